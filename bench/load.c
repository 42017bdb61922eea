/* Reading particle files, in MB/s: bench_load FOLDER [COUNT]. Makes a file of each format in FOLDER, reads
 * each in turn, several rounds, and prints the best: with a radius given, so that what is measured is the
 * reading, and without, where the spacing of the particles is measured too. Medians would tell of the
 * machine's other work. */
#include "base/clock.h"
#include "field/field.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>

enum { ROUNDS = 5, PATH = 4096 };

typedef void print_rows(FILE *out, const particles *p);

static void print_csv(FILE *out, const particles *p)
{
    fprintf(out, "x,y,z,r\n");
    for (size_t i = 0; i < p->count; i++)
        fprintf(out, "%.9g,%.9g,%.9g,0.02\n", p->axis[0][i], p->axis[1][i], p->axis[2][i]);
}

static void print_csv_full(FILE *out, const particles *p)
{
    fprintf(out, "x,y,z\n");
    for (size_t i = 0; i < p->count; i++)
        fprintf(out, "%.17g,%.17g,%.17g\n", p->axis[0][i], p->axis[1][i], p->axis[2][i]);
}

/* Atoms in an order of their own, as LAMMPS leaves them. */
static void print_lammps(FILE *out, const particles *p)
{
    size_t step = 1000003 % p->count ? 1000003 : 1;
    fprintf(out, "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n%zu\nITEM: BOX BOUNDS pp pp pp\n0 2\n0 1\n0 1\n",
            p->count);
    fprintf(out, "ITEM: ATOMS id type x y z vx vy vz\n");
    for (size_t k = 0; k < p->count; k++) {
        size_t i = k * step % p->count;
        double x = p->axis[0][i], y = p->axis[1][i], z = p->axis[2][i];
        fprintf(out, "%zu 1 %g %g %g %g %g %g\n", i + 1, x, y, z, x - y, y - z, z - x);
    }
}

static void print_xyz(FILE *out, const particles *p)
{
    fprintf(out, "%zu\nwater\n", p->count);
    for (size_t i = 0; i < p->count; i++)
        fprintf(out, "%s %.6f %.6f %.6f\n", i % 3 ? "H" : "O", p->axis[0][i], p->axis[1][i], p->axis[2][i]);
}

static void print_vtk(FILE *out, const particles *p)
{
    fprintf(out, "# vtk DataFile Version 3.0\nballs\nASCII\nDATASET POLYDATA\nPOINTS %zu double\n", p->count);
    for (size_t i = 0; i < p->count; i++)
        fprintf(out, "%.9g %.9g %.9g\n", p->axis[0][i], p->axis[1][i], p->axis[2][i]);
}

static void print_vtk_binary(FILE *out, const particles *p)
{
    fprintf(out, "# vtk DataFile Version 3.0\nballs\nBINARY\nDATASET POLYDATA\nPOINTS %zu double\n",
            p->count);
    for (size_t i = 0; i < p->count; i++)
        for (int k = 0; k < 3; k++) {
            uint64_t bits;
            unsigned char bytes[8];
            memcpy(&bits, &p->axis[k][i], sizeof bits);
            for (int b = 0; b < 8; b++) bytes[b] = (unsigned char)(bits >> (56 - 8 * b));
            fwrite(bytes, 1, sizeof bytes, out);
        }
    fputc('\n', out);
}

static const struct {
    const char *file, *shown;
    print_rows *print;
} formats[] = {
    {"load.lammpstrj", "LAMMPS, unsorted, 8 columns", print_lammps},
    {"load.csv", "CSV, 9 digits, radii", print_csv},
    {"full.csv", "CSV, 17 digits", print_csv_full},
    {"load.xyz", "XYZ, 6 places", print_xyz},
    {"load.vtk", "VTK, ASCII, 9 digits", print_vtk},
    {"binary.vtk", "VTK, binary doubles", print_vtk_binary},
};

enum { FORMATS = sizeof formats / sizeof *formats };

static double processor_ms(void)
{
    struct rusage used;
    getrusage(RUSAGE_SELF, &used);
    return (double)(used.ru_utime.tv_sec + used.ru_stime.tv_sec) * 1e3 +
           (double)(used.ru_utime.tv_usec + used.ru_stime.tv_usec) * 1e-3;
}

/* Milliseconds of opening and reading a file, on the clock and of the processors. */
static bool read_once(const char *path, double radius, double ms[2], mns_error *error)
{
    const mns_input_options options = {.radius = radius};
    mns_input *input;
    mns_field *field = NULL;
    double start = clock_ms(), used = processor_ms();
    if (mns_input_open(&path, 1, &options, &input, error)) return false;
    mns_status status = mns_input_read(input, 0, &field, error);
    ms[0] = clock_ms() - start, ms[1] = processor_ms() - used;
    mns_field_destroy(field);
    mns_input_close(input);
    return !status;
}

static bool make_files(const char *folder, size_t count, char path[FORMATS][PATH], mns_error *error)
{
    char name[64];
    const char *names = name;
    mns_input *input;
    mns_field *field = NULL;
    snprintf(name, sizeof name, "dense:%zu", count);
    if (mns_input_open(&names, 1, NULL, &input, error)) return false;
    bool is_fine = !mns_input_read(input, 0, &field, error);
    for (size_t i = 0; is_fine && i < FORMATS; i++) {
        snprintf(path[i], PATH, "%.4000s/%s", folder, formats[i].file);
        FILE *out = fopen(path[i], "wb");
        if (out) formats[i].print(out, &field->p);
        is_fine = out && !fclose(out);
        if (!is_fine) snprintf(error->text, sizeof error->text, "%.400s: cannot be written", path[i]);
    }
    mns_field_destroy(field);
    mns_input_close(input);
    return is_fine;
}

static bool measure(char path[FORMATS][PATH], double best[FORMATS][2][2], mns_error *error)
{
    for (int round = 0; round < ROUNDS; round++)
        for (int i = 0; i < FORMATS; i++)
            for (int spaced = 0; spaced < 2; spaced++) {
                double ms[2], *least = best[i][spaced];
                if (!read_once(path[i], spaced ? 0 : 0.02, ms, error)) return false;
                for (int k = 0; k < 2; k++) least[k] = !round || ms[k] < least[k] ? ms[k] : least[k];
            }
    return true;
}

int main(int argc, char **argv)
{
    static char path[FORMATS][PATH];
    double best[FORMATS][2][2];
    mns_error error = {0};
    long count = argc > 2 ? atol(argv[2]) : 1600000;
    if (argc < 2 || count < 1) {
        fprintf(stderr, "usage: bench_load FOLDER [COUNT]\n");
        return 2;
    }
    if (!make_files(argv[1], (size_t)count, path, &error) || !measure(path, best, &error)) {
        fprintf(stderr, "bench_load: %s\n", error.text);
        return 1;
    }
    printf("%ld balls, best of %d rounds in turn; MB are 10^6 bytes.\n\n", count, ROUNDS);
    printf("| file | MB | MB/s | processor ms | ms, without `--radius` |\n|-|-|-|-|-|\n");
    for (int i = 0; i < FORMATS; i++) {
        struct stat about;
        if (stat(path[i], &about)) return 1;
        printf("| %s | %.1f | %.0f | %.0f | %.0f |\n", formats[i].shown, (double)about.st_size / 1e6,
               (double)about.st_size / 1e3 / best[i][0][0], best[i][0][1], best[i][1][0]);
    }
    return 0;
}
