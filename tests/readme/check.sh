#!/bin/sh
# check.sh PROGRAM: the README says what the program's help says, its C is that of examples/, its scenes can be read.
set -eu
program=$1
cd "$(dirname "$(realpath "$0")")/../.."
wrong=0

complain() {
    echo "README.md: $*" >&2
    wrong=1
}

options() {
    grep -o -e '--[a-z][a-z-]*' | sort -u
}

help=$(for command in render view compare verify info; do "$program" $command --help; done | options)
told=$(options <README.md)
for option in $help; do
    echo "$told" | grep -qx -e "$option" || complain "$option is not in it"
done
# What is told in a table of options must be one.
for option in $(grep '^| `-' README.md | options); do
    echo "$help" | grep -qx -e "$option" || complain "$option is in a table, and no option"
done

# Each line of its C stands in an example.
missing=$(sed -n '/^```c$/,/^```$/p' README.md | grep -v '^```' | grep -vFx -f examples/host.c -f examples/host_overlay.c) || true
[ -z "$missing" ] || complain "not in examples/: $missing"
grep -q '^```c$' README.md || complain "no C in it"

# Keys of a scene, as a wrong one is answered.
scene=${TMPDIR:-/tmp}/readme.$$.json
for part in '{"?":1}' '{"field":{"?":1}}' '{"camera":{"?":1}}' '{"light":{"?":1}}' '{"material":{"?":1}}' '{"effects":{"?":1}}' '{"lights":[{"?":1}]}' '{"blend":{"?":1}}'; do
    echo "$part" >"$scene"
    for key in $("$program" info "$scene" 2>&1 | sed -n 's/.*known: //p' | tr -d ,); do
        grep -q "[\`.]$key\(\`\|\.\)" README.md || complain "the scene's key $key is not in it"
    done
done
rm -f "$scene"

for example in examples/*.json; do
    "$program" info "$example" >/dev/null || complain "$example cannot be read"
done

# Links to what is here.
for target in $(grep -o '](\([^)h#][^)]*\))' README.md | tr -d '()]'); do
    [ -e "$target" ] || complain "no $target"
done
exit $wrong
