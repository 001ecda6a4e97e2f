#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The example of a house from an IFC does what its page says: buildings_test.sh SOURCE_FOLDER PENUMBRA
set -euo pipefail
source=$1 penumbra=$2
command -v assimp >/dev/null || { echo "assimp (assimp-utils) is missing: nothing converts the house"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "$*" >&2; exit 1; }
# column NAME FILE.csv: its largest number
largest() { awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) at = i }
                                  NR > 1 && $at > most { most = $at } END { print most + 0 }' "$2"; }

"$source/examples/buildings/house.sh" "$folder" "$penumbra" >"$folder/log" 2>&1 || { cat "$folder/log"; fail "house.sh failed"; }
grep -q "2 panes of glass" "$folder/log" || fail "the panes are not named"
for file in house.png desk.png sun.png; do [ -s "$folder/$file" ] || fail "$file is missing"; done

# In closed form there are 718.3 lx below the panel's middle, 1.598 m over the desk, and little less 7 cm beside it.
awk -v lux="$(largest lux "$folder/desk.csv")" 'BEGIN { exit !(lux > 711 && lux < 718.3) }' || fail "the desk has other lux"

hours() { largest sun_hours "$1"; }
awk -v h="$(hours "$folder/sun.csv")" 'BEGIN { exit !(h > 3 && h < 8) }' || fail "the sun comes in for $(hours "$folder/sun.csv") h"
cd "$folder"
"$penumbra" -q measure house.glb --glass blocks --sun=48.14,11.58,2026-03-20T13:30+01:00 --plane=0.05,0.01,-3.95,4.9,3.9 \
    --grid 25x20 --over 08:00-18:00/1h --csv walled.csv >/dev/null
[ "$(hours walled.csv)" = 0 ] || fail "the sun comes through panes that block it"
