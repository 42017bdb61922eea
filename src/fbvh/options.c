#include "base/status.h"
#include "fbvh/builder.h"

#include <math.h>
#include <string.h>

#define BLOCK_BYTES ((size_t)128 << 20)
#define FEW_BALLS   32768

/* What an inner node costs, by the cost of a leaf n² or n. Smaller leaves make quicker rays, and builds that
 * take the longer the more balls there are: a few balls' build is nothing beside a frame. */
static double usual_traversal_cost(fbvh_cost cost, size_t balls)
{
    if (cost != FBVH_COST_SQUARE) return 6;
    return balls < FEW_BALLS ? 60 : 200;
}

mns_status fbvh_options_resolve(const fbvh_options *options, size_t balls, fbvh_options *o, mns_error *error)
{
    *o = options ? *options : (fbvh_options){0};
    if (!o->discard_most) o->discard_most = 12;
    if (!o->leaf_least) o->leaf_least = 4;
    if (o->traversal_cost == 0) o->traversal_cost = usual_traversal_cost(o->cost, balls);
    if (o->references_a_ball == 0) o->references_a_ball = FBVH_REFERENCES;
    if (!o->max_block_bytes) o->max_block_bytes = BLOCK_BYTES;
    if (o->kind > FBVH_OVERLAPPING || o->cost > FBVH_COST_LINEAR)
        return status_fail(error, MNS_ERROR_USAGE, "fbvh: no such kind of tree, or of cost");
    if (!(o->references_a_ball >= 1 && o->references_a_ball <= 1e6))
        return status_fail(error, MNS_ERROR_USAGE, "fbvh: references=%g is not in 1 to 1e6",
                           o->references_a_ball);
    if (!(o->traversal_cost >= 0 && o->traversal_cost <= 1e6))
        return status_fail(error, MNS_ERROR_USAGE, "fbvh: traversal-cost=%g is not in 0 to 1e6",
                           o->traversal_cost);
    return MNS_OK;
}

/* A whole number in [least, most], or a number, all of [text, end). */
static bool read_number(const char *text, size_t length, double least, double most, double *value)
{
    char copy[40];
    if (!length || length >= sizeof copy) return false;
    memcpy(copy, text, length);
    copy[length] = 0;
    double whole = 0, scale = 1;
    bool negative = *copy == '-', digits = false;
    const char *at = copy + negative;
    for (; *at >= '0' && *at <= '9'; at++) whole = 10 * whole + (*at - '0'), digits = true;
    if (*at == '.')
        for (at++; *at >= '0' && *at <= '9'; at++) whole += (*at - '0') * (scale /= 10), digits = true;
    if (*at || !digits) return false;
    *value = negative ? -whole : whole;
    return *value >= least && *value <= most;
}

static bool set_flag(const char *name, size_t length, fbvh_options *o)
{
#define IS(word) (length == strlen(word) && !memcmp(name, word, length))
    if (IS("fbvh"))
        o->kind = FBVH_FITTED;
    else if (IS("bvh"))
        o->kind = FBVH_OVERLAPPING;
    else if (IS("cost-n2"))
        o->cost = FBVH_COST_SQUARE;
    else if (IS("cost-n"))
        o->cost = FBVH_COST_LINEAR;
    else if (IS("no-fit"))
        o->no_fit = true;
    else if (IS("no-tight"))
        o->no_tight = true;
    else if (IS("no-discard"))
        o->no_discard = true;
    else if (IS("no-deep"))
        o->no_deep = true;
    else
        return false;
    return true;
}

static bool set_number(const char *name, size_t length, const char *value, size_t value_length,
                       fbvh_options *o)
{
    double number;
    bool whole = !IS("traversal-cost") && !IS("references");
    if (!read_number(value, value_length, IS("middle-levels") ? -1 : 0, 1e15, &number)) return false;
    if (whole && number != floor(number)) return false;
    if (!IS("block-bytes") && number > 1e9) return false;
    if (IS("block-bytes"))
        o->max_block_bytes = (size_t)number;
    else if (IS("discard-most"))
        o->discard_most = (unsigned)number;
    else if (IS("leaf-least"))
        o->leaf_least = (unsigned)number;
    else if (IS("middle-levels"))
        o->middle_levels = (int)number;
    else if (IS("traversal-cost"))
        o->traversal_cost = number;
    else if (IS("references"))
        o->references_a_ball = number;
    else
        return false;
#undef IS
    return true;
}

mns_status fbvh_options_parse(const char *text, fbvh_options *options, mns_error *error)
{
    fbvh_options o = *options;
    for (const char *at = text ? text : ""; *at;) {
        size_t length = strcspn(at, ",");
        const char *equals = memchr(at, '=', length);
        size_t name = equals ? (size_t)(equals - at) : length;
        bool known =
            equals ? set_number(at, name, equals + 1, length - name - 1, &o) : set_flag(at, name, &o);
        if (!known)
            return status_fail(
                error, MNS_ERROR_USAGE,
                "fbvh: \"%.*s\": expected fbvh, bvh, cost-n, cost-n2, no-fit, no-tight, no-discard, no-deep, "
                "or "
                "discard-most, leaf-least, traversal-cost, middle-levels, references or block-bytes "
                "with =number",
                (int)(length < 60 ? length : 60), at);
        at += length + (at[length] == ',');
    }
    *options = o;
    return MNS_OK;
}
