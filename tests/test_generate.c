/* The generators: counts, the same bits everywhere, overlaps, movement, and what a wrong specification says.
 */
#include "test_load_support.h"

#include "load/generate.h"

static particles make(const char *text, size_t frame)
{
    generate_spec spec;
    particles p = {0};
    mns_error error = {0};
    if (generate_parse(text, &spec, &error) || generate_make(&spec, frame, &p, &error))
        fail_msg("%s", error.text);
    return p;
}

/* FNV-1a over the bits of positions, radii and extra columns. */
static uint64_t checksum(const particles *p)
{
    uint64_t h = 0xcbf29ce484222325u;
    const double *arrays[5] = {p->axis[0], p->axis[1], p->axis[2], p->radius,
                               p->column ? p->column->value : NULL};
    for (int a = 0; a < 5 && arrays[a]; a++)
        for (size_t i = 0; i < p->count; i++) {
            uint64_t bits;
            memcpy(&bits, &arrays[a][i], 8);
            for (int b = 0; b < 8; b++) h = (h ^ (bits >> (8 * b) & 0xff)) * 0x100000001b3u;
        }
    return h;
}

/* The sums were taken once; every machine and compiler must give them. */
static void the_same_bits_on_every_machine(void **state)
{
    (void)state;
    static const struct {
        const char *spec;
        size_t frame;
        uint64_t sum;
    } known[] = {
        {"scattered:1000", 0, 0x5519d57c8873d9cbu},    {"scattered:1000:2", 0, 0x949dd3162d6cb132u},
        {"dense:1000:7", 0, 0x909ec1b5786c0b39u},      {"mixed:1000", 0, 0x5d15f0075bd046a7u},
        {"sheet:1000", 0, 0xae0ac24a35fa241au},        {"molecule:1000:3", 0, 0x197f5c64f8c00373u},
        {"tornado:1000:1:40", 0, 0xdac7313684c956c8u}, {"tornado:1000:1:40", 39, 0xed45df74a91dd37cu},
        {"pool:1000:1:40", 39, 0x1ed5d5fd60f38c2cu},   {"drop:1000:1:90", 0, 0x5f2868dfff358a60u},
        {"drop:1000:1:90", 80, 0x53d1ee615dbe3f4du},
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        particles p = make(known[i].spec, known[i].frame);
        uint64_t sum = checksum(&p);
        if (sum != known[i].sum)
            fail_msg("%s frame %zu: 0x%016llx", known[i].spec, known[i].frame, (unsigned long long)sum);
        particles_free(&p);
    }
}

static const char *const names[] = {"scattered", "dense",   "mixed", "sheet",
                                    "molecule",  "tornado", "pool",  "drop"};

enum { NAMES = sizeof names / sizeof *names };

static void exactly_as_many_as_asked(void **state)
{
    (void)state;
    static const size_t counts[] = {1, 2, 3, 7, 100, 1009, 4096};
    for (int n = 0; n < NAMES; n++)
        for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
            char spec[64];
            snprintf(spec, sizeof spec, "%s:%zu:5:100", names[n], counts[c]);
            for (size_t frame = 0; frame < 100; frame += 45) {
                particles p = make(spec, frame);
                assert_int_equal(p.count, counts[c]);
                for (size_t i = 0; i < p.count; i++) {
                    for (int k = 0; k < 3; k++) assert_true(isfinite(p.axis[k][i]));
                    assert_true(p.radius[i] > 0 && isfinite(p.radius[i]));
                }
                particles_free(&p);
            }
        }
}

/* Effective spheres over each ball's centre, on average over every 37th ball whose box [lo + margin, hi -
 * margin] holds it; its own counts too. */
static double overlap(const particles *p, const double *lo, const double *hi)
{
    size_t covered = 0, centres = 0;
    for (size_t i = 0; i < p->count; i += 37) {
        bool is_inside = true;
        for (int k = 0; lo && k < 3; k++)
            is_inside &= p->axis[k][i] >= lo[k] + p->radius[i] && p->axis[k][i] <= hi[k] - p->radius[i];
        if (!is_inside) continue;
        centres++;
        for (size_t j = 0; j < p->count; j++) {
            double d = 0;
            for (int k = 0; k < 3; k++)
                d += (p->axis[k][i] - p->axis[k][j]) * (p->axis[k][i] - p->axis[k][j]);
            covered += d < p->radius[j] * p->radius[j];
        }
    }
    return (double)covered / (double)centres;
}

/* Inside the volume: where balls are placed independently a centre is covered by its own sphere besides
 * the 2.1; on a lattice its own is one of the 33. */
static void overlaps_of_still_shapes(void **state)
{
    (void)state;
    static const double lo[3] = {0, 0, 0}, unit[3] = {1, 1, 1}, slab[3] = {2, 0.5, 1};
    particles p = make("scattered:20000", 0);
    double found = overlap(&p, lo, unit) - 1;
    print_message("scattered: %.2f\n", found);
    assert_true(fabs(found - 2.145) < 0.1);
    particles_free(&p);
    p = make("dense:20000", 0);
    found = overlap(&p, lo, slab);
    print_message("dense: %.2f\n", found);
    assert_true(fabs(found - 33) < 1);
    particles_free(&p);
}

/* Over all balls, those at the surface included. */
static void overlaps_of_moving_shapes(void **state)
{
    (void)state;
    static const struct {
        const char *spec;
        double overlap;
    } cases[] = {{"tornado:4000:1:200", 15},
                 {"tornado:20000:1:200", 15},
                 {"pool:4000:1:200", 30},
                 {"pool:20000:1:200", 30},
                 {"drop:20000:1:200", 30}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (size_t frame = 0; frame < 200; frame += 90) {
            particles p = make(cases[i].spec, frame);
            double found = overlap(&p, NULL, NULL);
            print_message("%s frame %zu: %.2f\n", cases[i].spec, frame, found);
            assert_true(fabs(found - cases[i].overlap) < 0.09 * cases[i].overlap);
            particles_free(&p);
        }
}

static void mixed_radii_span_two_decades_evenly(void **state)
{
    (void)state;
    particles p = make("mixed:10000", 0);
    size_t decade[2] = {0, 0};
    for (size_t i = 0; i < p.count; i++) {
        assert_true(p.radius[i] >= 1e-3 * (1 - 1e-12) && p.radius[i] <= 0.1);
        decade[p.radius[i] >= 0.01]++;
    }
    assert_true(fabs((double)decade[0] - 5000) < 200);
    particles_free(&p);
}

static double distance(const particles *p, size_t i, size_t j)
{
    double d = 0;
    for (int k = 0; k < 3; k++) d += (p->axis[k][i] - p->axis[k][j]) * (p->axis[k][i] - p->axis[k][j]);
    return sqrt(d);
}

static void molecules_have_bond_lengths(void **state)
{
    (void)state;
    particles p = make("molecule:5000:9", 0);
    for (size_t r = 0; r < 1000; r++) {
        size_t n = 5 * r, ca = n + 1, c = n + 2, o = n + 3, cb = n + 4;
        assert_true(fabs(distance(&p, n, ca) - 1.46) < 0.005);
        assert_true(fabs(distance(&p, ca, c) - 1.52) < 0.005);
        assert_true(fabs(distance(&p, c, o) - 1.23) < 0.005);
        assert_true(fabs(distance(&p, ca, cb) - 1.53) < 0.005);
        if (r < 999) assert_true(fabs(distance(&p, c, n + 5) - 1.33) < 0.01);
        if (r < 999) assert_true(fabs(distance(&p, ca, ca + 5) - 3.8) < 1e-9);
    }
    for (size_t i = 1; i < p.count; i += 5) /* the chain does not meet itself */
        for (size_t j = 1; j < i; j += 5) assert_true(distance(&p, i, j) > 3.79);
    assert_true(p.radius_is_surface && p.radius[0] == 1.55 && p.radius[1] == 1.70 && p.radius[3] == 1.52);
    assert_string_equal(p.column->name, "element");
    assert_string_equal(p.column->label[(size_t)p.column->value[3]], "O");
    particles_free(&p);
}

/* Frames follow each other smoothly: balls move, none by more than a few radii (droplets and rings apart:
 * they start anew). */
static void only_flows_move(void **state)
{
    (void)state;
    for (int n = 0; n < NAMES; n++) {
        char spec[64];
        snprintf(spec, sizeof spec, "%s:2000:5:60", names[n]);
        particles a = make(spec, 10), b = make(spec, 11);
        size_t moved = 0, jumped = 0;
        for (size_t i = 0; i < a.count; i++) {
            double d = 0;
            for (int k = 0; k < 3; k++) d += fabs(a.axis[k][i] - b.axis[k][i]);
            moved += d > 0;
            jumped += d > 0.1;
        }
        bool is_flow = !strcmp(names[n], "tornado") || !strcmp(names[n], "pool") || !strcmp(names[n], "drop");
        if (!is_flow) assert_int_equal(moved, 0);
        if (!strcmp(names[n], "tornado") || !strcmp(names[n], "pool")) assert_true(moved > 1900);
        if (!strcmp(names[n], "drop")) assert_true(moved > 50);
        assert_true(jumped < 20);
        particles_free(&a);
        particles_free(&b);
    }
}

static void the_arithmetic_is_right(void **state)
{
    (void)state;
    for (int i = -2000; i <= 2000; i++) {
        double x = i * 0.00737;
        assert_true(fabs(generate_sine(x) - sin(6.283185307179586477 * x)) < 1e-13);
        assert_true(fabs(generate_cosine(x) - cos(6.283185307179586477 * x)) < 1e-13);
        assert_true(fabs(generate_exp2(x) / exp2(x) - 1) < 1e-15);
        double cube = ldexp(1 + (i & 1023) / 1024.0, i / 4);
        assert_true(fabs(generate_cbrt(cube) / cbrt(cube) - 1) < 1e-15);
    }
}

static void generators_are_inputs(void **state)
{
    (void)state;
    mns_input *input = open_file("tornado:500:3:7");
    assert_int_equal(mns_input_frames(input), 7);
    mns_field *f = read_frame(input, 6);
    assert_true(f->p.count == 500 && f->uniform_radius > 0);
    assert_string_equal(f->p.format, "generator");
    assert_string_equal(f->radius_source, "generator");
    assert_string_equal(f->p.column[0].name, "speed");
    mns_field_destroy(f);
    mns_input_close(input);
    input = open_file("molecule:500");
    assert_int_equal(mns_input_frames(input), 1);
    f = read_frame(input, 0);
    assert_string_equal(f->radius_source, "van der Waals");
    mns_field_destroy(f);
    mns_input_close(input);
}

static void wrong_specifications_are_usage_errors(void **state)
{
    (void)state;
    static const struct {
        const char *spec, *words;
    } cases[] = {
        {"torpedo:4000", "no file and no generator 'torpedo'; the generators are scattered, dense"},
        {"tornado", "expected tornado:count"},
        {"tornado:", "expected tornado:count[:seed[:frames]]"},
        {"tornado:4k", "expected tornado:count"},
        {"tornado:0", "asks for 0 balls"},
        {"tornado:1000000000000000000", "asks for 1000000000000000000 balls; expected 1 to 2000000000"},
        {"tornado:99999999999999999999", "expected tornado:count"},
        {"tornado:-5", "expected tornado:count"},
        {"tornado:5:x", "expected tornado:count"},
        {"tornado:5:1:0", "asks for 0 frames"},
        {"tornado:5:1:2:3", "expected tornado:count"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        mns_input *input = NULL;
        mns_error error = {0};
        assert_int_equal(mns_input_open(&cases[i].spec, 1, NULL, &input, &error), MNS_ERROR_USAGE);
        if (!strstr(error.text, cases[i].words)) fail_msg("'%s' lacks '%s'", error.text, cases[i].words);
    }
    const char *both[] = {"dense:5", "dense:6"};
    mns_input *input = NULL;
    assert_int_equal(mns_input_open(both, 2, NULL, &input, NULL), MNS_ERROR_USAGE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_same_bits_on_every_machine),
        cmocka_unit_test(exactly_as_many_as_asked),
        cmocka_unit_test(overlaps_of_still_shapes),
        cmocka_unit_test(overlaps_of_moving_shapes),
        cmocka_unit_test(mixed_radii_span_two_decades_evenly),
        cmocka_unit_test(molecules_have_bond_lengths),
        cmocka_unit_test(only_flows_move),
        cmocka_unit_test(the_arithmetic_is_right),
        cmocka_unit_test(generators_are_inputs),
        cmocka_unit_test(wrong_specifications_are_usage_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
