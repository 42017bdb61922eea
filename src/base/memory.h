/* Allocation by checked counts: a product that overflows is a failed allocation, never a small one. */
#ifndef MNS_BASE_MEMORY_H
#define MNS_BASE_MEMORY_H

#include <stdint.h>
#include <stdlib.h>

/* `count` elements of `size` bytes, uninitialised; NULL on failure or overflow. count 0 gives a unique
 * pointer. */
static inline void *memory_array(size_t count, size_t size)
{
    if (size && count > SIZE_MAX / size) return NULL;
    size_t bytes = count * size;
    return malloc(bytes ? bytes : 1);
}

/* Enlarges `block` to `count` elements; NULL leaves the old block valid. */
static inline void *memory_resize(void *block, size_t count, size_t size)
{
    if (size && count > SIZE_MAX / size) return NULL;
    size_t bytes = count * size;
    return realloc(block, bytes ? bytes : 1);
}

#endif
