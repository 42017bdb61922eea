#include "compare/chart.h"

#include "base/memory.h"
#include "base/status.h"

#include <errno.h>
#include <fcntl.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

/* A run's place in the chart. */
typedef struct chart_point {
    char curve[64]; /* "list exact" */
    const char *name;
    double ms, off; /* median time, 99th percentile of the error of t */
    bool front;
} chart_point;

typedef struct chart {
    chart_point *point; /* by curve, in it by time */
    size_t count;
} chart;

static int by_curve(const void *a, const void *b)
{
    const chart_point *p = a, *q = b;
    int order = strcmp(p->curve, q->curve);
    return order ? order : (p->ms > q->ms) - (p->ms < q->ms);
}

static int by_time(const void *a, const void *b)
{
    const chart_point *p = a, *q = b;
    return (p->ms > q->ms) - (p->ms < q->ms);
}

/* The runs that have both figures, for the caller to free. */
static mns_status collect(const json_t *runs, chart *c, mns_error *error)
{
    c->point = memory_array(json_array_size(runs), sizeof *c->point);
    c->count = 0;
    if (!c->point) return status_no_memory(error, "making a chart");
    for (size_t i = 0; i < json_array_size(runs); i++) {
        const json_t *run = json_array_get(runs, i);
        const json_t *ms = json_object_get(json_object_get(run, "ms"), "median");
        const json_t *off = json_object_get(json_object_get(json_object_get(run, "errors"), "t"), "p99");
        chart_point *p = &c->point[c->count];
        if (!json_is_number(ms) || !json_is_number(off) || !(json_number_value(ms) > 0)) continue;
        p->ms = json_number_value(ms);
        p->off = json_number_value(off);
        if (p->off < CHART_ERROR_LEAST) p->off = CHART_ERROR_LEAST;
        p->name = json_string_value(json_object_get(run, "name"));
        p->front = json_is_true(json_object_get(run, "pareto"));
        snprintf(p->curve, sizeof p->curve, "%s %s", json_string_value(json_object_get(run, "method")),
                 json_string_value(json_object_get(run, "solver")));
        c->count++;
    }
    qsort(c->point, c->count, sizeof *c->point, by_curve);
    return MNS_OK;
}

/* Opens a new file of the folder; NULL and an error where that fails. */
static FILE *open_file(const char *folder, const char *name, mns_error *error)
{
    char reason[96], *path = NULL;
    if (asprintf(&path, "%s/%s", folder, name) < 0) {
        status_no_memory(error, "making a chart");
        return NULL;
    }
    FILE *file = fopen(path, "wx");
    if (!file)
        status_fail(error, MNS_ERROR_IO, "%.300s: cannot write: %s", path,
                    strerror_r(errno, reason, sizeof reason));
    free(path);
    return file;
}

static mns_status close_file(FILE *file, const char *folder, const char *name, mns_error *error)
{
    bool good = !ferror(file);
    good = !fclose(file) && good;
    if (good) return MNS_OK;
    return status_fail(error, MNS_ERROR_IO, "%.300s/%s: cannot write: is the disk full?", folder, name);
}

static bool starts_curve(const chart *c, size_t i)
{
    return i == 0 || strcmp(c->point[i].curve, c->point[i - 1].curve) != 0;
}

/* A block a curve, two empty lines between; the front is the last. Returns the number of curves. */
static int write_data(const chart *c, FILE *file)
{
    int curves = 0;
    fprintf(file,
            "# ms: median of a frame; error: 99th percentile of |t - t*| / max(t*, R_j), %g where less\n",
            CHART_ERROR_LEAST);
    fputs("# ms error run\n", file);
    for (size_t i = 0; i < c->count; i++) {
        if (starts_curve(c, i)) fprintf(file, "%s# %s\n", curves++ ? "\n\n" : "", c->point[i].curve);
        fprintf(file, "%.6g %.6g %s\n", c->point[i].ms, c->point[i].off, c->point[i].name);
    }
    fputs("\n\n# the front: no other run is both faster and nearer to the truth\n", file);
    chart sorted = {memory_array(c->count, sizeof *c->point), c->count};
    if (!sorted.point) return 0;
    memcpy(sorted.point, c->point, c->count * sizeof *c->point);
    qsort(sorted.point, sorted.count, sizeof *sorted.point, by_time);
    for (size_t i = 0; i < sorted.count; i++)
        if (sorted.point[i].front)
            fprintf(file, "%.6g %.6g %s\n", sorted.point[i].ms, sorted.point[i].off, sorted.point[i].name);
    free(sorted.point);
    return curves;
}

/* gnuplot has eight colours: the curves after them have these again, and other dashes and points. */
static void write_curve(FILE *file, int curve, const char *title)
{
    enum { COLORS = 8, TURNS = 5 };
    static const int point[TURNS] = {7, 5, 9, 11, 13}; /* filled: a disc, a square, triangles, a diamond */
    int turn = curve / COLORS % TURNS;
    fprintf(file, ", \\\n '' index %d using 1:2 with linespoints pt %d ps 0.9 lc %d dt %d title '%s'", curve,
            point[turn], curve % COLORS + 1, turn + 1, title);
}

/* In single quotes, where gnuplot knows no escape but a doubled quote. */
static void write_quoted(FILE *file, const char *text)
{
    fputc('\'', file);
    for (const char *c = text ? text : ""; *c; c++) {
        if (*c == '\'') fputc('\'', file);
        fputc((unsigned char)*c < 0x20 ? ' ' : *c, file);
    }
    fputc('\'', file);
}

static void write_script(const chart *c, int curves, const json_t *document, FILE *file)
{
    const json_t *view = json_object_get(document, "view");
    char title[400];
    const char *input = json_string_value(json_object_get(json_object_get(document, "input"), "name"));
    snprintf(title, sizeof title, "%.240s, %lldx%lld, %.100s", input ? input : "",
             (long long)json_integer_value(json_object_get(view, "width")),
             (long long)json_integer_value(json_object_get(view, "height")),
             json_string_value(json_object_get(document, "renderer")));
    fputs("# gnuplot chart.gp makes chart.svg of chart.dat\n"
          "set terminal svg noenhanced size 900,600 font 'sans-serif,13' background 'white'\n"
          "set output 'chart.svg'\n"
          "set title ",
          file);
    write_quoted(file, title);
    fputs("\nset xlabel 'median time of a frame, milliseconds'\n"
          "set ylabel 'error of t, 99th percentile: |t - t*| / max(t*, R_j)'\n"
          "set logscale xy\n"
          "set format y '1e%T'\n"
          "set offsets graph 0.12, graph 0.3, graph 0.12, graph 0.12\n"
          "set grid xtics ytics lc rgb '#dddddd'\n"
          "set key outside below\n",
          file);
    fprintf(file, "plot 'chart.dat' index %d using 1:2 with lines lw 5 lc rgb '#dddddd' title 'Pareto front'",
            curves);
    int curve = 0;
    for (size_t i = 0; i < c->count; i++) {
        if (!starts_curve(c, i)) continue;
        write_curve(file, curve, c->point[i].curve);
        fprintf(file, ", \\\n '' index %d using 1:2:3 with labels left offset 0.8,0.5 font ',10' notitle",
                curve++);
    }
    fputc('\n', file);
}

/* Runs gnuplot in the folder, its words put aside; its exit status, or -1 where it does not start. */
static int run_gnuplot(const char *folder)
{
    posix_spawn_file_actions_t actions;
    char program[] = "gnuplot", script[] = "chart.gp";
    char *arguments[] = {program, script, NULL};
    pid_t child;
    int result = -1;
    if (posix_spawn_file_actions_init(&actions)) return -1;
    bool ready = !posix_spawn_file_actions_addchdir_np(&actions, folder) &&
                 !posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0) &&
                 !posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0) &&
                 !posix_spawn_file_actions_adddup2(&actions, 1, 2);
    if (ready && !posix_spawnp(&child, program, &actions, NULL, arguments, environ)) {
        int status = 0;
        while (waitpid(child, &status, 0) < 0 && errno == EINTR) continue;
        result = WIFEXITED(status) ? WEXITSTATUS(status) : 1;
    }
    posix_spawn_file_actions_destroy(&actions);
    return result;
}

static void make_svg(const char *folder, char note[CHART_NOTE_SIZE])
{
    char *path = NULL;
    int result = run_gnuplot(folder);
    if (!result) return;
    if (result < 0 || result == 127)
        snprintf(note, CHART_NOTE_SIZE,
                 "no chart.svg: gnuplot is not installed; \"gnuplot chart.gp\" in the folder makes it");
    else
        snprintf(note, CHART_NOTE_SIZE,
                 "no chart.svg: gnuplot ended with status %d; \"gnuplot chart.gp\" in the folder says why",
                 result);
    if (asprintf(&path, "%s/chart.svg", folder) < 0) return;
    unlink(path); /* a half made one */
    free(path);
}

mns_status chart_write(const json_t *document, const char *folder, char note[CHART_NOTE_SIZE],
                       mns_error *error)
{
    chart c;
    mns_status status = collect(json_object_get(document, "runs"), &c, error);
    if (status) return status;
    note[0] = '\0';
    int curves = 0;
    FILE *file = open_file(folder, "chart.dat", error);
    if (file) {
        curves = write_data(&c, file);
        status = close_file(file, folder, "chart.dat", error);
    } else {
        status = MNS_ERROR_IO;
    }
    file = status ? NULL : open_file(folder, "chart.gp", error);
    if (file) {
        write_script(&c, curves, document, file);
        status = close_file(file, folder, "chart.gp", error);
    } else if (!status) {
        status = MNS_ERROR_IO;
    }
    if (!status && !c.count)
        snprintf(note, CHART_NOTE_SIZE, "no chart.svg: no run has both a time and an error");
    else if (!status)
        make_svg(folder, note);
    free(c.point);
    return status;
}
