/* The public face of a field: made from a host's arrays, and asked about. */
#include "base/memory.h"
#include "base/status.h"
#include "field/field.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Copies `width` numbers an element into the arrays; `what` names them in errors. */
static mns_status copy_values(const mns_values *from, size_t count, int width, double *const *to,
                              const char *what, mns_error *error)
{
    size_t size = from->is_float ? sizeof(float) : sizeof(double);
    size_t stride = from->stride ? from->stride : size * (size_t)width;
    if (stride < size * (size_t)width)
        return status_fail(error, MNS_ERROR_USAGE, "%s: a stride of %zu bytes; an element has %zu", what,
                           stride, size * (size_t)width);
    for (size_t i = 0; i < count; i++)
        for (int k = 0; k < width; k++) {
            const char *at = (const char *)from->data + i * stride + (size_t)k * size;
            float single;
            double value;
            if (from->is_float) {
                memcpy(&single, at, sizeof single); /* a host's stride need not keep alignment */
                value = single;
            } else {
                memcpy(&value, at, sizeof value);
            }
            if (!isfinite(value))
                return status_fail(error, MNS_ERROR_USAGE,
                                   "%s of particle %zu is %g; expected a finite number", what, i, value);
            to[k][i] = value;
        }
    return MNS_OK;
}

static mns_status copy_scalar(const mns_values *from, size_t count, double **to, const char *what,
                              mns_error *error)
{
    *to = memory_array(count, sizeof **to);
    if (!*to) return status_no_memory(error, "copying a host's particles");
    return copy_values(from, count, 1, to, what, error);
}

static mns_status copy_radii(const mns_field_desc *desc, particles *p, mns_error *error)
{
    if (!desc->radius.data) return MNS_OK;
    mns_status status = copy_scalar(&desc->radius, desc->count, &p->radius, "the radius", error);
    for (size_t i = 0; !status && i < desc->count; i++)
        if (!(p->radius[i] > 0))
            status = status_fail(error, MNS_ERROR_USAGE,
                                 "the radius of particle %zu is %g; expected one above 0", i, p->radius[i]);
    return status;
}

static mns_status copy_column(const mns_field_desc *desc, size_t index, particles *p, mns_error *error)
{
    const mns_column_desc *from = &desc->columns[index];
    if (!from->name || !*from->name || (!from->values.data && desc->count))
        return status_fail(error, MNS_ERROR_USAGE, "column %zu has no %s", index,
                           from->name && *from->name ? "values" : "name");
    for (size_t i = 0; i < p->column_count; i++)
        if (!strcmp(p->column[i].name, from->name))
            return status_fail(error, MNS_ERROR_USAGE,
                               "two columns are named '%.80s'; expected names that differ", from->name);
    particles_column *column = &p->column[p->column_count++]; /* from here on p owns what it holds */
    column->name = strdup(from->name);
    if (!column->name) return status_no_memory(error, "copying a host's columns");
    mns_status status = copy_scalar(&from->values, desc->count, &column->value, from->name, error);
    if (!status) particles_column_range(column, desc->count);
    return status;
}

static mns_status copy_columns(const mns_field_desc *desc, particles *p, mns_error *error)
{
    if (!desc->column_count) return MNS_OK;
    if (!desc->columns) return status_fail(error, MNS_ERROR_USAGE, "column_count is given without columns");
    p->column = desc->column_count <= SIZE_MAX / sizeof *p->column
                    ? calloc(desc->column_count, sizeof *p->column)
                    : NULL;
    if (!p->column) return status_no_memory(error, "copying a host's columns");
    mns_status status = MNS_OK;
    for (size_t i = 0; !status && i < desc->column_count; i++) status = copy_column(desc, i, p, error);
    return status;
}

static mns_status copy_particles(const mns_field_desc *desc, particles *p, mns_error *error)
{
    p->count = desc->count;
    p->format = "host";
    if (!desc->position.data && desc->count)
        return status_fail(error, MNS_ERROR_USAGE, "%zu particles without positions; expected position.data",
                           desc->count);
    if (!isfinite(desc->uniform_radius) || desc->uniform_radius < 0)
        return status_fail(error, MNS_ERROR_USAGE,
                           "uniform_radius is %g; expected one above 0, or 0 for the default",
                           desc->uniform_radius);
    for (int k = 0; k < 3; k++)
        if (!(p->axis[k] = memory_array(desc->count, sizeof(double))))
            return status_no_memory(error, "copying a host's particles");
    mns_status status = copy_values(&desc->position, desc->count, 3, p->axis, "the position", error);
    if (!status) status = copy_radii(desc, p, error);
    if (!status && desc->strength.data)
        status = copy_scalar(&desc->strength, desc->count, &p->strength, "the strength", error);
    if (!status) status = copy_columns(desc, p, error);
    return status;
}

mns_status mns_field_create(const mns_field_desc *desc, mns_field **field, mns_error *error)
{
    if (!desc || !field)
        return status_fail(error, MNS_ERROR_USAGE, "field: no description, or nowhere to put it");
    particles p = {0};
    mns_status status = copy_particles(desc, &p, error);
    if (status) goto fail;
    bool has_uniform = !p.radius && desc->uniform_radius > 0;
    mns_input_options options = {
        .kernel = desc->kernel, .iso = desc->iso, .radius = has_uniform ? desc->uniform_radius : 0};
    mns_field *made = NULL;
    status = field_from_particles(&p, &options, "host", &made, error);
    if (status) goto fail;
    if (has_uniform) made->radius_source = "host";
    *field = made;
    return MNS_OK;
fail:
    particles_free(&p);
    return status;
}

void mns_field_get_info(const mns_field *field, mns_field_info *info)
{
    const particles *p = &field->p;
    const double unit = field_unit(field);
    *info = (mns_field_info){
        .count = p->count,
        .radius_min = field->radius_min * unit,
        .radius_median = field->radius_median * unit,
        .radius_max = field->radius_max * unit,
        .strength_min = field->strength_min,
        .strength_max = field->strength_max,
        .radius_is_uniform = !p->radius,
        .has_strength = p->strength != NULL,
        .radius_source = field->radius_source,
        .kernel = field->kernel,
        .iso = field->iso,
        .format = p->format,
        .column_count = p->column_count,
        .rows_skipped = p->rows_skipped,
        .rows_skipped_why = p->rows_skipped_why,
        .has_cell = p->has_cell,
    };
    for (int k = 0; k < 3; k++) {
        info->lo[k] = field->lo[k] * unit, info->hi[k] = field->hi[k] * unit;
        info->effective_lo[k] = field->effective_lo[k] * unit;
        info->effective_hi[k] = field->effective_hi[k] * unit;
    }
    memcpy(info->cell_origin, p->cell_origin, sizeof info->cell_origin);
    memcpy(info->cell, p->cell, sizeof info->cell);
}

bool mns_field_get_column(const mns_field *field, size_t index, mns_column_info *info)
{
    if (index >= field->p.column_count) return false;
    const particles_column *column = &field->p.column[index];
    *info = (mns_column_info){
        .name = column->name,
        .is_label = column->label != NULL,
        .min = column->min,
        .max = column->max,
        .label_count = column->label_count,
        .labels = (const char *const *)column->label,
    };
    return true;
}

double mns_field_value(const mns_field *field, size_t index, size_t ball)
{
    if (index >= field->p.column_count || ball >= field->p.count) return NAN;
    return field->p.column[index].value[ball];
}
