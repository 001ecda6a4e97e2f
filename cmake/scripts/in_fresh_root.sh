#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# On a bare Debian of today: ./dev test --in SUITE, the README's two commands; ./dev package --in SUITE, packages made there,
# and installed and used in another root that is as bare.
# Roots are made by debootstrap from the mirror that this machine's apt uses, get a clean clone of the last commit, or the
# packages, and nothing else, and are removed afterwards.
set -euo pipefail
cd "$(dirname "$0")/../.."

what=test
[ "${1:-}" = --packages ] && what=package && shift
suite=${1:-}
[[ $suite =~ ^[a-z]+$ ]] || { echo "./dev $what --in SUITE, for instance bookworm or trixie" >&2; exit 2; }
[ "$(id -u)" -eq 0 ] || { echo "debootstrap and chroot need root: sudo ./dev $what --in $suite" >&2; exit 1; }
command -v debootstrap >/dev/null || { echo "debootstrap is missing: apt-get install debootstrap" >&2; exit 1; }

mirror=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' 'Label: Debian' | head -n 1)
[ -n "$mirror" ] || { echo "apt knows no Debian mirror: see /etc/apt/sources.list, then apt-get update" >&2; exit 1; }

roots=$(mktemp -d "${TMPDIR:-/var/tmp}/penumbra-$suite-XXXXXX")
chmod 755 "$roots"  # apt fetches as a user of its own
clean() {
    for root in "$roots"/*; do umount -l "$root/proc" "$root/dev" 2>/dev/null || true; done
    rm -rf --one-file-system "$roots"
}
trap clean EXIT
trap 'exit 130' INT TERM

# make_root NAME: in $roots/NAME
make_root() {
    local root=$roots/$1
    debootstrap --variant=minbase "$suite" "$root" "$mirror" >"$root.log" 2>&1 ||
        { tail -n 20 "$root.log" >&2; exit 1; }
    mount -t proc proc "$root/proc"
    mount --rbind /dev "$root/dev"
    mount --make-rslave "$root/dev"
    # How this machine reaches its mirror holds inside, too.
    apt-config dump Acquire | grep -iE '::proxy|::check-' >"$root/etc/apt/apt.conf.d/90host" || true
}

# within NAME COMMAND: run by bash in that root, in root's home
within() {
    local began=$SECONDS
    echo "$suite: $2"
    chroot "$roots/$1" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 bash -ec "cd; $2" ||
        { echo "$suite: $2 failed" >&2; exit 1; }
    echo "$suite: it took $((SECONDS - began)) s"
}

make_root build
git -c safe.directory='*' clone -q --no-hardlinks . "$roots/build/root/penumbra"
if [ $what = test ]; then
    within build "cd penumbra && ./dev demo"
    within build "cd penumbra && ./dev test"
    exit
fi
within build "cd penumbra && ./dev package"
make_root use
cp "$roots"/build/root/penumbra/build-package/*.deb "$roots/use/root/"
within use "apt-get update -qq && DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends ./*.deb >/dev/null"
within use "penumbra render /usr/share/doc/penumbra-doc/examples/office/office.gltf --size 64x36 -o office.png && ls -l office.png"
within use "python3 -c 'import penumbra; print(penumbra.__version__, penumbra.Renderer().device)'"
within use "DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends g++ pkg-config libegl-dev libpng-dev >/dev/null
    c++ -std=c++20 /usr/share/doc/penumbra-doc/examples/minimal/minimal.cpp -o minimal \$(pkg-config --cflags --libs penumbra epoxy libpng)
    ./minimal minimal.png && ls -l minimal.png"
within use "apt-get purge -y -qq penumbra 'libpenumbra*' >/dev/null && ! command -v penumbra"
