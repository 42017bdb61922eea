// A pixel's walk, begun from the planes and written to them.

void finish(ivec2 at)
{
    if (path_doubt) atomicAdd(count_undecided, 1u);
    paths_write(at, vec4(path_color, 1.0), path_terms, !path_doubt);
}

void begin(ivec2 at)
{
#ifdef BLENDS
    vec4 blend = texelFetch(plane_color, at, 0);
#else
    vec4 blend = vec4(0.0);
#endif
#ifdef SOLIDS
    uint mesh = texelFetch(plane_mesh, at, 0).x;
#else
    const uint mesh = 0u;
#endif
    path_begin(at, texelFetch(plane_t, at, 0).xy, texelFetch(plane_normal, at, 0).xyz, blend, mesh);
}
