#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Tries the tarball in a system that has none of hogel's libraries: check_tarball.sh FOLDER, which holds hogel-*.tar.gz.
set -euo pipefail
here=$(readlink -f "$(dirname "${BASH_SOURCE[0]}")")
tarball=$(readlink -f "$1"/hogel-*.tar.gz)
fail() { echo "check_tarball: $*" >&2; exit 1; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# A folder with a space in its name, moved after unpacking, because a relocatable archive bears that.
mkdir "$work/unpacked" "$work/a folder"
tar -C "$work/unpacked" -xzf "$tarball"
mv "$work"/unpacked/* "$work/a folder/hogel"
hogel="$work/a folder/hogel"
for file in "$hogel"/bin/hogel* "$hogel"/lib/*.so*; do
    if ldd "$file" | grep 'not found'; then fail "$file lacks a library"; fi
done
outside=$(ldd "$hogel/bin/hogel" | awk '$2 == "=>" { print $1, $3 }' | grep -v ' /tmp/' | cut -d' ' -f1 |
    grep -vE '^lib(c|m|dl|rt|pthread|resolv|gcc_s|stdc\+\+)\.so\.[0-9]+$' || true)
[ -z "$outside" ] || fail "takes from the system: $outside"
[ -s "$hogel/share/doc/hogel/licences/README.txt" ] || fail "has no licences"
"$here/check_hogel.sh" "$hogel/bin/hogel"
echo "the tarball: $(find "$hogel/lib" -name '*.so.*' -type f | wc -l) libraries, $(du -sm "$hogel" | cut -f1) MB unpacked"
