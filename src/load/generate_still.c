/* Shapes that do not move: scattered, dense, mixed, sheet. */
#include "load/generate.h"

#include <math.h>

/* ---- scattered: independent in the unit cube, R = 0.8 N^(-1/3): 2.1 spheres over a point ---- */

static void prepare_scattered(generate_frame *f)
{
    f->radius = 0.8 / generate_cbrt(f->count);
}

static void place_scattered(const generate_frame *f, uint64_t index, generate_ball *ball)
{
    for (unsigned k = 0; k < 3; k++) ball->at[k] = generate_random(f, index, k);
}

const generate_shape generate_scattered = {
    .name = "scattered", .prepare = prepare_scattered, .place = place_scattered};

/* ---- mixed: as scattered, radii log-uniform over two decades: R = 10^(-3 + 2 u) (10^4 / N)^(1/3) ---- */

static void prepare_mixed(generate_frame *f)
{
    f->radius = 1e-3 * generate_cbrt(1e4 / f->count);
}

static void place_mixed(const generate_frame *f, uint64_t index, generate_ball *ball)
{
    place_scattered(f, index, ball);
    ball->radius =
        f->radius * generate_exp2(6.643856189774724682 * generate_random(f, index, 3)); /* 2 log2 10 */
}

const generate_shape generate_mixed = {.name = "mixed", .prepare = prepare_mixed, .place = place_mixed};

/* ---- Lattices: as many sites as balls or a few more, left out evenly ---- */

static uint64_t whole_sites(double length)
{
    double sites = floor(length + 0.5);
    return sites < 1 ? 1 : (uint64_t)sites;
}

/* Sites of a box at the frame's spacing, more along `grow` until all balls find one. */
static void make_lattice(generate_frame *f, const double size[3], int grow)
{
    for (int k = 0; k < 3; k++) f->sites[k] = whole_sites(size[k] / f->spacing);
    while (f->sites[0] * f->sites[1] * f->sites[2] < (uint64_t)f->count) f->sites[grow]++;
}

/* The site's middle, moved at random by up to 0.3 spacings along each axis that has more than one layer. */
static void place_on_lattice(const generate_frame *f, const double size[3], uint64_t index, double at[3])
{
    uint64_t sites = f->sites[0] * f->sites[1] * f->sites[2], count = (uint64_t)f->count;
    uint64_t site =
        index * (sites / count) + index * (sites % count) / count; /* floor(index sites / count) */
    uint64_t cell[3] = {site / f->sites[2] / f->sites[1], site / f->sites[2] % f->sites[1],
                        site % f->sites[2]};
    for (int k = 0; k < 3; k++) {
        at[k] = ((double)cell[k] + 0.5) * size[k] / (double)f->sites[k];
        if (size[k] > 0) at[k] += (generate_random(f, index, (unsigned)k) - 0.5) * 0.6 * f->spacing;
    }
}

/* ---- dense: a jittered slab 2 x 0.5 x 1, R = 2 spacings: 4/3 pi 2^3 = 33 spheres over a ball's centre, its
 * own included ---- */

static const double slab[3] = {2, 0.5, 1};

static void prepare_dense(generate_frame *f)
{
    f->spacing = 1 / generate_cbrt(f->count);
    f->radius = 2 * f->spacing;
    make_lattice(f, slab, 0);
}

static void place_dense(const generate_frame *f, uint64_t index, generate_ball *ball)
{
    place_on_lattice(f, slab, index, ball->at);
}

const generate_shape generate_dense = {.name = "dense", .prepare = prepare_dense, .place = place_dense};

/* ---- sheet: one jittered layer over the unit square, R = 2 spacings: y = 0.05 sin(2 pi x) sin(2 pi z) ----
 */

static const double square[3] = {1, 0, 1};

static void prepare_sheet(generate_frame *f)
{
    f->spacing = 1 / sqrt(f->count);
    f->radius = 2 * f->spacing;
    make_lattice(f, square, 0);
}

static void place_sheet(const generate_frame *f, uint64_t index, generate_ball *ball)
{
    place_on_lattice(f, square, index, ball->at);
    ball->at[1] = 0.05 * generate_sine(ball->at[0]) * generate_sine(ball->at[2]);
}

const generate_shape generate_sheet = {.name = "sheet", .prepare = prepare_sheet, .place = place_sheet};
