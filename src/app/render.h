/* meniscus render. */
#ifndef MNS_APP_RENDER_H
#define MNS_APP_RENDER_H

#include "app/options.h"

extern const option_table RENDER_OPTIONS;

/* Notes what the user should know of an input: radii that were guessed, rows that were skipped. */
void render_note_field(const char *name, const mns_field *field);

/* The value range of a look that colours by a column and leaves it open: that of the input's frame 0. */
void render_fix_look(const mns_field *first, mns_look *look);

/* Prints the plan of one frame, with the limits of a context where one starts. */
mns_status render_explain(const app_options *o, const mns_field *field, const mns_view *view,
                          const mns_look *look, mns_error *error);

#endif
