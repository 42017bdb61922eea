#!/usr/bin/env bash
# The table of window.md, measured here and now under a virtual display: bench/window.sh. Nothing else should run
# meanwhile. Needs what ./run test installs.
set -euo pipefail
cd "$(dirname "$(realpath "$0")")/.."
{ cmake --preset release && cmake --build --preset release --target meniscus_program; } >&2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
printf 'rest\nspin 3\nrest\nside front\nrest\ntell still\nspin 10\nrest\nquit\n' >"$folder/script"

echo '| scene | moving: pictures a second | median ms | p95 ms | drawn at | at rest, 1024x768, ms |'
echo '|-|-|-|-|-|-|'
for scene in examples/dam.json examples/molecule.json scattered:100000; do
    xvfb-run -a -s '-screen 0 1280x1024x24' build/release/meniscus view "$scene" --size 1024x768 --no-panel --patience 600 \
        --script "$folder/script" >"$folder/log"
    still=$(sed -n 's/^still: .*last in \([0-9.]*\) ms.*/\1/p' "$folder/log")
    sed -n 's/^spin: \([0-9]*\) pictures, median \([0-9.]*\) ms, p95 \([0-9.]*\) ms, at last \([0-9x]*\) of .*/\1 \2 \3 \4/p' \
        "$folder/log" | tail -n 1 | while read -r count median p95 size; do
        echo "| $scene | $((count / 10)) | $median | $p95 | $size | $still |"
    done
done
