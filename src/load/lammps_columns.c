#include "load/lammps.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

/* The four ways a dump writes positions, in the order they are preferred. */
static const struct {
    const char *name[3];
    bool is_scaled;
} positions[] = {{{"x", "y", "z"}, false},
                 {{"xu", "yu", "zu"}, false},
                 {{"xs", "ys", "zs"}, true},
                 {{"xsu", "ysu", "zsu"}, true}};

static size_t find_name(const load_table *t, const char *name)
{
    size_t i = 0;
    while (i < t->column_count && strcmp(t->column[i].name, name) != 0) i++;
    return i;
}

bool lammps_add_columns(load_table *t, load_stream *s, load_text names, lammps_columns *columns)
{
    load_text name;
    while (table_next_field(&names, ' ', &name))
        if (!table_add_column(t, s, name, ROLE_NUMBER)) return false;
    size_t count = t->column_count;
    *columns = (lammps_columns){.id = find_name(t, "id")};

    bool is_found = false;
    for (size_t way = 0; !is_found && way < sizeof positions / sizeof *positions; way++) {
        size_t at[3];
        for (int k = 0; k < 3; k++) at[k] = find_name(t, positions[way].name[k]);
        is_found = at[0] < count && at[1] < count && at[2] < count;
        for (int k = 0; is_found && k < 3; k++) t->column[at[k]].role = (load_role)k;
        columns->is_scaled = positions[way].is_scaled;
    }
    if (!is_found) {
        stream_fail_line(s,
                         "no positions among the columns; expected x y z, xu yu zu, xs ys zs or xsu ysu zsu");
        return false;
    }
    size_t radius = find_name(t, "radius"), diameter = find_name(t, "diameter");
    columns->is_diameter = radius == count && diameter < count;
    if (radius < count || diameter < count) t->column[radius < count ? radius : diameter].role = ROLE_RADIUS;
    return true;
}

void lammps_guess_roles(load_table *t, load_text row)
{
    load_text field;
    for (size_t i = 0; i < t->column_count && table_next_field(&row, ' ', &field); i++)
        if (t->column[i].role == ROLE_NUMBER) t->column[i].role = table_guess_role(field);
}

static void unscale(load_table *t, const lammps_box *box)
{
    double *axis[3];
    for (int k = 0; k < 3; k++) axis[k] = t->column[table_find(t, (load_role)k)].value;
    for (size_t i = 0; i < t->row_count; i++) {
        double scaled[3] = {axis[0][i], axis[1][i], axis[2][i]};
        for (int k = 0; k < 3; k++) {
            axis[k][i] = box->origin[k];
            for (int e = 0; e < 3; e++) axis[k][i] += scaled[e] * box->edge[e][k];
        }
    }
}

typedef struct keyed {
    double id;
    size_t row;
} keyed;

static int compare_keyed(const void *a, const void *b)
{
    const keyed *x = a, *y = b;
    if (x->id != y->id) return x->id < y->id ? -1 : 1;
    return (x->row > y->row) - (x->row < y->row); /* equal ids keep their order */
}

/* order[i]: the row that comes i-th by id. Ids that fill a range are placed by counting, others sorted. */
static bool order_rows(const double *id, size_t count, size_t *order)
{
    double low = id[0], high = id[0];
    bool is_whole = true;
    for (size_t i = 0; i < count; i++) {
        low = id[i] < low ? id[i] : low;
        high = id[i] > high ? id[i] : high;
        is_whole = is_whole && id[i] == floor(id[i]);
    }
    if (is_whole && high - low < 4.0 * (double)count && fabs(low) < 0x1p52) {
        size_t range = (size_t)(high - low) + 2;
        size_t *start = calloc(range, sizeof *start);
        if (!start) return false;
        for (size_t i = 0; i < count; i++) start[(size_t)(id[i] - low) + 1]++;
        for (size_t k = 1; k < range; k++) start[k] += start[k - 1];
        for (size_t i = 0; i < count; i++) order[start[(size_t)(id[i] - low)]++] = i;
        free(start);
        return true;
    }
    keyed *key = memory_array(count, sizeof *key);
    if (!key) return false;
    for (size_t i = 0; i < count; i++) key[i] = (keyed){id[i], i};
    qsort(key, count, sizeof *key, compare_keyed);
    for (size_t i = 0; i < count; i++) order[i] = key[i].row;
    free(key);
    return true;
}

static bool sort_rows(load_table *t, load_stream *s, size_t id_column)
{
    const double *id = t->column[id_column].value;
    size_t sorted = 1;
    while (sorted < t->row_count && id[sorted - 1] <= id[sorted]) sorted++;
    if (sorted >= t->row_count) return true;
    size_t *order = memory_array(t->row_count, sizeof *order);
    double *moved = memory_array(t->row_count, sizeof *moved);
    bool is_done = order && moved && order_rows(id, t->row_count, order);
    for (size_t c = 0; is_done && c < t->column_count; c++) {
        double *value = t->column[c].value;
#pragma omp parallel for
        for (size_t i = 0; i < t->row_count; i++) moved[i] = value[order[i]];
        t->column[c].value = moved; /* and the old array is where the next goes */
        moved = value;
    }
    free(order);
    free(moved);
    if (!is_done) stream_no_memory(s);
    return is_done;
}

bool lammps_settle(load_table *t, load_stream *s, const lammps_columns *columns, const lammps_box *box)
{
    if (columns->is_scaled) unscale(t, box);
    if (columns->is_diameter) {
        load_column *radius = &t->column[table_find(t, ROLE_RADIUS)];
        for (size_t i = 0; i < t->row_count; i++) radius->value[i] /= 2;
    }
    return columns->id == t->column_count || sort_rows(t, s, columns->id);
}
