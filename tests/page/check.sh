#!/usr/bin/env bash
# Writes the made-up page and has it looked at by headless Chromium: check.sh WRITE_PAGE FOLDER CHART_JS. 77: no browser.
set -euo pipefail
here=$(dirname "$(realpath "$0")")
write=$1 folder=$2 chart=$3

for name in NODE CHROMIUM; do
    program=${!name-}
    [[ -n $program && -x $program ]] && continue
    echo "skipped: $name is missing (configure again once it is installed)"
    exit 77
done
rm -rf "$folder"
mkdir -p "$folder"
"$write" "$folder"
charts=with
[[ -s $chart ]] || charts=without
exec "$NODE" "$here/check.mjs" "$CHROMIUM" "$folder" "$charts"
