/* The regression renders of tests/images: a table of scenes, each with its truth and how far a picture of it
 * may lie from that. Every function ends the running program, or test, when something fails. */
#ifndef MNS_TESTS_IMAGE_TABLE_H
#define MNS_TESTS_IMAGE_TABLE_H

#include "compare/images.h"

enum { IMAGE_METHODS = 8, IMAGE_PATH = 512 };

/* A row of "scenes" in tests/images/table.json; the tolerances that it does not give are those of "common".
 * Its strings live as long as the table. */
typedef struct image_row {
    const char *name;  /* of NAME.json, the scene, and NAME.exr, its truth */
    const char *shows; /* what it is there for */
    const char
        *features; /* names, as --explain prints them, that its plan must have, or, after a "!", must not */
    const char *method[IMAGE_METHODS];
    size_t method_count;
    int samples;
    images_tolerance tolerance;
    double psnr; /* the least, decibels: colours are not in the tolerance of images_judge */
    const char *why;
} image_row;

typedef struct image_table {
    image_row *row;
    size_t count;
    void *document;
} image_table;

/* Reads FOLDER/table.json. */
image_table image_table_load(const char *folder);
void image_table_free(image_table *table);
/* The row of that name, or NULL. */
const image_row *image_table_find(const image_table *table, const char *name);

/* A row's scene, ready to draw. */
typedef struct image_scene {
    mns_scene *scene;
    mns_field *field;
    mns_view view; /* resolved */
    mns_options options;
} image_scene;

image_scene image_scene_load(const char *folder, const image_row *row);
void image_scene_free(image_scene *s);

/* The image FOLDER/NAME.exr and, where not NULL, the truth that it is; free by mns_image_destroy and
 * truth_destroy. */
mns_image *image_truth_load(const char *folder, const image_row *row, truth_planes **truth);

enum { IMAGE_WHY = 256 };

/* Whether the image is the truth's by the row's tolerances, or by `tolerance` where that is not NULL. `why`
 * gets the first reason against it, or how far it is off. */
bool image_judge(const image_row *row, const images_tolerance *tolerance, const truth_planes *truth,
                 const mns_image *image, char why[IMAGE_WHY]);

/* "FOLDER/NAME.ending", in a buffer of the caller's. */
const char *image_path(char path[IMAGE_PATH], const char *folder, const char *name, const char *ending);

#endif
