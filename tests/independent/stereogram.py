#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the spectra of the hogels that `hogel hologram` writes with the light field that it was given.

usage: stereogram.py HOGEL      exit status 77: numpy or h5py is missing

docs/notation.md, section 3: a hogel is a sum of the plane waves of frequencies j/d, with the moduli
(lambda/d) sqrt(L cos)/cos and phases counted from its first sample; L is the mean of the light field over the lobe of the wave.

An eye between two of these directions sees a soft spot beside its place by geometry: docs/holograms.md, `fourier`.
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
from common.checks import Checks, run
from common.pictures import read_exr

WAVELENGTH, PITCH, SIDE = 532e-9, 1e-6, 32
HOGEL = SIDE * PITCH
STEP = WAVELENGTH / HOGEL  # of the waves' sines
MAX_WITHIN = 1e-3  # root mean square of differences over that of what was expected
MAX_BORDER = 4e-3  # where steps in the light field fall within lobes, whose midpoints see them coarsely


def waves_of(field):
    """[t][s][j][i]: the wave of the sines (i - SIDE/2) STEP across and (SIDE/2 - j) STEP up, less the factor i lambda/d."""
    rows, columns = field.shape[0] // SIDE, field.shape[1] // SIDE
    hogels = field.reshape(rows, SIDE, columns, SIDE).transpose(0, 2, 1, 3)
    waves = np.fft.fftshift(np.fft.fft2(hogels), axes=(2, 3)) / SIDE**2
    return waves * HOGEL / (1j * WAVELENGTH)


def sines():
    return (np.arange(SIDE) - SIDE // 2) * STEP


def cosines():
    square = 1 - sines() ** 2 - sines()[:, None] ** 2
    return np.sqrt(square)


def make(hogel, folder, name, *options):
    run(hogel, "hologram", folder / name, "-o", folder / "hologram.h5", "--wavelength", "532nm", "--pitch", "1um", *options)
    return read_field(folder / "hologram.h5")


class LobeMeans:
    """Means of a perspective light field over the lobes, by midpoints: `points` along a lobe's side."""

    def __init__(self, half, directions, centre=(0, 0), points=64, constant=False):
        offset = (np.arange(points) + 0.5) / points - 0.5
        across = (sines()[:, None] + offset * STEP).ravel()
        upward = (-sines()[:, None] - offset * STEP).ravel()
        cosine = np.sqrt(1 - across**2 - upward[:, None] ** 2)
        self.points, self.half = points, half
        # Light of the sine n travels along (-U, -V, 1).
        u, v = -across / cosine - centre[0], -upward[:, None] / cosine - centre[1]
        self.u = (half + u) / (2 * half) * directions - 0.5
        self.v = (half - v) / (2 * half) * directions - 0.5
        self.inside = (np.abs(u) <= half) & (np.abs(v) <= half)
        self.directions, self.constant = directions, constant

    def whole(self):
        """The lobes that lie within the field of view, and not over its border."""
        return self.inside.reshape(SIDE, self.points, SIDE, self.points).all(axis=(1, 3))

    def of(self, values):
        """`values` is [v][u]; the result is [j][i]."""
        if self.constant:
            last = self.directions - 1
            at = values[np.clip(np.rint(self.v), 0, last).astype(int), np.clip(np.rint(self.u), 0, last).astype(int)]
        else:
            u, v = np.clip(self.u, 0, self.directions - 1), np.clip(self.v, 0, self.directions - 1)
            i, j = np.minimum(u.astype(int), self.directions - 2), np.minimum(v.astype(int), self.directions - 2)
            p, q = u - i, v - j
            at = ((1 - p) * values[j, i] + p * values[j, i + 1]) * (1 - q) + ((1 - p) * values[j + 1, i] + p * values[j + 1, i + 1]) * q
        at = np.where(self.inside, at, 0)
        return at.reshape(SIDE, self.points, SIDE, self.points).mean(axis=(1, 3))


def difference(a, b):
    return np.sqrt((np.abs(a - b) ** 2).sum() / (np.abs(b) ** 2).sum())


def frequency_grids(checks, hogel, folder, random):
    """Nothing is interpolated: each wave has one sample."""
    count = 21
    radiance = random.random((1, 3, 4, count, count))
    write_light_field(folder / "sines.h5", radiance, HOGEL, count * STEP / 2, sines=True)
    waves = waves_of(make(hogel, folder, "sines.h5", "--seed", "5"))
    middle, reach = SIDE // 2, count // 2
    # A ray along (U, V) is a wave of the opposite sines: both axes are reversed.
    lit = waves[:, :, middle - reach:middle + reach + 1, middle - reach:middle + reach + 1][:, :, ::-1, ::-1]
    cosine = cosines()[middle - reach:middle + reach + 1, middle - reach:middle + reach + 1]
    checks.at_most("frequency grid, radiances", np.abs(np.abs(lit) ** 2 * cosine - radiance[0]).max(), 1e-5)
    dark = waves.copy()
    dark[:, :, middle - reach:middle + reach + 1, middle - reach:middle + reach + 1] = 0
    checks.at_most("frequency grid, amplitude of waves without a ray", np.abs(dark).max(), 1e-5)
    return lit / np.abs(lit)


def phases(checks, hogel, folder, turns):
    steps = np.angle(turns) * 256 / (2 * np.pi)
    checks.at_most("random phases, from the next of 256 steps", np.abs(steps - np.rint(steps)).max(), 0.05)
    counts = np.bincount(np.rint(steps).astype(int).ravel() % 256, minlength=256)
    expected = turns.size / 256
    deviation = ((counts - expected) ** 2 / expected).sum()
    checks.at_most("random phases, chi squared of their steps less 255, in deviations", abs(deviation - 255) / np.sqrt(510), 4)
    flat = turns.reshape(-1, turns.shape[-1] * turns.shape[-2])
    alike = np.abs(flat @ flat.conj().T) / flat.shape[1]
    checks.at_most("random phases, likeness of hogels", (alike - np.eye(len(flat))).max(), 4 / np.sqrt(flat.shape[1]))
    first, again, other = (make(hogel, folder, "sines.h5", "--seed", seed) for seed in ("5", "5", "6"))
    checks.equal("the same seed, the same samples", np.array_equal(first, again), True)
    checks.at_most("another seed, likeness", abs(np.vdot(first, other)) / np.vdot(first, first).real, 4 / np.sqrt(turns.size))
    fixed = waves_of(make(hogel, folder, "sines.h5", "--phase", "fixed"))
    bright = np.abs(fixed) > 0.05
    seen = np.where(bright, fixed / np.maximum(np.abs(fixed), 1e-9), 0)
    checks.at_most("fixed phases, difference between hogels",
                   np.abs((seen - seen[0, 0]) * (bright & bright[0, 0])).max(), 1e-3)


def perspective(checks, hogel, folder, random):
    for half, directions, centre in ((0.15, 24, (0, 0)), (0.24, 13, (0, 0)), (0.1, 12, (0.12, -0.07))):
        radiance = random.random((1, 2, 2, directions, directions))
        write_light_field(folder / "tangents.h5", radiance, HOGEL, half, centre=centre)
        name = f"perspective, {directions} directions to {half} around {centre[0]}, {centre[1]}"
        for lobes in ("radiance", "amplitude"):
            waves = waves_of(make(hogel, folder, "tangents.h5", "--lobes", lobes))
            means = LobeMeans(half, directions, centre)
            if lobes == "radiance":
                shown = np.abs(waves[0, 0]) ** 2 * cosines()
                right = means.of(radiance[0, 0, 0])
            else:
                shown = np.abs(waves[0, 0]) * np.sqrt(cosines())
                right = means.of(np.sqrt(radiance[0, 0, 0]))
            whole = means.whole()
            # Off both axes lobes are sheared, which the rectangles are not.
            checks.at_most(f"{name}, mean {lobes} of lobes", difference(shown[whole], right[whole]),
                           MAX_BORDER if centre[0] * centre[1] != 0 else MAX_WITHIN)
            checks.at_most(f"{name}, with those over the border", difference(shown, right), MAX_BORDER)


def fringes(checks, hogel, folder, random):
    half, directions = 0.2, 16
    amplitude = random.random((2, 1, 2, 2, directions, directions))
    fields = {}
    for basis in ("pieces", "haar", "cdf97"):
        for name, values in (("a", amplitude[0]), ("b", amplitude[1]), ("sum", amplitude[0] + amplitude[1])):
            write_light_field(folder / f"{name}.h5", values**2, HOGEL, half)
            fields[name] = make(hogel, folder, f"{name}.h5", "--method", "basis", "--basis", basis)
        checks.at_most(f"basis {basis}, field of a sum of amplitudes", difference(fields["a"] + fields["b"], fields["sum"]), 1e-5)
        shown = np.abs(waves_of(fields["a"])[0, 0]) * np.sqrt(cosines())
        means = LobeMeans(half, directions, constant=basis == "pieces")
        whole, right = means.whole(), means.of(amplitude[0, 0, 0, 0])
        checks.at_most(f"basis {basis}, mean amplitude of lobes", difference(shown[whole], right[whole]),
                       MAX_BORDER if basis == "pieces" else MAX_WITHIN)
        checks.at_most(f"basis {basis}, with those over the border", difference(shown, right), MAX_BORDER)


def shift_of_spot(hogel, folder, direction, pupil, hogel_width=64e-6, depth=40e-3, distance=0.3, pixels=128):
    """How far the spot lies beside its line of sight, in the plane of the spot. `direction` is the eye's, in steps of the waves,
    and so is the pupil; the shift is in steps times the depth."""
    step = WAVELENGTH / hogel_width
    eye = direction * step * (distance + depth)
    run(hogel, "photo", folder / "spot.h5", "-o", folder / "spot.exr", "--wave", "--looks", "expected", "--pitch", "2um",
        "--wavelength", "532nm", "--eye", f"{eye * 1e3!r},0,{distance * 1e3!r}mm", "--pupil",
        f"{pupil * step * distance * 1e3!r}mm", "--focus", f"{depth * 1e3!r}mm", "--resolution", pixels)
    x, seen = positions(pixels, 64 * hogel_width / pixels), eye * depth / (distance + depth)
    light = np.where(np.abs(x - seen) < 1.2e-3, read_exr(folder / "spot.exr")[0].sum(axis=0), 0)
    return (light @ x / light.sum() - seen) * (1 + depth / distance) / (step * depth)


def places(checks, hogel, folder):
    """A spot of 0.1 mm at 40 mm, hogels of 64 um, from eyes on a direction of the hogels, a quarter and half a step beside it."""
    s, u = positions(64, 64e-6), positions(33, 0.12 / 33)
    spot = np.exp(-(((s[:, None] + u * 40e-3) / 0.1e-3) ** 2) / 2)
    write_light_field(folder / "spot.h5", (spot[:, None, :, None] * spot[None, :, None, :])[None], 64e-6, 0.06)
    for pupil, quarter in ((0.8, -0.15), (1.6, 0.035)):
        for direction, expected in ((0, 0), (0.25, quarter), (0.5, 0), (0.75, -quarter)):
            checks.at_most(f"a pupil of {pupil} directions, {direction} beside one, a spot lies {expected} beside geometry",
                           abs(shift_of_spot(hogel, folder, direction, pupil) - expected), 0.02)


def main():
    hogel = pathlib.Path(sys.argv[1]).resolve()
    checks, random = Checks(), np.random.default_rng(1)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        turns = frequency_grids(checks, hogel, folder, random)
        phases(checks, hogel, folder, turns)
        perspective(checks, hogel, folder, random)
        fringes(checks, hogel, folder, random)
        places(checks, hogel, folder)
    checks.finish()


main()
