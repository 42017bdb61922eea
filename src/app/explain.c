/* meniscus render --explain. */
#include "app/render.h"

#include <stdio.h>

/* Prints the plan for the driver's limits, or for the minima of OpenGL 4.3 where there is none. */
static mns_status print_plan(const app_options *o, const mns_field *field, const mns_view *view,
                             const mns_look *look, const mns_renderer *renderer, const char *why_not,
                             mns_error *error)
{
    mns_plan *plan;
    const mns_limits *limits = renderer ? mns_renderer_limits(renderer) : NULL;
    mns_status status = mns_plan_create(field, view, look, &o->draw, limits, &plan, error);
    if (status) return status;
    if (renderer)
        printf("limits: of %s\n", mns_renderer_name(renderer));
    else
        printf("limits: the minima of OpenGL 4.3, as no context starts here (%s)\n", why_not);
    fputs(mns_plan_text(plan), stdout);
    mns_plan_destroy(plan);
    return MNS_OK;
}

mns_status render_explain(const app_options *o, const mns_field *field, const mns_view *view,
                          const mns_look *look, mns_error *error)
{
    mns_context *context = NULL;
    mns_renderer *renderer = NULL;
    mns_error no_context;
    mns_status status = mns_context_create(o->backend, &context, &no_context);
    if (!status) status = mns_renderer_create(mns_context_get_proc(context), &renderer, &no_context);
    status = print_plan(o, field, view, look, status ? NULL : renderer, no_context.text, error);
    mns_renderer_destroy(renderer);
    mns_context_destroy(context);
    return status;
}
