/* Legacy VTK files: the points of POLYDATA, UNSTRUCTURED_GRID or any data set that lists them, in ASCII or
 * binary, with their point data. Cells are passed over (VTK User's Guide, "Legacy file formats"; cells of
 * version 5 as offsets and connectivity). */
#include "load/vtk.h"

#include "base/memory.h"
#include "load/format.h"
#include "load/number.h"

#include <stdio.h>
#include <string.h>

typedef struct reader {
    load_stream *s;
    load_table *table;
    bool is_binary;
    bool has_points;
    enum { PART_GEOMETRY, PART_POINTS, PART_CELLS } part; /* what attributes that follow belong to */
    uint64_t tuples;                                      /* of that part */
} reader;

static bool vtk_is_like(load_text head)
{
    return text_begins(head, "# vtk DataFile");
}

static bool fail_section(reader *r, const char *section, const char *expected)
{
    stream_fail_line(r->s, "%.40s is not as expected: %s", section, expected);
    return false;
}

static bool is_product_small(uint64_t a, uint64_t b)
{
    return !b || a <= UINT64_MAX / 4 / b;
}

/* The rest of a line as words; gives how many there are, at most `limit`. Those that are not there are empty.
 */
static size_t split_words(load_text line, load_text *word, size_t limit)
{
    size_t count = 0;
    while (count < limit && table_next_field(&line, ' ', &word[count])) count++;
    for (size_t i = count; i < limit; i++) word[i] = text_of("");
    return count;
}

/* ---- Columns ---- */

/* Names may carry %20 and its like; a component adds its letter or number. */
static int full_name(char *to, size_t size, load_text name, uint64_t width, uint64_t component)
{
    size_t length = 0;
    while (name.at < name.end && length + 24 < size) {
        unsigned code;
        if (*name.at == '%' && name.end - name.at >= 3 && sscanf(name.at + 1, "%2x", &code) == 1 &&
            code >= 0x20) {
            to[length++] = (char)code;
            name.at += 3;
        } else {
            to[length++] = *name.at++;
        }
    }
    to[length] = 0;
    if (width == 1) return (int)length;
    if (width == 3) return (int)length + snprintf(to + length, size - length, "_%c", "xyz"[component]);
    return (int)length + snprintf(to + length, size - length, "_%llu", (unsigned long long)component + 1);
}

/* Makes columns of an array's components, as many rows as there are points. */
static bool add_columns(reader *r, load_text name, uint64_t width, const vtk_values *v, load_role role)
{
    load_table *t = r->table;
    size_t rows = v->count / width;
    for (uint64_t k = 0; k < width; k++) {
        char full[160];
        int length = full_name(full, sizeof full, name, width, k);
        load_role own = role == ROLE_X ? (load_role)k : table_free_role(t, role);
        if (!table_add_column(t, r->s, (load_text){full, full + length}, own)) return false;
        load_column *column = &t->column[t->column_count - 1];
        column->value = memory_array(rows, sizeof *column->value);
        if (!column->value) {
            stream_no_memory(r->s);
            return false;
        }
        for (size_t i = 0; i < rows; i++) {
            double value = v->value[i * width + k];
            if (own == ROLE_RADIUS && !(value > 0)) {
                stream_fail(r->s, MNS_ERROR_INPUT, "the radius of point %zu is %g; expected one above 0", i,
                            value);
                return false;
            }
            column->value[i] = value;
        }
    }
    return true;
}

static load_role role_of_array(load_text name, uint64_t width)
{
    if (width == 1 && text_is(name, "radius")) return ROLE_RADIUS;
    if (width == 1 && text_is(name, "strength")) return ROLE_STRENGTH;
    return ROLE_NUMBER;
}

/* An array of the current part: kept where it belongs to the points. */
static bool read_array(reader *r, load_text name, uint64_t width, uint64_t tuples, vtk_type type)
{
    char shown[128]; /* the name goes with the next line */
    snprintf(shown, sizeof shown, "%.*s", name.end - name.at > 120 ? 120 : (int)(name.end - name.at),
             name.at);
    load_text kept_name = text_of(shown);
    bool is_kept = r->part == PART_POINTS && type != VTK_NONE;
    if (is_kept && tuples != r->tuples) return fail_section(r, shown, "as many tuples as POINT_DATA has");
    if (width < 1 || width > TABLE_COLUMNS || !is_product_small(tuples, width))
        return fail_section(r, shown, "a number of components from 1 to 1024");
    if (type == VTK_NONE) return fail_section(r, shown, "an array of numbers");
    vtk_values v = {0};
    bool is_fine = vtk_read_values(r->s, r->is_binary, type, tuples * width, shown, is_kept ? &v : NULL);
    if (is_fine && is_kept) is_fine = add_columns(r, kept_name, width, &v, role_of_array(kept_name, width));
    free(v.value);
    return is_fine;
}

/* ---- Sections ---- */

static bool read_points(reader *r, const load_text *word, size_t words)
{
    uint64_t count;
    if (words < 3 || !number_count(word[1], &count) || !is_product_small(count, 3) || r->has_points)
        return fail_section(r, "POINTS", "once, POINTS count type, a count that a file can hold");
    vtk_type type = vtk_type_by_name(word[2]);
    if (type == VTK_NONE) return fail_section(r, "POINTS", "a type of numbers such as float");
    vtk_values v = {0};
    bool is_fine = vtk_read_values(r->s, r->is_binary, type, count * 3, "POINTS", &v);
    if (is_fine) is_fine = add_columns(r, text_of("position"), 3, &v, ROLE_X);
    free(v.value);
    r->table->row_count = r->table->capacity = (size_t)count;
    r->has_points = true;
    return is_fine;
}

/* OFFSETS or CONNECTIVITY of version 5. */
static bool skip_cell_array(reader *r, uint64_t count)
{
    load_place place;
    load_text line, word[2];
    vtk_type type;
    if (!format_next_line(r->s, &place, &line) || split_words(line, word, 2) < 2 ||
        (!text_is(word[0], "OFFSETS") && !text_is(word[0], "CONNECTIVITY")) ||
        (type = vtk_type_by_name(word[1])) == VTK_NONE)
        return r->s->status ? false : fail_section(r, "the cells", "OFFSETS or CONNECTIVITY, and a type");
    return vtk_read_values(r->s, r->is_binary, type, count, "cells", NULL);
}

/* VERTICES, LINES, CELLS and so on: `count size`, then ints; version 5 has `offsets connections` and two
 * arrays. */
static bool skip_cells(reader *r, const load_text *word, size_t words)
{
    uint64_t count, size;
    if (words < 3 || !number_count(word[1], &count) || !number_count(word[2], &size))
        return fail_section(r, "the cells", "two counts");
    load_text next = stream_peek(r->s, 8);
    if (r->s->status) return false;
    if (text_begins(next, "OFFSETS ")) return skip_cell_array(r, count) && skip_cell_array(r, size);
    return vtk_read_values(r->s, r->is_binary, VTK_I32, size, "cells", NULL);
}

static bool skip_cell_types(reader *r, const load_text *word, size_t words)
{
    uint64_t count;
    if (words < 2 || !number_count(word[1], &count)) return fail_section(r, "CELL_TYPES", "a count");
    return vtk_read_values(r->s, r->is_binary, VTK_I32, count, "CELL_TYPES", NULL);
}

/* SCALARS name type [components], then a line LOOKUP_TABLE name. */
static bool read_scalars(reader *r, const load_text *word, size_t words)
{
    char name[128], type_name[24];
    uint64_t width = 1;
    load_text line;
    if (words < 3 || (words > 3 && !number_count(word[3], &width)))
        return fail_section(r, "SCALARS", "SCALARS name type [components]");
    snprintf(name, sizeof name, "%.*s",
             word[1].end - word[1].at > 120 ? 120 : (int)(word[1].end - word[1].at), word[1].at);
    snprintf(type_name, sizeof type_name, "%.*s",
             word[2].end - word[2].at > 20 ? 20 : (int)(word[2].end - word[2].at), word[2].at);
    load_text next = stream_peek(r->s, 12);
    if (r->s->status) return false;
    if (text_begins(next, "LOOKUP_TABLE") && !stream_line(r->s, &line)) return false;
    return read_array(r, text_of(name), width, r->tuples, vtk_type_by_name(text_of(type_name)));
}

static bool read_fixed(reader *r, const load_text *word, size_t words, uint64_t width)
{
    if (words < 3) return fail_section(r, "an attribute", "its name and type");
    return read_array(r, word[1], width, r->tuples, vtk_type_by_name(word[2]));
}

static bool read_coordinates(reader *r, const load_text *word, size_t words)
{
    uint64_t width;
    if (words < 4 || !number_count(word[2], &width))
        return fail_section(r, "TEXTURE_COORDINATES", "name, width, type");
    return read_array(r, word[1], width, r->tuples, vtk_type_by_name(word[3]));
}

/* Colours: bytes in binary, numbers from 0 to 1 in ASCII. */
static bool read_colors(reader *r, const load_text *word, size_t words)
{
    uint64_t width;
    if (words < 3 || !number_count(word[2], &width))
        return fail_section(r, "COLOR_SCALARS", "name and components");
    return read_array(r, word[1], width, r->tuples, VTK_U8);
}

static bool skip_lookup_table(reader *r, const load_text *word, size_t words)
{
    uint64_t size;
    if (words < 3 || !number_count(word[2], &size) || !is_product_small(size, 4))
        return fail_section(r, "LOOKUP_TABLE", "name and size");
    return vtk_read_values(r->s, r->is_binary, VTK_U8, size * 4, "LOOKUP_TABLE", NULL);
}

static bool skip_metadata(reader *r)
{
    load_text line;
    while (stream_line(r->s, &line))
        if (line.at == line.end) return true; /* a blank line ends it */
    return !r->s->status;
}

/* FIELD name arrays, then each: name components tuples type. */
static bool read_field(reader *r, const load_text *word, size_t words)
{
    uint64_t arrays, width, tuples;
    if (words < 3 || !number_count(word[2], &arrays)) return fail_section(r, "FIELD", "FIELD name arrays");
    for (uint64_t i = 0; i < arrays; i++) {
        load_place place;
        load_text line, part[4];
        if (!format_next_line(r->s, &place, &line))
            return r->s->status ? false : fail_section(r, "FIELD", "as many arrays as it says");
        size_t parts = split_words(line, part, 4);
        if (parts >= 1 && text_is(part[0], "METADATA")) { /* of the array before */
            if (!skip_metadata(r)) return false;
            i--;
            continue;
        }
        if (parts < 4 || !number_count(part[1], &width) || !number_count(part[2], &tuples))
            return fail_section(r, "FIELD", "name components tuples type");
        if (!read_array(r, part[0], width, tuples, vtk_type_by_name(part[3]))) return false;
    }
    return true;
}

static bool begin_data(reader *r, const load_text *word, size_t words)
{
    r->part = text_is(word[0], "POINT_DATA") ? PART_POINTS : PART_CELLS;
    if (words < 2 || !number_count(word[1], &r->tuples))
        return fail_section(r, "POINT_DATA or CELL_DATA", "a count");
    if (r->part == PART_POINTS && (!r->has_points || r->tuples != r->table->row_count))
        return fail_section(r, "POINT_DATA", "as many as there are POINTS, which come before");
    return true;
}

static bool is_cells(load_text word)
{
    static const char *const names[] = {"VERTICES", "LINES", "POLYGONS", "TRIANGLE_STRIPS", "CELLS"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (text_is(word, names[i])) return true;
    return false;
}

static bool read_section(reader *r, const load_text *word, size_t words)
{
    if (text_is(word[0], "POINTS")) return read_points(r, word, words);
    if (is_cells(word[0])) return skip_cells(r, word, words);
    if (text_is(word[0], "CELL_TYPES")) return skip_cell_types(r, word, words);
    if (text_is(word[0], "POINT_DATA") || text_is(word[0], "CELL_DATA")) return begin_data(r, word, words);
    if (text_is(word[0], "FIELD")) return read_field(r, word, words);
    if (text_is(word[0], "METADATA")) return skip_metadata(r);
    if (text_is(word[0], "DIMENSIONS")) return true; /* of a structured grid, which lists its points */
    if (r->part == PART_GEOMETRY) goto unknown;
    if (text_is(word[0], "SCALARS")) return read_scalars(r, word, words);
    if (text_is(word[0], "VECTORS") || text_is(word[0], "NORMALS")) return read_fixed(r, word, words, 3);
    if (text_is(word[0], "TENSORS")) return read_fixed(r, word, words, 9);
    if (text_is(word[0], "TENSORS6")) return read_fixed(r, word, words, 6);
    if (text_is(word[0], "GLOBAL_IDS") || text_is(word[0], "PEDIGREE_IDS"))
        return read_fixed(r, word, words, 1);
    if (text_is(word[0], "TEXTURE_COORDINATES")) return read_coordinates(r, word, words);
    if (text_is(word[0], "COLOR_SCALARS")) return read_colors(r, word, words);
    if (text_is(word[0], "LOOKUP_TABLE")) return skip_lookup_table(r, word, words);
unknown:
    stream_fail_line(r->s, "'%.*s'; expected a section of a legacy VTK file, such as POINTS or POINT_DATA",
                     SHOWN(word[0]));
    return false;
}

/* ---- The file ---- */

static bool read_head(reader *r)
{
    load_place place;
    load_text line, word[2];
    if (!stream_line(r->s, &line) || !vtk_is_like(line)) {
        stream_fail_line(r->s, "expected '# vtk DataFile Version'");
        return false;
    }
    if (!stream_line(r->s, &line) || !format_next_line(r->s, &place, &line)) {
        stream_fail_line(r->s, "the file ends; expected a title, then ASCII or BINARY");
        return false;
    }
    split_words(line, word, 1);
    r->is_binary = text_is(word[0], "BINARY");
    if (!r->is_binary && !text_is(word[0], "ASCII")) {
        stream_fail_line(r->s, "'%.*s'; expected ASCII or BINARY", SHOWN(line));
        return false;
    }
    if (!format_next_line(r->s, &place, &line) || split_words(line, word, 2) < 2 ||
        !text_is(word[0], "DATASET")) {
        stream_fail_line(r->s, "expected DATASET and its kind");
        return false;
    }
    return true;
}

static mns_status vtk_read(load_stream *s, particles *p)
{
    load_table table = {0};
    reader r = {.s = s, .table = &table};
    load_place place;
    load_text line, word[4];
    bool is_fine = read_head(&r);
    while (is_fine && format_next_line(s, &place, &line)) {
        size_t words = split_words(line, word, 4);
        is_fine = words ? read_section(&r, word, words) : true;
    }
    if (is_fine && !s->status && !r.has_points) stream_fail_line(s, "the file ends without POINTS");
    if (!s->status) return table_finish(&table, s, p);
    table_free(&table);
    return s->status;
}

const load_format format_vtk = {
    .name = "vtk", .endings = ".vtk ", .radius_source = "file", .is_like = vtk_is_like, .read = vtk_read};
