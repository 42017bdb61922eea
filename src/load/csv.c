/* Comma-separated values, and the same with semicolons, tabs or blanks. A header's names decide what the
 * columns are; without one they are x, y, z, then a radius, then a strength. Lines that begin with '#' are
 * comments. */
#include "load/format.h"
#include "load/number.h"
#include "load/rows.h"

#include <stdio.h>
#include <string.h>

static bool is_passed_over(load_text line)
{
    while (line.at < line.end && (*line.at == ' ' || *line.at == '\t' || *line.at == '\r')) line.at++;
    return line.at == line.end || *line.at == '#';
}

static bool next_row(load_stream *s, load_text *line)
{
    while (stream_line(s, line))
        if (!is_passed_over(*line)) return true;
    return false;
}

static char find_separator(load_text line)
{
    static const char separators[] = {';', ',', '\t'};
    for (size_t i = 0; i < sizeof separators; i++)
        if (memchr(line.at, separators[i], (size_t)(line.end - line.at))) return separators[i];
    return ' ';
}

/* A header has a field that is neither a number nor a bad number. */
static bool is_header(load_text line, char separator)
{
    load_text field;
    while (table_next_field(&line, separator, &field))
        if (table_guess_role(field) == ROLE_LABEL) return true;
    return false;
}

static load_role role_of_name(load_text name)
{
    if (text_is(name, "x")) return ROLE_X;
    if (text_is(name, "y")) return ROLE_Y;
    if (text_is(name, "z")) return ROLE_Z;
    if (text_is(name, "r") || text_is(name, "radius")) return ROLE_RADIUS;
    if (text_is(name, "q") || text_is(name, "strength")) return ROLE_STRENGTH;
    return ROLE_NUMBER;
}

static bool csv_is_like(load_text head)
{
    load_text line;
    do { /* the first line that counts */
        const char *end = memchr(head.at, '\n', (size_t)(head.end - head.at));
        line = (load_text){head.at, end ? end : head.end};
        head.at = end ? end + 1 : head.end;
    } while (is_passed_over(line) && head.at < head.end);
    if (line.end > line.at && line.end[-1] == '\r') line.end--;
    char separator = find_separator(line);
    if (!is_header(line, separator)) return table_count_fields(line, separator) >= 3;
    unsigned found = 0;
    load_text field;
    while (table_next_field(&line, separator, &field)) found |= 1u << role_of_name(field);
    return (found & 7) == 7;
}

/* Names of a header; what a column that is kept holds shows in the first row. */
static bool add_named(load_table *t, load_stream *s, load_text header)
{
    load_text name;
    char number[32];
    while (table_next_field(&header, t->separator, &name)) {
        load_role role = role_of_name(name);
        if (name.at == name.end) {
            int length = snprintf(number, sizeof number, "column%zu", t->column_count + 1);
            name = (load_text){number, number + length};
        }
        for (size_t i = 0; i < t->column_count; i++)
            if (text_is(name, t->column[i].name) || (role != ROLE_NUMBER && t->column[i].role == role)) {
                stream_fail_line(s, "the columns '%.60s' and '%.*s' mean the same; expected one of them",
                                 t->column[i].name, SHOWN(name));
                return false;
            }
        if (!table_add_column(t, s, name, role)) return false;
    }
    for (load_role role = ROLE_X; role <= ROLE_Z; role++)
        if (table_find(t, role) == t->column_count) {
            stream_fail_line(s, "no column '%c' in the header; expected x, y and z, or 3 to 5 numbers",
                             "xyz"[role]);
            return false;
        }
    return true;
}

static bool add_unnamed(load_table *t, load_stream *s, load_text row)
{
    static const char *const names[] = {"x", "y", "z", "r", "q"};
    size_t count = table_count_fields(row, t->separator);
    if (count < 3 || count > 5) {
        stream_fail_line(
            s, "%zu columns without a header; expected 3 to 5 (x,y,z,r,q), or a header that names x, y and z",
            count);
        return false;
    }
    for (size_t i = 0; i < count; i++)
        if (!table_add_column(t, s, (load_text){names[i], names[i] + 1}, (load_role)i)) return false;
    return true;
}

/* Columns that the header's names leave open are labels where the first row has text. */
static void guess_roles(load_table *t, load_text row)
{
    load_text field;
    for (size_t i = 0; i < t->column_count && table_next_field(&row, t->separator, &field); i++)
        if (t->column[i].role == ROLE_NUMBER) t->column[i].role = table_guess_role(field);
}

static bool read_rows(load_table *t, load_stream *s)
{
    load_text line;
    if (!next_row(s, &line)) {
        stream_fail_line(s, "the file has no rows; expected particles");
        return false;
    }
    t->separator = find_separator(line);
    if (is_header(line, t->separator)) {
        if (!add_named(t, s, line)) return false;
        if (!next_row(s, &line)) {
            stream_fail_line(s, "no row follows the header; expected particles");
            return false;
        }
    } else if (!add_unnamed(t, s, line)) {
        return false;
    }
    guess_roles(t, line);
    uint64_t lines;
    return table_add_row(t, s, line) && rows_add(t, s, UINT64_MAX, is_passed_over, &lines);
}

static mns_status csv_read(load_stream *s, particles *p)
{
    load_table table = {0};
    if (read_rows(&table, s)) return table_finish(&table, s, p);
    table_free(&table);
    return s->status;
}

const load_format format_csv = {.name = "csv",
                                .endings = ".csv .tsv .txt .dat ",
                                .radius_source = "file",
                                .is_like = csv_is_like,
                                .read = csv_read};
