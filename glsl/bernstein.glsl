// Polynomials of degree DEGREE in Bernstein form on [0, 1], and the search for their first rise through zero.
//
// The coefficients' hull holds the polynomial, so "every coefficient below -margin" proves that it stays below zero, and a single
// change of sign proves a single root. Subdivision only averages, and so cancels nothing; what it rounds is added to the margin.

const int PIECE_NONE = 0;    // stays below zero up to the end (or into the margin at the very end)
const int PIECE_HIT = 1;     // rises through zero
const int PIECE_OPEN = 2;    // rounding could decide
const int PIECE_CAP = 3;     // the search took too many steps
const int PIECE_LATER = 4;   // no verdict yet: to be taken up where the search has come to

const int SEES_NONE = 0, SEES_ONE = 1, SEES_OPEN = 2;

// What the signs of the coefficients prove, coming from below.
int bernstein_sees(KEPT b[DEGREE + 1], REAL margin)
{
    int first = DEGREE + 1;    // first coefficient not below zero for certain
    bool above = true;         // all after it are above zero for certain
    for (int i = 0; i <= DEGREE; i++) {
        if (first <= DEGREE)
            above = above && kept(b[i]) > margin;
        else if (!(kept(b[i]) < -margin))
            first = i;
    }
    if (first > DEGREE) return SEES_NONE;
    if (first == DEGREE) return kept(b[DEGREE]) > margin ? SEES_ONE : SEES_NONE;
    if (above && (first > 0 || kept(b[0]) <= margin)) return SEES_ONE;
    return SEES_OPEN;
}

// de Casteljau at x: `left` is the polynomial on [0, x], what is left in b is it on [x, 1].
void bernstein_split(inout KEPT b[DEGREE + 1], REAL x, out KEPT left[DEGREE + 1])
{
    for (int k = 0; k <= DEGREE; k++) {
        left[k] = b[0];
        for (int i = 0; i < DEGREE - k; i++) kept_add(b[i], x * (kept(b[i + 1]) - kept(b[i])));
    }
}

// Value and slope at x.
REAL bernstein_at(KEPT b[DEGREE + 1], REAL x, out REAL slope)
{
    for (int k = 0; k < DEGREE - 1; k++)
        for (int i = 0; i < DEGREE - k; i++) kept_add(b[i], x * (kept(b[i + 1]) - kept(b[i])));
    slope = NUM(DEGREE) * (kept(b[1]) - kept(b[0]));
    return kept(b[0]) + x * (kept(b[1]) - kept(b[0]));
}

// The one root of a polynomial that SEES_ONE, by Newton steps kept inside a shrinking bracket.
REAL bernstein_root(KEPT b[DEGREE + 1])
{
    REAL low = NUM(0.0);
    REAL high = NUM(1.0);
    REAL x = clamp(kept(b[0]) / (kept(b[0]) - kept(b[DEGREE])), NUM(0.0), NUM(1.0));
    for (int step = 0; step < 60; step++) {
        REAL slope;
        REAL value = bernstein_at(b, x, slope);
        if (value < NUM(0.0))
            low = x;
        else
            high = x;
        REAL next = x - value / slope;
        if (!(next >= low && next <= high)) next = NUM(0.5) * (low + high);
        bool near = abs(next - x) <= SOLVE_TOLERANCE;
        x = next;
        if (near) break;
    }
    return x;
}

#ifndef ROOT_MATTERS
#define ROOT_MATTERS true // where the root lies, not only that there is one
#endif

// Where the largest coefficient stands, away from the ends: a good place to split a hump.
REAL bernstein_hump(KEPT b[DEGREE + 1])
{
    REAL largest = kept(b[1]);
    REAL place = NUM(1.0);
    for (int i = 2; i < DEGREE; i++)
        if (kept(b[i]) > largest) {
            largest = kept(b[i]);
            place = NUM(i);
        }
    return place / NUM(DEGREE);
}

// The first x in [0, 1] at which the polynomial rises through zero, never passing one and never taking a later one: the search
// goes on from a place only when everything to the left of it has been proved to stay below zero. Where a stretch proves nothing
// it is cut at its hump, and its left part looked at first; no stack is kept, what lies right is cut again from b.
int bernstein_first(KEPT b[DEGREE + 1], REAL margin, int steps, out REAL root)
{
    REAL low = NUM(0.0);    // b is the polynomial on [low, 1]
    REAL width = NUM(1.0);  // of that, the stretch looked at
    root = NUM(0.0);
    int sees = bernstein_sees(b, margin);
    if (sees == SEES_NONE) return PIECE_NONE;
    if (sees == SEES_ONE) {
        if (ROOT_MATTERS) root = bernstein_root(b);
        return PIECE_HIT;
    }
    REAL scale = abs(kept(b[0]));
    for (int i = 1; i <= DEGREE; i++) scale = max(scale, abs(kept(b[i])));
    REAL rounding = NUM(0.5) * TAU * scale;
    margin += rounding;
    width = bernstein_hump(b);
    for (int step = 0; step < steps; step++) {
        KEPT left[DEGREE + 1];
        KEPT right[DEGREE + 1] = b;
        bernstein_split(right, width, left);
        sees = bernstein_sees(left, margin);
        if (sees == SEES_ONE) {
            if (ROOT_MATTERS) root = low + (NUM(1.0) - low) * width * bernstein_root(left);
            return PIECE_HIT;
        }
        if (sees == SEES_NONE) {
            low += (NUM(1.0) - low) * width;
            if (width == NUM(1.0)) return PIECE_NONE;
            b = right;
            margin += rounding;
            width = NUM(1.0);
        } else {
            if (kept(b[0]) > margin || width < SOLVE_TOLERANCE) return PIECE_OPEN;
            width *= bernstein_hump(left);
        }
    }
    return PIECE_CAP;
}
