#include "compare/run.h"

#include "base/memory.h"
#include "base/status.h"

#include <ctype.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>

/* ---- What there is to run ---- */

typedef struct known_method {
    const char *method, *solver;
    mns_method method_value;
    mns_solver solver_value;
} known_method;

/* Every method with every solver of it. A new one is a line here, and where it iterates, lines of its caps
 * below. */
static const known_method METHODS[] = {
    {"list", "exact", MNS_METHOD_LIST, MNS_SOLVER_EXACT},
    {"list", "cubic", MNS_METHOD_LIST, MNS_SOLVER_CUBIC},
    {"list", "cubic-monomial", MNS_METHOD_LIST, MNS_SOLVER_CUBIC_MONOMIAL},
    {"tile", "exact", MNS_METHOD_TILE, MNS_SOLVER_EXACT},
    {"tile", "cubic", MNS_METHOD_TILE, MNS_SOLVER_CUBIC},
    {"tile", "cubic-monomial", MNS_METHOD_TILE, MNS_SOLVER_CUBIC_MONOMIAL},
    {"fbvh", "exact", MNS_METHOD_FBVH, MNS_SOLVER_EXACT},
    {"fbvh", "secant", MNS_METHOD_FBVH, MNS_SOLVER_SECANT},
    {"bvh", "exact", MNS_METHOD_BVH, MNS_SOLVER_EXACT},
    {"bvh", "secant", MNS_METHOD_BVH, MNS_SOLVER_SECANT},
    {"reference", "exact", MNS_METHOD_REFERENCE, MNS_SOLVER_EXACT},
};
enum { METHOD_COUNT = sizeof METHODS / sizeof *METHODS };

/* What is run where nothing is asked for: every method and solver but the reference, which is the truth; and
 * the passes as published. */
static const char DEFAULT_RUNS[] =
    "list:exact,list:cubic,list:cubic-monomial,list:exact:gather=paper,tile:exact,tile:cubic,"
    "tile:cubic-monomial,fbvh:exact,bvh:exact,fbvh:secant:secant-steps=2,fbvh:secant:secant-steps=4,"
    "fbvh:secant:secant-steps=8,fbvh:secant,bvh:secant";

typedef struct known_key {
    const char *key;
    long most;                                     /* a whole number from 1 to it; 0: one of the names */
    const char *names[3];                          /* NULL behind the last */
    void (*set)(mns_options *options, long value); /* the number, or the name's index */
} known_key;

static void set_gather(mns_options *options, long value)
{
    options->gather = (mns_gather)value;
}

static void set_slots(mns_options *options, long value)
{
    options->slots = (int)value;
}

static void set_root_steps(mns_options *options, long value)
{
    options->root_steps = (int)value;
}

static void set_shuffle(mns_options *options, long value)
{
    options->shuffle = (uint32_t)value;
}

static void set_pool(mns_options *options, long value)
{
    options->max_pool_nodes = (size_t)value;
}

static void set_secant_steps(mns_options *options, long value)
{
    options->secant_steps = (int)value;
}

static void set_samples(mns_options *options, long value)
{
    options->samples = (int)value;
}

static const known_key KEYS[] = {
    {"gather", 0, {"early-z", "paper"}, set_gather},
    {"slots", 1024, {NULL}, set_slots},
    {"root-steps", 4096, {NULL}, set_root_steps},
    {"shuffle", UINT32_MAX, {NULL}, set_shuffle},
    {"pool", INT32_MAX, {NULL}, set_pool},
    {"aa", 64, {NULL}, set_samples},
    {"secant-steps", 4096, {NULL}, set_secant_steps},
};
enum { KEY_COUNT = sizeof KEYS / sizeof *KEYS };

/* "early-z or paper", "a whole number from 1 to 64" */
static void describe_values(const known_key *key, char *text, size_t size)
{
    if (key->most)
        snprintf(text, size, "a whole number from 1 to %ld", key->most);
    else
        snprintf(text, size, "%s or %s", key->names[0], key->names[1]);
}

/* Appends what fits. */
static void append(char text[RUN_KNOWN_SIZE], const char *before, const char *word, const char *behind)
{
    size_t used = strlen(text);
    snprintf(text + used, RUN_KNOWN_SIZE - used, "%s%s%s", before, word, behind);
}

void run_known(char text[RUN_KNOWN_SIZE])
{
    text[0] = '\0';
    for (size_t i = 0; i < METHOD_COUNT; i++) {
        append(text, i ? ", " : "", METHODS[i].method, ":");
        append(text, "", METHODS[i].solver, "");
    }
    for (size_t i = 0; i < KEY_COUNT; i++) append(text, i ? ", " : "; keys: ", KEYS[i].key, "");
}

/* ---- Reading --runs ---- */

/* Splits off what stands before the first `separator`; NULL where nothing is left. */
static char *next_word(char **text, char separator)
{
    char *word = *text;
    if (!word) return NULL;
    char *end = strchr(word, separator);
    *text = end ? end + 1 : NULL;
    if (end) *end = '\0';
    return word;
}

/* The value that `text` stands for, -1 where it is none of the key's. */
static long read_value(const known_key *key, const char *text)
{
    char *end;
    for (long i = 0; key->names[i]; i++)
        if (!strcmp(text, key->names[i])) return i;
    if (!key->most || !isdigit((unsigned char)*text)) return -1;
    errno = 0;
    long value = strtol(text, &end, 10);
    return value >= 1 && value <= key->most && !errno && !*end ? value : -1;
}

static const known_key *find_key(const char *name)
{
    for (size_t i = 0; i < KEY_COUNT; i++)
        if (!strcmp(name, KEYS[i].key)) return &KEYS[i];
    return NULL;
}

static mns_status take_setting(run_spec *spec, char *word, mns_error *error)
{
    char expected[80], known[RUN_KNOWN_SIZE], *text = strchr(word, '=');
    if (!text)
        return status_fail(error, MNS_ERROR_USAGE, "--runs %.90s: \"%.40s\": expected KEY=VALUE", spec->name,
                           word);
    *text++ = '\0';
    const known_key *key = find_key(word);
    if (!key) {
        run_known(known);
        return status_fail(error, MNS_ERROR_USAGE, "--runs %.90s: unknown key %.40s; known are %s",
                           spec->name, word, strstr(known, "keys: ") + 6);
    }
    for (size_t k = 0; k < spec->setting_count; k++)
        if (spec->setting[k].key == key->key)
            return status_fail(error, MNS_ERROR_USAGE, "--runs %.90s: %s stands in it twice", spec->name,
                               word);
    long value = read_value(key, text);
    if (value < 0) {
        describe_values(key, expected, sizeof expected);
        return status_fail(error, MNS_ERROR_USAGE, "--runs %.90s: %s=%.40s: expected %s", spec->name, word,
                           text, expected);
    }
    key->set(&spec->options, value);
    run_setting *setting = &spec->setting[spec->setting_count++];
    setting->key = key->key;
    snprintf(setting->value, sizeof setting->value, "%s", text);
    return MNS_OK;
}

static mns_status take_run(run_spec *spec, char *text, mns_error *error)
{
    if (strlen(text) >= sizeof spec->name)
        return status_fail(error, MNS_ERROR_USAGE, "--runs %.90s...: expected fewer than %d characters a run",
                           text, RUN_NAME_SIZE);
    *spec = (run_spec){.method = NULL};
    strcpy(spec->name, text);
    const char *method = next_word(&text, ':'), *solver = next_word(&text, ':');
    for (size_t i = 0; i < METHOD_COUNT && solver && !spec->method; i++) {
        if (strcmp(method, METHODS[i].method) || strcmp(solver, METHODS[i].solver)) continue;
        spec->method = METHODS[i].method, spec->solver = METHODS[i].solver;
        spec->options.method = METHODS[i].method_value;
        spec->options.solver = METHODS[i].solver_value;
    }
    if (!spec->method) {
        char known[RUN_KNOWN_SIZE];
        run_known(known);
        return status_fail(error, MNS_ERROR_USAGE, "--runs %.90s: no such METHOD:SOLVER; known are %s",
                           spec->name, known);
    }
    mns_status status = MNS_OK;
    for (char *word; !status && (word = next_word(&text, ':'));) status = take_setting(spec, word, error);
    return status;
}

mns_status run_parse(const char *text, run_spec **runs, size_t *count, mns_error *error)
{
    char *copy = strdup(text ? text : DEFAULT_RUNS), *rest = copy;
    size_t most = 1, n = 0;
    for (const char *c = copy; c && *c; c++) most += *c == ',';
    run_spec *list = copy ? memory_array(most, sizeof *list) : NULL;
    mns_status status = list ? MNS_OK : status_no_memory(error, "reading --runs");
    for (char *word; !status && (word = next_word(&rest, ','));) {
        status = take_run(&list[n], word, error);
        for (size_t i = 0; i < n && !status; i++)
            if (!strcmp(list[i].name, list[n].name))
                status = status_fail(error, MNS_ERROR_USAGE, "--runs: %s stands in it twice", list[n].name);
        n++;
    }
    free(copy);
    if (status) {
        free(list);
        return status;
    }
    *runs = list;
    *count = n;
    return MNS_OK;
}
