#include "compare/page.h"

#include "base/status.h"
#include "compare/metrics.h"
#include "compare/page_text.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* In a script element the parser looks for "</script" and "<!--"; in JSON a '<' stands in strings alone,
 * where it may be written as an escape. Non-ASCII text is escaped by jansson. The digits are those of
 * results.json. */
#define JSON_FLAGS (JSON_COMPACT | JSON_ENSURE_ASCII | JSON_ENCODE_ANY | JSON_REAL_PRECISION(9))

typedef struct page_writer {
    FILE *file;
    const json_t *results;
    const page_picture *picture;
    size_t count;
} page_writer;

/* jansson's callback: 0, or -1 where the file takes no more. */
static int write_safely(const char *text, size_t size, void *context)
{
    FILE *file = context;
    for (size_t i = 0; i < size; i++)
        if ((text[i] == '<' ? fputs("\\u003c", file) : fputc((unsigned char)text[i], file)) == EOF) return -1;
    return 0;
}

static bool write_json(FILE *file, const json_t *value)
{
    return value && !json_dump_callback(value, write_safely, file, JSON_FLAGS);
}

/* A name from outside; what is not UTF-8 in it becomes '?'. */
static bool write_name(FILE *file, const char *name)
{
    json_t *value = json_string(name);
    if (!value) {
        char plain[256];
        size_t length = 0;
        for (; name[length] && length < sizeof plain - 1; length++)
            plain[length] = (unsigned char)name[length] < 0x80 ? name[length] : '?';
        plain[length] = 0;
        value = json_string(plain);
    }
    bool written = write_json(file, value);
    json_decref(value);
    return written;
}

static void write_base64(FILE *file, const unsigned char *byte, size_t size)
{
    static const char digit[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (size_t i = 0; i < size; i += 3) {
        size_t left = size - i;
        unsigned bits = (unsigned)byte[i] << 16;
        if (left > 1) bits |= (unsigned)byte[i + 1] << 8;
        if (left > 2) bits |= byte[i + 2];
        char four[4] = {digit[bits >> 18], digit[bits >> 12 & 63], left > 1 ? digit[bits >> 6 & 63] : '=',
                        left > 2 ? digit[bits & 63] : '='};
        fwrite(four, 1, sizeof four, file);
    }
}

/* {"depth_range": x, "mask_colors": ["#rrggbb", ...], "list": [{"run", "kind", "png"}, ...]} */
static bool write_pictures(const page_writer *page)
{
    FILE *file = page->file;
    json_t *range = json_real(PICTURES_DEPTH_RANGE);
    fputs("{\"depth_range\":", file);
    bool written = write_json(file, range);
    json_decref(range);
    fputs(",\"mask_colors\":[", file);
    for (int i = 0; i < METRICS_MASK_COUNT; i++)
        fprintf(file, "%s\"%s\"", i ? "," : "", PICTURES_MASK_COLOR[i]);
    fputs("],\"list\":[", file);
    for (size_t i = 0; i < page->count && written; i++) {
        fputs(i ? ",{\"run\":" : "{\"run\":", file);
        written = write_name(file, page->picture[i].run);
        fputs(",\"kind\":", file);
        written = written && write_name(file, page->picture[i].kind);
        fputs(",\"png\":\"", file);
        write_base64(file, page->picture[i].png, page->picture[i].size);
        fputs("\"}", file);
    }
    fputs("]}", file);
    return written;
}

static const page_text *find_text(const char *name, size_t length)
{
    for (const page_text *text = page_texts; text->name; text++)
        if (strlen(text->name) == length && !strncmp(text->name, name, length)) return text;
    return NULL;
}

/* Writes what the template's {{name}} stands for. False: out of memory, or the file takes no more. */
static bool write_part(const page_writer *page, const char *name, size_t length)
{
    if (length == strlen("results") && !strncmp(name, "results", length))
        return write_json(page->file, page->results);
    if (length == strlen("pictures") && !strncmp(name, "pictures", length)) return write_pictures(page);
    const page_text *text = find_text(name, length);
    return text && fwrite(text->text, 1, text->size, page->file) == text->size;
}

static bool write_page(const page_writer *page)
{
    const page_text *template = find_text("page.html", strlen("page.html"));
    const char *at = template->text, *end = at + template->size;
    while (at < end) {
        const char *open = strstr(at, "{{"), *close = open ? strstr(open, "}}") : NULL;
        size_t plain = (size_t)((close ? open : end) - at);
        if (fwrite(at, 1, plain, page->file) != plain) return false;
        if (!close) break;
        if (!write_part(page, open + 2, (size_t)(close - open - 2))) return false;
        at = close + 2;
    }
    return true;
}

static mns_status fail_write(const char *path, int code, mns_error *error)
{
    char reason[128]; /* the GNU variant: strerror is not safe among threads */
    return status_fail(error, MNS_ERROR_IO, "%s: cannot write: %s", path,
                       strerror_r(code, reason, sizeof reason));
}

mns_status page_write(const json_t *results, const page_picture *pictures, size_t count, const char *path,
                      mns_error *error)
{
    page_writer page = {fopen(path, "wb"), results, pictures, count};
    if (!page.file) return fail_write(path, errno, error);
    errno = 0;
    bool whole = write_page(&page), failed = ferror(page.file) != 0;
    failed |= fclose(page.file) != 0; /* a full disk may show only here */
    if (whole && !failed) return MNS_OK;
    int code = errno;
    unlink(path);
    return failed ? fail_write(path, code ? code : EIO, error) : status_no_memory(error, "writing a page");
}
