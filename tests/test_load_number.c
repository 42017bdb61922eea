/* Numbers out of text: the same doubles as the C library's, to the last bit, in any locale. */
#include "test_load_support.h"

#include <locale.h>

#include "load/number.h"

static uint64_t state_of_random = 1;

static uint64_t next_random(void)
{
    state_of_random ^= state_of_random << 13;
    state_of_random ^= state_of_random >> 7;
    state_of_random ^= state_of_random << 17;
    return state_of_random;
}

static void expect_same(const char *text)
{
    const char *at = text, *end = text + strlen(text);
    double value = -1, expected = strtod(text, NULL);
    assert_true(number_scan(&at, end, &value));
    if (at != end || value != expected || signbit(value) != signbit(expected))
        fail_msg("'%s': %.17g, expected %.17g", text, value, expected);
}

static void random_doubles_come_back(void **state)
{
    (void)state;
    static const char *const formats[] = {"%.17g", "%.16e", "%.9g", "%.6f", "%.20e", "%.40e", "%.3e"};
    for (int i = 0; i < 60000; i++) {
        uint64_t bits = next_random();
        double value;
        memcpy(&value, &bits, sizeof value);
        if (i % 3) value = (double)(int64_t)next_random() * ldexp(1, (int)(next_random() % 120) - 110);
        if (!isfinite(value)) continue;
        char text[512];
        snprintf(text, sizeof text, formats[i % 7], value);
        expect_same(text);
    }
}

static void random_digits_are_rounded_correctly(void **state)
{
    (void)state;
    for (int i = 0; i < 60000; i++) {
        char text[80];
        int length = 1 + (int)(next_random() % 22), at = 0;
        for (int k = 0; k < length; k++) text[at++] = (char)('0' + next_random() % 10);
        if (i % 2) text[at / 2] = '.';
        snprintf(text + at, sizeof text - (size_t)at, "e%d", (int)(next_random() % 70) - 35);
        if (text[0] == '.' && text[1] == 'e') continue;
        expect_same(text);
    }
}

static void edges_are_rounded_correctly(void **state)
{
    (void)state;
    static const char *const texts[] = {"0",
                                        "-0",
                                        "+1",
                                        "1.",
                                        ".5",
                                        "-.5e1",
                                        "00000000000000000000000000001",
                                        "0.00000000000000000000000000000000001",
                                        "9007199254740993",
                                        "9007199254740992.9999999999",
                                        "18446744073709551615",
                                        "18446744073709551616",
                                        "4.9e-324",
                                        "2.4703282292062327e-324",
                                        "2.2250738585072011e-308",
                                        "1.7976931348623157e308",
                                        "1e-400",
                                        "123456789012345678e-27",
                                        "9999999999999999999e27",
                                        "1e22",
                                        "1e23",
                                        "5e-1",
                                        "1.00000000000000011102230246251565404236316680908203125",
                                        "8.5e15",
                                        "72057594037927945"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) expect_same(texts[i]);
}

static void only_the_number_is_taken(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        int taken; /* -1: no number */
        double value;
    } cases[] = {{"1,2", 1, 1},  {"1e", 1, 1},      {"1e+", 1, 1},  {"2e3x", 3, 2000},      {"", -1, 0},
                 {"-", -1, 0},   {".", -1, 0},      {"e5", -1, 0},  {"nan", -1, 0},         {"inf", -1, 0},
                 {"0x10", 1, 0}, {"1.5.2", 3, 1.5}, {"--1", -1, 0}, {"1e400", 5, INFINITY}, {"1 2", 1, 1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const char *text = cases[i].text, *at = text;
        double value = -7;
        bool found = number_scan(&at, text + strlen(text), &value);
        assert_int_equal(found, cases[i].taken >= 0);
        assert_int_equal(at - text, found ? cases[i].taken : 0);
        assert_true(value == (found ? cases[i].value : -7));
    }
}

static load_text whole(const char *text)
{
    return (load_text){text, text + strlen(text)};
}

static void wholes_counts_and_specials(void **state)
{
    (void)state;
    double value;
    uint64_t count;
    assert_true(number_whole(whole(" 1.5\t"), &value) && value == 1.5);
    assert_false(number_whole(whole("1.5 2"), &value));
    assert_false(number_whole(whole("1e999"), &value));
    assert_true(number_count(whole(" 22059 "), &count) && count == 22059);
    assert_true(number_count(whole("1000000000000000000"), &count) && count == 1000000000000000000u);
    assert_false(number_count(whole("18446744073709551616"), &count));
    assert_false(number_count(whole("-1"), &count));
    assert_false(number_count(whole(""), &count));
    assert_true(number_is_special(whole("-NaN")) && number_is_special(whole("Infinity")));
    assert_true(number_is_special(whole("+inf")) && number_is_special(whole("nan(0x1)")));
    assert_false(number_is_special(whole("information")));
}

static void the_locale_does_not_matter(void **state)
{
    (void)state;
    static const char *const commas[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "de_DE"};
    for (size_t i = 0; i < 4 && !setlocale(LC_ALL, commas[i]); i++) {}
    const char *text = "1.2345678901234567890123", *at = text; /* goes to the library */
    double value;
    bool found = number_scan(&at, text + strlen(text), &value);
    setlocale(LC_ALL, "C");
    assert_true(found && !*at && value == 1.2345678901234567890123);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_doubles_come_back),    cmocka_unit_test(random_digits_are_rounded_correctly),
        cmocka_unit_test(edges_are_rounded_correctly), cmocka_unit_test(only_the_number_is_taken),
        cmocka_unit_test(wholes_counts_and_specials),  cmocka_unit_test(the_locale_does_not_matter),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
