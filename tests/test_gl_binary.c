/* Programs kept between runs: taken where they fit in every byte, made anew and kept again where they do not.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "gl/program.h"
#include "support/gl_fixture.h"

static const gl_shader shader = {
    .vertex = "screen.vert.glsl", .fragment = "host_depth.frag.glsl", .defines = ""};
static const gl_shader other = {
    .vertex = "screen.vert.glsl", .fragment = "host_depth.frag.glsl", .defines = "#define FAR 1\n"};

typedef struct state {
    gl_fixture gl;
    gl_device device;
    char folder[64];
} state;

static int set_up(void **out)
{
    static state s;
    mns_error error;
    gl_fixture_begin(&s.gl);
    if (gl_device_open(&s.device, mns_context_get_proc(s.gl.context), &error)) return -1;
    snprintf(s.folder, sizeof s.folder, "/tmp/meniscus_test_XXXXXX");
    *out = &s;
    return mkdtemp(s.folder) ? 0 : -1;
}

static int tear_down(void **in)
{
    state *s = *in;
    char command[128];
    gl_device_close(&s->device);
    gl_fixture_end(&s->gl);
    snprintf(command, sizeof command, "rm -r '%s'", s->folder);
    return system(command);
}

static void skip_without_formats(state *s)
{
    GLint formats = 0;
    s->device.gl.GetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &formats);
    if (formats < 1) skip();
}

/* Makes the program with nothing in hand but the folder; whether it came from there. */
static bool make(state *s, const char *folder, const gl_shader *what)
{
    gl_programs programs = {0};
    mns_error error;
    GLuint id = 0;
    GLint linked = GL_FALSE;
    gl_binaries_open(&s->device, &programs.binaries, folder);
    if (gl_program_get(&s->device, &programs, what, &id, &error)) fail_msg("%s", error.text);
    s->device.gl.GetProgramiv(id, GL_LINK_STATUS, &linked);
    assert_true(linked && s->device.gl.GetError() == GL_NO_ERROR);
    s->device.gl.UseProgram(id);
    assert_true(s->device.gl.GetError() == GL_NO_ERROR);
    s->device.gl.UseProgram(0);
    assert_true(programs.binaries.taken <= 1);
    bool taken = programs.binaries.taken == 1;
    gl_programs_free(&s->device, &programs);
    return taken;
}

/* The files in the folder; the path of the last. */
static int count_files(const state *s, char path[400])
{
    int count = 0;
    DIR *list = opendir(s->folder);
    assert_non_null(list);
    for (struct dirent *entry; (entry = readdir(list));) {
        if (entry->d_name[0] == '.' && (!entry->d_name[1] || entry->d_name[1] == '.')) continue;
        snprintf(path, 400, "%s/%s", s->folder, entry->d_name);
        count++;
    }
    closedir(list);
    return count;
}

static void a_program_is_taken_the_second_time(void **in)
{
    state *s = *in;
    char path[400];
    skip_without_formats(s);
    assert_false(make(s, s->folder, &shader));
    assert_int_equal(count_files(s, path), 1);
    assert_true(make(s, s->folder, &shader));
    assert_false(make(s, s->folder, &other));
    assert_int_equal(count_files(s, path), 2);
    assert_true(make(s, s->folder, &other) && make(s, s->folder, &shader));
    assert_false(make(s, NULL, &shader));
    unlink(path);
    assert_int_equal(count_files(s, path), 1);
    unlink(path);
}

/* Another folder from now on: what was taken before is still told. */
static void what_was_taken_still_counts_in_another_folder(void **in)
{
    state *s = *in;
    gl_programs programs = {0};
    mns_error error;
    GLuint id = 0;
    char path[400];
    skip_without_formats(s);
    make(s, s->folder, &shader);
    gl_binaries_open(&s->device, &programs.binaries, s->folder);
    if (gl_program_get(&s->device, &programs, &shader, &id, &error)) fail_msg("%s", error.text);
    assert_int_equal(programs.binaries.taken, 1);
    gl_binaries_open(&s->device, &programs.binaries, NULL);
    assert_string_equal(programs.binaries.folder, "");
    assert_int_equal(programs.binaries.taken, 1);
    gl_programs_free(&s->device, &programs);
    assert_int_equal(count_files(s, path), 1);
    unlink(path);
}

/* Every byte of the head, some of the driver's, and lengths of all kinds. */
static void what_does_not_fit_is_thrown_away(void **in)
{
    state *s = *in;
    char path[400];
    unsigned char bytes[1 << 16];
    skip_without_formats(s);
    make(s, s->folder, &shader);
    assert_int_equal(count_files(s, path), 1);
    FILE *file = fopen(path, "rb");
    size_t size = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    assert_true(size > 64 && size < sizeof bytes);
    for (size_t at = 0; at < size; at += at < 64 ? 1 : 1 + size / 20) {
        bytes[at] ^= 0x10;
        file = fopen(path, "wb");
        fwrite(bytes, 1, size, file);
        fclose(file);
        bytes[at] ^= 0x10;
        if (make(s, s->folder, &shader)) fail_msg("taken, though byte %zu is wrong", at);
        if (!make(s, s->folder, &shader)) fail_msg("not kept again after byte %zu was wrong", at);
    }
    for (size_t length = 0; length <= size + 100; length += 1 + length) {
        file = fopen(path, "wb");
        fwrite(bytes, 1, length < size ? length : size, file);
        for (size_t i = size; i < length; i++) fputc(0, file);
        fclose(file);
        if (length != size) assert_false(make(s, s->folder, &shader));
        assert_true(make(s, s->folder, &shader));
    }
    unlink(path);
}

/* What the check sum finds good and the driver does not. */
static void what_the_driver_refuses_is_compiled(void **in)
{
    state *s = *in;
    char path[400];
    skip_without_formats(s);
    gl_programs programs = {0};
    gl_binaries_open(&s->device, &programs.binaries, s->folder);
    make(s, s->folder, &shader);
    assert_int_equal(count_files(s, path), 1);
    struct stat about;
    assert_int_equal(stat(path, &about), 0);
    unsigned char *bytes = calloc(1, (size_t)about.st_size);
    FILE *file = fopen(path, "rb");
    assert_true(bytes && file);
    size_t size = fread(bytes, 1, (size_t)about.st_size, file), head = 48;
    fclose(file);
    memset(bytes + head, 0x5a, size - head); /* not what any driver gives */
    uint64_t sum = store_sum(0, bytes + head, size - head);
    memcpy(bytes + head - 8, &sum, 8);
    file = fopen(path, "wb");
    fwrite(bytes, 1, size, file);
    fclose(file);
    free(bytes);
    assert_false(make(s, s->folder, &shader));
    assert_true(make(s, s->folder, &shader));
    unlink(path);
}

static void another_driver_has_programs_of_its_own(void **in)
{
    state *s = *in;
    gl_device renamed = s->device;
    gl_binary_key key[4];
    key[0] = gl_binary_key_begin(&s->device);
    snprintf(renamed.name, sizeof renamed.name, "%.200s2", s->device.name);
    key[1] = gl_binary_key_begin(&renamed);
    renamed = s->device;
    snprintf(renamed.vendor, sizeof renamed.vendor, "another");
    key[2] = gl_binary_key_begin(&renamed);
    key[3] = key[0];
    gl_binary_key_add(&key[3], "");
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < i; j++)
            for (int lane = 0; lane < 2; lane++) assert_true(key[i].lane[lane] != key[j].lane[lane]);
    gl_binary_key ab = key[0], ba = key[0];
    gl_binary_key_add(&ab, "a"), gl_binary_key_add(&ab, "bc");
    gl_binary_key_add(&ba, "ab"), gl_binary_key_add(&ba, "c");
    assert_true(ab.lane[0] != ba.lane[0] && ab.lane[1] != ba.lane[1]);
}

/* A folder that cannot be, or a file in a folder's place: nothing is kept, and nothing fails. */
static void nothing_fails_where_nothing_can_be_kept(void **in)
{
    state *s = *in;
    char path[400];
    snprintf(path, sizeof path, "%s/file", s->folder);
    fclose(fopen(path, "wb"));
    assert_false(make(s, path, &shader));
    snprintf(path, sizeof path, "%s/file/below", s->folder);
    assert_false(make(s, path, &shader));
    assert_false(make(s, "/proc/nothing", &shader));
    assert_false(make(s, "", &shader));
    char *lengthy = malloc(2 * STORE_PATH);
    assert_non_null(lengthy);
    memset(lengthy, 'a', 2 * STORE_PATH);
    lengthy[0] = '/', lengthy[2 * STORE_PATH - 1] = 0;
    assert_false(make(s, lengthy, &shader));
    free(lengthy);
    snprintf(path, sizeof path, "%s/file", s->folder);
    unlink(path);
}

/* The longest unused go first, and other files are left alone. */
static void the_folder_is_bounded(void **in)
{
    state *s = *in;
    char path[400];
    const char bytes[100] = {0};
    const store_part part = {bytes, sizeof bytes};
    FILE *file;
    for (int i = 0; i < 6; i++) {
        char name[8] = {(char)('a' + i), 0};
        assert_int_equal(store_write(s->folder, name, "program", &part, 1, 1000), 0);
        snprintf(path, sizeof path, "%s/%s.program", s->folder, name);
        const struct timespec times[2] = {{1000 + i, 0}, {1000 + i, 0}};
        assert_int_equal(utimensat(AT_FDCWD, path, times, 0), 0);
    }
    file = store_open(s->folder, "b", "program"); /* of use: the newest now */
    assert_non_null(file);
    store_close(file, s->folder, "b", "program", true);
    assert_int_equal(store_write(s->folder, "keep", "truth", &part, 1, 1000), 0);
    assert_int_equal(store_write(s->folder, "g", "program", &part, 1, 300), 0);
    static const char *const left[] = {"b.program", "f.program", "g.program", "keep.truth"};
    assert_int_equal(count_files(s, path), 4);
    for (int i = 0; i < 4; i++) {
        snprintf(path, sizeof path, "%s/%s", s->folder, left[i]);
        assert_int_equal(unlink(path), 0);
    }
}

/* Whose writer ended before it was renamed; one that may still be written stays. */
static void orphans_are_removed(void **in)
{
    state *s = *in;
    const store_part part = {"x", 1};
    static const char *const name[] = {"old-1.part", ".new-1.part", ".old-1.part", ".old.party"};
    char path[4][400];
    for (int i = 0; i < 4; i++) {
        snprintf(path[i], sizeof path[i], "%s/%s", s->folder, name[i]);
        FILE *file = fopen(path[i], "wb");
        assert_non_null(file);
        fclose(file);
        const time_t age = i == 1 ? 3000 : 4000;
        const struct timespec then = {time(NULL) - age, 0}, times[2] = {then, then};
        assert_int_equal(utimensat(AT_FDCWD, path[i], times, 0), 0);
    }
    assert_int_equal(store_write(s->folder, "a", "program", &part, 1, 1000), 0);
    for (int i = 0; i < 4; i++) assert_int_equal(unlink(path[i]) == 0, i != 2);
    snprintf(path[0], sizeof path[0], "%s/a.program", s->folder);
    assert_int_equal(unlink(path[0]), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_program_is_taken_the_second_time),
        cmocka_unit_test(what_was_taken_still_counts_in_another_folder),
        cmocka_unit_test(what_does_not_fit_is_thrown_away),
        cmocka_unit_test(what_the_driver_refuses_is_compiled),
        cmocka_unit_test(another_driver_has_programs_of_its_own),
        cmocka_unit_test(nothing_fails_where_nothing_can_be_kept),
        cmocka_unit_test(the_folder_is_bounded),
        cmocka_unit_test(orphans_are_removed),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
