/* Methods and solvers by name, as options, scenes and figures call them. */
#include "meniscus.h"

#include <stddef.h>

const char *mns_method_name(mns_method method)
{
    static const char *const names[] = {"auto", "list", "reference", "tile", "fbvh", "bvh"};
    return (unsigned)method < sizeof names / sizeof *names ? names[method] : NULL;
}

const char *mns_solver_name(mns_solver solver)
{
    static const char *const names[] = {"exact", "cubic", "cubic-monomial", "secant"};
    return (unsigned)solver < sizeof names / sizeof *names ? names[solver] : NULL;
}
