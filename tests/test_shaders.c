/* Every shader variant that the plan can make is valid GLSL by the letter of Khronos' own compiler, not only
 * by a driver's. Needs glslangValidator (Debian: glslang-tools); without it the test is skipped. */
#include "gl/program.h"
#include "support/variants.h"

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { STATUS_SKIP = 77, MOST_TEXTS = 16384 };

static const char *const shader_names[SHADER_COUNT] = {
    [SHADER_CORE_QUADS] = "core-quads",
    [SHADER_CORE_POINTS] = "core-points",
    [SHADER_GATHER_QUADS] = "gather-quads",
    [SHADER_GATHER_POINTS] = "gather-points",
    [SHADER_SHUFFLE] = "shuffle",
    [SHADER_ORDER] = "order",
    [SHADER_CAST] = "cast",
    [SHADER_WALK] = "walk",
    [SHADER_RESOLVE] = "resolve",
    [SHADER_TREE] = "tree",
    [SHADER_TREE_WALK] = "tree-walk",
    [SHADER_TREE_RESOLVE] = "tree-resolve",
    [SHADER_SOLIDS_FIRST] = "solids-first",
    [SHADER_EFFECTS_LIST] = "effects-list",
    [SHADER_EFFECTS_PLAIN] = "effects-plain",
    [SHADER_EFFECTS_ANY] = "effects-any",
    [SHADER_EFFECTS] = "effects-rays",
    [SHADER_EFFECTS_RESOLVE] = "effects-resolve",
    [SHADER_SHADE] = "shade",
    [SHADER_HOST_DEPTH] = "host-depth",
    [SHADER_HOST_DRAW] = "host-draw",
};

/* The texts so far, by what matters of them. */
typedef struct texts {
    char folder[64];
    uint64_t seen[MOST_TEXTS];
    size_t count, many_lights;
} texts;

static uint64_t hash(uint64_t h, const char *data, size_t size) /* FNV-1a */
{
    for (size_t i = 0; i < size; i++) h = (h ^ (unsigned char)data[i]) * 0x100000001b3u;
    return h;
}

/* Of a text without those of its leading #define lines whose name is nowhere else in it. */
static uint64_t text_hash(const char *text, const char *stage)
{
    uint64_t h = hash(0xcbf29ce484222325u, stage, strlen(stage));
    const char *body = strstr(text, "\n") + 1;
    while (!strncmp(body, "#define ", 8)) body = strchr(body, '\n') + 1;
    for (const char *line = strstr(text, "\n") + 1; line < body; line = strchr(line, '\n') + 1) {
        char name[64];
        snprintf(name, sizeof name, "%.*s", (int)strcspn(line + 8, " "), line + 8);
        if (strstr(body, name)) h = hash(h, line, strcspn(line, "\n") + 1);
    }
    return hash(h, body, strlen(body));
}

static void write_text(texts *t, const char *name, const char *stage, const char *text)
{
    uint64_t h = text_hash(text, stage);
    for (size_t i = 0; i < t->count; i++)
        if (t->seen[i] == h) return;
    assert_true(t->count < MOST_TEXTS);
    t->seen[t->count++] = h;
    t->many_lights += strstr(text, "#define LIGHTS_MANY") != NULL;
    char path[160];
    snprintf(path, sizeof path, "%s/%s-%zu.%s", t->folder, name, t->count, stage);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static void write_variant(texts *t, plan_shader shader, const mns_plan *plan)
{
    char defines[PLAN_DEFINES];
    const char *file[3], *const stage[3] = {"vert", "frag", "comp"};
    plan_shader_files(shader, &file[0], &file[1], &file[2]);
    plan_shader_defines(plan, shader, defines);
    for (int i = 0; i < 3; i++) {
        if (!file[i]) continue;
        char *text = glsl_assemble(file[i], defines);
        assert_non_null(text);
        write_text(t, shader_names[shader], stage[i], text);
        free(text);
    }
}

/* Which triples of settings some written variant has had: a setting is a feature that is there or not, a
 * kernel, a solver. */
enum { SETTINGS = 6 + 4 + 2 * (FEATURE_COUNT - 5) };
typedef struct triples {
    bool seen[SETTINGS][SETTINGS][SETTINGS];
} triples;

/* The mask's settings, of what the shader reads. */
static size_t settings_of(uint64_t reads, uint64_t features, size_t setting[FEATURE_COUNT])
{
    size_t count = 0;
    if (reads & FEATURE_KERNEL) setting[count++] = (features & FEATURE_KERNEL) - 1;
    if (reads & FEATURE_SOLVER) setting[count++] = 6 + ((features & FEATURE_SOLVER) >> 3);
    for (size_t bit = 5; bit < FEATURE_COUNT; bit++)
        if (reads >> bit & 1) setting[count++] = 10 + 2 * (bit - 5) + (features >> bit & 1);
    return count;
}

/* How many of the mask's triples (pairs and singles, where it has but these) are new; notes them where
 * `note`. */
static size_t new_triples(triples *t, uint64_t reads, uint64_t features, bool note)
{
    size_t setting[FEATURE_COUNT], count = settings_of(reads, features, setting), fresh = 0;
    for (size_t a = 0; a < count; a++)
        for (size_t b = a; b < count; b++)
            for (size_t c = b; c < count; c++) {
                bool *seen = &t->seen[setting[a]][setting[b]][setting[c]];
                fresh += !*seen;
                *seen |= note;
            }
    return fresh;
}

/* The next mask, of what the shader reads: of many features not every one, but some by chance. */
static uint64_t next_mask(uint64_t reads, uint64_t subset, uint64_t *chance)
{
    if (__builtin_popcountll(reads) < 20) return (subset - reads) & reads;
    uint64_t mask = 0;
    for (int half = 0; half < 2; half++) { /* of a number its upper bits: the lower ones come round soon */
        *chance = *chance * 6364136223846793005u + 1442695040888963407u; /* Knuth's */
        mask = mask << 32 | *chance >> 32;
    }
    return *chance >> 48 == 0 ? 0 : mask & reads;
}

/* How many lights there are is no feature, but some texts hang on whether there are several: LIGHTS stands
 * for that where they do. */
static uint64_t reads_of(plan_shader shader)
{
    char one[PLAN_DEFINES], many[PLAN_DEFINES];
    const uint64_t all = ~UINT64_C(0) >> (64 - FEATURE_COUNT);
    plan_shader_defines(&(mns_plan){.features = all, .look.light_count = 1}, shader, one);
    plan_shader_defines(&(mns_plan){.features = all, .look.light_count = 2}, shader, many);
    return variant_reads(shader) | (strcmp(one, many) != 0 ? FEATURE_LIGHTS : 0);
}

/* Each feature that the shader reads is there in some variant, and is missing in another. */
static void expect_every_setting(const triples *t, plan_shader shader, uint64_t reads)
{
    size_t setting[FEATURE_COUNT];
    for (int there = 0; there < 2; there++) {
        uint64_t features = there ? ~UINT64_C(0) : 0;
        size_t count = settings_of(reads & ~(FEATURE_KERNEL | FEATURE_SOLVER), features, setting);
        for (size_t i = 0; i < count; i++)
            if (!t->seen[setting[i]][setting[i]][setting[i]])
                fail_msg("%s: no variant %s feature %zu", shader_names[shader], there ? "has" : "lacks",
                         (setting[i] - 10) / 2 + 5);
    }
}

/* Small shaders in every variant. Of those that walk a ray, which have thousands (some 20 s of compiling),
 * enough that any three settings that can go together are together in one: of the masks those first that
 * bring most new triples. */
static void write_all(texts *t, plan_shader shader)
{
    uint64_t reads = reads_of(shader), chance = 1;
    bool all = __builtin_popcountll(reads) < 8;
    triples *done = calloc(1, sizeof *done);
    assert_non_null(done);
    for (size_t least = all ? 0 : 512;; least /= 2) {
        uint64_t subset = 0;
        do {
            mns_plan plan = {.options = {.slots = 24, .root_steps = 48}};
            bool possible = variant_of(shader, reads, subset, &plan.features);
            plan.look.light_count = plan.features & FEATURE_LIGHTS ? 2 : 1;
            if (possible && (all || new_triples(done, reads, plan.features, false) > least)) {
                new_triples(done, reads, plan.features, true);
                write_variant(t, shader, &plan);
            }
            subset = next_mask(reads, subset, &chance);
        } while (subset);
        if (!least) break;
    }
    expect_every_setting(done, shader, reads);
    free(done);
}

static void remove_folder(const char *folder)
{
    DIR *dir = opendir(folder);
    assert_non_null(dir);
    for (struct dirent *entry; (entry = readdir(dir));) {
        char path[400];
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        if (entry->d_name[0] != '.') unlink(path);
    }
    closedir(dir);
    assert_int_equal(rmdir(folder), 0);
}

/* Runs the validator over one shader's texts, and prints what it complains of. It is held to 20 s and 1 GB:
 * glslang 12 runs away where a `precise` value hangs on a structure that a loop replaces by what a part of it
 * leads to. */
static size_t complaints(const texts *t, const char *name)
{
    char command[256], line[400], file[400] = "";
    snprintf(command, sizeof command, "cd %s && ulimit -v 1000000 && timeout 20 glslangValidator %s-* 2>&1",
             t->folder, name);
    FILE *out = popen(command, "r"); /* the names are ours */
    assert_non_null(out);
    size_t count = 0;
    while (fgets(line, sizeof line, out)) {
        if (!strncmp(line, name, strlen(name)))
            snprintf(file, sizeof file, "%.*s", (int)strcspn(line, "\n"), line);
        if (strncmp(line, "ERROR", 5) != 0 && strncmp(line, "WARNING", 7) != 0) continue;
        if (count++ < 10) print_error("%s/%s: %s", t->folder, file, line);
    }
    int status = pclose(out);
    if (status != 0 && !count++)
        print_error("%s/%s-*: glslangValidator ended with status %d\n", t->folder, name, status);
    return count;
}

static void every_variant_is_valid(void **state)
{
    (void)state;
    texts *t = calloc(1, sizeof *t);
    assert_non_null(t);
    const char *temporary = getenv("TMPDIR");
    snprintf(t->folder, sizeof t->folder, "%.40s/shaders-XXXXXX",
             temporary && *temporary ? temporary : "/tmp");
    assert_non_null(mkdtemp(t->folder));
    size_t bad = 0;
    for (int shader = 0; shader < SHADER_COUNT; shader++) {
        size_t before = t->count;
        write_all(t, (plan_shader)shader);
        assert_true(t->count > before);
        bad += complaints(t, shader_names[shader]);
    }
    print_message("%zu texts, %zu of several lights\n", t->count, t->many_lights);
    assert_true(t->many_lights > 10);
    if (bad) fail_msg("%zu complaints; the texts are left in %s", bad, t->folder);
    remove_folder(t->folder);
    free(t);
}

/* A number's spelling must not hang on the locale: whole numbers have but one. Nothing is cut off. */
static void defines_hold_whole_numbers_only(void **state)
{
    (void)state;
    for (int shader = 0; shader < SHADER_COUNT; shader++) {
        char defines[PLAN_DEFINES], name[64];
        mns_plan plan = {.features = ~UINT64_C(0) >> (64 - FEATURE_COUNT),
                         .options = {.slots = 1024, .root_steps = 4096}};
        plan_shader_defines(&plan, (plan_shader)shader, defines);
        assert_true(strlen(defines) < PLAN_DEFINES / 2);
        for (const char *line = defines; *line; line = strchr(line, '\n') + 1) {
            int value, end = 0;
            assert_int_equal(sscanf(line, "#define %63[A-Z0-9_] %d%n", name, &value, &end), 2);
            assert_true(line[end] == '\n');
        }
    }
}

/* What a shader is told of is what changes its text: a feature that it does not read makes no new variant. */
static void a_shader_has_no_variants_that_it_does_not_need(void **state)
{
    (void)state;
    const uint64_t look = FEATURE_CEL | FEATURE_DIRECTIONAL | FEATURE_SPECULAR | FEATURE_SAMPLES;
    assert_int_equal(variant_reads(SHADER_CAST) & (look | FEATURE_CORE | FEATURE_PAPER | FEATURE_POINTS), 0);
    assert_int_equal(variant_reads(SHADER_RESOLVE) & (look | FEATURE_SOLVER), 0);
    assert_int_equal(
        variant_reads(SHADER_SHADE) & (FEATURE_KERNEL | FEATURE_SOLVER | FEATURE_RADII | FEATURE_FAR), 0);
    for (int shader = SHADER_CORE_QUADS; shader <= SHADER_GATHER_POINTS; shader++)
        assert_int_equal(variant_reads((plan_shader)shader) &
                             (look | FEATURE_KERNEL | FEATURE_SOLVER | FEATURE_COLORS),
                         0);
    assert_int_equal(
        variant_reads(SHADER_ORDER) | variant_reads(SHADER_SHUFFLE) | variant_reads(SHADER_HOST_DRAW), 0);
}

/* Rays to several lights, and to one that is read without asking which. */
static void many_lights_are_a_variant(void **state)
{
    (void)state;
    for (int shader = 0; shader < SHADER_COUNT; shader++)
        assert_int_equal((reads_of((plan_shader)shader) & FEATURE_LIGHTS) != 0,
                         shader >= SHADER_EFFECTS_ANY && shader <= SHADER_EFFECTS_RESOLVE);
}

/* Where no ray is traced beyond the first the triangles' tree is not walked: without its depth that text is
 * not even valid. */
static void the_tree_of_triangles_is_compiled_where_rays_walk_it(void **state)
{
    (void)state;
    const mns_plan with = {.features = MNS_KERNEL_POLY3 | FEATURE_LIT | FEATURE_SOLIDS},
                   without = {.features = MNS_KERNEL_POLY3 | FEATURE_LIT};
    for (int shader = SHADER_EFFECTS_LIST; shader <= SHADER_EFFECTS_RESOLVE; shader++) {
        char defines[PLAN_DEFINES];
        bool walks = shader > SHADER_EFFECTS_PLAIN;
        plan_shader_defines(&with, (plan_shader)shader, defines);
        assert_int_equal(strstr(defines, "SOLID_DEPTH") != NULL, walks);
        plan_shader_defines(&without, (plan_shader)shader, defines);
        assert_null(strstr(defines, "SOLID"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defines_hold_whole_numbers_only),
        cmocka_unit_test(a_shader_has_no_variants_that_it_does_not_need),
        cmocka_unit_test(many_lights_are_a_variant),
        cmocka_unit_test(the_tree_of_triangles_is_compiled_where_rays_walk_it),
        cmocka_unit_test(every_variant_is_valid),
    };
    if (system("glslangValidator --version >/dev/null 2>&1") != 0) {
        puts("skipped: no glslangValidator (Debian: glslang-tools)");
        return STATUS_SKIP;
    }
    return cmocka_run_group_tests_name("shaders", tests, NULL, NULL);
}
