#include "list/pack.h"

#include "field/kernel.h"
#include "shade/palette.h"

#include <string.h>

/* A double as the float nearest to it, forced through memory: one compiler kept the wider value in a
 * register. */
static float rounded(double value)
{
    volatile float f = (float)value;
    return f;
}

static const list_ball *ball_at(const list_order *order, list_chosen chosen, size_t i)
{
    return list_ball_at(order, chosen.place ? chosen.place[i] : i);
}

void list_pack_high(const list_order *order, list_chosen chosen, const mns_field *field, const mns_plan *plan,
                    float *out)
{
    size_t stride = plan->ball_floats;
    bool radii = plan->features & FEATURE_RADII, strengths = plan->features & FEATURE_STRENGTHS;
#pragma omp parallel for if (chosen.count > ORDER_ALONE)
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
#pragma omp parallel for if (chosen.count > ORDER_ALONE)
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
    const particles_column *column = &field->p.column[plan->color_column];
    bool elements = strcmp(column->name, "element") == 0;
    double low = plan->color_range[0], span = plan->color_range[1] - low;
#pragma omp parallel for if (chosen.count > ORDER_ALONE)
    for (size_t i = 0; i < chosen.count; i++) {
        double value = column->value[ball_at(order, chosen, i)->index];
        if (!(plan->features & FEATURE_LABELS))
            ((float *)out)[i] = span != 0 ? (float)((value - low) / span) : 0.5f;
        else
            ((uint32_t *)out)[i] = palette_label(column->label[(size_t)value], (size_t)value, elements);
    }
}
