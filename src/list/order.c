#include "list/order.h"

#include "base/memory.h"
#include "base/status.h"

#include <omp.h>
#include <string.h>

/* What culling needs of the view, once a frame. */
typedef struct cull {
    view_frame frame;
    vec3 origin;
    double plane_depth;
    double tan_x, tan_y;   /* of the half angles, a pixel wider than the frame: samples are jittered */
    double side_x, side_y; /* length of the side planes' normals */
    double pixels;         /* a unit across at depth 1 */
    double most_point;     /* largest diameter of a point in pixels */
} cull;

static cull cull_make(const mns_plan *plan)
{
    cull c = {.frame = plan->frame, .origin = vec3_load(plan->origin), .plane_depth = plan->plane_depth};
    const view_frame *f = &plan->frame;
    c.tan_y = f->tan_half * (1 + 2.0 / f->height);
    c.tan_x = f->tan_half * (f->width + 2.0) / f->height;
    c.side_x = sqrt(1 + c.tan_x * c.tan_x);
    c.side_y = sqrt(1 + c.tan_y * c.tan_y);
    c.pixels = f->height / (2 * f->tan_half);
    c.most_point = plan->features & FEATURE_POINTS ? plan->limits.max_point_size - 1 : 0;
    if (plan->features & FEATURE_TILES) c.most_point = INFINITY; /* nobody draws billboards */
    return c;
}

/* A float's bits in an order that unsigned integers share. */
static uint32_t sortable(float value)
{
    uint32_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits & 0x80000000u ? ~bits : bits | 0x80000000u;
}

/* Whether the ball can touch the view; if so *key is its effective distance, and *point whether a point can
 * hold it. */
static bool cull_ball(const cull *c, vec3 at, double radius, uint32_t *key, bool *point)
{
    vec3 d = vec3_sub(at, c->frame.eye);
    double x = fabs(vec3_dot(d, c->frame.right)), y = fabs(vec3_dot(d, c->frame.up));
    double z = vec3_dot(d, c->frame.forward);
    double cover = radius * (1 + 1e-6);
    if (z <= -cover || x - z * c->tan_x > cover * c->side_x || y - z * c->tan_y > cover * c->side_y)
        return false;
    double away = vec3_length(d), square = (z - radius) * (z + radius), widest = x > y ? x : y;
    /* Diameter of the projection: between the tangents from the eye. */
    *point = c->most_point == INFINITY ||
             (z > 1.01 * radius &&
              2.001 * c->pixels * radius * sqrt(widest * widest + square) < square * c->most_point);
    double far_part = c->plane_depth > 0 ? away - c->plane_depth : away;
    *key = sortable((float)(far_part - radius));
    return true;
}

/* Each thread culls its stretch to the place where the stretch begins; then the gaps are closed in order. */
static size_t cull_all(list_order *order, const mns_field *field, const cull *c, uint32_t *past_large)
{
    size_t kept[64], begin[64], parts = 1, total = field->p.count;
    uint32_t large = 0; /* farthest key of a ball that is no point, plus one */
    float most = 0;
    const double *x = field->p.axis[0], *y = field->p.axis[1], *z = field->p.axis[2];
    int threads = omp_get_max_threads() > 64 ? 64 : omp_get_max_threads();
#pragma omp parallel num_threads(threads) reduction(max : large, most) if (total > ORDER_ALONE)
    {
        size_t self = (size_t)omp_get_thread_num(), all = (size_t)omp_get_num_threads();
        size_t first = total * self / all, past = total * (self + 1) / all, n = first;
        for (size_t i = first; i < past; i++) {
            uint32_t key;
            bool point;
            vec3 at = {x[i], y[i], z[i]};
            if (!cull_ball(c, at, field_radius(field, i), &key, &point)) continue;
            if (!point && key >= large) large = key + 1;
            vec3 from = vec3_sub(at, c->origin);
            order->ball[n] = (list_ball){{(float)from.x, (float)from.y, (float)from.z}, (uint32_t)i};
            const float *p = order->ball[n].position;
            float size = fabsf(p[0]) + fabsf(p[1]) + fabsf(p[2]);
            if (size > most) most = size;
            order->key[n++] = (uint64_t)key << 32;
        }
        begin[self] = first;
        kept[self] = n - first;
#pragma omp single nowait
        parts = all;
    }
    size_t count = 0;
    for (size_t part = 0; part < parts; part++) {
        memmove(order->ball + count, order->ball + begin[part], kept[part] * sizeof *order->ball);
        memmove(order->key + count, order->key + begin[part], kept[part] * sizeof *order->key);
        count += kept[part];
    }
    *past_large = large;
    order->size = most;
    return count;
}

static mns_status reserve(list_order *order, size_t count, mns_error *error)
{
    if (order->capacity >= count && order->ball) return MNS_OK;
    list_order_free(order);
    order->ball = memory_array(count, sizeof *order->ball);
    order->key = memory_array(count, sizeof *order->key);
    order->scratch = memory_array(count, sizeof *order->scratch);
    order->digits = memory_array(RADIX_THREADS * RADIX_DIGITS, sizeof *order->digits);
    if (!order->ball || !order->key || !order->scratch || !order->digits) {
        list_order_free(order);
        return status_no_memory(error, "while sorting the balls");
    }
    order->capacity = count;
    return MNS_OK;
}

/* The places of the keys that reach past_large begin here. */
static size_t count_quads(const list_order *order, uint32_t past_large)
{
    size_t low = 0, high = order->count;
    while (low < high) {
        size_t middle = (low + high) / 2;
        if (order->key[middle] >> 32 >= past_large)
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

mns_status list_order_make(list_order *order, const mns_field *field, const mns_plan *plan, size_t near,
                           mns_error *error)
{
    mns_status status = reserve(order, field->p.count, error);
    if (status) return status;
    cull c = cull_make(plan);
    uint32_t past_large;
    order->count = order->in_view = cull_all(order, field, &c, &past_large);
    for (size_t i = 0; i < order->count; i++) order->key[i] |= (uint32_t)i;
    order->sorted = near < order->count ? list_part_near(order, near) : order->count;
    list_radix_sort(order->key, order->scratch, order->digits, order->sorted);
    order->quads = order->sorted == order->count ? count_quads(order, past_large) : 0;
    return MNS_OK;
}

void list_order_finish(list_order *order)
{
    list_radix_sort(order->key + order->sorted, order->scratch, order->digits, order->count - order->sorted);
    order->sorted = order->count;
}

void list_order_free(list_order *order)
{
    free(order->ball);
    free(order->key);
    free(order->scratch);
    free(order->digits);
    *order = (list_order){0};
}
