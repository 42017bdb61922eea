/* What a comparison writes, read back: JSON, CSV and the chart's data. */
#include "compare/chart.h"
#include "compare/results.h"
#include "support/cli.h"
#include "support/draw_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static int setup(void **state)
{
    cli *c = malloc(sizeof *c);
    assert_non_null(c);
    cli_setup(c, "");
    *state = c;
    return 0;
}

static int teardown(void **state)
{
    cli_teardown(*state);
    free(*state);
    return 0;
}

/* Two runs of made-up figures, and one that was refused. */
static void make_runs(run_result run[3])
{
    run_spec *spec;
    size_t count;
    mns_error error;
    assert_int_equal(
        run_parse("list:exact,list:cubic:gather=paper:slots=9,list:cubic-monomial", &spec, &count, &error),
        MNS_OK);
    memset(run, 0, 3 * sizeof *run);
    for (int i = 0; i < 3; i++) run[i].spec = spec[i];
    free(spec);
    for (int i = 0; i < 2; i++) {
        metrics *m = &run[i].errors;
        metrics_spread spread = {1e-7, 2e-7, 3e-7, 4e-7, 5e-7}, none = {NAN, NAN, NAN, NAN, NAN};
        *m = (metrics){.pixels = 100,
                       .hits = 60 + (size_t)i,
                       .missed = 5,
                       .invented = 6,
                       .missed_decided = 3,
                       .invented_decided = 4,
                       .wrong_root = 2,
                       .undecided = 1,
                       .compared = 50};
        m->effects = (metrics_effects){.any = i == 0, .compared = 40, .undecided = 3};
        m->effects.has[TRUTH_SHADOW] = i == 0, m->effects.wrong[TRUTH_SHADOW] = 8;
        m->t = m->footprint = m->normal = spread;
        m->residual = none;
        m->psnr = i ? 42.5 : METRICS_PSNR_MOST;
        run[i].ms = (run_times){.frames = 7, .median = 10.5 - i, .min = 9, .max = 12, .has_phases = i == 0};
        run[i].ms.phase[MNS_PHASE_CAST] = 4.25;
        m->worst_count = 2;
        m->worst[0] = (metrics_pixel){3, 4, METRICS_MISSED, INFINITY, 2.5, NAN};
        m->worst[1] = (metrics_pixel){5, 6, METRICS_DEPTH, 2.25, 2.5, 0.1};
    }
    run[1].errors.t.p99 = 1e-3;
    run[2].status = MNS_ERROR_UNSUPPORTED;
    strcpy(run[2].error.text, "size 9x9: \"too\" large, by far");
    run_mark_front(run, 3);
}

static json_t *make_document(const cli *c, mns_field **field, mns_view *view)
{
    const double centre[3] = {0, 0, 0};
    run_result run[3];
    json_t *document;
    mns_error error;
    (void)c;
    *field = draw_field(1, centre, NULL, 1, NULL, MNS_KERNEL_WYVILL);
    *view = (mns_view){.width = 10, .height = 10};
    assert_int_equal(mns_view_resolve(view, *field, view, &error), MNS_OK);
    truth_planes truth = {.ms = 1234.5, .hits = 61, .undecided = 2, .cached = true};
    results_about about = {.command = "meniscus compare x -o y",
                           .renderer = "r",
                           .backend = "osmesa",
                           .input = "caf\xe9.csv",
                           .field = *field,
                           .view = view,
                           .truth = &truth};
    make_runs(run);
    assert_int_equal(results_document(&about, run, 3, &document, &error), MNS_OK);
    return document;
}

static const json_t *at(const json_t *value, const char *path)
{
    char copy[80], *rest = copy;
    snprintf(copy, sizeof copy, "%s", path);
    for (char *word; (word = strsep(&rest, "."));) {
        const json_t *next =
            json_is_array(value) ? json_array_get(value, (size_t)atoi(word)) : json_object_get(value, word);
        if (!next) fail_msg("%s: there is no %s", path, word);
        value = next;
    }
    return value;
}

static void json_holds_every_figure(void **state)
{
    const cli *c = *state;
    mns_field *field;
    mns_view view;
    mns_error error;
    char path[128];
    json_t *made = make_document(c, &field, &view);
    snprintf(path, sizeof path, "%s/results.json", c->folder);
    assert_int_equal(results_write_json(made, path, &error), MNS_OK);
    json_t *d = json_load_file(path, 0, NULL);
    assert_int_equal(json_integer_value(at(d, "schema")), 1);
    assert_string_equal(json_string_value(at(d, "command")), "meniscus compare x -o y");
    assert_int_equal(strlen(json_string_value(at(d, "created"))), 20);
    assert_true(json_integer_value(at(d, "machine.cores")) > 0);
    assert_true(json_integer_value(at(d, "machine.memory_bytes")) > 0);
    assert_non_null(strstr(json_string_value(at(d, "machine.system")), "Linux"));
    assert_non_null(at(d, "machine.cpu"));
    assert_string_equal(json_string_value(at(d, "version")), mns_version());
    assert_true(strlen(json_string_value(at(d, "commit"))) > 0);
    assert_string_equal(json_string_value(at(d, "input.name")), "caf?.csv");
    assert_string_equal(json_string_value(at(d, "input.kernel")), "wyvill");
    assert_true(json_real_value(at(d, "input.iso")) == 0.2);
    assert_int_equal(strlen(json_string_value(at(d, "input.hash"))), 32);
    assert_true(fabs(json_real_value(at(d, "view.eye.2")) - view.eye[2]) < 1e-8);
    assert_int_equal(json_integer_value(at(d, "view.height")), 10);
    assert_true(json_real_value(at(d, "truth.ms")) == 1234.5 && json_is_true(at(d, "truth.cached")));
    assert_true(json_is_null(at(d, "suite")));
    assert_int_equal(json_array_size(at(d, "runs")), 3);
    assert_string_equal(json_string_value(at(d, "runs.1.settings.slots")), "9");
    assert_true(json_real_value(at(d, "runs.0.ms.median")) == 10.5);
    assert_true(json_real_value(at(d, "runs.0.ms.phases.cast")) == 4.25);
    assert_int_equal(json_object_size(at(d, "runs.1.ms.phases")), 0);
    assert_int_equal(json_integer_value(at(d, "runs.0.errors.missed")), 5);
    assert_int_equal(json_integer_value(at(d, "runs.0.errors.missed_decided")), 3);
    assert_true(json_real_value(at(d, "runs.0.errors.t.p999")) == 3e-7);
    assert_true(json_is_null(at(d, "runs.0.errors.residual.max")));
    assert_true(json_real_value(at(d, "runs.1.errors.psnr")) == 42.5);
    assert_true(json_is_true(at(d, "runs.0.pareto")) && json_is_true(at(d, "runs.1.pareto")));
    assert_string_equal(json_string_value(at(d, "runs.0.worst.0.kind")), "missed");
    assert_true(json_is_null(at(d, "runs.0.worst.0.t")) && json_is_null(at(d, "runs.0.worst.0.error")));
    assert_true(json_real_value(at(d, "runs.0.worst.1.truth")) == 2.5);
    assert_true(json_is_null(at(d, "runs.0.failed")));
    assert_string_equal(json_string_value(at(d, "runs.2.failed")), "size 9x9: \"too\" large, by far");
    assert_true(json_is_null(at(d, "runs.2.ms")) && json_is_null(at(d, "runs.2.errors")));
    json_decref(d);
    json_decref(made);
    mns_field_destroy(field);
}

/* The n-th field of a line without quotes before it, in a buffer of the caller's. */
static const char *csv_field(const char *line, size_t n, char text[128])
{
    for (; n; n--) {
        line = strchr(line, ',');
        assert_non_null(line);
        line++;
    }
    snprintf(text, 128, "%.*s", (int)strcspn(line, ",\n"), line);
    return text;
}

static size_t csv_column(const char *header, const char *name)
{
    char text[128];
    for (size_t n = 0; n < 80; n++)
        if (!strcmp(csv_field(header, n, text), name)) return n;
    fail_msg("no column %s", name);
    return 0;
}

static void csv_has_a_row_a_run(void **state)
{
    const cli *c = *state;
    mns_field *field;
    mns_view view;
    mns_error error;
    char path[128], text[128];
    size_t size;
    json_t *document = make_document(c, &field, &view);
    snprintf(path, sizeof path, "%s/results.csv", c->folder);
    assert_int_equal(results_write_csv(document, path, &error), MNS_OK);
    char *csv = cli_read(c, "results.csv", &size), *row[5], *rest = csv;
    for (int i = 0; i < 5; i++) row[i] = strsep(&rest, "\n");
    assert_string_equal(row[4], "");
    assert_null(rest);
    assert_int_equal(strncmp(row[0], "case,name,method,solver,settings,frames,ms_median,", 50), 0);
#define FIELD(line, name) csv_field(row[line], csv_column(row[0], name), text)
    assert_string_equal(FIELD(1, "case"), "");
    assert_string_equal(FIELD(1, "name"), "list:exact");
    assert_string_equal(FIELD(2, "settings"), "gather=paper;slots=9");
    assert_string_equal(FIELD(1, "frames"), "7");
    assert_string_equal(FIELD(1, "ms_median"), "10.5");
    assert_string_equal(FIELD(1, "ms_cast"), "4.25");
    assert_string_equal(FIELD(2, "ms_cast"), "");
    assert_string_equal(FIELD(2, "hits"), "61");
    assert_string_equal(FIELD(1, "wrong_root"), "2");
    assert_string_equal(FIELD(1, "shadow_wrong"), "8");
    assert_string_equal(FIELD(1, "mirror_wrong"), "");
    assert_string_equal(FIELD(1, "effects_undecided"), "3");
    assert_string_equal(FIELD(2, "shadow_wrong"), "");
    assert_string_equal(FIELD(2, "t_p99"), "0.001");
    assert_string_equal(FIELD(1, "normal_rms"), "5e-07");
    assert_string_equal(FIELD(1, "residual_max"), "");
    assert_string_equal(FIELD(2, "psnr"), "42.5");
    assert_string_equal(FIELD(2, "pareto"), "1");
    assert_string_equal(FIELD(3, "t_max"), "");
    assert_non_null(strstr(row[3], ",0,\"size 9x9: \"\"too\"\" large, by far\""));
    size_t commas[3] = {0};
    for (int i = 0; i < 3; i++)
        for (const char *s = row[i]; *s; s++) commas[i] += *s == ',';
    assert_true(commas[0] == commas[1] && commas[0] == commas[2]);
    free(csv);
    json_decref(document);
    mns_field_destroy(field);
}

/* A suite has its rows under the names of its cases. */
static void csv_has_the_rows_of_a_suite(void **state)
{
    const cli *c = *state;
    mns_error error;
    char path[128];
    size_t size;
    run_result run[3];
    make_runs(run);
    json_t *document = json_pack("{s:[], s:{s:s, s:[{s:s, s:[o, o]}, {s:s, s:[o]}]}}", "runs", "suite",
                                 "name", "stiff", "cases", "name", "a,b", "runs", results_run(&run[0]),
                                 results_run(&run[1]), "name", "far", "runs", results_run(&run[0]));
    assert_non_null(document);
    snprintf(path, sizeof path, "%s/results.csv", c->folder);
    assert_int_equal(results_write_csv(document, path, &error), MNS_OK);
    char *csv = cli_read(c, "results.csv", &size);
    assert_non_null(strstr(csv, "\n\"a,b\",list:exact,list,exact,"));
    assert_non_null(strstr(csv, "\n\"a,b\",list:cubic:gather=paper:slots=9,list,cubic,"));
    assert_non_null(strstr(csv, "\nfar,list:exact,list,exact,"));
    free(csv);
    json_decref(document);
}

static void the_chart_can_be_made_again(void **state)
{
    const cli *c = *state;
    mns_field *field;
    mns_view view;
    mns_error error;
    char note[CHART_NOTE_SIZE], *path = strdup(getenv("PATH"));
    size_t size;
    json_t *document = make_document(c, &field, &view);
    setenv("PATH", "/nowhere", 1);
    assert_int_equal(chart_write(document, c->folder, note, &error), MNS_OK);
    setenv("PATH", path, 1);
    free(path);
    assert_non_null(strstr(note, "gnuplot is not installed"));
    assert_false(cli_exists(c, "chart.svg"));
    char *data = cli_read(c, "chart.dat", &size), *script = cli_read(c, "chart.gp", &size);
    assert_non_null(strstr(data, "# list cubic\n9.5 0.001 list:cubic:gather=paper:slots=9\n"));
    assert_non_null(strstr(data, "# list exact\n10.5 2e-07 list:exact\n"));
    assert_null(strstr(data, "cubic-monomial"));
    assert_non_null(strstr(script, "set output 'chart.svg'"));
    assert_non_null(strstr(script, "index 2 using 1:2 with lines"));
    free(data);
    free(script);
    json_decref(document);
    mns_field_destroy(field);
}

/* gnuplot has eight colours; of more curves no two look the same. */
static void no_two_curves_look_the_same(void **state)
{
    const cli *c = *state;
    enum { CURVES = 20 };
    mns_error error;
    char note[CHART_NOTE_SIZE], seen[CURVES][40];
    size_t size, count = 0;
    json_t *runs = json_array();
    for (int i = 0; i < CURVES; i++) {
        char method[16];
        snprintf(method, sizeof method, "m%02d", i);
        json_array_append_new(runs, json_pack("{s:s, s:s, s:s, s:{s:f}, s:{s:{s:f}}}", "name", method,
                                              "method", method, "solver", "exact", "ms", "median", 1.0 + i,
                                              "errors", "t", "p99", 1e-6));
    }
    json_t *document = json_pack("{s:o, s:{s:s}, s:s}", "runs", runs, "input", "name", "x", "renderer", "r");
    assert_non_null(document);
    assert_int_equal(chart_write(document, c->folder, note, &error), MNS_OK);
    char *script = cli_read(c, "chart.gp", &size);
    for (const char *at = script; (at = strstr(at, "with linespoints "));) {
        const char *end = strstr(at, " title");
        assert_true(end && count < CURVES && end - at < 40);
        snprintf(seen[count], sizeof seen[count], "%.*s", (int)(end - at), at);
        for (size_t i = 0; i < count; i++) assert_string_not_equal(seen[i], seen[count]);
        count++;
        at = end;
    }
    assert_int_equal(count, CURVES);
    assert_non_null(strstr(seen[0], " lc 1 dt 1"));
    assert_non_null(strstr(seen[8], " lc 1 dt 2"));
    if (!*note) assert_true(cli_exists(c, "chart.svg")); /* gnuplot takes the script */
    assert_null(strstr(note, "ended with"));
    free(script);
    json_decref(document);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, setup, teardown)
    const struct CMUnitTest tests[] = {
        TEST(json_holds_every_figure),     TEST(csv_has_a_row_a_run),
        TEST(csv_has_the_rows_of_a_suite), TEST(the_chart_can_be_made_again),
        TEST(no_two_curves_look_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
