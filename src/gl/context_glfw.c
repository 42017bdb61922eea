/* Contexts of a hidden GLFW window, for machines that have a display but no EGL. Main thread only, as GLFW
 * is. */
#include "gl/context.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <stdio.h>

static mns_status glfw_failed(mns_error *error, const char *call)
{
    const char *reason = NULL;
    int code = glfwGetError(&reason);
    const char *kind = code == GLFW_VERSION_UNAVAILABLE ? "version too old"
                       : code == GLFW_API_UNAVAILABLE   ? "library missing"
                                                        : "driver failed";
    return status_fail(error, MNS_ERROR_GL, "%s: %s: %s", kind, call, reason ? reason : "no reason given");
}

static mns_status make_current(mns_context *context, mns_error *error)
{
    glfwMakeContextCurrent(context->state);
    return glfwGetCurrentContext() == context->state ? MNS_OK : glfw_failed(error, "glfwMakeContextCurrent");
}

/* GLFW itself stays initialised: glfwTerminate would take the host's windows along. */
static void destroy(mns_context *context)
{
    glfwDestroyWindow(context->state);
}

void context_glfw_release(void)
{
    if (!glfwGetTimerFrequency()) { /* not initialised, by us or by the host: nothing can be current */
        glfwGetError(NULL);
        return;
    }
    if (glfwGetCurrentContext()) glfwMakeContextCurrent(NULL);
}

/* A hidden window of the newest core context from 4.6 down to 4.3; NULL where there is none. Hints are the
 * process's: they are left at their defaults. */
static GLFWwindow *create_window(void)
{
    GLFWwindow *window = NULL;
    for (int minor = 6; !window && minor >= 3; minor--) {
        glfwDefaultWindowHints();
        glfwWindowHint(GLFW_VISIBLE, GLFW_FALSE);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
        glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, minor);
        glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
        glfwWindowHint(GLFW_OPENGL_DEBUG_CONTEXT, GLFW_TRUE);
        window = glfwCreateWindow(16, 16, "meniscus", NULL, NULL);
    }
    return window;
}

mns_status context_glfw_open(mns_context *context, mns_error *error)
{
    const context_backend backend = {make_current, destroy, glfwGetProcAddress};
    if (!glfwInit()) return glfw_failed(error, "glfwInit");
    context->state = create_window();
    if (!context->state) {
        mns_status status = glfw_failed(error, "glfwCreateWindow");
        glfwDefaultWindowHints();
        return status;
    }
    glfwDefaultWindowHints();
    context->kind = MNS_BACKEND_GLFW;
    mns_status status = make_current(context, error);
    if (status != MNS_OK) {
        destroy(context);
        return status;
    }
    snprintf(context->name, sizeof context->name, "glfw");
    context->backend = backend;
    return MNS_OK;
}
