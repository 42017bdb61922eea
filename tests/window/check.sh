#!/usr/bin/env bash
# check.sh PROGRAM: the window under a virtual display, driven by scripts and by a hand (xdotool). What it saves is
# compared, byte by byte, with what `render` draws through a GLFW context too.
set -euo pipefail
program=$1
for tool in Xvfb xdotool; do
    command -v $tool >/dev/null || { echo "skipped: no $tool"; exit 77; }
done
source=$(dirname "$(realpath "$0")")/../..
folder=$(mktemp -d)
export XDG_CACHE_HOME=$folder/cache TMPDIR=$folder
wrong=0
Xvfb -displayfd 1 -screen 0 1280x1024x24 -nolisten tcp >"$folder/display" 2>"$folder/xvfb.log" &
server=$!
trap 'kill $server 2>/dev/null; wait $server 2>/dev/null || true; rm -rf "$folder"' EXIT
for _ in $(seq 100); do
    [[ -s $folder/display ]] && break
    sleep 0.1
done
[[ -s $folder/display ]] || { cat "$folder/xvfb.log"; echo "skipped: Xvfb does not start"; exit 77; }
DISPLAY=:$(cat "$folder/display")
export DISPLAY
cd "$folder"

complain() {
    echo "window: $*" >&2
    wrong=1
}

# view SCRIPT ARGUMENT...: replays it; what it told lies in log. It must not speak of GL or the driver.
view() {
    local script=$1
    shift
    printf '%s\n' "$script" >script
    "$program" view --script script "$@" >log 2>errors || complain "view $*: status $?: $(cat errors log)"
    ! grep -q -e 'GL error' -e 'the driver gave' log || complain "view $*: $(cat log)"
}

same() {
    cmp -s "$1" "$2" || complain "$1 is not $2: $3"
}

render() {
    "$program" render --backend glfw "$@" >/dev/null || complain "render $* failed"
}

# What `copy` told, drawn without a window.
render_copied() {
    local line
    line=$(grep '^meniscus render ' "$1" | tail -n 1)
    eval "${line/#meniscus/\"\$program\"}" --backend=glfw --output="$2" >/dev/null || complain "$line"
}

# ---- Without a display, or with an old driver: one line that names what works.
refused() {
    local status=0
    env "$@" "$program" view scattered:50 >log 2>errors || status=$?
    [[ $status -eq 1 && $(wc -l <errors) -eq 1 ]] || complain "$*: status $status, $(cat errors)"
    grep -q 'meniscus render' errors || complain "$*: does not name meniscus render: $(cat errors)"
}
refused DISPLAY= WAYLAND_DISPLAY=
refused MESA_GL_VERSION_OVERRIDE=3.3
grep -q 'OpenGL 3.3' errors || complain "an old driver is not told: $(cat errors)"

# ---- A script: the picture of every view is that of render, bit for bit; what is wrong is told, and changes nothing.
size=(--size 320x240)
printf '0,0,0\n1,nan,0\n' >bad.csv
view $'save first.png
orbit 40 20\nscroll 2\nset method fbvh\ncopy\nsave turned.png
set color-map magma\nset iso 0.3\nset kernel wyvill\nside top\nfov 30\nset aa 3\ncopy\nsave look.png\nsave look.json\nsave look.exr
open missing.csv\nopen bad.csv\nset color-by nothing\nrest\nsave same.png
quit' scattered:500 "${size[@]}" --light 1,1,1
render scattered:500 "${size[@]}" --light 1,1,1 -o expected.png
same first.png expected.png "the first view"
grep '^meniscus render ' log | head -n 1 >first.log
render_copied first.log expected.png
same turned.png expected.png "another view by fbvh"
render_copied log expected.png
same look.png expected.png "another look"
render look.json -o expected.png
same look.png expected.png "the saved scene"
render look.json -o expected.exr
same look.exr expected.exr "the saved scene in floats"
same look.png same.png "what could not be opened or drawn has changed it"
for what in missing.csv bad.csv nothing; do
    grep -q "^error: .*$what" log || complain "not told: $what: $(cat log)"
done

# ---- Each way to a context.
for context in native egl osmesa; do
    view $'save '$context$'.png\nquit' scattered:200 "${size[@]}" --context $context
    [[ $context != native ]] || render scattered:200 "${size[@]}" -o expected.png
    same $context.png expected.png "--context $context"
done
view $'rest\nspin 0.1\nrest\nspin 1.5\nrest\nquit' scattered:200 "${size[@]}" # the first one compiles
tail -n 1 log | grep -q '^spin: [1-9]' || complain "no spin: $(cat log)"

# ---- What puts it on the window is valid by the letter.
if command -v glslangValidator >/dev/null; then
    { echo '#version 430 core'; cat "$source/glsl/color.glsl" "$source/glsl/window/screen.frag.glsl"; } >screen.frag
    glslangValidator screen.frag >log || complain "screen.frag.glsl: $(cat log)"
fi

# ---- Two methods, the divider, the error against the truth.
view $'compare divider\nother fbvh:exact\nrest\ngrab middle.png\ndrag 0 160 120 60 120\ngrab left.png
compare difference\nrest\ngrab difference.png\nnext other\ncompare flicker\nsleep 900\ntell flickered\ncompare off\ncheck\nrest
hover\nmove 160 120\nsleep 200\ntell hover\ncentre 160 120\nset color-by nothing\nrest\nmove 161 121\nmove 160 120\nsleep 200\ntell centred\nquit' scattered:500 "${size[@]}"
! cmp -s middle.png left.png || complain "the divider stays where it was"
! cmp -s middle.png difference.png || complain "the difference is not shown"
grep -q 'against the reference: 0 missed, 0 invented, 0 wrong roots' log || complain "no error told: $(cat log)"
[[ $(grep -c -E '^(hover|centred): .* at .*: density 0\.(2|20000.*|19999.*), ball [0-9]+' log) -eq 2 ]] ||
    complain "nothing is said of what is under the cursor: $(cat log)"
point() { sed -n "s/^$1: .* at \([-0-9.e, ]*\): density.*/\1/p" log; }
awk -v a="$(point hover)" -v b="$(point centred)" 'BEGIN { split(a, p, ", "); split(b, q, ", ");
    for (i = 1; i <= 3; i++) if ((p[i] - q[i]) ^ 2 > 1e-4) exit 1 }' || complain "centre does not centre: $(cat log)"
[[ $(sed -n 's/^flickered: .*showed \([0-9]*\),.*/\1/p' log) -ge 4 ]] || complain "it does not flicker: $(cat log)"

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

# ---- Shaders read again: a bad one is told, and the one before draws on.
mkdir glsl
cp "$source"/glsl/*.glsl glsl
sed -i 's/out_color = color/out_color = colour/' glsl/shade.frag.glsl
printf 'save before.png\nreload\nrest\nsave after.png\nquit\n' >script
"$program" view scattered:200 "${size[@]}" --glsl glsl --script script >log 2>errors || complain "reload: $(cat errors)"
grep -q '^error: shade.frag.glsl does not compile' log || complain "a bad shader is not told: $(cat log)"
same before.png after.png "a bad shader changed the picture"

# ---- A hand: drags, the wheel, keys, another size; asleep where nothing happens.
"$program" view scattered:500 "${size[@]}" >log 2>errors &
viewer=$!
window=$(timeout 20 xdotool search --sync --onlyvisible --name '^scattered:500' | head -n 1)
hand() {
    xdotool "$@"
    sleep 0.3
}
hand windowfocus "$window"
hand mousemove --window "$window" 160 120 mousedown 1 mousemove_relative 40 20 mousemove_relative 10 0 mouseup 1
hand mousemove_relative -- -20 0 click 4 click 4
hand keydown shift mousedown 1 mousemove_relative 5 9 mouseup 1 keyup shift
hand mousemove --window "$window" 160 120 click --repeat 2 --delay 60 1
hand key Tab # the panel comes, and goes by a key that passes through it
hand key Tab
hand key m
hand windowsize --sync "$window" 400 300
sleep 0.5
ticks() { awk '{print $14 + $15}' /proc/$viewer/stat; }
for _ in $(seq 30); do # what it was last asked for may take its time
    before=$(ticks)
    sleep 1
    spent=$(($(ticks) - before))
    [[ $spent -gt 3 ]] || break
done
[[ $spent -le 3 ]] || complain "at rest it takes $spent hundredths of a second in one"
hand key ctrl+c
hand key ctrl+s
sleep 0.5
xdotool key Escape
wait $viewer || complain "a hand: status $?: $(cat errors log)"
grep -q -e '--size=400x300' log || complain "no other size: $(cat log)"
grep -q -e '--method=list' log || complain "no other method: $(cat log)"
! grep -q -e '--eye=0.50018910186516996,0.49992022151508364,2' log || complain "the mouse moves nothing: $(cat log)"
render_copied log expected.png
same meniscus.png expected.png "the picture after a hand's work"
! grep -q -e 'GL error' -e 'the driver gave' log || complain "a hand: $(cat log)"
[[ ! -s errors ]] || complain "a hand: $(cat errors)"
exit $wrong
