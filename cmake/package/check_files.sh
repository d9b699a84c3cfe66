#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What can be seen without installing: hardening of the binaries, no path of the build in them, no file of a package in another.
# check_files.sh FOLDER PATH-OF-THE-BUILD
set -euo pipefail
packages=$(readlink -f "$1")
built_in=$2
fail() { echo "check_files: $*" >&2; exit 1; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

for deb in "$packages"/*.deb; do
    dpkg-deb -x "$deb" "$work/debs"
    dpkg-deb -c "$deb" | awk '$6 !~ /\/$/ { print $6 }'
done | sort | uniq -d >"$work/twice"
[ ! -s "$work/twice" ] || fail "in two packages: $(cat "$work/twice")"
mkdir "$work/tarball"
tar -C "$work/tarball" --strip-components=1 -xzf "$packages"/hogel-*.tar.gz

for page in "$work"/debs/usr/share/man/man1/hogel{,-make}.1.gz "$work"/tarball/share/man/man1/hogel{,-make}.1.gz; do
    [ -s "$page" ] || fail "no manual page $page"
done

# hardened FILE: what dpkg-buildflags asks for is in it.
hardened() {
    local dynamic symbols
    readelf -lW "$1" | grep -q GNU_RELRO || fail "$1: no read-only relocations"
    dynamic=$(readelf -dW "$1")
    grep -qE 'BIND_NOW|Flags:.* NOW' <<<"$dynamic" || fail "$1: no immediate binding"
    symbols=$(readelf --dyn-syms -W "$1")
    grep -q __stack_chk_fail <<<"$symbols" || fail "$1: no stack protector"
    case $1 in
        */_core.*) ;;  # the Python module calls none of the functions that have fortified twins
        *) grep -qE '__(memcpy|memmove|memset|snprintf|vsnprintf|fprintf|printf|read|strcpy)_chk' <<<"$symbols" || fail "$1: not fortified" ;;
    esac
    readelf -hW "$1" | grep -q 'DYN (' || fail "$1: not position independent"
}

for file in "$work"/debs/usr/bin/hogel* "$work"/debs/usr/lib/*/libhogel.so.*.*.* "$work"/debs/usr/lib/python3/dist-packages/hogel/_core.*.so "$work"/tarball/bin/hogel* \
    "$work"/tarball/lib/libhogel.so.*.*.*; do
    hardened "$file"
done
if readelf -dW "$work"/debs/usr/bin/hogel* "$work"/debs/usr/lib/*/libhogel.so.*.*.* \
    "$work"/debs/usr/lib/python3/dist-packages/hogel/_core.*.so | grep -E 'RPATH|RUNPATH'; then
    fail "a Debian package says where libraries are"
fi
if grep -rlF "$built_in" "$work"; then fail "the files above name $built_in"; fi
echo "hardened, and without a path of the build: $(cd "$packages" && echo *.deb *.tar.gz)"
