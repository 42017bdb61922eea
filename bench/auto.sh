#!/usr/bin/env bash
# How often the plan's choice of a method is within 10 % of the best: bench/auto.sh [NAME:COUNT]... (default: seven kinds of
# scene, 1,000 to 1,000,000 balls). Part of bench/speed.sh.
set -euo pipefail
cd "$(dirname "$(realpath "$0")")/.."
{ cmake --preset release -DMNS_TESTS=ON -DMNS_BENCH=ON && cmake --build --preset release --target bench_auto; } >&2
build/release/bench/bench_auto "$@"
