#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Phase pictures in the codes of other programs, written and read by hogel, against the formulas of their makers.

usage: phase_codes.py HOGEL      exit status 77: numpy or h5py is missing

docs/holograms-from-elsewhere.md. A pattern of `hogel slm --phase-code` must be decoded by the maker's formula to the phase of
the field, to half a step; a picture that the maker's formula encodes must be read as its phases, to the last bit of a float.
"""
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
try:
    import numpy as np

    from common.light_fields import write_field
except ImportError as missing:
    print(missing)
    sys.exit(77)
from common.checks import Checks, run
from common.pictures import read_png, write_png

SAMPLES = 96
TURN = 2 * np.pi

# Name: encoding of phases as levels, decoding of levels as phases, step of phase. As the makers' programs compute them.
CODES = {
    "hogel": (lambda p: np.round(p % TURN * 256 / TURN) % 256, lambda v: v * TURN / 256, TURN / 256),
    "neural-holography": (lambda p: np.round((1 - ((p + np.pi) % TURN) / TURN) * 255),
                          lambda v: (1 - v / 255) * TURN - np.pi, TURN / 255),
    "slmsuite": (lambda p: (255 - np.round(p % TURN * 256 / TURN)) % 256, lambda v: (255 - v) * TURN / 256, TURN / 256),
    "odak": (lambda p: np.round(p % TURN / TURN * 255), lambda v: v * TURN / 255, TURN / 255),
    "tensorholo": (lambda p: np.round(((p + np.pi) % TURN) / TURN * 255), lambda v: (v / 255 - 0.5) * TURN, TURN / 255),
    "range=3pi,offset=-45deg,invert": (lambda p: 255 - np.round((p + np.pi / 4) % TURN / (3 * np.pi) * 255),
                                       lambda v: -np.pi / 4 + 3 * np.pi * (255 - v) / 255, 3 * np.pi / 255),
}


def off(a, b):
    """The largest difference of angles."""
    return np.abs(np.angle(np.exp(1j * (a - b)))).max()


def written(checks, hogel, folder, phase):
    write_field(folder / "field.h5", np.exp(1j * phase), 8e-6, 532e-9)
    for name, (_, decode, step) in CODES.items():
        run(hogel, "slm", folder / "field.h5", "-o", folder / "p.png", "--encoding", "phase", "--pixels",
            f"{SAMPLES}x{SAMPLES}", "--pixel-pitch", "8um", "--phase-code", name)
        levels = read_png(folder / "p.png")[0].astype(float)
        checks.at_most(f"{name}, written: off by, steps", off(decode(levels), phase) / step, 0.51)


def read(checks, hogel, folder, phase):
    for name, (encode, decode, _) in CODES.items():
        levels = encode(phase).astype(np.uint8)
        write_png(folder / "p.png", levels)
        run(hogel, "propagate", folder / "p.png", "-o", folder / "f.npy", "--distance", "0mm", "--pitch", "8um", "--wavelength",
            "532nm", "--phase-code", name)
        field = np.load(folder / "f.npy")
        checks.at_most(f"{name}, read: error", np.abs(field - np.exp(1j * decode(levels.astype(float)))).max(), 2e-7)


def main():
    hogel, checks = pathlib.Path(sys.argv[1]).resolve(), Checks()
    random = np.random.default_rng(1)
    phase = random.uniform(-np.pi, np.pi, (SAMPLES, SAMPLES))
    phase[0, :16] = np.linspace(-np.pi, np.pi, 16)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        written(checks, hogel, folder, phase)
        read(checks, hogel, folder, phase)
    checks.finish()


main()
