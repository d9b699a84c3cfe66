#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the Debian packages in this system, which should be a clean one, tries them, builds a program with them and removes
# them: check_debs.sh FOLDER SOURCES. As root.
set -euo pipefail
here=$(readlink -f "$(dirname "${BASH_SOURCE[0]}")")
packages=$(readlink -f "$1")
sources=$(readlink -f "$2")
fail() { echo "check_debs: $*" >&2; exit 1; }
export DEBIAN_FRONTEND=noninteractive
install() { apt-get -q -y -o Acquire::Retries=3 install --no-install-recommends "$@" >/tmp/apt.log 2>&1 || { cat /tmp/apt.log; fail "apt-get install $*"; }; }

install "$packages"/hogel_*.deb "$packages"/libhogel[0-9]*.deb
"$here/check_hogel.sh" /usr/bin/hogel
[ ! -e /usr/include/hogel ] || fail "hogel brings headers"

install "$packages"/libhogel-dev_*.deb g++ cmake make pkg-config
work=$(mktemp -d)
cmake -S "$sources/tests/install" -B "$work/found" >/dev/null
cmake --build "$work/found" >"$work/log" 2>&1 || { cat "$work/log"; fail "a project that finds hogel by CMake does not build"; }
"$work/found/uses_hogel"
# shellcheck disable=SC2046  # they are several words
g++ -std=c++20 "$sources/tests/install/main.cpp" -o "$work/pkg" $(pkg-config --cflags --libs hogel)
"$work/pkg"

install "$packages"/python3-hogel_*.deb
(cd "$work" && python3 "$sources/cmake/package/check_python.py")

apt-get -q -y purge python3-hogel hogel libhogel-dev "$(dpkg-query -W -f '${Package}\n' 'libhogel[0-9]*' | head -n 1)" >/tmp/apt.log 2>&1 ||
    { cat /tmp/apt.log; fail "apt-get purge"; }
left=$(find /usr -path '*hogel*' ! -path '*/hogweed*' | head)
[ -z "$left" ] || fail "left behind: $left"
echo "the Debian packages: installed, used, built with and removed"
