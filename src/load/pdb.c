/* Protein Data Bank files: ATOM and HETATM records in fixed columns (wwPDB format 3.3). MODEL to ENDMDL is a
 * frame, and so is what an END record ends. Of alternate locations the one of the highest occupancy stays,
 * the first among equals. */
#include "load/cell.h"
#include "load/element.h"
#include "load/format.h"
#include "load/number.h"
#include "load/table.h"

#include "base/memory.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { X, Y, Z, RADIUS, ELEMENT, NAME, RESIDUE, CHAIN, NUMBER, OCCUPANCY, B_FACTOR, COLUMNS };

static const struct {
    const char *name;
    load_role role;
} columns[COLUMNS] = {{"x", ROLE_X},
                      {"y", ROLE_Y},
                      {"z", ROLE_Z},
                      {"radius", ROLE_RADIUS},
                      {"element", ROLE_LABEL},
                      {"name", ROLE_LABEL},
                      {"residue", ROLE_LABEL},
                      {"chain", ROLE_LABEL},
                      {"residue_number", ROLE_NUMBER},
                      {"occupancy", ROLE_NUMBER},
                      {"b_factor", ROLE_NUMBER}};

/* Where alternate locations of an atom went. */
typedef struct alternates {
    load_labels atom; /* chain, residue and atom name as one word */
    size_t *row;      /* of each atom */
    size_t capacity;
} alternates;

static bool pdb_is_like(load_text head)
{
    static const char *const records[] = {"HEADER", "TITLE ", "COMPND", "REMARK", "CRYST1", "MODEL ",
                                          "ATOM  ", "HETATM", "AUTHOR", "EXPDTA", "OBSLTE", "SPLIT "};
    while (head.at < head.end && (*head.at == '\n' || *head.at == '\r')) head.at++;
    for (size_t i = 0; i < sizeof records / sizeof *records; i++)
        if (text_begins(head, records[i])) return true;
    return false;
}

static bool is_atom(load_text line)
{
    return text_begins(line, "ATOM  ") || text_begins(line, "HETATM");
}

static bool is_record(load_text line, const char *name)
{
    while (line.end > line.at && line.end[-1] == ' ') line.end--;
    size_t length = strlen(name);
    return text_begins(line, name) && (line.at + length == line.end || line.at[length] == ' ');
}

static bool ends_frame(load_text line)
{
    return is_record(line, "ENDMDL") || is_record(line, "END");
}

static bool pdb_scan(load_stream *s, load_frames *frames)
{
    load_place place = stream_place(s);
    load_text line;
    bool is_open = false;
    while (stream_line(s, &line)) {
        if (ends_frame(line)) {
            if (is_open || !frames->count)
                place = stream_place(s); /* what follows belongs to the next frame */
            is_open = false;
        } else if (!is_open && (is_atom(line) || is_record(line, "MODEL"))) {
            if (!frames_add(frames, place)) return false;
            is_open = true;
        }
    }
    return true;
}

/* Columns `first` to `last` counted from 1, as far as the line has them. */
static load_text cut(load_text line, int first, int last)
{
    ptrdiff_t length = line.end - line.at;
    ptrdiff_t from = first - 1 < length ? first - 1 : length, to = last < length ? last : length;
    return (load_text){line.at + from, line.at + to};
}

static load_text cut_word(load_text line, int first, int last)
{
    load_text word = cut(line, first, last);
    while (word.at < word.end && *word.at == ' ') word.at++;
    while (word.at < word.end && word.end[-1] == ' ') word.end--;
    return word;
}

static bool read_number(load_table *t, load_stream *s, int column, load_text text, double blank)
{
    double value = blank;
    bool is_blank = text.at == text.end && isfinite(blank);
    if (!is_blank && !number_whole(text, &value)) {
        stream_fail_line(s, "%s is '%.*s'; expected a%s number", columns[column].name, SHOWN(text),
                         number_is_special(text) ? " finite" : "");
        return false;
    }
    t->column[column].value[t->row_count] = value;
    return true;
}

static bool read_label(load_table *t, load_stream *s, int column, load_text text)
{
    size_t number;
    if (!labels_number(&t->column[column].labels, text, &number)) {
        stream_no_memory(s);
        return false;
    }
    t->column[column].value[t->row_count] = (double)number;
    return true;
}

/* Fills the row after the last one. */
static bool read_atom(load_table *t, load_stream *s, load_text line)
{
    if (line.end - line.at < 54) {
        stream_fail_line(s, "%zu columns; expected an atom's position in columns 31 to 54",
                         (size_t)(line.end - line.at));
        return false;
    }
    const char *element = element_of_pdb(cut(line, 77, 78), cut(line, 13, 16));
    double radius = element_radius(text_of(element));
    if (!table_reserve(t, s, 1)) return false;
    t->column[RADIUS].value[t->row_count] = radius > 0 ? radius : ELEMENT_UNKNOWN_RADIUS;
    /* A residue number past 9999 is written in letters by some programs; it is for colour only. */
    load_text number = cut_word(line, 23, 26);
    double value;
    if (!number_whole(number, &value)) number.end = number.at;
    return read_number(t, s, X, cut_word(line, 31, 38), NAN) &&
           read_number(t, s, Y, cut_word(line, 39, 46), NAN) &&
           read_number(t, s, Z, cut_word(line, 47, 54), NAN) && read_label(t, s, ELEMENT, text_of(element)) &&
           read_label(t, s, NAME, cut_word(line, 13, 16)) &&
           read_label(t, s, RESIDUE, cut_word(line, 18, 20)) &&
           read_label(t, s, CHAIN, cut_word(line, 22, 22)) && read_number(t, s, NUMBER, number, 0) &&
           read_number(t, s, OCCUPANCY, cut_word(line, 55, 60), 1) &&
           read_number(t, s, B_FACTOR, cut_word(line, 61, 66), 0);
}

/* Decides about the row just filled, of an atom with alternate locations: a new atom's stays; a better one
 * takes the place of the one before; *skipped counts. */
static bool settle_alternate(load_table *t, load_stream *s, load_text line, alternates *known,
                             size_t *skipped)
{
    char key[16];
    load_text name = cut(line, 13, 16), residue = cut(line, 22, 27);
    memcpy(key, name.at, 4);
    memcpy(key + 4, residue.at, 6);
    size_t number, before = known->atom.count;
    if (!labels_number(&known->atom, (load_text){key, key + 10}, &number)) goto no_memory;
    if (number == before) {
        if (known->atom.capacity > known->capacity) {
            size_t *row = memory_resize(known->row, known->atom.capacity, sizeof *row);
            if (!row) goto no_memory;
            known->row = row, known->capacity = known->atom.capacity;
        }
        known->row[number] = t->row_count++;
        return true;
    }
    ++*skipped;
    size_t row = known->row[number], last = t->row_count;
    if (t->column[OCCUPANCY].value[last] > t->column[OCCUPANCY].value[row])
        for (int c = 0; c < COLUMNS; c++) t->column[c].value[row] = t->column[c].value[last];
    return true;
no_memory:
    stream_no_memory(s);
    return false;
}

/* The unit cell's edges from lengths and angles (degrees): a along x, b in the xy plane. */
static void read_cell(load_text line, particles *p)
{
    static const int from[6] = {7, 16, 25, 34, 41, 48}, to[6] = {15, 24, 33, 40, 47, 54};
    double v[6];
    const double degree = 3.14159265358979323846 / 180, origin[3] = {0};
    for (int i = 0; i < 6; i++)
        if (!number_whole(cut(line, from[i], to[i]), &v[i])) return;
    if (v[0] <= 1 && v[1] <= 1 && v[2] <= 1) return; /* the format's way to say: no crystal */
    double cos_a = cos(v[3] * degree), cos_b = cos(v[4] * degree), cos_c = cos(v[5] * degree),
           sin_c = sin(v[5] * degree);
    double cx = v[2] * cos_b, cy = v[2] * (cos_a - cos_b * cos_c) / sin_c,
           cz2 = v[2] * v[2] - cx * cx - cy * cy;
    const double edges[3][3] = {
        {v[0], 0, 0}, {v[1] * cos_c, v[1] * sin_c, 0}, {cx, cy, cz2 > 0 ? sqrt(cz2) : 0}};
    cell_set(p, origin, edges);
}

/* Records up to the frame's end. */
static bool read_records(load_table *t, load_stream *s, alternates *known, particles *p)
{
    load_text line;
    bool in_model = false;
    while (stream_line(s, &line)) {
        if (is_atom(line)) {
            if (!read_atom(t, s, line)) return false;
            if (line.at[16] == ' ')
                t->row_count++;
            else if (!settle_alternate(t, s, line, known, &p->rows_skipped))
                return false;
        } else if (is_record(line, "MODEL")) {
            if (in_model || t->row_count) {
                stream_fail_line(s, "MODEL inside a frame; expected ENDMDL before");
                return false;
            }
            in_model = true;
        } else if (is_record(line, "CRYST1")) {
            read_cell(line, p);
        } else if (ends_frame(line) && (t->row_count || in_model)) {
            return true;
        }
    }
    if (in_model) stream_fail_line(s, "the file ends inside a MODEL; expected ENDMDL");
    if (!t->row_count) stream_fail_line(s, "no ATOM or HETATM record in the file; expected atoms");
    return !s->status;
}

static mns_status pdb_read(load_stream *s, particles *p)
{
    load_table table = {0};
    alternates known = {0};
    bool is_fine = true;
    for (int c = 0; is_fine && c < COLUMNS; c++)
        is_fine = table_add_column(&table, s, text_of(columns[c].name), columns[c].role);
    is_fine = is_fine && read_records(&table, s, &known, p);
    free(known.row);
    labels_free(&known.atom);
    if (is_fine) {
        p->radius_is_surface = true;
        if (p->rows_skipped)
            snprintf(p->rows_skipped_why, sizeof p->rows_skipped_why,
                     "alternate locations of an atom: the one of highest occupancy is kept");
        return table_finish(&table, s, p);
    }
    table_free(&table);
    return s->status;
}

const load_format format_pdb = {.name = "pdb",
                                .endings = ".pdb .ent .brk ",
                                .radius_source = "van der Waals",
                                .is_like = pdb_is_like,
                                .scan = pdb_scan,
                                .read = pdb_read};
