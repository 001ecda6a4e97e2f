#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# From an IFC to a picture with sun and luminaire, to lux on the desk and to hours of sun on the floor, all in FOLDER.
#
#     examples/buildings/house.sh [FOLDER] [PENUMBRA]
#
# Needs Debian's assimp-utils, whose importer reads IFC 2x3; ifc_to_glb.mjs beside this reads IFC 4, too.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
folder=${1:-out/house}
penumbra=$(realpath "${2:-$here/../../build/penumbra}")

command -v assimp >/dev/null || { echo "No assimp here: apt install assimp-utils" >&2; exit 3; }
mkdir -p "$folder"
assimp export "$here/house.ifc" "$folder/house.glb" -fglb2 >"$folder/assimp.log" || { cat "$folder/assimp.log" >&2; exit 3; }
cp "$here/house.lights.json" "$folder/"
cd "$folder"

sun=--sun=48.14,11.58,2026-03-20T13:30+01:00

"$penumbra" info house.glb --nodes='Ifc*'
# A camera of one's own: the model has none, and the one that it is given stands at the far wall.
"$penumbra" render house.glb $sun --look-from=4.7,1.6,-3.7 --look-at=1.9,0.9,-0.6 --size 960x540 -o house.png
"$penumbra" measure house.glb --surface='IfcFurnishingElement_Desk*' --grid 16x8 --csv desk.csv -o desk.png
"$penumbra" measure house.glb $sun --plane=0.05,0.01,-3.95,4.9,3.9 --grid 49x39 --over 08:00-18:00/10min --csv sun.csv -o sun.png
