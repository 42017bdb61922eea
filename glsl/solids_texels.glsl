// The meshes beside the surface as the GPU has them.

// Texels of four words: of each node its box, rounded outwards, with its first child or triangle (lo.w) and its count of triangles (hi.w,
// 0: inner); of each triangle its corners and its mesh, and the corners beyond its edges; of each corner its place as two floats an axis;
// of each mesh its colour. path_solids tells where the last three begin, and how many nodes there are.
layout(binding = 10) uniform usamplerBuffer solid_texels;

// Linear light.
vec3 solid_color(uint mesh)
{
    return uintBitsToFloat(texelFetch(solid_texels, int(path_solids.z + mesh)).rgb);
}
