/* molecule: a folded chain of residues of five atoms (N, CA, C, O, CB) at bond lengths. The CA atoms sit 3.8
 * apart on the cells of a Hilbert curve, which folds without meeting itself; between two of them C and N lie
 * in a plane that the seed turns about the step by quarter turns. Bonds: CA-C 1.52, C-N 1.33, N-CA 1.46,
 * C-O 1.23, CA-CB 1.53 angstroms. Radii are van der Waals radii, where a lone atom's surface shall lie. */
#include "load/element.h"
#include "load/generate.h"

#include <math.h>
#include <string.h>

enum { ATOMS = 5, C_ELEMENT = 0, N_ELEMENT, O_ELEMENT };

static const char *const elements[] = {"C", "N", "O", NULL};
static const double step = 3.8;

/* Cell `index` of the Hilbert curve in a cube of 2^bits a side (J. Skilling, "Programming the Hilbert curve",
 * 2004). */
static void hilbert_cell(uint64_t index, int bits, int64_t cell[3])
{
    uint64_t x[3] = {0};
    for (int b = 0; b < bits; b++)
        for (int k = 0; k < 3; k++) x[2 - k] |= (index >> (3 * b + k) & 1) << b;
    uint64_t carry = x[2] >> 1;
    for (int k = 2; k > 0; k--) x[k] ^= x[k - 1];
    x[0] ^= carry;
    for (uint64_t q = 2; q != (uint64_t)1 << bits; q <<= 1)
        for (int k = 2; k >= 0; k--) {
            uint64_t low = q - 1, swap = (x[0] ^ x[k]) & low;
            if (x[k] & q)
                x[0] ^= low;
            else
                x[0] ^= swap, x[k] ^= swap;
        }
    for (int k = 0; k < 3; k++) cell[k] = (int64_t)x[k];
}

static void prepare_molecule(generate_frame *f)
{
    (void)f; /* every length is given */
}

/* The step from residue r to r + 1 and a direction across it. */
static void step_frame(const generate_frame *f, uint64_t residue, double from[3], double along[3],
                       double across[3])
{
    int64_t a[3], b[3];
    hilbert_cell(residue, 20, a);
    hilbert_cell(residue + 1, 20, b);
    int axis = 0;
    for (int k = 0; k < 3; k++) {
        from[k] = step * (double)a[k];
        along[k] = (double)(b[k] - a[k]);
        across[k] = 0;
        if (a[k] != b[k]) axis = k;
    }
    double turn = generate_random(f, residue, 0);
    across[(axis + (turn < 0.5 ? 1 : 2)) % 3] = turn < 0.25 || turn >= 0.75 ? 1 : -1;
}

/* u along the step, v across it, w perpendicular to both. */
static void put(double at[3], const double from[3], const double along[3], const double across[3], double u,
                double v, double w)
{
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        at[k] = from[k] + u * along[k] + v * across[k] + w * (along[i] * across[j] - along[j] * across[i]);
    }
}

static void place_molecule(const generate_frame *f, uint64_t index, generate_ball *ball)
{
    /* In the plane of a step, CA at (0, 0) and the next at (3.8, 0). */
    static const double place_n[2] = {2.3891, -0.3754}, place_c[2] = {1.4200, 0.5423},
                        place_o[2] = {1.2200, 1.7559};
    static const int element[ATOMS] = {N_ELEMENT, C_ELEMENT, C_ELEMENT, O_ELEMENT, C_ELEMENT};
    static const double radius[] = {1.70, 1.55, 1.52}; /* as element.c has them */
    uint64_t residue = index / ATOMS;
    double from[3], along[3], across[3];
    /* The nitrogen belongs to the step before. */
    step_frame(f, index % ATOMS == 0 ? residue : residue + 1, from, along, across);
    switch (index % ATOMS) {
    case 0:
        put(ball->at, from, along, across, place_n[0], place_n[1], 0);
        break;
    case 1:
        put(ball->at, from, along, across, 0, 0, 0);
        break;
    case 2:
        put(ball->at, from, along, across, place_c[0], place_c[1], 0);
        break;
    case 3:
        put(ball->at, from, along, across, place_o[0], place_o[1], 0);
        break;
    default:
        put(ball->at, from, along, across, -0.5, -0.6, 1.3153);
        break;
    }
    ball->extra = element[index % ATOMS];
    ball->radius = radius[element[index % ATOMS]];
}

const generate_shape generate_molecule = {.name = "molecule",
                                          .column = "element",
                                          .labels = elements,
                                          .radius_is_surface = true,
                                          .prepare = prepare_molecule,
                                          .place = place_molecule};
