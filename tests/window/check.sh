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

# ---- The difference on the window has the colours of the distances that render writes.
if [[ -n $difference ]]; then
    from=("${size[@]}" --method list --eye 0.5,0.5,3 --look-at 0.5,0.5,0.5)
    view $'other list:cubic\ncompare difference\nscale 1000\nrest\ngrab difference.png\nquit' scattered:500 "${from[@]}" --no-panel
    render scattered:500 "${from[@]}" -o a.exr
    render scattered:500 "${from[@]}" --solver cubic -o b.exr
    "$difference" a.exr b.exr difference.png 2.5e-2 >difference.log || complain "the difference: $(cat difference.log)"
fi

# ---- Samples that come one by one at rest are those of --aa.
view $'rest\ntell one\nset aa 4\nrest\ntell four\nsave rest.png\nquit' scattered:500 "${size[@]}"
render scattered:500 "${size[@]}" --aa 4 -o expected.png
same rest.png expected.png "samples that came one by one"
drawn() { sed -n "s/^$1: drew \([0-9]*\),.*/\1/p" log; }
[[ $(drawn four) -ge $(($(drawn one) + 4)) ]] || complain "samples do not come one by one: $(cat log)"

# ---- What takes longer than one has patience for stays coarse until it is asked for.
view $'rest\ncheck\ntell first\nset method fbvh\nrest\ntell set\nwhole\ntell whole\ncompare divider\nrest\ntell two
other fbvh:exact\nrest\ntell other\nsave whole.png\ntell saved\nquit' scattered:500 "${size[@]}" --patience 0.0001
for word in first set two other; do
    grep -q "^$word: .* 60x45 of 320x240" log || complain "$word: not coarse: $(cat log)"
done
grep -q '^error: .*Return' log || complain "an error of a coarse picture: $(cat log)"
grep -q '^whole: .* 320x240 of 320x240' log || complain "not whole: $(cat log)"
[[ $(grep -c '^the whole picture .*Return draws it' log) -eq 4 ]] || complain "not told: $(cat log)"
render scattered:500 "${size[@]}" --method fbvh -o expected.png
same whole.png expected.png "what was coarse until it was saved"

# ---- While it moves the resolution drops, and comes back at rest.
view $'rest\nspin 1\nspin 1.5\nrest\ntell still\nquit' drop:20000 --size 800x600
moving=$(sed -n 's/^spin: .* at last \([0-9]*\)x.*/\1/p' log)
[[ ${moving:-800} -lt 800 ]] || complain "the resolution does not drop: $(cat log)"
grep -q '^still: .* 800x600 of 800x600' log || complain "the resolution does not come back: $(cat log)"

# ---- A scene tells what it cannot say, and takes no name that is not UTF-8.
view $'save left.json\nset look glass\nsave said.json\nquit' scattered:50 "${size[@]}" --method fbvh --tree no-fit --secant-steps 9
grep -q '^saved left.json without what a scene cannot say: --tree, --secant-steps' log || complain "not told: $(cat log)"
view $'set blend-mirror 0.25\nsave blend.png\nsave blend.json\nquit' tornado:100 "${size[@]}" --blend-by speed --blend-range 0:2 \
    --blend-color 0,0,0
render blend.json -o expected.png
same blend.png expected.png "a saved second material"
name=$'b\xe4r.csv'
printf '0,0,0\n' >"$name"
view $'save none.json\nsave some.png\nquit' "$name" "${size[@]}" --radius 1
grep -a -q -F 'a scene is UTF-8 text' log || complain "a name that JSON cannot hold: $(cat log)"
[[ -e some.png && ! -e none.json ]] || complain "saved a scene that names no file"

# ---- Shaders read again: a bad one is told, and the one before draws on.
mkdir glsl
cp "$source"/glsl/*.glsl glsl
sed -i 's/out_color = color/out_color = colour/' glsl/shade.frag.glsl
printf 'save before.png\nreload\nrest\nsave after.png\nquit\n' >script
"$program" view scattered:200 "${size[@]}" --glsl glsl --script script >log 2>errors || complain "reload: $(cat errors)"
grep -q '^error: shade.frag.glsl does not compile' log || complain "a bad shader is not told: $(cat log)"
same before.png after.png "a bad shader changed the picture"
exit $wrong
