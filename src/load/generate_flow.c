/* Shapes that move over their frames: tornado, pool, drop. Balls fill each volume evenly, jittered by 0.3
 * spacings. */
#include "load/generate.h"

#include <math.h>

#define PI 3.14159265358979323846

static void jitter(const generate_frame *f, uint64_t index, double at[3])
{
    for (unsigned k = 0; k < 3; k++) at[k] += (generate_random(f, index, k) - 0.5) * 0.6 * f->spacing;
}

static void set_size(generate_frame *f, double overlap, double volume, double area)
{
    f->spacing = generate_cbrt(volume / f->count);
    f->radius = generate_radius(overlap, f->count, volume, area);
}

/* ---- tornado: a funnel of height 2 and radius sqrt(a + b h^3), h = y / 2, turning faster inside, its axis
 * swaying ---- */

static const double funnel_a = 0.0036, funnel_b = 0.2464;

static void prepare_tornado(generate_frame *f)
{
    double volume = 2 * PI * (funnel_a + funnel_b / 4);
    set_size(f, 14.2, volume, 4.1); /* its surface, walls and top; the ridges gather balls: 15 come out */
}

/* h below which the share u of the volume lies: a h + b h^4 / 4 = u (a + b / 4), by Newton's method from
 * above. */
static double funnel_height(double u)
{
    double goal = u * (funnel_a + funnel_b / 4), h = 1;
    for (int i = 0; i < 14; i++) {
        double cube = h * h * h;
        h -= (funnel_a * h + funnel_b / 4 * cube * h - goal) / (funnel_a + funnel_b * cube);
    }
    return h;
}

static void place_tornado(const generate_frame *f, uint64_t index, generate_ball *ball)
{
    double h = funnel_height(generate_even(f, index, 0)), share = sqrt(generate_even(f, index, 1));
    double rate = 0.6 / (0.2 + share); /* turns a second */
    double angle = generate_even(f, index, 2) + rate * f->time;
    double ridge =
        1 + 0.12 * generate_sine(2 * angle + 3 * h - 1.2 * f->time); /* two ridges wind up the wall */
    double r = sqrt(funnel_a + funnel_b * h * h * h) * share * ridge;
    double sway = 0.18 * h * (1 - 0.5 * h), phase = 0.8 * h - 0.35 * f->time;
    ball->at[0] = r * generate_cosine(angle) + sway * generate_sine(phase);
    ball->at[1] = 2 * h;
    ball->at[2] = r * generate_sine(angle) + sway * generate_cosine(phase);
    ball->extra = 2 * PI * r * rate;
    jitter(f, index, ball->at);
}

const generate_shape generate_tornado = {
    .name = "tornado", .column = "speed", .prepare = prepare_tornado, .place = place_tornado};

/* ---- Rings of waves around a point at distance r: amplitude A / (1 + (r / w)^2), wave length w, two waves a
 * second ---- */

static double rings(double r, double width, double amplitude, double time)
{
    double fall = 1 + (r / width) * (r / width);
    return amplitude / fall * generate_cosine(r / width - 2 * time);
}

/* ---- pool: 2 x 0.3 x 1, two trains of waves and the rings of a splash, every 64th ball a droplet of its
 * crown ---- */

static double pool_depth(const generate_frame *f, double x, double z)
{
    double dx = x - 1.2, dz = z - 0.5, t = f->time;
    return 0.3 + 0.025 * generate_sine(1.5 * x - 0.9 * t) +
           0.015 * generate_sine(0.8 * x + 1.7 * z + 1.1 * t) + rings(sqrt(dx * dx + dz * dz), 0.25, 0.06, t);
}

static void prepare_pool(generate_frame *f)
{
    /* Waves thin out what they lift, and droplets leave: 30 come out. */
    set_size(f, 33, 2 * 0.3 * 1, 2 * (2 * 1 + 2 * 0.3 + 0.3 * 1));
}

/* Thrown up and out from a ring about the splash, again and again: y = v s - 2 s^2 with s the time since the
 * throw. */
static void place_droplet(const generate_frame *f, uint64_t index, generate_ball *ball)
{
    double angle = generate_random(f, index, 4), speed = 0.9 + 0.5 * generate_random(f, index, 5);
    double life = speed / 2, phase = f->time / life + generate_random(f, index, 6);
    double s = (phase - floor(phase)) * life, out = 0.12 + 0.35 * s;
    ball->at[0] = 1.2 + out * generate_cosine(angle);
    ball->at[1] = 0.3 + speed * s - 2 * s * s;
    ball->at[2] = 0.5 + out * generate_sine(angle);
}

static void place_pool(const generate_frame *f, uint64_t index, generate_ball *ball)
{
    if (index % 64 == 63) {
        place_droplet(f, index, ball);
    } else {
        double x = 2 * generate_even(f, index, 0), z = generate_even(f, index, 2);
        ball->at[0] = x;
        ball->at[1] = generate_even(f, index, 1) * pool_depth(f, x, z);
        ball->at[2] = z;
        jitter(f, index, ball->at);
    }
    ball->extra = ball->at[1];
}

const generate_shape generate_pool = {
    .name = "pool", .column = "height", .prepare = prepare_pool, .place = place_pool};

/* ---- drop: a sphere of radius 0.14 falls 0.6 into a pool 1 x 0.25 x 1 and leaves rings ---- */

enum { DROP_SHARE = 24 }; /* one ball in so many belongs to the drop: as their volumes are */
static const double drop_radius = 0.14, drop_start = 0.99, drop_pool = 0.25, drop_gravity = 4;

static void prepare_drop(generate_frame *f)
{
    double sphere = 4.0 / 3 * PI * drop_radius * drop_radius * drop_radius;
    set_size(f, 30, drop_pool + sphere, 2 + 4 * drop_pool + 4 * PI * drop_radius * drop_radius);
}

/* Seconds since the drop touched the pool; negative before. */
static double drop_age(const generate_frame *f)
{
    return f->time - sqrt(2 * (drop_start - drop_radius - drop_pool) / drop_gravity);
}

static void place_falling(const generate_frame *f, uint64_t index, generate_ball *ball)
{
    double age = drop_age(f), flat = age > 0 ? 1 / (1 + 3 * age) : 1, wide = sqrt(1 / flat);
    double middle = drop_start - drop_gravity / 2 * f->time * f->time;
    double rest = drop_pool - drop_radius * flat; /* its top level with the pool */
    if (age > 0) middle = rest + (drop_radius + drop_radius * flat) / (1 + 40 * age * age);
    double r = drop_radius * generate_cbrt(generate_even(f, index, 0) + 1e-9);
    double up = 2 * generate_even(f, index, 1) - 1, side = sqrt(1 - up * up),
           angle = generate_even(f, index, 2);
    ball->at[0] = 0.5 + wide * r * side * generate_cosine(angle);
    ball->at[1] = middle + flat * r * up;
    ball->at[2] = 0.5 + wide * r * side * generate_sine(angle);
    ball->extra = 1;
}

static void place_drop(const generate_frame *f, uint64_t index, generate_ball *ball)
{
    if (index % DROP_SHARE == 0) {
        place_falling(f, index, ball);
    } else {
        double x = generate_even(f, index, 0), z = generate_even(f, index, 2), age = drop_age(f);
        double r = sqrt((x - 0.5) * (x - 0.5) + (z - 0.5) * (z - 0.5)),
               swell = age > 0 ? age / (0.1 + age * age) : 0;
        ball->at[0] = x;
        ball->at[1] = generate_even(f, index, 1) * (drop_pool + rings(r, 0.2, 0.04 * swell, age));
        ball->at[2] = z;
    }
    jitter(f, index, ball->at);
}

const generate_shape generate_drop = {
    .name = "drop", .column = "drop", .prepare = prepare_drop, .place = place_drop};
