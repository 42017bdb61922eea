/* What a command that draws one scene holds: the field read, the view resolved, and a renderer. */
#ifndef MNS_APP_DRAWING_H
#define MNS_APP_DRAWING_H

#include "app/options.h"

typedef struct drawing {
    mns_input *input;
    mns_field *field;
    mns_view view; /* resolved to frame 0, as render does */
    mns_context *context;
    mns_renderer *renderer;
} drawing;

/* Reads the frame of the input that --frame names (default 0) and makes a context. End with drawing_close in
 * either case. */
mns_status drawing_open(const app_options *o, drawing *d, mns_error *error);
void drawing_close(drawing *d);

#endif
