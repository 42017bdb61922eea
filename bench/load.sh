#!/usr/bin/env bash
# How fast particle files are read, the table of load.md: bench/load.sh [COUNT] (default: 1,600,000 balls). The files,
# half a gigabyte, are made in a folder of their own and removed. Needs what ./run test installs.
set -euo pipefail
cd "$(dirname "$(realpath "$0")")/.."
{ cmake --preset release -DMNS_TESTS=ON -DMNS_BENCH=ON && cmake --build --preset release --target bench_load; } >&2
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
build/release/bench/bench_load "$folder" "$@"
