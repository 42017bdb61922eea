#include "shade/ball_colors.h"

#include "shade/palette.h"

#include <string.h>

size_t ball_colors_words(const mns_plan *plan)
{
    return (size_t)(plan->features & FEATURE_COLORS ? 1 : 0) + (plan->features & FEATURE_MATERIALS ? 1 : 0);
}

ball_colors ball_colors_of(const mns_field *field, const mns_plan *plan)
{
    ball_colors colors = {.field = field, .plan = plan, .words = ball_colors_words(plan)};
    if (!(plan->features & FEATURE_COLORS)) return colors;
    colors.column = &field->p.column[plan->color_column];
    colors.labels = plan->features & FEATURE_LABELS;
    colors.elements = strcmp(colors.column->name, "element") == 0;
    colors.low = plan->color_range[0];
    colors.span = plan->color_range[1] - plan->color_range[0];
    return colors;
}

static uint32_t color_word(const ball_colors *colors, uint32_t index)
{
    double value = colors->column->value[index];
    if (colors->labels)
        return palette_label(colors->column->label[(size_t)value], (size_t)value, colors->elements);
    float part = colors->span != 0 ? (float)((value - colors->low) / colors->span) : 0.5f;
    uint32_t word;
    memcpy(&word, &part, sizeof word);
    return word;
}

void ball_colors_put(const ball_colors *colors, uint32_t index, uint32_t *word)
{
    if (colors->column) *word++ = color_word(colors, index);
    if (!(colors->plan->features & FEATURE_MATERIALS)) return;
    float place = (float)plan_blend_place(colors->plan, colors->field, index);
    memcpy(word, &place, sizeof place);
}
