/* meniscus verify. */
#include "app/app.h"
#include "app/drawing.h"
#include "compare/probe.h"

#include <math.h>
#include <stdio.h>

enum { RAYS = 1000 };

static mns_status option_rays(app_options *o, const char *name, const char *text, mns_error *error)
{
    return parse_whole(name, text, 1, UINT32_MAX, &o->rays, error);
}

static mns_status option_seed(app_options *o, const char *name, const char *text, mns_error *error)
{
    return parse_whole(name, text, 0, UINT32_MAX, &o->seed, error);
}

static const option_row ROWS[] = {
    {NULL, 0, NULL, "What to check:", NULL},
    {"rays", 0, "N", "pixels, drawn at random without replacement (default 1000; all, where there are fewer)",
     option_rays},
    {"seed", 0, "S", "another seed, another choice of pixels (default 0)", option_seed},
    {"size", 0, "WxH", "pixels of the frame (default 1024x768)", option_size},
    {"frame", 0, "A", "the frame of the input, from 0 (default 0)", option_frame},
    OPTIONS_OF_FIELD,
    OPTIONS_OF_CAMERA,
    {NULL, 0, NULL, "Method that is checked:", NULL},
    {"method", 0, "NAME", "as for render", option_method},
    {"solver", 0, "NAME",
     "exact (the default), cubic, cubic-monomial or secant: models of the field fail, as they should",
     option_solver},
    {"gather", 0, "NAME", "early-z (the default) or paper", option_gather},
    {"backend", 0, "NAME", "auto (the default: the first that starts), egl, osmesa or glfw", option_backend},
    {"threads", 0, "N", "threads on the CPU (default: one a core)", option_threads},
    {"no-cache", 0, NULL, "as for render", option_no_cache},
};

static const option_table VERIFY_OPTIONS = {
    .command = "verify",
    .arguments = "INPUT...",
    .doc =
        "Draws INPUT, takes random pixels and solves each again with the certified tracer, in doubles on the "
        "CPU. Exit status 1 where a pixel disagrees that is not undecided: a hit missed or invented, or "
        "|t - t*| beyond the truth's own bound and 2e-6 max(t*, R) / slope; slope is the least of 1 and "
        "|df/dt| R / L at the hit, R the radius of its strongest ball, and the whole is at most what is a "
        "wrong root, 0.1 R + 2^-20 t*. docs/errors.md gives the reasons. Effects are not looked at: compare "
        "does.",
    .rows = ROWS,
    .count = sizeof ROWS / sizeof *ROWS,
};

/* "0.4471936" or "none" */
static const char *distance(double t, char text[32])
{
    snprintf(text, 32, isfinite(t) ? "%.9g" : "none", t);
    return text;
}

static void print_report(const probe_report *r)
{
    char t[32], truth[32];
    printf(
        "%zu pixels, %zu hits: %zu agree, %zu undecided, %zu disagree (%zu missed, %zu invented, %zu off)\n",
        r->rays, r->hits, r->agreed, r->undecided, r->missed + r->invented + r->off, r->missed, r->invented,
        r->off);
    if (!r->has_worst) return;
    const metrics_pixel *w = &r->worst;
    printf("worst: pixel %d,%d: t %s, truth %s", w->x, w->y, distance(w->t, t), distance(w->truth, truth));
    if (isnan(w->error))
        printf(", %s\n", metrics_kind_name(w->kind));
    else
        printf(", |t - t*|/t* %.3g\n", w->error);
}

static mns_status check(const app_options *o, drawing *d, probe_report *report, mns_error *error)
{
    mns_frame *frame = NULL;
    mns_image *image = NULL;
    mns_status status = mns_frame_create(d->renderer, &frame, error);
    if (!status)
        status = mns_renderer_draw(d->renderer, d->field, &d->view, &o->look, &o->draw, frame, error);
    if (!status) status = mns_frame_read(frame, &image, error);
    if (!status) {
        const mns_stats *s = mns_frame_stats(frame);
        printf("%s: %dx%d, %llu particles, %s, %s, %s\n", o->inputs[0], s->width, s->height,
               (unsigned long long)s->balls, s->method, s->solver, mns_renderer_name(d->renderer));
        if (s->effects_rays)
            app_note("only first hits are looked at; compare holds what light does beyond them against the "
                     "truth, too");
        size_t rays = o->rays ? (size_t)o->rays : RAYS;
        status = probe_image(d->field, &d->view, image, rays, (uint64_t)o->seed, report, error);
    }
    mns_image_destroy(image);
    mns_frame_destroy(frame);
    return status;
}

static mns_status verify(const app_options *o, mns_error *error)
{
    drawing d;
    probe_report report;
    mns_status status = drawing_open(o, &d, error);
    if (!status) status = check(o, &d, &report, error);
    drawing_close(&d);
    if (status) return status;
    print_report(&report);
    size_t wrong = report.missed + report.invented + report.off;
    if (!wrong) return MNS_OK;
    return app_fail(error, MNS_ERROR_GL, "%.200s: %zu of %zu pixels disagree with the truth", o->inputs[0],
                    wrong, report.rays);
}

int app_verify(int argc, char **argv)
{
    app_options o;
    mns_error error;
    mns_status status = options_read(&VERIFY_OPTIONS, argc, argv, &o, &error);
    if (!status && !o.help) status = verify(&o, &error);
    options_free(&o);
    return status ? app_report(&error) : APP_DONE;
}
