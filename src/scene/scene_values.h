/* Values of a scene file: each function reads one kind of them, checked, into `target`. */
#ifndef MNS_SCENE_SCENE_VALUES_H
#define MNS_SCENE_SCENE_VALUES_H

#include "scene/scene.h"

/* Bytes of a key's path in the document, "material.color_by". */
#define SCENE_PATH_SIZE 128

typedef struct scene_reader {
    const char *path; /* of the file, for errors */
    scene_file *file;
    mns_error *error;
} scene_reader;

/* Reads a value into `target`, a member of the scene; `key` is its path in the document. */
typedef mns_status scene_read(scene_reader *r, const char *key, const json_t *value, void *target);

/* The value is not what the key wants: says what it is, and what was expected. */
mns_status scene_wrong(scene_reader *r, const char *key, const json_t *value, const char *expected);

/* Copies a string that is not empty into *text, which the caller frees. */
mns_status scene_read_text(scene_reader *r, const char *key, const json_t *value, char **text);

/* A whole number. */
mns_status scene_read_whole(scene_reader *r, const char *key, const json_t *value, int least, int most,
                            int *to);

scene_read scene_read_frame, scene_read_samples; /* int */
scene_read scene_read_method;                    /* mns_method */
scene_read scene_read_solver;                    /* mns_solver */
scene_read scene_read_positive;                  /* double: above 0 */
scene_read scene_read_weight;                    /* double: 0 or more */
scene_read scene_read_angle;                     /* double: between 0 and 180 */
scene_read scene_read_point;                     /* double[3] */
scene_read scene_read_direction;                 /* double[3]: not all 0 */
scene_read scene_read_range;                     /* double[2]: the lower first */
scene_read scene_read_color;                     /* double[3] */
scene_read scene_read_background;                /* double[4] */
scene_read scene_read_bands;                     /* int */
scene_read scene_read_size;                      /* the view's width and height */
scene_read scene_read_kernel;                    /* mns_kernel */
scene_read scene_read_color_map;                 /* mns_color_map */
scene_read scene_read_light_kind;                /* mns_light_kind */
scene_read scene_read_shading;                   /* mns_shading */
scene_read scene_read_color_by;                  /* the file's own text */

#endif
