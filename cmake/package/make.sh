#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds the Debian packages and the tarball from the sources that this script is in.
#
# usage: make.sh BUILD OUT [CMAKE-OPTION...]
# BUILD is a folder for the build, OUT gets the packages. SOURCE_DATE_EPOCH in the environment is the date of everything in them;
# sources without a git repository need it.
set -euo pipefail
source=$(readlink -f "$(dirname "${BASH_SOURCE[0]}")/../..")
build=$1 out=$2
shift 2
mkdir -p "$out"

# Both packages are made of the same compiled files: only the folders and the library's search path differ.
configure() {
    cmake -S "$source" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DHOGEL_TESTS=OFF -DHOGEL_HARDENING=ON \
        "-DCMAKE_CXX_FLAGS=-ffile-prefix-map=$source=/usr/src/hogel -ffile-prefix-map=$build=/usr/src/hogel/build" "$@" >/dev/null
}

pack() {
    cmake --build "$build" --parallel "$(nproc)"
    (cd "$build" && cpack -B "$build/packages" >"$build/cpack.log") || { cat "$build/cpack.log"; exit 1; }
}

rm -rf "$build/packages"
configure "$@" -DHOGEL_PACKAGE=debian -DHOGEL_PYTHON=ON -DCMAKE_INSTALL_PREFIX=/usr "-DCMAKE_INSTALL_LIBDIR=lib/$(gcc -print-multiarch)"
pack
configure "$@" -DHOGEL_PACKAGE=tarball -DHOGEL_PYTHON=OFF -DCMAKE_INSTALL_PREFIX=/usr/local -DCMAKE_INSTALL_LIBDIR=lib
pack
mv "$build"/packages/*.deb "$build"/packages/*.tar.gz "$out"
