// Where the samples of shadows and occlusion lie: one text for GLSL and C, so that both draw the same rays.
//
// The includer defines REAL, NUM(x) and DENSITY_FN as for density.glsl, UINT (an unsigned integer of 32 bits), and max.
// Points of the unit square are those of the sequence R2 (Roberts 2018: steps of 1/g and 1/g^2, g^3 = g + 1, in whole numbers, so
// that no machine rounds them), shifted by a hash of what they are for. So any stretch of the indices is spread evenly: the samples
// beside the pixel's centre go on where the one before stopped.

// Every bit of x stirs every bit of the result. Constants: C. Wellons 2018, "lowbias32".
DENSITY_FN UINT samples_stir(UINT x)
{
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

// The sequence's name: pixel (x, y) from the top left, the seed, the surface on the way of the path (1 the first; the one that a
// mirrored ray meets 2 n, a refracted 2 n + 1), and what for: 0 occlusion, 1 + l the shadow of light l.
DENSITY_FN UINT samples_key(UINT x, UINT y, UINT seed, UINT path, UINT purpose)
{
    UINT key = samples_stir(seed + 0x9e3779b9u);
    key = samples_stir(key ^ x);
    key = samples_stir(key + y);
    key = samples_stir(key ^ path);
    return samples_stir(key + purpose);
}

// Coordinate 0 or 1 of point `index`, in [0, 1), with 24 bits: a float holds it as it is.
DENSITY_FN REAL samples_number(UINT key, UINT index, int axis)
{
    UINT place = axis == 0 ? key + index * 0xc13fa9a9u : samples_stir(key ^ 0x55555555u) + index * 0x91e10da5u;
    return NUM(place >> 8) * NUM(5.9604644775390625e-8);
}

// Coordinate `axis` of a direction about +z whose density goes with its cosine: a point of the unit disc, lifted (Malley).
DENSITY_FN REAL samples_hemisphere(int axis, REAL u, REAL v)
{
    REAL around = NUM(6.283185482025146484375) * v;
    REAL aside = sqrt(u);
    if (axis == 0) return aside * cos(around);
    if (axis == 1) return aside * sin(around);
    return sqrt(NUM(1.0) - u);
}

// Coordinate `axis` of a direction in a cone about +z, evenly by solid angle; width: 1 less the cosine of the cone's half angle.
DENSITY_FN REAL samples_cone(int axis, REAL width, REAL u, REAL v)
{
    REAL around = NUM(6.283185482025146484375) * v;
    REAL drop = u * width;
    REAL aside = sqrt(drop * (NUM(2.0) - drop));
    if (axis == 0) return aside * cos(around);
    if (axis == 1) return aside * sin(around);
    return NUM(1.0) - drop;
}

// The width of the cone in which a sphere is seen whose radius over its distance is ratio < 1.
DENSITY_FN REAL samples_cone_width(REAL ratio)
{
    REAL square = ratio * ratio;
    return square / (NUM(1.0) + sqrt(NUM(1.0) - square));
}

// Over the distance of its middle, how far a sphere so seen is in the direction that is `drop` below the axis' cosine, 1.
DENSITY_FN REAL samples_sphere_distance(REAL ratio, REAL drop)
{
    REAL aside = drop * (NUM(2.0) - drop);
    return NUM(1.0) - drop - sqrt(max(ratio * ratio - aside, NUM(0.0)));
}

// Coordinate `axis` of the direction (x, y, z) about +z when +z is turned to the unit vector n. Based on: Duff et al. 2017,
// "Building an orthonormal basis, revisited".
DENSITY_FN REAL samples_turned(int axis, REAL nx, REAL ny, REAL nz, REAL x, REAL y, REAL z)
{
    REAL side = nz < NUM(0.0) ? NUM(-1.0) : NUM(1.0);
    REAL a = NUM(-1.0) / (side + nz);
    REAL b = nx * ny * a;
    if (axis == 0) return x * (NUM(1.0) + side * nx * nx * a) + y * b + z * nx;
    if (axis == 1) return x * side * b + y * (side + ny * ny * a) + z * ny;
    return z * nz - x * side * nx - y * ny;
}
