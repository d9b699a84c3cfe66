#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Makes the files that check_like.py tries every command with, in the current folder.
set -e
printf 'o back\nv -4e-4 -4e-4 -1e-4\nv 4e-4 -4e-4 -1e-4\nv 4e-4 4e-4 -3e-4\nv -4e-4 4e-4 -3e-4\nf 1 2 3\nf 1 3 4\no front\nv -2e-4 -2e-4 4e-5\nv 2e-4 -2e-4 1e-4\nv 4e-5 3e-4 8e-5\nf 5 7 6\no side\nv -4e-4 4e-5 1e-4\nv -1e-4 8e-5 -8e-5\nv -2e-4 4e-4 4e-5\nf 8 9 10\n' > m.obj

# Runs each command that its lines name, all at the same time.
together() {
    running=
    while read -r line; do
        hogel $line -q < /dev/null &
        running="$running $!"
    done
    for one in $running; do wait "$one"; done
}

together << END
render m.obj -o x.h5 --hogels 6x4 --directions 8x6 --size 0.5mm
render m.obj -o deep.h5 --hogels 6x4 --directions 24x24 --size 0.15mm --depth
render m.obj -o row.h5 --hogels 6x4 --directions 8x1 --size 1mm
render m.obj -o low.h5 --hogels 6x2 --directions 8x1 --size 1mm
render m.obj -o five.h5 --hogels 6x4 --directions 8x8 --size 1mm --hemicube
render sphere -o wide.h5 --hogels 40x36 --directions 8x6 --size 4mm
hologram m.obj -o s.h5 --hogels 4x3 --directions 12x12 --size 0.8192mm --pitch 6.4um --fov 0.4deg --wavelength 633nm
END
together << END
compress x.h5 -o x.hgl
compress x.h5 -o exact.hgl --lossless
compress x.h5 -o fringes.hgl --coder fringes --transform haar
hologram x.h5 -o f.h5 --wavelength 532nm --pitch 1.6um
hologram low.h5 -o lines.h5 --wavelength 532nm --pitch 1.6um --method lines --line-pitch 8um
export wide.h5 -o views --layout numbered
export wide.h5 -o ordered
END
together << END
propagate f.h5 -o f.npy --distance 0mm
propagate f.h5 -o f.npz --distance 0mm
slm s.h5 -o pattern.png --encoding phase --pixels 128x96 --pixel-pitch 6.4um
propagate f.h5 -o real.exr --distance 1mm --display amplitude
propagate f.h5 -o imaginary.exr --distance 2mm --display amplitude
propagate f.h5 -o other.exr --distance 3mm --display amplitude
propagate f.h5 -o re.png --distance 1mm --display amplitude
propagate f.h5 -o im.png --distance 2mm --display amplitude
END
printf 'v -4e-4 -4e-4 0\nv 4e-4 -4e-4 1e-4\nv 4e-4 4e-4 0\nvt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\n' > u.obj
for i in 0 1 2 3 4 5; do for k in 0 1 2 3 4 5; do echo "$i $k $((i*k)).1"; done; done > cloud.xyz
