#include "load/generate.h"

#include "base/memory.h"
#include "base/status.h"
#include "load/number.h"

#include <stdio.h>
#include <string.h>

static const generate_shape *const shapes[] = {&generate_scattered, &generate_dense, &generate_mixed,
                                               &generate_tornado,   &generate_pool,  &generate_molecule,
                                               &generate_drop,      &generate_sheet};

enum { SHAPES = sizeof shapes / sizeof shapes[0] };

#define LARGEST_COUNT 2000000000u

static const generate_shape *find_shape(load_text name)
{
    size_t length = (size_t)(name.end - name.at);
    for (int i = 0; i < SHAPES; i++)
        if (strlen(shapes[i]->name) == length && !memcmp(shapes[i]->name, name.at, length)) return shapes[i];
    return NULL;
}

static const char *word_end(const char *text)
{
    while (*text >= 'a' && *text <= 'z') text++;
    return text;
}

bool generate_is_spec(const char *text)
{
    const char *end = word_end(text);
    return end > text && *end == ':';
}

bool generate_is_name(const char *text)
{
    return find_shape((load_text){text, text + strlen(text)}) != NULL;
}

static mns_status fail_name(load_text name, mns_error *error)
{
    char known[200] = "";
    size_t length = 0;
    for (int i = 0; i < SHAPES && length < sizeof known - 20; i++)
        length +=
            (size_t)snprintf(known + length, sizeof known - length, "%s%s", i ? ", " : "", shapes[i]->name);
    return status_fail(error, MNS_ERROR_USAGE, "no file and no generator '%.*s'; the generators are %s",
                       SHOWN(name), known);
}

/* The next of the numbers between colons; absent: what *value is. */
static bool next_number(const char **at, uint64_t *value)
{
    if (!**at) return true;
    const char *first = *at + 1, *end = first + strcspn(first, ":");
    *at = end;
    return *first != ' ' && number_count((load_text){first, end}, value);
}

mns_status generate_parse(const char *text, generate_spec *spec, mns_error *error)
{
    const char *at = word_end(text);
    load_text name = {text, at};
    uint64_t count = 0, seed = 1, frames = 1;
    const generate_shape *shape = find_shape(name);
    if (!shape) return fail_name(name, error);
    if (!next_number(&at, &count) || !next_number(&at, &seed) || !next_number(&at, &frames) || *at)
        return status_fail(error, MNS_ERROR_USAGE,
                           "'%.80s' is no generator; expected %s:count[:seed[:frames]]", text, shape->name);
    if (count < 1 || count > LARGEST_COUNT)
        return status_fail(error, MNS_ERROR_USAGE, "'%.80s' asks for %llu balls; expected 1 to %u", text,
                           (unsigned long long)count, LARGEST_COUNT);
    if (frames < 1 || frames > LARGEST_COUNT)
        return status_fail(error, MNS_ERROR_USAGE, "'%.80s' asks for %llu frames; expected 1 to %u", text,
                           (unsigned long long)frames, LARGEST_COUNT);
    *spec = (generate_spec){.shape = shape, .count = (size_t)count, .frames = (size_t)frames, .seed = seed};
    return MNS_OK;
}

/* The shape's extra column with its labels; p owns what was made even on failure. */
static bool add_column(const generate_shape *shape, particles *p)
{
    if (!shape->column) return true;
    p->column = calloc(1, sizeof *p->column);
    if (!p->column) return false;
    p->column_count = 1;
    p->column->name = strdup(shape->column);
    p->column->value = memory_array(p->count, sizeof(double));
    if (!p->column->name || !p->column->value) return false;
    size_t labels = 0;
    while (shape->labels && shape->labels[labels]) labels++;
    if (!labels) return true;
    p->column->label = calloc(labels, sizeof *p->column->label);
    for (size_t i = 0; p->column->label && i < labels; i++) {
        p->column->label[i] = strdup(shape->labels[i]);
        if (!p->column->label[i]) return false;
        p->column->label_count++;
    }
    return p->column->label != NULL;
}

static bool allocate(const generate_spec *spec, particles *p)
{
    *p = (particles){
        .count = spec->count, .format = "generator", .radius_is_surface = spec->shape->radius_is_surface};
    for (int k = 0; k < 3; k++)
        if (!(p->axis[k] = memory_array(p->count, sizeof(double)))) return false;
    p->radius = memory_array(p->count, sizeof(double));
    return p->radius && add_column(spec->shape, p);
}

mns_status generate_make(const generate_spec *spec, size_t frame, particles *p, mns_error *error)
{
    if (!allocate(spec, p)) {
        particles_free(p);
        return status_no_memory(error, "generating particles");
    }
    generate_frame shared = {.count = (double)spec->count, .seed = spec->seed, .time = (double)frame / 60};
    double *extra = p->column ? p->column->value : NULL;
    spec->shape->prepare(&shared);
#pragma omp parallel for
    for (size_t i = 0; i < p->count; i++) {
        generate_ball ball = {.radius = shared.radius};
        spec->shape->place(&shared, i, &ball);
        for (int k = 0; k < 3; k++) p->axis[k][i] = ball.at[k];
        p->radius[i] = ball.radius;
        if (extra) extra[i] = ball.extra;
    }
    if (extra) particles_column_range(p->column, p->count);
    return MNS_OK;
}
