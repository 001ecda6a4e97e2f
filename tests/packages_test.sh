#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The Debian packages of a build: lintian has nothing to say of them but what is overridden with a reason, they hold what
# they should, and what they hold works: packages_test.sh BUILD_FOLDER
set -euo pipefail
build=$1
for program in cpack dpkg-deb dpkg-shlibdeps lintian; do
    command -v $program >/dev/null || { echo "$program is missing: packages are not tested"; exit 77; }
done
grep -qxF CMAKE_INSTALL_PREFIX:PATH=/usr "$build/CMakeCache.txt" ||
    { echo "this build is not for packages (CMAKE_INSTALL_PREFIX=/usr): ./dev package makes and tests them"; exit 77; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() { echo "$*" >&2; exit 1; }

cpack -G DEB --config "$build/CPackConfig.cmake" -B "$folder" >cpack.log 2>&1 || { cat cpack.log; fail "cpack failed"; }
packages=(*.deb)
[ ${#packages[@]} -ge 4 ] || fail "packages are missing: ${packages[*]}"

# As root lintian only warns of that; a maintainer must be none, unless one is named.
lintian --allow-root --fail-on error,warning "${packages[@]}" || fail "lintian has something to say"

root=$folder/root
for package in "${packages[@]}"; do dpkg-deb -x "$package" "$root"; done
for file in applications/penumbra.desktop icons/hicolor/scalable/apps/penumbra.svg penumbra/lights.schema.json \
    penumbra/json.schema.json man/man1/penumbra.1.gz bash-completion/completions/penumbra \
    doc/penumbra-doc/{README.md,CHANGELOG.md,docs/manual/measuring.md,docs/pictures/measure-sun.png} \
    doc/penumbra-doc/examples/{minimal/minimal.cpp,python/sweep.py,office/office.gltf}; do
    [ -s "$root/usr/share/$file" ] || fail "/usr/share/$file is missing"
done
if command -v desktop-file-validate >/dev/null; then
    desktop-file-validate "$root/usr/share/applications/penumbra.desktop"
fi

"$root/usr/bin/penumbra" render "$root/usr/share/doc/penumbra-doc/examples/office/office.gltf" --size 32x18 -o picture.png
[ -s picture.png ] || fail "no picture"
"$root/usr/bin/penumbra" list parameters --json >parameters.json
[ -s parameters.json ] || fail "no parameters"
if ls python3-penumbra*.deb >/dev/null 2>&1; then
    PYTHONPATH=$root/usr/lib/python3/dist-packages /usr/bin/python3 -c '
import penumbra
frame = penumbra.Renderer().render(penumbra.open_scene("two-boxes"), "hard", size=(32, 18))
assert 0 < frame.visibility[frame.lights[0]].mean() < 1'
fi
