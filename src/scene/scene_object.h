/* Objects of a scene file: a table an object, a row a key. */
#ifndef MNS_SCENE_SCENE_OBJECT_H
#define MNS_SCENE_SCENE_OBJECT_H

#include "scene/scene_values.h"

typedef struct scene_key {
    const char *name;
    scene_read *read;
    size_t target;     /* offset in what the object fills */
    size_t set_target; /* offset in it of the `set` member that tells it is given */
    unsigned set_bit;  /* 0: its value tells */
} scene_key;

/* Reads an object's members into `base` by the table; an unknown one is an error. `key` is its path in the
 * document. */
mns_status scene_read_object(scene_reader *r, const char *key, const json_t *value, const scene_key *keys,
                             size_t count, void *base);

#define SCENE_COUNT(array) (sizeof(array) / sizeof *(array))

/* scene_effects.c: "lights", "effects", "blend". */
scene_read scene_read_lights, scene_read_effects, scene_read_blend;
/* scene_meshes.c: "meshes". */
scene_read scene_read_meshes;

#endif
