/* The unit of a field's lengths: where floats could not square them, they are kept over a power of two, and
 * given back in scene units at the library's face. */
#include "base/status.h"
#include "field/field.h"

#include <math.h>

/* Between these nothing is gained by another unit, and bits stay what they were. */
#define LEAST 0x1p-40
#define MOST  0x1p30

/* What doubles can square, and the products of squares again. */
#define DOUBLES_LEAST 1e-60
#define DOUBLES_MOST  1e60

mns_status field_choose_unit(double radius_min, double extent, double farthest, double *unit,
                             mns_error *error)
{
    bool plain = radius_min >= LEAST && extent <= MOST;
    double chosen = plain ? 1 : ldexp(1, (ilogb(radius_min) + ilogb(extent)) / 2);
    if (!(radius_min / chosen >= DOUBLES_LEAST && fmax(extent, farthest) / chosen <= DOUBLES_MOST))
        return status_fail(error, MNS_ERROR_UNSUPPORTED,
                           "radii from %g and lengths to %g: too far apart for doubles to square both; move "
                           "the field to 0, or split it",
                           radius_min, fmax(extent, farthest));
    *unit = chosen;
    return MNS_OK;
}

void field_enter_unit(mns_field *f)
{
    double unit = field_unit(f);
    if (unit == 1) return;
    for (int k = 0; k < 3; k++)
        for (size_t i = 0; i < f->p.count; i++) f->p.axis[k][i] /= unit;
    for (size_t i = 0; f->p.radius && i < f->p.count; i++) f->p.radius[i] /= unit;
    f->uniform_radius /= unit;
    f->radius_min /= unit;
    f->radius_median /= unit;
    f->radius_max /= unit;
}
