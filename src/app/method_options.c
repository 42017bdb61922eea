/* The options of how a frame is drawn, which commands share. */
#include "app/app.h"
#include "app/options.h"

static const char *method_name(int i)
{
    return mns_method_name((mns_method)i);
}

mns_status option_method(app_options *o, const char *name, const char *text, mns_error *error)
{
    int index;
    mns_status status = parse_name(name, text, method_name, MNS_METHOD_BVH + 1, &index, error);
    if (!status) o->draw.method = (mns_method)index;
    return status;
}

static const char *solver_name(int i)
{
    return mns_solver_name((mns_solver)i);
}

mns_status option_solver(app_options *o, const char *name, const char *text, mns_error *error)
{
    int index;
    mns_status status = parse_name(name, text, solver_name, MNS_SOLVER_SECANT + 1, &index, error);
    if (!status) o->draw.solver = (mns_solver)index;
    return status;
}

mns_status option_tree(app_options *o, const char *name, const char *text, mns_error *error)
{
    (void)name, (void)error;
    o->draw.tree = text;
    return MNS_OK;
}

mns_status option_secant_steps(app_options *o, const char *name, const char *text, mns_error *error)
{
    return parse_count(name, text, 4096, &o->draw.secant_steps, error);
}

mns_status option_counters(app_options *o, const char *name, const char *text, mns_error *error)
{
    (void)name, (void)text, (void)error;
    o->draw.counters = true;
    return MNS_OK;
}

static const char *gather_name(int i)
{
    static const char *const names[] = {"early-z", "paper"};
    return names[i];
}

mns_status option_gather(app_options *o, const char *name, const char *text, mns_error *error)
{
    int index;
    mns_status status = parse_name(name, text, gather_name, MNS_GATHER_PAPER + 1, &index, error);
    if (!status) o->draw.gather = (mns_gather)index;
    return status;
}

static const char *backend_name(int i)
{
    static const char *const names[] = {"auto", "egl", "osmesa", "glfw"};
    return names[i];
}

mns_status option_backend(app_options *o, const char *name, const char *text, mns_error *error)
{
    int index;
    mns_status status = parse_name(name, text, backend_name, MNS_BACKEND_GLFW + 1, &index, error);
    if (!status) o->backend = (mns_backend)index;
    return status;
}

mns_status option_threads(app_options *o, const char *name, const char *text, mns_error *error)
{
    return parse_count(name, text, 1024, &o->threads, error);
}

mns_status option_no_cache(app_options *o, const char *name, const char *text, mns_error *error)
{
    (void)name, (void)text, (void)error;
    o->no_cache = true;
    return MNS_OK;
}
