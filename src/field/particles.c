#include "field/field.h"

#include <stdlib.h>
#include <string.h>

void particles_free(particles *p)
{
    for (int k = 0; k < 3; k++) free(p->axis[k]);
    free(p->radius);
    free(p->strength);
    for (size_t i = 0; i < p->column_count; i++) {
        particles_column *column = &p->column[i];
        for (size_t l = 0; l < column->label_count; l++) free(column->label[l]);
        free(column->label);
        free(column->value);
        free(column->name);
    }
    free(p->column);
    memset(p, 0, sizeof *p);
}

void particles_column_range(particles_column *column, size_t count)
{
    column->min = column->max = count ? column->value[0] : 0;
    for (size_t i = 1; i < count; i++) {
        if (column->value[i] < column->min) column->min = column->value[i];
        if (column->value[i] > column->max) column->max = column->value[i];
    }
}
