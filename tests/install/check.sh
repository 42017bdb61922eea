#!/bin/sh
# Installs to a folder of its own, moves that folder, and builds and runs host.c against it in both ways. The test's
# environment (cmake/install.cmake) says which build, which compiler and which flags. Then the hosts of examples/, which
# the README shows: where the installed program can draw, so must they.
set -eu
here=$(dirname "$(realpath "$0")")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

expect_100_balls() {
    said=$("$@")
    if [ "$said" != "100 balls" ]; then
        echo "$1 said '$said', expected '100 balls'" >&2
        exit 1
    fi
}

"$CMAKE" --install "$BUILD" --prefix "$work/first" >/dev/null
mv "$work/first" "$work/prefix"
prefix=$work/prefix
ls "$prefix/include/meniscus.h" "$prefix/$LIBDIR/libmeniscus.so" >/dev/null

PKG_CONFIG_PATH=$prefix/$LIBDIR/pkgconfig
export PKG_CONFIG_PATH
# shellcheck disable=SC2046,SC2086 # flags are words
"$CC" ${HOST_FLAGS-} "$here/host.c" -o "$work/host" $(pkg-config --cflags --libs meniscus) \
    -Wl,-rpath,"$prefix/$LIBDIR"
expect_100_balls "$work/host"

"$CMAKE" -S "$here" -B "$work/build" -G "$GENERATOR" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_C_COMPILER="$CC" \
    -DCMAKE_C_FLAGS="${HOST_FLAGS-}" >/dev/null
"$CMAKE" --build "$work/build" >/dev/null
expect_100_balls "$work/build/host"


examples=$here/../../examples
# shellcheck disable=SC2046,SC2086
"$CC" -std=c11 -Wall -Wextra -Werror ${HOST_FLAGS-} "$examples/host.c" -o "$work/drawing" \
    $(pkg-config --cflags --libs meniscus) -Wl,-rpath,"$prefix/$LIBDIR"
# shellcheck disable=SC2046,SC2086
"$CC" -std=c11 -Wall -Wextra -Werror ${HOST_FLAGS-} -c "$examples/host_overlay.c" -o "$work/overlay.o" \
    $(pkg-config --cflags meniscus)
cd "$work"
if "$prefix/$BINDIR/meniscus" render scattered:10 -o drawn.png --size 16x12; then
    ./drawing
    [ -s host.png ] || { echo "examples/host.c left no host.png" >&2; exit 1; }
fi
"$prefix/$BINDIR/meniscus" --version
