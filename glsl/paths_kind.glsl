// Whether the place that a walk is at belongs to the surface or to a mesh.
#ifdef SOLIDS
bool place_solid = false;    // a mesh's: all of it is shaded, and no root tells a side to the rays that leave it
bool path_met_solid = false; // so is what path_use is told of

// A mesh does not tell on which side of the surface it is met: as where the ray began.
bool place_within(uint path, REAL3 way)
{
    if (path != 1u) return path_inwards;
    return path_size.z == 1 || (path_size.z == 2 && dot(vec3(eye_slope.xyz), vec3(way)) > 0.0);
}
#else
const bool place_solid = false;
#endif

// Whether path_ray leaves the surface, and not a mesh.
bool path_on_surface()
{
    return place_path == 0u || !place_solid;
}
