/* What is common to all inputs: formats told apart, gzip, sequences, and what cannot be opened. */
#include "test_load_support.h"

#include <sys/stat.h>

static const char csv_text[] = "x,y,z,r\n1,2,3,0.5\n4,5,6,0.5\n";

static void content_tells_before_the_name(void **state)
{
    (void)state;
    static const struct {
        const char *name, *text, *format;
    } cases[] = {
        {"a.pdb", "x,y,z\n1,2,3\n", "csv"},
        {"a.csv", "1\nc\nH 1 2 3\n", "xyz"},
        {"a.csv", "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n0\nITEM: ATOMS x y z\n", "lammps"},
        {"a.xyz", "# vtk DataFile Version 2.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 1 float\n1 2 3\n", "vtk"},
        {"a.txt", "ATOM      1  N   GLY A   1       1.000   2.000   3.000\n", "pdb"},
        {"noname", "1 2 3\n", "csv"},
        {"noname", "# c\nZ;Y;X\n1;2;3\n", "csv"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        mns_field *f = read_text(cases[i].name, cases[i].text);
        assert_string_equal(f->p.format, cases[i].format);
        mns_field_destroy(f);
    }
}

static void the_name_tells_where_content_does_not(void **state)
{
    (void)state;
    expect_failure("g.csv", "garbage\n", ":1: ", "no column 'x'");
    expect_failure("g.tsv.gz", "garbage\n", ":1: ", "no column 'x'");
    expect_failure("g.XYZ", "garbage\n", ":1: ", "expected a number of atoms");
    expect_failure("g.lammpstrj", "garbage\n", ":1: ", "ITEM:");
    expect_failure("g.ent", "garbage\n", ":1: ", "no ATOM or HETATM");
    expect_failure("g.vtk", "garbage\n", ":1: ", "vtk DataFile");
    expect_failure("g.bin", "garbage\n", ": ", "unknown format; expected CSV, XYZ");
    expect_bytes_failure("g", "\0\1\2\3\xff\xfe", 6, ": ", "unknown format");
}

static void gzip_reads_as_the_plain_file(void **state)
{
    (void)state;
    const char *path = in_folder("a.csv.gz");
    write_gzip(path, csv_text, strlen(csv_text));
    mns_input *input = open_file(path);
    mns_field *f = read_frame(input, 0);
    assert_int_equal(f->p.count, 2);
    expect_at(f, 1, 4, 5, 6);
    mns_field_destroy(f);
    f = read_frame(input, 0); /* and again from its beginning */
    assert_int_equal(f->p.count, 2);
    mns_field_destroy(f);
    mns_input_close(input);
}

static size_t read_whole(const char *path, unsigned char *to, size_t size)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    size_t got = fread(to, 1, size, file);
    fclose(file);
    return got;
}

static void gzip_members_follow_one_another(void **state)
{
    (void)state;
    unsigned char data[1000];
    const char *path = in_folder("two.gz");
    write_gzip(path, csv_text, strlen(csv_text));
    size_t size = read_whole(path, data, sizeof data);
    write_gzip(path, "7,8,9,0.5\n", 10);
    size += read_whole(path, data + size, sizeof data - size);
    memset(data + size, 0, 20); /* padding is legal */
    write_bytes(path, data, size + 20);
    mns_input *input = open_file(path);
    mns_field *f = read_frame(input, 0);
    assert_int_equal(f->p.count, 3);
    expect_at(f, 2, 7, 8, 9);
    mns_field_destroy(f);
    mns_input_close(input);
    memset(data + size, 'j', 4);
    char where[32];
    snprintf(where, sizeof where, ": byte %zu: ", size);
    expect_bytes_failure("two.gz", data, size + 4, where, "after the end of the gzip stream");
}

static void cut_and_damaged_gzip_name_the_byte(void **state)
{
    (void)state;
    enum { ROWS = 20000 };
    char *text = malloc(ROWS * 40), *at = text;
    unsigned char *data = malloc(ROWS * 40);
    for (int i = 0; i < ROWS; i++)
        at += sprintf(at, "%d,%d.%d,-%d,1\n", i, i * 7919 % 9973, i, i * 31 % 1009);
    const char *path = in_folder("whole.gz");
    write_gzip(path, text, (size_t)(at - text));
    size_t size = read_whole(path, data, ROWS * 40);
    char where[48];
    for (size_t cut = 1; cut <= 3; cut++) {
        size_t left = cut == 1 ? size - 3 : cut == 2 ? size / 2 : 12;
        snprintf(where, sizeof where, ": byte %zu: ", left);
        expect_bytes_failure("cut.gz", data, left, where, "the gzip stream is cut off; expected more bytes");
    }
    data[size - 6] ^= 1; /* the checksum */
    expect_bytes_failure("sum.gz", data, size, ": byte ",
                         "the gzip stream is damaged (incorrect data check)");
    data[size - 6] ^= 1;
    for (size_t i = size / 3; i < size / 3 + 400; i++) data[i] = 0xff;
    mns_error error;
    path = in_folder("damaged.gz");
    write_bytes(path, data, size);
    assert_int_equal(read_failing(path, &error), MNS_ERROR_INPUT);
    assert_non_null(strstr(error.text, "damaged.gz"));
    free(data);
    free(text);
}

static void what_cannot_be_opened_is_told(void **state)
{
    (void)state;
    mns_error error;
    assert_int_equal(read_failing(in_folder("absent.csv"), &error), MNS_ERROR_IO);
    assert_non_null(strstr(error.text, "absent.csv: cannot open: No such file"));
    assert_int_equal(read_failing(folder, &error), MNS_ERROR_IO);
    assert_non_null(strstr(error.text, "is a folder; expected a particle file"));
    assert_int_equal(read_failing("/dev/null", &error), MNS_ERROR_IO);
    assert_non_null(strstr(error.text, "/dev/null: is not an ordinary file"));
    const char *pipe = in_folder("pipe");
    assert_int_equal(mkfifo(pipe, 0600), 0);
    assert_int_equal(read_failing(pipe, &error), MNS_ERROR_IO); /* and does not hang */
    expect_failure("empty.csv", "", ": ", "the file is empty");
    const char *path = in_folder("locked.csv");
    write_bytes(path, csv_text, strlen(csv_text));
    chmod(path, 0);
    if (access(path, R_OK) != 0) { /* root may read it all the same */
        assert_int_equal(read_failing(path, &error), MNS_ERROR_IO);
        assert_non_null(strstr(error.text, "Permission denied"));
    }
    write_gzip(path = in_folder("empty.gz"), "", 0);
    assert_int_equal(read_failing(path, &error), MNS_ERROR_INPUT);
    assert_non_null(strstr(error.text, "nothing is in the file"));
}

static void long_paths_keep_their_end(void **state)
{
    (void)state;
    char path[700];
    memset(path, 'd', 600);
    strcpy(path + 600, "/field.csv");
    path[100] = path[300] = '/';
    mns_error error;
    assert_int_equal(read_failing(path, &error), MNS_ERROR_IO);
    assert_non_null(strstr(error.text, "ddd/field.csv: cannot open"));
    assert_memory_equal(error.text, "...", 3);
}

static void names_make_one_sequence(void **state)
{
    (void)state;
    char paths[3][128];
    static const char *const texts[3] = {"1,0,0\n", "1\na\nH 2 0 0\n1\nb\nH 3 0 0\n", "4,0,0\n"};
    const char *names[3];
    for (int i = 0; i < 3; i++) {
        snprintf(paths[i], sizeof paths[i], "%s/frame.%d", folder, i);
        write_bytes(paths[i], texts[i], strlen(texts[i]));
        names[i] = paths[i];
    }
    mns_input *input = NULL;
    mns_input_options options = {.radius = 0.5, .radius_scale = 3, .iso = 0.3, .kernel = MNS_KERNEL_WYVILL};
    assert_int_equal(mns_input_open(names, 3, &options, &input, NULL), MNS_OK);
    assert_int_equal(mns_input_frames(input), 4);
    static const size_t order[] = {0, 1, 2, 3, 3, 1, 0, 2};
    for (size_t i = 0; i < 8; i++) {
        mns_field *f = read_frame(input, order[i]);
        expect_at(f, 0, (double)order[i] + 1, 0, 0);
        assert_true(f->uniform_radius == 1.5 && f->iso == 0.3 && f->kernel == MNS_KERNEL_WYVILL);
        assert_string_equal(f->radius_source, "option");
        mns_field_destroy(f);
    }
    unlink(paths[0]); /* files may go while a sequence is drawn */
    mns_field *f = NULL;
    mns_error error;
    assert_int_equal(mns_input_read(input, 0, &f, &error), MNS_ERROR_IO);
    f = read_frame(input, 3);
    mns_field_destroy(f);
    mns_input_close(input);
    mns_input_close(NULL);
}

static void failures_of_the_field_name_the_file(void **state)
{
    (void)state;
    const char *path = in_folder("far.csv");
    write_bytes(path, "1,2,1e301\n", 10);
    mns_error error;
    assert_int_equal(read_failing(path, &error), MNS_ERROR_UNSUPPORTED);
    assert_non_null(strstr(error.text, "far.csv: particle 0: z = 1e+301"));
}

static void nothing_named_is_a_usage_error(void **state)
{
    (void)state;
    mns_input *input = NULL;
    const char *none = "";
    assert_int_equal(mns_input_open(NULL, 0, NULL, &input, NULL), MNS_ERROR_USAGE);
    assert_int_equal(mns_input_open(&none, 1, NULL, &input, NULL), MNS_ERROR_USAGE);
    assert_null(input);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(content_tells_before_the_name),
        cmocka_unit_test(the_name_tells_where_content_does_not),
        cmocka_unit_test(gzip_reads_as_the_plain_file),
        cmocka_unit_test(gzip_members_follow_one_another),
        cmocka_unit_test(cut_and_damaged_gzip_name_the_byte),
        cmocka_unit_test(what_cannot_be_opened_is_told),
        cmocka_unit_test(long_paths_keep_their_end),
        cmocka_unit_test(names_make_one_sequence),
        cmocka_unit_test(failures_of_the_field_name_the_file),
        cmocka_unit_test(nothing_named_is_a_usage_error),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
