#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What ./dev room writes compiles as it is: new_room_test.sh SOURCE_FOLDER COMPILER
set -euo pipefail
copy=$(mktemp -d)
trap 'rm -rf "$copy"' EXIT
cp -r "$1"/{cmake,include,src} "$copy"
cd "$copy"
cmake/scripts/new_room.sh variance_map variance
room=src/techniques/variance_map
for file in "$room/variance.cpp" src/catalog.cpp; do
    "$2" -std=c++20 -fsyntax-only -Wall -Wextra -Werror -I. -Iinclude "$file"
done
if glslang=$(command -v glslangValidator); then
    cmake -DGLSLANG="$glslang" -DSTAGE=comp -DFILE="$copy/$room/variance.comp.glsl" -DROOT="$copy" \
        -DSTAMP="$copy/checked" -P cmake/check_shader.cmake
fi
