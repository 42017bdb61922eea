/* A run: one method with one solver and its settings, drawn, timed and measured. */
#ifndef MNS_COMPARE_RUN_H
#define MNS_COMPARE_RUN_H

#include "compare/metrics.h"

enum { RUN_NAME_SIZE = 96, RUN_KNOWN_SIZE = 400, RUN_SETTINGS = 8, RUN_FRAMES_LEAST = 5 };

typedef struct run_setting {
    const char *key; /* a literal */
    char value[24];
} run_setting;

typedef struct run_spec {
    char name[RUN_NAME_SIZE];    /* "list:exact:gather=paper": it is the run's whole description */
    const char *method, *solver; /* literals */
    mns_options options;
    run_setting setting[RUN_SETTINGS];
    size_t setting_count;
} run_spec;

/* Takes METHOD:SOLVER[:KEY=VALUE]...[,...] apart; NULL: the default runs, every method and solver of this
 * build but for the reference, which is the truth, and, of what iterates, a range of its caps. `*runs` is for
 * free. Errors: USAGE (an unknown method, solver or key, a value out of range, a run twice), MEMORY. */
mns_status run_parse(const char *text, run_spec **runs, size_t *count, mns_error *error);
/* What may stand in --runs, "list:exact, ...; keys: gather, ...": for messages and help. */
void run_known(char text[RUN_KNOWN_SIZE]);

typedef struct run_times {
    int frames;              /* that the figures are of */
    double median, min, max; /* milliseconds of a frame, in which every position counts as changed */
    bool has_phases;
    double phase[MNS_PHASE_COUNT]; /* medians of frames of their own, whose phases glFinish closed */
} run_times;

/* What came of one run. */
typedef struct run_result {
    run_spec spec;
    mns_status status; /* not OK: it could not be drawn, `error` says why, and the rest is zeros */
    mns_error error;
    run_times ms;
    metrics errors;
    mns_stats stats; /* of the last frame; its texts are gone */
    bool pareto;     /* no other run is both faster and at least as near to the truth (run_mark_front) */
} run_result;

/* What all runs of a scene share. */
typedef struct run_scene {
    mns_renderer *renderer;
    const mns_field *field;
    const mns_view *view;           /* resolved */
    const mns_look *look;           /* NULL: defaults */
    const mns_reference *reference; /* for the residual; NULL: none is measured */
    const truth_planes *truth;
    int frames; /* 1: one frame, cold, with no times of phases; more: two frames first to warm up */
} run_scene;

/* Draws and measures. A refusal by the renderer is no error of this function: it is result->status. `image`,
 * where not NULL, gets the planes of the last frame, to be given to mns_image_destroy; NULL where it was
 * refused. Errors: MEMORY, GL. */
mns_status run_measure(const run_scene *scene, const run_spec *spec, run_result *result, mns_image **image,
                       mns_error *error);
/* Marks the Pareto front of the median time and the 99th percentile of the error of t; a run without either
 * is not on it. */
void run_mark_front(run_result *result, size_t count);

#endif
