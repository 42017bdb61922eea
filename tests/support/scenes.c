#include "support/scenes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

const double scene_row[] = {-1, 0, 0, 0, 0, 0, 1, 0, 0};
const double scene_equal[] = {1, 1, 1}, scene_sizes[] = {1, 1.5, 0.5}, scene_gains[] = {1, 2, 0.5};
const double scene_carving[] = {1, -0.5, 1}, scene_weak[] = {0.1, 0.2, 0.15};
static const double heat[] = {3, 5, 4};
const mns_column_desc scene_heat = {"heat", {.data = heat}};

const mns_limits scene_llvmpipe = {.max_storage_block = 1u << 27,
                                   .max_texture_size = 16384,
                                   .max_viewport = {16384, 16384},
                                   .max_texture_buffer = 1 << 27,
                                   .max_point_size = 255,
                                   .is_software = true,
                                   .has_clip_control = true};

mns_field *scene_field(const scene *s)
{
    mns_error error;
    mns_field *field = NULL;
    mns_input *input = NULL;
    mns_status status;
    if (s->generator) {
        status = mns_input_open(&s->generator, 1, NULL, &input, &error);
        if (!status) status = mns_input_read(input, 0, &field, &error);
    } else {
        status = mns_field_create(&s->desc, &field, &error);
    }
    mns_input_close(input);
    if (status) fail_msg("%s: %s", s->name, error.text);
    return field;
}

mns_plan *scene_plan(const scene *s, const mns_field *field)
{
    mns_error error;
    mns_plan *plan = NULL;
    mns_options options = s->options;
    if (options.method == MNS_METHOD_AUTO)
        options.method = MNS_METHOD_LIST; /* what is chosen: test_choose.c */
    if (plan_make(field, &s->view, &s->look, &options, s->limits, s->host, &plan, &error))
        fail_msg("%s: %s", s->name, error.text);
    return plan;
}
