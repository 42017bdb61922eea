/* Colours of labels and colour maps. */
#ifndef MNS_SHADE_PALETTE_H
#define MNS_SHADE_PALETTE_H

#include "meniscus.h"

enum { PALETTE_ANCHORS = 10 };

/* rgba8 (red in the low byte), sRGB: of a chemical element by its symbol when `element`, else the index-th of
 * a cycle of well-separated colours (also for an unknown symbol). */
uint32_t palette_label(const char *label, size_t index, bool element);

/* The map's colours at 0, 1/9, ... 1 as 0xrrggbb, sRGB; straight lines between them. */
const uint32_t *palette_map(mns_color_map map);

#endif
