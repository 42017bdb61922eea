#include "support/planes.h"

#include "compare/truth_cache.h"
#include "image/image.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

planes planes_make(int width, int height)
{
    planes p;
    mns_error error;
    size_t pixels = (size_t)width * (size_t)height;
    assert_int_equal(truth_allocate(width, height, true, true, &p.truth, &error), MNS_OK);
    assert_int_equal(image_create(width, height, &p.image, &error), MNS_OK);
    memset(p.truth->normal, 0, 3 * pixels * sizeof(double));
    memset(p.image->normal, 0, 3 * pixels * sizeof(float));
    for (size_t i = 0; i < pixels; i++) {
        p.truth->t[i] = INFINITY, p.truth->t_error[i] = 0, p.truth->radius[i] = 1, p.truth->certain[i] = 1;
        p.image->t[i] = INFINITY, p.image->t_lo[i] = 0, p.image->certain[i] = 1;
    }
    for (size_t i = 0; i < 4 * pixels; i++) p.truth->rgba[i] = p.image->rgba[i] = 1;
    return p;
}

void planes_free(planes *p)
{
    truth_destroy(p->truth);
    mns_image_destroy(p->image);
}

void planes_hit(planes *p, size_t index, double t, double off)
{
    p->truth->t[index] = t;
    p->image->t[index] = (float)(t + off);
    p->image->t_lo[index] = (float)(t + off - (double)(float)(t + off));
    p->truth->normal[3 * index + 2] = 1;
    p->image->normal[3 * index + 2] = 1;
}
