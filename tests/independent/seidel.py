#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares photographs of a point through a thin lens (`--film-distance`) with the third-order theory of its aberrations.

usage: seidel.py HOGEL      exit status 77: numpy or h5py is missing

The lens of docs/notation.md, section 4, is flat and turns phases by -k delta^2/2l, to the second order alone, at a distance delta from
its middle. For a point at the distance a, seen under the slopes u, and the film at b, 1/l = 1/a + 1/b, the paths' expansion to the
fourth order leaves, with the stop at the lens,

  W(delta) = - delta^4/8 (1/a^3 + 1/b^3)                             spherical aberration
             + delta^2 (delta u)/2 (1/a^2 - 1/b^2)                   coma, none at a = b
             - ((delta u)^2/2 + delta^2 u^2/4) (1/a + 1/b)           astigmatism and curvature, Petzval's sum zero
             + 0                                                     distortion

The perfect lens, without a film distance, has none of these. The picture of a point is the square of the transform of e^{ikW}. Each
picture is compared with that, and, to see what the comparison is worth, with the same less one of the terms.
"""
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
try:
    import numpy as np

    from common.light_fields import positions
except ImportError as missing:
    print(missing)
    sys.exit(77)
from common.checks import Checks, run
from common.pictures import read_exr

WAVELENGTH, PITCH, SAMPLES, PIXELS = 633e-9, 0.5e-6, 255, 96
TERMS = ("spherical aberration", "coma", "astigmatism")
MAX_UNLIKENESS = 0.04  # root mean square of the differences of two pictures of equal sum over that of the theory's
MIN_SHOWN = 0.3        # unlikeness to the theory without a term of a fifth of a wavelength or more


def disc(diameter, rings=64, spokes=144):
    node, weight = np.polynomial.legendre.leggauss(rings)
    radius = diameter / 4 * (node + 1)
    angle = 2 * np.pi * np.arange(spokes) / spokes
    points = np.stack([np.outer(radius, np.cos(angle)).ravel(), np.outer(radius, np.sin(angle)).ravel()], axis=1)
    return points, np.repeat(weight * radius, spokes)


def terms(points, u, a, b):
    square, slope = (points**2).sum(axis=1), points @ u
    return {"spherical aberration": -square**2 / 8 * (1 / a**3 + 1 / b**3),
            "coma": square * slope / 2 * (1 / a**2 - 1 / b**2),
            "astigmatism": -(slope**2 / 2 + square * (u @ u) / 4) * (1 / a + 1 / b)}


class Theory:
    """Pictures: means over pixels, by 2 x 2 points in each. On the film, a point's neighbour at p has the phase of delta p/a."""

    def __init__(self, points, weight, a, pixel):
        offset = np.array([-1, 1]) / np.sqrt(12) * pixel
        x = (positions(PIXELS, pixel)[:, None] + offset).ravel()
        self.across = np.exp(2j * np.pi / WAVELENGTH / a * np.outer(points[:, 0], x))
        self.up = np.exp(-2j * np.pi / WAVELENGTH / a * np.outer(x, points[:, 1])) * weight

    def picture(self, path):
        film = (self.up * np.exp(2j * np.pi / WAVELENGTH * path)) @ self.across
        picture = (np.abs(film) ** 2).reshape(PIXELS, 2, PIXELS, 2).sum(axis=(1, 3))
        return picture / picture.sum()


def unlikeness(seen, right):
    return np.sqrt(((seen / seen.sum() - right) ** 2).sum() / (right**2).sum())


def photograph(hogel, folder, eye, pupil, film):
    run(hogel, "photo", folder / "point.npy", "-o", folder / "photograph.exr", "--camera", "full", "--film-distance",
        f"{film * 1e3!r}mm", "--eye", ",".join(f"{v!r}" for v in eye * 1e3) + "mm", "--pupil", f"{pupil * 1e3!r}mm", "--focus", "0mm",
        "--resolution", PIXELS, "--pitch", "0.5um", "--wavelength", "633nm")
    return read_exr(folder / "photograph.exr")[0]


def main():
    hogel = pathlib.Path(sys.argv[1]).resolve()
    checks = Checks()
    # One sample in the middle shines alike in all directions.
    point = np.zeros((SAMPLES, SAMPLES), np.complex64)
    point[SAMPLES // 2, SAMPLES // 2] = 1
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        np.save(folder / "point.npy", point)
        for a, b, pupil, aside in ((10e-3, 10e-3, 2.4e-3, (0, 0)), (10e-3, 5e-3, 2e-3, (0, 0)), (10e-3, 10e-3, 1.6e-3, (0.7e-3, 0.4e-3)),
                                   (10e-3, 20e-3, 2.2e-3, (-0.3e-3, 0.5e-3)), (12e-3, 6e-3, 1.6e-3, (0.5e-3, -0.6e-3))):
            eye = np.array([*aside, a])
            u = -np.array(aside) / a
            points, weight = disc(pupil)
            path = terms(points, u, a, b)
            theory = Theory(points, weight, a, SAMPLES * PITCH / PIXELS)
            seen = photograph(hogel, folder, eye, pupil, b)
            waves = ", ".join(f"{np.ptp(path[term]) / WAVELENGTH:.1f}" for term in TERMS)
            where = f"object {a * 1e3:g} mm, film {b * 1e3:g} mm, pupil {pupil * 1e3:g} mm, slope {np.hypot(*u):.3f} (waves: {waves})"
            checks.at_most(f"{where}, unlikeness", unlikeness(seen, theory.picture(sum(path.values()))), MAX_UNLIKENESS)
            for term in TERMS:
                if np.ptp(path[term]) < 0.2 * WAVELENGTH:
                    continue
                less = theory.picture(sum(path.values()) - path[term])
                checks.at_least(f"{where}, unlikeness to no {term}", unlikeness(seen, less), MIN_SHOWN)
            perfect = photograph(hogel, folder, eye, pupil, 0.0)
            checks.at_most(f"{where}, perfect lens, unlikeness to none", unlikeness(perfect, theory.picture(0 * path["coma"])),
                           MAX_UNLIKENESS)
    checks.finish()


main()
