// The cast: one pixel's ray over its list (Szecsi & Illes 2012, section 6). Fragment shader of a full-screen triangle.
//
// The ray is cut into pieces between neighbouring ends of effective intervals; on each the active balls' sum is solved by the
// variant's piece_solve. What float cannot decide, and what outgrows the arrays, goes to the list of pixels that resolve takes.
#include "real.glsl"
#include "density.glsl"
#include "view.glsl"
#include "far.glsl"
#include "balls.glsl"
#define LISTS_ACCESS readonly
#ifdef BALL_TEXELS
#define LISTS_TEXELS
#endif
#include "lists.glsl"
#include "chord.glsl"
#include "stream.glsl"
#include "side.glsl"
#include "loops.glsl"
#if SOLVER != SOLVER_EXACT
#define MIDDLES // of chords are separators too
#endif
#include "active_slots.glsl"
#if SOLVER == SOLVER_EXACT
#include "exact.glsl"
#else
#define DEGREE 3
#include "bernstein.glsl"
#if SOLVER == SOLVER_CUBIC
#include "spline.glsl"
#else
#define MONOMIAL
#include "monomial.glsl"
#endif
#endif
#include "surface.glsl"
#include "planes.glsl"
#include "redo.glsl"
#ifdef HOST_DEPTH
#include "host.glsl"
#endif

layout(location = 0) out vec2 out_t;
layout(location = 1) out vec4 out_normal;
#ifdef BLENDS
layout(location = 2) out vec4 out_color;
#endif

// Takes slot j into the piece [s, stop], if its ball is active there.
void slot_add(int j, float s, float stop, inout float next, inout bool some)
{
    Chord chord = active_chord(j);
    bool here = chord.a <= s && chord.b > s;
    next = min(next, slot_next(chord, stop));
    slot_free = chord.b <= s ? min(slot_free, j) : slot_free;
    some = some || here;
#if SOLVER == SOLVER_EXACT
    chord.shrink = here ? chord.shrink : 0.0; // adds zeros: cheaper than to branch
    piece_take(chord, s, stop);
#else
    if (here) piece_take(chord, s, stop);
#endif
}

// Sums the piece [s, stop] over the slots. Returns the next separator after it, as far as the slots know.
float slot_sum(float s, float stop, out bool some)
{
    float next = FAR_AWAY;
    some = false;
    active_from = s;
    slot_free = slot_count;
    piece_begin();
    EACH_SLOT(slot_add(j, s, stop, next, some))
    return next;
}

#if SOLVER == SOLVER_EXACT && !defined(EYE_INSIDE) && !defined(EYE_ON)
#include "walk_bounds.glsl"
#else
#include "walk_pieces.glsl"
#endif

void main()
{
    vec2 position = gl_FragCoord.xy;
    uint head = list_head(ivec2(position));
    Pixel pixel = pixel_miss(true);
    if (head != NO_NODE) {
        Ray ray = view_ray(position);
#ifdef TILES
        list_ray = ray;
#endif
        float limit = FAR_AWAY;
#ifdef HOST_DEPTH
        limit = host_limit(position);
#endif
        float t;
        side_take(ray);
        int found = cast_walk(head, limit, t);
        if (found == PIECE_HIT) {
            Surface surface = surface_at(ray, t);
#if SOLVER == SOLVER_EXACT
            if (!surface_settled(surface, t)) found = PIECE_OPEN;
#else
            surface.shift = 0.0;
#endif
            pixel.t = pixel_distance(position, t, surface.shift);
            pixel.normal = vec4(surface.normal, 1.0);
            pixel.color = surface.color;
        }
        if (!loops_whole(int(level_two))) {
            found = PIECE_CAP;
            t = 0.0;
        }
        if (stream_disorder) {
            atomicAdd(count_disorder, 1u);
        } else if (found == PIECE_OPEN) {
            atomicAdd(count_float, 1u);
            redo_add(position, REDO_DOUBLE, 0.0);
        } else if (found == PIECE_CAP) {
            if (slot_overflow)
                atomicAdd(count_active, 1u);
            else
                atomicAdd(count_steps, 1u);
            redo_add(position, REDO_FLOAT, t);
        }
    }
    out_t = pixel.t;
    out_normal = pixel.normal;
#ifdef BLENDS
    out_color = pixel.color;
#endif
}
