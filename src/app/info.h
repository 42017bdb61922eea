/* meniscus info. */
#ifndef MNS_APP_INFO_H
#define MNS_APP_INFO_H

#include "meniscus.h"

#include <jansson.h>

/* What an input holds, as the object of --json: a new reference, NULL where memory ends. */
json_t *info_json(const mns_field *field, size_t frame, size_t frames);

/* The same for people, a line a thing. */
void info_print(const mns_field *field, size_t frame, size_t frames);

#endif
