/* The planes of a frame traced on the CPU, row by row on all cores, and handed to GL for their shading. */
#include "reference/reference.h"

#include "base/memory.h"
#include "base/rounded.h"
#include "base/status.h"
#include "effects/effects.h"
#include "render/draw.h"
#include "shade/palette.h"
#include "shade/shade.h"

#include <string.h>

/* ---- Colours ---- */

static mns_status make_labels(draw *d, mns_error *error)
{
    const particles_column *column = &d->field->p.column[d->plan->color_column];
    bool elements = strcmp(column->name, "element") == 0;
    float(*label)[3] = d->tracer.label = memory_array(column->label_count, sizeof *label);
    if (!label) return status_no_memory(error, "while colouring a frame");
    for (size_t i = 0; i < column->label_count; i++) {
        uint32_t rgba = palette_label(column->label[i], i, elements);
        for (int c = 0; c < 3; c++) label[i][c] = shade_linear((rgba >> (8 * c) & 255) / 255.0);
    }
    return MNS_OK;
}

/* Adds a ball's colour, and its place between two materials, times its density. */
static void add_ball(const draw *d, size_t ball, double part, double sum[4])
{
    const mns_plan *plan = d->plan;
    double low = plan->color_range[0], span = plan->color_range[1] - low;
    if (plan->features & FEATURE_MATERIALS) sum[3] += part * plan_blend_place(plan, d->field, ball);
    if (!(plan->features & FEATURE_COLORS)) return;
    double value = d->field->p.column[plan->color_column].value[ball];
    if (!(plan->features & FEATURE_LABELS)) {
        sum[0] += part * (span != 0 ? (value - low) / span : 0.5);
        return;
    }
    for (int c = 0; c < 3; c++) sum[c] += part * (double)d->tracer.label[(size_t)value][c];
}

/* As glsl/surface.glsl blends: the mean over the balls around, by their densities where those are positive.
 */
static void blend(const draw *d, const reference_scratch *scratch, double s, float color[4])
{
    double sum[4] = {0, 0, 0, 0}, weight = 0;
    for (size_t i = 0; i < scratch->chord_count; i++) {
        double part = reference_share(&scratch->chord[i], d->field->kernel, s);
        if (!(part > 0)) continue;
        weight += part;
        add_ball(d, scratch->chord[i].ball, part, sum);
    }
    for (int c = 0; c < 4; c++) color[c] = weight > 0 ? (float)(sum[c] / weight) : 0;
    if (!(d->plan->features & FEATURE_MATERIALS)) color[3] = weight > 0 ? 1 : 0;
}

/* The linear colour that glsl/shade.frag.glsl makes of a place on the colour map. */
static void map_color(mns_color_map map, double place, double color[3])
{
    const uint32_t *anchor = palette_map(map);
    double at = fmin(fmax(place, 0), 1) * (PALETTE_ANCHORS - 1);
    int low = at < PALETTE_ANCHORS - 2 ? (int)at : PALETTE_ANCHORS - 2;
    for (int c = 0; c < 3; c++) {
        int shift = 16 - 8 * c;
        double a = anchor[low] >> shift & 255, b = anchor[low + 1] >> shift & 255;
        color[c] = (double)shade_linear((a + (b - a) * (at - low)) / 255);
    }
}

static void first_color(const mns_plan *plan, const float blended[4], double color[3])
{
    if (!(plan->features & FEATURE_COLORS))
        for (int c = 0; c < 3; c++) color[c] = (double)shade_linear(plan->look.color[c]);
    else if (plan->features & FEATURE_LABELS)
        for (int c = 0; c < 3; c++) color[c] = (double)blended[c];
    else
        map_color(plan->look.color_map, (double)blended[0], color);
}

static double surface_albedo(const void *user, const reference_scratch *scratch, double s, double color[3])
{
    const draw *d = user;
    const mns_plan *plan = d->plan;
    float blended[4] = {0, 0, 0, 0};
    if (plan->features & FEATURE_BLENDS) blend(d, scratch, s, blended);
    first_color(plan, blended, color);
    if (!(plan->features & FEATURE_MATERIALS)) return 0;
    const mns_blend *second = &plan->look.blend;
    double weight = fmin(fmax((double)blended[3], 0), 1);
    for (int c = 0; c < 3 && second->set & MNS_LOOK_COLOR; c++)
        color[c] = effects_between(color[c], (double)shade_linear(second->color[c]), weight);
    return weight;
}

/* ---- Pixels ---- */

typedef struct row_counts {
    uint64_t hits, undecided, effects_rays, effects_undecided;
} row_counts;

/* The least float that is no smaller. */
static float rounded_up(double value)
{
    float f = rounded(value);
    return (double)f >= value ? f : nextafterf(f, INFINITY);
}

static void put_pixel(draw *d, size_t at, size_t from_top, const mns_hit *hit)
{
    draw_tracer *tracer = &d->tracer;
    float *t = tracer->t + 2 * at, *normal = tracer->normal + 4 * at;
    float high = rounded(hit->t), low = hit->hit ? rounded(hit->t - (double)high) : 0;
    t[0] = high, t[1] = low;
    for (int a = 0; a < 3; a++) normal[a] = (float)hit->normal[a];
    normal[3] = hit->certain ? 1 : 0;
    d->frame->t_error[from_top] =
        hit->hit ? rounded_up(hit->t_error + fabs(hit->t - ((double)high + (double)low))) : 0;
}

/* The pixel's colour and terms, by rays from what its first found. False: out of memory. */
static bool light_pixel(draw *d, reference_scratch *scratch, size_t at, vec3 way, const effects_met *first,
                        row_counts *counts)
{
    size_t width = (size_t)d->plan->frame.width, height = (size_t)d->plan->frame.height;
    draw_tracer *tracer = &d->tracer;
    effects_pixel pixel = {
        .x = (uint32_t)(at % width), .y = (uint32_t)(height - 1 - at / width), .sample = (uint32_t)d->sample};
    if (!effects_shade(tracer->effects, scratch, way, first, &pixel)) return false;
    float *terms = tracer->terms + 4 * at;
    for (int c = 0; c < 4; c++) tracer->lit[4 * at + (size_t)c] = (float)pixel.color[c];
    terms[0] = (float)pixel.shadow, terms[1] = (float)pixel.occlusion;
    terms[2] = (float)pixel.mirror, terms[3] = (float)pixel.refracted;
    tracer->settled[at] = pixel.certain ? 1 : 0;
    if (tracer->mesh) tracer->mesh[at] = (uint32_t)first->mesh;
    counts->effects_rays += pixel.rays;
    counts->effects_undecided += !pixel.certain;
    return true;
}

static bool first_hit(const draw *d, reference_scratch *scratch, vec3 way, effects_met *met)
{
    reference_query query = {.reach = INFINITY};
    if (d->tracer.effects) return effects_first(d->tracer.effects, scratch, way, met);
    vec3_store(query.origin, d->plan->frame.eye);
    vec3_store(query.direction, way);
    return effects_meet(d->tracer.reference, NULL, scratch, &query, (vec3){0, 0, 0}, met);
}

/* Row y from the bottom. False: out of memory. */
static bool trace_row(draw *d, reference_scratch *scratch, int y, const double jitter[2], row_counts *counts)
{
    const view_frame *frame = &d->plan->frame;
    bool lit = d->plan->features & FEATURE_LIT, colors = d->plan->features & FEATURE_BLENDS && !lit;
    size_t width = (size_t)frame->width, from_top = (size_t)(frame->height - 1 - y);
    for (size_t x = 0; x < width; x++) {
        size_t at = (size_t)y * width + x;
        effects_met met;
        const mns_hit *hit = &met.answer.hit;
        vec3 way = view_direction(frame, (double)x + 0.5 + jitter[0], (double)from_top + 0.5 - jitter[1]);
        if (!first_hit(d, scratch, way, &met)) return false;
        counts->hits += hit->hit;
        counts->undecided += !hit->certain;
        put_pixel(d, at, from_top * width + x, hit);
        if (lit && !light_pixel(d, scratch, at, way, &met, counts)) return false;
        if (!colors) continue;
        float *color = d->tracer.color + 4 * at;
        memset(color, 0, 4 * sizeof *color);
        if (hit->hit) blend(d, scratch, met.answer.s, color);
    }
    return true;
}

/* ---- Frames ---- */

static mns_status begin_effects(draw *d, mns_error *error)
{
    size_t pixels = (size_t)d->plan->frame.width * (size_t)d->plan->frame.height;
    draw_tracer *tracer = &d->tracer;
    bool solids = d->plan->features & FEATURE_SOLIDS;
    mns_status status = draw_solids_begin(d, error);
    if (status) return status;
    if (solids) tracer->mesh = memory_array(pixels, sizeof *tracer->mesh);
    tracer->lit = memory_array(pixels, 4 * sizeof(float));
    tracer->terms = memory_array(pixels, 4 * sizeof(float));
    tracer->settled = memory_array(pixels, sizeof(float));
    tracer->effects = calloc(1, sizeof *tracer->effects);
    if (!tracer->lit || !tracer->terms || !tracer->settled || !tracer->effects || (solids && !tracer->mesh))
        return status_no_memory(error, "while tracing a frame");
    return effects_begin(tracer->effects, d->plan, tracer->reference, solids ? &d->r->solids.set : NULL,
                         surface_albedo, d, error);
}

mns_status draw_reference_begin(draw *d, mns_error *error)
{
    const GladGLContext *gl = &d->r->device.gl;
    size_t pixels = (size_t)d->plan->frame.width * (size_t)d->plan->frame.height;
    draw_tracer *tracer = &d->tracer;
    mns_status status = mns_reference_create(d->field, &tracer->reference, error);
    if (status) return status;
    if (!d->r->passes.vertex_array) gl->GenVertexArrays(1, &d->r->passes.vertex_array);
    tracer->t = memory_array(pixels, 2 * sizeof(float));
    tracer->normal = memory_array(pixels, 4 * sizeof(float));
    if (!tracer->t || !tracer->normal) return status_no_memory(error, "while tracing a frame");
    if (d->plan->features & FEATURE_BLENDS) {
        tracer->color = memory_array(pixels, 4 * sizeof(float));
        if (!tracer->color) return status_no_memory(error, "while tracing a frame");
        if (d->plan->features & FEATURE_LABELS) status = make_labels(d, error);
    }
    if (!status && d->plan->features & FEATURE_LIT) status = begin_effects(d, error);
    draw_mark(d, MNS_PHASE_BUILD);
    return status;
}

void draw_reference_end(draw *d)
{
    mns_reference_destroy(d->tracer.reference);
    free(d->tracer.t);
    free(d->tracer.normal);
    free(d->tracer.color);
    free(d->tracer.label);
    free(d->tracer.lit);
    free(d->tracer.terms);
    free(d->tracer.settled);
    free(d->tracer.mesh);
    if (d->tracer.effects) effects_end(d->tracer.effects);
    free(d->tracer.effects);
    d->tracer = (draw_tracer){0};
}

static void upload(draw *d)
{
    const draw_tracer *tracer = &d->tracer;
    frame_send(d->frame, d->frame->t, GL_RG, tracer->t);
    frame_send(d->frame, d->frame->normal, GL_RGBA, tracer->normal);
    if (tracer->color) frame_send(d->frame, d->frame->color, GL_RGBA, tracer->color);
    if (!tracer->lit) return;
    frame_send(d->frame, d->frame->lit, GL_RGBA, tracer->lit);
    frame_send(d->frame, d->frame->terms, GL_RGBA, tracer->terms);
    frame_send(d->frame, d->frame->settled, GL_RED, tracer->settled);
    if (tracer->mesh) frame_send_whole(d->frame, d->frame->mesh, tracer->mesh);
}

mns_status draw_reference_sample(draw *d, const double jitter[2], mns_error *error)
{
    int height = d->plan->frame.height;
    uint64_t hits = 0, undecided = 0, rays = 0, effects_undecided = 0;
    bool failed = false;
#pragma omp parallel reduction(+ : hits, undecided, rays, effects_undecided) reduction(|| : failed)
    {
        reference_scratch scratch = {0};
        row_counts counts = {0};
#pragma omp for schedule(dynamic)
        for (int y = 0; y < height; y++)
            if (!failed) failed = !trace_row(d, &scratch, y, jitter, &counts);
        hits += counts.hits;
        undecided += counts.undecided;
        rays += counts.effects_rays;
        effects_undecided += counts.effects_undecided;
        reference_scratch_free(&scratch);
    }
    if (failed) return status_no_memory(error, "while tracing a frame");
    upload(d);
    d->stats->pixels_hit = hits;
    d->stats->pixels_undecided = undecided;
    d->stats->effects_rays = rays;
    d->stats->effects_undecided = effects_undecided;
    d->stats->tiles = 1;
    draw_mark(d, MNS_PHASE_TRACE);
    return MNS_OK;
}
