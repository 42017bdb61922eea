// What light's ways beyond the first hit are read from and written to. One invocation a pixel of a region (effects_list.glsl), or an
// entry of a list.

layout(local_size_x = 64) in;
layout(location = 3) uniform ivec4 path_region; // x, y, past x, past y
layout(binding = 6) uniform sampler2D plane_t;
layout(binding = 7) uniform sampler2D plane_normal;
#ifdef BLENDS
layout(binding = 8) uniform sampler2D plane_color;
#endif
#ifdef SOLIDS
layout(binding = 11) uniform usampler2D plane_mesh;
#endif
layout(binding = 1, rgba32f) writeonly uniform image2D plane_lit;
layout(binding = 2, rgba32f) writeonly uniform image2D plane_terms;
layout(binding = 3, r32f) writeonly uniform image2D plane_settled;
#ifdef RAYS_NOW
layout(location = 4) uniform uvec4 path_lists; // of redo_entry: this dispatch's first, where those go that wait in float, and those for
                                               // doubles; how many are this dispatch's
#endif

void paths_write(ivec2 at, vec4 lit, vec4 terms, bool settled)
{
    imageStore(plane_lit, at, lit);
    imageStore(plane_terms, at, terms);
    if (!settled) imageStore(plane_settled, at, vec4(0.0)); // it was cleared to 1
}

uint path_index()
{
    return (gl_WorkGroupID.x + gl_WorkGroupID.y * gl_NumWorkGroups.x) * 64u + gl_LocalInvocationIndex;
}
