/* The machine that figures were taken on. */
#ifndef MNS_COMPARE_MACHINE_H
#define MNS_COMPARE_MACHINE_H

#include <jansson.h>

/* {"cpu", "cores", "memory_bytes", "system"}, null where the system does not tell: a new reference. */
json_t *machine_describe(void);

#endif
