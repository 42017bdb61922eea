/* The files of a comparison: results.json and results.csv. Both are faces that others script against.
 *
 * results.json:
 *   {"schema": 1, "command": "meniscus compare ...", "created": "2026-01-31T12:00:00Z",
 *    "machine": {"cpu", "cores", "memory_bytes", "system"},
 *    "renderer": GL_RENDERER and GL_VERSION, "backend": "egl surfaceless", "version": mns_version(),
 * "commit", "input": {"name", "count", "kernel", "iso", "hash"}, "view": {"eye": [x,y,z], "look_at": [x,y,z],
 * "up": [x,y,z], "fov", "width", "height"}, "truth": {"ms", "hits", "undecided", "cached"}, "runs": [{"name",
 * "method", "solver", "settings": {KEY: "VALUE"}, "frames", "failed": null or the reason; where there is one,
 * ms and errors are null and worst is empty, "ms": {"median", "min", "max", "phases": {"sort": ms, ...}},
 * phases {} where not measured "errors": {"pixels", "hits", "missed", "invented", "missed_decided",
 * "invented_decided", "wrong_root", "undecided", "compared", "effects_compared", "effects_undecided",
 * "shadow_wrong", "occlusion_wrong", "mirror_wrong", "refraction_wrong" (null where the look has no such
 * effect), "t", "footprint", "residual", "normal":
 * {"median", "p99", "p999", "max", "rms"}, "psnr"}, "pareto": bool, "worst": [{"x", "y", "kind", "t",
 * "truth", "error"}]}], "suite": null or {"name", "cases": [...]}}
 *
 * A figure that does not exist (an error over no pixels, the t of a miss) is null. "input", "view" and
 * "truth" are null where there is no one scene: of a suite; "input", "view" and "machine" are of saved images
 * too. docs/errors.md says what each figure means. */
#ifndef MNS_COMPARE_RESULTS_H
#define MNS_COMPARE_RESULTS_H

#include "compare/run.h"

#include <jansson.h>

/* What the results are of; what is NULL becomes null. */
typedef struct results_about {
    const char *command;
    const char *renderer, *backend;
    const char *input; /* its name */
    const mns_field *field;
    const mns_view *view; /* resolved */
    const truth_planes *truth;
} results_about;

/* The whole document, "suite" null: a new reference. Errors: MEMORY. */
mns_status results_document(const results_about *about, const run_result *runs, size_t count,
                            json_t **document, mns_error *error);
/* One element of "runs", for suites too: a new reference, NULL where memory ends. */
json_t *results_run(const run_result *run);

/* Write new files. The CSV has a header and a row for each of "runs", and for each of the "runs" of each of
 * the suite's cases, whose name stands in its first column, "case" (empty outside a suite). Errors: IO. */
mns_status results_write_csv(const json_t *document, const char *path, mns_error *error);
mns_status results_write_json(const json_t *document, const char *path, mns_error *error);

#endif
