#!/usr/bin/env bash
# Builds the yardstick and makes its scenes under build/bench/, once. Sourced by the tables' scripts, or run alone.
# Needs g++ and python3, and a processor with AVX2.
set -euo pipefail
cd "$(dirname "$(realpath "${BASH_SOURCE[0]}")")/.."

BENCH=$PWD/build/bench
LIMIT=$BENCH/limit
SCENES=$BENCH/scenes

yardstick_build() {
    local source=bench/yardstick/limit.cpp width=()
    mkdir -p "$BENCH"
    grep -qw avx512f /proc/cpuinfo || width=(-Ibench/yardstick/avx2)
    [[ $LIMIT -nt $source ]] || g++ -O3 -march=native -fopenmp "${width[@]}" "$source" -o "$LIMIT"
    [[ -s $SCENES/done ]] && return 0
    mkdir -p "$SCENES"
    python3 bench/yardstick/scenes.py "$SCENES" && date >"$SCENES/done"
}

# How wide the yardstick's vectors are here.
yardstick_vectors() {
    if grep -qw avx512f /proc/cpuinfo; then echo AVX-512; else echo "AVX2 (two operations for each of AVX-512)"; fi
}

yardstick_build
