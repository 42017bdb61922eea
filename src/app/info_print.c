/* What an input holds, for people and for programs. */
#include "app/info.h"

#include <stdio.h>

/* ---- For people ---- */

/* Labels printed of a text column, at most. */
#define LABELS_SHOWN 12

static void print_box(const char *what, const double lo[3], const double hi[3])
{
    printf("%s: x %.9g to %.9g, y %.9g to %.9g, z %.9g to %.9g\n", what, lo[0], hi[0], lo[1], hi[1], lo[2],
           hi[2]);
}

static void print_numbers(const mns_field_info *info)
{
    print_box("box of the centres", info->lo, info->hi);
    print_box("box of the effective spheres", info->effective_lo, info->effective_hi);
    if (info->radius_is_uniform)
        printf("radii: %.9g (%s)\n", info->radius_median, info->radius_source);
    else
        printf("radii: %.9g to %.9g, median %.9g (%s)\n", info->radius_min, info->radius_max,
               info->radius_median, info->radius_source);
    if (info->has_strength)
        printf("strengths: %.9g to %.9g\n", info->strength_min, info->strength_max);
    else
        puts("strengths: 1 (none in the input)");
}

static void print_column(const mns_column_info *column)
{
    if (!column->is_label) {
        printf("  %s: %.9g to %.9g\n", column->name, column->min, column->max);
        return;
    }
    printf("  %s: %zu label%s:", column->name, column->label_count, column->label_count == 1 ? "" : "s");
    for (size_t i = 0; i < column->label_count && i < LABELS_SHOWN; i++) printf(" %s", column->labels[i]);
    puts(column->label_count > LABELS_SHOWN ? " ..." : "");
}

static void print_cell(const mns_field_info *info)
{
    if (!info->has_cell) return;
    const double *o = info->cell_origin;
    printf("cell: corner %.9g,%.9g,%.9g, edges", o[0], o[1], o[2]);
    for (int i = 0; i < 3; i++)
        printf(" %.9g,%.9g,%.9g", info->cell[i][0], info->cell[i][1], info->cell[i][2]);
    putchar('\n');
}

void info_print(const mns_field *field, size_t frame, size_t frames)
{
    mns_field_info info;
    mns_column_info column;
    mns_field_get_info(field, &info);
    printf("format: %s\nframes: %zu (this is %zu)\nparticles: %zu\n", info.format, frames, frame, info.count);
    if (info.count) print_numbers(&info);
    printf("kernel: %s\nlevel: %.9g\n", mns_kernel_name(info.kernel), info.iso);
    printf("columns: %zu\n", info.column_count);
    for (size_t i = 0; mns_field_get_column(field, i, &column); i++) print_column(&column);
    print_cell(&info);
    if (info.rows_skipped)
        printf("rows skipped: %zu (%s)\n", info.rows_skipped, info.rows_skipped_why);
    else
        puts("rows skipped: 0");
}

/* ---- For programs ---- */

static json_t *vector(const double v[3])
{
    return json_pack("[f, f, f]", v[0], v[1], v[2]);
}

/* Names come from files in any encoding; JSON takes UTF-8 alone. */
static json_t *text(const char *string)
{
    json_t *value = json_string(string);
    return value ? value : json_string("?");
}

static json_t *column_json(const mns_column_info *column)
{
    json_t *object = json_object();
    json_object_set_new(object, "name", text(column->name));
    if (!column->is_label) {
        json_object_set_new(object, "range", json_pack("[f, f]", column->min, column->max));
        return object;
    }
    json_t *labels = json_array();
    for (size_t i = 0; i < column->label_count; i++) json_array_append_new(labels, text(column->labels[i]));
    json_object_set_new(object, "labels", labels);
    return object;
}

static json_t *columns_json(const mns_field *field)
{
    mns_column_info column;
    json_t *list = json_array();
    for (size_t i = 0; mns_field_get_column(field, i, &column); i++)
        json_array_append_new(list, column_json(&column));
    return list;
}

static json_t *radii_json(const mns_field_info *info)
{
    return json_pack("{s:f, s:f, s:f, s:s}", "min", info->radius_min, "median", info->radius_median, "max",
                     info->radius_max, "source", info->radius_source);
}

static json_t *cell_json(const mns_field_info *info)
{
    if (!info->has_cell) return json_null();
    return json_pack("{s:o, s:[o, o, o]}", "corner", vector(info->cell_origin), "edges",
                     vector(info->cell[0]), vector(info->cell[1]), vector(info->cell[2]));
}

json_t *info_json(const mns_field *field, size_t frame, size_t frames)
{
    mns_field_info info;
    mns_field_get_info(field, &info);
    json_t *object = json_object();
    json_object_set_new(object, "format", json_string(info.format));
    json_object_set_new(object, "frames", json_integer((json_int_t)frames));
    json_object_set_new(object, "frame", json_integer((json_int_t)frame));
    json_object_set_new(object, "particles", json_integer((json_int_t)info.count));
    json_object_set_new(object, "box", json_pack("[o, o]", vector(info.lo), vector(info.hi)));
    json_object_set_new(object, "effective_box",
                        json_pack("[o, o]", vector(info.effective_lo), vector(info.effective_hi)));
    json_object_set_new(object, "radii", radii_json(&info));
    json_object_set_new(object, "strengths", json_pack("[f, f]", info.strength_min, info.strength_max));
    json_object_set_new(object, "kernel", json_string(mns_kernel_name(info.kernel)));
    json_object_set_new(object, "level", json_real(info.iso));
    json_object_set_new(object, "columns", columns_json(field));
    json_object_set_new(object, "cell", cell_json(&info));
    json_object_set_new(object, "rows_skipped", json_integer((json_int_t)info.rows_skipped));
    json_object_set_new(object, "rows_skipped_why", text(info.rows_skipped_why));
    return object;
}
