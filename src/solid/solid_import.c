#include "solid/solid_import.h"

#include "base/status.h"

#include <assimp/cfileio.h>
#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* assimp has one text for the last failure of any thread, and writes it unguarded: an import has to end, and
 * its text be copied, before the next one begins. The lock is for that text alone, and a host that calls
 * assimp itself does not take it. */
static pthread_mutex_t importing = PTHREAD_MUTEX_INITIALIZER;

/* ---- A file, as assimp asks for it ---- */

static FILE *file_of(struct aiFile *file)
{
    return (FILE *)(void *)file->UserData;
}

static size_t read_some(struct aiFile *file, char *to, size_t size, size_t count)
{
    return fread(to, size, count, file_of(file));
}

/* None is opened for that. */
static size_t write_none(struct aiFile *file, const char *from, size_t size, size_t count)
{
    (void)file, (void)from, (void)size, (void)count;
    return 0;
}

static void flush_none(struct aiFile *file)
{
    (void)file;
}

static size_t tell(struct aiFile *file)
{
    off_t at = ftello(file_of(file));
    return at < 0 ? 0 : (size_t)at;
}

static size_t size_of(struct aiFile *file)
{
    struct stat about;
    return fstat(fileno(file_of(file)), &about) || about.st_size < 0 ? 0 : (size_t)about.st_size;
}

static enum aiReturn seek(struct aiFile *file, size_t offset, enum aiOrigin from)
{
    int whence = from == aiOrigin_CUR ? SEEK_CUR : from == aiOrigin_END ? SEEK_END : SEEK_SET;
    return fseeko(file_of(file), (off_t)offset, whence) ? aiReturn_FAILURE : aiReturn_SUCCESS;
}

/* For reading alone, whatever a format may ask for; what it is is noted before anything is read of it. */
static struct aiFile *open_noted(struct aiFileIO *io, const char *name, const char *mode)
{
    watch *opened = (watch *)(void *)io->UserData;
    struct stat about;
    FILE *file = *mode == 'r' && !strchr(mode, '+') ? fopen(name, "rb") : NULL;
    struct aiFile *made = file ? malloc(sizeof *made) : NULL;
    if (file && !made) opened->failed = true;
    if (made && !fstat(fileno(file), &about) && !S_ISDIR(about.st_mode) && watch_note(opened, name, &about)) {
        *made = (struct aiFile){.ReadProc = read_some,
                                .WriteProc = write_none,
                                .TellProc = tell,
                                .FileSizeProc = size_of,
                                .SeekProc = seek,
                                .FlushProc = flush_none,
                                .UserData = (char *)(void *)file};
        return made;
    }
    free(made);
    if (file) fclose(file);
    return NULL;
}

static void close_noted(struct aiFileIO *io, struct aiFile *file)
{
    (void)io;
    if (!file) return;
    fclose(file_of(file));
    free(file);
}

/* ---- A mesh ---- */

mns_status solid_import(const char *file, watch *opened, const struct aiScene **scene, mns_error *error)
{
    struct aiFileIO io = {
        .OpenProc = open_noted, .CloseProc = close_noted, .UserData = (char *)(void *)opened};
    mns_status status = MNS_OK;
    pthread_mutex_lock(&importing);
    *scene = aiImportFileEx(file, aiProcess_Triangulate | aiProcess_ValidateDataStructure, &io);
    if (!*scene)
        status = status_fail(error, MNS_ERROR_INPUT, "%s: expected a mesh (OBJ, PLY, STL, glTF): %s", file,
                             aiGetErrorString());
    pthread_mutex_unlock(&importing);
    if (!opened->failed) return status;
    if (*scene) aiReleaseImport(*scene);
    *scene = NULL;
    return status_no_memory(error, "while reading a mesh");
}
