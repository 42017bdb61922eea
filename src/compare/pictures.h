/* Pictures of a run as PNG files in memory: what was drawn, how far its depth is off, and where it hits. */
#ifndef MNS_COMPARE_PICTURES_H
#define MNS_COMPARE_PICTURES_H

#include "compare/truth.h"

/* One picture of a run; run and kind are borrowed, png is the list's. */
typedef struct page_picture {
    const char *run;  /* the run's name, or "truth" */
    const char *kind; /* "image", "depth" (signed difference), "mask" (hit mask) */
    const unsigned char *png;
    size_t size;
} page_picture;

typedef struct picture_list {
    page_picture *picture;
    size_t count, capacity;
} picture_list;

/* The ends of the signed depth difference's colours, in pixel footprints (without a view: in 1e-3 t*): blue
 * where the image is nearer than the truth, red where it is farther; grey where there is nothing to compare.
 * The scale is that of asinh, linear within a hundredth of the range: small differences show too. */
#define PICTURES_DEPTH_RANGE 10.0
/* Colours of the hit mask, "#rrggbb", by metrics_mask. */
extern const char *const PICTURES_MASK_COLOR[];

/* Adds the three pictures of a run (of the truth itself, image NULL: its image alone, where it has colours).
 * `run` must outlive the list. Errors: MEMORY. */
mns_status pictures_add(picture_list *list, const char *run, const truth_planes *truth,
                        const mns_image *image, mns_error *error);
void pictures_free(picture_list *list);

#endif
