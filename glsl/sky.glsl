// The built-in sky: one text for GLSL and C, over REAL, NUM, DENSITY_FN and max as samples.glsl. A clear day, by hand: blue above,
// pale at the horizon, a hazy ground, and a glow about (1, 2, 1.5), where a directional light stands unless it is told otherwise.

DENSITY_FN REAL sky_of(int channel, REAL red, REAL green, REAL blue)
{
    return channel == 0 ? red : channel == 1 ? green : blue;
}

// Linear light of channel 0 to 2 in the unit direction (x, y, z), y being up.
DENSITY_FN REAL sky_color(int channel, REAL x, REAL y, REAL z)
{
    REAL horizon = sky_of(channel, NUM(0.75), NUM(0.84375), NUM(0.9375));
    REAL near = NUM(1.0) - max(y, -y);
    REAL haze = near * near;
    haze = haze * haze;
    if (y < NUM(0.0)) {
        REAL ground = sky_of(channel, NUM(0.21875), NUM(0.203125), NUM(0.1875));
        haze = haze * haze;
        return ground + (horizon - ground) * haze * haze;
    }
    REAL zenith = sky_of(channel, NUM(0.125), NUM(0.3125), NUM(0.6875));
    REAL glow = max(x + NUM(2.0) * y + NUM(1.5) * z, NUM(0.0)) / sqrt(NUM(7.25));
    for (int i = 0; i < 5; i++) glow = glow * glow;
    REAL disc = glow * glow;
    for (int i = 0; i < 3; i++) disc = disc * disc;
    REAL warm = sky_of(channel, NUM(1.0), NUM(0.9375), NUM(0.8125));
    return zenith + (horizon - zenith) * haze + warm * (NUM(0.375) * glow + NUM(6.0) * disc);
}
