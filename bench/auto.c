/* How often `--method auto` is near the best: bench_auto [NAME:COUNT]... Every scene is drawn by each method,
 * still and moving, in two sizes, the methods in turn. Processor time is what is judged by: on a software
 * renderer it is the frame's cost, and other work on the machine moves it less than the clock. */
#include "meniscus.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/resource.h>

enum { METHODS = 3, DRAWS_LEAST = 3, DRAWS_MOST = 9 };

#define WITHIN   1.1
#define SPEND_MS 1500.0 /* a method and case, about */

static const mns_method methods[METHODS] = {MNS_METHOD_LIST, MNS_METHOD_TILE, MNS_METHOD_FBVH};
static const char *const method_names[METHODS] = {"list", "tile", "fbvh"};
static const int sizes[][2] = {{640, 480}, {1024, 768}};

typedef struct tally {
    unsigned cases, near_used, near_clock;
    mns_renderer *renderer;
    mns_frame *frame;
} tally;

typedef struct cost {
    double used, clock; /* milliseconds: of the processors, on the clock */
} cost;

static double processor_ms(void)
{
    struct rusage used;
    getrusage(RUSAGE_SELF, &used);
    return (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) * 1e3 +
           (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec) * 1e-3;
}

static int compare_doubles(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(double *values, size_t count)
{
    qsort(values, count, sizeof *values, compare_doubles);
    return values[count / 2];
}

/* Medians over some draws, after one to warm up. */
static mns_status measure(tally *t, const mns_field *field, const mns_view *view, const mns_options *options,
                          cost *result, mns_error *error)
{
    double used[DRAWS_MOST], clock[DRAWS_MOST];
    size_t count = 0;
    mns_status status = mns_renderer_draw(t->renderer, field, view, NULL, options, t->frame, error);
    for (double spent = 0; !status && count < DRAWS_MOST && (count < DRAWS_LEAST || spent < SPEND_MS);) {
        double before = processor_ms();
        status = mns_renderer_draw(t->renderer, field, view, NULL, options, t->frame, error);
        used[count] = processor_ms() - before;
        clock[count] = mns_frame_stats(t->frame)->ms_total;
        spent += clock[count++];
    }
    if (!status) *result = (cost){median(used, count), median(clock, count)};
    return status;
}

static size_t find_method(mns_method method)
{
    size_t i = 0;
    while (i + 1 < METHODS && methods[i] != method) i++;
    return i;
}

static double over_best(const double value[METHODS], size_t chosen)
{
    double best = value[0];
    for (size_t i = 1; i < METHODS; i++) best = value[i] < best ? value[i] : best;
    return value[chosen] / best;
}

static mns_status try_case(tally *t, const char *scene, const mns_field *field, const int size[2], bool moved,
                           mns_error *error)
{
    const mns_view view = {.width = size[0], .height = size[1]};
    cost costs[METHODS];
    double used[METHODS], clock[METHODS];
    mns_plan *plan;
    mns_options options = {.moved = moved};
    mns_status status =
        mns_plan_create(field, &view, NULL, &options, mns_renderer_limits(t->renderer), &plan, error);
    if (status) return status;
    size_t chosen = find_method(mns_plan_method(plan, NULL));
    mns_plan_destroy(plan);
    for (size_t i = 0; i < METHODS && !status; i++) {
        options.method = methods[i];
        status = measure(t, field, &view, &options, &costs[i], error);
        used[i] = costs[i].used, clock[i] = costs[i].clock;
    }
    if (status) return status;
    double by_used = over_best(used, chosen), by_clock = over_best(clock, chosen);
    t->cases++;
    t->near_used += by_used <= WITHIN;
    t->near_clock += by_clock <= WITHIN;
    printf("| %s | %dx%d | %s |", scene, size[0], size[1], moved ? "moving" : "still");
    for (size_t i = 0; i < METHODS; i++) printf(" %.1f (%.1f) |", used[i], clock[i]);
    printf(" `%s` | %.2f (%.2f) |\n", method_names[chosen], by_used, by_clock);
    fflush(stdout);
    return MNS_OK;
}

static mns_status try_scene(tally *t, const char *scene, mns_error *error)
{
    mns_input *input;
    mns_field *field = NULL;
    mns_status status = mns_input_open(&scene, 1, NULL, &input, error);
    if (status) return status;
    status = mns_input_read(input, 0, &field, error);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes && !status; i++)
        for (int moved = 0; moved < 2 && !status; moved++)
            status = try_case(t, scene, field, sizes[i], moved, error);
    mns_field_destroy(field);
    mns_input_close(input);
    return status;
}

static mns_status try_all(tally *t, mns_error *error)
{
    static const char *const kinds[] = {"scattered", "dense", "mixed",   "sheet",
                                        "tornado",   "pool",  "molecule"};
    static const int counts[] = {1000, 10000, 100000, 1000000};
    mns_status status = MNS_OK;
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++)
        for (size_t k = 0; k < sizeof kinds / sizeof *kinds && !status; k++) {
            char scene[40];
            snprintf(scene, sizeof scene, "%s:%d", kinds[k], counts[c]);
            status = try_scene(t, scene, error);
        }
    return status;
}

int main(int argc, char **argv)
{
    tally t = {0};
    mns_context *context = NULL;
    mns_error error = {0};
    mns_status status = mns_context_create(MNS_BACKEND_AUTO, &context, &error);
    if (!status) status = mns_renderer_create(mns_context_get_proc(context), &t.renderer, &error);
    if (!status) status = mns_frame_create(t.renderer, &t.frame, &error);
    if (!status) {
        printf("%s; processor milliseconds a frame (on the clock), medians.\n\n",
               mns_renderer_name(t.renderer));
        printf("| scene | size | frames | `list` | `tile` | `fbvh` | `auto` takes | over the best |\n");
        printf("|-|-|-|-|-|-|-|-|\n");
        if (argc < 2) status = try_all(&t, &error);
        for (int i = 1; i < argc && !status; i++) status = try_scene(&t, argv[i], &error);
    }
    if (status)
        fprintf(stderr, "bench_auto: %s\n", error.text);
    else
        printf("\nWithin 10 %% of the best by processor time: %u of %u cases; by the clock: %u.\n",
               t.near_used, t.cases, t.near_clock);
    mns_frame_destroy(t.frame);
    mns_renderer_destroy(t.renderer);
    mns_context_destroy(context);
    return status != MNS_OK;
}
