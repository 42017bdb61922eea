#!/usr/bin/env bash
# How long the first image takes, the table of load.md: bench/start.sh. Needs what ./run test installs and python3.
set -euo pipefail
cd "$(dirname "$(realpath "$0")")/.."
program=${MENISCUS:-build/release/meniscus} # one built before, or this tree's
[[ -n ${MENISCUS-} ]] || { cmake --preset release && cmake --build --preset release --target meniscus_program; } >&2
PYTHONDONTWRITEBYTECODE=1 python3 bench/start.py "$program"
