/* Writes the made-up comparison into a folder: index.html, results.json and, of the suite alone, suite.html.
 * usage: write_page FOLDER */
#include "compare/page.h"
#include "page/made_up.h"

#include <stdio.h>
#include <stdlib.h>

static int write_all(const json_t *results, json_t *suite, const picture_list *list, const char *folder)
{
    char path[4096];
    mns_error error = {0};
    snprintf(path, sizeof path, "%s/results.json", folder);
    if (json_dump_file(results, path, JSON_REAL_PRECISION(9))) return perror(path), 1;
    snprintf(path, sizeof path, "%s/index.html", folder);
    mns_status status = page_write(results, list->picture, list->count, path, &error);
    snprintf(path, sizeof path, "%s/suite.html", folder);
    if (!status) status = page_write(suite, NULL, 0, path, &error);
    if (status) fprintf(stderr, "write_page: %s\n", error.text);
    return status != MNS_OK;
}

int main(int count, char **arguments)
{
    if (count != 2) return 2;
    json_t *results = made_up_results(), *suite = json_copy(results);
    picture_list list = {0};
    int failed = !results || !suite || !made_up_pictures(results, &list);
    if (!failed) {
        static const char *const absent[] = {"input", "view", "truth"};
        for (int i = 0; i < 3; i++) json_object_set_new(suite, absent[i], json_null());
        json_object_set_new(suite, "runs", json_array());
        failed = write_all(results, suite, &list, arguments[1]);
    }
    made_up_free(&list);
    json_decref(suite);
    json_decref(results);
    return failed;
}
