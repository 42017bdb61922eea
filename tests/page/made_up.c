#include "page/made_up.h"

#include <math.h>
#include <png.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

const char MADE_UP_HOSTILE[] =
    "</script><script>alert(1)</script><!-- \"quoted\" 'and' & \\ \xc3\xa9\xe7\x90\x83 {{page.js}}";

typedef struct made_up_run {
    const char *name, *method, *solver, *key, *value; /* key "": no settings */
    double ms, error;                                 /* error < 0: refused */
    int missed, invented;
} made_up_run;

static const made_up_run RUNS[MADE_UP_RUNS] = {
    {"list:exact", "list", "exact", "", "", 41.5, 0, 0, 0},
    {"list:cubic", "list", "cubic", "", "", 30.25, 2.5e-3, 7, 3},
    {"list:cubic-monomial", "list", "cubic-monomial", "", "", 29.75, 8e-2, 1207, 18},
    {"fbvh:projection:steps=4", "fbvh", "projection", "steps", "4", 22.125, 3.75e-4, 12, 5},
    {"fbvh:projection:steps=16", "fbvh", "projection", "steps", "16", 63.5, 4.5e-6, 2, 0},
    {MADE_UP_HOSTILE, "kanamori", "clipping", "k", "</script>&\"14\"", 120.75, 1.25e-5, 40, 61},
    {"list:none", "list", "none", "", "", 0, -1, 0, 0},
};

static json_t *spread(double p99)
{
    return json_pack("{s:f, s:f, s:f, s:f, s:f}", "median", p99 / 16, "p99", p99, "p999", p99 * 3, "max",
                     p99 * 32, "rms", p99 / 2);
}

static json_t *worst_of(const made_up_run *run)
{
    json_t *worst = json_array();
    for (int i = 0; i < 5; i++) {
        bool missed = i < 2 && run->missed;
        json_array_append_new(worst,
                              json_pack("{s:i, s:i, s:s, s:o, s:f, s:o}", "x", 31 + 17 * i, "y", 90 - 11 * i,
                                        "kind", missed ? "missed" : "depth", "t",
                                        missed ? json_null() : json_real(2.5 + run->error * i), "truth", 2.5,
                                        "error", missed ? json_null() : json_real(run->error * i / 2.5)));
    }
    return worst;
}

static json_t *run_json(const made_up_run *run)
{
    json_t *settings = run->key[0] ? json_pack("{s:s}", run->key, run->value) : json_object();
    if (run->error < 0)
        return json_pack("{s:s, s:s, s:s, s:o, s:i, s:s, s:n, s:n, s:b, s:[]}", "name", run->name, "method",
                         run->method, "solver", run->solver, "settings", settings, "frames", 0, "failed",
                         "plan: no such solver", "ms", "errors", "pareto", 0, "worst");
    json_t *phases =
        json_pack("{s:f, s:f, s:f, s:f}", "sort", run->ms * 0.0625, "gather", run->ms * 0.3125, "cast",
                  run->ms * 0.5, "build", strcmp(run->method, "fbvh") ? 0.0 : run->ms * 0.125);
    json_t *ms = json_pack("{s:f, s:f, s:f, s:o}", "median", run->ms, "min", run->ms * 0.96875, "max",
                           run->ms * 1.125, "phases", phases);
    json_t *errors =
        json_pack("{s:i, s:i, s:i, s:i, s:i, s:i, s:i, s:i, s:i, s:o, s:o, s:o, s:o, s:f}", "pixels",
                  MADE_UP_WIDTH * MADE_UP_HEIGHT, "hits", 9000, "missed", run->missed, "invented",
                  run->invented, "missed_decided", run->missed * 3 / 4, "invented_decided", run->invented / 2,
                  "wrong_root", run->missed / 3, "undecided", 2, "compared", 8990, "t", spread(run->error),
                  "footprint", spread(run->error * 300), "residual", spread(run->error * 2), "normal",
                  spread(run->error * 50), "psnr", run->error > 0 ? 64.0 : 200.0);
    return json_pack("{s:s, s:s, s:s, s:o, s:i, s:n, s:o, s:o, s:b, s:o}", "name", run->name, "method",
                     run->method, "solver", run->solver, "settings", settings, "frames", 9, "failed", "ms",
                     ms, "errors", errors, "pareto", run->missed < 10, "worst", worst_of(run));
}

static json_t *suite_run(const char *name, const char *verdict, int missed, const char *note)
{
    return json_pack("{s:s, s:s, s:i, s:i, s:i, s:i, s:f, s:f, s:s}", "name", name, "verdict", verdict,
                     "missed", missed, "invented", missed / 2, "undecided", missed ? 0 : 1, "pixels", 3072,
                     "ms", 4.5, "t_p999", 2e-7, "note", note);
}

static json_t *suite_json(void)
{
    static const char *const cases[][3] = {
        {"radii/1e3", "radii over three decades in one scene", ""},
        {"far/1e9", "the field lies 1e9 units from the origin: a float has no digit left", ""},
        {"eye/1e6", "the eye is 1e6 radii away", "eye"},
        {"crowd/coincident", "10,000 balls share one centre & <one> pixel", "active"},
    };
    json_t *list = json_array();
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        bool inside = !cases[i][2][0];
        json_t *limits = inside ? json_array() : json_pack("[s]", cases[i][2]);
        json_t *runs = json_array();
        json_array_append_new(runs, suite_run("list:exact", "holds", 0, ""));
        json_array_append_new(runs, suite_run("list:cubic", i % 2 ? "fails" : "holds", i % 2 ? 12 : 0, ""));
        json_array_append_new(runs, i == 2
                                        ? suite_run(MADE_UP_HOSTILE, "refused", 0, "a list passes the pool")
                                        : suite_run(MADE_UP_HOSTILE, inside ? "fails" : "outside", 40, ""));
        json_array_append_new(list, json_pack("{s:s, s:s, s:b, s:o, s:o}", "name", cases[i][0], "why",
                                              cases[i][1], "inside", inside, "limits", limits, "runs", runs));
    }
    return json_pack("{s:s, s:o}", "name", "stiff", "cases", list);
}

json_t *made_up_results(void)
{
    json_t *runs = json_array();
    for (int i = 0; i < MADE_UP_RUNS; i++) json_array_append_new(runs, run_json(RUNS + i));
    return json_pack(
        "{s:i, s:s, s:s, s:{s:s, s:i, s:I, s:s}, s:s, s:s, s:s, s:s, s:{s:s, s:i, s:s, s:f, s:s}, "
        "s:{s:[f,f,f], s:[f,f,f], s:[f,f,f], s:f, s:i, s:i}, s:{s:f, s:i, s:i, s:b}, s:o, s:o}",
        "schema", 1, "command", MADE_UP_HOSTILE, "created", "2026-01-31T12:00:00Z", "machine", "cpu",
        "A made-up CPU", "cores", 2, "memory_bytes", (json_int_t)24 << 30, "system", "Linux", "renderer",
        "llvmpipe", "backend", "egl surfaceless", "version", "meniscus 0.1.0", "commit", "0123456789ab",
        "input", "name", MADE_UP_HOSTILE, "count", 10000, "kernel", "poly3", "iso", 0.2, "hash",
        "00112233445566778899aabbccddeeff", "view", "eye", 0.5, 0.5, 3.0, "look_at", 0.5, 0.5, 0.5, "up", 0.0,
        1.0, 0.0, "fov", 45.0, "width", MADE_UP_WIDTH, "height", MADE_UP_HEIGHT, "truth", "ms", 4210.5,
        "hits", 9001, "undecided", 3, "cached", 0, "runs", runs, "suite", suite_json());
}

/* ---- pictures: a ball, shifted a little from run to run */

typedef void painter(double x, double y, int run,
                     unsigned char rgb[3]); /* x, y from the ball's centre, in its radii */

static void paint_image(double x, double y, int run, unsigned char rgb[3])
{
    double z = 1 - x * x - y * y, light = z > 0 ? 0.2 + 0.8 * sqrt(z) : 1;
    rgb[0] = (unsigned char)((z > 0 ? 90 + 10 * run : 255) * light);
    rgb[1] = (unsigned char)((z > 0 ? 160 : 255) * light);
    rgb[2] = (unsigned char)((z > 0 ? 220 - 10 * run : 255) * light);
}

static void paint_depth(double x, double y, int run, unsigned char rgb[3])
{
    double wave = x * x + y * y < 1 ? sin(9 * x + run) * cos(7 * y) : 0;
    rgb[0] = (unsigned char)(wave < 0 ? 255 + 180 * wave : 255);
    rgb[1] = (unsigned char)(255 - 180 * fabs(wave));
    rgb[2] = (unsigned char)(wave > 0 ? 255 - 180 * wave : 255);
}

static void paint_mask(double x, double y, int run, unsigned char rgb[3])
{
    double edge = x * x + y * y + 0.02 * run * sin(20 * x);
    rgb[0] = edge > 1.03 ? 250 : edge > 1 ? 200 : 120;
    rgb[1] = edge > 1.03 ? 250 : edge > 1 ? 40 : 125;
    rgb[2] = edge > 1.03 ? 250 : edge > 1 ? 60 : 135;
}

static bool add_picture(picture_list *list, const char *run, const char *kind, painter *paint, int index)
{
    unsigned char pixel[MADE_UP_HEIGHT][MADE_UP_WIDTH][3];
    for (int row = 0; row < MADE_UP_HEIGHT; row++)
        for (int column = 0; column < MADE_UP_WIDTH; column++)
            paint((column - 80 - index) / 50.0, (row - 60) / 50.0, index, pixel[row][column]);
    png_image png = {.version = PNG_IMAGE_VERSION,
                     .width = MADE_UP_WIDTH,
                     .height = MADE_UP_HEIGHT,
                     .format = PNG_FORMAT_RGB};
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
    unsigned char *memory = malloc(size);
    if (!memory || !png_image_write_to_memory(&png, memory, &size, 0, pixel, 0, NULL)) {
        free(memory);
        return false;
    }
    list->picture[list->count++] = (page_picture){run, kind, memory, size};
    return true;
}

bool made_up_pictures(const json_t *results, picture_list *list)
{
    list->capacity = 3 * MADE_UP_RUNS + 1, list->count = 0;
    list->picture = calloc(list->capacity, sizeof *list->picture);
    bool good = list->picture && add_picture(list, "truth", "image", paint_image, 0);
    const json_t *run;
    size_t i;
    json_array_foreach(json_object_get(results, "runs"), i, run)
    {
        const char *name = json_string_value(json_object_get(run, "name"));
        if (!json_is_null(json_object_get(run, "failed"))) continue;
        good = good && add_picture(list, name, "image", paint_image, (int)i) &&
               add_picture(list, name, "depth", paint_depth, (int)i) &&
               add_picture(list, name, "mask", paint_mask, (int)i);
    }
    return good;
}

void made_up_free(picture_list *list)
{
    for (size_t i = 0; i < list->count; i++) free((void *)list->picture[i].png);
    free(list->picture);
    *list = (picture_list){0};
}
