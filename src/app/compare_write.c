#include "app/compare.h"

#include "app/app.h"
#include "compare/chart.h"
#include "compare/folder.h"
#include "compare/page.h"
#include "compare/results.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static mns_status write_files(const json_t *document, const picture_list *pictures,
                              const folder_output *folder, char note[CHART_NOTE_SIZE], mns_error *error)
{
    char *csv = folder_file(folder, "results.csv"), *json = folder_file(folder, "results.json");
    char *page = folder_file(folder, "index.html");
    mns_status status = MNS_OK;
    if (!csv || !json || !page) status = app_fail(error, MNS_ERROR_MEMORY, "out of memory naming files");
    if (!status) status = results_write_csv(document, csv, error);
    if (!status) status = results_write_json(document, json, error);
    if (!status) status = chart_write(document, folder->temporary, note, error);
    if (!status) status = page_write(document, pictures->picture, pictures->count, page, error);
    free(csv);
    free(json);
    free(page);
    return status;
}

mns_status compare_write(const json_t *document, const picture_list *pictures, const char *path,
                         mns_error *error)
{
    folder_output folder;
    char note[CHART_NOTE_SIZE] = "";
    mns_status status = folder_begin(&folder, path, error);
    if (status) return status;
    status = write_files(document, pictures, &folder, note, error);
    if (!status) status = folder_commit(&folder, error);
    folder_discard(&folder);
    if (status) return status;
    if (*note) app_note("%s", note);
    printf("%s: results.csv, results.json, chart%s, index.html\n", path, *note ? ".gp" : ".svg");
    return MNS_OK;
}

static void print_effects(const metrics_effects *e)
{
    const char *before = "; wrong of effects: ";
    for (truth_term term = 0; term < TRUTH_TERMS; term++)
        if (e->has[term]) {
            printf("%s%zu %s", before, e->wrong[term], metrics_term_name(term));
            before = ", ";
        }
    if (e->any) printf(", %zu undecided", e->undecided);
}

void compare_print(const run_result *run)
{
    const metrics *m = &run->errors;
    if (run->status) {
        printf("%s: %s\n", run->spec.name, run->error.text);
        return;
    }
    printf("%s: ", run->spec.name);
    if (isfinite(run->ms.median))
        printf("%.1f ms (%.1f to %.1f), ", run->ms.median, run->ms.min, run->ms.max);
    printf("%zu hits, %zu missed, %zu invented, %zu wrong root, %zu undecided", m->hits, m->missed_decided,
           m->invented_decided, m->wrong_root, m->undecided);
    if (m->compared)
        printf(", t p99 %.2g, max %.2g, normal p99 %.2g degrees", m->t.p99, m->t.max, m->normal.p99);
    print_effects(&m->effects);
    putchar('\n');
    fflush(stdout);
}
