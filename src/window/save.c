/* What a view leaves behind: the picture, the scene, the command line. */
#include "base/status.h"
#include "window/scene_json.h"
#include "window/viewer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static mns_status save_picture(viewer *v, const char *path, mns_error *error)
{
    mns_image *image = NULL;
    mns_status status = drawing_finish(v, error);
    if (!status && !v->side[0].is_drawn)
        status = status_fail(error, MNS_ERROR_USAGE, "save: there is no picture yet");
    if (!status) status = mns_frame_read(v->side[0].frame, &image, error);
    if (!status) status = mns_image_write(image, path, error);
    mns_image_destroy(image);
    return status;
}

/* What a scene cannot say must be given beside it. */
static void tell_left_out(viewer *v, const char *path)
{
    const mns_options *o = &v->settings->draw;
    const struct {
        const char *name;
        bool is_given;
    } option[] = {{"--gather", o->gather},       {"--tree", o->tree && *o->tree},
                  {"--slots", o->slots},         {"--root-steps", o->root_steps},
                  {"--pool", o->max_pool_nodes}, {"--secant-steps", o->secant_steps},
                  {"--shuffle", o->shuffle}};
    char names[120] = "";
    size_t used = 0;
    for (size_t i = 0; i < sizeof option / sizeof *option; i++)
        if (option[i].is_given)
            used +=
                (size_t)snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "", option[i].name);
    if (used)
        viewer_tell(v, "saved %.300s without what a scene cannot say: %s", path, names);
    else
        viewer_tell(v, "saved %.400s", path);
}

mns_status save_as(viewer *v, const char *path, mns_error *error)
{
    const char *ending = strrchr(path, '.');
    bool scene = ending && strcasecmp(ending, ".json") == 0;
    mns_view view = drawing_view(v);
    mns_status status =
        scene ? scene_json_write(v->settings, &v->look, &view, v->now->timeline.shown, path, error)
              : save_picture(v, path, error);
    if (!status && scene) tell_left_out(v, path);
    if (!status && !scene) viewer_tell(v, "saved %.400s", path);
    return status;
}

mns_status save_copy(viewer *v, mns_error *error)
{
    const window_host *host = &v->desc->host;
    const mns_options options = drawing_options(v, 0);
    mns_view view = drawing_view(v);
    mns_plan *plan; /* the method is the plan's, which needs no picture */
    mns_status status = mns_plan_create(v->now->field, &view, &v->look, &options,
                                        mns_renderer_limits(v->side[0].renderer), &plan, error);
    if (status) return status;
    mns_method method = mns_plan_method(plan, NULL);
    mns_plan_destroy(plan);
    char *text = host->command(host->context, &view, v->now->timeline.shown, method);
    if (!text) return status_no_memory(error, "writing a command line");
    glfwSetClipboardString(v->window, text);
    host->tell(host->context, text);
    snprintf(v->status, sizeof v->status, "copied the command line");
    v->stale = true;
    free(text);
    return MNS_OK;
}
