/* What the targets of the readers share: any bytes as a file of one format are read or refused in one line.
 */
#ifndef MNS_FUZZ_READER_H
#define MNS_FUZZ_READER_H

#include <string.h>

#include "load/format.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static inline int fuzz_format(const char *name, const uint8_t *data, size_t size)
{
    mns_error error = {0};
    const load_format *format = format_by_name(name);
    if (format_try(format, data, size, &error) && (!error.text[0] || strchr(error.text, '\n')))
        __builtin_trap();
    return 0;
}

#endif
