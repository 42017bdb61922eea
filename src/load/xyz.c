/* XYZ and extended XYZ: a count, a comment, then a line an atom; frames follow one another. The extended
 * comment names the columns, Properties=species:S:1:pos:R:3:..., and gives the box, Lattice="ax ay az bx by
 * bz cx cy cz". */
#include "load/cell.h"
#include "load/format.h"
#include "load/number.h"
#include "load/rows.h"

#include <stdio.h>
#include <string.h>

static bool xyz_is_like(load_text head)
{
    const char *end = memchr(head.at, '\n', (size_t)(head.end - head.at));
    if (!end) return false;
    uint64_t count;
    return number_count((load_text){head.at, end > head.at && end[-1] == '\r' ? end - 1 : end}, &count);
}

static bool xyz_scan(load_stream *s, load_frames *frames)
{
    load_place place;
    load_text line;
    while (format_next_line(s, &place, &line)) {
        uint64_t count;
        if (!frames_add(frames, place)) return false;
        if (!number_count(line, &count) || count >= UINT64_MAX - 1) break;
        if (stream_skip_lines(s, count + 1) < count + 1) break;
    }
    return true;
}

/* ---- The comment ---- */

/* The value of `key` in key=value pairs, without quotes; false where it is not there. */
static bool find_value(load_text comment, const char *key, load_text *value)
{
    const char *at = comment.at, *end = comment.end;
    while (at < end) {
        while (at < end && (*at == ' ' || *at == '\t')) at++;
        load_text name = {at, at};
        while (at < end && *at != '=' && *at != ' ' && *at != '\t') at++;
        name.end = at;
        if (at == end || *at != '=') continue;
        at++;
        char quote = at < end && (*at == '"' || *at == '\'') ? *at : at < end && *at == '{' ? '}' : 0;
        at += quote != 0;
        value->at = at;
        while (at < end && (quote ? *at != quote : *at != ' ' && *at != '\t')) at++;
        value->end = at;
        at += quote && at < end;
        if (text_is(name, key)) return true;
    }
    return false;
}

static bool read_lattice(load_stream *s, load_text comment, particles *p)
{
    load_text text;
    double edges[3][3], origin[3] = {0};
    if (!find_value(comment, "Lattice", &text)) return true;
    if (!cell_numbers(text, 9, edges[0])) {
        stream_fail_line(s, "Lattice is \"%.*s\"; expected 9 numbers", SHOWN(text));
        return false;
    }
    if (find_value(comment, "Origin", &text) && !cell_numbers(text, 3, origin)) {
        stream_fail_line(s, "Origin is \"%.*s\"; expected 3 numbers", SHOWN(text));
        return false;
    }
    cell_set(p, origin, (const double(*)[3])edges);
    return true;
}

/* ---- Columns ---- */

static bool next_part(load_text *rest, load_text *part)
{
    if (!rest->at) return false;
    const char *end = memchr(rest->at, ':', (size_t)(rest->end - rest->at));
    *part = (load_text){rest->at, end ? end : rest->end};
    rest->at = end ? end + 1 : NULL;
    return true;
}

static load_role property_role(load_text name, char type, uint64_t width)
{
    if (type == 'S') return ROLE_LABEL;
    if (type == 'L') return ROLE_LOGICAL;
    if (width == 1 && text_is(name, "radius")) return ROLE_RADIUS;
    if (width == 1 && text_is(name, "strength")) return ROLE_STRENGTH;
    return ROLE_NUMBER;
}

static bool add_property(load_table *t, load_stream *s, load_text name, char type, uint64_t width)
{
    bool is_position = text_is(name, "pos") && type == 'R' && width == 3;
    load_role role = property_role(name, type, width);
    if (text_is(name, "species")) name = text_of("element");
    for (uint64_t i = 0; i < width; i++) {
        char full[128];
        int length = (int)(name.end - name.at) < 100 ? (int)(name.end - name.at) : 100;
        if (width == 1)
            length = snprintf(full, sizeof full, "%.*s", length, name.at);
        else if (width == 3)
            length = snprintf(full, sizeof full, "%.*s_%c", length, name.at, "xyz"[i]);
        else
            length = snprintf(full, sizeof full, "%.*s_%d", length, name.at, (int)i + 1);
        load_role free_role = is_position ? table_free_role(t, (load_role)i)
                              : role == ROLE_RADIUS || role == ROLE_STRENGTH ? table_free_role(t, role)
                                                                             : role;
        if (!table_add_column(t, s, (load_text){full, full + length}, free_role)) return false;
    }
    return true;
}

static bool add_properties(load_table *t, load_stream *s, load_text properties)
{
    load_text rest = properties, name, type, width_text;
    while (next_part(&rest, &name)) {
        uint64_t width;
        if (!next_part(&rest, &type) || !next_part(&rest, &width_text) || type.end - type.at != 1 ||
            !strchr("SRIL", *type.at) || !number_count(width_text, &width) || width < 1 ||
            width > TABLE_COLUMNS) {
            stream_fail_line(s, "Properties '%.*s'; expected name:type:columns, type S, R, I or L",
                             SHOWN(name));
            return false;
        }
        if (!add_property(t, s, name, *type.at, width)) return false;
    }
    if (table_find(t, ROLE_X) < t->column_count) return true;
    stream_fail_line(s, "Properties name no positions; expected pos:R:3");
    return false;
}

/* Without Properties: an element and x, y, z, and what follows; or x, y, z alone. */
static bool add_plain(load_table *t, load_stream *s, load_text row)
{
    static const char *const names[] = {"element", "x", "y", "z"};
    size_t count = table_count_fields(row, ' ');
    if (count < 3) {
        stream_fail_line(s, "%zu columns; expected an element and x, y, z", count);
        return false;
    }
    load_text field;
    for (size_t i = count == 3; table_next_field(&row, ' ', &field); i++) {
        char number[32];
        snprintf(number, sizeof number, "column%zu", i + 1);
        const char *name = i < 4 ? names[i] : number;
        load_role role = i == 0 ? ROLE_LABEL : i < 4 ? (load_role)(i - 1) : table_guess_role(field);
        if (!table_add_column(t, s, text_of(name), role)) return false;
    }
    return true;
}

/* ---- A frame ---- */

static bool read_atoms(load_table *t, load_stream *s, uint64_t count)
{
    uint64_t rest = 0;
    load_text line;
    if (!count) return t->column_count || add_plain(t, s, text_of("0 0 0"));
    bool has_first = stream_line(s, &line);
    if (has_first) {
        if (!t->column_count && !add_plain(t, s, line)) return false;
        if (!table_add_row(t, s, line) || !rows_add(t, s, count - 1, NULL, &rest)) return false;
    }
    const unsigned long long found = has_first + rest, expected = count;
    if (s->status || found == expected) return !s->status;
    stream_fail_line(s, "the file ends after %llu atoms of %llu", found, expected);
    return false;
}

static mns_status xyz_read(load_stream *s, particles *p)
{
    load_table table = {.separator = ' '};
    load_place place;
    load_text line, properties;
    uint64_t count;
    if (!format_next_line(s, &place, &line))
        return stream_fail_line(s, "the file ends; expected a number of atoms");
    if (!number_count(line, &count))
        return stream_fail_line(s, "'%.*s'; expected a number of atoms", SHOWN(line));
    if (!stream_line(s, &line))
        return stream_fail_line(s, "the file ends; expected a comment and %llu atoms",
                                (unsigned long long)count);
    if (!read_lattice(s, line, p)) return s->status;
    bool is_ready = !find_value(line, "Properties", &properties) || add_properties(&table, s, properties);
    if (is_ready && read_atoms(&table, s, count)) return table_finish(&table, s, p);
    table_free(&table);
    return s->status;
}

const load_format format_xyz = {.name = "xyz",
                                .endings = ".xyz .extxyz ",
                                .radius_source = "file",
                                .is_like = xyz_is_like,
                                .scan = xyz_scan,
                                .read = xyz_read};
