#include "brute_tree.h"

#include "base/memory.h"

#include <math.h>
#include <string.h>

enum { LEAF_BALLS = 8, STACK_NODES = 128 };

typedef struct node {
    double lo[3], hi[3];
    size_t first, count; /* balls order[first .. first + count) */
    size_t right;        /* index of the right child; the left one follows its parent; 0: a leaf */
} node;

struct brute_tree {
    const mns_field *field;
    size_t *order;
    node *nodes;
    size_t node_count;
};

static void node_fit(const brute_tree *tree, node *n)
{
    for (int a = 0; a < 3; a++) n->lo[a] = INFINITY, n->hi[a] = -INFINITY;
    for (size_t i = n->first; i < n->first + n->count; i++) {
        size_t ball = tree->order[i];
        double r = field_radius(tree->field, ball) * (1 + 1e-12);
        for (int a = 0; a < 3; a++) {
            double p = tree->field->p.axis[a][ball], slack = fabs(p) * 1e-12;
            n->lo[a] = fmin(n->lo[a], p - r - slack);
            n->hi[a] = fmax(n->hi[a], p + r + slack);
        }
    }
}

/* Quickselect: the `half` smallest of `count` indices by `key` come first. */
static void select_half(size_t *order, size_t count, size_t half, const double *key)
{
    size_t lo = 0, hi = count;
    while (hi - lo > 1) {
        double pivot = key[order[lo + (hi - lo) / 2]];
        size_t i = lo, j = hi - 1;
        while (i <= j) {
            while (key[order[i]] < pivot) i++;
            while (key[order[j]] > pivot) j--;
            if (i > j) break;
            size_t swap = order[i];
            order[i++] = order[j], order[j] = swap;
            if (j-- == 0) break;
        }
        if (half <= j && j < hi)
            hi = j + 1;
        else if (half >= i)
            lo = i;
        else
            return;
    }
}

static int longest_axis(const node *n)
{
    int axis = 0;
    for (int a = 1; a < 3; a++)
        if (n->hi[a] - n->lo[a] > n->hi[axis] - n->lo[axis]) axis = a;
    return axis;
}

/* Halves by count, so the depth is the logarithm of the number of balls. */
static void split(brute_tree *tree, size_t first, size_t count)
{
    size_t index = tree->node_count++;
    node *n = &tree->nodes[index];
    *n = (node){.first = first, .count = count};
    node_fit(tree, n);
    if (count <= LEAF_BALLS) return;
    size_t half = count / 2;
    select_half(tree->order + first, count, half, tree->field->p.axis[longest_axis(n)]);
    split(tree, first, half);
    tree->nodes[index].right = tree->node_count;
    split(tree, first + half, count - half);
}

brute_tree *brute_tree_create(const mns_field *field)
{
    brute_tree *tree = calloc(1, sizeof *tree);
    if (!tree) return NULL;
    tree->field = field;
    tree->order = memory_array(field->p.count, sizeof *tree->order);
    tree->nodes = memory_array(field->p.count + 1, sizeof *tree->nodes);
    if (!tree->order || !tree->nodes) {
        brute_tree_destroy(tree);
        return NULL;
    }
    for (size_t i = 0; i < field->p.count; i++) tree->order[i] = i;
    if (field->p.count) split(tree, 0, field->p.count);
    return tree;
}

void brute_tree_destroy(brute_tree *tree)
{
    if (!tree) return;
    free(tree->order);
    free(tree->nodes);
    free(tree);
}

static bool ray_meets_box(const brute_ray *ray, const node *n)
{
    long double from = 0, to = INFINITY;
    for (int a = 0; a < 3; a++) {
        long double o = ray->origin[a], d = ray->direction[a];
        if (d == 0) {
            if (o < n->lo[a] || o > n->hi[a]) return false;
            continue;
        }
        long double x = (n->lo[a] - o) / d, y = (n->hi[a] - o) / d;
        from = fmaxl(from, fminl(x, y));
        to = fminl(to, fmaxl(x, y));
    }
    return from <= to * (1 + 1e-15L);
}

/* False where the ray misses the ball or has it behind. */
static bool chord_of(const mns_field *field, size_t ball, const brute_ray *ray, brute_chord *chord)
{
    long double c[3], middle = 0, away2 = 0, r = field_radius(field, ball);
    for (int a = 0; a < 3; a++) {
        c[a] = field->p.axis[a][ball] - ray->origin[a];
        middle += c[a] * ray->direction[a];
    }
    for (int a = 0; a < 3; a++) {
        long double across = c[a] - middle * ray->direction[a];
        away2 += across * across;
    }
    long double away = sqrtl(away2);
    if (away >= r) return false;
    long double half = sqrtl((r - away) * (r + away));
    *chord = (brute_chord){middle - half, middle + half, middle, away2, ball};
    return chord->exit > 0;
}

static bool chords_push(brute_chords *chords, const brute_chord *chord)
{
    if (chords->count == chords->capacity) {
        size_t capacity = chords->capacity ? 2 * chords->capacity : 64;
        brute_chord *grown = memory_resize(chords->chord, capacity, sizeof *grown);
        if (!grown) return false;
        chords->chord = grown, chords->capacity = capacity;
    }
    chords->chord[chords->count++] = *chord;
    return true;
}

static int by_entry(const void *a, const void *b)
{
    const brute_chord *x = a, *y = b;
    if (x->entry != y->entry) return x->entry < y->entry ? -1 : 1;
    return (x->ball > y->ball) - (x->ball < y->ball);
}

bool brute_tree_collect(const brute_tree *tree, const brute_ray *ray, brute_chords *chords)
{
    size_t stack[STACK_NODES], depth = 0;
    chords->count = 0;
    if (tree->node_count) stack[depth++] = 0;
    while (depth) {
        size_t index = stack[--depth];
        const node *n = &tree->nodes[index];
        if (!ray_meets_box(ray, n)) continue;
        if (n->right) {
            stack[depth++] = index + 1, stack[depth++] = n->right;
            continue;
        }
        for (size_t i = n->first; i < n->first + n->count; i++) {
            brute_chord chord;
            if (chord_of(tree->field, tree->order[i], ray, &chord) && !chords_push(chords, &chord))
                return false;
        }
    }
    if (chords->count) qsort(chords->chord, chords->count, sizeof *chords->chord, by_entry);
    return true;
}
