#include "image/output.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { NAMES_MAX = 10000, NAME_ROOM = 64 };

mns_status output_failed(const char *path, int code, mns_error *error)
{
    char reason[128];
    /* the GNU variant: strerror is not safe among threads */
    return status_fail(error, MNS_ERROR_IO, "%s: cannot write: %s", path,
                       strerror_r(code, reason, sizeof reason));
}

/* Opens a new file in the folder of output->path under a name that nobody has, and returns its descriptor or
 * -1. Not mkstemp: its file would keep others out, whatever the umask. */
static int create_beside(output_file *output)
{
    const char *slash = strrchr(output->path, '/');
    int folder = slash ? (int)(slash - output->path) + 1 : 0, descriptor = -1;
    for (int n = 0; n < NAMES_MAX; n++) {
        snprintf(output->temporary, (size_t)folder + NAME_ROOM, "%.*s.meniscus-%ld-%d.part", folder,
                 output->path, (long)getpid(), n);
        descriptor = open(output->temporary, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor >= 0 || errno != EEXIST) break;
    }
    return descriptor;
}

mns_status output_open(output_file *output, const char *path, mns_error *error)
{
    struct stat there;
    if (!stat(path, &there)) {
        if (S_ISDIR(there.st_mode)) return output_failed(path, EISDIR, error);
        if (!S_ISREG(there.st_mode))
            return status_fail(error, MNS_ERROR_IO, "%s: cannot write: not a regular file", path);
    }
    *output = (output_file){.path = path, .temporary = malloc(strlen(path) + NAME_ROOM)};
    if (!output->temporary) return status_no_memory(error, "naming a file");
    int code, descriptor = create_beside(output);
    if (descriptor >= 0) {
        output->file = fdopen(descriptor, "wb");
        if (output->file) return MNS_OK;
        code = errno;
        close(descriptor);
        unlink(output->temporary);
    } else {
        code = errno;
    }
    free(output->temporary);
    return output_failed(path, code, error);
}

mns_status output_commit(output_file *output, mns_error *error)
{
    /* a full disk may show only when the last bytes leave the buffer */
    bool failed = ferror(output->file) != 0;
    errno = 0;
    failed |= fclose(output->file) != 0;
    failed = failed || rename(output->temporary, output->path) != 0;
    mns_status status = failed ? output_failed(output->path, errno ? errno : EIO, error) : MNS_OK;
    if (failed) unlink(output->temporary);
    free(output->temporary);
    *output = (output_file){0};
    return status;
}

void output_discard(output_file *output)
{
    fclose(output->file);
    unlink(output->temporary);
    free(output->temporary);
    *output = (output_file){0};
}
