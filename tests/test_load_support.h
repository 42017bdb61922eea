/* For the tests of input: files made on the spot, fields read from them, messages looked at. */
#ifndef MNS_TEST_LOAD_SUPPORT_H
#define MNS_TEST_LOAD_SUPPORT_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include <zlib.h>

#include "field/field.h"

#define MAYBE_UNUSED __attribute__((unused))

/* A folder of this process, made once by make_folder and removed by remove_folder (group set-up and
 * tear-down). */
static char folder[64];

MAYBE_UNUSED static int make_folder(void **state)
{
    (void)state;
    snprintf(folder, sizeof folder, "/tmp/meniscus_test_XXXXXX");
    return mkdtemp(folder) ? 0 : -1;
}

MAYBE_UNUSED static int remove_folder(void **state)
{
    (void)state;
    char command[128];
    snprintf(command, sizeof command, "rm -r '%s'", folder);
    return system(command);
}

/* The path of a file of that name in the folder; each of four calls has its own text. */
MAYBE_UNUSED static const char *in_folder(const char *name)
{
    static char path[4][128];
    static int next;
    next = (next + 1) % 4;
    snprintf(path[next], sizeof path[next], "%s/%s", folder, name);
    return path[next];
}

MAYBE_UNUSED static void write_bytes(const char *path, const void *data, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    fclose(file);
}

MAYBE_UNUSED static void write_gzip(const char *path, const void *data, size_t size)
{
    gzFile file = gzopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(gzwrite(file, data, (unsigned)size), size);
    gzclose(file);
}

MAYBE_UNUSED static mns_input *open_file(const char *path)
{
    mns_input *input = NULL;
    mns_error error = {0};
    if (mns_input_open(&path, 1, NULL, &input, &error)) fail_msg("%s", error.text);
    return input;
}

MAYBE_UNUSED static mns_field *read_frame(mns_input *input, size_t frame)
{
    mns_field *field = NULL;
    mns_error error = {0};
    if (mns_input_read(input, frame, &field, &error)) fail_msg("frame %zu: %s", frame, error.text);
    return field;
}

/* The first frame of a file of that name and text. */
MAYBE_UNUSED static mns_field *read_text(const char *name, const char *text)
{
    const char *path = in_folder(name);
    write_bytes(path, text, strlen(text));
    mns_input *input = open_file(path);
    mns_field *field = read_frame(input, 0);
    mns_input_close(input);
    return field;
}

/* What opening a file and reading all its frames says first. */
MAYBE_UNUSED static mns_status read_failing(const char *path, mns_error *error)
{
    mns_input *input = NULL;
    *error = (mns_error){0};
    mns_status status = mns_input_open(&path, 1, NULL, &input, error);
    for (size_t i = 0; !status && i < mns_input_frames(input); i++) {
        mns_field *field = NULL;
        status = mns_input_read(input, i, &field, error);
        assert_true((field != NULL) == (status == MNS_OK));
        mns_field_destroy(field);
    }
    mns_input_close(input);
    return status;
}

/* A file of that content fails with a message that has the file's name, `where` right behind it, and `words`.
 */
MAYBE_UNUSED static void expect_bytes_failure(const char *name, const void *data, size_t size,
                                              const char *where, const char *words)
{
    const char *path = in_folder(name);
    char begin[256];
    mns_error error;
    write_bytes(path, data, size);
    mns_status status = read_failing(path, &error);
    if (status != MNS_ERROR_INPUT && status != MNS_ERROR_UNSUPPORTED)
        fail_msg("%s: status %d, '%s'", name, status, error.text);
    snprintf(begin, sizeof begin, "%s%s", path, where);
    if (strncmp(error.text, begin, strlen(begin)) != 0)
        fail_msg("'%s' does not begin with '%s'", error.text, begin);
    if (!strstr(error.text, words)) fail_msg("'%s' lacks '%s'", error.text, words);
}

MAYBE_UNUSED static void expect_failure(const char *name, const char *text, const char *where,
                                        const char *words)
{
    expect_bytes_failure(name, text, strlen(text), where, words);
}

/* The column of that name. */
MAYBE_UNUSED static const particles_column *column_of(const mns_field *field, const char *name)
{
    for (size_t i = 0; i < field->p.column_count; i++)
        if (!strcmp(field->p.column[i].name, name)) return &field->p.column[i];
    fail_msg("no column '%s'", name);
    return NULL;
}

MAYBE_UNUSED static const char *label_of(const mns_field *field, const char *name, size_t row)
{
    const particles_column *column = column_of(field, name);
    assert_non_null(column->label);
    return column->label[(size_t)column->value[row]];
}

MAYBE_UNUSED static void expect_at(const mns_field *field, size_t i, double x, double y, double z)
{
    if (field->p.axis[0][i] != x || field->p.axis[1][i] != y || field->p.axis[2][i] != z)
        fail_msg("ball %zu is at %.17g %.17g %.17g", i, field->p.axis[0][i], field->p.axis[1][i],
                 field->p.axis[2][i]);
}

#endif
