#!/usr/bin/env bash
# The tables of speed.md, measured here and now: bench/speed.sh [ratios|paper|large|growth]... [SCENE]... (default: all
# tables, all scenes). Builds the yardstick and makes its scenes first. Nothing else should run meanwhile. Needs what ./run test
# installs, g++ and python3.
set -euo pipefail
cd "$(dirname "$(realpath "$0")")/.."
# shellcheck source=SCRIPTDIR/yardstick.sh
source bench/yardstick.sh >&2

program=${MENISCUS:-build/release/meniscus} # one built before, or this tree's
[[ -n ${MENISCUS-} ]] || { cmake --preset release && cmake --build --preset release --target meniscus_program; } >&2
# Medians leave the first frame out, so compilers are waited for once; in a folder of their own, as bench/start.sh has them.
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
export XDG_CACHE_HOME=$folder MESA_SHADER_CACHE_DIR=$folder
export SCENES LIMIT PYTHONDONTWRITEBYTECODE=1
LIMIT_VECTORS=$(yardstick_vectors)
export LIMIT_VECTORS

tables=() scenes=()
for argument in "$@"; do
    case $argument in
    ratios | paper | large | growth) tables+=("$argument") ;;
    auto) rm -r "$folder" && exec bench/auto.sh "${@:2}" ;;
    *) scenes+=("$argument") ;;
    esac
done
[[ ${#tables[@]} -gt 0 ]] || tables=(ratios paper large growth)
for table in "${tables[@]}"; do
    python3 bench/speed.py "$table" "$program" "${scenes[@]}"
    echo
done
