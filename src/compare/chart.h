/* The static chart of a comparison: error against run time, by gnuplot. */
#ifndef MNS_COMPARE_CHART_H
#define MNS_COMPARE_CHART_H

#include "meniscus.h"

#include <jansson.h>

enum { CHART_NOTE_SIZE = 160 };

/* Errors of 0 have no place on a logarithmic axis: they are drawn here. */
#define CHART_ERROR_LEAST 1e-10

/* Writes chart.dat and chart.gp (which makes chart.svg again by "gnuplot chart.gp" in the folder) for the
 * document's "runs", and has gnuplot make chart.svg. Where gnuplot cannot be had, or there is nothing to
 * draw, there is no chart.svg, and `note` says why; else it is "". Errors: IO, MEMORY. */
mns_status chart_write(const json_t *document, const char *folder, char note[CHART_NOTE_SIZE],
                       mns_error *error);

#endif
