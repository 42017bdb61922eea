// A ray's walk from separator to separator, each piece looked at.

// Returns the last piece's verdict; s is the hit. Taking balls in, stepping from separator to separator and searching
// a piece are loops of their own, so that on a wide machine no lane pays for what another does.
int cast_walk(uint head, float limit, out float s)
{
    s = RAY_BEGIN;
    slots_clear();
    stream_read(head);
    float stop = FAR_AWAY;
    int work = 0;
#ifdef MONOMIAL
    bool gap = true;
#endif
    for (;;) {
        stream_fill(s, stop);
        bool may = false;
        float next;
        while (stream_near > stop && s < limit && !slot_overflow) {
            bool some;
            next = slot_sum(s, stop, some);
#ifdef MONOMIAL
            if (gap) monomial_begin(s);
            gap = !some;
#endif
            may = piece_may(s, stop, SIDE) && some;
            if (may) break;
#ifdef MONOMIAL
            monomial_pass(s, stop);
#endif
            s = stop;
            stop = next;
            work += slot_count + 2;
            if (work > WALK_BUDGET) break;
        }
        if (!may) {
            if (!(stream_near <= stop || stream_near > stop)) return PIECE_CAP; // not a number
            if (slot_overflow || work > WALK_BUDGET) return PIECE_CAP;
            if ((stop == FAR_AWAY && stream_near == FAR_AWAY) || s >= limit) return PIECE_NONE;
            continue;
        }
        float hit;
        int found = piece_solve(s, stop, SIDE, ROOT_STEPS, hit);
        if (found != PIECE_NONE) {
            s = hit;
            return found == PIECE_HIT && s > limit ? PIECE_NONE : found;
        }
#ifdef MONOMIAL
        monomial_pass(s, stop);
#endif
        s = stop;
        stop = next;
        work += 64;
    }
    return PIECE_CAP; // only where the driver ended the loop
}
