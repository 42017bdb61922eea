#include "load/table.h"

#include "base/memory.h"
#include "base/status.h"
#include "load/number.h"

#include <math.h>
#include <string.h>
#include <strings.h>

bool table_add_column(load_table *t, load_stream *s, load_text name, load_role role)
{
    if (t->column_count == TABLE_COLUMNS) {
        stream_fail(s, MNS_ERROR_UNSUPPORTED, "more than %d columns; drop some", TABLE_COLUMNS);
        return false;
    }
    load_column *column = memory_resize(t->column, t->column_count + 1, sizeof *column);
    if (!column) {
        stream_no_memory(s);
        return false;
    }
    t->column = column;
    column += t->column_count;
    *column = (load_column){.name = strndup(name.at, (size_t)(name.end - name.at)), .role = role};
    if (!column->name) {
        stream_no_memory(s);
        return false;
    }
    t->column_count++;
    return true;
}

bool table_reserve(load_table *t, load_stream *s, size_t more)
{
    if (more <= t->capacity - t->row_count) return true;
    size_t capacity = t->capacity ? t->capacity * 2 : 256;
    if (capacity < t->row_count + more) capacity = t->row_count + more;
    for (size_t i = 0; i < t->column_count; i++) {
        double *value = memory_resize(t->column[i].value, capacity, sizeof *value);
        if (!value) {
            stream_no_memory(s);
            return false;
        }
        t->column[i].value = value;
    }
    t->capacity = capacity;
    return true;
}

/* ---- Fields ---- */

static bool is_blank(char c, char separator)
{
    return c == ' ' || (c == '\t' && separator != '\t') || c == '\r';
}

static const char *skip_blanks(const char *at, const char *end, char separator)
{
    while (at < end && is_blank(*at, separator)) at++;
    return at;
}

/* A quoted field: what stands between the quotes. */
static bool quoted_field(load_text *rest, char separator, load_text *field)
{
    const char *at = rest->at + 1, *end = rest->end;
    field->at = at;
    while (at < end && (*at != '"' || (at + 1 < end && at[1] == '"'))) at += *at == '"' ? 2 : 1;
    field->end = at;
    if (at < end) at++;
    at = skip_blanks(at, end, separator);
    if (at < end && separator != ' ' && *at != separator) return false;
    rest->at = at < end && separator != ' ' ? at + 1 : at;
    if (at == end) rest->at = NULL;
    return true;
}

bool table_next_field(load_text *rest, char separator, load_text *field)
{
    if (!rest->at) return false;
    rest->at = skip_blanks(rest->at, rest->end, separator);
    if (rest->at == rest->end && separator == ' ') return false;
    load_text whole = *rest;
    if (rest->at < rest->end && *rest->at == '"' && quoted_field(rest, separator, field)) return true;
    *rest = whole;
    const char *end = rest->at;
    if (separator == ' ')
        while (end < rest->end && !is_blank(*end, ' ')) end++;
    else
        while (end < rest->end && *end != separator) end++;
    *field = (load_text){rest->at, end};
    rest->at = separator == ' '  ? end
               : end < rest->end ? end + 1
                                 : NULL; /* NULL: no separator, so no field follows */
    while (separator != ' ' && field->end > field->at && is_blank(field->end[-1], separator)) field->end--;
    return true;
}

size_t table_count_fields(load_text line, char separator)
{
    size_t count = 0;
    load_text field;
    while (table_next_field(&line, separator, &field)) count++;
    return count;
}

load_role table_guess_role(load_text field)
{
    double value;
    const char *at = field.at;
    bool is_number = number_scan(&at, field.end, &value) && at == field.end;
    return is_number || number_is_special(field) ? ROLE_NUMBER : ROLE_LABEL;
}

/* ---- Rows ---- */

static bool fail_number(load_stream *s, const load_column *column, load_text field)
{
    if (number_is_special(field))
        stream_fail_line(s, "%.60s is '%.*s'; expected a finite number", column->name, SHOWN(field));
    else
        stream_fail_line(s, "%.60s is '%.*s'; expected a number", column->name, SHOWN(field));
    return false;
}

bool table_put(load_table *t, load_stream *s, size_t index, double value, load_text shown)
{
    load_column *column = &t->column[index];
    if (!isfinite(value)) {
        stream_fail_line(s, "%.60s is '%.*s'; expected a finite number", column->name, SHOWN(shown));
        return false;
    }
    if (column->role == ROLE_RADIUS && !(value > 0)) {
        stream_fail_line(s, "%.60s is %g; expected one above 0", column->name, value);
        return false;
    }
    column->value[t->row_count] = value;
    return true;
}

static bool put_text(load_table *t, load_stream *s, size_t index, load_text field)
{
    load_column *column = &t->column[index];
    double value;
    size_t number;
    switch (column->role) {
    case ROLE_LABEL:
        if (!labels_number(&column->labels, field, &number)) {
            stream_no_memory(s);
            return false;
        }
        column->value[t->row_count] = (double)number;
        return true;
    case ROLE_LOGICAL:
        if (field.at < field.end && strchr("TtFf01", *field.at))
            return table_put(t, s, index, strchr("Tt1", *field.at) != NULL, field);
        stream_fail_line(s, "%.60s is '%.*s'; expected T or F", column->name, SHOWN(field));
        return false;
    default: {
        const char *at = field.at;
        if (!number_scan(&at, field.end, &value) || at != field.end) return fail_number(s, column, field);
        return table_put(t, s, index, value, field);
    }
    }
}

/* The plain case in place: a number that ends at a separator. False leaves *at for the careful way. */
static bool fast_number(const char **at, const char *end, char separator, double *value)
{
    const char *c = *at;
    while (c < end && is_blank(*c, separator)) c++;
    if (!number_scan(&c, end, value)) return false;
    if (separator == ' ') {
        if (c < end && !is_blank(*c, ' ')) return false;
    } else {
        if (c == end || *c != separator) return false;
        c++;
    }
    *at = c;
    return true;
}

static bool fail_count(const load_table *t, load_stream *s, load_text line)
{
    stream_fail_line(s, "%zu columns; expected %zu", table_count_fields(line, t->separator), t->column_count);
    return false;
}

bool table_add_row(load_table *t, load_stream *s, load_text line)
{
    if (!table_reserve(t, s, 1)) return false;
    load_text rest = line, field;
    for (size_t i = 0; i < t->column_count; i++) {
        load_role role = t->column[i].role;
        const char *at = rest.at;
        double value;
        bool is_plain = at && role <= ROLE_NUMBER && fast_number(&at, rest.end, t->separator, &value) &&
                        isfinite(value) && (role != ROLE_RADIUS || value > 0);
        if (is_plain) {
            t->column[i].value[t->row_count] = value;
            rest.at = at;
            continue;
        }
        if (!table_next_field(&rest, t->separator, &field)) return fail_count(t, s, line);
        if (!put_text(t, s, i, field)) return false;
    }
    if (table_next_field(&rest, t->separator, &field)) return fail_count(t, s, line);
    t->row_count++;
    return true;
}

/* ---- The end ---- */

load_text text_of(const char *word)
{
    return (load_text){word, word + strlen(word)};
}

bool text_is(load_text text, const char *word)
{
    size_t length = strlen(word);
    return (size_t)(text.end - text.at) == length && !strncasecmp(text.at, word, length);
}

bool text_begins(load_text text, const char *word)
{
    size_t length = strlen(word);
    return (size_t)(text.end - text.at) >= length && !memcmp(text.at, word, length);
}

load_role table_free_role(const load_table *t, load_role role)
{
    return table_find(t, role) < t->column_count ? ROLE_NUMBER : role;
}

size_t table_find(const load_table *t, load_role role)
{
    size_t i = 0;
    while (i < t->column_count && t->column[i].role != role) i++;
    return i;
}

static void hand_over(load_column *from, particles_column *to, size_t count)
{
    *to = (particles_column){.name = from->name, .value = from->value};
    from->name = NULL, from->value = NULL;
    if (from->role == ROLE_LABEL) {
        to->label = from->labels.word;
        to->label_count = from->labels.count;
        from->labels.word = NULL, from->labels.count = 0;
    }
    particles_column_range(to, count);
}

mns_status table_finish(load_table *t, load_stream *s, particles *p)
{
    if (!t->row_count && !table_reserve(t, s, 1)) goto done; /* so that empty columns are arrays too */
    p->column = calloc(t->column_count + 1, sizeof *p->column);
    if (!p->column) {
        stream_no_memory(s);
        goto done;
    }
    p->count = t->row_count;
    for (size_t i = 0; i < t->column_count; i++) {
        load_column *column = &t->column[i];
        double *fitted = memory_resize(column->value, t->row_count, sizeof *fitted);
        if (fitted) column->value = fitted;
        double **to = column->role <= ROLE_Z          ? &p->axis[column->role]
                      : column->role == ROLE_RADIUS   ? &p->radius
                      : column->role == ROLE_STRENGTH ? &p->strength
                                                      : NULL;
        if (to)
            *to = column->value, column->value = NULL;
        else
            hand_over(column, &p->column[p->column_count++], p->count);
    }
done:
    table_free(t);
    return s->status;
}

void table_free(load_table *t)
{
    for (size_t i = 0; i < t->column_count; i++) {
        free(t->column[i].name);
        free(t->column[i].value);
        labels_free(&t->column[i].labels);
    }
    free(t->column);
    memset(t, 0, sizeof *t);
}
