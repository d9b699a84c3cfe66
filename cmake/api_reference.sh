#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes the API reference in build/docs of the comments in the public headers. Comments that name what is not there fail it;
# names without a comment are counted.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
mkdir -p build/docs
doxygen cmake/doxygen.conf
bare='(is|are) not documented'
echo "$(grep -cE "$bare" build/docs/warnings.txt || true) public names without a comment: build/docs/warnings.txt"
if grep -vE "$bare|^  parameter" build/docs/warnings.txt; then
    echo "api_reference: the comments above are wrong" >&2
    exit 1
fi
echo "The reference is in $PWD/build/docs/html; begin with index.html"
