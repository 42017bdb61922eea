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
#include "lists.glsl"
#include "chord.glsl"
#include "active_array.glsl"
#if SOLVER == SOLVER_EXACT && KERNEL <= DENSITY_WYVILL
#if KERNEL == DENSITY_POLY2
#define DEGREE 4
#elif KERNEL == DENSITY_POLY4
#define DEGREE 8
#else
#define DEGREE 6
#endif
#include "bernstein.glsl"
#include "piece.glsl"
#elif SOLVER == SOLVER_EXACT
#define DEGREE 1
#include "bernstein.glsl"
#include "taylor.glsl"
#else
#define MIDDLES
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
#ifdef COLORS
layout(location = 2) out vec4 out_color;
#endif

// Walks the ray. Returns the last piece's verdict; s is the hit.
int cast_walk(Ray ray, uint head, float limit, out float s, out bool refilled)
{
    s = 0.0;
    refilled = false;
    int found = PIECE_NONE;
    int next = 0;
    active_clear();
#ifdef MONOMIAL
    monomial_w = vec4(0.0);
#endif
    window_load(ray, head, -FAR_AWAY, 0u);
    for (;;) {
        if (active_count == 0 && next < window_count) {
            s = max(s, window_entry[next]);
#ifdef MONOMIAL
            monomial_w = vec4(0.0);
#endif
        }
        while (next < window_count && window_entry[next] <= s) {
            int before = active_count;
            active_add(ray, window_ball[next++], s);
            if (active_overflow) return PIECE_CAP;
#ifdef MONOMIAL
            if (active_count > before) monomial_enter(active_chord(before), active_strength(before), s);
#endif
        }
        if (next == window_count && window_more) {
            refilled = true;
            window_load(ray, head, window_entry[WINDOW_MAX - 1], window_ball[WINDOW_MAX - 1]);
            next = 0;
            continue;
        }
        if (active_count == 0) {
            if (next == window_count) break;
            continue;
        }
        if (s >= limit) break;
        float stop = next < window_count ? min(active_end, window_entry[next]) : active_end;
#ifdef MIDDLES
        stop = piece_stop(s, stop);
#endif
        float hit;
        found = piece_solve(s, stop, SIDE, ROOT_STEPS, hit);
        if (found != PIECE_NONE) {
            s = hit;
            if (found == PIECE_HIT && s > limit) found = PIECE_NONE;
            break;
        }
#ifdef MONOMIAL
        monomial_pass(s, stop);
#endif
        s = stop;
        if (active_end <= s) active_drop(s);
    }
    return found;
}

void main()
{
    vec2 position = gl_FragCoord.xy;
    uint head = imageLoad(list_heads, ivec2(position)).x;
    Pixel pixel = pixel_miss(true);
    if (head != NO_NODE) {
        Ray ray = view_ray(position);
        float limit = FAR_AWAY;
#ifdef HOST_DEPTH
        limit = host_limit(position);
#endif
        float t;
        bool refilled;
        int found = cast_walk(ray, head, limit, t, refilled);
        if (refilled) atomicAdd(count_refilled, 1u);
        if (found == PIECE_HIT) {
            Surface surface = surface_at(ray, t);
#if SOLVER == SOLVER_EXACT
            // A Newton step that is not small is no correction: double shall decide.
            if (!(abs(surface.shift) <= 1.0e-2 * surface.radius)) found = PIECE_OPEN;
#else
            surface.shift = 0.0;
#endif
            pixel.t = pixel_distance(position, t, surface.shift);
            pixel.normal = vec4(surface.normal, 1.0);
            pixel.color = surface.color;
        }
        if (found == PIECE_OPEN)
            redo_add(position, REDO_FLOAT);
        else if (found == PIECE_CAP)
            redo_add(position, active_overflow ? REDO_ACTIVE : REDO_STEPS);
    }
    out_t = pixel.t;
    out_normal = pixel.normal;
#ifdef COLORS
    out_color = pixel.color;
#endif
}
