/* The figures of a draw. */
#include "render/draw.h"

#include "base/status.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void draw_stats_start(draw *d)
{
    const mns_plan *plan = d->plan;
    mns_stats *stats = d->stats;
    *stats = (mns_stats){0};
    bool traced = plan->features & FEATURE_REFERENCE;
    bool tiles = plan->features & FEATURE_TILES;
    bool tree = plan->features & FEATURE_TREE, overlaps = plan->features & FEATURE_OVERLAPS;
    stats->method = traced ? "reference" : overlaps ? "bvh" : tree ? "fbvh" : tiles ? "tile" : "list";
    stats->solver = mns_solver_name(plan->options.solver);
    stats->gather = traced || tiles || tree                    ? "none"
                    : plan->options.gather == MNS_GATHER_PAPER ? "paper"
                                                               : "early-z";
    stats->width = plan->frame.width;
    stats->height = plan->frame.height;
    stats->timed = plan->options.measure;
    stats->balls = d->field->p.count;
    stats->t_unit = plan->t_unit;
    stats->color_by = plan->color_by;
    stats->color_map = "";
    stats->passes = plan->pass_count;
    if (!(plan->features & FEATURE_COLORS) || plan->features & FEATURE_LABELS) return;
    stats->color_map = mns_color_map_name(plan->look.color_map);
    memcpy(stats->color_range, plan->color_range, sizeof stats->color_range);
}

void draw_counts_add(mns_stats *stats, const list_counts *counts)
{
    stats->fallbacks.active_overflow += counts->active;
    stats->fallbacks.root_cap += counts->steps;
    stats->fallbacks.undecided_float += counts->undecided_float;
    stats->pixels_undecided += counts->undecided;
}

mns_status draw_hits_count(draw *d, mns_error *error)
{
    const GladGLContext *gl = &d->r->device.gl;
    size_t pixels = (size_t)d->stats->width * (size_t)d->stats->height;
    float *t = malloc(pixels * 2 * sizeof *t);
    if (!t) return status_no_memory(error, "while counting hits");
    gl->BindTexture(GL_TEXTURE_2D, d->frame->t);
    gl->GetTexImage(GL_TEXTURE_2D, 0, GL_RG, GL_FLOAT, t);
    for (size_t i = 0; i < pixels; i++) d->stats->pixels_hit += t[2 * i] < INFINITY;
    free(t);
    return MNS_OK;
}

mns_status draw_work_count(draw *d, mns_error *error)
{
    const GladGLContext *gl = &d->r->device.gl;
    size_t pixels = (size_t)d->stats->width * (size_t)d->stats->height;
    float *work = malloc(pixels * MNS_WORK_COUNT * sizeof *work);
    if (!work) return status_no_memory(error, "while counting work");
    gl->BindTexture(GL_TEXTURE_2D, d->frame->work);
    gl->GetTexImage(GL_TEXTURE_2D, 0, GL_RGBA, GL_FLOAT, work);
    for (size_t i = 0; i < pixels * MNS_WORK_COUNT; i++)
        d->stats->work[i % MNS_WORK_COUNT] += (double)work[i] / (double)pixels;
    d->stats->counted = true;
    free(work);
    return MNS_OK;
}

uint64_t draw_buffers_count(const mns_renderer *r)
{
    const list_passes *p = &r->passes;
    const trace_passes *t = &r->trace;
    const gl_buffer *all[] = {&p->balls,         &p->balls_low,
                              &p->cores,         &p->colors,
                              &p->nodes,         &p->counter,
                              &p->redo,          &p->view,
                              &p->view_wide,     &p->far_block,
                              &r->shade,         &p->backwards,
                              &p->tile_heads,    &t->balls,
                              &t->balls_low,     &t->colors,
                              &t->pairs,         &t->leaves,
                              &t->references,    &r->effects.block,
                              &r->effects.store, &r->effects.solids.buffer,
                              &p->squares,       &t->block_list};
    uint64_t count = 0;
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) count += all[i]->id != 0;
    return count;
}
