#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures how bright the methods straight from scenes show a white card, in photographs of holograms of many seeds.

usage: direct.py HOGEL      exit status 77: numpy or h5py is missing

docs/holograms.md, "Straight from scenes". The card's radiance follows from the lights of mesh files (docs/scenes.md). Speckle leaves
1/sqrt(n k) of uncertainty to the mean over n resolution cells and k seeds; here n is about 800.
"""
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
try:
    import numpy as np

    from common.meshes import Scene
except ImportError as missing:
    print(missing)
    sys.exit(77)
from common.checks import THOROUGH, Checks, by_turns, run
from common.pictures import read_exr

MAX_ERROR = 0.03
SIDE = 0.6e-3
LIGHTS = (((-0.6, 0.75, 0.6), 2.4), ((0.8, 0.1, 0.5), 0.42))  # the way to each, its irradiance in red
AMBIENT = 0.08


def write_card(path, depth, slope):
    """Returns its radiance."""
    right, up = np.array([SIDE, 0, -SIDE * slope]), np.array([0, SIDE, 0])
    scene = Scene()
    scene.patch(np.array([0, 0, -depth]) - (right + up) / 2, right, up, 1)
    scene.write_ply(path)
    normal = np.cross(right, up)
    normal /= np.linalg.norm(normal)
    lit = sum(irradiance * max(0, np.array(way) @ normal) / np.linalg.norm(way) for way, irradiance in LIGHTS)
    return AMBIENT + lit / np.pi


def main():
    hogel = pathlib.Path(sys.argv[1]).resolve()
    checks = Checks()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for number, (method, cards) in enumerate((("fresnel", ((4e-3, 0.3), (-3e-3, 0.3))), ("planes", ((4e-3, 0.3), (-3e-3, 0.3))),
                                                  ("polygons", ((-3e-3, 0.3), (4e-3, 1.2))), ("polygons-visible", ((4e-3, 1.2),)),
                                                  ("points-tiled", ((4e-3, 0.3),)))):
            seeds = 4 if method == "points-tiled" else 12 if THOROUGH else 8
            for depth, slope in by_turns(cards, number):
                radiance = write_card(folder / "card.ply", depth, slope)
                found = []
                for seed in range(seeds):
                    run(hogel, "hologram", folder / "card.ply", "-o", folder / "hologram.h5", "--as-is", "--method", method, "--hogels",
                        "16x16", "--size", "0.768mm", "--pitch", "3um", "--wavelength", "633nm", "--seed", seed + 1)
                    run(hogel, "photo", folder / "hologram.h5", "-o", folder / "photograph.exr", "--eye", "0mm,0mm,40mm", "--pupil",
                        "3mm", "--focus", f"{depth * 1e3!r}mm", "--resolution", "64")
                    found.append(read_exr(folder / "photograph.exr")[0][22:42, 22:42].mean() / radiance)
                checks.at_most(f"{method}, depth {depth * 1e3:g} mm, slope {slope}, {seeds} seeds (to "
                               f"{np.std(found) / np.sqrt(seeds):.3f}), error of brightness",
                               abs(np.mean(found) - 1), MAX_ERROR)
    checks.finish()


main()
