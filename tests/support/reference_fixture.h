/* For tests of the certified tracer: balls by hand, a field and a reference of them, rays. Every function
 * ends the running test when something fails. */
#ifndef MNS_TESTS_REFERENCE_FIXTURE_H
#define MNS_TESTS_REFERENCE_FIXTURE_H

#include "meniscus.h"

enum { FIXTURE_BALLS = 60 };

typedef struct fixture_numbers {
    uint64_t state;
} fixture_numbers;

/* The next of a sequence, in [0, 1). */
double fixture_random(fixture_numbers *r);

/* Balls as arrays, as a host has them. */
typedef struct fixture_balls {
    double position[FIXTURE_BALLS * 3], radius[FIXTURE_BALLS], strength[FIXTURE_BALLS];
    size_t count;
} fixture_balls;

void fixture_add(fixture_balls *b, double x, double y, double z, double radius, double strength);

/* Free by mns_field_destroy and mns_reference_destroy. */
mns_field *fixture_field(const fixture_balls *b, mns_kernel kernel, double iso);
mns_reference *fixture_reference(const mns_field *field);

mns_hit fixture_trace(const mns_reference *reference, const double from[3], const double direction[3]);
/* One ray through one field, made and destroyed. */
mns_hit fixture_trace_once(const fixture_balls *b, mns_kernel kernel, double iso, const double from[3],
                           const double direction[3]);

void fixture_expect_close(double a, double b, double tolerance);

#endif
