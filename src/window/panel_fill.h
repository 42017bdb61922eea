/* What the panel shows of a window. */
#ifndef MNS_WINDOW_PANEL_FILL_H
#define MNS_WINDOW_PANEL_FILL_H

#include "window/viewer.h"

/* Shows the panel, which is open. */
void panel_fill(viewer *v);

#endif
