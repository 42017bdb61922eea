#!/usr/bin/env bash
# check.sh PROGRAM: the window driven by scripts: views, contexts, two methods, shaders.
. "$(dirname "$(realpath "$0")")/lib.sh"

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

# ---- Shaders read again: a bad one is told, and the one before draws on.
mkdir glsl
cp "$source"/glsl/*.glsl glsl
sed -i 's/out_color = color/out_color = colour/' glsl/shade.frag.glsl
printf 'save before.png\nreload\nrest\nsave after.png\nquit\n' >script
"$program" view scattered:200 "${size[@]}" --glsl glsl --script script >log 2>errors || complain "reload: $(cat errors)"
grep -q '^error: shade.frag.glsl does not compile' log || complain "a bad shader is not told: $(cat log)"
same before.png after.png "a bad shader changed the picture"
exit $wrong
