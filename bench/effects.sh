#!/usr/bin/env bash
# The tables of effects.md, measured here and now: bench/effects.sh [effects|yardstick|truth]... (default: all). Nothing else should run
# meanwhile. Needs what ./run test installs, g++ and python3. SIZE=WxH: of the frames, 640x480 by default (a
# small one first fills the driver's cache of programs). ONLY="SCENE...": of the table `effects`.
set -euo pipefail
cd "$(dirname "$(realpath "$0")")/.."
# shellcheck source=SCRIPTDIR/yardstick.sh
source bench/yardstick.sh >&2

{ cmake --preset release && cmake --build --preset release --target meniscus_program; } >&2
LIMIT_VECTORS=$(yardstick_vectors)
export SCENES LIMIT LIMIT_VECTORS

[[ $# -gt 0 ]] || set -- effects yardstick truth
for table in "$@"; do
    case $table in
    effects | yardstick | truth) python3 bench/effects.py "$table" build/release/meniscus ;;
    *)
        echo "bench/effects.sh: no table '$table'; expected effects, yardstick or truth" >&2
        exit 2
        ;;
    esac
    echo
done
