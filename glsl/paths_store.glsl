// Walks that wait for another dispatch. Whatever list of redo_entry a walk is on (path_lists), it has
// the slot of the store that it was given in the first; an entry is x + 65536 y, the slot with the flags below, and where a walk along a
// ray in doubles has come to, as bits.

layout(std430, binding = 7) buffer PathStore {
    uvec4 path_store[];
};

const uint ENTRY_ALONE = 0x80000000u; // one ray a dispatch
const uint ENTRY_HELD = 0x40000000u;  // the walk is in the store; else it has not been begun
const uint ENTRY_SLOT = 0x3fffffffu;

void entry_wait(uvec4 entry) { redo_entry[path_lists.y + atomicAdd(count_steps, 1u)] = entry; }
void entry_wait_double(uvec4 entry) { redo_entry[path_lists.z + atomicAdd(count_float, 1u)] = entry; }

const uint STORE_WALK = 11u;
const uint STORE_SIZE = STORE_WALK + 3u * uint(PATH_STACK);

uvec4 store_bits(vec3 v, float w) { return floatBitsToUint(vec4(v, w)); }

void path_save(uint slot)
{
    uint at = (slot & ENTRY_SLOT) * STORE_SIZE;
    uint flags = (path_doubt ? 1u : 0u) | (place_inside ? 2u : 0u) | uint(path_asks) << 2u;
    path_store[at] = store_bits(path_color, place_shadow);
    path_store[at + 1u] = floatBitsToUint(path_terms);
    path_store[at + 2u] = uvec4(uint(path_top), place_path, place_light, place_sample);
    path_store[at + 3u] = uvec4(place_left, flags, floatBitsToUint(place_seen));
    path_store[at + 4u] = store_bits(vec3(place_at), place_mirrored);
    path_store[at + 5u] = store_bits(vec3(place_normal), place_solid ? 1.0 : 0.0);
    path_store[at + 6u] = store_bits(vec3(place_viewer), 0.0);
    path_store[at + 7u] = store_bits(place_albedo, place_weight);
    path_store[at + 8u] = store_bits(place_share, 0.0);
    path_store[at + 9u] = store_bits(place_shaded, 0.0);
    path_store[at + 10u] = store_bits(place_shine, 0.0);
#ifdef PATHS_ON
    at += STORE_WALK;
    for (int i = 0; i < path_top; i++) {
        path_store[at] = uvec4(floatBitsToUint(wait_at[i]), wait_rest[i].x);
        path_store[at + 1u] = uvec4(floatBitsToUint(wait_way[i]), wait_rest[i].y | wait_rest[i].z << 8u | wait_rest[i].w << 16u);
#ifdef MATERIALS
        path_store[at + 2u] = store_bits(wait_share[i], wait_weight[i]);
#else
        path_store[at + 2u] = store_bits(wait_share[i], 0.0);
#endif
        at += 3u;
    }
#endif
}

vec3 store_vector(uint at) { return uintBitsToFloat(path_store[at].xyz); }

void path_load(ivec2 pixel, uint slot)
{
    path_open(pixel);
    uint at = (slot & ENTRY_SLOT) * STORE_SIZE;
    uvec4 flow = path_store[at + 2u];
    uvec4 rest = path_store[at + 3u];
    path_color = store_vector(at);
    place_shadow = uintBitsToFloat(path_store[at].w);
    path_terms = uintBitsToFloat(path_store[at + 1u]);
    path_top = int(flow.x);
    place_path = flow.y;
    place_light = flow.z;
    place_sample = flow.w;
    place_left = rest.xy;
    path_doubt = (rest.z & 1u) != 0u;
    place_inside = (rest.z & 2u) != 0u;
    PATH_ASKS(int(rest.z >> 2u));
    place_seen = uintBitsToFloat(rest.w);
    place_at = REAL3(store_vector(at + 4u));
    place_mirrored = uintBitsToFloat(path_store[at + 4u].w);
    place_normal = REAL3(store_vector(at + 5u));
#ifdef SOLIDS
    place_solid = path_store[at + 5u].w != 0u;
#endif
    place_viewer = REAL3(store_vector(at + 6u));
    place_albedo = store_vector(at + 7u);
#ifdef MATERIALS
    place_weight = uintBitsToFloat(path_store[at + 7u].w);
#endif
    place_share = store_vector(at + 8u);
    place_shaded = store_vector(at + 9u);
    place_shine = store_vector(at + 10u);
#ifdef PATHS_ON
    at += STORE_WALK;
    for (int i = 0; i < path_top; i++) {
        uvec4 one = path_store[at];
        uvec4 two = path_store[at + 1u];
        wait_at[i] = uintBitsToFloat(one.xyz);
        wait_way[i] = uintBitsToFloat(two.xyz);
        wait_share[i] = store_vector(at + 2u);
#ifdef MATERIALS
        wait_weight[i] = uintBitsToFloat(path_store[at + 2u].w);
#endif
        wait_rest[i] = uvec4(one.w, two.w & 0xffu, two.w >> 8u & 0xffu, two.w >> 16u);
        at += 3u;
    }
#endif
}
