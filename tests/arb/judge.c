#include "judge.h"

#include <math.h>
#include <stdio.h>

/* What counts as near, in units of truth_gap: the design's tau for doubles. */
static const double NEAR = 0x1p-40;

static mns_status trace(const rays_case *c, mns_hit *hit, mns_error *error)
{
    mns_field *field = NULL;
    mns_reference *reference = NULL;
    double position[3 * RAYS_BALLS];
    for (size_t i = 0; i < c->scene.count; i++)
        for (int a = 0; a < 3; a++) position[3 * i + (size_t)a] = c->axis[a][i];
    mns_field_desc desc = {.count = c->scene.count,
                           .position = {.data = position},
                           .radius = {.data = c->radius},
                           .strength = {.data = c->strength},
                           .kernel = c->scene.kernel,
                           .iso = c->scene.iso};
    mns_status status = mns_field_create(&desc, &field, error);
    if (!status) status = mns_reference_create(field, &reference, error);
    if (!status) status = mns_reference_trace(reference, c->ray.origin, c->ray.direction, hit, error);
    mns_reference_destroy(reference);
    mns_field_destroy(field);
    return status;
}

/* The outward normal, where the gradient is steep enough to have one in doubles. */
static bool normal_fits(const rays_case *c, const judgement *j)
{
    double x[3], gradient[3], length = 0, steep = 0, along = 0;
    for (int a = 0; a < 3; a++) length += c->ray.direction[a] * c->ray.direction[a];
    for (int a = 0; a < 3; a++) x[a] = c->ray.origin[a] + j->truth.t * c->ray.direction[a] / sqrt(length);
    truth_value(&c->scene, x, gradient);
    for (int a = 0; a < 3; a++) steep += gradient[a] * gradient[a], along -= gradient[a] * j->hit.normal[a];
    steep = sqrt(steep);
    double bend = 0, far = 0; /* how f'' and the rounding of places could turn it */
    for (size_t i = 0; i < c->scene.count; i++)
        bend += fabs(c->strength[i]) * 20 / (c->radius[i] * c->radius[i]);
    for (int a = 0; a < 3; a++) far = fmax(far, fabs(x[a]) + fabs(c->ray.origin[a]));
    double doubt = bend * (j->hit.t_error + 0x1p-48 * far);
    return doubt > 1e-5 * steep || along > (1 - 1e-8) * steep;
}

static bool certain_fits(const rays_case *c, const judgement *j)
{
    if (j->truth.kind == TRUTH_MISS) return !j->hit.hit && isinf(j->hit.t) && j->hit.t > 0;
    return j->truth.kind == TRUTH_HIT && j->hit.hit && j->distance <= j->hit.t_error && normal_fits(c, j);
}

judgement judge_ray(const rays_case *c)
{
    judgement j = {.gap = 1};
    mns_error error = {0};
    j.truth = truth_trace(&c->scene, &c->ray);
    if (trace(c, &j.hit, &error)) {
        fprintf(stderr, "%s\n", error.text);
        j.verdict = JUDGE_WRONG;
        return j;
    }
    if (j.truth.kind == TRUTH_HIT && j.hit.hit) j.distance = truth_distance(&j.truth, j.hit.t);
    if (j.truth.kind == TRUTH_UNTOLD)
        j.verdict = JUDGE_UNTOLD;
    else if (j.hit.certain)
        j.verdict = certain_fits(c, &j) ? JUDGE_RIGHT : JUDGE_WRONG;
    else {
        j.gap = j.truth.kind == TRUTH_TOUCH ? 0 : truth_gap(&c->scene, &c->ray, &j.truth);
        j.verdict = j.gap <= NEAR ? JUDGE_UNDECIDED : JUDGE_NEEDLESS;
    }
    return j;
}

void judge_print(const rays_case *c, const judgement *j)
{
    static const char *const verdicts[] = {"right", "undecided", "undecided without need", "wrong", "untold"};
    static const char *const kinds[] = {"miss", "hit", "touch", "untold"};
    fprintf(stderr,
            "%s: the truth is a %s, t %a + %a; the tracer says %s%s, t %a within %a; distance %g, gap %g\n",
            verdicts[j->verdict], kinds[j->truth.kind], j->truth.t, j->truth.t_rest,
            j->hit.certain ? "" : "perhaps ", j->hit.hit ? "hit" : "miss", j->hit.t, j->hit.t_error,
            j->distance, j->gap);
    fprintf(stderr, "kernel %s, L %a, origin %a %a %a, direction %a %a %a\n",
            mns_kernel_name(c->scene.kernel), c->scene.iso, c->ray.origin[0], c->ray.origin[1],
            c->ray.origin[2], c->ray.direction[0], c->ray.direction[1], c->ray.direction[2]);
    for (size_t i = 0; i < c->scene.count; i++)
        fprintf(stderr, "  {%a, %a, %a, %a, %a}\n", c->axis[0][i], c->axis[1][i], c->axis[2][i], c->radius[i],
                c->strength[i]);
}
