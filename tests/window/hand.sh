#!/usr/bin/env bash
# hand.sh PROGRAM: the window driven by a hand: mouse, wheel and keys as the window system gives them.
. "$(dirname "$(realpath "$0")")/lib.sh"

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

# ---- The panel and the divider by the mouse; a key that is held switches once; letters and signs as they are typed.
# told PATTERN WHAT: it is in the log, by and by.
told() {
    for _ in $(seq 100); do
        if grep -q -e "$1" log; then return; fi
        sleep 0.1
    done
    complain "$2: $(cat log)"
}
view $'panel\nquit' scattered:30 "${size[@]}"
panel=yes
! grep -q 'has no panel' log || panel=
setxkbmap fr 2>/dev/null || true # where M and Q are elsewhere
"$program" view scattered:500 --size 900x700 --eye 0.5,0.5,3 --look-at 0.5,0.5,0.5 >log 2>errors &
viewer=$!
window=$(timeout 20 xdotool search --sync --onlyvisible --name '^scattered:500' | head -n 1)
hand windowfocus "$window"
if [[ -n $panel ]]; then
    hand mousemove --window "$window" 80 44 click 1 # what there is for a method
    hand mousemove --window "$window" 80 85 click 1 # one below the first of them
    hand key ctrl+c
    told '--method=\(list\|reference\|tile\|fbvh\|bvh\) ' "the panel's method"
    grep -q -e '--eye=0.5,0.5,3 ' log || complain "a click on the panel moves the camera: $(cat log)"
    hand key Tab
fi
hand key b
hand mousemove --window "$window" 450 350 mousedown 1
hand mousemove_relative 100 0
hand mousemove_relative 80 0 mouseup 1
told '^divider at 0.700' "the divider does not follow the mouse"
hand keydown l
told '^the sequence' "a key does nothing"
sleep 1
hand keyup l
[[ $(grep -c '^the sequence' log) -eq 1 ]] || complain "a key that is held switches to and fro: $(cat log)"
hand key equal
hand key ctrl+c
told '--eye=0.5,0.5,2.5 ' "= does not zoom"
hand click 6 # two fingers go to the left
hand key ctrl+c
told '--eye=0.[0-46-9].*,0.5,2.5 ' "two fingers do not pan"
hand key m
told '^method: ' "a letter of another layout"
xdotool key ctrl+q
wait $viewer || complain "a mouse: status $?: $(cat errors log)"
! grep -q -e 'GL error' -e 'the driver gave' -e '^error' log || complain "a mouse: $(cat log)"
[[ ! -s errors ]] || complain "a mouse: $(cat errors)"
exit $wrong
