#include "window/choices.h"

#include <stdio.h>
#include <string.h>

static const char *const OF_LISTS[] = {"exact", "cubic", "cubic-monomial", NULL};
static const char *const OF_TREES[] = {"exact", "secant", NULL};
static const char *const OF_TRUTH[] = {"exact", NULL};
static const char *const SAMPLES[] = {"1", "4", "16", "64", NULL};
static const char *const MODES[] = {"off", "divider", "flicker", "difference", NULL}; /* as compare_mode */
static const char *const OTHERS[] = {"list:exact",  "tile:exact", "fbvh:exact", "bvh:exact",
                                     "fbvh:secant", "list:cubic", NULL};

static void fill(choice *c, const char *const *names, const char *now)
{
    for (c->count = 0; names[c->count]; c->count++) {
        c->names[c->count] = names[c->count];
        if (now && strcmp(now, names[c->count]) == 0) c->now = c->count;
    }
}

static void methods(const viewer *v, choice *c)
{
    for (int k = 0; k <= MNS_METHOD_BVH; k++) c->names[c->count++] = mns_method_name((mns_method)k);
    c->now = (int)v->settings->draw.method;
}

static void solvers(const viewer *v, choice *c)
{
    const mns_plan *plan = v->side[0].is_drawn ? mns_frame_plan(v->side[0].frame) : NULL;
    mns_method method = plan ? mns_plan_method(plan, NULL) : MNS_METHOD_LIST;
    bool tree = method == MNS_METHOD_FBVH || method == MNS_METHOD_BVH;
    fill(c,
         method == MNS_METHOD_REFERENCE ? OF_TRUTH
         : tree                         ? OF_TREES
                                        : OF_LISTS,
         mns_solver_name(v->settings->draw.solver));
}

static void kernels(const viewer *v, choice *c)
{
    mns_field_info info;
    mns_field_get_info(v->now->field, &info);
    for (int k = MNS_KERNEL_DEFAULT + 1; k < MNS_KERNEL_COUNT; k++) {
        if ((mns_kernel)k == info.kernel) c->now = c->count;
        c->names[c->count++] = mns_kernel_name((mns_kernel)k);
    }
}

static void looks(const viewer *v, choice *c)
{
    const char *now = v->settings->look.preset;
    if (!now || !*now) now = "plain";
    for (const char *name; c->count < CHOICE_NAMES && (name = mns_look_preset_name((size_t)c->count));
         c->count++) {
        if (strcmp(name, now) == 0) c->now = c->count;
        c->names[c->count] = name;
    }
}

static void maps(const viewer *v, choice *c)
{
    for (int k = 0; k < MNS_COLOR_MAP_COUNT; k++) c->names[c->count++] = mns_color_map_name((mns_color_map)k);
    c->now = (int)v->settings->look.color_map;
}

static void columns(const viewer *v, choice *c)
{
    const char *now = v->settings->look.color_by;
    mns_column_info column;
    c->names[c->count++] = "none";
    if (!now) c->now = 0;
    for (size_t i = 0; c->count < CHOICE_NAMES && mns_field_get_column(v->now->field, i, &column); i++) {
        if (now && strcmp(now, column.name) == 0) c->now = c->count;
        c->names[c->count++] = column.name;
    }
}

static void samples(const viewer *v, choice *c)
{
    char now[16];
    snprintf(now, sizeof now, "%d", v->settings->draw.samples ? v->settings->draw.samples : 1);
    fill(c, SAMPLES, now);
}

static void modes(const viewer *v, choice *c)
{
    fill(c, MODES, MODES[v->compare]);
}

static void others(const viewer *v, choice *c)
{
    fill(c, OTHERS, v->other_name);
}

static const struct {
    const char *name, *label, *action;
    void (*fill)(const viewer *v, choice *c);
} ROWS[] = {{"method", "method", "set method", methods},
            {"solver", "solver", "set solver", solvers},
            {"kernel", "kernel", "set kernel", kernels},
            {"look", "look", "set look", looks},
            {"color-by", "colour by", "set color-by", columns},
            {"color-map", "colour map", "set color-map", maps},
            {"aa", "samples", "set aa", samples},
            {"compare", "compare", "compare", modes},
            {"other", "with", "other", others}};

bool choice_at(const viewer *v, int index, choice *c)
{
    if (index < 0 || index >= (int)(sizeof ROWS / sizeof *ROWS)) return false;
    *c = (choice){.label = ROWS[index].label, .action = ROWS[index].action, .now = -1};
    ROWS[index].fill(v, c);
    return true;
}

bool choice_named(const viewer *v, const char *name, choice *c)
{
    for (int i = 0; i < (int)(sizeof ROWS / sizeof *ROWS); i++)
        if (strcmp(ROWS[i].name, name) == 0) return choice_at(v, i, c);
    return false;
}
