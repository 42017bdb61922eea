/* XYZ and extended XYZ. */
#include "test_load_support.h"

static void plain_atoms(void **state)
{
    (void)state;
    mns_field *f = read_text("water.xyz", "3\nwater\nO 0 0 0.119\nH  0 0.763 -0.477\nH\t0 -0.763 -0.477\n");
    assert_int_equal(f->p.count, 3);
    expect_at(f, 1, 0, 0.763, -0.477);
    assert_string_equal(label_of(f, "element", 0), "O");
    assert_string_equal(label_of(f, "element", 2), "H");
    assert_string_equal(f->p.format, "xyz");
    assert_string_equal(f->radius_source, "default spacing");
    assert_false(f->p.has_cell);
    mns_field_destroy(f);
}

static void plain_columns_that_follow_are_kept(void **state)
{
    (void)state;
    mns_field *f = read_text("a.xyz", "2\n\nC 1 2 3 -0.5 sp2\nC 4 5 6 0.5 sp3\n");
    assert_true(column_of(f, "column5")->min == -0.5 && column_of(f, "column5")->max == 0.5);
    assert_string_equal(label_of(f, "column6", 1), "sp3");
    mns_field_destroy(f);
    f = read_text("b.xyz", "2\n\n1 2 3\n4 5 6\n");
    expect_at(f, 1, 4, 5, 6);
    assert_int_equal(f->p.column_count, 0);
    mns_field_destroy(f);
}

static void extended_properties_name_the_columns(void **state)
{
    (void)state;
    mns_field *f = read_text(
        "e.xyz",
        "2\nLattice=\"10 0 0 1 11 0 2 3 12\" Origin='-1 -2 -3' Time=0.5 "
        "Properties=id:I:1:species:S:1:pos:R:3:radius:R:1:velo:R:3:fixed:L:1:pair:R:2 pbc=\"T T F\"\n"
        "7 Na 1 2 3 0.5 4 5 6 T 8 9\n9 Cl 11 12 13 0.75 14 15 16 F 18 19\n");
    assert_int_equal(f->p.count, 2);
    expect_at(f, 0, 1, 2, 3);
    expect_at(f, 1, 11, 12, 13);
    assert_true(field_radius(f, 0) == 0.5 && field_radius(f, 1) == 0.75);
    assert_string_equal(f->radius_source, "file");
    assert_string_equal(label_of(f, "element", 1), "Cl");
    assert_true(column_of(f, "id")->value[1] == 9 && column_of(f, "velo_y")->value[0] == 5);
    assert_true(column_of(f, "fixed")->value[0] == 1 && column_of(f, "fixed")->value[1] == 0);
    assert_true(column_of(f, "pair_2")->value[1] == 19);
    assert_true(f->p.has_cell && f->p.cell_origin[2] == -3 && f->p.cell[0][0] == 10 && f->p.cell[1][0] == 1);
    assert_true(f->p.cell[2][1] == 3 && f->p.cell[2][2] == 12);
    mns_field_destroy(f);
}

static void frames_follow_one_another(void **state)
{
    (void)state;
    static const char text[] = "1\na\nH 1 2 3\n2\nb\nH 4 5 6\nH 7 8 9\n\n0\nnone\n1\nd\nH 0 0 1\n\n\n";
    for (int packed = 0; packed <= 1; packed++) {
        const char *path = in_folder("frames.xyz");
        if (packed)
            write_gzip(path, text, strlen(text));
        else
            write_bytes(path, text, strlen(text));
        mns_input *input = open_file(path);
        assert_int_equal(mns_input_frames(input), 4);
        static const size_t order[] = {3, 1, 0, 2, 1, 3, 3}, counts[] = {1, 2, 0, 1};
        static const double last_z[] = {3, 9, 0, 1};
        for (size_t i = 0; i < sizeof order / sizeof *order; i++) {
            mns_field *f = read_frame(input, order[i]);
            assert_int_equal(f->p.count, counts[order[i]]);
            if (f->p.count) assert_true(f->p.axis[2][f->p.count - 1] == last_z[order[i]]);
            mns_field_destroy(f);
        }
        mns_field *f = NULL;
        mns_error error;
        assert_int_equal(mns_input_read(input, 4, &f, &error), MNS_ERROR_USAGE);
        assert_non_null(strstr(error.text, "no frame 4; the input has 4"));
        mns_input_close(input);
    }
}

static void bad_files_name_their_line(void **state)
{
    (void)state;
    static const struct {
        const char *text, *where, *words;
    } cases[] = {
        {"2\nc\nH 1 2 3\n", ":3: ", "ends after 1 atoms of 2"},
        {"1000000000000000000\nc\nH 1 2 3\n", ":3: ", "ends after 1 atoms of 1000000000000000000"},
        {"99999999999999999999\nc\n", ":1: ", "expected a number of atoms"},
        {"2\n", ":1: ", "the file ends"},
        {"1\nc\nH 1 2\n2\n", ":3: ", "H"},
        {"1\nc\nH 1\n", ":3: ", "2 columns; expected an element"},
        {"2\nc\nH 1 2 3\nH 1 2 3 4\n", ":4: ", "5 columns; expected 4"},
        {"1\nc\nH 1 NaN 3\n", ":3: ", "y is 'NaN'; expected a finite number"},
        {"1\nc\nH 1 2 3\nHello\n", ":4: ", "'Hello'; expected a number of atoms"},
        {"1\nProperties=pos:R:3:radius:R:1\n1 2 3 0\n", ":3: ", "radius is 0; expected one above 0"},
        {"1\nProperties=species:S:1\nH\n", ":2: ", "expected pos:R:3"},
        {"1\nProperties=pos:R:3:q\n1 2 3\n", ":2: ", "expected name:type:columns"},
        {"1\nProperties=pos:Q:3\n1 2 3\n", ":2: ", "expected name:type:columns"},
        {"1\nProperties=pos:R:3:a:R:1000000000000\n1 2 3\n", ":2: ", "expected name:type:columns"},
        {"1\nProperties=pos:R:3:ok:L:1\n1 2 3 maybe\n", ":3: ", "expected T or F"},
        {"1\nLattice=\"1 2 3\"\nH 1 2 3\n", ":2: ", "expected 9 numbers"},
        {"1\nLattice=\"1 0 0 0 1 0 0 0 1\" Origin=\"a b c\"\nH 1 2 3\n", ":2: ", "expected 3 numbers"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        expect_failure("bad.xyz", cases[i].text, cases[i].where, cases[i].words);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plain_atoms),
        cmocka_unit_test(plain_columns_that_follow_are_kept),
        cmocka_unit_test(extended_properties_name_the_columns),
        cmocka_unit_test(frames_follow_one_another),
        cmocka_unit_test(bad_files_name_their_line),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
