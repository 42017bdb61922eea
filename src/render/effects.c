/* Light beyond the first hit, of a frame whose planes are there: region by region, dispatch after dispatch,
 * until no walk waits. */
#include "shade/effects.h"

#include "base/status.h"
#include "render/draw.h"
#include "shade/shade.h"

mns_status draw_solids_begin(draw *d, mns_error *error)
{
    const mns_plan *plan = d->plan;
    if (!(plan->features & FEATURE_SOLIDS)) return MNS_OK;
    return solid_files_take(&d->r->solids, plan->mesh, plan->look.mesh_count, plan->unit, error);
}

mns_status draw_effects_begin(draw *d, mns_error *error)
{
    uint64_t f = d->plan->features;
    mns_status status = f & FEATURE_RAYS && !(f & FEATURE_TREE) ? draw_tree_begin(d, error) : MNS_OK;
    if (!status) status = draw_solids_begin(d, error);
    if (!status && f & FEATURE_SOLIDS)
        status = shade_solids_send(&d->r->effects.solids, &d->r->device, d->plan, &d->r->solids, error);
    if (!status) status = shade_effects_map(&d->r->effects, &d->r->device, d->plan, error);
    draw_mark(d, MNS_PHASE_UPLOAD);
    return status;
}

/* Walks on in float, and in doubles with the rays that float cannot decide, until none waits. */
static mns_status light_region(draw *d, list_region region, mns_error *error)
{
    mns_renderer *r = d->r;
    shade_walks walks;
    mns_status status =
        shade_effects_begin(&r->effects, &r->passes, &r->device, d->plan, d->program, region, &walks, error);
    if (status) return status;
    while (walks.waiting || walks.waiting_wide) {
        if (!walks.waiting) {
            status = draw_late_program(d, SHADER_EFFECTS_RESOLVE, MNS_PHASE_EFFECTS, error);
            if (!status) status = draw_tree_low(d, MNS_PHASE_EFFECTS, error);
            if (status) return status;
        }
        shade_effects_go_on(&r->effects, &r->trace, &r->passes, &r->device, d->program, &walks);
    }
    d->stats->effects_rays += walks.rays;
    d->stats->effects_undecided += walks.undecided;
    return gl_check(&r->device, "effects", error);
}

static mns_status light_rows(draw *d, size_t most, mns_error *error)
{
    int width = d->plan->frame.width, height = d->plan->frame.height;
    int rows = most / (size_t)width < (size_t)height ? (int)(most / (size_t)width) : height;
    if (!rows)
        return status_fail(error, MNS_ERROR_UNSUPPORTED,
                           "size %dx%d: this driver's storage blocks hold the light's ways of no row", width,
                           height);
    mns_status status = MNS_OK;
    for (int y = 0; y < height && !status; y += rows) {
        list_region region = {0, y, width, rows < height - y ? rows : height - y};
        status = light_region(d, region, error);
    }
    return status;
}

mns_status draw_effects_sample(draw *d, const double jitter[2], mns_error *error)
{
    mns_renderer *r = d->r;
    const mns_frame *f = d->frame;
    const mns_plan *plan = d->plan;
    const shade_planes planes = {f->t, f->normal, f->color, f->mesh, f->lit, f->terms, f->settled};
    bool rays = plan->features & FEATURE_RAYS;
    size_t pixels = (size_t)f->width * (size_t)f->height, most = rays ? shade_effects_most(plan) : pixels;
    if (most > r->passes.redo_capacity) most = r->passes.redo_capacity;
    if (most > pixels) most = pixels;
    mns_status status = shade_send(&r->device, &r->shade, plan, jitter, error);
    if (!status) status = shade_effects_send(&r->effects, &r->device, plan, jitter, d->sample, error);
    if (!status && plan->features & FEATURE_SOLIDS) {
        const GLuint seen[3] = {f->t, f->normal, f->mesh};
        shade_solids_first(&r->effects.solids, &r->passes, &r->device, plan, d->program[SHADER_SOLIDS_FIRST],
                           r->effects.block.id, seen, &d->stats->pixels_undecided);
    }
    if (!status) status = shade_effects_reserve(&r->effects, &r->passes, &r->device, plan, most, error);
    if (status) return status;
    d->stats->effects_rays = d->stats->effects_undecided = 0;
    shade_effects_bind(&r->effects, &r->trace, &r->passes, &r->device, plan, &r->shade, &planes);
    shade_effects_clear(&r->device, plan, f->lit_target);
    status = light_rows(d, most, error);
    draw_mark(d, MNS_PHASE_EFFECTS);
    return status;
}
