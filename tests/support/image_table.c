#include "support/image_table.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void end_if(bool failed, const char *what, const char *why)
{
    if (!failed) return;
    fprintf(stderr, "%s: %s\n", what, why);
    exit(1);
}

const char *image_path(char path[IMAGE_PATH], const char *folder, const char *name, const char *ending)
{
    int length = snprintf(path, IMAGE_PATH, "%s/%s.%s", folder, name, ending);
    end_if(length >= IMAGE_PATH, folder, "its name is too long");
    return path;
}

/* The tolerances that are given; the rest stay as they are. */
static bool read_tolerance(json_t *from, image_row *row, json_error_t *why)
{
    json_int_t mask = (json_int_t)row->tolerance.mask;
    if (json_unpack_ex(from, why, 0, "{s?F, s?F, s?I, s?F, s:s}", "t", &row->tolerance.t, "normal",
                       &row->tolerance.normal, "mask", &mask, "psnr", &row->psnr, "why", &row->why))
        return false;
    row->tolerance.mask = (size_t)mask;
    return true;
}

static image_row read_row(json_t *from, const image_row *common)
{
    image_row row = *common;
    json_t *methods;
    json_error_t why;
    bool good =
        read_tolerance(from, &row, &why) &&
        !json_unpack_ex(from, &why, 0, "{s:s, s:s, s:s, s:o, s?i}", "name", &row.name, "shows", &row.shows,
                        "features", &row.features, "methods", &methods, "samples", &row.samples);
    end_if(!good, "table.json", why.text);
    row.method_count = json_array_size(methods);
    end_if(row.method_count == 0 || row.method_count > IMAGE_METHODS, row.name, "its methods are a list");
    for (size_t i = 0; i < row.method_count; i++) {
        row.method[i] = json_string_value(json_array_get(methods, i));
        end_if(!row.method[i], row.name, "a method is a name");
    }
    return row;
}

image_table image_table_load(const char *folder)
{
    char path[IMAGE_PATH];
    json_error_t why;
    json_t *root = json_load_file(image_path(path, folder, "table", "json"), JSON_REJECT_DUPLICATES, &why);
    end_if(!root, path, why.text);
    json_t *scenes = json_object_get(root, "scenes");
    image_row common = {.samples = 1};
    end_if(!read_tolerance(json_object_get(root, "common"), &common, &why), path, why.text);
    image_table table = {.count = json_array_size(scenes), .document = root};
    end_if(!table.count, path, "expected a list of scenes");
    table.row = calloc(table.count, sizeof *table.row);
    end_if(!table.row, path, "out of memory");
    for (size_t i = 0; i < table.count; i++) table.row[i] = read_row(json_array_get(scenes, i), &common);
    return table;
}

void image_table_free(image_table *table)
{
    free(table->row);
    json_decref(table->document);
    *table = (image_table){0};
}

const image_row *image_table_find(const image_table *table, const char *name)
{
    for (size_t i = 0; i < table->count; i++)
        if (strcmp(table->row[i].name, name) == 0) return &table->row[i];
    return NULL;
}

image_scene image_scene_load(const char *folder, const image_row *row)
{
    char path[IMAGE_PATH];
    mns_error error = {0};
    mns_input *input = NULL;
    image_scene s = {.options = {.samples = row->samples}};
    mns_status status = mns_scene_load(image_path(path, folder, row->name, "json"), &s.scene, &error);
    if (!status)
        status = mns_input_open(s.scene->inputs, s.scene->input_count, &s.scene->field, &input, &error);
    if (!status) status = mns_input_read(input, 0, &s.field, &error);
    if (!status) status = mns_view_resolve(&s.scene->view, s.field, &s.view, &error);
    mns_input_close(input);
    end_if(status, row->name, error.text);
    return s;
}

void image_scene_free(image_scene *s)
{
    mns_field_destroy(s->field);
    mns_scene_destroy(s->scene);
    *s = (image_scene){0};
}

mns_image *image_truth_load(const char *folder, const image_row *row, truth_planes **truth)
{
    char path[IMAGE_PATH];
    mns_error error = {0};
    mns_image *image = NULL;
    mns_status status = mns_image_read(image_path(path, folder, row->name, "exr"), &image, &error);
    if (!status && truth) status = truth_from_image(image, truth, &error);
    end_if(status, row->name, error.text);
    return image;
}

bool image_judge(const image_row *row, const images_tolerance *tolerance, const truth_planes *truth,
                 const mns_image *image, char why[IMAGE_WHY])
{
    metrics m;
    mns_error error = {0};
    if (!tolerance) tolerance = &row->tolerance;
    end_if(metrics_measure(truth, image, NULL, 1, &m, &error), row->name, error.text);
    if (!images_judge(tolerance, images_mask_errors(truth, image, &m), &m, why, IMAGE_WHY)) return false;
    bool same = m.psnr >= row->psnr;
    if (same)
        snprintf(why, IMAGE_WHY, "t %.2g, normal %.2g degrees, colours %.4g decibels", m.t.max, m.normal.max,
                 m.psnr);
    else
        snprintf(why, IMAGE_WHY, "colours are %.4g decibels off (at least %.4g)", m.psnr, row->psnr);
    return same;
}
