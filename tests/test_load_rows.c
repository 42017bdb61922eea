/* Rows read in pieces, on several cores: the same bits, labels and lines of failures as one row after
 * another. */
#include "test_load_support.h"

#include <omp.h>

#include "load/format.h"

/* A text in the making, and what it should give. */
typedef struct sample {
    char *text;
    size_t size, capacity;
    double *value; /* three a row */
    int *label;    /* by the row's word */
    uint64_t *line;
    size_t rows;
    uint64_t lines;
    uint32_t random;
} sample;

static uint32_t draw(sample *s)
{
    s->random = s->random * 1664525u + 1013904223u;
    return s->random >> 8;
}

static void add(sample *s, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    s->size += (size_t)vsnprintf(s->text + s->size, s->capacity - s->size, format, arguments);
    va_end(arguments);
    assert_true(s->size < s->capacity);
}

static sample sample_begin(size_t rows, uint32_t seed)
{
    sample s = {.capacity = rows * 120 + 1000, .random = seed};
    s.text = malloc(s.capacity);
    s.value = malloc(rows * 3 * sizeof *s.value);
    s.label = malloc(rows * sizeof *s.label);
    s.line = malloc(rows * sizeof *s.line);
    assert_true(s.text && s.value && s.label && s.line);
    return s;
}

static void sample_free(sample *s)
{
    free(s->text);
    free(s->value);
    free(s->label);
    free(s->line);
}

/* A number as people write them, and what the C library takes it for. */
static double add_number(sample *s, const char *behind)
{
    static const char *const formats[] = {"%.17g", "%g", "%.3f", "%.9e", "%+.0f"};
    double value = ((double)draw(s) / 0x1p24 - 0.5) * (draw(s) % 8 ? 10 : 1e7);
    size_t from = s->size;
    add(s, formats[draw(s) % 5], value);
    value = strtod(s->text + from, NULL);
    add(s, "%s", behind);
    return value;
}

/* A row x,y,z,word with an end of one kind or another; new words turn up all along. */
static void add_row(sample *s)
{
    const char *end = draw(s) % 3 ? "\n" : "\r\n";
    size_t newest = s->rows / 50 + 1;
    double *v = s->value + 3 * s->rows;
    for (int k = 0; k < 3; k++) v[k] = add_number(s, draw(s) % 5 ? "," : " , ");
    s->label[s->rows] = (int)(s->rows % 50 ? draw(s) % newest : newest - 1);
    add(s, draw(s) % 4 ? "w%d%s" : "\"w%d\"%s", s->label[s->rows], end);
    s->line[s->rows++] = ++s->lines;
}

static void add_rows(sample *s, size_t rows)
{
    static const char *const between[] = {"\n", "# a comment, with commas\n", " \t\r\n"};
    for (size_t i = 0; i < rows; i++) {
        add_row(s);
        if (draw(s) % 16) continue;
        add(s, "%s", between[draw(s) % 3]);
        s->lines++;
    }
}

static mns_status read_sample(const sample *s, particles *p, mns_error *error)
{
    load_stream stream;
    *error = (mns_error){0};
    mns_status status = stream_open_memory(&stream, s->text, s->size, "memory", error);
    if (!status) status = format_csv.read(&stream, p);
    stream_close(&stream);
    return status;
}

static void expect_sample(const sample *s)
{
    particles p = {0};
    mns_error error;
    if (read_sample(s, &p, &error)) fail_msg("%s", error.text);
    assert_int_equal(p.count, s->rows);
    assert_true(p.column_count == 1 && p.column[0].label);
    for (size_t i = 0; i < s->rows; i++) {
        for (int k = 0; k < 3; k++)
            if (p.axis[k][i] != s->value[3 * i + (size_t)k])
                fail_msg("row %zu: %.17g, not %.17g", i, p.axis[k][i], s->value[3 * i + (size_t)k]);
        char word[16];
        snprintf(word, sizeof word, "w%d", s->label[i]);
        size_t number = (size_t)p.column[0].value[i];
        assert_true(number < p.column[0].label_count);
        assert_string_equal(p.column[0].label[number], word);
    }
    size_t newest = 0; /* words are numbered in the order they came */
    for (size_t i = 0; i < s->rows; i++) {
        size_t number = (size_t)p.column[0].value[i];
        assert_true(number <= newest);
        newest += number == newest;
    }
    assert_int_equal(p.column[0].label_count, newest);
    particles_free(&p);
}

/* The cuts between pieces fall on every byte of a row in turn, since a comment of every length comes before.
 */
static void cuts_fall_anywhere(void **state)
{
    (void)state;
    for (int before = 0; before < 40; before++) {
        sample s = sample_begin(6000, 7);
        add(&s, "#%*s\nx,y,z,word\n", before, "");
        s.lines = 2;
        add_rows(&s, 6000);
        if (before % 2) s.size--; /* no newline at the end */
        assert_true(s.size > 150000);
        expect_sample(&s);
        sample_free(&s);
    }
}

static void threads_do_not_matter(void **state)
{
    (void)state;
    int threads = omp_get_max_threads();
    sample s = sample_begin(300000, 3); /* longer than a buffer */
    add(&s, "x,y,z,word\n");
    s.lines = 1;
    add_rows(&s, 300000);
    assert_true(s.size > 10000000);
    for (int i = 1; i <= 4; i += 3) {
        omp_set_num_threads(i);
        expect_sample(&s);
    }
    omp_set_num_threads(threads);
    sample_free(&s);
}

/* The first bad row is named, wherever it stands and however many follow it. */
static void a_bad_row_names_its_line(void **state)
{
    (void)state;
    sample s = sample_begin(6000, 11);
    add(&s, "x,y,z,word\n");
    s.lines = 1;
    add_rows(&s, 6000);
    char *good = malloc(s.size), begin[32];
    assert_non_null(good);
    memcpy(good, s.text, s.size);
    for (size_t row = 1; row < s.rows; row += 1 + row / 7) {
        const char *at = s.text;
        for (uint64_t line = 1; line < s.line[row]; line++) at = strchr(at, '\n') + 1;
        for (char *bad = s.text + (at - s.text); (bad = strchr(bad, ',')); bad += 100000) *bad = '?';
        particles p = {0};
        mns_error error;
        assert_int_equal(read_sample(&s, &p, &error), MNS_ERROR_INPUT);
        particles_free(&p);
        snprintf(begin, sizeof begin, "memory:%llu: ", (unsigned long long)s.line[row]);
        if (strncmp(error.text, begin, strlen(begin)) != 0)
            fail_msg("'%s' is not '%s...'", error.text, begin);
        memcpy(s.text, good, s.size);
    }
    free(good);
    sample_free(&s);
}

/* Unpacked by and by, blocks are of any size; and a gzip stream that is cut off says so only after the bad
 * row before. */
static void packed_rows_are_the_same(void **state)
{
    (void)state;
    sample s = sample_begin(30000, 5);
    add(&s, "x,y,z,word\n");
    s.lines = 1;
    add_rows(&s, 30000);
    const char *plain = in_folder("plain.csv"), *packed = in_folder("packed.csv.gz");
    write_bytes(plain, s.text, s.size);
    write_gzip(packed, s.text, s.size);
    mns_input *input[2] = {open_file(plain), open_file(packed)};
    mns_field *field[2] = {read_frame(input[0], 0), read_frame(input[1], 0)};
    assert_true(field[0]->p.count == s.rows && field[1]->p.count == s.rows);
    for (int k = 0; k < 3; k++)
        assert_memory_equal(field[0]->p.axis[k], field[1]->p.axis[k], s.rows * sizeof(double));
    for (int i = 0; i < 2; i++) {
        mns_field_destroy(field[i]);
        mns_input_close(input[i]);
    }
    *strchr(s.text + 11, ',') = '?'; /* of the first row */
    write_gzip(packed, s.text, s.size);
    unsigned char *bytes = malloc(s.size);
    FILE *file = fopen(packed, "rb");
    assert_true(bytes && file);
    size_t size = fread(bytes, 1, s.size, file);
    fclose(file);
    assert_true(size > 100000);
    expect_bytes_failure("cut.csv.gz", bytes, size / 2, ":2: ", "expected a number");
    free(bytes);
    sample_free(&s);
}

/* Frames end where their counts say, in the middle of a block. */
static void frames_end_within_a_block(void **state)
{
    (void)state;
    enum { ATOMS = 5000, FRAMES = 5 };
    char *text = malloc(FRAMES * (ATOMS * 40 + 200)), *at = text;
    for (int frame = 0; frame < FRAMES; frame++) {
        at += sprintf(at, "ITEM: TIMESTEP\n%d\nITEM: NUMBER OF ATOMS\n%d\n", frame, ATOMS);
        at += sprintf(at, "ITEM: BOX BOUNDS pp pp pp\n0 9\n0 9\n0 9\nITEM: ATOMS id type x y z\n");
        for (int i = 0; i < ATOMS; i++)
            at +=
                sprintf(at, "%d 1 %d %d.5 %d\n", (i * 7 + frame) % ATOMS, i, frame, (i * 7 + frame) % ATOMS);
    }
    const char *path = in_folder("a.lammpstrj");
    write_bytes(path, text, (size_t)(at - text));
    mns_input *input = open_file(path);
    assert_int_equal(mns_input_frames(input), FRAMES);
    for (size_t frame = 0; frame < FRAMES; frame++) {
        mns_field *field = read_frame(input, (frame * 3) % FRAMES);
        assert_int_equal(field->p.count, ATOMS);
        for (size_t i = 0; i < ATOMS; i++) /* sorted by id, which is z */
            assert_true(field->p.axis[2][i] == (double)i &&
                        field->p.axis[1][i] == (double)(frame * 3 % FRAMES) + 0.5);
        mns_field_destroy(field);
    }
    mns_input_close(input);
    const char *end = strchr(text + (at - text) / FRAMES - 1000, '\n') + 1; /* the frame is short */
    expect_bytes_failure("short.lammpstrj", text, (size_t)(end - text), ":", " atoms of 5000");
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cuts_fall_anywhere),        cmocka_unit_test(threads_do_not_matter),
        cmocka_unit_test(a_bad_row_names_its_line),  cmocka_unit_test(packed_rows_are_the_same),
        cmocka_unit_test(frames_end_within_a_block),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
