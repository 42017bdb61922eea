#!/usr/bin/env bash
# The table of povray.md, made here and now: bench/povray.sh [METHOD...] (default: all four). Needs python3, povray and what
# ./run test installs.
set -euo pipefail
cd "$(dirname "$(realpath "$0")")/.."
{ cmake --preset release && cmake --build --preset release --target meniscus_program; } >&2
exec python3 bench/povray.py build/release/meniscus "$@"
