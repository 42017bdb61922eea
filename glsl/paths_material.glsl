// What the surface's material does where a walk is, and on the way there: the look's, or it and a second one as its balls blend them
// (MATERIALS).

#ifdef MATERIALS
float place_weight = 0.0;    // of the second material
float path_weight = 0.0;     // and on the way here, where that is inside
float path_met_weight = 0.0; // and where path_use is told of
#ifdef PATHS_ON
float wait_weight[PATH_STACK]; // and where the rays that wait begin
#endif
#else
const float place_weight = 0.0;
#endif

// Tells path_use what balls were met, as they blend.
void path_met(vec4 blend)
{
#ifdef MATERIALS
    path_met_weight = lighting_weight(blend);
#endif
}

// The place is the first hit.
void place_weigh_first(vec4 blend)
{
#ifdef MATERIALS
    place_weight = place_solid ? 0.0 : lighting_weight(blend);
    path_weight = place_weight; // the eye is of no material
#endif
}

#ifdef PATHS_ON
// A ray that waits begins at the place.
void wait_weigh(int wait)
{
#ifdef MATERIALS
    wait_weight[wait] = place_weight;
#endif
}

// The place is what such a ray has met.
void place_weigh_met(int wait)
{
#ifdef MATERIALS
    place_weight = place_solid ? 0.0 : path_met_weight;
    path_weight = place_solid ? wait_weight[wait] : 0.5 * (wait_weight[wait] + place_weight);
#endif
}
#endif

// Shares: mirrored at any angle; of the rest, what goes through.
float place_mirror()
{
#ifdef MATERIALS
    return lighting_between(float(path_optics.x), second_optics.x, place_weight);
#else
    return float(path_optics.x);
#endif
}

float place_transmission()
{
#ifdef MATERIALS
    return lighting_between(float(path_optics.z), second_optics.y, place_weight);
#else
    return float(path_optics.z);
#endif
}

// What is left of light on its way inside.
vec3 path_absorbed(REAL way)
{
#if defined(ABSORPTION) && defined(MATERIALS)
    return exp(-lighting_between(path_absorption.rgb, second_absorption.rgb, path_weight) * float(way));
#elif defined(ABSORPTION)
    return exp(-path_absorption.rgb * float(way));
#else
    return vec3(1.0);
#endif
}
