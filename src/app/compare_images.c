/* meniscus compare A.exr B.exr. */
#include "app/app.h"
#include "app/compare.h"
#include "compare/images.h"
#include "compare/results.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The name of a run is short: the file's own, without its folders, and its end where that is too long. */
static void name_run(const char *path, run_spec *spec)
{
    const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path;
    size_t length = strlen(name), most = sizeof spec->name - 1;
    snprintf(spec->name, sizeof spec->name, "%s", length > most ? name + length - most : name);
    spec->method = "saved";
    spec->solver = "image";
}

/* The folder, where it is asked for. */
static mns_status write_folder(const app_options *o, const char *command, const truth_planes *truth,
                               const mns_image *image, const run_result *run, mns_error *error)
{
    json_t *document = NULL;
    picture_list list = {0};
    results_about about = {.command = command, .truth = truth};
    mns_status status = pictures_add(&list, "truth", truth, NULL, error);
    if (!status) status = pictures_add(&list, run->spec.name, truth, image, error);
    if (!status) status = results_document(&about, run, 1, &document, error);
    if (!status) status = compare_write(document, &list, o->output, error);
    json_decref(document);
    pictures_free(&list);
    return status;
}

static mns_status judge(const app_options *o, const char *command, const truth_planes *truth,
                        const mns_image *image, mns_error *error)
{
    char why[200];
    run_result run = {.ms = {.median = NAN, .min = NAN, .max = NAN}};
    name_run(o->inputs[1], &run.spec);
    mns_status status = metrics_measure(truth, image, NULL, 1, &run.errors, error);
    if (status) return status;
    compare_print(&run);
    if (o->output) status = write_folder(o, command, truth, image, &run, error);
    if (status) return status;
    size_t mask = images_mask_errors(truth, image, &run.errors);
    if (images_judge(&o->tolerance, mask, &run.errors, why, sizeof why)) return MNS_OK;
    return app_fail(error, MNS_ERROR_INPUT, "%.140s: %s", o->inputs[1], why);
}

mns_status compare_images(const app_options *o, const char *command, mns_error *error)
{
    mns_image *image[2] = {NULL, NULL};
    truth_planes *truth = NULL;
    mns_status status = mns_image_read(o->inputs[0], &image[0], error);
    if (!status) status = mns_image_read(o->inputs[1], &image[1], error);
    if (!status && (image[0]->width != image[1]->width || image[0]->height != image[1]->height))
        status = app_fail(error, MNS_ERROR_INPUT, "%.180s is %dx%d, %.180s is %dx%d: expected the same size",
                          o->inputs[0], image[0]->width, image[0]->height, o->inputs[1], image[1]->width,
                          image[1]->height);
    if (!status) status = truth_from_image(image[0], &truth, error);
    if (!status) status = judge(o, command, truth, image[1], error);
    truth_destroy(truth);
    mns_image_destroy(image[0]);
    mns_image_destroy(image[1]);
    return status;
}
