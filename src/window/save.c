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

mns_status save_as(viewer *v, const char *path, mns_error *error)
{
    const char *ending = strrchr(path, '.');
    bool scene = ending && strcasecmp(ending, ".json") == 0;
    mns_view view = drawing_view(v);
    mns_status status = scene ? scene_json_write(v->settings, &v->look, &view, v->timeline.shown, path, error)
                              : save_picture(v, path, error);
    if (!status) viewer_tell(v, "saved %.400s", path);
    return status;
}

mns_status save_copy(viewer *v, mns_error *error)
{
    const window_host *host = &v->desc->host;
    mns_status status = drawing_finish(v, error); /* the method is the plan's */
    if (status) return status;
    mns_view view = drawing_view(v);
    const mns_plan *plan = v->side[0].is_drawn ? mns_frame_plan(v->side[0].frame) : NULL;
    mns_method method = plan ? mns_plan_method(plan, NULL) : v->settings->draw.method;
    char *text = host->command(host->context, &view, v->timeline.shown, method);
    if (!text) return status_no_memory(error, "writing a command line");
    glfwSetClipboardString(v->window, text);
    host->tell(host->context, text);
    snprintf(v->status, sizeof v->status, "copied the command line");
    v->stale = true;
    free(text);
    return MNS_OK;
}
