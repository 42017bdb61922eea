#include "support/reference_fixture.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

double fixture_random(fixture_numbers *r) /* Marsaglia's xorshift */
{
    r->state ^= r->state << 13;
    r->state ^= r->state >> 7;
    r->state ^= r->state << 17;
    return (double)(r->state >> 11) * 0x1p-53;
}

void fixture_add(fixture_balls *b, double x, double y, double z, double radius, double strength)
{
    double *p = b->position + 3 * b->count;
    p[0] = x, p[1] = y, p[2] = z;
    b->radius[b->count] = radius;
    b->strength[b->count++] = strength;
}

mns_field *fixture_field(const fixture_balls *b, mns_kernel kernel, double iso)
{
    mns_error error;
    mns_field *field = NULL;
    mns_field_desc desc = {.count = b->count,
                           .position = {.data = b->position},
                           .radius = {.data = b->radius},
                           .strength = {.data = b->strength},
                           .kernel = kernel,
                           .iso = iso};
    if (mns_field_create(&desc, &field, &error)) fail_msg("%s", error.text);
    return field;
}

mns_reference *fixture_reference(const mns_field *field)
{
    mns_error error;
    mns_reference *reference = NULL;
    if (mns_reference_create(field, &reference, &error)) fail_msg("%s", error.text);
    return reference;
}

mns_hit fixture_trace(const mns_reference *reference, const double from[3], const double direction[3])
{
    mns_error error;
    mns_hit hit;
    if (mns_reference_trace(reference, from, direction, &hit, &error)) fail_msg("%s", error.text);
    return hit;
}

mns_hit fixture_trace_once(const fixture_balls *b, mns_kernel kernel, double iso, const double from[3],
                           const double direction[3])
{
    mns_field *field = fixture_field(b, kernel, iso);
    mns_reference *reference = fixture_reference(field);
    mns_hit hit = fixture_trace(reference, from, direction);
    mns_reference_destroy(reference);
    mns_field_destroy(field);
    return hit;
}

void fixture_expect_close(double a, double b, double tolerance)
{
    if (!(fabs(a - b) <= tolerance)) fail_msg("%.17g is not %.17g within %.3g", a, b, tolerance);
}
