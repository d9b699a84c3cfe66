#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Remakes the example streams of this folder after a change of the draft format: make.sh HOGEL
set -eu
hogel=$(realpath "$1")
out=$(realpath "$(dirname "$0")")
cd "$(mktemp -d)"
render() { "$hogel" render "$1" -o "$2" --size 6mm --directions "$4" --hogels "$3" "${@:5}" -q; }
pack() { "$hogel" compress "$1" -o "$out/$2.hgl" "${@:3}" -q; }
render pumpkin a.h5 6x5 21x12 --float
pack a.h5 hogel --sqnr 45 --tile 5x4
pack a.h5 threepass --coder threepass --transform cdf97 --sqnr 25
pack a.h5 ezw --coder ezw --transform ai33 --sqnr 25
pack a.h5 fringes --coder fringes --transform haar --sqnr 20
pack a.h5 jpeg4d --coder jpeg4d --sqnr 25
pack a.h5 table --coder jpeg4d --table jpeg --sqnr 20
pack a.h5 tone --tone histogram --tone-decades 1 --chrominance 2 --sqnr 30
render pumpkin p.h5 7x6 40x24
pack p.h5 partitions --sqnr 25
render sphere s.h5 3x2 10x12 --depth
pack s.h5 lossless --lossless --no-depth
pack s.h5 bounded --max-error 0.01 --no-depth
pack s.h5 depth --sqnr 30
render sphere cube.h5 3x3 16x16 --hemicube
pack cube.h5 unfolded --hemicube unfolded --sqnr 30
render pumpkin row.h5 9x20 24x1
pack row.h5 stacked --step 0.1 --tile 7x13
