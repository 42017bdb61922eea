#include "compare/stiff.h"

#include "base/status.h"
#include "compare/stiff_makers.h"

/* The names of the domain's limits, as domain_limit_name gives them; the two that no input tells, as
 * docs/domain.md has them. */
#define RATIO   "radius-ratio"
#define OFFSET  "offset"
#define FAR_EYE "far-eye"
#define STRONG  "strength"
#define CROWDED "active-balls"
#define CANCELS "cancellation"
#define LENGTHS "lengths"

#define POLY2    MNS_KERNEL_POLY2
#define POLY3    MNS_KERNEL_POLY3
#define WYVILL   MNS_KERNEL_WYVILL
#define PERLIN   MNS_KERNEL_PERLIN
#define WENDLAND MNS_KERNEL_WENDLAND

/* A case of poly3, and the same for the kernels that differ from it most: poly2 has the roughest edge, the
 * last two are no polynomials of the distance squared. */
#define ONE(name, why, breaks, flags, make, ...)                                                             \
    {                                                                                                        \
        name, why, breaks, flags, POLY3, make,                                                               \
        {                                                                                                    \
            __VA_ARGS__                                                                                      \
        }                                                                                                    \
    }
#define OTHER(suffix, kernel, name, why, breaks, flags, make, ...)                                           \
    {                                                                                                        \
        name suffix, why, breaks, flags, kernel, make,                                                       \
        {                                                                                                    \
            __VA_ARGS__                                                                                      \
        }                                                                                                    \
    }
#define OTHERS(...)                                                                                          \
    OTHER("/poly2", POLY2, __VA_ARGS__), OTHER("/wyvill", WYVILL, __VA_ARGS__),                              \
        OTHER("/perlin", PERLIN, __VA_ARGS__), OTHER("/wendland", WENDLAND, __VA_ARGS__)
#define ALL(...) ONE(__VA_ARGS__), OTHERS(__VA_ARGS__)

static const stiff_case cases[] = {
    /* Radii far apart. */
    ONE("ratio-1e3-near", "radii over 1e3, seen so near that the smallest are pixels wide", "", 0,
        stiff_ratio_near, 1e3),
    ALL("ratio-1e6-near", "radii over 1e6, seen so near that the smallest are pixels wide", "", 0,
        stiff_ratio_near, 0.49e6),
    ONE("ratio-1e3-far", "radii over 1e3 in one picture, the small ones far thinner than a pixel", "", 0,
        stiff_ratio_far, 1e3),
    ONE("ratio-1e6-far", "radii over 1e6 in one picture, the small ones far thinner than a pixel", "", 0,
        stiff_ratio_far, 0.99e6),
    ONE("ratio-1e8-near", "radii over 1e8: a small ball's slope against a large one's rounding", RATIO, 0,
        stiff_ratio_near, 1e8),

    /* Far from zero. */
    ONE("offset-1e6", "1e6 units from the origin: floats there are half a radius apart", "", 0, stiff_offset,
        1e6, 1),
    ONE("offset-1e9", "1e9 of the smallest radii from the origin: even doubles are coarse", "", 0,
        stiff_offset, 0.99e9 * 0.15, 1),
    OTHER("", WENDLAND, "offset-1e9/wendland", "the same, with a kernel that is no polynomial", "", 0,
          stiff_offset, 0.99e9 * 0.15, 1),
    ONE("offset-1e9-units", "1e9 units from the origin, radii of 1 to 2", "", 0, stiff_offset, 0.99e9, 6.7),
    ONE("offset-1e12", "1e12 radii from the origin: the input's own rounding is a thousandth of a radius",
        OFFSET, 0, stiff_offset, 1e12 * 0.15, 1),

    /* The eye far away. */
    ONE("far-eye-1e3", "the eye 1e3 radii away: float directions miss by a hundredth of a pixel", "", 0,
        stiff_far_eye, 1e3),
    ONE("far-eye-1e4", "the eye 1e4 radii away: float directions miss by a tenth of a pixel", "", 0,
        stiff_far_eye, 1e4),
    ALL("far-eye-1e5", "the eye 1e5 radii away: a float t holds a hundredth of a radius", "", 0,
        stiff_far_eye, 0.99e5),
    ONE("far-eye-1e6", "the eye 1e6 radii away", FAR_EYE, 0, stiff_far_eye, 1e6),

    /* Crowds at one place. */
    ONE("coincident", "10,000 balls with one centre: chords that begin and end at one place", "", 0,
        stiff_coincident, 1e4, 0),
    OTHERS("coincident", "10,000 balls with one centre: chords that begin and end at one place", "",
           STIFF_HEAVY, stiff_coincident, 1e4, 0),
    ONE("nearly-coincident", "10,000 balls within 1e-7 of a radius: in floats their chords tie", "", 0,
        stiff_coincident, 1e4, 1e-7),
    ONE("coincident-deep", "10,000 coincident balls, L at half of their sum: all are active at the hit", "",
        0, stiff_coincident, 1e4, 0, 5e3),
    ONE("active-1000", "1,000 balls active at one point, the hit on their fringe", "", 0, stiff_active, 1e3,
        0.2),
    ONE("active-1000-deep", "1,000 balls active at one point, the hit within", "", 0, stiff_active, 1e3, 200),
    ONE("active-10000", "10,000 balls active at one point, the hit on their fringe", "", 0, stiff_active, 1e4,
        0.2),
    ONE("active-10000-deep", "10,000 balls active at one point, the hit within", "", STIFF_HEAVY,
        stiff_active, 1e4, 2000),
    ONE("active-40000", "40,000 balls active at one point", CROWDED, STIFF_HEAVY, stiff_active, 4e4, 8000),

    /* Levels at the ends. */
    ALL("level-1e-6", "L at 1e-6 of a peak: the surface lies where kernels end in a tangent", "", 0,
        stiff_level, 1e-6),
    ALL("level-0.999999", "L at 0.999999 of a ball's peak: balls of a thousandth of a radius, all curvature",
        "", 0, stiff_level_alone, 0.999999),
    ONE("level-peak", "L at a ball's very peak: f reaches it in a point, and nowhere passes it", "",
        STIFF_TOUCHES, stiff_level_alone, 1),
    ONE("level-above-alone", "L above every ball's peak, and nothing overlaps: nothing is there", "", 0,
        stiff_level_alone, 1.5),
    ALL("level-above", "L above one ball's peak: no ball alone has a core, only sums reach it", "", 0,
        stiff_level, 1.5),

    /* Touches. */
    ALL("silhouettes", "each cell's ray passes a ball's outline by 2^-2 down to 2^-55 of its radius", "",
        STIFF_TOUCHES, stiff_silhouettes, 0),
    ALL("necks", "each cell's ray goes through a neck that closed or parted by 2^-2 down to 2^-55", "",
        STIFF_TOUCHES, stiff_necks, 0),
    ALL("saddles", "each cell's ray crosses a saddle point where f does not even curve along it", "",
        STIFF_TOUCHES, stiff_saddles, 0),
    ALL("rings", "each cell's ray goes through a hole amid four balls that just opens or closes", "",
        STIFF_TOUCHES, stiff_rings, 0),

    /* Thinner than a pixel. */
    ONE("film-face", "a film whose thinnest places hold by 1e-4 of L, seen slantwise", "", 0, stiff_film_face,
        1e-4),
    ONE("film-torn", "the same film, torn by 1e-4 of L", "", 0, stiff_film_face, -1e-4),
    ALL("film-edge", "a film of a few hundredths of a radius seen along its edge, thinner than a pixel", "",
        0, stiff_film_edge, 2e-3),
    ALL("gap", "a gap thinner than a pixel between two slabs: one row of rays looks through", "", 0,
        stiff_gap, 2e-3),
    ONE("gap-inside", "the eye inside a slab: the way out is a gap of 1e-3 of L", "", 0, stiff_gap_inside,
        1e-3),

    /* Strengths. */
    ALL("strengths-1e6", "strengths from 1e-6 to 1e6", "", 0, stiff_strengths, 6),
    ONE("strengths-1e12", "strengths from 1e-12 to 1e12: surfaces where kernels are all but zero", STRONG, 0,
        stiff_strengths, 12),
    ALL("carving", "every third ball carves, as strong as the others", "", 0, stiff_carving, 1),
    ONE("carving-strong", "every third ball carves with five times the strength", "", 0, stiff_carving, 5),
    ONE("cancelling", "pairs of +50 and -49 at one place: sums cancel to a hundredth", "", 0,
        stiff_cancelling, 50, 0),
    ALL("cancelling-beside", "pairs of +50 and -49 a hundredth of a radius apart: thin positive skins", "", 0,
        stiff_cancelling, 50, 0.01),
    ONE("cancelling-1e6", "pairs of +1e6 and -999,999: sums cancel to a millionth", CANCELS, 0,
        stiff_cancelling, 1e6, 0),
    ONE("cancelling-1e12", "pairs of +1e12 and 1 - 1e12: doubles keep four digits of the sum",
        STRONG " " CANCELS, 0, stiff_cancelling, 1e12, 0),

    /* The eye within. */
    ALL("eye-in-ball", "the eye in effective spheres, outside the surface: chords begin before the ray", "",
        0, stiff_eye_in_ball, 0),
    ALL("eye-inside", "the eye inside the surface: the first hit is the way out", "", 0, stiff_eye_inside, 0),
    ONE("eye-at-centre", "the eye at a ball's centre, where a kernel of the distance has no direction", "", 0,
        stiff_eye_at_centre, 0),
    OTHER("", PERLIN, "eye-at-centre/perlin", "the same, with a kernel that is no polynomial", "", 0,
          stiff_eye_at_centre, 0),
    ONE("eye-off-surface", "the eye 1e-6 of a radius outside the surface", "", 0, stiff_eye_on_surface, 1e-6),
    ONE("eye-under-surface", "the eye 1e-6 of a radius under the surface", "", 0, stiff_eye_on_surface,
        -1e-6),
    ONE("eye-on-surface", "f(eye) = L to the last bit: the sign just after decides", "", STIFF_TOUCHES,
        stiff_eye_on_surface, 0),

    /* Frames. */
    ONE("near-plane", "balls on either side of the plane through the eye, all around it", "", 0,
        stiff_near_plane, 0),
    ONE("fov-170", "170 degrees: a pixel at the edge is a hundredth of one in the middle", "", 0,
        stiff_wide_view, 170),
    ONE("fov-179", "179 degrees", "", 0, stiff_wide_view, 179),
    ONE("frame-1x1", "one pixel", "", 0, stiff_frame, 1, 1),
    ONE("frame-8192x4", "four rows of 8192", "", 0, stiff_frame, 8192, 4),
    ONE("one-ball", "one ball", "", 0, stiff_one_ball, 0),
    ONE("no-ball", "none", "", 0, stiff_no_ball, 0),
    ONE("one-pixel", "sixty balls, all inside one pixel", "", 0, stiff_one_pixel, 0),
    ONE("million-in-a-pixel", "1,600,000 balls, all inside one pixel", "", 0, stiff_million, 1.6e6),
    ONE("line-3000", "3,000 balls in a row along a ray that hits the last", "", 0, stiff_line, 3e3),
    ONE("line-30000", "30,000 balls in a row along a ray that hits the last", "", 0, stiff_line, 3e4),

    /* Lengths at what numbers hold. */
    ONE("lengths-1e-15", "radii from 1.5e-15: their fourth powers are no floats", "", 0, stiff_scaled, 1e-14),
    ONE("lengths-1e15", "distances to 7e14: their cubes are no floats", "", 0, stiff_scaled, 2e14),
    ONE("lengths-1e-20", "radii of 1e-21: their squares are no floats", "", 0, stiff_scaled, 1e-20),
    ONE("lengths-1e20", "radii of 1e19: their squares are no floats", "", 0, stiff_scaled, 1e20),
    ONE("lengths-1e-38", "radii at the least that a float holds", LENGTHS, 0, stiff_scaled, 1e-37),
    ONE("lengths-1e38", "radii at the most that a float holds", LENGTHS, 0, stiff_scaled, 1e38),
    ONE("lengths-1e290", "radii whose squares are no doubles", LENGTHS, 0, stiff_scaled, 1e290),
    ONE("lengths-subnormal", "radii that are subnormal doubles", LENGTHS, 0, stiff_scaled, 1e-309),
    ONE("lengths-1e-38-to-1e38", "a radius at either end of a float", RATIO " " OFFSET " " LENGTHS, 0,
        stiff_spread, 1e-38, 1e38),
};

const stiff_case *stiff_cases(size_t *count)
{
    *count = sizeof cases / sizeof *cases;
    return cases;
}

mns_status stiff_build(const stiff_case *which, mns_field **field, mns_view *view, mns_error *error)
{
    stiff_scene scene = {.kernel = which->kernel, .iso = 0.2};
    which->make(&scene, which->number);
    mns_field_desc desc = {.count = scene.count,
                           .position = {.data = scene.position},
                           .radius = {.data = scene.radius},
                           .strength = {.data = scene.strength},
                           .kernel = scene.kernel,
                           .iso = scene.iso};
    mns_field *made = NULL;
    mns_status status = scene.failed ? status_no_memory(error, "building a case of the stiff suite")
                                     : mns_field_create(&desc, &made, error);
    if (!status) status = mns_view_resolve(&scene.view, made, view, error);
    if (!status)
        *field = made;
    else
        mns_field_destroy(made);
    stiff_scene_free(&scene);
    return status;
}
