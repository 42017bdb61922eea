#include "load/cell.h"

#include "load/number.h"
#include "load/table.h"

#include <math.h>
#include <string.h>

bool cell_numbers(load_text text, size_t count, double *value)
{
    load_text field;
    for (size_t i = 0; i < count; i++)
        if (!table_next_field(&text, ' ', &field) || !number_whole(field, &value[i])) return false;
    return !table_next_field(&text, ' ', &field);
}

void cell_set(particles *p, const double origin[3], const double edges[3][3])
{
    for (int i = 0; i < 3; i++) {
        double length = fabs(edges[i][0]) + fabs(edges[i][1]) + fabs(edges[i][2]);
        if (!(length > 0) || !isfinite(length) || !isfinite(origin[i])) return;
    }
    p->has_cell = true;
    memcpy(p->cell_origin, origin, sizeof p->cell_origin);
    memcpy(p->cell, edges, sizeof p->cell);
}
