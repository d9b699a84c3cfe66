#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Tries an installed program: check_hogel.sh HOGEL. Its libraries are there, and a small scene becomes photographs.
set -euo pipefail
hogel=$1
fail() { echo "check_hogel: $*" >&2; exit 1; }

if ldd "$hogel" | grep 'not found'; then fail "$hogel lacks a library"; fi
"$hogel" --version | grep -xE 'hogel [0-9]+\.[0-9]+\.[0-9]+' || fail "--version printed something else"
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
"$hogel" make pumpkin -o "$out/made" --size 1mm --hogels 20x20 --directions 16x16 --resolution 40 -q
for picture in left right high; do
    [ -s "$out/made/photo_${picture}_near.png" ] || fail "no photograph photo_${picture}_near.png"
done
"$hogel" compare "$out/made/photo_left_near.exr" "$out/made/photo_left_near_geometric.exr" --min-psnr 20 |
    grep psnr || fail "its photograph is not that of the scene"
