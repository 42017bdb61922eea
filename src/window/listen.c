/* What GLFW tells of mouse, keys, monitors and files, as events. */
#include "window/viewer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

static bool mouse_is_taken(const viewer *v)
{
    return v->panel && !v->drag && panel_takes_mouse(v->panel);
}

static void on_size(GLFWwindow *window, int width, int height)
{
    viewer *v = glfwGetWindowUserPointer(window);
    viewer_measure(v);
    viewer_resize(v, width, height);
}

/* On another monitor. */
static void on_scale(GLFWwindow *window, float across, float down)
{
    viewer *v = glfwGetWindowUserPointer(window);
    (void)across, (void)down;
    viewer_measure(v);
    v->polish = 2;
}

static void on_refresh(GLFWwindow *window)
{
    viewer *v = glfwGetWindowUserPointer(window);
    v->stale = true;
}

static void on_button(GLFWwindow *window, int button, int action, int mods)
{
    viewer *v = glfwGetWindowUserPointer(window);
    v->polish = 2;
    if (!mouse_is_taken(v)) events_press(v, button, action == GLFW_PRESS, mods);
}

static void on_cursor(GLFWwindow *window, double x, double y)
{
    viewer *v = glfwGetWindowUserPointer(window);
    v->polish = 2;
    if (!mouse_is_taken(v)) events_move(v, x * v->dots, y * v->dots);
}

static void on_scroll(GLFWwindow *window, double x, double y)
{
    viewer *v = glfwGetWindowUserPointer(window);
    v->polish = 2;
    if (!mouse_is_taken(v)) events_scroll(v, x, y);
}

/* The letter that is printed on a key, whatever the layout: GLFW's keys are places on an American one. Where
 * a sign is printed instead, on_character has it. */
static int letter_of(int key, int code)
{
    const char *name = glfwGetKeyName(key, code);
    if (!name || !name[0] || name[1]) return key;
    if (name[0] >= 'a' && name[0] <= 'z') return name[0] - 'a' + GLFW_KEY_A;
    return key >= GLFW_KEY_A && key <= GLFW_KEY_Z ? GLFW_KEY_UNKNOWN : key;
}

static void on_key(GLFWwindow *window, int key, int code, int action, int mods)
{
    viewer *v = glfwGetWindowUserPointer(window);
    v->polish = 2;
    if (action != GLFW_RELEASE && !(v->panel && panel_takes_keys(v->panel)))
        events_key(v, letter_of(key, code), mods, action == GLFW_REPEAT);
}

static void on_character(GLFWwindow *window, unsigned character)
{
    viewer *v = glfwGetWindowUserPointer(window);
    if (!(v->panel && panel_takes_keys(v->panel))) events_type(v, character);
}

static void on_drop(GLFWwindow *window, int count, const char **paths)
{
    viewer *v = glfwGetWindowUserPointer(window);
    mns_error error;
    if (settings_open(v, paths, (size_t)count, &error)) viewer_tell_error(v, &error);
    v->polish = 2;
}

bool viewer_flies(const viewer *v, double way[3])
{
    static const int keys[3][2] = {
        {GLFW_KEY_D, GLFW_KEY_A}, {GLFW_KEY_E, GLFW_KEY_Q}, {GLFW_KEY_W, GLFW_KEY_S}};
    bool flies = false;
    if (v->panel && panel_takes_keys(v->panel)) return false;
    if (glfwGetKey(v->window, GLFW_KEY_LEFT_CONTROL) || glfwGetKey(v->window, GLFW_KEY_RIGHT_CONTROL))
        return false;
    for (int i = 0; i < 3; i++) {
        way[i] = glfwGetKey(v->window, keys[i][0]) - glfwGetKey(v->window, keys[i][1]);
        flies = flies || way[i] != 0;
    }
    return flies;
}

void viewer_listen(viewer *v)
{
    glfwSetWindowUserPointer(v->window, v);
    glfwSetFramebufferSizeCallback(v->window, on_size);
    glfwSetWindowRefreshCallback(v->window, on_refresh);
    glfwSetMouseButtonCallback(v->window, on_button);
    glfwSetCursorPosCallback(v->window, on_cursor);
    glfwSetScrollCallback(v->window, on_scroll);
    glfwSetKeyCallback(v->window, on_key);
    glfwSetCharCallback(v->window, on_character);
    glfwSetWindowContentScaleCallback(v->window, on_scale);
    glfwSetDropCallback(v->window, on_drop);
}
