/* A set of triangles from those of its files: corners joined, neighbours found. */
#include "solid/solid.h"

#include "base/memory.h"
#include "base/status.h"

#include <string.h>

/* ---- As they come ---- */

void solid_soup_free(solid_soup *soup)
{
    free(soup->corner);
    free(soup->mesh);
    *soup = (solid_soup){0};
}

static bool has_area(const vec3 corner[3])
{
    vec3 u = vec3_sub(corner[1], corner[0]), v = vec3_sub(corner[2], corner[0]);
    double size = fmax(vec3_length(u), vec3_length(v));
    if (!(size > 0)) return false;
    return vec3_length(vec3_cross(vec3_scale(u, 1 / size), vec3_scale(v, 1 / size))) > 0;
}

static bool reserve(solid_soup *soup)
{
    size_t capacity = soup->capacity ? 2 * soup->capacity : 1024;
    if (soup->count < soup->capacity) return true;
    double(*corner)[3] = memory_resize(soup->corner, 3 * capacity, sizeof *corner);
    if (corner) soup->corner = corner;
    uint32_t *mesh = corner ? memory_resize(soup->mesh, capacity, sizeof *mesh) : NULL;
    if (!mesh) return false;
    soup->mesh = mesh;
    soup->capacity = capacity;
    return true;
}

mns_status solid_soup_add(solid_soup *soup, vec3 corner[3], uint32_t mesh, const char *file, mns_error *error)
{
    if (!has_area(corner)) {
        soup->dropped++;
        return MNS_OK;
    }
    if (soup->count == SOLID_MOST)
        return status_fail(error, MNS_ERROR_UNSUPPORTED,
                           "%s: the meshes have more than %d triangles together; expected fewer", file,
                           SOLID_MOST);
    if (!reserve(soup)) return status_no_memory(error, "while reading a mesh");
    for (size_t k = 0; k < 3; k++) vec3_store(soup->corner[3 * soup->count + k], corner[k]);
    soup->mesh[soup->count++] = mesh;
    return MNS_OK;
}

/* ---- Joined ---- */

static uint64_t hash_of(const double place[3])
{
    uint64_t h = 0x9e3779b97f4a7c15u;
    for (int a = 0; a < 3; a++) {
        uint64_t word;
        memcpy(&word, &place[a], sizeof word);
        h = (h ^ word) * 0xff51afd7ed558ccdu;
        h ^= h >> 32;
    }
    return h;
}

/* One corner for each place, however many triangles meet there. */
static bool join_corners(const solid_soup *soup, double unit, solid_set *set)
{
    size_t slots = 16, corners = 3 * soup->count;
    while (slots < 2 * corners) slots *= 2;
    uint32_t *table = memory_array(slots, sizeof *table); /* 1 + a corner, 0: free */
    set->corner = memory_array(corners, sizeof *set->corner);
    if (!table || !set->corner) {
        free(table);
        return false;
    }
    memset(table, 0, slots * sizeof *table);
    for (size_t i = 0; i < corners; i++) {
        double place[3];
        for (int a = 0; a < 3; a++) place[a] = soup->corner[i][a] / unit + 0.0; /* -0 is 0 */
        size_t slot = hash_of(place) & (slots - 1);
        while (table[slot] && memcmp(set->corner[table[slot] - 1], place, sizeof place))
            slot = (slot + 1) & (slots - 1);
        if (!table[slot]) {
            memcpy(set->corner[set->corner_count++], place, sizeof place);
            table[slot] = (uint32_t)set->corner_count;
        }
        set->triangle[i / 3].corner[i % 3] = table[slot] - 1;
        set->triangle[i / 3].mesh = soup->mesh[i / 3];
    }
    free(table);
    return true;
}

typedef struct half_edge {
    uint32_t low, high; /* corners */
    uint32_t triangle, side;
} half_edge;

static int by_corners(const void *a, const void *b)
{
    const half_edge *x = a, *y = b;
    if (x->low != y->low) return x->low < y->low ? -1 : 1;
    return (x->high > y->high) - (x->high < y->high);
}

static uint32_t opposite(const solid_set *set, const half_edge *e)
{
    return set->triangle[e->triangle].corner[(e->side + 2) % 3];
}

/* An edge that exactly two triangles share tells each the other's third corner. */
static bool find_neighbours(solid_set *set)
{
    size_t count = 3 * set->triangle_count;
    half_edge *edge = memory_array(count, sizeof *edge);
    if (!edge) return false;
    for (size_t i = 0; i < count; i++) {
        solid_triangle *t = &set->triangle[i / 3];
        uint32_t side = (uint32_t)(i % 3), a = t->corner[side], b = t->corner[(side + 1) % 3];
        edge[i] = (half_edge){a < b ? a : b, a < b ? b : a, (uint32_t)(i / 3), side};
        t->beside[side] = SOLID_ALONE;
    }
    qsort(edge, count, sizeof *edge, by_corners);
    for (size_t i = 0, past; i < count; i = past) {
        for (past = i + 1; past < count && !by_corners(&edge[i], &edge[past]);) past++;
        if (past - i != 2) continue;
        set->triangle[edge[i].triangle].beside[edge[i].side] = opposite(set, &edge[i + 1]);
        set->triangle[edge[i + 1].triangle].beside[edge[i + 1].side] = opposite(set, &edge[i]);
    }
    free(edge);
    return true;
}

mns_status solid_set_make(const solid_soup *soup, double unit, solid_set *set, mns_error *error)
{
    *set = (solid_set){.triangle_count = soup->count, .dropped = soup->dropped};
    set->triangle = memory_array(soup->count, sizeof *set->triangle);
    if (!set->triangle || !join_corners(soup, unit, set) || !find_neighbours(set) || !solid_tree_build(set)) {
        solid_set_free(set);
        return status_no_memory(error, "while reading meshes");
    }
    if (set->node_count) {
        memcpy(set->lo, set->node->lo, sizeof set->lo);
        memcpy(set->hi, set->node->hi, sizeof set->hi);
    }
    return MNS_OK;
}

void solid_set_free(solid_set *set)
{
    free(set->corner);
    free(set->triangle);
    free(set->node);
    *set = (solid_set){0};
}
