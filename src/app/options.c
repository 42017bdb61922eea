#include "app/options.h"

#include "app/app.h"
#include "app/spelling.h"

#include <argp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { KEY_HELP = '?', KEY_FIRST = 0x100 }; /* a row's key is its letter, or else KEY_FIRST + its index */

/* The options as they were given, in order. */
typedef struct given_option {
    size_t row;
    const char *text;
} given_option;

typedef struct command_line {
    const option_table *table;
    given_option *given;
    size_t given_count;
    const char **names;
    size_t name_count;
    bool help;
    int next; /* of argv, after what was understood so far */
} command_line;

static int row_key(const option_table *table, size_t i)
{
    return table->rows[i].letter ? table->rows[i].letter : KEY_FIRST + (int)i;
}

static bool take(command_line *line, int key, char *text)
{
    if (key == KEY_HELP) {
        line->help = true;
        return true;
    }
    if (key == ARGP_KEY_ARG) {
        line->names[line->name_count++] = text;
        return true;
    }
    for (size_t i = 0; i < line->table->count; i++) {
        if (!line->table->rows[i].name || row_key(line->table, i) != key) continue;
        line->given[line->given_count++] = (given_option){i, text};
        return true;
    }
    return false;
}

static error_t record(int key, char *text, struct argp_state *state)
{
    command_line *line = state->input;
    if (!take(line, key, text)) return ARGP_ERR_UNKNOWN;
    line->next = state->next;
    return 0;
}

/* The table as argp wants it, for the caller to free; NULL where memory ends. */
static struct argp_option *argp_rows(const option_table *table)
{
    struct argp_option *rows = calloc(table->count + 2, sizeof *rows);
    if (!rows) return NULL;
    int group = 0;
    for (size_t i = 0; i < table->count; i++) {
        const option_row *row = &table->rows[i];
        if (!row->name) group++;
        bool may = row->value && row->value[0] == '?';
        rows[i] = (struct argp_option){row->name,
                                       row->name ? row_key(table, i) : 0,
                                       may ? row->value + 1 : row->value,
                                       may ? OPTION_ARG_OPTIONAL : 0,
                                       row->doc,
                                       group};
    }
    rows[table->count] = (struct argp_option){"help", KEY_HELP, NULL, 0, "print this", -1};
    return rows;
}

/* The option whose name is nearest to a misspelt one; NULL: none is near. */
static const char *meant_by(const option_table *table, const char *name, size_t length)
{
    const char *meant = NULL;
    size_t best = length > 4 ? SPELLING_FAR : SPELLING_FAR - 1;
    for (size_t i = 0; i < table->count; i++) {
        size_t slips = table->rows[i].name ? spelling_slips(name, length, table->rows[i].name) : best;
        if (slips < best) best = slips, meant = table->rows[i].name;
    }
    return meant;
}

/* argp stopped at `word`: says why. */
static mns_status wrong_word(const option_table *table, const char *word, mns_error *error)
{
    size_t length = strcspn(word, "=");
    for (size_t i = 0; i < table->count; i++) {
        const option_row *row = &table->rows[i];
        bool is_letter = row->letter && word[0] == '-' && word[1] == row->letter;
        bool is_name =
            row->name && length == strlen(row->name) + 2 && !strncmp(word + 2, row->name, length - 2);
        if (!is_letter && !is_name) continue;
        if (row->value)
            return app_fail(error, MNS_ERROR_USAGE, "%.*s: expected a value, %s", (int)length, word,
                            row->value);
        return app_fail(error, MNS_ERROR_USAGE, "%.*s: takes no value", (int)length, word);
    }
    const char *meant = length > 2 ? meant_by(table, word + 2, length - 2) : NULL;
    return app_fail(error, MNS_ERROR_USAGE, "unknown option %.80s%s%s; \"meniscus %s --help\" lists them",
                    word, meant ? ": expected --" : "", meant ? meant : "", table->command);
}

/* A whole number after an option that takes its value by an equals sign alone would be read as a file's name.
 */
static mns_status check_loose_values(const option_table *table, int argc, char **argv, mns_error *error)
{
    for (int i = 1; i + 1 < argc && strcmp(argv[i], "--") != 0; i++) {
        const char *value = argv[i + 1];
        if (strncmp(argv[i], "--", 2) != 0 || !*value || value[strspn(value, "0123456789")]) continue;
        for (size_t r = 0; r < table->count; r++) {
            const option_row *row = &table->rows[r];
            if (row->name && row->value && row->value[0] == '?' &&
                strstr(row->name, argv[i] + 2) == row->name)
                return app_fail(error, MNS_ERROR_USAGE,
                                "%s %.40s: expected %s=%.40s, or ./%.40s for a file of that name", argv[i],
                                value, argv[i], value, value);
        }
    }
    return MNS_OK;
}

/* Splits argv into options and names; prints the help where it is asked for. */
static mns_status split(int argc, char **argv, command_line *line, mns_error *error)
{
    const option_table *table = line->table;
    struct argp_option *rows = argp_rows(table);
    if (!rows) return app_fail(error, MNS_ERROR_MEMORY, "out of memory reading the command line");
    struct argp argp = {.options = rows, .parser = record, .args_doc = table->arguments, .doc = table->doc};
    unsigned flags = ARGP_NO_ERRS | ARGP_NO_HELP | ARGP_NO_EXIT | ARGP_IN_ORDER;
    mns_status status = MNS_OK;
    line->next = 1;
    if (argp_parse(&argp, argc, argv, flags, NULL, line))
        status = wrong_word(table, line->next < argc ? argv[line->next] : argv[argc - 1], error);
    if (!status && line->help) {
        char name[40];
        snprintf(name, sizeof name, "meniscus %s", table->command);
        argp_help(&argp, stdout, ARGP_HELP_STD_HELP & ~(ARGP_HELP_EXIT_OK | ARGP_HELP_BUG_ADDR), name);
    }
    free(rows);
    return status;
}

static mns_status apply(const command_line *line, app_options *o, mns_error *error)
{
    mns_status status = MNS_OK;
    for (size_t i = 0; i < line->given_count && !status; i++) {
        const option_row *row = &line->table->rows[line->given[i].row];
        char name[40];
        snprintf(name, sizeof name, "--%s", row->name);
        status = row->apply(o, name, line->given[i].text, error);
    }
    return status;
}

static mns_status note_given(const command_line *line, app_options *o, mns_error *error)
{
    o->given = calloc(line->given_count + 1, sizeof *o->given);
    if (!o->given) return app_fail(error, MNS_ERROR_MEMORY, "out of memory reading the command line");
    o->given_count = line->given_count;
    for (size_t i = 0; i < line->given_count; i++) o->given[i] = line->table->rows[line->given[i].row].name;
    return MNS_OK;
}

static bool is_scene(const char *name)
{
    const char *ending = strrchr(name, '.');
    return ending && strcasecmp(ending, ".json") == 0;
}

/* Lays the scene among the names, if there is one, under the options; other names replace the scene's inputs.
 */
static mns_status take_names(command_line *line, app_options *o, mns_error *error)
{
    const char *scene = NULL;
    size_t kept = 0;
    for (size_t i = 0; i < line->name_count; i++) {
        const char *name = line->names[i];
        if (!is_scene(name)) {
            line->names[kept++] = name;
        } else if (scene) {
            return app_fail(error, MNS_ERROR_USAGE, "two scenes, %.80s and %.80s: expected at most one",
                            scene, name);
        } else {
            scene = name;
        }
    }
    if (scene) {
        mns_status status = mns_scene_load(scene, &o->scene, error);
        if (status) return status;
        o->field = o->scene->field;
        o->view = o->scene->view;
        o->look = o->scene->look;
        o->draw = o->scene->draw;
        o->frames = (parse_frames_range){
            .given = o->scene->frame > 0, .first = o->scene->frame, .last = o->scene->frame, .step = 1};
        o->inputs = o->scene->inputs;
        o->input_count = o->scene->input_count;
        o->range_is_scenes = o->look.set & MNS_LOOK_RANGE;
        o->blend_range_is_scenes = true;
    }
    if (kept) {
        o->inputs = line->names;
        o->input_count = kept;
        o->frames = (parse_frames_range){0}; /* the scene's is one of its own input's */
    }
    return MNS_OK;
}

static void free_meshes(app_options *o)
{
    for (size_t i = 0; i < o->mesh_count; i++) free((char *)o->meshes[i].file);
    o->mesh_count = 0;
}

mns_status options_read(const option_table *table, int argc, char **argv, app_options *o, mns_error *error)
{
    memset(o, 0, sizeof *o);
    app_options scratch = *o;
    command_line line = {.table = table,
                         .given = calloc((size_t)argc, sizeof *line.given),
                         .names = calloc((size_t)argc, sizeof *line.names)};
    o->names = line.names;
    mns_status status = MNS_OK;
    if (!line.given || !line.names)
        status = app_fail(error, MNS_ERROR_MEMORY, "out of memory reading the command line");
    if (!status) status = check_loose_values(table, argc, argv, error);
    if (!status) status = split(argc, argv, &line, error);
    o->help = line.help;
    if (!status && !line.help) {
        status = apply(&line, &scratch, error);
        free_meshes(&scratch);
        if (!status) status = take_names(&line, o, error);
        if (!status) status = apply(&line, o, error);
        if (!status) status = note_given(&line, o, error);
    }
    free(line.given);
    return status;
}

void options_free(app_options *o)
{
    mns_scene_destroy(o->scene);
    free_meshes(o);
    free(o->names);
    free(o->given);
}

const char *options_beside(const app_options *o, const char *const *known)
{
    for (size_t i = 0; i < o->given_count; i++) {
        size_t k = 0;
        while (known[k] && strcmp(known[k], o->given[i]) != 0) k++;
        if (!known[k]) return o->given[i];
    }
    return NULL;
}

/* ---- Rows that commands share ---- */

static const char *kernel_name(int i)
{
    return i == MNS_KERNEL_DEFAULT ? NULL : mns_kernel_name((mns_kernel)i);
}

mns_status option_kernel(app_options *o, const char *name, const char *text, mns_error *error)
{
    int index;
    mns_status status = parse_name(name, text, kernel_name, MNS_KERNEL_COUNT, &index, error);
    if (!status) o->field.kernel = (mns_kernel)index;
    return status;
}

mns_status option_iso(app_options *o, const char *name, const char *text, mns_error *error)
{
    return parse_positive(name, text, &o->field.iso, error);
}

mns_status option_radius(app_options *o, const char *name, const char *text, mns_error *error)
{
    return parse_positive(name, text, &o->field.radius, error);
}

mns_status option_radius_scale(app_options *o, const char *name, const char *text, mns_error *error)
{
    return parse_positive(name, text, &o->field.radius_scale, error);
}

mns_status option_frame(app_options *o, const char *name, const char *text, mns_error *error)
{
    return parse_frames(name, text, &o->frames, error);
}
