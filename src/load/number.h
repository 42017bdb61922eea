/* Numbers out of text, correctly rounded, whatever the host's locale. */
#ifndef MNS_LOAD_NUMBER_H
#define MNS_LOAD_NUMBER_H

#include "load/stream.h"

/* Scans a decimal number (sign, digits, point, exponent) at *at and moves *at past it. False, with *at as it
 * was, where there is none; "nan", "inf" and hexadecimals are none. A number too large for a double gives an
 * infinity. */
bool number_scan(const char **at, const char *end, double *value);

/* The whole text as a finite number, or as a count; white space around it is allowed. */
bool number_whole(load_text text, double *value);
bool number_count(load_text text, uint64_t *value);

/* Whether the text spells nan or an infinity, which a message should say. */
bool number_is_special(load_text text);

#endif
