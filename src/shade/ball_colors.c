#include "shade/ball_colors.h"

#include "shade/palette.h"

#include <string.h>

ball_colors ball_colors_of(const mns_field *field, const mns_plan *plan)
{
    const particles_column *column = &field->p.column[plan->color_column];
    return (ball_colors){.column = column,
                         .labels = plan->features & FEATURE_LABELS,
                         .elements = strcmp(column->name, "element") == 0,
                         .low = plan->color_range[0],
                         .span = plan->color_range[1] - plan->color_range[0]};
}

uint32_t ball_colors_word(const ball_colors *colors, uint32_t index)
{
    double value = colors->column->value[index];
    if (colors->labels)
        return palette_label(colors->column->label[(size_t)value], (size_t)value, colors->elements);
    float part = colors->span != 0 ? (float)((value - colors->low) / colors->span) : 0.5f;
    uint32_t word;
    memcpy(&word, &part, sizeof word);
    return word;
}
