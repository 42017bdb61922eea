/* For tests of image files: a folder of their own, an image with every kind of value, and whole files read or
 * written. */
#ifndef MNS_TESTS_IMAGE_FIXTURE_H
#define MNS_TESTS_IMAGE_FIXTURE_H

#include "meniscus.h"

#define IMAGE_FIXTURE_PATH_MAX 512

/* setup and teardown for cmocka: *state is the name of a fresh folder, removed with all its files. */
int image_fixture_setup(void **state);
int image_fixture_teardown(void **state);

/* "folder/name", in a buffer of the caller's. */
const char *image_fixture_path(char buffer[IMAGE_FIXTURE_PATH_MAX], const char *folder, const char *name);

/* Entries of a folder, "." and ".." apart. */
int image_fixture_count(const char *folder);

/* An opaque image of noise, with infinities, negative zeros, denormals and the largest floats among the
 * planes. Ends the test on failure; free by mns_image_destroy. */
mns_image *image_fixture_noise(int width, int height);

/* A whole file, its size in *size; free by free. Ends the test on failure. */
unsigned char *image_fixture_load(const char *path, size_t *size);
void image_fixture_save(const char *path, const void *bytes, size_t size);

#endif
