/* Legacy VTK files, ASCII and binary. */
#include "test_load_support.h"

#define HEAD "# vtk DataFile Version 3.0\na title\nASCII\nDATASET POLYDATA\n"

/* A file put together byte by byte; numbers big-endian. */
typedef struct bytes {
    unsigned char data[4000];
    size_t size;
} bytes;

static void add_text(bytes *b, const char *text)
{
    memcpy(b->data + b->size, text, strlen(text));
    b->size += strlen(text);
}

static void add_integer(bytes *b, uint64_t value, int size)
{
    for (int i = size - 1; i >= 0; i--) b->data[b->size++] = (unsigned char)(value >> (8 * i));
}

static void add_double(bytes *b, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, 8);
    add_integer(b, bits, 8);
}

static void add_float(bytes *b, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, 4);
    add_integer(b, bits, 4);
}

static mns_field *read_bytes(const char *name, const bytes *b)
{
    const char *path = in_folder(name);
    write_bytes(path, b->data, b->size);
    mns_input *input = open_file(path);
    mns_field *f = read_frame(input, 0);
    mns_input_close(input);
    return f;
}

static void ascii_points_and_their_data(void **state)
{
    (void)state;
    mns_field *f = read_text(
        "a.vtk", HEAD "POINTS 3 float\n1 2 3 4 5 6\n7 8\n9\nVERTICES 3 6\n1 0 1 1 1 2\n"
                      "CELL_DATA 3\nSCALARS cell int 1\nLOOKUP_TABLE default\n7 7 7\n"
                      "POINT_DATA 3\nSCALARS radius double\nLOOKUP_TABLE default\n0.5 0.25 1\n"
                      "VECTORS velocity float\n1 0 0 0 2 0 0 0 3\n"
                      "FIELD FieldData 2\nspeed%20x 1 3 double\n1 2\n3\npair 2 3 int\n1 2 3 4 5 6\n"
                      "METADATA\nINFORMATION 0\n\nSCALARS charge int 1\nLOOKUP_TABLE default\n-1 0 1\n");
    assert_int_equal(f->p.count, 3);
    expect_at(f, 0, 1, 2, 3);
    expect_at(f, 2, 7, 8, 9);
    assert_true(field_radius(f, 0) == 0.5 && field_radius(f, 1) == 0.25);
    assert_int_equal(f->p.column_count, 7);
    assert_true(column_of(f, "velocity_y")->value[1] == 2 && column_of(f, "speed x")->value[2] == 3);
    assert_true(column_of(f, "pair_2")->value[1] == 4 && column_of(f, "charge")->value[0] == -1);
    assert_string_equal(f->p.format, "vtk");
    assert_string_equal(f->radius_source, "file");
    mns_field_destroy(f);
}

static void ascii_sections_that_are_passed_over(void **state)
{
    (void)state;
    mns_field *f =
        read_text("a.vtk", "# vtk DataFile Version 5.1\nt\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                           "FIELD FieldData 1\nTIME 1 1 double\n0.5\nPOINTS 2 double\n1 2 3 4 5 6\n"
                           "METADATA\nINFORMATION 1\nNAME L2 LOCATION vtkDataArray\n\n"
                           "CELLS 3 2\nOFFSETS vtktypeint64\n0 1 2\nCONNECTIVITY vtktypeint64\n0 1\n"
                           "CELL_TYPES 2\n1\n1\n\nPOINT_DATA 2\nNORMALS n float\n0 0 1 0 0 1\n"
                           "TENSORS t float\n1 2 3 4 5 6 7 8 9 1 2 3 4 5 6 7 8 9\n"
                           "TEXTURE_COORDINATES uv 2 float\n0 1 0 1\nCOLOR_SCALARS rgb 3\n0 0.5 1 0 0 1\n"
                           "SCALARS s float\nLOOKUP_TABLE mine\n5 6\nLOOKUP_TABLE mine 2\n0 0 0 1 1 1 1 1\n");
    assert_int_equal(f->p.count, 2);
    expect_at(f, 1, 4, 5, 6);
    assert_true(column_of(f, "n_z")->value[0] == 1 && column_of(f, "t_9")->value[1] == 9);
    assert_true(column_of(f, "uv_2")->value[0] == 1 && column_of(f, "rgb_y")->value[0] == 0.5);
    assert_true(column_of(f, "s")->value[1] == 6);
    mns_field_destroy(f);
}

static void binary_points_and_their_data(void **state)
{
    (void)state;
    bytes b = {.size = 0};
    add_text(&b, "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 2 double\n");
    for (int i = 1; i <= 6; i++) add_double(&b, i + 0.125);
    add_text(&b, "\nCELLS 2 4\n");
    for (int i = 0; i < 4; i++) add_integer(&b, i % 2 ? 10 : 1, 4); /* 10 is a newline byte */
    add_text(&b, "\nCELL_TYPES 2\n");
    for (int i = 0; i < 2; i++) add_integer(&b, 1, 4);
    add_text(&b, "\nPOINT_DATA 2\nSCALARS radius float 1\nLOOKUP_TABLE default\n");
    add_float(&b, 0.5f), add_float(&b, 1.5f);
    add_text(&b, "\nFIELD FieldData 6\nbyte 1 2 unsigned_char\n");
    add_integer(&b, 255, 1), add_integer(&b, 3, 1);
    add_text(&b, "\nshort 1 2 short\n");
    add_integer(&b, 0xfffe, 2), add_integer(&b, 7, 2);
    add_text(&b, "\nint 1 2 int\n");
    add_integer(&b, 0xfffffffd, 4), add_integer(&b, 9, 4);
    add_text(&b, "\nlong 1 2 vtktypeint64\n");
    add_integer(&b, (uint64_t)-4, 8), add_integer(&b, 11, 8);
    add_text(&b, "\nbits 1 2 bit\n");
    add_integer(&b, 0x40, 1);
    add_text(&b, "\nvec 3 2 float\n");
    for (int i = 0; i < 6; i++) add_float(&b, (float)i);
    add_text(&b, "\n");
    mns_field *f = read_bytes("b.vtk", &b);
    expect_at(f, 0, 1.125, 2.125, 3.125);
    expect_at(f, 1, 4.125, 5.125, 6.125);
    assert_true(field_radius(f, 1) == 1.5);
    assert_true(column_of(f, "byte")->value[0] == 255 && column_of(f, "short")->value[0] == -2);
    assert_true(column_of(f, "int")->value[0] == -3 && column_of(f, "long")->value[0] == -4);
    assert_true(column_of(f, "bits")->value[0] == 0 && column_of(f, "bits")->value[1] == 1);
    assert_true(column_of(f, "vec_z")->value[1] == 5 && column_of(f, "int")->value[1] == 9);
    mns_field_destroy(f);
}

static void bad_ascii_files_name_their_line(void **state)
{
    (void)state;
    static const struct {
        const char *text, *where, *words;
    } cases[] = {
        {HEAD "POINTS 2 float\n1 2 3\n4 5\n", ":7: ", "ends after 5 of 6 values of POINTS"},
        {HEAD "POINTS 1000000000000000000 float\n1 2 3\n", ":6: ", "ends after 3 of 3000000000000000000"},
        {HEAD "POINTS 9000000000000000000 float\n1 2 3\n", ":5: ", "POINTS"},
        {HEAD "POINTS 2 float\n1 2 3\n4 nan 6\n", ":7: ", "POINTS has 'nan'; expected a finite number"},
        {HEAD "POINTS 2 float\n1 2 3\n4 x 6\n", ":7: ", "POINTS has 'x'; expected a number"},
        {HEAD "POINTS 2 string\n", ":5: ", "a type of numbers"},
        {HEAD "POINTS 1 float\n1 2 3\nPOINT_DATA 2\n", ":7: ", "as many as there are POINTS"},
        {HEAD "POINTS 1 float\n1 2 3\nPOINT_DATA 1\nSCALARS radius float\nLOOKUP_TABLE default\n0\n", ": ",
         "the radius of point 0 is 0"},
        {HEAD "POINTS 1 float\n1 2 3\nPOINT_DATA 1\nFIELD f 2\na 1 1 float\n1\n",
         ":10: ", "as many arrays as it says"},
        {HEAD "POINTS 1 float\n1 2 3\nPOINT_DATA 1\nFIELD f 1\na 1 2 float\n1 2\n",
         ":9: ", "as many tuples as POINT_DATA"},
        {HEAD "POINTS 1 float\n1 2 3\nNONSENSE\n", ":7: ", "'NONSENSE'; expected a section"},
        {HEAD, ":4: ", "without POINTS"},
        {"# vtk DataFile Version 3.0\nt\nTEXT\n", ":3: ", "'TEXT'; expected ASCII or BINARY"},
        {"# vtk DataFile Version 3.0\nt\n", ":2: ", "the file ends"},
        {"# vtk DataFile Version 3.0\nt\nASCII\nPOINTS 1 float\n", ":4: ", "expected DATASET"},
        {"# vtk DataFile Version 3.0\nt\n\r \r\n", ":3: ", "the file ends"}, /* found by the fuzzer */
        {"hello", ":1: ", "expected '# vtk DataFile Version'"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        expect_failure("bad.vtk", cases[i].text, cases[i].where, cases[i].words);
}

static void bad_binary_files_name_their_byte(void **state)
{
    (void)state;
    static const char head[] = "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET POLYDATA\nPOINTS 1 double\n";
    char where[64];
    bytes b = {.size = 0};
    add_text(&b, head);
    add_double(&b, 1), add_double(&b, 2);
    snprintf(where, sizeof where, ": byte %zu: ", b.size);
    expect_bytes_failure("bad.vtk", b.data, b.size, where, "ends early; expected 8 more bytes");
    snprintf(where, sizeof where, ": byte %zu: ", b.size);
    add_double(&b, NAN);
    expect_bytes_failure("bad.vtk", b.data, b.size, where,
                         "POINTS has the value nan; expected a finite number");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ascii_points_and_their_data),
        cmocka_unit_test(ascii_sections_that_are_passed_over),
        cmocka_unit_test(binary_points_and_their_data),
        cmocka_unit_test(bad_ascii_files_name_their_line),
        cmocka_unit_test(bad_binary_files_name_their_byte),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
