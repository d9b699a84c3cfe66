#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares photographs by `--camera full`, `narrow` and `eye` with direct sums in double precision.

usage: cameras.py HOGEL      exit status 77: numpy or h5py is missing

docs/notation.md, section 4: a spherical wave from each sample of the hologram to each point q of the pupil; there the lens
turns the waves from a point p of the plane in focus to one phase, and their sum is the film. Brightness is that of the
whole picture, unlikeness the root mean square of the differences over that of the sum's deviations from their mean.
"""
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
try:
    import numpy as np

    from common.light_fields import positions, read_field, write_light_field
except ImportError as missing:
    print(missing)
    sys.exit(77)

from common.checks import Checks, by_turns, run
from common.pictures import read_exr

MAX_BRIGHTNESS = 3e-3
MAX_UNLIKENESS = {"full": 4e-3, "narrow": 8e-3, "eye": 8e-3}  # correlations of 1 - (this)^2/2
MAX_TILTED = 8e-3
MAX_SHIFT = 0.01        # pixels from the sum
MAX_SIGHT = 0.1         # pixels from the line of sight; a resolution cell is 1.9
WAVELENGTH = 633e-9
PITCH = 0.5e-6


def turned(distance):
    """e^{ikr}, exact for distances of many wavelengths."""
    cycles = distance / WAVELENGTH
    cycles -= np.rint(cycles)
    cycles *= 2 * np.pi
    turn = np.empty(cycles.shape, complex)
    turn.real, turn.imag = np.cos(cycles), np.sin(cycles)
    return turn


def distances(a, b):
    square = (a[:, 2, None] - b[:, 2]) ** 2
    for axis in (0, 1):
        square = square + (a[:, axis, None] - b[:, axis]) ** 2
    return np.sqrt(square)


class Lens:
    """A disc around `centre`: Gauss's radii, equal angles."""

    def __init__(self, centre, diameter, rings=32, spokes=72):
        node, weight = np.polynomial.legendre.leggauss(rings)
        radius = diameter / 4 * (node + 1)
        angle = 2 * np.pi * np.arange(spokes) / spokes
        self.centre, self.area = np.asarray(centre), np.pi * diameter**2 / 4
        self.points = self.centre + np.stack([np.outer(radius, np.cos(angle)).ravel(), np.outer(radius, np.sin(angle)).ravel(),
                                              np.zeros(rings * spokes)], axis=1)
        self.weight = np.repeat(weight * diameter / 4 * radius * 2 * np.pi / spokes, spokes)

    def light_of(self, field):
        """U(q) of a field around the origin."""
        x, y = np.meshgrid(positions(field.shape[1], PITCH), -positions(field.shape[0], PITCH))
        sources = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
        light = np.empty(len(self.points), complex)
        for part in np.array_split(np.arange(len(self.points)), 16):
            r = distances(self.points[part], sources)
            light[part] = (turned(r) / r**2) @ field.ravel() * PITCH**2 * self.centre[2] / (1j * WAVELENGTH)
        return light

    def picture(self, light, columns, rows, pixel, focus, slope=0):
        """Means over pixels, by 3 x 3 points of Gauss's rule in each; the depth in focus is focus + slope x."""
        node, weight = np.polynomial.legendre.leggauss(3)
        x = (positions(columns, pixel)[:, None] + pixel / 2 * node).ravel()
        y = (-positions(rows, pixel)[:, None] - pixel / 2 * node).ravel()
        x, y = np.meshgrid(x, y)
        seen = np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
        away = seen - self.centre
        reach = (self.centre[2] + focus + slope * self.centre[0]) / (self.centre[2] - slope * away[:, 0])
        there = self.centre + away * reach[:, None]
        film = np.empty(len(there), complex)
        for part in np.array_split(np.arange(len(there)), 16):
            film[part] = turned(-distances(there[part], self.points)) @ (light * self.weight)
        cosine = self.centre[2] / np.sqrt((away**2).sum(axis=1))
        radiance = (np.abs(film) ** 2 * cosine).reshape(rows, 3, columns, 3) / (WAVELENGTH**2 * self.area)
        return np.einsum("jyix,y,x->ji", radiance, weight, weight) / 4


def eye_at(degrees, azimuth, distance):
    tilt, turn = np.radians(degrees), np.radians(azimuth)
    return distance * np.array([np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), np.cos(tilt)])


def photograph(hogel, source, folder, camera, eye, pupil, focus, resolution, *more):
    path = folder / "photograph.exr"
    run(hogel, "photo", source, "-o", path, "--camera", camera, "--eye", ",".join(f"{v!r}" for v in eye * 1e3) + "mm",
        "--pupil", f"{pupil * 1e3!r}mm", "--focus", f"{focus * 1e3!r}mm", "--resolution", resolution, *more)
    return read_exr(path)[0]


def compare(checks, name, photographed, summed, limit=None):
    checks.at_most(f"{name}, brightness", abs(photographed.sum() / summed.sum() - 1), MAX_BRIGHTNESS)
    checks.at_most(f"{name}, unlikeness", np.sqrt(((photographed - summed) ** 2).sum()) / np.sqrt(
        ((summed - summed.mean()) ** 2).sum()), limit or MAX_UNLIKENESS[name.split(",")[0]])


def noise(checks, hogel, folder):
    radiance = np.random.default_rng(3).random((1, 5, 6, 24, 24))  # in all directions that the samples can light
    write_light_field(folder / "noise.h5", radiance, 8e-6, 0.7)
    making = ["--pitch", "0.5um", "--wavelength", "633nm", "--seed", "11"]
    run(hogel, "hologram", folder / "noise.h5", "-o", folder / "hologram.h5", *making)
    field = read_field(folder / "hologram.h5")
    pupil, columns, rows = 1.4e-3, 32, 27
    pixel = field.shape[1] * PITCH / columns
    for turn, (degrees, azimuth) in enumerate(((0, 0), (15, 40), (30, 200))):
        eye = eye_at(degrees, azimuth, 9e-3)
        lens = Lens(eye, pupil)
        light = lens.light_of(field)
        cases = [(focus, 0) for focus in by_turns((0.0, 0.1e-3, -0.1e-3), turn)]
        cases += [(0.0, tilt) for tilt in by_turns((5, 15, 30), turn)]
        for focus, tilt in cases:
            summed = lens.picture(light, columns, rows, pixel, focus, np.tan(np.radians(tilt)))
            for camera in ("full", "narrow", "eye"):
                source, more = (folder / "noise.h5", ["--wave", "--looks", "1", *making]) if camera == "eye" else (
                    folder / "hologram.h5", [])
                there = photograph(hogel, source, folder, camera, eye, pupil, focus, f"{columns}x{rows}", "--focus-tilt",
                                   f"{tilt}deg,0deg", *more)
                compare(checks, f"{camera}, {degrees} degrees, focus {focus * 1e3:g} mm, tilted by {tilt}", there, summed,
                        MAX_TILTED if tilt else None)


def middle(picture, pixel):
    """Centre of what is brighter than a fifth of the peak."""
    bright = np.where(picture > 0.2 * picture.max(), picture - 0.2 * picture.max(), 0)
    rows, columns = picture.shape
    return np.array([bright.sum(axis=0) @ positions(columns, pixel), bright.sum(axis=1) @ -positions(rows, pixel)]) / bright.sum()


def places(checks, hogel, folder):
    """Spherical waves from points behind and before the hologram are seen where the line of sight to them crosses it."""
    x, y = np.meshgrid(positions(160, PITCH), -positions(160, PITCH))
    pupil, pixels = 1.2e-3, 32
    pixel = 160 * PITCH / pixels
    for seen, depth, degrees, azimuth in (((6e-6, -4e-6), 0.2e-3, 0, 0), ((-5e-6, 7e-6), 0.3e-3, 25, 120),
                                          ((3e-6, 2e-6), -0.2e-3, 20, -60)):
        eye = eye_at(degrees, azimuth, 9e-3)
        point = eye + (np.array([*seen, 0]) - eye) * (1 + depth / eye[2])
        r = np.sqrt((x - point[0]) ** 2 + (y - point[1]) ** 2 + depth**2)
        soft = np.exp(-((x**2 + y**2) / 30e-6**2) ** 3)
        field = (soft * turned(np.copysign(r, depth)) / r).astype(np.complex64)
        np.save(folder / "point.npy", field)
        lens = Lens(eye, pupil, rings=20, spokes=60)
        summed = lens.picture(lens.light_of(field), pixels, pixels, pixel, depth)
        for camera in ("full", "narrow"):
            there = photograph(hogel, folder / "point.npy", folder, camera, eye, pupil, depth, pixels, "--pitch", "0.5um",
                               "--wavelength", "633nm")
            name = f"{camera}, point at depth {depth * 1e3:g} mm from {degrees} degrees"
            checks.at_most(f"{name}, pixels from its line of sight", np.abs(middle(there, pixel) - seen).max() / pixel,
                           MAX_SIGHT)
            checks.at_most(f"{name}, pixels from the sum's", np.abs(middle(there, pixel) - middle(summed, pixel)).max() / pixel,
                           MAX_SHIFT)
            compare(checks, name, there, summed)


def main():
    hogel = pathlib.Path(sys.argv[1]).resolve()
    checks = Checks()
    with tempfile.TemporaryDirectory() as name:
        noise(checks, hogel, pathlib.Path(name))
        places(checks, hogel, pathlib.Path(name))
    checks.finish()


main()
