#!/usr/bin/env bash
# The tables of fbvh.md, measured here and now: bench/fbvh.sh [build|static|counters|paper|moving|against]... (default: all).
# Nothing else should run meanwhile. Needs what ./run test installs, g++ and python3.
set -euo pipefail
cd "$(dirname "$(realpath "$0")")/.."
# shellcheck source=SCRIPTDIR/yardstick.sh
source bench/yardstick.sh >&2

{ cmake --preset release -DMNS_TESTS=ON -DMNS_BENCH=ON && cmake --build --preset release --target bench_fbvh_build meniscus_program; } >&2
LIMIT_VECTORS=$(yardstick_vectors)
export SCENES LIMIT LIMIT_VECTORS

[[ $# -gt 0 ]] || set -- build static counters paper moving against
for table in "$@"; do
    case $table in
    build) python3 bench/fbvh_build.py build/release/bench/bench_fbvh_build ;;
    static | counters) python3 bench/fbvh_trace.py "$table" build/release/meniscus ;;
    paper | against | moving) python3 bench/fbvh_paper.py "$table" build/release/meniscus ;;
    *)
        echo "bench/fbvh.sh: no table '$table'; expected build, static, counters, paper, moving or against" >&2
        exit 2
        ;;
    esac
    echo
done
