/* Inside the LAMMPS reader: columns, and what is done to them once all rows are there. */
#ifndef MNS_LOAD_LAMMPS_H
#define MNS_LOAD_LAMMPS_H

#include "load/table.h"

typedef struct lammps_box {
    bool is_known;
    double origin[3], edge[3][3];
} lammps_box;

typedef struct lammps_columns {
    bool is_scaled;   /* positions in units of the box */
    bool is_diameter; /* the radius column holds diameters */
    size_t id;        /* a column, or column_count */
} lammps_columns;

/* Columns by the names behind "ITEM: ATOMS". */
bool lammps_add_columns(load_table *t, load_stream *s, load_text names, lammps_columns *columns);
/* Columns whose first value is text become labels. */
void lammps_guess_roles(load_table *t, load_text row);
/* Positions out of the box's units, radii out of diameters, rows by id. */
bool lammps_settle(load_table *t, load_stream *s, const lammps_columns *columns, const lammps_box *box);

#endif
