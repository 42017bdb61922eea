/* The window and its context: from the newest OpenGL down to 4.3, or one line that says what was found. */
#include "base/clock.h"
#include "base/status.h"
#include "window/viewer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <stdio.h>

static void hint(const viewer *v, int minor)
{
    static const int api[] = {GLFW_NATIVE_CONTEXT_API, GLFW_EGL_CONTEXT_API, GLFW_OSMESA_CONTEXT_API};
    glfwDefaultWindowHints();
    glfwWindowHint(GLFW_CONTEXT_CREATION_API, api[v->desc->context]);
    if (minor < 0) {
        glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
        return;
    }
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, minor);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
    glfwWindowHint(GLFW_DEPTH_BITS, 0);
    glfwWindowHint(GLFW_STENCIL_BITS, 0);
}

/* What the driver has, where it has no 4.3. */
static mns_status too_old(viewer *v, const char *reason, mns_error *error)
{
    hint(v, -1);
    GLFWwindow *any = glfwCreateWindow(16, 16, "meniscus", NULL, NULL);
    char found[160] = "no OpenGL at all";
    if (any) {
        glfwMakeContextCurrent(any);
        typedef const unsigned char *get_string(unsigned name);
        get_string *string = (get_string *)glfwGetProcAddress("glGetString");
        const unsigned name_version = 0x1F02, name_renderer = 0x1F01;
        if (string)
            snprintf(found, sizeof found, "OpenGL %.60s (%.80s)", string(name_version),
                     string(name_renderer));
        glfwDestroyWindow(any);
    }
    return status_fail(
        error, MNS_ERROR_GL,
        "no window: it needs OpenGL 4.3, and %s was found (%.120s); \"meniscus render\" draws to a file",
        found, reason);
}

void viewer_measure(viewer *v)
{
    int units, pixels;
    glfwGetFramebufferSize(v->window, &pixels, NULL);
    glfwGetWindowSize(v->window, &units, NULL);
    if (units > 0 && pixels > 0) v->dots = (double)pixels / units;
}

void viewer_set_size(viewer *v, int width, int height)
{
    width = width ? width : 1024, height = height ? height : 768;
    glfwSetWindowSize(v->window, (int)(width / v->dots), (int)(height / v->dots));
    v->script.until_ms = clock_ms() + 300; /* the window system takes its time */
}

mns_status viewer_open_window(viewer *v, mns_error *error)
{
    const char *reason = NULL;
    const mns_view *asked = &v->settings->view;
    int width = asked->width ? asked->width : 1024, height = asked->height ? asked->height : 768;
    if (!glfwInit()) {
        glfwGetError(&reason);
        return status_fail(error, MNS_ERROR_GL,
                           "no window: %.200s; \"meniscus render\" draws to a file without one",
                           reason ? reason : "GLFW does not start");
    }
    char first[160] = "no reason given";
    for (int minor = 6; minor >= 3 && !v->window; minor--) {
        hint(v, minor);
        v->window = glfwCreateWindow(width, height, "meniscus", NULL, NULL);
        if (!v->window && glfwGetError(&reason) && reason) snprintf(first, sizeof first, "%s", reason);
    }
    if (!v->window) return too_old(v, first, error);
    glfwMakeContextCurrent(v->window);
    glfwSwapInterval(1);
    glfwGetFramebufferSize(v->window, &v->width, &v->height);
    viewer_measure(v);
    if (!(v->dots > 0)) v->dots = 1;
    v->get_proc = glfwGetProcAddress;
    return MNS_OK;
}
