#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The README's two commands on a bare Debian of today: ./dev test --in bookworm|trixie
# The root is made by debootstrap from the mirror that this machine's apt uses, gets a clean clone of the last commit and
# nothing else, and is removed afterwards.
set -euo pipefail
cd "$(dirname "$0")/../.."

suite=${1:-}
[[ $suite =~ ^[a-z]+$ ]] || { echo "./dev test --in SUITE, for instance bookworm or trixie" >&2; exit 2; }
[ "$(id -u)" -eq 0 ] || { echo "debootstrap and chroot need root: sudo ./dev test --in $suite" >&2; exit 1; }
command -v debootstrap >/dev/null || { echo "debootstrap is missing: apt-get install debootstrap" >&2; exit 1; }

mirror=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' 'Label: Debian' | head -n 1)
[ -n "$mirror" ] || { echo "apt knows no Debian mirror: see /etc/apt/sources.list, then apt-get update" >&2; exit 1; }

root=$(mktemp -d "${TMPDIR:-/var/tmp}/penumbra-$suite-XXXXXX")
chmod 755 "$root"  # apt fetches as a user of its own
trap 'umount -l "$root/proc" "$root/dev" 2>/dev/null || true; rm -rf --one-file-system "$root"' EXIT
trap 'exit 130' INT TERM
debootstrap --variant=minbase "$suite" "$root" "$mirror" >"$root.log" 2>&1 ||
    { tail -n 20 "$root.log" >&2; exit 1; }
rm "$root.log"
mount -t proc proc "$root/proc"
mount --rbind /dev "$root/dev"
mount --make-rslave "$root/dev"
# How this machine reaches its mirror holds inside, too.
apt-config dump Acquire | grep -iE '::proxy|::check-' >"$root/etc/apt/apt.conf.d/90host" || true
git -c safe.directory='*' clone -q --no-hardlinks . "$root/root/penumbra"

commands() {
    local began
    for command in demo test; do
        began=$SECONDS
        echo "$suite: ./dev $command"
        chroot "$root" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 \
            bash -c "cd ~/penumbra && ./dev $command" || { echo "$suite: ./dev $command failed" >&2; return 1; }
        echo "$suite: ./dev $command took $((SECONDS - began)) s"
    done
}
commands
