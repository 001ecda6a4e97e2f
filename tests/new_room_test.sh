#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What ./dev room writes compiles as it is, and so does the example of a room in its place: new_room_test.sh SOURCE_FOLDER COMPILER
set -euo pipefail
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
cp -r "$1"/{cmake,include,src} "$copy"
cd "$copy"
cmake/scripts/new_room.sh variance_map variance
room=src/techniques/variance_map
for whose in made example; do
    [ $whose = made ] || cp "$1"/examples/variance_map/* $room
    for file in "$room/variance.cpp" src/catalog.cpp; do
        "$2" -std=c++20 -fsyntax-only -Wall -Wextra -Werror -I. -Iinclude "$file"
    done
    if glslang=$(command -v glslangValidator); then
        for shader in "$room"/*.comp.glsl; do
            cmake -DGLSLANG="$glslang" -DSTAGE=comp -DFILE="$copy/$shader" -DROOT="$copy" -DSTAMP="$copy/checked" \
                -P cmake/check_shader.cmake
        done
    fi
done
