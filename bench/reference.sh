#!/usr/bin/env bash
# The certified tracer against ball arithmetic, the table of errors.md: bench/reference.sh [-n RAYS] [-s FIRST SEED]
# (default: 100,000 rays). Exits 1 where the two disagree. Needs what ./run test installs.
set -euo pipefail
cd "$(dirname "$(realpath "$0")")/.."
{ cmake --preset release -DMNS_TESTS=ON -DMNS_BENCH=ON && cmake --build --preset release --target bench_reference; } >&2
build/release/bench/bench_reference "$@"
