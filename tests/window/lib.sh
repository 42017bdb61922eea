# What the checks of the window share: a virtual display, a folder of their own, and how to open it and compare. Sourced by
# CHECK.sh PROGRAM; status 77 where there is no display, or no hand (xdotool). What the window saves is compared, byte by
# byte, with what `render` draws through a GLFW context too.
set -euo pipefail
program=$(realpath "$1")
difference=${2:+$(realpath "$2")} # the program that compares one with two renders; none: that is left out
for tool in Xvfb xdotool; do
    command -v $tool >/dev/null || { echo "skipped: no $tool"; exit 77; }
done
source=$(dirname "$(realpath "$0")")/../..
folder=$(mktemp -d)
export XDG_CACHE_HOME=$folder/cache TMPDIR=$folder
wrong=0
size=(--size 320x240)
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
