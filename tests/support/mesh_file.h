/* Mesh files that a test writes, and whether this build reads any. */
#ifndef MNS_TESTS_MESH_FILE_H
#define MNS_TESTS_MESH_FILE_H

#include <stdbool.h>

typedef char mesh_path[40];

/* Writes the text to a new file of that ending (".obj"). Ends the test on failure; the caller unlinks it. */
void mesh_write(const char *ending, const char *text, mesh_path path);
bool mesh_is_built_in(void);

#endif
