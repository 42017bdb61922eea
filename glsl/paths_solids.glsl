// What the meshes answer to the ray of a walk.

// `begin`: what the start may be off a mesh that it leaves, of the lengths around.
Solid solid_ask(REAL begin)
{
    REAL3 leaves = path_on_surface() ? REAL3(0.0) : place_normal;
#ifdef MNS_DOUBLE
    const bool fine = false;
#else
    bool fine = path_asks == ASKS_PATH;
#endif
    return solid_cast(path_ray.start, path_ray.way, path_limit, leaves, begin, fine);
}

// So near to each other a mesh and the surface may be met in either order.
REAL solid_gap(Solid solid)
{
    return solid.off + SETTLED * (solid.t + solid_reach);
}

// Whether floats tell how far a path goes that meets a mesh: not where it grazes it, as a mirrored ray a wide floor near its horizon,
// for what its direction is off counts there by the reciprocal of the slant.
bool solid_steep(Solid solid)
{
    return abs(dot(solid.normal, solid_way)) > NUM(0.03125);
}

// Up to where the surface counts.
REAL solid_before(Solid solid)
{
    return solid.hit ? min(path_limit, solid.t + solid_gap(solid)) : path_limit;
}
