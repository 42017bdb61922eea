#!/usr/bin/env bash
# input.sh PROGRAM: what the window opens: inputs that cannot be drawn, and sequences.
. "$(dirname "$(realpath "$0")")/lib.sh"

size=(--size 320x240)

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
exit $wrong
