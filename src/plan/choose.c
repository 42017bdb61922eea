/* The method of a frame whose host leaves it open. What an option asks of one method alone decides first,
 * then the driver; docs/decisions.md has the measurements, `bench/speed.sh auto` takes them again. */
#include "plan/plan.h"

static plan_choice choice(mns_method method, const char *reason)
{
    return (plan_choice){method, reason};
}

plan_choice plan_required(const mns_options *options)
{
    if (options->method != MNS_METHOD_AUTO) return choice(options->method, "asked for");
    if (options->counters) return choice(MNS_METHOD_FBVH, "auto: trees alone count a ray's work");
    if (options->tree && *options->tree)
        return choice(MNS_METHOD_FBVH, "auto: it is said how a tree is built");
    if (options->solver == MNS_SOLVER_SECANT)
        return choice(MNS_METHOD_FBVH, "auto: the solver secant is the trees'");
    if (options->gather == MNS_GATHER_PAPER)
        return choice(MNS_METHOD_LIST, "auto: lists alone are gathered as published");
    if (options->shuffle) return choice(MNS_METHOD_LIST, "auto: gathered lists alone are shuffled");
    return choice(MNS_METHOD_AUTO, NULL);
}

plan_choice plan_choose(const mns_options *options, const mns_limits *limits)
{
    plan_choice required = plan_required(options);
    if (required.method != MNS_METHOD_AUTO) return required;
    if (limits->is_software)
        return choice(MNS_METHOD_TILE, "auto: a software renderer casts sooner than it rasterises");
    return choice(MNS_METHOD_TILE, "auto: a card would have to sort the lists that it gathers");
}
