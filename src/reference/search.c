#include "reference/search.h"

#include "reference/start.h"

#include <math.h>

/* Beyond so many balls looked at, those of every piece counted, a ray is given up as undecided: seconds, and
 * some hundred times what ten thousand balls at one point take. */
#define WORK_MOST 200000000

/* The walk looks at F = side (f - L), which is above 0 until the hit. Pieces are taken from left to right and
 * halved until one of three things is proven: F > 0 on the whole piece; F falls on it, from above 0 to below;
 * or F stays so near 0 that rounding hides its sign. After pieces of the last kind, a piece with F > 0 means
 * that a touch could not be told from two crossings: the ray is undecided. One that ends with F < 0 means
 * that the sign changed, for the first time, since the first of them: that is a proof again, with a wider
 * bracket. */
typedef struct search {
    reference_scratch *scratch;
    const mns_field *field;
    double side;
    size_t work; /* balls looked at, and pieces */
    bool failed; /* out of memory */
    bool given_up;
    bool hidden;       /* F's sign is hidden from hidden_from on; F > 0 up to there */
    bool hidden_falls; /* and F has been falling since */
    double hidden_from;
    bool touched; /* some hidden stretch ended with F > 0, or the start was one */
    search_result *result;
} search;

static piece_balls balls_of(const search *s, size_t first, size_t count)
{
    return (piece_balls){s->scratch->chord, s->scratch->active.item + first, count, s->field->kernel,
                         s->field->iso};
}

/* F at a point: its sign where that is proven, else 0. */
static int sign_at(const search *s, const piece_balls *balls, double x, piece_point *at)
{
    piece_point_at(balls, x, at);
    at->value *= s->side, at->slope *= s->side;
    return at->value > at->error ? 1 : at->value < -at->error ? -1 : 0;
}

/* ---- The end of a search ---- */

/* Draws the bracket [lo, hi] about `x`, near which F's sign is hidden, as tight as it can be proven. */
static void settle(search *s, const piece_balls *balls, double x, const piece_point *here)
{
    search_result *r = s->result;
    double least = fabs(x) * 2 * ROUND;
    double first = fmax(2 * (fabs(here->value) + here->error) / fabs(here->slope), least);
    piece_point at;
    if (!isfinite(first)) first = least;
    for (double step = first; x - step > r->lo; step *= 2)
        if (sign_at(s, balls, x - step, &at) > 0) {
            r->lo = x - step;
            break;
        }
    for (double step = first; x + step < r->hi; step *= 2)
        if (sign_at(s, balls, x + step, &at) < 0) {
            r->hi = x + step;
            break;
        }
    r->at = x;
}

/* F falls all over [lo, hi], from above 0 to below: Newton's steps, kept inside. */
static void refine(search *s, const piece_balls *balls, double lo, double hi)
{
    search_result *r = s->result;
    double x = lo + 0.5 * (hi - lo);
    r->found = true;
    r->lo = lo, r->hi = hi, r->at = x;
    for (int i = 0; i < 200; i++) {
        piece_point here;
        int sign = sign_at(s, balls, x, &here);
        double step = -here.value / here.slope;
        if (fabs(here.value) <= 4 * here.error || fabs(step) <= fabs(x) * 2 * ROUND) {
            settle(s, balls, x, &here);
            return;
        }
        if (sign > 0) r->lo = x;
        if (sign < 0) r->hi = x;
        x += step;
        if (!(x > r->lo && x < r->hi) || i % 8 == 7) x = r->lo + 0.5 * (r->hi - r->lo);
        r->at = x;
        if (x <= r->lo || x >= r->hi) return; /* neighbouring doubles */
    }
}

/* F > 0 up to hidden_from, F < 0 at `hi`, and between nobody knows. */
static void take_hidden(search *s, double hi)
{
    search_result *r = s->result;
    size_t count = s->scratch->chord_count; /* the bottom of the stack holds every chord */
    piece_balls all = balls_of(s, 0, count);
    if (s->hidden_falls) {
        refine(s, &all, s->hidden_from, hi);
        return;
    }
    double unknown = s->hidden_from;
    piece_point at;
    for (int i = 0; i < 60; i++) {
        double middle = unknown + 0.5 * (hi - unknown);
        if (middle <= unknown || middle >= hi) break;
        if (sign_at(s, &all, middle, &at) < 0)
            hi = middle;
        else
            unknown = middle;
    }
    *r = (search_result){true, true, s->hidden_from, hi, s->hidden_from + 0.5 * (hi - s->hidden_from)};
}

/* ---- Pieces ---- */

/* What a piece has been proven to be. */
typedef enum verdict {
    VERDICT_OPEN,  /* its polynomial may tell */
    VERDICT_NONE,  /* nothing: halve it */
    VERDICT_CLEAR, /* F > 0, or hidden: go on */
    VERDICT_FOUND,
} verdict;

static verdict take_clear(search *s)
{
    if (s->hidden) s->touched = true;
    s->hidden = false;
    return VERDICT_CLEAR;
}

/* F < 0 from `at` on. */
static verdict take_below(search *s, double at)
{
    if (!s->hidden) s->hidden_from = at; /* only where the start was a guess */
    take_hidden(s, at);
    return VERDICT_FOUND;
}

static verdict take_cover(search *s, double from, bool falls)
{
    if (!s->hidden) s->hidden_from = from, s->hidden_falls = falls;
    s->hidden = true;
    s->hidden_falls = s->hidden_falls && falls;
    return VERDICT_CLEAR;
}

/* F falls on [from, to]: the sign at the end tells all. */
static verdict take_fall(search *s, const piece_balls *balls, double from, double to)
{
    piece_point at;
    int end = sign_at(s, balls, to, &at);
    if (end > 0) return take_clear(s);
    if (end < 0) {
        if (s->hidden)
            take_hidden(s, to);
        else
            refine(s, balls, from, to);
        return VERDICT_FOUND;
    }
    /* The end is hidden: from the last point with F > 0 that is easily found. */
    double hi = to;
    for (int i = 0; !s->hidden && i < 60; i++) {
        double middle = from + 0.5 * (hi - from);
        if (middle <= from || middle >= hi) break;
        if (sign_at(s, balls, middle, &at) > 0)
            from = middle;
        else
            hi = middle;
    }
    return take_cover(s, from, true);
}

static verdict judge_range(search *s, const piece_balls *balls, double from, double to, bool can_halve)
{
    piece_range range;
    piece_range_of(balls, from, to, &range);
    double slack = 2 * ROUND * (s->field->iso + range.at_most);
    double lo = range.lo - s->field->iso - slack, hi = range.hi - s->field->iso + slack;
    if (s->side > 0 ? lo > 0 : hi < 0) return take_clear(s);
    if (s->side > 0 ? hi < 0 : lo > 0) return take_below(s, from);
    /* A polynomial would not help yet. */
    bool coarse = range.loose > 0.5 * (range.hi - range.lo) && range.loose > 0.05 * s->field->iso;
    return coarse && can_halve ? VERDICT_NONE : VERDICT_OPEN;
}

static verdict judge_piece(search *s, const piece_balls *balls, double from, double to, bool can_halve)
{
    piece p;
    piece_make(balls, from, to, &p);
    double margin = p.rounding + p.model, lo = INFINITY, hi = -INFINITY, steepest = -INFINITY;
    for (int j = 0; j <= p.degree; j++) {
        double c = s->side * p.c[j];
        lo = fmin(lo, c), hi = fmax(hi, c);
        if (j) steepest = fmax(steepest, c - s->side * p.c[j - 1]);
    }
    if (lo > margin) return take_clear(s);
    if (hi < -margin) return take_below(s, from);
    bool falls = steepest < -(2 * p.rounding + p.slope_model);
    if (falls && (!s->hidden || s->side * p.c[p.degree] < -margin)) return take_fall(s, balls, from, to);
    if (can_halve && hi - lo + 2 * p.model > 6 * p.rounding) return VERDICT_NONE;
    take_cover(s, from, falls);
    return s->side * p.c[p.degree] < -margin ? take_below(s, to) : VERDICT_CLEAR;
}

/* Puts those chords of the list [first, first + count) that reach into [from, to] on top of the stack. */
static bool narrow(search *s, size_t first, size_t count, double from, double to)
{
    reference_list *active = &s->scratch->active;
    if (!reference_list_reserve(active, active->count + count)) return false;
    for (size_t i = first; i < first + count; i++) {
        const reference_chord *c = &s->scratch->chord[active->item[i]];
        if (c->enter < to && c->leave > from) active->item[active->count++] = active->item[i];
    }
    return true;
}

/* Looks at one piece; false: the search is over. */
static bool visit(search *s, double from, double to, size_t first, size_t count)
{
    reference_list *active = &s->scratch->active;
    size_t top = active->count;
    s->given_up = s->work > WORK_MOST;
    s->failed = !s->given_up && !narrow(s, first, count, from, to);
    if (s->given_up || s->failed) return false;
    size_t mine = active->count - top;
    s->work += mine + 16;
    piece_balls balls = balls_of(s, top, mine);
    double middle = from + 0.5 * (to - from);
    bool can_halve = middle > from && middle < to, goes_on;
    verdict proven = judge_range(s, &balls, from, to, can_halve);
    if (proven == VERDICT_OPEN) proven = judge_piece(s, &balls, from, to, can_halve);
    if (proven != VERDICT_NONE)
        goes_on = proven == VERDICT_CLEAR;
    else
        goes_on = visit(s, from, middle, top, mine) && visit(s, middle, to, top, mine);
    active->count = top;
    return goes_on;
}

bool reference_search(reference_scratch *scratch, const mns_field *field, const reference_ray *ray,
                      double side, double reach, search_result *result)
{
    size_t count = scratch->chord_count;
    *result = (search_result){.certain = true};
    if (!count) return true;
    if (!reference_list_reserve(&scratch->active, count)) return false;
    double begin = INFINITY, end = -INFINITY;
    for (size_t i = 0; i < count; i++) {
        scratch->active.item[i] = i;
        begin = fmin(begin, scratch->chord[i].enter), end = fmax(end, scratch->chord[i].leave);
    }
    scratch->active.count = count;
    search s = {.scratch = scratch, .field = field, .side = -1, .result = result};
    if (begin < -ray->base) {
        piece_balls all = balls_of(&s, 0, count);
        reference_start start =
            side != 0 ? reference_start_from(&all, ray, side) : reference_start_of(&all, field, ray);
        begin = start.from;
        s.side = start.side;
        s.touched = !start.certain;
    }
    end = fmin(end, reach - ray->base);
    if (begin < end) visit(&s, begin, end, 0, count);
    result->certain = !s.touched && !s.given_up && !(s.hidden && !result->found);
    return !s.failed;
}
