#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares `hogel propagate` with direct sums in double precision.

usage: propagation.py HOGEL      exit status 77: numpy is missing

A field is read as the band-limited one through its samples (docs/notation.md, section 5). At points of the output it is

  near   the sum of its plane waves over a fine grid of frequencies, in Gauss's rule, each turned by e^{2 pi i f_z z};
  far    the sum of the spherical waves of its samples, Rayleigh and Sommerfeld's first integral.

The error is the root mean square of the differences over that of the sums, at some of the output's samples.
"""
import os
import pathlib
import subprocess
import sys
import tempfile

try:
    import numpy as np
except ImportError:
    print("numpy is missing")
    sys.exit(77)

MAX_ERROR = 1e-3


def positions(samples, pitch, centre):
    return (np.arange(samples) - (samples - 1) / 2) * pitch + centre


def plane_waves(field, pitch, wavelength, z, points):
    edge = 0.5 / pitch
    sine = min(0.99, np.sqrt(2) * wavelength * edge)
    path = field.shape[0] * pitch + np.abs(points).max() + abs(z) * sine / np.sqrt(1 - sine**2)
    panels = int(np.ceil(edge * path)) + 2
    node, weight = np.polynomial.legendre.leggauss(16)
    middle = -edge + edge / panels * (2 * np.arange(panels) + 1)
    f = (middle[:, None] + edge / panels * node).ravel()
    weight = np.tile(weight * edge / panels, panels)
    x, y = positions(field.shape[1], pitch, 0), -positions(field.shape[0], pitch, 0)
    spectrum = np.exp(-2j * np.pi * np.outer(f, y)) @ field @ np.exp(-2j * np.pi * np.outer(x, f)) * pitch**2
    square = 1 / wavelength**2 - f[:, None] ** 2 - f**2
    cycles = np.sqrt(np.maximum(square, 0)) * z
    onward = np.where(square > 0, np.exp(2j * np.pi * (cycles % 1)),
                      np.exp(-2 * np.pi * np.sqrt(np.maximum(-square, 0)) * z) if z >= 0 else 0)
    spectrum *= onward * np.outer(weight, weight)
    return np.array([np.exp(2j * np.pi * f * v) @ spectrum @ np.exp(2j * np.pi * f * u) for u, v in points])


def spherical_waves(field, pitch, wavelength, z, points):
    x, y = positions(field.shape[1], pitch, 0), -positions(field.shape[0], pitch, 0)
    values = []
    for u, v in points:
        r = np.sqrt((u - x) ** 2 + (v - y)[:, None] ** 2 + z**2)
        kernel = abs(z) / (2 * np.pi * r**2) * (1 / r - 2j * np.pi / wavelength) * np.exp(2j * np.pi * (r / wavelength % 1))
        values.append((field * (kernel if z > 0 else kernel.conj())).sum() * pitch**2)
    return np.array(values)


def random_field(random, samples):
    """Of 0.3 cycles per sample at the most, fading out towards its sides."""
    f = np.fft.fftfreq(samples)
    spectrum = random.normal(size=(samples, samples)) + 1j * random.normal(size=(samples, samples))
    spectrum *= np.exp(-((f / 0.15) ** 2))[:, None] * np.exp(-((f / 0.15) ** 2))
    side = np.sin(np.pi * (np.arange(samples) + 0.5) / samples) ** 4
    return (np.fft.ifft2(spectrum) * samples * side * side[:, None]).astype(np.complex64)


def compare(hogel, folder, field, pitch, wavelength, z, output_pitch, samples, offset, random):
    np.save(folder / "field.npy", field)
    subprocess.run([hogel, "propagate", folder / "field.npy", "-o", folder / "there.npy", "--distance", f"{z!r}m", "--pitch",
                    f"{pitch * 1e6!r}um", "--wavelength", f"{wavelength * 1e9!r}nm", "--output-pitch",
                    f"{output_pitch * 1e6!r}um", "--output-samples", str(samples), "--offset-x", f"{offset!r}m", "-q"], check=True)
    there = np.load(folder / "there.npy")
    u, v = positions(samples, output_pitch, offset), -positions(samples, output_pitch, 0)
    places = random.integers(0, samples, (20, 2))
    points = np.array([(u[i], v[j]) for i, j in places])
    aside = 0.5 * wavelength / pitch * abs(z)
    far = aside > 3 * field.shape[0] * pitch
    right = (spherical_waves if far else plane_waves)(field.astype(complex), pitch, wavelength, z, points)
    error = np.sqrt((np.abs(there[places[:, 1], places[:, 0]] - right) ** 2).sum() / (np.abs(right) ** 2).sum())
    print(f"{field.shape[0] * pitch * 1e3:6.3g} mm, {wavelength * 1e9:.0f} nm, {z:8.4g} m, pitch {output_pitch * 1e6:8.4g} um, offset "
          f"{offset * 1e3:8.4g} mm, {'spherical' if far else 'plane'} waves: {error:.1e}")
    return error <= MAX_ERROR


def main():
    hogel = pathlib.Path(sys.argv[1]).resolve()
    random = np.random.default_rng(7)
    right = True
    with tempfile.TemporaryDirectory() as name:
        for row, size in enumerate((0.1e-3, 0.5e-3, 2e-3, 20e-3)):
            for column, z in enumerate((0.0, 1e-3, 20e-3, -0.2, 1.0, 10.0)):
                both = (450e-9, 650e-9)
                for wavelength in both if os.environ.get("HOGEL_THOROUGH") == "1" else both[(row + column) % 2:][:1]:
                    samples = 56
                    pitch = size / samples
                    field = random_field(random, samples)
                    aside = 0.25 * wavelength / pitch * abs(z)
                    for output_pitch, offset in ((pitch, 0.0), (max(pitch, aside / samples) * 0.7, 0.2 * size)):
                        right &= compare(hogel, pathlib.Path(name), field, pitch, wavelength, z, output_pitch, 40, offset, random)
    sys.exit(0 if right else 1)


main()
