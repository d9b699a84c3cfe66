#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes the packages of the last commit twice, compares them byte for byte, and tries them in clean systems.
#
# usage: run.sh WORK NEEDED [--clean-build]
# WORK is a folder that is emptied; the packages and SHA256SUMS are left there. The second time is a build here in a folder with
# another name, or with --clean-build one in a clean system, which gets the packages NEEDED, separated by commas: those of the
# sections at the top and [package] of packages.txt.
set -euo pipefail
sources=$(readlink -f "$(dirname "${BASH_SOURCE[0]}")/../..")
work=$1
needed=$2
clean_build=${3:-}
[ -z "$clean_build" ] || [ "$clean_build" = --clean-build ] || { echo "run: knows --clean-build, not $clean_build" >&2; exit 2; }
say() { printf '\n==> %s\n' "$*"; }
launcher=()
if command -v ccache >/dev/null; then launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache); fi
as_root=()
if [ "$(id -u)" != 0 ]; then as_root=(sudo); fi

SOURCE_DATE_EPOCH=${SOURCE_DATE_EPOCH:-$(git -C "$sources" log -1 --format=%ct)}
export SOURCE_DATE_EPOCH

# export_to FOLDER: the sources as they were committed, and nothing else.
export_to() {
    mkdir -p "$1"
    git -C "$sources" archive HEAD | tar -x -C "$1"
}

# in_clean_system PACKAGES HOOK...: Debian 12 with these packages besides the essential ones, gone when the hooks have run.
in_clean_system() {
    local include=$1 hook hooks=()
    shift
    for hook in "$@"; do hooks+=("--customize-hook=$hook"); done
    "${as_root[@]}" mmdebstrap --quiet --variant=minbase --format=null ${include:+--include="$include"} "${hooks[@]}" bookworm /dev/null
}

rm -rf "$work"
mkdir -p "$work"
work=$(readlink -f "$work")

say "Building the packages of $(git -C "$sources" describe --always)"
export_to "$work/sources"
"$work/sources/cmake/package/make.sh" "$work/sources/build/package" "$work/first" "${launcher[@]}"

if [ -n "$clean_build" ]; then
    say "Building them again in a clean system"
    mkdir "$work/second"
    export_to "$work/elsewhere/sources"
    in_clean_system "$needed" "copy-in $work/elsewhere/sources /opt" \
        "chroot \"\$1\" env SOURCE_DATE_EPOCH=$SOURCE_DATE_EPOCH /opt/sources/cmake/package/make.sh /opt/sources/build/again /opt/packages" \
        "sync-out /opt/packages $work/second"
else
    say "Building them again in another folder"
    export_to "$work/elsewhere/with-a-longer-name/sources"
    "$work/elsewhere/with-a-longer-name/sources/cmake/package/make.sh" \
        "$work/elsewhere/with-a-longer-name/sources/build/again" "$work/second" "${launcher[@]}"
fi
(cd "$work/first" && sha256sum -- *) | tee "$work/SHA256SUMS"
# The table of libraries in the tarball, with the versions of their packages.
carried() { tar -xzOf "$1"/hogel-*.tar.gz --wildcards '*/licences/README.txt'; }
if ! (cd "$work/second" && sha256sum --quiet -c "$work/SHA256SUMS"); then
    diff <(carried "$work/first") <(carried "$work/second") ||
        echo "run: this system and the clean one have the versions above of libraries that the tarball brings; upgrade this one" >&2
    echo "run: the second time gave other bytes" >&2
    exit 1
fi
say "Twice the same bytes"

"$sources/cmake/package/check_files.sh" "$work/first" "$work"
if command -v lintian >/dev/null; then lintian --fail-on error "$work"/first/*.deb; fi
say "Trying them in a clean system"
export_to "$work/tests"
# shellcheck disable=SC2016  # $1 is mmdebstrap's
in_clean_system "" "copy-in $work/tests $work/first /opt" \
    'chroot "$1" /opt/tests/cmake/package/check_tarball.sh /opt/first' \
    'chroot "$1" /opt/tests/cmake/package/check_debs.sh /opt/first /opt/tests'

mv "$work"/first/* "$work"
rm -rf "$work/first" "$work/second" "$work/elsewhere" "$work/tests"
say "The packages are in $work"
