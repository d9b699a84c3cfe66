#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures how bright the holograms of each method show a plane of one radiance, at several depths and slopes.

usage: brightness.py HOGEL      exit status 77: numpy or h5py is missing

docs/notation.md, section 3: a spectral density of L lambda^2/cos means radiance L. The density is that of the hologram's middle
under a smooth window, its mean over directions and seeds. The middle of the fan is what lies within 0.4 of its half. All light,
as if it were within the fan, whose edges are soft, is compared where waves are those of the hogels' own transform.
(The method `basis` is in stereogram.py: hogels with the same phases interfere, so a plane is not evenly bright.)
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

MAX_MIDDLE = {"fourier": 0.05, "phase-added": 0.07, "phase-added-exact": 0.07, "olas": 0.05}
MAX_ALL = 0.02
SHOWN = 0.7
SLOPES = (0, 0.05, 0.1, 0.3)


class Fan:
    """A light field's rays."""

    def __init__(self, hogels, hogel_pitch, directions, half):
        self.hogels, self.hogel_pitch, self.directions, self.half = hogels, hogel_pitch, directions, half

    def depths(self, depth, slope):
        """Where rays meet the plane zeta = depth + slope x."""
        u = positions(self.directions, 2 * self.half / self.directions)
        s = positions(self.hogels, self.hogel_pitch)
        row = (depth + slope * s[:, None]) / (1 - slope * u)
        return np.broadcast_to(row[None, :, None, :], (self.hogels, self.hogels, self.directions, self.directions))

    def write(self, path, depth, slope):
        depths = self.depths(depth, slope)
        write_light_field(path, np.full((1, *depths.shape), SHOWN), self.hogel_pitch, self.half, depth=depths)


def radiances_of(field, pitch, wavelength, half):
    """In the middle of the fan, and of all light."""
    samples = field.shape[0]
    window = np.clip(2.5 * np.sin(np.pi * (np.arange(samples) + 0.5) / samples) - 1.2, 0, 1) ** 2
    spectrum = np.fft.fft2(field * window * window[:, None]) * pitch**2
    density = np.abs(spectrum) ** 2 / (np.sum(window**2) * pitch) ** 2
    f = np.fft.fftfreq(samples, pitch) * wavelength
    square = f**2 + f[:, None] ** 2
    cosine = np.sqrt(np.maximum(1 - square, 1e-9))
    tangent = np.maximum(np.abs(f), np.abs(f[:, None])) / cosine
    shown = density * cosine / wavelength**2
    return np.array([shown[tangent <= 0.4 * half].mean(), shown.sum() / np.count_nonzero(tangent <= half)])


def measure(hogel, folder, fan, method, pitch, wavelength, seeds):
    found = []
    for seed in range(seeds):
        run(hogel, "hologram", folder / "plane.h5", "-o", folder / "hologram.h5", "--method", method, "--pitch", f"{pitch * 1e6!r}um",
            "--wavelength", f"{wavelength * 1e9!r}nm", "--seed", seed + 1)
        found.append(radiances_of(read_field(folder / "hologram.h5"), pitch, wavelength, fan.half))
    return np.mean(found, axis=0) / SHOWN


def main():
    hogel = pathlib.Path(sys.argv[1]).resolve()
    checks = Checks()
    stereogram = Fan(20, 50e-6, 26, 0.1)
    near_eye = Fan(160, 6.4e-6, 9, 0.0406)
    two_samples = Fan(110, 8e-6, 11, 0.06)
    wide = Fan(90, 3e-6, 17, 0.28)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        for number, (title, fan, method, pitch, wavelength, far, seeds) in enumerate((
                ("fourier", stereogram, "fourier", 2e-6, 633e-9, 2e-3, 6),
                ("phase-added", stereogram, "phase-added", 2e-6, 633e-9, 2e-3, 3),
                ("phase-added-exact", stereogram, "phase-added-exact", 2e-6, 633e-9, 2e-3, 3),
                ("olas, near an eye", near_eye, "olas", 6.4e-6, 520e-9, 2e-3, 6),
                ("olas, two samples a hogel", two_samples, "olas", 4e-6, 633e-9, 2e-3, 3),
                ("olas, wide", wide, "olas", 1e-6, 633e-9, 0.25e-3, 2))):
            for turn, depth in enumerate((0.1 * far, -0.35 * far, far)):
                for slope in by_turns(SLOPES, number + turn) if method != "fourier" else (0,):
                    fan.write(folder / "plane.h5", depth, slope)
                    middle, all_light = measure(hogel, folder, fan, method, pitch, wavelength, seeds)
                    where = f"{title}, depth {depth * 1e3:.3g} mm, slope {slope}"
                    checks.at_most(f"{where}, error of brightness", abs(middle - 1), MAX_MIDDLE[method])
                    if method != "olas":
                        checks.at_most(f"{where}, of all light", abs(all_light - 1), MAX_ALL)
                if method == "fourier":  # knows no depth
                    break
    checks.finish()


main()
