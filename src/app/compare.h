/* meniscus compare: its two forms. */
#ifndef MNS_APP_COMPARE_H
#define MNS_APP_COMPARE_H

#include "app/options.h"
#include "compare/pictures.h"
#include "compare/run.h"

#include <jansson.h>

/* Writes the folder of a comparison: results.csv, results.json, chart.dat, chart.gp, chart.svg where gnuplot
 * is to be had, and index.html; whole or not at all. */
mns_status compare_write(const json_t *document, const picture_list *pictures, const char *path,
                         mns_error *error);

/* A run in one line on standard output. */
void compare_print(const run_result *run);

/* Runs the hard cases of o->suite. Errors: as their parts, INPUT where an exact solver fails inside the
 * domain. */
mns_status compare_suite(const app_options *o, const char *command, mns_error *error);

/* Compares two saved images, the first being the truth. */
mns_status compare_images(const app_options *o, const char *command, mns_error *error);

#endif
