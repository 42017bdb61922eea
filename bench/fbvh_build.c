/* What building a tree takes: fbvh_build SCENE[:SEED] OPTIONS ROUNDS. SCENE is a generator's name with a
 * count or a file; prints one line of figures, of the median round. */
#include "fbvh/fbvh.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static int by_value(const void *a, const void *b)
{
    const double *x = a, *y = b;
    return (*x > *y) - (*x < *y);
}

static int fail(const mns_error *error)
{
    fprintf(stderr, "fbvh_build: %s\n", error->text);
    return 1;
}

/* Of all threads: what a build costs on a machine that is busy with other things. */
static double processor_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec * 1e3 + (double)now.tv_nsec * 1e-6;
}

int main(int argc, char **argv)
{
    enum { ROUNDS_MOST = 100 };
    mns_error error = {0};
    mns_input *input;
    mns_field *field;
    fbvh_options options = {0};
    fbvh_builder *builder;
    const fbvh_tree *tree = NULL;
    double ms[ROUNDS_MOST], work[ROUNDS_MOST];
    if (argc != 4) return fprintf(stderr, "usage: fbvh_build SCENE OPTIONS ROUNDS\n"), 2;
    int rounds = atoi(argv[3]);
    if (rounds < 1 || rounds > ROUNDS_MOST)
        return fprintf(stderr, "fbvh_build: 1 to %d rounds\n", ROUNDS_MOST), 2;
    const char *name = argv[1];
    if (mns_input_open(&name, 1, NULL, &input, &error) || mns_input_read(input, 0, &field, &error) ||
        fbvh_options_parse(argv[2], &options, &error) || fbvh_builder_create(&builder, &error))
        return fail(&error);
    for (int i = 0; i < rounds; i++) {
        double start = processor_ms();
        if (fbvh_build(builder, field, &options, &tree, &error)) return fail(&error);
        ms[i] = tree->figures.build_ms;
        work[i] = processor_ms() - start;
    }
    double first = ms[0];
    qsort(ms, (size_t)rounds, sizeof *ms, by_value);
    qsort(work, (size_t)rounds, sizeof *work, by_value);
    const fbvh_figures *f = &tree->figures;
    double balls = (double)tree->ball_count;
    printf("%s %s balls=%zu first=%.1f median=%.1f least=%.1f processor=%.1f sort=%.1f leaves=%zu depth=%zu "
           "mean=%.1f "
           "largest=%zu "
           "references=%.2f bounded=%zu discarded=%zu bytes=%.1f scratch=%.1f\n",
           argv[1], *argv[2] ? argv[2] : "default", tree->ball_count, first, ms[rounds / 2], ms[0],
           work[rounds / 2], f->sort_ms, f->leaves, f->depth, f->leaf_mean, f->leaf_largest,
           (double)tree->reference_count / balls, f->leaves_bounded, f->discarded,
           (double)f->memory_bytes / balls, (double)f->scratch_bytes / balls);
    fbvh_builder_destroy(builder);
    mns_field_destroy(field);
    mns_input_close(input);
    return 0;
}
