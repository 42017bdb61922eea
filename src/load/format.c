#include "load/format.h"

#include "base/memory.h"
#include "base/status.h"
#include "load/table.h"

#include <string.h>
#include <strings.h>

/* In the order they are tried: what is told most surely comes first. */
const load_format *const load_formats[] = {&format_vtk, &format_lammps, &format_pdb,
                                           &format_xyz, &format_csv,    NULL};

enum { HEAD_SIZE = 4096 };

const load_format *format_by_name(const char *name)
{
    for (const load_format *const *f = load_formats; *f; f++)
        if (!strcmp((*f)->name, name)) return *f;
    return NULL;
}

static bool ends_with(const char *name, size_t length, const char *ending, size_t ending_length)
{
    return length > ending_length && !strncasecmp(name + length - ending_length, ending, ending_length);
}

/* Whether the name, with .gz left aside, has one of the endings. */
static bool has_ending(const char *name, const char *endings)
{
    size_t length = strlen(name);
    if (ends_with(name, length, ".gz", 3)) length -= 3;
    for (const char *next; (next = strchr(endings, ' ')); endings = next + 1)
        if (ends_with(name, length, endings, (size_t)(next - endings))) return true;
    return false;
}

const load_format *format_find(load_stream *s, const char *name)
{
    load_text head = stream_peek(s, HEAD_SIZE);
    if (s->status) return NULL;
    if (head.at == head.end) {
        stream_fail(s, MNS_ERROR_INPUT, "nothing is in the file; expected particles");
        return NULL;
    }
    for (const load_format *const *f = load_formats; *f; f++)
        if ((*f)->is_like(head)) return *f;
    for (const load_format *const *f = load_formats; *f; f++)
        if (has_ending(name, (*f)->endings)) return *f;
    stream_fail(s, MNS_ERROR_INPUT,
                "unknown format; expected CSV, XYZ, a LAMMPS text dump, PDB or legacy VTK");
    return NULL;
}

bool frames_add(load_frames *frames, load_place place)
{
    if (frames->count == frames->capacity) {
        size_t capacity = frames->capacity ? frames->capacity * 2 : 16;
        load_place *grown = memory_resize(frames->place, capacity, sizeof *grown);
        if (!grown) return false;
        frames->place = grown, frames->capacity = capacity;
    }
    frames->place[frames->count++] = place;
    return true;
}

bool format_next_line(load_stream *s, load_place *place, load_text *line)
{
    for (;;) {
        *place = stream_place(s);
        if (!stream_line(s, line)) return false;
        for (const char *c = line->at; c < line->end; c++)
            if (*c != ' ' && *c != '\t' && *c != '\r') return true;
    }
}

mns_status format_try(const load_format *format, const void *data, size_t size, mns_error *error)
{
    load_stream s;
    load_frames frames = {0};
    mns_status status = stream_open_memory(&s, data, size, "memory", error);
    if (!status) {
        const load_place start = stream_place(&s);
        if (format->scan ? !format->scan(&s, &frames) : !frames_add(&frames, start))
            status = status_no_memory(error, "reading particles");
        if (!status && !frames.count && !frames_add(&frames, start))
            status = status_no_memory(error, "reading particles");
    }
    for (size_t i = 0; !status && i < frames.count; i++) {
        particles p = {0};
        status = stream_seek(&s, frames.place[i]);
        if (!status) status = format->read(&s, &p);
        mns_field *field = NULL;
        if (!status) status = field_from_particles(&p, NULL, format->radius_source, &field, error);
        mns_field_destroy(field);
        particles_free(&p);
    }
    free(frames.place);
    stream_close(&s);
    return status;
}
