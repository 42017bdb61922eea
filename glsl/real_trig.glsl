// Sine and cosine in doubles, which GLSL does not have: to a few units in the last place, for small multiples of a turn.

// The angle less the nearest quarter turn, and which that is.
double trig_reduce(double x, out int quarter)
{
    double turns = floor(x * 0.636619772367581343LF + 0.5LF);
    quarter = int(turns) & 3;
    return (x - turns * 1.57079632679489656LF) - turns * 6.12323399573676604e-17LF;
}

// Taylor's sums, within an eighth of a turn.
double trig_sine(double x)
{
    double y = x * x;
    double sum = 2.81145725434552076e-15LF;
    sum = sum * y - 7.64716373181981648e-13LF;
    sum = sum * y + 1.60590438368216146e-10LF;
    sum = sum * y - 2.50521083854417188e-8LF;
    sum = sum * y + 2.75573192239858907e-6LF;
    sum = sum * y - 1.98412698412698413e-4LF;
    sum = sum * y + 8.33333333333333333e-3LF;
    sum = sum * y - 1.66666666666666667e-1LF;
    return x + x * y * sum;
}

double trig_cosine(double x)
{
    double y = x * x;
    double sum = -1.56192069685862265e-16LF;
    sum = sum * y + 4.77947733238738530e-14LF;
    sum = sum * y - 1.14707455977297247e-11LF;
    sum = sum * y + 2.08767569878680990e-9LF;
    sum = sum * y - 2.75573192239858907e-7LF;
    sum = sum * y + 2.48015873015873016e-5LF;
    sum = sum * y - 1.38888888888888889e-3LF;
    sum = sum * y + 4.16666666666666667e-2LF;
    return 1.0LF - 0.5LF * y + y * y * sum;
}

double real_sine(double x)
{
    int quarter;
    double rest = trig_reduce(x, quarter);
    double part = (quarter & 1) == 0 ? trig_sine(rest) : trig_cosine(rest);
    return quarter < 2 ? part : -part;
}

double real_cosine(double x)
{
    return real_sine(x + 1.57079632679489656LF);
}
