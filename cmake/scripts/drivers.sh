#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The tests that draw, on every OpenGL driver of this machine: ./dev drivers [CTEST ARGUMENT ...]
# Writes out/drivers.md, a row a driver: what it calls itself, when, how many tests passed, which did not. Debian's other
# Mesa is in a fresh root: ./dev test --in SUITE.
set -euo pipefail
cd "$(dirname "$0")/../.."

rooms=$(for room in src/techniques/*/*_test.cpp; do basename "$(dirname "$room")"; done | sort -u)
labels="^($(printf '%s|' $rooms contract properties host library gl geometry steady_state frame | sed 's/|$//'))_test$"
mkdir -p out
{
    echo "| driver | day | passed | failed |"
    echo "| --- | --- | ---: | --- |"
} >out/drivers.md

# on NAME VARIABLE=VALUE ...
on() {
    local name=$1
    shift
    local renderer
    renderer=$(env "$@" build/penumbra list devices | grep -v 'not usable' | head -n 1 | sed 's/^[0-9]* *//') || true
    if [ -z "$renderer" ]; then
        echo "| $name | $(date -I) | – | does not start |" >>out/drivers.md
        return
    fi
    echo "$name: $renderer"
    env "$@" ctest --test-dir build -L "$labels" -j "$(nproc)" --timeout 3600 "${arguments[@]}" >"out/drivers.$name.log" || true
    local failed
    failed=$(sed -n 's/^\t *[0-9]* - \(.*\) (.*/\1/p' "out/drivers.$name.log" | paste -sd ' ')
    echo "| $renderer | $(date -I) | $(sed -n 's/^100% tests passed.*out of \([0-9]*\)$/\1/p
        s/^\([0-9]*\)% tests passed, \([0-9]*\) tests failed out of \([0-9]*\)$/\3 less \2/p' "out/drivers.$name.log") | ${failed:-–} |" \
        >>out/drivers.md
}

arguments=("$@")
on default -u GALLIUM_DRIVER
on llvmpipe LIBGL_ALWAYS_SOFTWARE=1 GALLIUM_DRIVER=llvmpipe
on zink LIBGL_ALWAYS_SOFTWARE=1 GALLIUM_DRIVER=zink
cat out/drivers.md
