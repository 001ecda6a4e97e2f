#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Draco as Debian 13 packages it (libdraco-dev 1.5.6): its pkg-config file names its folders relative to the folder that the
# compiler is started in, "-Iinclude -Llib/x86_64-linux-gnu", where Debian 12's (1.5.5) has -I/usr/include. Compilers find
# draco nevertheless, since /usr/include is looked through anyway; CMake's pkg_check_modules(DRACO IMPORTED_TARGET draco)
# does not generate, since the folder does not exist. Draco's own CMake package is right in both: find_package(draco),
# draco::draco.
#
# Seen: libdraco-dev 1.5.6+dfsg-3+b3, pkg-config 1.8.1, CMake 3.25 and 3.31. Needs apt, dpkg, pkg-config, cmake, a compiler.
set -euo pipefail

version=1.5.6+dfsg-3+b3
expected='-Iinclude -Llib/x86_64-linux-gnu -ldraco'

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mirror=$(apt-get indextargets --format '$(SITE)' 'Created-By: Packages' 'Label: Debian' | head -n 1)
echo "deb ${mirror:-https://deb.debian.org/debian} trixie main" >sources.list
mkdir -p state/lists/partial cache/archives/partial
apt=(-o Dir::State="$folder/state" -o Dir::Cache="$folder/cache" -o Dir::Etc::SourceList="$folder/sources.list"
    -o Dir::Etc::SourceParts=/dev/null -o APT::Sandbox::User=root -qq)
apt-get "${apt[@]}" update
apt-get "${apt[@]}" download "libdraco-dev=$version"
dpkg-deb -x libdraco-dev_*.deb root

export PKG_CONFIG_LIBDIR=$folder/root/usr/lib/x86_64-linux-gnu/pkgconfig PKG_CONFIG_ALLOW_SYSTEM_CFLAGS=1
flags=$(pkg-config --cflags --libs draco | sed 's/ *$//')
echo "pkg-config --cflags --libs draco: $flags"
[ "$flags" = "$expected" ] || { echo "changed: expected $expected" >&2; exit 1; }

mkdir project
cat >project/CMakeLists.txt <<'END'
cmake_minimum_required(VERSION 3.25)
project(uses_draco CXX)
find_package(PkgConfig REQUIRED)
pkg_check_modules(DRACO REQUIRED IMPORTED_TARGET draco)
add_executable(a a.cpp)
target_link_libraries(a PRIVATE PkgConfig::DRACO)
END
echo 'int main() {}' >project/a.cpp
if cmake -S project -B build >log 2>&1; then
    echo "changed: CMake generates" >&2
    exit 1
fi
grep -q 'includes non-existent path' log || { cat log >&2; exit 1; }
echo 'CMake: imported target "PkgConfig::DRACO" includes non-existent path "include"'
