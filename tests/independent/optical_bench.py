#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares photographs on the bench of `hogel photo --focal` with a panel of explicit sub-pixels, in double precision.

usage: optical_bench.py HOGEL      exit status 77: numpy is missing

docs/modulators.md, "The bench": a pixel is 5x5 sub-pixels; the 3x3 in the middle modulate, and the others are a mirror.
The panel is in a dark plane eight times as wide. Each tilted plane wave is filtered by the aperture, propagated by the angular
spectrum to the plane in focus, and squared; the mean over a pixel is that of its band-limited intensity.
"""
import json
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
try:
    import numpy as np
except ImportError as missing:
    print(missing)
    sys.exit(77)

from common.checks import Checks, run
from common.pictures import read_exr

MAX_DIFFERENCE = -38    # decibels: root mean square of differences over that of the intensities
MAX_EFFICIENCY = 0.016  # relative: the edge of the aperture is soft
PITCH, WAVELENGTH, FOCAL = 8e-6, 532e-9, 0.2
SUB, ACTIVE, ROOM = 5, 3, 8


def panel_of(pattern, full):
    """The reflectance of the sub-pixels."""
    if full:
        return np.kron(pattern, np.ones((SUB, SUB)))
    border = (SUB - ACTIVE) // 2
    inside = np.zeros((SUB, SUB))
    inside[border:SUB - border, border:SUB - border] = 1
    return np.kron(pattern, inside) + np.kron(np.ones(pattern.shape), 1 - inside)


class Bench:
    def __init__(self, pattern, full):
        self.shape = pattern.shape
        rows, columns = (ROOM * SUB * side for side in pattern.shape)
        step = PITCH / SUB
        self.fx, self.fy = np.fft.fftfreq(columns, step), np.fft.fftfreq(rows, step)[:, None]
        plane = np.zeros((rows, columns), complex)
        plane[:pattern.shape[0] * SUB, :pattern.shape[1] * SUB] = panel_of(pattern, full)
        self.light = np.fft.fft2(plane) * np.sinc(self.fx * step) * np.sinc(self.fy * step)

    def photograph(self, points, size, centre, radius, focus, stop):
        """The picture and the efficiency; centre, radius and stop in cycles per pixel."""
        total = 0
        for k in range(points):
            r = size / (2 * FOCAL) * np.sqrt((k + 0.5) / points) if points > 1 else 0
            angle = np.pi * (3 - np.sqrt(5)) * k
            gx, gy = self.fx + r * np.cos(angle) / WAVELENGTH, self.fy + r * np.sin(angle) / WAVELENGTH
            ax, ay = gx - centre[0] / PITCH, gy - centre[1] / PITCH    # from the middle of the aperture
            passed = (np.hypot(ax, ay) <= radius / PITCH) & (np.hypot(gx, gy) >= stop / PITCH)
            along = np.sqrt(np.maximum(1 / WAVELENGTH**2 - ax**2 - ay**2, 0))
            field = np.fft.ifft2(np.where(passed, self.light * np.exp(-2j * np.pi * focus * along), 0))
            total = total + np.abs(field) ** 2 / points
        spectrum = np.fft.fft2(total) * np.sinc(self.fx * PITCH) * np.sinc(self.fy * PITCH)
        means = np.fft.ifft2(spectrum).real[SUB // 2::SUB, SUB // 2::SUB]
        return means[:self.shape[0], :self.shape[1]], total.sum() / (SUB**2 * self.shape[0] * self.shape[1])


# Fill factor of 1 or 0.36, points and size of the source, order, aperture, focus, zero-order stop.
CASES = [
    (True, 1, 0, (0, 0), 0.5, 0, 0),
    (True, 1, 0, (0, 0), 0.2, -8e-3, 0),
    (False, 1, 0, (0, 0), 0.3, 5e-3, 0.1),
    (False, 5, 4e-3, (0, 0), 0.25, -6e-3, 0),
    (False, 3, 6e-3, (0.25, -0.125), 0.12, 3e-3, 0),
    (False, 4, 9e-3, (0, 0), 0.5, 2e-3, 0),
]


def main():
    hogel = pathlib.Path(sys.argv[1]).resolve()
    checks = Checks()
    rng = np.random.default_rng(5)
    pattern = np.exp(2j * np.pi * rng.random((50, 64))).astype(np.complex64)
    benches = {full: Bench(pattern.astype(complex), full) for full in (True, False)}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        np.save(folder / "pattern.npy", pattern)
        for full, points, size, centre, radius, focus, stop in CASES:
            told = run(hogel, "photo", folder / "pattern.npy", "-o", folder / "b.exr", "--pitch", f"{PITCH * 1e6}um", "--wavelength",
                       f"{WAVELENGTH * 1e9}nm", "--focal", f"{FOCAL * 1e3}mm", f"--focus={focus * 1e3}mm", "--fill-factor",
                       1 if full else (ACTIVE / SUB)**2, "--source", f"sources:{points},{size or 1}{'m' if size else 'nm'}",
                       f"--order={centre[0]},{-centre[1]}", "--aperture", radius, "--zero-order-stop", stop, "--json")
            picture = read_exr(folder / "b.exr")[0]
            expected, efficiency = benches[full].photograph(points, size, centre, radius, focus, stop)
            what = f"fill {1 if full else 0.36}, {points} points, order {centre}, radius {radius}, focus {focus * 1e3:g} mm"
            error = np.sqrt(np.mean((picture - expected) ** 2) / np.mean(expected**2))
            checks.at_most(f"{what}: dB", 20 * np.log10(error), MAX_DIFFERENCE)
            checks.at_most(f"{what}: efficiency", abs(json.loads(told)["bench"][0]["efficiency"] / efficiency - 1), MAX_EFFICIENCY)
    checks.finish()


if __name__ == "__main__":
    main()
