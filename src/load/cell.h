/* Simulation boxes. */
#ifndef MNS_LOAD_CELL_H
#define MNS_LOAD_CELL_H

#include "field/field.h"
#include "load/stream.h"

/* `count` numbers separated by blanks, and nothing behind them. */
bool cell_numbers(load_text text, size_t count, double *value);

/* Sets the cell unless an edge is zero or not finite. */
void cell_set(particles *p, const double origin[3], const double edges[3][3]);

#endif
