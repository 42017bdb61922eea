/* Digits are gathered into 64 bits; where they and the power of ten fit, one exactly rounded operation ends
 * it, first in doubles (D. Gay's fast path), then in 128-bit integers; what is left (more than 19 digits, far
 * exponents) goes to the C library in the "C" locale. */
#include "load/number.h"

#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

__extension__ typedef unsigned __int128 wide;

typedef struct decimal {
    uint64_t digits;
    int kept;      /* digits in it, at most 19 */
    long exponent; /* value = digits 10^exponent */
    bool is_cut;   /* a digit that is not zero was left out */
} decimal;

enum { LARGEST_EXACT = 27 }; /* 5^27 < 2^63 */

static void take_digit(decimal *d, int digit, bool is_fraction)
{
    if (d->kept < 19) {
        d->digits = d->digits * 10 + (unsigned)digit;
        d->kept += d->digits != 0;
        d->exponent -= is_fraction;
    } else {
        d->is_cut |= digit != 0;
        d->exponent += !is_fraction;
    }
}

/* value 2^power to 53 bits, ties to even; `sticky`: the true value lies a little above. Stays in the normal
 * range. */
static double round_wide(wide value, bool sticky, int power)
{
    uint64_t high = (uint64_t)(value >> 64), low = (uint64_t)value;
    int bits = high ? 128 - __builtin_clzll(high) : 64 - __builtin_clzll(low);
    int shift = bits - 53;
    if (shift <= 0) return ldexp((double)low, power); /* only where nothing is cut: sticky is false */
    uint64_t kept = (uint64_t)(value >> shift);
    wide rest = value & (((wide)1 << shift) - 1), half = (wide)1 << (shift - 1);
    if (rest > half || (rest == half && (sticky || (kept & 1)))) kept++;
    return ldexp((double)kept, shift + power);
}

static double exact_wide(uint64_t digits, long exponent)
{
    static const uint64_t five_8 = 390625, eights[] = {1, five_8, five_8 * five_8, five_8 * five_8 * five_8};
    uint64_t power = (uint64_t)(exponent < 0 ? -exponent : exponent), five = eights[power / 8];
    for (power %= 8; power > 0; power--) five *= 5;
    if (exponent >= 0) return round_wide((wide)digits * five, false, (int)exponent);
    int lead = __builtin_clzll(digits);
    wide numerator = (wide)(digits << lead) << 64; /* over 5^27 this still has more than 64 bits */
    wide quotient = numerator / five;
    return round_wide(quotient, quotient * five != numerator, (int)exponent - 64 - lead);
}

/* The library's own conversion of a text that is known to be a number. */
static double slow_number(const char *at, const char *end)
{
    char near[128];
    size_t length = (size_t)(end - at);
    char *copy = length < sizeof near ? near : malloc(length + 1);
    locale_t c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    double value = NAN; /* no memory: refused as a number that is not finite */
    if (copy && c_locale) {
        memcpy(copy, at, length);
        copy[length] = 0;
        value = strtod_l(copy, NULL, c_locale);
    }
    if (c_locale) freelocale(c_locale);
    if (copy != near) free(copy);
    return value;
}

static double convert(const decimal *d, const char *at, const char *end)
{
    static const double powers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    if (!d->digits) return 0;
    if (!d->is_cut && d->digits < (uint64_t)1 << 53 && d->exponent >= -22 && d->exponent <= 22) {
        double value = (double)d->digits;
        return d->exponent < 0 ? value / powers[-d->exponent] : value * powers[d->exponent];
    }
    if (!d->is_cut && d->exponent >= -LARGEST_EXACT && d->exponent <= LARGEST_EXACT)
        return exact_wide(d->digits, d->exponent);
    return slow_number(at, end);
}

static bool is_digit(char c)
{
    return (unsigned char)(c - '0') < 10;
}

/* Digits at `c`, gathered where they fit 64 bits whatever they are; gives where they end. */
static const char *scan_digits(const char *c, const char *end, uint64_t *digits)
{
    uint64_t value = *digits;
    for (; c < end && is_digit(*c); c++) value = value * 10 + (unsigned)(*c - '0');
    *digits = value;
    return c;
}

/* The same digit by digit, for what does not fit. */
static void take_digits(const char *c, const char *end, decimal *d)
{
    bool is_fraction = false;
    *d = (decimal){0};
    for (; c < end; c++)
        if (*c == '.')
            is_fraction = true;
        else
            take_digit(d, *c - '0', is_fraction);
}

/* An exponent at `c`, or nothing where no digits follow its letter. */
static const char *scan_exponent(const char *c, const char *end, decimal *d)
{
    if (c == end || (*c | 0x20) != 'e') return c;
    const char *digit = c + 1;
    bool is_negative = digit < end && *digit == '-';
    if (digit < end && (*digit == '-' || *digit == '+')) digit++;
    if (digit == end || !is_digit(*digit)) return c;
    long exponent = 0;
    for (; digit < end && is_digit(*digit); digit++)
        if (exponent < 1000000) exponent = exponent * 10 + (*digit - '0');
    d->exponent += is_negative ? -exponent : exponent;
    return digit;
}

bool number_scan(const char **at, const char *end, double *value)
{
    const char *c = *at;
    bool is_negative = c < end && *c == '-';
    if (c < end && (*c == '-' || *c == '+')) c++;
    decimal d = {0};
    const char *first = c, *whole = scan_digits(c, end, &d.digits);
    c = whole;
    if (c < end && *c == '.') {
        c = scan_digits(whole + 1, end, &d.digits);
        if (c == whole + 1 && whole == first) return false; /* a point alone */
        d.exponent = (long)(whole + 1 - c);
    } else if (c == first) {
        return false;
    }
    if (c - first > 19) take_digits(first, c, &d); /* the point is one of them */
    c = scan_exponent(c, end, &d);
    double magnitude = convert(&d, first, c);
    *value = is_negative ? -magnitude : magnitude;
    *at = c;
    return true;
}

static load_text trim(load_text text)
{
    while (text.at < text.end && (*text.at == ' ' || *text.at == '\t')) text.at++;
    while (text.at < text.end && (text.end[-1] == ' ' || text.end[-1] == '\t')) text.end--;
    return text;
}

bool number_whole(load_text text, double *value)
{
    text = trim(text);
    double found;
    if (!number_scan(&text.at, text.end, &found) || text.at != text.end || !isfinite(found)) return false;
    *value = found;
    return true;
}

bool number_count(load_text text, uint64_t *value)
{
    text = trim(text);
    uint64_t found = 0;
    if (text.at == text.end) return false;
    for (; text.at < text.end; text.at++) {
        if (*text.at < '0' || *text.at > '9' || found > (UINT64_MAX - 9) / 10) return false;
        found = found * 10 + (unsigned)(*text.at - '0');
    }
    *value = found;
    return true;
}

bool number_is_special(load_text text)
{
    text = trim(text);
    if (text.at < text.end && (*text.at == '-' || *text.at == '+')) text.at++;
    size_t length = (size_t)(text.end - text.at);
    return (length >= 3 && !strncasecmp(text.at, "nan", 3)) ||
           (length == 3 && !strncasecmp(text.at, "inf", 3)) ||
           (length == 8 && !strncasecmp(text.at, "infinity", 8));
}
