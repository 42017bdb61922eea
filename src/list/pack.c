#include "list/pack.h"

#include "base/rounded.h"
#include "field/kernel.h"
#include "shade/ball_colors.h"

#include <string.h>

static const list_ball *ball_at(const list_order *order, list_chosen chosen, size_t i)
{
    return list_ball_at(order, chosen.place ? chosen.place[i] : i);
}

void list_pack_high(const list_order *order, list_chosen chosen, const mns_field *field, const mns_plan *plan,
                    float *out)
{
    size_t stride = plan->ball_floats;
    bool radii = plan->features & FEATURE_RADII, strengths = plan->features & FEATURE_STRENGTHS;
#pragma omp parallel for if (order->in_view > ORDER_ALONE)
    for (size_t i = 0; i < chosen.count; i++) {
        const list_ball *ball = ball_at(order, chosen, i);
        float *to = out + i * stride;
        to[stride - 1] = 0; /* without radii and strengths a record may have room to spare */
        memcpy(to, ball->position, sizeof ball->position);
        if (radii) to[3] = (float)field->p.radius[ball->index];
        if (strengths) to[stride - 1] = (float)field->p.strength[ball->index];
    }
}

void list_pack_quads(const list_order *order, const mns_plan *plan, float *out)
{
    size_t stride = plan->ball_floats;
    for (size_t i = 0; i < order->quads; i++)
        memcpy(out + (order->count + i) * stride, out + (order->quads - 1 - i) * stride,
               stride * sizeof *out);
}

void list_pack_low(const list_order *order, list_chosen chosen, const mns_field *field, const mns_plan *plan,
                   float *out)
{
    size_t stride = plan->ball_floats;
#pragma omp parallel for if (order->in_view > ORDER_ALONE)
    for (size_t i = 0; i < chosen.count; i++) {
        const list_ball *ball = ball_at(order, chosen, i);
        float *to = out + i * stride;
        for (int axis = 0; axis < 3; axis++) {
            double exact = field->p.axis[axis][ball->index] - plan->origin[axis];
            to[axis] = (float)(exact - (double)ball->position[axis]);
        }
        if (plan->features & FEATURE_RADII) {
            double exact = field->p.radius[ball->index];
            to[3] = (float)(exact - (double)rounded(exact));
        }
        if (plan->features & FEATURE_STRENGTHS) {
            double exact = field->p.strength[ball->index];
            to[stride - 1] = (float)(exact - (double)rounded(exact));
        }
    }
}

void list_pack_cores(const list_order *order, const mns_field *field, float *out)
{
#pragma omp parallel for if (order->count > ORDER_ALONE)
    for (size_t place = 0; place < order->count; place++) {
        uint32_t index = list_ball_at(order, place)->index;
        double q = field_strength(field, index);
        double ratio = q > field->iso ? kernel_core_radius(field->kernel, field->iso / q) : 0;
        out[place] = (float)(field_radius(field, index) * ratio);
    }
}

void list_pack_colors(const list_order *order, list_chosen chosen, const mns_field *field,
                      const mns_plan *plan, void *out)
{
    ball_colors colors = ball_colors_of(field, plan);
#pragma omp parallel for if (order->in_view > ORDER_ALONE)
    for (size_t i = 0; i < chosen.count; i++)
        ball_colors_put(&colors, ball_at(order, chosen, i)->index, (uint32_t *)out + i * colors.words);
}
