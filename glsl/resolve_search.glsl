// How a walk that pauses keeps its place in an entry of the redo list, and how long a search may be.
#ifdef MNS_DOUBLE
const uint RESOLVE_STATE = REDO_DOUBLE;
uvec2 resolve_pack(REAL s) { return unpackDouble2x32(s); }
REAL resolve_unpack(uvec2 bits) { return packDouble2x32(bits); }
#else
const uint RESOLVE_STATE = REDO_FLOAT;
uvec2 resolve_pack(REAL s) { return uvec2(floatBitsToUint(s), 0u); }
REAL resolve_unpack(uvec2 bits) { return uintBitsToFloat(bits.x); }
#endif

// A search by the curvature takes short steps where L is far below a ball's peak; it pauses when it has done enough for a dispatch.
#if KERNEL > DENSITY_WYVILL
const int RESOLVE_SEARCH = 16 * RESOLVE_STEPS;
#else
const int RESOLVE_SEARCH = RESOLVE_STEPS;
#endif
