/* Inside the VTK reader: values of a section, in either encoding. */
#ifndef MNS_LOAD_VTK_H
#define MNS_LOAD_VTK_H

#include "load/table.h"

typedef enum vtk_type {
    VTK_NONE = 0,
    VTK_BIT,
    VTK_I8,
    VTK_U8,
    VTK_I16,
    VTK_U16,
    VTK_I32,
    VTK_U32,
    VTK_I64,
    VTK_U64,
    VTK_F32,
    VTK_F64,
} vtk_type;

/* VTK_NONE for a name that is no type of numbers. */
vtk_type vtk_type_by_name(load_text name);

/* One array as it is read: components side by side; memory grows with the values that are there. */
typedef struct vtk_values {
    double *value; /* count of them; NULL where they were only passed over */
    size_t count;
} vtk_values;

/* Reads `count` values, or passes over them where `values` is NULL. Binary: big-endian. `what` is for
 * messages. */
bool vtk_read_values(load_stream *s, bool is_binary, vtk_type type, uint64_t count, const char *what,
                     vtk_values *values);

#endif
