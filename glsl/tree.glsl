// A tree of boxes over the balls (Gourmel et al. 2010), and the walk of a ray from leaf to leaf.
//
// A pair is two siblings: of each the box on a grid of 65,536 steps an axis, rounded outwards, and a link. A leaf has its box in
// floats and a run of references to balls. The walk goes by the grid, which costs half the memory traffic; what is known of a
// leaf holds in its own box alone, and rays are cut by that.

#ifdef TREE_TEXELS
layout(binding = 3) uniform usamplerBuffer tree_pair_texels;
layout(binding = 4) uniform usamplerBuffer tree_leaf_texels;
layout(binding = 5) uniform usamplerBuffer tree_reference_texels;
uvec4 tree_pair(uint at) { return texelFetch(tree_pair_texels, int(at)); }
uvec4 tree_leaf(uint at) { return texelFetch(tree_leaf_texels, int(at)); }
uint tree_reference(uint at) { return texelFetch(tree_reference_texels, int(at)).x; }
#else
layout(std430, binding = 2) readonly buffer TreePairs {
    uvec4 tree_pairs[];
};
layout(std430, binding = 5) readonly buffer TreeLeaves {
    uvec4 tree_leaves[];
};
layout(std430, binding = 6) readonly buffer TreeReferences {
    uint tree_references[];
};
uvec4 tree_pair(uint at) { return tree_pairs[at]; }
uvec4 tree_leaf(uint at) { return tree_leaves[at]; }
uint tree_reference(uint at) { return tree_references[at]; }
#endif

// A link: LINK_LEAF and the leaf's number, or a pair's number, and in the first of a pair the axis along which the siblings lie one
// after the other, the first one low.
const uint LINK_LEAF = 0x80000000u;
const uint LINK_PLACE = 0x1fffffffu;
const uint LINK_NONE = 0xffffffffu;
const uint REFERENCE_SPLIT = 0x80000000u; // a split ball of the leaf, not one of its own
const uint REFERENCE_BALL = 0x7fffffffu;

layout(location = 0) uniform vec3 tree_base;  // grid coordinate 0, less nothing: relative to the origin
layout(location = 1) uniform vec3 tree_cell;  // a step of the grid
layout(location = 2) uniform uint tree_root;  // a link, or LINK_NONE

// What a ray's slabs need: planes are entered at coordinate x where x * scale + (towards or away). Both are moved outwards by what
// rounding can do to a position along the ray, and no direction is zero, so that no slab is 0 * infinity.
vec3 tree_inverse = vec3(0.0);
vec3 tree_scale = vec3(0.0);
vec3 tree_enter = vec3(0.0);
vec3 tree_leave = vec3(0.0);
vec3 tree_start = vec3(0.0);
vec3 tree_slack = vec3(0.0); // of ray parameters, an axis
uvec3 tree_low_shift = uvec3(0u); // where the plane that is entered stands in a pair's words, and that which is left
uvec3 tree_high_shift = uvec3(0u);
uint tree_signs = 0u; // bit k: the ray runs down axis k

void tree_aim(vec3 start, vec3 way)
{
    vec3 size = 65535.0 * tree_cell + abs(tree_base - start);
    float slack = 1.0e-6 * max(size.x, max(size.y, size.z));
    bvec3 down = lessThan(way, vec3(0.0));
    vec3 safe = max(abs(way), vec3(1.0e-9));
    tree_inverse = mix(vec3(1.0), vec3(-1.0), down) / safe;
    tree_start = start;
    tree_slack = slack * abs(tree_inverse);
    tree_scale = tree_cell * tree_inverse;
    vec3 base = (tree_base - start) * tree_inverse;
    tree_enter = base - tree_slack;
    tree_leave = base + tree_slack;
    tree_low_shift = 16u * uvec3(down);
    tree_high_shift = uvec3(16u) - tree_low_shift;
    tree_signs = uint(down.x) | uint(down.y) << 1u | uint(down.z) << 2u;
}

// Whether the ray meets a box of the grid between from and to.
bool tree_meets(uvec3 box, float from, float to)
{
    vec3 enter = vec3((box >> tree_low_shift) & 0xffffu) * tree_scale + tree_enter;
    vec3 leave = vec3((box >> tree_high_shift) & 0xffffu) * tree_scale + tree_leave;
    float begin = max(max(enter.x, enter.y), max(enter.z, from));
    float end = min(min(leave.x, leave.y), min(leave.z, to));
    return begin <= end;
}

uint tree_stack[TREE_DEPTH];
int tree_top = 0; // entries in use
uint tree_link = LINK_NONE; // where the walk is; LINK_NONE: at its end

void tree_begin()
{
    tree_top = 0;
    tree_stack[0] = LINK_NONE;
    tree_link = tree_root;
}

// Leaves the link behind, and goes on to what was put off last.
void tree_next()
{
    tree_top--;
    tree_link = tree_top < 0 ? LINK_NONE : tree_stack[max(tree_top, 0)];
}

bool tree_inner()
{
    return tree_link < LINK_LEAF;
}

// From a pair to the sibling that the ray meets first, the other put off.
void tree_step(float from, float to)
{
    uint at = 2u * (tree_link & LINK_PLACE);
    uvec4 low = tree_pair(at);
    uvec4 high = tree_pair(at + 1u);
    bool meets_low = tree_meets(low.xyz, from, to);
    bool meets_high = tree_meets(high.xyz, from, to);
    bool down = (tree_signs >> (low.w >> 29u & 3u) & 1u) != 0u;
    uint low_link = low.w & ~0x60000000u;
    uint first = down ? high.w : low_link;
    uint second = down ? low_link : high.w;
    if (meets_low && meets_high) {
        tree_stack[tree_top] = second;
        tree_top++;
        tree_link = first;
    } else if (meets_low || meets_high) {
        tree_link = meets_low ? low_link : high.w;
    } else {
        tree_next();
    }
}

// A leaf's references [first, past) and the stretch of the ray in its box; empty where begin > end.
struct Leaf {
    uint first, past;
    float begin, end;
};

Leaf tree_leaf_at(uint link, float from, float to)
{
    uint at = 2u * (link & LINK_PLACE);
    uvec4 one = tree_leaf(at);
    uvec4 two = tree_leaf(at + 1u);
    vec3 a = (uintBitsToFloat(one.xyz) - tree_start) * tree_inverse;
    vec3 b = (uintBitsToFloat(two.xyz) - tree_start) * tree_inverse;
    vec3 enter = min(a, b) - tree_slack;
    vec3 leave = max(a, b) + tree_slack;
    Leaf leaf;
    leaf.first = one.w;
    leaf.past = one.w + two.w;
    leaf.begin = max(max(enter.x, enter.y), max(enter.z, from));
    leaf.end = min(min(leave.x, leave.y), min(leave.z, to));
    return leaf;
}
