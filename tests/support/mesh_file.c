#include "support/mesh_file.h"

#include "meniscus.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

void mesh_write(const char *ending, const char *text, mesh_path path)
{
    snprintf(path, sizeof(mesh_path), "/tmp/mesh-XXXXXX%s", ending);
    int file = mkstemps(path, (int)strlen(ending));
    assert_true(file >= 0);
    assert_int_equal(write(file, text, strlen(text)), strlen(text));
    close(file);
}

bool mesh_is_built_in(void)
{
    return strstr(mns_version(), "no assimp") == NULL;
}
