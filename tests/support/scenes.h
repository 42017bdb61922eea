/* Scenes to plan: a field, a view, a look, options and a driver's limits, and what the plan of them shall be.
 */
#ifndef MNS_TESTS_SCENES_H
#define MNS_TESTS_SCENES_H

#include "plan/plan.h"

typedef struct scene {
    const char *name;
    const char *generator; /* or NULL: desc */
    mns_field_desc desc;
    mns_view view;
    mns_look look;
    mns_options options;
    const mns_limits *limits;
    bool host;
    uint64_t features;
    const char *passes;
    const char *left_out; /* "part: reason" of one, or NULL */
} scene;

/* Three balls in a row, and numbers for them. */
extern const double scene_row[9], scene_equal[3], scene_sizes[3], scene_gains[3], scene_carving[3],
    scene_weak[3];
extern const mns_column_desc scene_heat; /* 3, 5, 4 */
extern const mns_limits scene_llvmpipe;

/* Initialisers of a scene's desc: the row, radii still to say; and the row of radius 1. */
#define SCENE_ROW  .count = 3, .position = {.data = scene_row}, .columns = &scene_heat, .column_count = 1
#define SCENE_UNIT SCENE_ROW, .uniform_radius = 1
/* Of a scene: an eye that looks along -z. */
#define SCENE_EYE(x, y, z)                                                                                   \
    .view = {.set = MNS_VIEW_EYE | MNS_VIEW_LOOK_AT, .eye = {x, y, z}, .look_at = {x, y, (z)-1.0}}

/* The scene's field and plan, for the caller to destroy; what fails ends the running test. */
mns_field *scene_field(const scene *s);
mns_plan *scene_plan(const scene *s, const mns_field *field);

#endif
