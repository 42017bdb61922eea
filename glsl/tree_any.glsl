// Whether a ray that leaves the surface meets it again before a limit, by bounds alone: what shadows and the ambient light ask. No
// chord's ends, no slots, no root; what the bounds leave open is told by the cast (tree_cast.glsl). From outside, in a fitted tree.
//
// A leaf's stretch of the ray is cut into parts. In each a ball is nowhere denser than at the place nearest to its centre, so that a
// sum of those below L clears the part; and where at a cut the balls sum to more than L, the ray has met the surface somewhere before.
// At the ray's own start f is L: there the first part is clear where the balls' slopes surely fall together, and the second is clear.

const int ANY_PARTS = 4;
const float ANY_CUTS[ANY_PARTS + 1] = float[](0.0, 0.125, 0.25, 0.5, 1.0);

float any_cut[ANY_PARTS + 1] = float[](0.0, 0.0, 0.0, 0.0, 0.0);
float any_value[ANY_PARTS + 1]; // f there
float any_most[ANY_PARTS];      // and no less than f in the part that begins there
float any_margin = 0.0;         // what rounding may add to any of them
float any_rise = 0.0;           // no less than f's slope in the first part

// No less than the slope of the ball's density between two places, `begin` and `end` from the nearest to its centre: that is
// (k'(v) / v) s / R^2, and k'(v) / v has one hump. u: at the nearest and the farthest place.
float any_ball_rise(float strength, float shrink, float begin, float end, float nearest, float farthest)
{
    float near = -density_slope_over_v(KERNEL, nearest);
    float far = -density_slope_over_v(KERNEL, farthest);
#if KERNEL == DENSITY_PERLIN
    float most = density_curvature_bound(KERNEL, 1.0 - nearest);
#else
    float most = near;
#endif
    float rise = strength > 0.0 ? (begin < 0.0 ? -begin * most : -begin * min(near, far)) : max(abs(begin), abs(end)) * most;
    return abs(strength) * shrink * rise;
}

void any_take(Ray ray, Ball ball, bool first)
{
#ifdef RADII
    float inverse = 1.0 / ball.radius;
#else
    float inverse = level_inverse;
#endif
    float shrink = inverse * inverse;
    float middle;
    vec3 offset = chord_offset(ball.centre - ray.start, ray.way, middle);
    float aside = dot(offset, offset) * shrink;
    float near = clamp(middle, any_cut[0], any_cut[ANY_PARTS]) - middle;
    float widest = 1.0 - aside - near * near * shrink;
    if (!(widest > 0.0)) return;
    float positive = max(ball.strength, 0.0);
    float reach = 3.0 + (any_cut[ANY_PARTS] + view_reach) * inverse;
    any_margin += abs(ball.strength) * density_slope_bound(KERNEL, widest) * reach;
    float peak = density_value(KERNEL, aside);
    float before = 0.0;
    float place = 0.0;
    for (int i = 0; i <= ANY_PARTS; i++) {
        float here = any_cut[i] - middle;
        float u = min(aside + here * here * shrink, 1.0);
        float value = density_value(KERNEL, u);
        any_value[i] += ball.strength * value;
        if (i > 0) any_most[i - 1] += positive * (place < 0.0 && here > 0.0 ? peak : max(before, value));
        if (i == 1 && first) {
            float nearest = place < 0.0 ? min(here, 0.0) : place;
            nearest = min(aside + nearest * nearest * shrink, 1.0);
            float farthest = min(aside + max(place * place, here * here) * shrink, 1.0);
            any_rise += any_ball_rise(ball.strength, shrink, place, here, nearest, farthest);
            any_rise += 2.0 * TAU * abs(ball.strength) * density_curvature_bound(KERNEL, widest) * reach * inverse;
        }
        before = value;
        place = here;
    }
}

// PIECE_NONE: the leaf holds no crossing; PIECE_HIT: there is one in it or before it; PIECE_LATER: bounds do not tell.
int any_leaf(Ray ray, Leaf leaf, bool first)
{
    any_margin = any_rise = 0.0;
    for (int i = 0; i <= ANY_PARTS; i++) {
        any_cut[i] = mix(leaf.begin, leaf.end, ANY_CUTS[i]);
        any_value[i] = 0.0;
        if (i < ANY_PARTS) any_most[i] = 0.0;
    }
    for (uint at = leaf.first; at < leaf.past; at++) any_take(ray, ball_get(tree_reference(at) & REFERENCE_BALL), first);
    float margin = 2.0 * TAU * any_margin;
    float value = any_value[1];
    float most = any_most[1];
    for (int i = 2; i <= ANY_PARTS; i++) value = max(value, any_value[i]);
    for (int i = 2; i < ANY_PARTS; i++) most = max(most, any_most[i]);
    // The start may be off the surface by so much, and a ray that begins inside it has met nothing yet where it still is.
    float off = first ? abs(any_value[0] - level.x) : 0.0;
    bool begun = !first || off <= LEAVE_DOUBT * margin || any_value[0] < level.x;
    float inside = first ? margin + off : LEAVE_DOUBT * margin;
    if (begun && value > level.x + inside) return PIECE_HIT;
    bool leaves = any_rise < 0.0 && off <= LEAVE_DOUBT * margin;
    bool clear = most < level.x - margin - off && (first ? leaves : any_most[0] < level.x - margin);
    return clear ? PIECE_NONE : PIECE_LATER;
}

// The ray's verdict: PIECE_NONE, PIECE_HIT, or PIECE_LATER. The order of leaves does not matter: a hit in any is one.
int tree_any(Ray ray, float limit, out int work)
{
    int found = PIECE_NONE;
    work = 0;
    view_reach = sqrt(dot(ray.start, ray.start));
    tree_aim(ray.start, ray.way);
    tree_begin();
    while (tree_link != LINK_NONE && found != PIECE_HIT && work < WALK_BUDGET) {
        while (tree_inner() && work < WALK_BUDGET) {
            tree_step(0.0, limit);
            work++;
        }
        if (tree_link == LINK_NONE || tree_inner()) break;
        Leaf leaf = tree_leaf_at(tree_link, 0.0, limit);
        if (!(leaf.begin <= leaf.end)) leaf.past = leaf.first;
        work += 1 + int(leaf.past - leaf.first);
        bool first = leaf.begin == 0.0 && path_on_surface(); // on a mesh f is not L: that leaf is as any
        int told = leaf.past > leaf.first ? any_leaf(ray, leaf, first) : PIECE_NONE;
        found = told == PIECE_NONE ? found : told;
        tree_next();
    }
    return work >= WALK_BUDGET ? PIECE_LATER : found;
}
