#include "gl/binary.h"

#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* All programs of every variant that the tests draw by take 20 MB on llvmpipe. */
#define CACHE_BYTES ((uint64_t)64 << 20)

enum { FORMAT = 1, NAME_SIZE = 33, FORMATS_MOST = 64 };

static const uint64_t MAGIC = 0x474f5250534e4d21u;
static const char ending[] = "program";

/* In front of the driver's bytes. No gaps: it is written as it lies. */
typedef struct binary_header {
    uint64_t magic;
    uint32_t format, driver_format;
    gl_binary_key key;
    uint64_t size, sum; /* of the driver's bytes */
} binary_header;

static void name_of(const gl_binary_key *key, char name[NAME_SIZE])
{
    snprintf(name, NAME_SIZE, "%016llx%016llx", (unsigned long long)key->lane[0],
             (unsigned long long)key->lane[1]);
}

/* ---- Keys ---- */

void gl_binary_key_add(gl_binary_key *key, const char *text)
{
    size_t size = strlen(text) + 1; /* with its end, so that texts do not run into one another */
    key->lane[0] = store_sum(key->lane[0], text, size);
    key->lane[1] = store_sum(key->lane[1] ^ 0x9e3779b97f4a7c15u, text, size) + size;
}

gl_binary_key gl_binary_key_begin(const gl_device *device)
{
    gl_binary_key key = {{0x6d6e73, 0x70726f67}};
    char version[40];
    snprintf(version, sizeof version, "%d.%d.%d %d", MNS_VERSION_MAJOR, MNS_VERSION_MINOR, MNS_VERSION_PATCH,
             FORMAT);
    gl_binary_key_add(&key, version);
    gl_binary_key_add(&key, device->name);
    gl_binary_key_add(&key, device->vendor);
    return key;
}

/* ---- The driver ---- */

static bool is_driver_format(gl_device *device, uint32_t format)
{
    GLint count = 0, known[FORMATS_MOST];
    device->gl.GetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &count);
    if (count < 1 || count > FORMATS_MOST) return false;
    device->gl.GetIntegerv(GL_PROGRAM_BINARY_FORMATS, known);
    for (GLint i = 0; i < count; i++)
        if ((uint32_t)known[i] == format) return true;
    return false;
}

void gl_binaries_open(gl_device *device, gl_binaries *binaries, const char *folder)
{
    GLint count = 0;
    size_t length = folder ? strlen(folder) : 0;
    *binaries->folder = '\0';
    device->gl.GetIntegerv(GL_NUM_PROGRAM_BINARY_FORMATS, &count);
    if (count < 1 || count > FORMATS_MOST || length >= sizeof binaries->folder) return;
    if (length) memcpy(binaries->folder, folder, length);
}

/* ---- Taking ---- */

/* The bytes behind a header that fits, for the caller to free; NULL: there are none. */
static void *read_bytes(FILE *file, const gl_binary_key *key, binary_header *header)
{
    struct stat about;
    if (fstat(fileno(file), &about) || about.st_size <= (off_t)sizeof *header ||
        (uint64_t)about.st_size > CACHE_BYTES || fread(header, sizeof *header, 1, file) != 1)
        return NULL;
    size_t size = (size_t)about.st_size - sizeof *header;
    if (header->magic != MAGIC || header->format != FORMAT || header->size != size ||
        memcmp(&header->key, key, sizeof *key) != 0)
        return NULL;
    void *bytes = malloc(size);
    if (bytes && fread(bytes, 1, size, file) == size && store_sum(0, bytes, size) == header->sum)
        return bytes;
    free(bytes);
    return NULL;
}

bool gl_binary_take(gl_device *device, gl_binaries *binaries, const gl_binary_key *key, GLuint program)
{
    char name[NAME_SIZE];
    binary_header header;
    if (!*binaries->folder) return false;
    name_of(key, name);
    FILE *file = store_open(binaries->folder, name, ending);
    if (!file) return false;
    void *bytes = read_bytes(file, key, &header);
    GLint good = GL_FALSE;
    if (bytes && is_driver_format(device, header.driver_format)) {
        device->gl.ProgramBinary(program, header.driver_format, bytes, (GLsizei)header.size);
        device->gl.GetProgramiv(program, GL_LINK_STATUS, &good);
        while (!good && device->gl.GetError() != GL_NO_ERROR) {}
    }
    free(bytes);
    store_close(file, binaries->folder, name, ending, good);
    binaries->taken += good != GL_FALSE;
    return good;
}

/* ---- Leaving ---- */

void gl_binary_ask(gl_device *device, const gl_binaries *binaries, GLuint program)
{
    if (*binaries->folder) device->gl.ProgramParameteri(program, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE);
}

void gl_binary_leave(gl_device *device, const gl_binaries *binaries, const gl_binary_key *key, GLuint program)
{
    GLint length = 0;
    GLsizei got = 0;
    GLenum format = 0;
    if (!*binaries->folder) return;
    device->gl.GetProgramiv(program, GL_PROGRAM_BINARY_LENGTH, &length);
    void *bytes = length > 0 ? malloc((size_t)length) : NULL;
    if (!bytes) return;
    device->gl.GetProgramBinary(program, length, &got, &format, bytes);
    binary_header header = {.magic = MAGIC, .format = FORMAT, .driver_format = format, .key = *key};
    char name[NAME_SIZE];
    if (got > 0 && got <= length) {
        header.size = (uint64_t)got;
        header.sum = store_sum(0, bytes, (size_t)got);
        const store_part part[] = {{&header, sizeof header}, {bytes, (size_t)got}};
        name_of(key, name);
        /* What cannot be kept is compiled again the next time. */
        (void)store_write(binaries->folder, name, ending, part, 2, CACHE_BYTES);
    }
    while (device->gl.GetError() != GL_NO_ERROR) {}
    free(bytes);
}
