/* Rows of text into columns. A reader names the columns and their roles once, then adds lines; memory grows
 * with the rows that are there, never with what a header announces. */
#ifndef MNS_LOAD_TABLE_H
#define MNS_LOAD_TABLE_H

#include "field/field.h"
#include "load/labels.h"
#include "load/stream.h"

typedef enum load_role {
    ROLE_X = 0,
    ROLE_Y,
    ROLE_Z,
    ROLE_RADIUS, /* must be above 0 */
    ROLE_STRENGTH,
    ROLE_NUMBER,  /* kept as a column */
    ROLE_LABEL,   /* text, kept as a column */
    ROLE_LOGICAL, /* T or F, kept as 1 or 0 */
} load_role;

typedef struct load_column {
    char *name;
    load_role role;
    double *value;
    load_labels labels; /* of ROLE_LABEL */
} load_column;

enum { TABLE_COLUMNS = 1024 };

typedef struct load_table {
    load_column *column;
    size_t column_count;
    size_t row_count, capacity;
    char separator; /* between fields; ' ': any white space */
} load_table;

/* Adds a column; the name is copied. False: failed, recorded in the stream. */
bool table_add_column(load_table *t, load_stream *s, load_text name, load_role role);
/* Adds the row in a line. */
bool table_add_row(load_table *t, load_stream *s, load_text line);
/* Room for so many more rows: value[row_count] of each column and on may then be set, and row_count raised.
 */
bool table_reserve(load_table *t, load_stream *s, size_t more);
/* Checks and puts one number into the next row; `shown` is what messages quote. */
bool table_put(load_table *t, load_stream *s, size_t column, double value, load_text shown);

/* The next field of a line and moves past it and its separator; false where there is none left. */
bool table_next_field(load_text *rest, char separator, load_text *field);
size_t table_count_fields(load_text line, char separator);

/* What a first row's field makes of a column that nothing else tells about: ROLE_NUMBER or ROLE_LABEL. */
load_role table_guess_role(load_text field);
/* The role, or ROLE_NUMBER where a column has it already. */
load_role table_free_role(const load_table *t, load_role role);

load_text text_of(const char *word);
bool text_is(load_text text, const char *word);     /* whatever the case */
bool text_begins(load_text text, const char *word); /* as written */

/* The first column of that role, or column_count. */
size_t table_find(const load_table *t, load_role role);
/* Hands the columns over to *p by their roles and empties the table. Positions must be there. */
mns_status table_finish(load_table *t, load_stream *s, particles *p);
void table_free(load_table *t); /* frees the members, zeroes *t */

#endif
