#include "window/keys.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <stddef.h>
#include <string.h>

static const key_row KEYS[] = {
    {GLFW_KEY_F, 0, "F", "fit", "fit the whole field into the window", false},
    {GLFW_KEY_HOME, 0, "Home", "home", "back to the first view", false},
    {GLFW_KEY_1, 0, "1", "side front", "look from the front", false},
    {GLFW_KEY_2, 0, "2", "side back", "from the back", false},
    {GLFW_KEY_3, 0, "3", "side left", "from the left", false},
    {GLFW_KEY_4, 0, "4", "side right", "from the right", false},
    {GLFW_KEY_5, 0, "5", "side top", "from the top", false},
    {GLFW_KEY_6, 0, "6", "side bottom", "from the bottom", false},
    {GLFW_KEY_LEFT, 0, "Left", "orbit -15 0", "orbit", true},
    {GLFW_KEY_RIGHT, 0, "Right", "orbit 15 0", "orbit", true},
    {GLFW_KEY_UP, 0, "Up", "orbit 0 15", "orbit", true},
    {GLFW_KEY_DOWN, 0, "Down", "orbit 0 -15", "orbit", true},
    {0, 0, "=", "zoom 0.8", "nearer", true},
    {0, 0, "-", "zoom 1.25", "farther", true},
    {0, 0, "[", "widen 0.9", "a narrower field of view", true},
    {0, 0, "]", "widen 1.1", "a wider field of view", true},
    {GLFW_KEY_M, 0, "M", "next method", "the next method", false},
    {GLFW_KEY_N, 0, "N", "next solver", "the next solver of it", false},
    {GLFW_KEY_K, 0, "K", "next kernel", "the next kernel", false},
    {GLFW_KEY_G, 0, "G", "next look", "the next look", false},
    {GLFW_KEY_C, 0, "C", "next color-map", "the next colour map", false},
    {GLFW_KEY_X, 0, "X", "next aa", "1, 4, 16 or 64 samples a pixel at rest", false},
    {GLFW_KEY_B, 0, "B", "next compare", "compare: a divider, flicker, the difference, or off", false},
    {GLFW_KEY_V, 0, "V", "next other", "the method to compare with", false},
    {0, 0, ",", "scale 0.1", "a finer scale of the difference", true},
    {0, 0, ".", "scale 10", "a coarser scale", true},
    {GLFW_KEY_T, 0, "T", "check", "the error against the reference, in the background", false},
    {GLFW_KEY_I, 0, "I", "hover", "say what is under the cursor, or no longer", false},
    {GLFW_KEY_SPACE, 0, "Space", "play", "play, or pause", false},
    {GLFW_KEY_PAGE_UP, 0, "PageUp", "step -1", "the frame before", true},
    {GLFW_KEY_PAGE_DOWN, 0, "PageDown", "step 1", "the next frame", true},
    {GLFW_KEY_L, 0, "L", "loop", "begin again at the end, or no longer", false},
    {GLFW_KEY_9, 0, "9", "speed 0.5", "half as fast", true},
    {GLFW_KEY_0, 0, "0", "speed 2", "twice as fast", true},
    {GLFW_KEY_ENTER, 0, "Return", "whole", "draw a picture whole that takes long", false},
    {GLFW_KEY_S, GLFW_MOD_CONTROL, "ctrl+S", "save", "save the picture as meniscus.png", false},
    {GLFW_KEY_E, GLFW_MOD_CONTROL, "ctrl+E", "save meniscus.exr", "save it as meniscus.exr", false},
    {GLFW_KEY_J, GLFW_MOD_CONTROL, "ctrl+J", "save meniscus.json", "save the scene as meniscus.json", false},
    {GLFW_KEY_C, GLFW_MOD_CONTROL, "ctrl+C", "copy", "copy the command line that renders this view", false},
    {GLFW_KEY_F5, 0, "F5", "reload", "read the shaders again (--glsl)", false},
    {GLFW_KEY_TAB, 0, "Tab", "panel", "show the panel, or hide it", false},
    {0, 0, "?", "help", "show these keys", false},
    {GLFW_KEY_F1, 0, "F1", "help", "show these keys", false},
    {GLFW_KEY_Q, GLFW_MOD_CONTROL, "ctrl+Q", "quit", "close the window", false},
    {GLFW_KEY_ESCAPE, 0, "Escape", "quit", "close the window", false},
};

enum { KEY_COUNT = sizeof KEYS / sizeof *KEYS };

const key_row *key_of(int key, int mods)
{
    mods &= GLFW_MOD_SHIFT | GLFW_MOD_CONTROL;
    for (int i = 0; i < KEY_COUNT; i++)
        if (key && KEYS[i].key == key && KEYS[i].mods == mods) return &KEYS[i];
    return NULL;
}

const key_row *key_typed(unsigned character)
{
    for (int i = 0; i < KEY_COUNT; i++)
        if (!KEYS[i].key && (unsigned char)KEYS[i].name[0] == character) return &KEYS[i];
    return NULL;
}

const key_row *key_named(const char *name)
{
    for (int i = 0; i < KEY_COUNT; i++)
        if (strcmp(KEYS[i].name, name) == 0) return &KEYS[i];
    return NULL;
}

const key_row *key_at(int index)
{
    return index >= 0 && index < KEY_COUNT ? &KEYS[index] : NULL;
}
