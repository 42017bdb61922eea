#!/usr/bin/env bash
# input.sh PROGRAM: what the window opens: inputs that cannot be drawn, and sequences.
. "$(dirname "$(realpath "$0")")/lib.sh"


# ---- What can be opened, but not drawn, leaves all as it was: picture, words, frame, and what plays on.
echo '{"input": "scattered:50", "material": {"color_by": "nothing"}}' >undrawn.json
view $'orbit 30 10\nframe 1\nrest\nsave before.png\ncopy\nopen undrawn.json\nrest\nsave after.png\ncopy
open undrawn.json\nsave none.png\nset environment none.exr\nsave none.png\nsave again.png\ncopy
set radius 0.2\nset kernel wyvill\nset color-by nothing\nrest\nsave both.png\nset kernel wyvill\nopen missing.csv\nrest\nsave wyvill.png
copy\ntell stays\nstep 1\nrest\ntell goes\nplay\nrest\nopen undrawn.json\nrest\nsleep 500\ntell plays\nquit' \
    drop:300:1:4 "${size[@]}"
same before.png after.png "what could not be drawn"
same before.png again.png "what could not be drawn before it was saved"
same before.png both.png "what could not be drawn takes back what was not drawn either"
[[ ! -e none.png ]] || complain "a picture of what could not be drawn"
[[ $(grep -c '^meniscus render drop:300:1:4 .*--frame=1' log) -eq 4 ]] || complain "other words: $(cat log)"
[[ $(grep '^meniscus render' log | head -n 3 | sort -u | wc -l) -eq 1 ]] || complain "other words or camera: $(cat log)"
render_copied log expected.png
same wyvill.png expected.png "what could be drawn before what could not be read"
grep -q '^stays: .*frame 1,' log || complain "another frame: $(cat log)"
grep -q '^goes: .*frame 2,' log || complain "it reads no frame any longer: $(cat log)"
drawn() { sed -n "s/^$1: drew \([0-9]*\),.*/\1/p" log; }
[[ $(drawn plays) -ge $(($(drawn goes) + 5)) ]] || complain "it no longer plays: $(cat log)"

# ---- A sequence: played, dropped frames told, a frame by its number is that of render.
dam=$source/examples/dam.06500.lammpstrj.gz
view $'rest\nplay\nsleep 1500\npause\nrest\ntell played\nframe 1\nrest\nsave frame.png\nstep -1\nrest\ntell back\nquit' \
    "$dam" "$dam" "${size[@]}" --radius 2.2 --color-by vz
render "$dam" "$dam" "${size[@]}" --radius 2.2 --color-by vz --frame 1 -o expected.png
same frame.png expected.png "a frame of a sequence"
[[ $(sed -n 's/^played: drew \([0-9]*\),.*/\1/p' log) -ge 3 ]] || complain "it does not play: $(cat log)"
grep -q '^back: .*frame 0,' log || complain "it does not step: $(cat log)"
view $'panel\nrest\nopen drop:100:1:3\nrest\nstep 1\nrest\npanel\nopen scattered:50\nrest\nopen examples\npanel\nrest\nquit' scattered:30 "${size[@]}"
view $'set method fbvh\nrest\nplay\nsleep 900\ntell fbvh\nset method tile\nsleep 300\nset method fbvh\nsleep 300\nopen scattered:50\nrest\nquit' \
    drop:3000:1:20 "${size[@]}"
[[ $(sed -n 's/^fbvh: drew \([0-9]*\),.*/\1/p' log) -ge 2 ]] || complain "it does not play by trees: $(cat log)"
# ---- The dam break, a file a frame: every frame that is shown is that of render, by hand and while it plays.
zcat "$dam" >dam.txt
for k in 0 1 2 3; do
    awk -v t="0.$((2 * k))" 'BEGIN { print "x,y,z,vz" }
        NR > 9 && NR % 12 == 0 { print $3 + t * $6 "," $4 + t * $7 "," $5 + t * $8 "," $8 }' dam.txt >dam.$k.csv
done
files=(dam.[0-3].csv "${size[@]}" --radius 4 --color-by vz --method fbvh)
render "${files[@]}" --frame 0:3 -o expected.%04d.png
hand= playing=
for k in 0 1 2 3; do hand+=$'frame '$k$'\nrest\nsave hand.'$k$'.png\n'; done
for k in 0 1 2 3 4 5; do playing+=$'sleep 130\nsave played.'$k$'.png\ntell played'$k$'\n'; done
view "${hand}"$'loop\nspeed 0.25'$'\nplay\n'"sleep 30"$'\n'"${playing}pause"$'\nrest\nquit' "${files[@]}"
for k in 0 1 2 3; do same hand.$k.png expected.000$k.png "frame $k by hand"; done
seen=
for k in 0 1 2 3 4 5; do
    frame=$(sed -n "s/^played$k: .* frame \([0-9]*\),.*/\1/p" log)
    same played.$k.png "expected.000$frame.png" "frame $frame while it plays"
    seen+="$frame "
done
[[ $seen =~ [012].*3\ $ ]] || complain "from the end it does not begin again and play to the end: $seen"

# ---- A file that goes while it plays is told; the window stays, and shows the others.
for k in 0 1 2; do cp dam.$k.csv gone.$k.csv; done
: >log
printf 'open undrawn.json\nrest\ntell ready\nsleep 900\nplay\nsleep 700\nframe 0\nrest\nsave gone.png\nquit\n' >script
"$program" view --script script gone.[0-2].csv "${files[@]:4}" >log 2>errors &
viewer=$!
for _ in $(seq 100); do
    if grep -q '^ready' log; then break; fi
    sleep 0.1
done
title=$(xdotool search --name '\.csv \[0/2\]' getwindowname) || true
[[ $title == gone.0.csv* ]] || complain "what could not be drawn has changed the title: $title"
rm gone.1.csv gone.2.csv
wait $viewer || complain "a file that goes: status $?: $(cat errors)"
grep -q '^error: gone.1.csv' log || complain "a file that goes is not told: $(cat log)"
same gone.png expected.0000.png "the frame that is there"

exit $wrong
