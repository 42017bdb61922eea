#!/usr/bin/env bash
# Has headless Chromium look at the made-up page, at one that the program writes, whose chart is held against its
# results.csv, and at one of two saved images: check.sh WRITE_PAGE MENISCUS FOLDER CHART_JS. 77: no browser.
set -euo pipefail
here=$(dirname "$(realpath "$0")")
write=$1 meniscus=$2 folder=$3 chart=$4

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
"$NODE" "$here/check.mjs" "$CHROMIUM" "$folder" "$charts"

XDG_CACHE_HOME=$folder/cache "$meniscus" compare scattered:300 --size 96x72 -o "$folder/real"
"$NODE" "$here/check.mjs" "$CHROMIUM" "$folder/real" "$charts"

"$meniscus" render scattered:300 --size 96x72 -o "$folder/a.exr"
"$meniscus" render scattered:300 --size 96x72 --solver cubic -o "$folder/b.exr"
status=0
"$meniscus" compare "$folder/a.exr" "$folder/b.exr" -o "$folder/saved" || status=$?
[[ $status -eq 1 ]] || { echo "images that differ: exit status $status, not 1"; exit 1; }
"$NODE" "$here/check.mjs" "$CHROMIUM" "$folder/saved" "$charts"
