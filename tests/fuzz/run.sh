#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs every fuzz target over its seeds, for so many seconds each. What a target finds lies in build/fuzz, beside its corpus.
#
# usage: run.sh SECONDS     in the project's folder, with build/release/bin/hogel, and build/fuzz configured
set -euo pipefail
targets=(tests/fuzz/*_fuzz.cpp)
targets=("${targets[@]##*/}")
targets=("${targets[@]%.cpp}")
cmake --build build/fuzz --target "${targets[@]}"
# h5py is the distribution's Python's.
/usr/bin/python3 tests/fuzz/make_seeds.py build/release/bin/hogel build/fuzz/corpus
for target in "${targets[@]}"; do
    printf '\n==> Fuzzing %s\n' "$target"
    # Leaks are those of libraries: tests look for hogel's own. A child process that ends by an error leaves an empty file,
    # because it may write none.
    ASAN_OPTIONS=detect_leaks=0 "build/fuzz/bin/$target" -max_total_time="$1" -detect_leaks=0 -timeout=60 -print_final_stats=1 \
        -artifact_prefix="build/fuzz/$target-" "build/fuzz/corpus/$target"
    find build/fuzz -maxdepth 1 -name "$target-*" -empty -delete
done
