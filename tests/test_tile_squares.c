/* The squares that a cast runs for, by brute force: each pixel of a listed tile lies in one of them, none in
 * two, and every cell of the least size in them holds a listed tile. */
#include "support/draw_fixture.h"
#include "tile/tile.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

typedef struct grid {
    int width, height, shift;
    double share; /* of tiles that are listed */
} grid;

static const grid grids[] = {
    {64, 64, 3, 1},     {65, 63, 3, 1},     {1, 1, 2, 1},         {1, 1, 2, 0},        {300, 1, 2, 0.5},
    {1, 300, 3, 0.5},   {640, 480, 3, 0},   {640, 480, 3, 0.5},   {640, 480, 2, 0.99}, {333, 222, 2, 0.1},
    {333, 222, 4, 0.8}, {200, 333, 5, 0.6}, {128, 128, 2, 0.999}, {127, 129, 3, 0.95},
};

static tile_bins make(const grid *g)
{
    tile_bins bins = {.region = {7, 9, g->width, g->height}, .shift = g->shift};
    mns_error error;
    uint64_t random = 5;
    bins.across = (g->width + (1 << g->shift) - 1) >> g->shift;
    bins.down = (g->height + (1 << g->shift) - 1) >> g->shift;
    size_t tiles = (size_t)bins.across * (size_t)bins.down;
    bins.length = calloc(tiles, sizeof *bins.length);
    assert_non_null(bins.length);
    for (size_t i = 0; i < tiles; i++) bins.length[i] = draw_random(&random) < g->share ? 3 : 0;
    if (tile_squares_make(&bins, &error)) fail_msg("%s", error.text);
    return bins;
}

static bool listed(const tile_bins *bins, int x, int y)
{
    return bins->length[(size_t)(y >> bins->shift) * (size_t)bins->across + (size_t)(x >> bins->shift)];
}

/* Counts the pixels of a cell of the least size within the region into `covered`; whether any is listed. */
static bool count_cell(const tile_bins *bins, int x0, int y0, int least, uint8_t *covered)
{
    bool some = false;
    for (int y = y0; y < y0 + least && y < bins->region.height; y++)
        for (int x = x0; x < x0 + least && x < bins->region.width; x++) {
            covered[(size_t)y * (size_t)bins->region.width + (size_t)x]++;
            some = some || listed(bins, x, y);
        }
    return some;
}

static void expect_cover(const grid *g)
{
    tile_bins bins = make(g);
    int least = g->shift > 3 ? 1 << g->shift : 8;
    uint8_t *covered = calloc((size_t)g->width * (size_t)g->height, 1);
    assert_non_null(covered);
    for (size_t i = 0; i < bins.square_count; i++) {
        tile_square square = bins.square[i];
        assert_true(square.side >= least && square.side <= SQUARE_MOST && square.x % square.side == 0 &&
                    square.y % square.side == 0);
        for (int y = square.y; y < square.y + square.side && y < g->height; y += least)
            for (int x = square.x; x < square.x + square.side && x < g->width; x += least)
                assert_true(count_cell(&bins, x, y, least, covered));
    }
    for (int y = 0; y < g->height; y++)
        for (int x = 0; x < g->width; x++) {
            uint8_t count = covered[(size_t)y * (size_t)g->width + (size_t)x];
            assert_true(count == 1 || (count == 0 && !listed(&bins, x, y)));
        }
    if (g->share == 0) assert_int_equal(bins.square_count, 0);
    free(covered), free(bins.length);
    bins.length = NULL;
    tile_bins_free(&bins);
}

static void squares_hold_the_listed_tiles(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof grids / sizeof *grids; i++) expect_cover(&grids[i]);
}

/* A frame that is filled takes the largest squares, and no more than those. */
static void a_filled_frame_takes_few(void **state)
{
    (void)state;
    tile_bins bins = make(&(grid){640, 480, 3, 1});
    assert_int_equal(bins.square_count, 10 * 8);
    free(bins.length);
    bins.length = NULL;
    tile_bins_free(&bins);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(squares_hold_the_listed_tiles),
        cmocka_unit_test(a_filled_frame_takes_few),
    };
    return cmocka_run_group_tests_name("tile squares", tests, NULL, NULL);
}
