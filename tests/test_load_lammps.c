/* LAMMPS text dumps. */
#include "test_load_support.h"

#define HEAD(count, box) "ITEM: TIMESTEP\n100\nITEM: NUMBER OF ATOMS\n" count "\n" box
#define UPRIGHT          "ITEM: BOX BOUNDS pp pp ff\n0 10\n-1 1\n2 6\n"

static void atoms_are_sorted_by_id(void **state)
{
    (void)state;
    mns_field *f = read_text(
        "a.lammpstrj",
        HEAD("4", UPRIGHT) "ITEM: ATOMS id type x y z vx element \n"
                           "3 1 3 0 0 0.3 O \n1 2 1 0 0 0.1 H \n4 1 4 0 0 0.4 O\n2 2 2 0 0 0.2 H\n");
    assert_int_equal(f->p.count, 4);
    for (size_t i = 0; i < 4; i++) {
        expect_at(f, i, (double)i + 1, 0, 0);
        assert_true(column_of(f, "id")->value[i] == (double)i + 1);
        assert_string_equal(label_of(f, "element", i), i < 2 ? "H" : "O");
    }
    assert_true(column_of(f, "vx")->value[2] == 0.3 && column_of(f, "type")->value[0] == 2);
    assert_string_equal(f->p.format, "lammps");
    assert_true(f->p.has_cell && f->p.cell[0][0] == 10 && f->p.cell_origin[1] == -1 && f->p.cell[2][2] == 4);
    mns_field_destroy(f);

    /* Ids far apart, and two alike that keep their order. */
    f = read_text("b.dump",
                  HEAD("4", UPRIGHT) "ITEM: ATOMS id x y z\n9000000000 4 0 0\n5 2 0 0\n5 3 0 0\n-7 1 0 0\n");
    for (size_t i = 0; i < 4; i++) expect_at(f, i, (double)i + 1, 0, 0);
    mns_field_destroy(f);
}

static void every_kind_of_position(void **state)
{
    (void)state;
    mns_field *f = read_text("u", HEAD("1", UPRIGHT) "ITEM: ATOMS xu yu zu\n11 12 13\n");
    expect_at(f, 0, 11, 12, 13);
    mns_field_destroy(f);
    f = read_text("s", HEAD("1", UPRIGHT) "ITEM: ATOMS xs ys zs\n0.5 0.25 0.75\n");
    expect_at(f, 0, 5, -0.5, 5);
    mns_field_destroy(f);
    f = read_text("su", HEAD("1", UPRIGHT) "ITEM: ATOMS zsu ysu xsu\n0.75 0.25 1.5\n");
    expect_at(f, 0, 15, -0.5, 5);
    mns_field_destroy(f);
    f = read_text("both", HEAD("1", UPRIGHT) "ITEM: ATOMS xs ys zs x y z\n0.5 0.5 0.5 1 2 3\n");
    expect_at(f, 0, 1, 2, 3);
    assert_true(column_of(f, "xs")->value[0] == 0.5);
    mns_field_destroy(f);
}

static void triclinic_bounds_hold_the_tilted_box(void **state)
{
    (void)state;
    /* Edges (10,0,0), (2,8,0), (-3,1,4) from corner (1,2,3): bounds x 1-3 .. 11+2, y 2 .. 10+1, z 3 .. 7. */
    mns_field *f = read_text(
        "t",
        HEAD("1", "ITEM: BOX BOUNDS xy xz yz pp pp pp\n-2 13 2\n2 11 -3\n3 7 1\n") "ITEM: ATOMS xs ys "
                                                                                   "zs\n0.5 0.25 0.75\n");
    static const double edges[3][3] = {{10, 0, 0}, {2, 8, 0}, {-3, 1, 4}};
    assert_memory_equal(f->p.cell, edges, sizeof edges);
    assert_true(f->p.cell_origin[0] == 1 && f->p.cell_origin[1] == 2 && f->p.cell_origin[2] == 3);
    expect_at(f, 0, 1 + 5 + 0.5 - 2.25, 2 + 2 + 0.75, 3 + 3);
    mns_field_destroy(f);
    f = read_text(
        "g",
        HEAD("1",
             "ITEM: BOX BOUNDS abc origin pp pp pp\n10 0 0 1\n2 8 0 2\n-3 1 4 3\n") "ITEM: ATOMS xs ys "
                                                                                    "zs\n0.5 0.25 0.75\n");
    expect_at(f, 0, 1 + 5 + 0.5 - 2.25, 2 + 2 + 0.75, 3 + 3);
    mns_field_destroy(f);
}

static void radii_and_diameters(void **state)
{
    (void)state;
    mns_field *f = read_text("r", HEAD("2", UPRIGHT) "ITEM: ATOMS x y z radius\n1 2 3 0.5\n4 5 6 0.75\n");
    assert_true(field_radius(f, 0) == 0.5 && field_radius(f, 1) == 0.75);
    mns_field_destroy(f);
    f = read_text("d", HEAD("2", UPRIGHT) "ITEM: ATOMS x y z diameter\n1 2 3 0.5\n4 5 6 0.75\n");
    assert_true(field_radius(f, 0) == 0.25 && field_radius(f, 1) == 0.375);
    mns_field_destroy(f);
}

static void frames_and_optional_sections(void **state)
{
    (void)state;
    const char *path = in_folder("frames.lammpstrj");
    static const char text[] = "ITEM: UNITS\nlj\nITEM: TIME\n0.5\n" HEAD(
        "1", UPRIGHT) "ITEM: ATOMS x y z\n1 0 0\n"
                      "ITEM: TIME\n1.0\n" HEAD("0", UPRIGHT) "ITEM: ATOMS x y z\n" HEAD(
                          "2", UPRIGHT) "ITEM: ATOMS x y z\n2 0 0\n3 0 0\n";
    write_gzip(path, text, strlen(text));
    mns_input *input = open_file(path);
    assert_int_equal(mns_input_frames(input), 3);
    static const size_t counts[] = {1, 0, 2};
    for (size_t i = 3; i-- > 0;) {
        mns_field *f = read_frame(input, i);
        assert_int_equal(f->p.count, counts[i]);
        mns_field_destroy(f);
    }
    mns_input_close(input);
}

static void a_broken_last_frame_leaves_the_others(void **state)
{
    (void)state;
    const char *path = in_folder("broken.lammpstrj");
    static const char text[] =
        HEAD("1", UPRIGHT) "ITEM: ATOMS x y z\n1 0 0\n" HEAD("2", UPRIGHT) "ITEM: ATOMS x y z\n2 0 0\n";
    write_bytes(path, text, strlen(text));
    mns_input *input = open_file(path);
    assert_int_equal(mns_input_frames(input), 2);
    mns_field *f = NULL;
    mns_error error;
    assert_int_equal(mns_input_read(input, 1, &f, &error), MNS_ERROR_INPUT);
    assert_non_null(strstr(error.text, "broken.lammpstrj:20: the file ends after 1 atoms of 2"));
    f = read_frame(input, 0);
    assert_int_equal(f->p.count, 1);
    mns_field_destroy(f);
    mns_input_close(input);
}

static void bad_files_name_their_line(void **state)
{
    (void)state;
    static const struct {
        const char *text, *where, *words;
    } cases[] = {
        {HEAD("1000000000000000000", UPRIGHT) "ITEM: ATOMS x y z\n1 2 3\n",
         ":10: ", "after 1 atoms of 1000000000000000000"},
        {HEAD("two", UPRIGHT) "ITEM: ATOMS x y z\n1 2 3\n", ":4: ", "'two'; expected the number of atoms"},
        {HEAD("1", UPRIGHT) "ITEM: ATOMS id type\n1 2\n", ":9: ", "no positions among the columns"},
        {HEAD("1", UPRIGHT) "ITEM: ATOMS x y z\n1 inf 3\n", ":10: ", "y is 'inf'; expected a finite number"},
        {HEAD("1", UPRIGHT) "ITEM: ATOMS x y z\n1 2\n", ":10: ", "2 columns; expected 3"},
        {HEAD("1", UPRIGHT) "ITEM: ATOMS x y z radius\n1 2 3 0\n", ":10: ", "radius is 0"},
        {HEAD("1", UPRIGHT) "ITEM: ATOMS x y z diameter\n1 2 3 -2\n",
         ":10: ", "diameter is -2; expected one above 0"},
        {HEAD("1", "ITEM: BOX BOUNDS pp pp pp\n0 1\n0\n0 1\n") "ITEM: ATOMS x y z\n1 2 3\n",
         ":7: ", "2 numbers of box bounds"},
        {HEAD("1", "ITEM: BOX BOUNDS xy xz yz pp pp pp\n0 1\n0 1\n0 1\n") "ITEM: ATOMS x y z\n1 2 3\n",
         ":6: ", "3 numbers"},
        {HEAD("1", "ITEM: BOX BOUNDS pp pp pp\n0 1\n"), ":6: ", "3 lines of box bounds"},
        {HEAD("1", "") "ITEM: ATOMS xs ys zs\n1 2 3\n", ":5: ", "scaled positions without a box"},
        {"ITEM: TIMESTEP\n1\nITEM: ATOMS x y z\n1 2 3\n", ":3: ", "before ITEM: NUMBER OF ATOMS"},
        {"ITEM: TIMESTEP\n1\nATOMS\n", ":3: ", "'ATOMS'; expected a line that begins with ITEM:"},
        {"ITEM: TIMESTEP\n1\nITEM: NUMBER OF ATOMS\n", ":3: ", "expected the number of atoms"},
        {HEAD("1", UPRIGHT), ":8: ", "expected ITEM: ATOMS"},
        {HEAD("1", UPRIGHT) "ITEM: ATOMS x y z\n1 2 3\ngarbage\n",
         ":11: ", "'garbage'; expected a line that begins with ITEM:"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        expect_failure("bad.dump", cases[i].text, cases[i].where, cases[i].words);
}

/* One frame of a dam break, as the repository ships it. */
static void the_example_holds_22059_particles(void **state)
{
    (void)state;
    mns_input *input = open_file(MNS_SOURCE_DIR "/examples/dam.06500.lammpstrj.gz");
    assert_int_equal(mns_input_frames(input), 1);
    mns_field *f = read_frame(input, 0);
    print_message("dam.06500.lammpstrj.gz: %zu particles\n", f->p.count);
    assert_int_equal(f->p.count, 22059);
    assert_true(f->p.has_cell && f->p.cell[0][0] == 24 && f->p.cell[1][1] == 90 && f->p.cell[2][2] == 60);
    assert_true(column_of(f, "id")->min == 1 && column_of(f, "id")->max == 22059);
    expect_at(f, 7, 0.798361, 1.27832, 0.979455); /* id 8, the file's first row */
    mns_field_destroy(f);
    mns_input_close(input);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(atoms_are_sorted_by_id),
        cmocka_unit_test(every_kind_of_position),
        cmocka_unit_test(triclinic_bounds_hold_the_tilted_box),
        cmocka_unit_test(radii_and_diameters),
        cmocka_unit_test(frames_and_optional_sections),
        cmocka_unit_test(a_broken_last_frame_leaves_the_others),
        cmocka_unit_test(bad_files_name_their_line),
        cmocka_unit_test(the_example_holds_22059_particles),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
