#!/usr/bin/env bash
# The table of card.md, measured here and now by whatever renderer there is; SIZE=WxH and REPEAT=N of the frames. Needs what ./run
# test installs, and python3.
set -euo pipefail
cd "$(dirname "$(realpath "$0")")/.."
{ cmake --preset release && cmake --build --preset release --target meniscus_program; } >&2
python3 bench/card.py build/release/meniscus
