/* Effects in pictures: what does nothing changes nothing, the truth's shading is the shade pass's, terms
 * reach the image; and the texts that GLSL and C share give both the same numbers. */
#include "effects/shared.h"
#include "support/draw_fixture.h"
#include "support/gl_compute.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { WIDTH = 48, HEIGHT = 36, PIXELS = WIDTH * HEIGHT };
static const mns_options traced = {.method = MNS_METHOD_REFERENCE};
static const mns_view small = {.width = WIDTH, .height = HEIGHT};

/* ---- The same numbers ---- */

enum { CASES = 4096, RESULTS = 16 };

static const char compute_main[] =
    "layout(local_size_x = 64) in;\n"
    "layout(std430, binding = 1) writeonly buffer Results { uint result[]; };\n"
    "void main()\n"
    "{\n"
    "    uint i = gl_GlobalInvocationID.x, at = 16u * i;\n"
    "    uint key = samples_key(i % 61u, i / 61u, 5u, 1u + i % 7u, i % 3u);\n"
    "    float u = samples_number(key, i, 0), v = samples_number(key, i, 1), w = samples_number(key, i + 9u, "
    "0);\n"
    "    vec3 n = normalize(vec3(u, v, w) - 0.501);\n"
    "    vec3 h = vec3(samples_hemisphere(0, u, v), samples_hemisphere(1, u, v), samples_hemisphere(2, u, "
    "v));\n"
    "    float width = samples_cone_width(w);\n"
    "    result[at] = key;\n"
    "    result[at + 1u] = floatBitsToUint(u);\n"
    "    result[at + 2u] = floatBitsToUint(v);\n"
    "    for (int axis = 0; axis < 3; axis++) {\n"
    "        uint a = at + uint(axis);\n"
    "        result[a + 3u] = floatBitsToUint(samples_turned(axis, n.x, n.y, n.z, h.x, h.y, h.z));\n"
    "        result[a + 6u] = floatBitsToUint(samples_cone(axis, width, u, v));\n"
    "        result[a + 9u] = floatBitsToUint(sky_color(axis, n.x, n.y, n.z));\n"
    "    }\n"
    "    result[at + 12u] = floatBitsToUint(width);\n"
    "    result[at + 13u] = floatBitsToUint(samples_sphere_distance(w, u * width));\n"
    "    result[at + 14u] = floatBitsToUint(optics_fresnel(0.5 + w, v));\n"
    "    result[at + 15u] = floatBitsToUint(optics_bend(1.0 + w, v));\n"
    "}\n";

static void run(const GladGLContext *gl, uint32_t *result)
{
    const char *const text[] = {"#version 430 core\n#define UINT uint\n", gl_compute_embedded("real.glsl"),
                                gl_compute_embedded("samples.glsl"),      gl_compute_embedded("optics.glsl"),
                                gl_compute_embedded("sky.glsl"),          compute_main};
    GLuint program = gl_compute_program(gl, text, 6), buffer;
    gl->GenBuffers(1, &buffer);
    gl->BindBufferBase(GL_SHADER_STORAGE_BUFFER, 1, buffer);
    gl->BufferData(GL_SHADER_STORAGE_BUFFER, CASES * RESULTS * sizeof *result, NULL, GL_STATIC_READ);
    gl->UseProgram(program);
    gl->DispatchCompute(CASES / 64, 1, 1);
    gl->MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    gl->GetBufferSubData(GL_SHADER_STORAGE_BUFFER, 0, CASES * RESULTS * sizeof *result, result);
    gl->UseProgram(0);
    gl->DeleteBuffers(1, &buffer);
    gl->DeleteProgram(program);
}

static void in_c(uint32_t i, uint32_t *key, double result[RESULTS])
{
    *key = samples_key(i % 61, i / 61, 5, 1 + i % 7, i % 3);
    double u = samples_number(*key, i, 0), v = samples_number(*key, i, 1), w = samples_number(*key, i + 9, 0);
    double n[3] = {u - 0.501, v - 0.501, w - 0.501}, h[3];
    double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]), width = samples_cone_width(w);
    for (int a = 0; a < 3; a++) n[a] /= length, h[a] = samples_hemisphere(a, u, v);
    result[1] = u, result[2] = v;
    for (int a = 0; a < 3; a++) {
        result[3 + a] = samples_turned(a, n[0], n[1], n[2], h[0], h[1], h[2]);
        result[6 + a] = samples_cone(a, width, u, v);
        result[9 + a] = sky_color(a, n[0], n[1], n[2]);
    }
    result[12] = width;
    result[13] = samples_sphere_distance(w, u * width);
    result[14] = optics_fresnel(0.5 + w, v);
    result[15] = optics_bend(1 + w, v);
}

/* Keys and numbers to the bit. The rest to some roundings of 1; GLSL's sine and cosine are good to 2^-11 of
 * it and no better (llvmpipe: 1e-6), the sky's glow is a power of 512, and near the critical angle Fresnel's
 * share rises like a root. */
static void texts_give_glsl_and_c_the_same(void **state)
{
    draw_fixture *d = *state;
    static uint32_t got[CASES * RESULTS];
    static const double allowed[RESULTS] = {0,    0,    0,    5e-6, 5e-6, 5e-6, 5e-6, 5e-6,
                                            5e-6, 1e-3, 1e-3, 1e-3, 1e-6, 2e-3, 5e-3, 1e-5};
    run(&d->gl.gl, got);
    for (uint32_t i = 0; i < CASES; i++) {
        double want[RESULTS];
        uint32_t key;
        in_c(i, &key, want);
        assert_true(got[RESULTS * i] == key);
        for (int k = 1; k < RESULTS; k++) {
            float value;
            memcpy(&value, &got[RESULTS * i + (uint32_t)k], sizeof value);
            if (!(fabs((double)value - want[k]) <= allowed[k]))
                fail_msg("case %u, result %d: %.9g, in C %.17g", i, k, (double)value, want[k]);
        }
    }
    draw_fixture_check(d);
}

/* ---- Nothing for nothing ---- */

static void what_does_nothing_changes_no_bit(void **state)
{
    static const mns_light plain_light = {.kind = MNS_LIGHT_HEAD, .strength = 1, .color = {1, 1, 1}};
    static const mns_look looks[] = {
        {.effects = {.shadows = true}},
        {.set = MNS_LOOK_MIRROR, .effects = {.reflections = 3}},
        {.effects = {.index = 1, .absorption = {1, 1, 1}, .occlusion_reach = 3, .seed = 9}},
        {.set = MNS_LOOK_TRANSMISSION, .effects = {.refractions = 5}},
        {.lights = &plain_light, .light_count = 1},
        {.preset = "plain"},
    };
    draw_fixture *d = *state;
    mns_field *field = draw_generated("scattered:200", MNS_KERNEL_DEFAULT);
    for (int method = 0; method < 2; method++) {
        const mns_options *options = method ? NULL : &traced;
        mns_image *plain = draw_image(d, field, &small, NULL, options);
        assert_null(plain->effects_certain);
        for (size_t i = 0; i < sizeof looks / sizeof *looks; i++) {
            mns_image *image = draw_image(d, field, &small, &looks[i], options);
            draw_expect_same(image, plain, "nothing");
            assert_true(!image->shadow && !image->occlusion && !image->mirror_t && !image->refract_t);
            assert_true(d->stats.effects_rays == 0);
            mns_image_destroy(image);
        }
        mns_image_destroy(plain);
    }
    mns_field_destroy(field);
}

/* Two lights of half the strength are one: what the truth shades itself is what the shade pass makes. */
static void the_truths_shading_is_the_shade_passs(void **state)
{
    static const mns_light heads[2] = {{.strength = 0.5}, {.strength = 0.5}},
                           sides[2] = {{.kind = MNS_LIGHT_DIRECTIONAL, .strength = 0.25},
                                       {.kind = MNS_LIGHT_DIRECTIONAL, .strength = 0.75}};
    static const struct {
        const char *field, *color_by;
        mns_light_kind light;
        mns_shading shading;
        int samples;
    } cases[] = {
        {"scattered:300", NULL, MNS_LIGHT_HEAD, MNS_SHADING_SMOOTH, 1},
        {"scattered:300", NULL, MNS_LIGHT_DIRECTIONAL, MNS_SHADING_SMOOTH, 3},
        {"tornado:300", "speed", MNS_LIGHT_DIRECTIONAL, MNS_SHADING_SMOOTH, 1},
        {"molecule:100", "element", MNS_LIGHT_HEAD, MNS_SHADING_SMOOTH, 1},
        {"scattered:300", NULL, MNS_LIGHT_HEAD, MNS_SHADING_CEL, 1},
    };
    draw_fixture *d = *state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        mns_field *field = draw_generated(cases[i].field, MNS_KERNEL_DEFAULT);
        mns_options options = traced;
        options.samples = cases[i].samples;
        mns_look look = {.light = cases[i].light,
                         .shading = cases[i].shading,
                         .color_by = cases[i].color_by,
                         .set = MNS_LOOK_BACKGROUND,
                         .background = {0.2, 0.4, 0.6, 0.5}};
        mns_image *plain = draw_image(d, field, &small, &look, &options);
        look.lights = cases[i].light == MNS_LIGHT_HEAD ? heads : sides;
        look.light_count = 2;
        mns_image *lit = draw_image(d, field, &small, &look, &options);
        /* Colours by a column come to the shade pass as halves; a float may fall on either side of a cel's
         * band. */
        int off = 0;
        float allowed = cases[i].color_by ? 2e-3f : 2e-6f;
        for (int k = 0; k < 4 * PIXELS; k++) off += !(fabsf(lit->rgba[k] - plain->rgba[k]) <= allowed);
        if (off > (cases[i].shading == MNS_SHADING_CEL ? 12 : 0))
            fail_msg("case %zu: %d numbers are off", i, off);
        mns_image_destroy(plain);
        mns_image_destroy(lit);
        mns_field_destroy(field);
    }
}

/* ---- Terms ---- */

static const mns_look everything = {.light = MNS_LIGHT_DIRECTIONAL,
                                    .effects = {.shadows = true,
                                                .reflections = 1,
                                                .refractions = 2,
                                                .mirror = 0.1,
                                                .index = 1.3,
                                                .transmission = 0.5,
                                                .occlusion_rays = 4,
                                                .environment = "sky"}};

static void terms_reach_the_image_and_its_file(void **state)
{
    draw_fixture *d = *state;
    char path[] = "/tmp/effects-XXXXXX.exr";
    mns_error error;
    mns_image *read = NULL;
    mns_field *field = draw_generated("scattered:100", MNS_KERNEL_DEFAULT);
    mns_image *image = draw_image(d, field, &small, &everything, &traced);
    float *const terms[] = {image->shadow, image->occlusion, image->mirror_t, image->refract_t,
                            image->effects_certain};
    int hits = 0, dark = 0, deep = 0, met = 0;
    for (int k = 0; k < 5; k++) assert_non_null(terms[k]);
    for (int i = 0; i < PIXELS; i++) {
        bool hit = !isinf(image->t[i]);
        assert_true(image->shadow[i] == 0 || image->shadow[i] == 1);
        assert_true(image->occlusion[i] >= 0 && image->occlusion[i] <= 1);
        assert_true(image->effects_certain[i] == 1);
        assert_true(!hit || (image->refract_t[i] > 0 && !isinf(image->refract_t[i])));
        if (!hit)
            assert_true(image->shadow[i] == 1 && image->occlusion[i] == 1 && isinf(image->mirror_t[i]) &&
                        isinf(image->refract_t[i]));
        hits += hit;
        dark += hit && image->shadow[i] == 0;
        deep += hit && image->occlusion[i] < 1;
        met += hit && !isinf(image->mirror_t[i]);
    }
    assert_true(hits > 100 && dark > 20 && dark < hits && deep > 20 && met > 20 && met < hits);
    assert_true(d->stats.effects_rays > (uint64_t)hits * 6 && d->stats.effects_undecided == 0);
    int file = mkstemps(path, 4);
    assert_true(file >= 0);
    close(file);
    if (mns_image_write(image, path, &error) || mns_image_read(path, &read, &error))
        fail_msg("%s", error.text);
    float *const back[] = {read->shadow, read->occlusion, read->mirror_t, read->refract_t,
                           read->effects_certain};
    for (int k = 0; k < 5; k++) assert_memory_equal(back[k], terms[k], PIXELS * sizeof(float));
    unlink(path);
    mns_image_destroy(read);
    mns_image_destroy(image);
    mns_field_destroy(field);
}

static void a_picture_has_the_same_bits_again(void **state)
{
    draw_fixture *d = *state;
    mns_field *field = draw_generated("scattered:100", MNS_KERNEL_DEFAULT);
    mns_options options = traced;
    options.samples = 2;
    mns_look look = everything;
    mns_image *one = draw_image(d, field, &small, &look, &options);
    mns_image *two = draw_image(d, field, &small, &look, &options);
    draw_expect_same(one, two, "again");
    look.effects.seed = 1;
    mns_image *other = draw_image(d, field, &small, &look, &options);
    assert_true(memcmp(one->rgba, other->rgba, 4 * PIXELS * sizeof(float)) != 0);
    assert_memory_equal(one->shadow, other->shadow, PIXELS * sizeof(float));
    mns_image_destroy(one);
    mns_image_destroy(two);
    mns_image_destroy(other);
    mns_field_destroy(field);
}

static void what_cannot_be_drawn_is_refused(void **state)
{
    draw_fixture *d = *state;
    mns_error error;
    mns_look look = {.effects = {.environment = "/nowhere/map.exr"}};
    mns_field *field = draw_generated("scattered:100", MNS_KERNEL_DEFAULT);
    for (int method = 0; method < 2; method++) {
        const mns_options *options = method ? NULL : &traced;
        assert_int_equal(mns_renderer_draw(d->renderer, field, &small, &look, options, d->frame, &error),
                         MNS_ERROR_IO);
        assert_non_null(strstr(error.text, "/nowhere/map.exr"));
    }
    mns_field_destroy(field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texts_give_glsl_and_c_the_same),
        cmocka_unit_test(what_does_nothing_changes_no_bit),
        cmocka_unit_test(the_truths_shading_is_the_shade_passs),
        cmocka_unit_test(terms_reach_the_image_and_its_file),
        cmocka_unit_test(a_picture_has_the_same_bits_again),
        cmocka_unit_test(what_cannot_be_drawn_is_refused),
    };
    return cmocka_run_group_tests_name("effects, drawn", tests, draw_fixture_setup, draw_fixture_teardown);
}
