/* The page's text: whole, its data intact and unable to end its element, and what happens where it cannot be
 * written. */
#include "compare/page.h"
#include "page/made_up.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static const char PATH[] = "test_page.html";

static char *load(const char *path)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    fseek(file, 0, SEEK_END);
    long size = ftell(file);
    rewind(file);
    char *text = malloc((size_t)size + 1);
    assert_non_null(text);
    assert_int_equal(fread(text, 1, (size_t)size, file), size);
    text[size] = 0;
    fclose(file);
    assert_int_equal(strlen(text), size); /* no zero byte: it is text */
    return text;
}

/* Writes a page and reads it back. */
static char *page_of(const json_t *results, const page_picture *picture, size_t count)
{
    mns_error error = {0};
    unlink(PATH);
    assert_int_equal(page_write(results, picture, count, PATH, &error), MNS_OK);
    char *text = load(PATH);
    unlink(PATH);
    return text;
}

/* The data of the element `id`, as a browser would take it: up to the next end of a script. */
static json_t *data_of(const char *text, const char *id)
{
    char tag[64];
    snprintf(tag, sizeof tag, "id=\"%s\">", id);
    const char *from = strstr(text, tag);
    assert_non_null(from);
    from += strlen(tag);
    const char *end = strstr(from, "</script");
    assert_non_null(end);
    json_error_t why;
    json_t *value = json_loadb(from, (size_t)(end - from), 0, &why);
    if (!value) fail_msg("%s: %s", id, why.text);
    return value;
}

static size_t count_of(const char *text, const char *part)
{
    size_t count = 0;
    for (const char *at = text; (at = strstr(at, part)); at += strlen(part)) count++;
    return count;
}

static void results_stand_in_the_page_unchanged(void **state)
{
    (void)state;
    json_t *results = made_up_results();
    char *text = page_of(results, NULL, 0);
    json_t *found = data_of(text, "results-data");
    enum { FLAGS = JSON_SORT_KEYS | JSON_REAL_PRECISION(9) }; /* as results.json is written */
    char *wanted = json_dumps(results, FLAGS), *shown = json_dumps(found, FLAGS);
    assert_non_null(wanted);
    assert_string_equal(shown, wanted);
    free(shown);
    free(wanted);
    json_decref(found);
    json_decref(results);
    free(text);
}

static void pictures_stand_in_the_page_in_base64(void **state)
{
    (void)state;
    static const unsigned char bytes[] = {0x00, 0xff, 0x10, 0xfb, 0xef};
    const page_picture pictures[] = {
        {"a", "image", bytes, 3}, {MADE_UP_HOSTILE, "depth", bytes, 4}, {"\xff!", "mask", bytes, 5}};
    static const char *const expected[] = {"AP8Q", "AP8Q+w==", "AP8Q++8="};
    json_t *results = json_object();
    char *text = page_of(results, pictures, 3);
    json_t *found = data_of(text, "pictures-data"), *list = json_object_get(found, "list");
    assert_int_equal(json_array_size(list), 3);
    for (size_t i = 0; i < 3; i++) {
        const json_t *one = json_array_get(list, i);
        assert_string_equal(json_string_value(json_object_get(one, "png")), expected[i]);
        assert_string_equal(json_string_value(json_object_get(one, "kind")), pictures[i].kind);
    }
    assert_string_equal(json_string_value(json_object_get(json_array_get(list, 1), "run")), MADE_UP_HOSTILE);
    assert_string_equal(json_string_value(json_object_get(json_array_get(list, 2), "run")), "?!");
    json_decref(found);
    json_decref(results);
    free(text);
}

static void hostile_names_end_no_element(void **state)
{
    (void)state;
    json_t *plain = json_object(), *hostile = made_up_results();
    char *without = page_of(plain, NULL, 0), *with = page_of(hostile, NULL, 0);
    static const char *const marks[] = {"<script", "</script", "<!--"};
    for (size_t i = 0; i < 3; i++) assert_int_equal(count_of(with, marks[i]), count_of(without, marks[i]));
    assert_null(strstr(with, "alert(1)</script>"));
    for (const char *c = strstr(with, "results-data"); *c && strncmp(c, "</script", 8); c++)
        assert_in_range((unsigned char)*c, 0x20, 0x7e); /* ASCII alone: no charset can be guessed wrong */
    free(with);
    free(without);
    json_decref(hostile);
    json_decref(plain);
}

static void every_part_of_the_template_is_filled(void **state)
{
    (void)state;
    json_t *results = json_object();
    char *text = page_of(results, NULL, 0);
    assert_null(strstr(text, "{{"));
    assert_non_null(strstr(text, "prefers-color-scheme"));
    assert_non_null(strstr(text, "page.startCharts"));
    assert_int_equal(count_of(text, "</html>"), 1);
    free(text);
    json_decref(results);
}

static void a_page_that_cannot_be_written_says_where_and_leaves_nothing(void **state)
{
    (void)state;
    mns_error error = {0};
    json_t *results = made_up_results();
    assert_int_equal(page_write(results, NULL, 0, "no-such-folder/page.html", &error), MNS_ERROR_IO);
    assert_non_null(strstr(error.text, "no-such-folder/page.html: cannot write: No such file"));
    if (!access("/dev/full", W_OK)) { /* a disk without room */
        assert_int_equal(symlink("/dev/full", "test_page_full.html"), 0);
        assert_int_equal(page_write(results, NULL, 0, "test_page_full.html", &error), MNS_ERROR_IO);
        assert_non_null(strstr(error.text, "No space left"));
        assert_int_not_equal(access("test_page_full.html", F_OK), 0);
    }
    assert_int_equal(page_write(results, NULL, 0, "no-such-folder/page.html", NULL), MNS_ERROR_IO);
    json_decref(results);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(results_stand_in_the_page_unchanged),
        cmocka_unit_test(pictures_stand_in_the_page_in_base64),
        cmocka_unit_test(hostile_names_end_no_element),
        cmocka_unit_test(every_part_of_the_template_is_filled),
        cmocka_unit_test(a_page_that_cannot_be_written_says_where_and_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
