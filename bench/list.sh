#!/usr/bin/env bash
# The tables of list.md, measured here and now: bench/list.sh [ratios|phases|accuracy]... (default: all three). Nothing
# else should run meanwhile. Needs what ./run test installs, g++ and python3.
set -euo pipefail
cd "$(dirname "$(realpath "$0")")/.."
# shellcheck source=SCRIPTDIR/yardstick.sh
source bench/yardstick.sh >&2

{ cmake --preset release -DMNS_TESTS=ON -DMNS_BENCH=ON && cmake --build --preset release --target meniscus_program bench_accuracy; } >&2
export MESA_SHADER_CACHE_DISABLE=true # a warm cache would hide what the first frame costs
export SCENES LIMIT PYTHONDONTWRITEBYTECODE=1
LIMIT_VECTORS=$(yardstick_vectors)
export LIMIT_VECTORS

[[ $# -gt 0 ]] || set -- ratios phases accuracy
for table in "$@"; do
    case $table in
    ratios | phases) python3 bench/list.py "$table" build/release/meniscus ;;
    accuracy) build/release/bench/bench_accuracy ;;
    *)
        echo "bench/list.sh: no table '$table'; expected ratios, phases or accuracy" >&2
        exit 2
        ;;
    esac
    echo
done
