/* CSV: what headers, separators and comments mean, and what each bad row says. */
#include "test_load_support.h"

static void rows_without_a_header_are_x_y_z_r_q(void **state)
{
    (void)state;
    mns_field *f = read_text("a.csv", "1,2,3,0.5,-2\n4.5,-5e1,6,1.5,4\r\n");
    assert_int_equal(f->p.count, 2);
    expect_at(f, 0, 1, 2, 3);
    expect_at(f, 1, 4.5, -50, 6);
    assert_true(field_radius(f, 0) == 0.5 && field_radius(f, 1) == 1.5);
    assert_true(field_strength(f, 0) == -2 && field_strength(f, 1) == 4);
    assert_string_equal(f->p.format, "csv");
    assert_string_equal(f->radius_source, "file");
    mns_field_destroy(f);

    f = read_text("b.csv", "0,0,0\n1,0,0"); /* no radii; no newline at the end */
    assert_true(f->p.count == 2 && f->uniform_radius == 2 && !f->p.strength);
    assert_string_equal(f->radius_source, "default spacing");
    mns_field_destroy(f);
}

static void header_names_decide(void **state)
{
    (void)state;
    mns_field *f = read_text(
        "a.csv", "# made by hand\n\nkind, Z ,\"RADIUS\",X,speed,y,Strength,\n"
                 "# another\nsalt,3,0.25,1,10,2,7,a\n \"a, b\" , 6 ,0.5,4,30,5,8,b\nsalt,9,1,7,20,8,9,\n");
    assert_int_equal(f->p.count, 3);
    expect_at(f, 0, 1, 2, 3);
    expect_at(f, 1, 4, 5, 6);
    expect_at(f, 2, 7, 8, 9);
    assert_true(field_radius(f, 1) == 0.5 && field_strength(f, 2) == 9);
    assert_int_equal(f->p.column_count, 3);
    assert_string_equal(label_of(f, "kind", 0), "salt");
    assert_string_equal(label_of(f, "kind", 1), "a, b");
    assert_true(column_of(f, "kind")->label_count == 2 && column_of(f, "kind")->value[2] == 0);
    const particles_column *speed = column_of(f, "speed");
    assert_true(!speed->label && speed->min == 10 && speed->max == 30 && speed->value[1] == 30);
    assert_string_equal(label_of(f, "column8", 1), "b");
    assert_string_equal(label_of(f, "column8", 2), "");
    mns_field_destroy(f);
}

static void other_separators_are_welcome(void **state)
{
    (void)state;
    static const char *const texts[] = {"x;y;z;r\n1;2;3;4\n",
                                        "x\ty\tz\tr\n1\t2\t3\t4\n",
                                        "x y z r\n 1  2 3\t4 \n",
                                        "x , y , z , r\n1 , 2 , 3 , 4\n",
                                        "\xef\xbb\xbfx,y,z,r\n1,2,3,4\n",
                                        "\"x\",\"y\",\"z\",\"r\"\n\"1\",\"2\",\"3\",\"4\"\n"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        mns_field *f = read_text("any", texts[i]);
        assert_int_equal(f->p.count, 1);
        expect_at(f, 0, 1, 2, 3);
        assert_true(f->uniform_radius == 4);
        mns_field_destroy(f);
    }
}

static void many_rows_grow(void **state)
{
    (void)state;
    enum { ROWS = 30000 };
    char *text = malloc(ROWS * 40), *at = text;
    for (int i = 0; i < ROWS; i++) at += sprintf(at, "%d,%d.5,-%d,%d\n", i, i, i, i + 1);
    mns_field *f = read_text("many.csv", text);
    assert_int_equal(f->p.count, ROWS);
    for (size_t i = 0; i < ROWS; i++) {
        expect_at(f, i, (double)i, (double)i + 0.5, -(double)i);
        assert_true(field_radius(f, i) == (double)i + 1);
    }
    mns_field_destroy(f);
    free(text);
}

static void bad_rows_name_their_line(void **state)
{
    (void)state;
    static const struct {
        const char *text, *where, *words;
    } cases[] = {
        {"1,2,3\n1,nan,3\n", ":2: ", "y is 'nan'; expected a finite number"},
        {"1,2,3\n1,2,-inf\n", ":2: ", "z is '-inf'"},
        {"1,2,3\n1,2,1e999\n", ":2: ", "z is '1e999'; expected a finite number"},
        {"nan,2,3\n", ":1: ", "x is 'nan'"},
        {"1,2,3,1\n# c\n1,2,3,0\n", ":3: ", "r is 0; expected one above 0"},
        {"x,y,z,radius\n1,2,3,-1\n", ":2: ", "radius is -1; expected one above 0"},
        {"1,2,3\n1,2\n", ":2: ", "2 columns; expected 3"},
        {"1,2,3\n1,2,3,4\n", ":2: ", "4 columns; expected 3"},
        {"1,2,3\n1,2,3,\n", ":2: ", "4 columns; expected 3"},
        {"1,2,3\n1,,3\n", ":2: ", "y is ''; expected a number"},
        {"1,2,3\n1,abc,3\n", ":2: ", "y is 'abc'; expected a number"},
        {"1,2,3\n1,2 5,3\n", ":2: ", "y is '2 5'"},
        {"x,y,z,speed\n1,2,3,4\n1,2,3,fast\n", ":3: ", "speed is 'fast'"},
        {"x,y,z,speed\n1,2,3,nan\n", ":2: ", "speed is 'nan'; expected a finite number"},
        {"1,2\n3,4\n", ":1: ", "2 columns without a header"},
        {"1,2,3,4,5,6\n", ":1: ", "6 columns without a header"},
        {"x,y,w\n1,2,3\n", ":1: ", "no column 'z'"},
        {"x,y,z,X\n1,2,3,4\n", ":1: ", "mean the same"},
        {"x,y,z,r,Radius\n1,2,3,4,5\n", ":1: ", "mean the same"},
        {"x,y,z\n", ":1: ", "no row follows the header"},
        {"# only\n\n", ":2: ", "no rows"},
        {"hello world\n", ":1: ", "no column 'x'"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        expect_failure("bad.csv", cases[i].text, cases[i].where, cases[i].words);
}

static void a_line_without_end_is_refused(void **state)
{
    (void)state;
    enum { SIZE = 12000000 };
    static char text[SIZE];
    static const char row[] = "1,2,3\n", names[] = "x,y,z,";
    memset(text, '1', SIZE);
    memcpy(text, row, sizeof row - 1);
    expect_bytes_failure("long.csv", text, SIZE, ":2: ", "longer than 10000000 bytes");
    memset(text + 6, ',', SIZE - 6);
    text[900000] = '\n';
    expect_bytes_failure("commas.csv", text, SIZE, ":2: ", "expected a number");
    memcpy(text, names, sizeof names - 1);
    for (int i = 6; i < 900000; i++) text[i] = i % 2 ? ',' : 'a';
    expect_bytes_failure("names.csv", text, SIZE, ":1: ", "mean the same");
}

static void no_more_columns_than_fit(void **state)
{
    (void)state;
    char *text = malloc(20000), *at = text + sprintf(text, "x,y,z");
    for (int i = 0; i < 1500; i++) at += sprintf(at, ",c%d", i);
    expect_failure("wide.csv", text, ": ", "more than 1024 columns");
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_without_a_header_are_x_y_z_r_q),
        cmocka_unit_test(header_names_decide),
        cmocka_unit_test(other_separators_are_welcome),
        cmocka_unit_test(many_rows_grow),
        cmocka_unit_test(bad_rows_name_their_line),
        cmocka_unit_test(a_line_without_end_is_refused),
        cmocka_unit_test(no_more_columns_than_fit),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
