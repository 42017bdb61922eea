/* Protein Data Bank files. */
#include "test_load_support.h"

#include "field/kernel.h"

/* Columns 1 to 80 of an atom: record, serial, name, alternate location, residue, chain, number, x, y, z,
 * occupancy, B, element. */
static const char *atom(const char *record, const char *name, char alternate, const char *residue, int number,
                        double x, double occupancy, const char *element)
{
    static char line[8][96];
    static int next;
    next = (next + 1) % 8;
    snprintf(line[next], sizeof line[next],
             "%-6s%5d %-4s%c%-3s A%4d    %8.3f%8.3f%8.3f%6.2f%6.2f          %2s\n", record, 1, name,
             alternate, residue, number, x, 2.0, 3.0, occupancy, 20.5, element);
    return line[next];
}

static mns_field *read_lines(const char *const *lines, size_t count)
{
    char text[2000] = "";
    for (size_t i = 0; i < count; i++) strcat(text, lines[i]);
    return read_text("a.pdb", text);
}

static void atoms_have_elements_and_radii(void **state)
{
    (void)state;
    const char *lines[] = {
        atom("ATOM", " N", ' ', "GLY", 1, 1, 1, " N"), atom("ATOM", " CA", ' ', "GLY", 1, 2, 1, " C"),
        atom("HETATM", "CA", ' ', " CA", 2, 3, 1, "CA"), atom("HETATM", "FE", ' ', "HEM", 3, 4, 1, "")};
    mns_field *f = read_lines(lines, 4);
    assert_int_equal(f->p.count, 4);
    expect_at(f, 1, 2, 2, 3);
    static const char *const elements[] = {"N", "C", "Ca", "Fe"};
    static const double radii[] = {1.55, 1.70, 2.31, 2.44};
    double core = kernel_core_radius(MNS_KERNEL_POLY3, 0.2);
    for (size_t i = 0; i < 4; i++) {
        assert_string_equal(label_of(f, "element", i), elements[i]);
        assert_true(fabs(field_radius(f, i) * core - radii[i]) < 1e-12);
    }
    assert_string_equal(f->radius_source, "van der Waals");
    assert_string_equal(label_of(f, "name", 1), "CA");
    assert_string_equal(label_of(f, "residue", 3), "HEM");
    assert_string_equal(label_of(f, "chain", 0), "A");
    assert_true(column_of(f, "residue_number")->value[3] == 3 && column_of(f, "b_factor")->value[0] == 20.5);
    assert_string_equal(f->p.format, "pdb");
    mns_field_destroy(f);
}

static void names_tell_where_columns_77_and_78_do_not(void **state)
{
    (void)state;
    static const struct {
        const char *name, *element;
    } cases[] = {{" CA", "C"}, {"CA", "Ca"}, {"HG11", "H"}, {"1HB", "H"}, {" OXT", "O"}, {"ZN", "Zn"},
                 {" SG", "S"}, {"NA", "Na"}, {"HG", "Hg"},  {" D1", "D"}, {" ??", "X"},  {"QA", "X"}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *line = atom("ATOM", cases[i].name, ' ', "XXX", 1, 1, 1, i % 2 ? "" : "17");
        mns_field *f = read_lines(&line, 1);
        assert_string_equal(label_of(f, "element", 0), cases[i].element);
        mns_field_destroy(f);
    }
}

static void one_alternate_location_is_kept(void **state)
{
    (void)state;
    const char *lines[] = {
        atom("ATOM", " N", ' ', "SER", 1, 1, 1, " N"),    atom("ATOM", " CB", 'A', "SER", 1, 2, 0.3, " C"),
        atom("ATOM", " CB", 'B', "SER", 1, 3, 0.6, " C"), atom("ATOM", " CB", 'C', "SER", 1, 4, 0.1, " C"),
        atom("ATOM", " OG", 'A', "SER", 1, 5, 0.5, " O"), atom("ATOM", " OG", 'B', "SER", 1, 6, 0.5, " O"),
        atom("ATOM", " CB", 'A', "SER", 2, 7, 0.5, " C")};
    mns_field *f = read_lines(lines, 7);
    assert_int_equal(f->p.count, 4);
    expect_at(f, 1, 3, 2, 3);
    expect_at(f, 2, 5, 2, 3);
    expect_at(f, 3, 7, 2, 3);
    mns_field_info info;
    mns_field_get_info(f, &info);
    assert_int_equal(info.rows_skipped, 3);
    assert_non_null(strstr(info.rows_skipped_why, "alternate locations"));
    mns_field_destroy(f);
}

static void models_are_frames(void **state)
{
    (void)state;
    char text[2000];
    const char *path = in_folder("models.pdb");
    snprintf(text, sizeof text,
             "HEADER    X\nMODEL        1\n%sENDMDL\nMODEL        2\n%s%sENDMDL\nCONECT    1    2\nEND\n",
             atom("ATOM", " C", ' ', "AAA", 1, 1, 1, " C"), atom("ATOM", " C", ' ', "AAA", 1, 2, 1, " C"),
             atom("ATOM", " C", ' ', "AAA", 1, 3, 1, " C"));
    write_gzip(path, text, strlen(text));
    mns_input *input = open_file(path);
    assert_int_equal(mns_input_frames(input), 2);
    mns_field *second = read_frame(input, 1), *first = read_frame(input, 0);
    assert_true(first->p.count == 1 && second->p.count == 2);
    expect_at(second, 1, 3, 2, 3);
    mns_field_destroy(first);
    mns_field_destroy(second);
    mns_input_close(input);

    snprintf(text, sizeof text, "%sEND\n%sEND\n", atom("ATOM", " C", ' ', "AAA", 1, 1, 1, " C"),
             atom("ATOM", " C", ' ', "AAA", 1, 2, 1, " C")); /* as some programs write trajectories */
    write_bytes(path, text, strlen(text));
    input = open_file(path);
    assert_int_equal(mns_input_frames(input), 2);
    mns_input_close(input);
}

static void cells_come_from_cryst1(void **state)
{
    (void)state;
    const char *lines[] = {"CRYST1   10.000   20.000   30.000  90.00  90.00 120.00 P 1           1\n",
                           atom("ATOM", " C", ' ', "AAA", 1, 1, 1, " C")};
    mns_field *f = read_lines(lines, 2);
    assert_true(f->p.has_cell && f->p.cell[0][0] == 10);
    assert_true(fabs(f->p.cell[1][0] + 10) < 1e-9 && fabs(f->p.cell[1][1] - 10 * sqrt(3)) < 1e-9);
    assert_true(fabs(f->p.cell[2][2] - 30) < 1e-9);
    mns_field_destroy(f);
    lines[0] = "CRYST1    1.000    1.000    1.000  90.00  90.00  90.00 P 1           1\n";
    f = read_lines(lines, 2);
    assert_false(f->p.has_cell);
    mns_field_destroy(f);
}

static void bad_files_name_their_line(void **state)
{
    (void)state;
    char text[600];
    expect_failure("bad.pdb", "HEADER    X\nREMARK\nEND\n", ":3: ", "no ATOM or HETATM record");
    expect_failure("bad.pdb", "ATOM      1  N   GLY A   1      11.000\n",
                   ":1: ", "expected an atom's position");
    expect_failure("bad.pdb", "ATOM      1  N   GLY A   1         nan   2.000   3.000\n",
                   ":1: ", "x is 'nan'; expected a finite");
    expect_failure("bad.pdb", "ATOM      1  N   GLY A   1       1.000   x.000   3.000\n",
                   ":1: ", "y is 'x.000'; expected a number");
    expect_failure("bad.pdb", "ATOM      1  N   GLY A   1       1.000           3.000\n",
                   ":1: ", "y is ''; expected a number");
    snprintf(text, sizeof text, "MODEL        1\n%s", atom("ATOM", " C", ' ', "AAA", 1, 1, 1, " C"));
    expect_failure("bad.pdb", text, ":2: ", "ends inside a MODEL; expected ENDMDL");
    snprintf(text, sizeof text, "%sMODEL        2\n", atom("ATOM", " C", ' ', "AAA", 1, 1, 1, " C"));
    expect_failure("bad.pdb", text, ":2: ", "MODEL inside a frame");
}

/* 1TII as the repository ships it. */
static void the_example_holds_5684_atoms(void **state)
{
    (void)state;
    mns_input *input = open_file(MNS_SOURCE_DIR "/examples/1tii.pdb");
    assert_int_equal(mns_input_frames(input), 1);
    mns_field *f = read_frame(input, 0);
    print_message("1tii.pdb: %zu particles\n", f->p.count);
    assert_int_equal(f->p.count, 5684);
    assert_int_equal(column_of(f, "element")->label_count, 4); /* N C O S */
    assert_int_equal(column_of(f, "chain")->label_count, 8);   /* D E F G H A C and water without one */
    assert_int_equal(f->p.rows_skipped, 0);
    mns_field_destroy(f);
    mns_input_close(input);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(atoms_have_elements_and_radii),
        cmocka_unit_test(names_tell_where_columns_77_and_78_do_not),
        cmocka_unit_test(one_alternate_location_is_kept),
        cmocka_unit_test(models_are_frames),
        cmocka_unit_test(cells_come_from_cryst1),
        cmocka_unit_test(bad_files_name_their_line),
        cmocka_unit_test(the_example_holds_5684_atoms),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
