#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Radiance's development after 6.0: flatcorr and corr of source.cal, now computed by rtrace itself, leave out the multiplier A1
# where it is the only number ("if (nrargs > 1)" in l_source_corr, src/rt/func.c). ies2rad writes flat luminaires just so, with
# 1 / area as the multiplier: a panel of 0.6 x 0.6 m gives 0.36 of its light. Boxes and cylinders have more numbers, and are right.
#
# Seen: commit bcffc2b5 of 2026-08-19 (VERSION: 6.1a), and right: 6.0.2. Needs git, cmake, ninja, a C and C++ compiler, libtiff-dev.
set -euo pipefail

expected='6.0.2: 100.0 lx of 100, bcffc2b5: 36.0 lx of 100'

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
git clone -q --no-checkout --filter=blob:none https://github.com/LBNL-ETA/Radiance source

# lux VERSION: below a panel of 0.6 x 0.6 m of 400 cd, 2 m away
lux() {
    mkdir "$1"
    git -C source archive "$1" CMakeLists.txt src | tar -x -C "$1"
    sed -i '/^add_subdirectory(InstallRules)/d; /^add_subdirectory(resources)/d; /^include(CPack)/d; /^file(COPY test/d' "$1/CMakeLists.txt"
    cmake -S "$1" -B "$1/build" -G Ninja -DBUILD_HEADLESS=ON -DCMAKE_BUILD_TYPE=Release >"$1/log" 2>&1 &&
        ninja -C "$1/build" ies2rad oconv rtrace >>"$1/log" 2>&1 || { tail "$1/log" >&2; exit 1; }
    export PATH=$folder/$1/build/bin:$PATH RAYPATH=.:$folder/$1/src/rt:$folder/$1/src/cv
    printf '%s\n' IESNA:LM-63-2002 TILT=NONE "1 -1 1 2 1 1 2 0.6 0.6 0" "1 1 10" "0 90" 0 "400 400" >panel.ies
    ies2rad -dm -t white -o panel panel.ies 2>>"$1/log"
    oconv panel.rad >panel.oct 2>>"$1/log"
    echo 0 0 -2 0 0 1 | rtrace -I+ -h -ab 0 -ds 0 panel.oct | awk '{ printf "%.1f", 179 * $2 }'
}
released=$(lux rad6R0P2)
developed=$(lux bcffc2b52d99b908adfdc2543e4cddf83268a125)
seen="6.0.2: $released lx of 100, bcffc2b5: $developed lx of 100"
echo "$seen"
[ "$seen" = "$expected" ] || { echo "changed: expected $expected" >&2; exit 1; }
