/* How far the drawn planes are from the brute-force oracle: a row of a table for each scene, back end and
 * solver.
 *
 * usage, from the repository's root: bench_accuracy [-n RAYS] [-k KERNEL] [-b BACKEND] [-s SOLVER]
 * [-v VIEW, 0 to 4] [SCENE...]
 */
#include "meniscus.h"
#include "support/brute_image.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

typedef struct bench_scene {
    const char *name, *input;
    mns_input_options options;
    double up[3];
} bench_scene;

static const bench_scene scenes[] = {
    {"scattered", "scattered:10000", {0}, {0, 1, 0}},
    {"dense", "dense:10000", {0}, {0, 1, 0}},
    {"mixed", "mixed:10000", {0}, {0, 1, 0}},
    {"molecule", "examples/1tii.pdb", {0}, {0, 1, 0}},
    {"dam", "examples/dam.06500.lammpstrj.gz", {MNS_KERNEL_POLY2, 0.35, 2.2, 0}, {0, 0, 1}},
};
enum { SCENES = sizeof scenes / sizeof *scenes };

static const struct {
    const char *name;
    mns_backend backend;
} backends[] = {{"egl", MNS_BACKEND_EGL}, {"osmesa", MNS_BACKEND_OSMESA}};
enum { BACKENDS = sizeof backends / sizeof *backends };

static const struct {
    const char *name;
    mns_solver solver;
} solvers[] = {
    {"exact", MNS_SOLVER_EXACT}, {"cubic", MNS_SOLVER_CUBIC}, {"cubic-monomial", MNS_SOLVER_CUBIC_MONOMIAL}};
enum { SOLVERS = sizeof solvers / sizeof *solvers };

/* The eye lies at look_at + distance * fit * direction, `fit` being where the whole field fits the frame:
 * three from outside, one close by, and one from within. */
static const struct {
    double direction[3], distance;
} views[] = {{{0, 0.2, 1}, 1},
             {{0.9, 0.35, -0.4}, 1},
             {{-0.6, -0.7, 0.5}, 1},
             {{0.3, 0.5, 0.8}, 0.45},
             {{0.2, 0.1, 0.3}, 0.02}};
enum { VIEWS = sizeof views / sizeof *views };

typedef struct bench {
    size_t rays;
    mns_kernel kernel;
    const char *backend, *solver; /* NULL: all */
    size_t first_view, end_view;
    bool failed;
} bench;

typedef struct stage { /* one scene, one context */
    const bench_scene *scene;
    const mns_field *field;
    const brute *oracle;
    mns_renderer *renderer;
    mns_frame *frame;
} stage;

static bool complain(bench *b, const char *what, const mns_error *error)
{
    fprintf(stderr, "%s: %s\n", what, error->text);
    b->failed = true;
    return false;
}

static bool place_view(const stage *s, size_t index, mns_view *view, mns_error *error)
{
    bool within = views[index].distance < 0.1; /* lists are long there: a smaller frame gives rays enough */
    mns_view fit = {.width = within ? 160 : 640, .height = within ? 120 : 480};
    memcpy(fit.up, s->scene->up, sizeof fit.up);
    if (s->scene->up[2] != 0) { /* looking along -z cannot be fitted with z up */
        fit.up[1] = 1;
        fit.up[2] = 0;
    }
    if (mns_view_resolve(&fit, s->field, &fit, error)) return false;
    double length = 0, away = 0;
    for (int a = 0; a < 3; a++) {
        length += views[index].direction[a] * views[index].direction[a];
        away += (fit.eye[a] - fit.look_at[a]) * (fit.eye[a] - fit.look_at[a]);
    }
    double step = views[index].distance * sqrt(away / length);
    for (int a = 0; a < 3; a++) fit.eye[a] = fit.look_at[a] + step * views[index].direction[a];
    memcpy(fit.up, s->scene->up, sizeof fit.up);
    return mns_view_resolve(&fit, s->field, view, error) == MNS_OK;
}

static bool measure_view(const bench *b, const stage *s, mns_solver solver, size_t index, brute_tally *tally,
                         mns_error *error)
{
    mns_view view;
    mns_image *image = NULL;
    mns_options options = {.method = MNS_METHOD_LIST, .solver = solver, .moved = true};
    bool done = place_view(s, index, &view, error) &&
                mns_renderer_draw(s->renderer, s->field, &view, NULL, &options, s->frame, error) == MNS_OK &&
                mns_frame_read(s->frame, &image, error) == MNS_OK;
    if (done) {
        done = brute_tally_add(tally, s->oracle, &view, image, b->rays / (b->end_view - b->first_view),
                               0x1p-40, 1000 + index);
        if (!done) snprintf(error->text, sizeof error->text, "out of memory comparing");
    }
    mns_image_destroy(image);
    return done;
}

static void print_row(const char *scene, const char *backend, const char *solver, const brute_report *r)
{
    printf("| %s | %s | %s | %zu | %zu | %zu | %zu | %zu | %zu | %zu | %.1e | %.1e | %.1e | %.1e | %.4f |\n",
           scene, backend, solver, r->rays, r->hits, r->missed, r->invented, r->later, r->undecided, r->near,
           r->t_median, r->t_p99, r->t_p999, r->t_max, r->normal_p999);
    fflush(stdout);
}

static void measure_solvers(bench *b, const stage *s, const char *backend)
{
    for (size_t i = 0; i < SOLVERS; i++) {
        if (b->solver && strcmp(b->solver, solvers[i].name) != 0) continue;
        mns_error error = {0};
        brute_tally *tally = brute_tally_create();
        bool done = tally;
        for (size_t v = b->first_view; done && v < b->end_view; v++)
            done = measure_view(b, s, solvers[i].solver, v, tally, &error) ||
                   complain(b, s->scene->name, &error);
        if (done) {
            brute_report report = brute_tally_report(tally);
            print_row(s->scene->name, backend, solvers[i].name, &report);
        }
        brute_tally_destroy(tally);
    }
}

static void measure_backend(bench *b, stage *s, size_t index)
{
    mns_error error = {0};
    mns_context *context = NULL;
    s->renderer = NULL, s->frame = NULL;
    if (mns_context_create(backends[index].backend, &context, &error) ||
        mns_renderer_create(mns_context_get_proc(context), &s->renderer, &error) ||
        mns_frame_create(s->renderer, &s->frame, &error))
        complain(b, backends[index].name, &error);
    else
        measure_solvers(b, s, backends[index].name);
    mns_frame_destroy(s->frame);
    mns_renderer_destroy(s->renderer);
    mns_context_destroy(context);
}

static void measure_scene(bench *b, const bench_scene *scene)
{
    mns_error error = {0};
    mns_input *input = NULL;
    mns_field *field = NULL;
    brute *oracle = NULL;
    mns_input_options options = scene->options;
    if (b->kernel) options.kernel = b->kernel;
    if (mns_input_open(&scene->input, 1, &options, &input, &error) ||
        mns_input_read(input, 0, &field, &error)) {
        complain(b, scene->name, &error);
        goto done;
    }
    oracle = brute_create(field);
    if (!oracle) {
        snprintf(error.text, sizeof error.text, "out of memory");
        complain(b, scene->name, &error);
        goto done;
    }
    stage s = {.scene = scene, .field = field, .oracle = oracle};
    for (size_t i = 0; i < BACKENDS; i++)
        if (!b->backend || strcmp(b->backend, backends[i].name) == 0) measure_backend(b, &s, i);
done:
    brute_destroy(oracle);
    mns_field_destroy(field);
    mns_input_close(input);
}

static bool wanted(const bench_scene *scene, char **names, int count)
{
    for (int i = 0; i < count; i++)
        if (strcmp(names[i], scene->name) == 0) return true;
    return count == 0;
}

int main(int argc, char **argv)
{
    bench b = {.rays = 20000, .end_view = VIEWS};
    for (int option; (option = getopt(argc, argv, "n:k:b:s:v:")) != -1;) {
        if (option == 'n')
            b.rays = strtoul(optarg, NULL, 10);
        else if (option == 'k')
            b.kernel = mns_kernel_by_name(optarg);
        else if (option == 'b')
            b.backend = optarg;
        else if (option == 's')
            b.solver = optarg;
        else if (option == 'v') {
            b.first_view = strtoul(optarg, NULL, 10) % VIEWS;
            b.end_view = b.first_view + 1;
        } else
            return 2;
    }
    if (b.kernel == MNS_KERNEL_COUNT || b.rays < VIEWS) {
        fprintf(stderr, "bench_accuracy: expected a kernel's name after -k, and at least %d rays after -n\n",
                VIEWS);
        return 2;
    }
    puts("| scene | back end | solver | rays | hits | missed | invented | later root | undecided | too near "
         "to call "
         "| t median | p99 | p99.9 | max | normal p99.9, degrees |\n"
         "|-|-|-|-|-|-|-|-|-|-|-|-|-|-|-|");
    for (size_t i = 0; i < SCENES; i++)
        if (wanted(&scenes[i], argv + optind, argc - optind)) measure_scene(&b, &scenes[i]);
    return b.failed;
}
