/* Many rows at once: what the stream's buffer holds of whole lines is cut into pieces, many more than
 * cores, and each goes the way of a table of its own. Values, labels' numbers and messages are those of one
 * row after another. */
#ifndef MNS_LOAD_ROWS_H
#define MNS_LOAD_ROWS_H

#include "load/table.h"

/* Whether a line is no row: blank, or a comment. */
typedef bool rows_pass_over(load_text line);

/* Adds the rows in the next `most` lines, or in as many as there are; `pass_over` may be NULL. *taken: lines.
 * False: failed, recorded in the stream. */
bool rows_add(load_table *t, load_stream *s, uint64_t most, rows_pass_over *pass_over, uint64_t *taken);

#endif
