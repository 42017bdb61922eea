// Light at the face between two clear media: one text for GLSL and C, over REAL, NUM and DENSITY_FN as density.glsl.
// cosine: of the angle between the ray and the normal, in [0, 1]; ratio: index of refraction beyond the face over that on this side.

// (ratio times the cosine beyond the face)^2, by Snell's law; 0 or less beyond the critical angle: total reflection.
DENSITY_FN REAL optics_beyond(REAL ratio, REAL cosine)
{
    return ratio * ratio - (NUM(1.0) - cosine * cosine);
}

// The share that is reflected of unpolarised light (Fresnel): the mean of both polarisations.
DENSITY_FN REAL optics_fresnel(REAL ratio, REAL cosine)
{
    REAL beyond = optics_beyond(ratio, cosine);
    if (beyond <= NUM(0.0)) return NUM(1.0);
    beyond = sqrt(beyond);
    REAL across = (cosine - beyond) / (cosine + beyond);
    REAL along = (ratio * ratio * cosine - beyond) / (ratio * ratio * cosine + beyond);
    return NUM(0.5) * (across * across + along * along);
}

// What of the normal n (towards the ray, n . way = -cosine) goes into the refracted ray, which is (way + bend n) / ratio.
DENSITY_FN REAL optics_bend(REAL ratio, REAL cosine)
{
    REAL beyond = optics_beyond(ratio, cosine);
    return cosine - (beyond > NUM(0.0) ? sqrt(beyond) : NUM(0.0)); // what decided that a ray goes through may have rounded otherwise
}

// A ray whose share of the pixel is below this, in every channel, is not worth its cost: it sees the environment.
DENSITY_FN REAL optics_least_share(void)
{
    return NUM(0.0009765625);
}
