#!/usr/bin/env bash
# The section "Errors against time" of errors.md, measured here and now: bench/errors.sh [SCENE]... (default: all). Writes
# the section with its tables, and the charts in bench/errors/. Nothing else should run meanwhile. Needs what ./run test
# installs, gnuplot-nox and python3.
set -euo pipefail
cd "$(dirname "$(realpath "$0")")/.."
command -v gnuplot >/dev/null || { echo "bench/errors.sh: gnuplot is missing (package gnuplot-nox)" >&2; exit 1; }
{ cmake --preset release && cmake --build --preset release --target meniscus_program; } >&2

declare -A SCENES=(
    [scattered]="scattered:10000"
    [dense]="dense:10000"
    [mixed]="mixed:10000"
    [molecule]="examples/1tii.pdb"
    [dam]="examples/dam.06500.lammpstrj.gz --radius 2.2 --kernel poly2 --iso 0.35
        --eye 112,-14,66 --look-at 12,43,26 --up 0,0,1 --fov 40"
)
OPTIONS=(--size 640x480 --frames 9)

[[ $# -gt 0 ]] || set -- scattered dense mixed molecule dam
results=$(mktemp -d)
trap 'rm -r "$results"' EXIT
mkdir -p bench/errors
for scene in "$@"; do
    [[ -n ${SCENES[$scene]-} ]] || { echo "bench/errors.sh: no scene '$scene'; known: ${!SCENES[*]}" >&2; exit 2; }
    read -r -d '' -a arguments <<<"${SCENES[$scene]}" || true
    build/release/meniscus compare "${arguments[@]}" "${OPTIONS[@]}" -o "$results/$scene" >&2
    cp "$results/$scene/chart.svg" "bench/errors/$scene.svg"
done
python3 bench/errors.py bench/errors.md "${@/#/$results/}"
