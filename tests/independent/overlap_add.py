#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures how exactly holograms of overlapping windows (olas, fixed phases) show a texture on a plane.

usage: overlap_add.py HOGEL      exit status 77: numpy or h5py is missing

A hogel a sample, views over the whole band. The hologram is carried back to the plane by the angular spectrum, and its amplitude
there, scaled to the same mean, is compared with the root of the texture's radiance, without a border.

Hogels of several samples, random phases: how far beside each other the directions of a pupil see a disc, over what geometry
says. It is the step of the light field's directions over that of the windows' transforms.
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

SAMPLES, PITCH, WAVELENGTH, BORDER = 320, 6.4e-6, 520e-9, 64
HALF = WAVELENGTH / (2 * PITCH)  # the sines of the band, and so small that they are the tangents

# Depth in metres, views across, PSNR in dB that is held.
HELD = [(0.5e-3, 9, 57), (2e-3, 9, 37), (2e-3, 17, 60), (5e-3, 9, 21), (5e-3, 17, 46)]


# Steps of directions that are 6 % less than those of the windows and 5 % more, and how many: more than a pupil sees.
STEPS = [(0.16 / 27, 13), (0.16 / 31, 13)]


class Texture:
    """Waves of all directions with periods from 8 to 60 samples on a ground of 0.5: between 0.1 and 0.9."""

    def __init__(self, waves=60, seed=4):
        random = np.random.default_rng(seed)
        angle, period = random.uniform(0, np.pi, waves), PITCH * np.exp(random.uniform(np.log(8), np.log(60), waves))
        self.fx, self.fy = np.cos(angle) / period, np.sin(angle) / period
        self.phase = random.uniform(0, 2 * np.pi, waves)
        self.strength = random.uniform(0.5, 1, waves)
        self.strength *= 0.4 / self.strength.sum() * 3.5

    def at(self, x, y):
        """On the grid of places x and y."""
        across = np.exp(2j * np.pi * np.outer(x, self.fx))
        down = np.exp(2j * np.pi * np.outer(y, self.fy)) * (self.strength * np.exp(1j * self.phase))
        return np.clip(0.5 + (down @ across.T).real, 0.02, 1)


def shown_at(field, depth):
    """The amplitude on the plane `depth` behind the hologram."""
    f = np.fft.fftfreq(SAMPLES, PITCH)
    cosine = np.sqrt(1 - WAVELENGTH**2 * (f**2 + f[:, None] ** 2))
    return np.abs(np.fft.ifft2(np.fft.fft2(field) * np.exp(-2j * np.pi / WAVELENGTH * cosine * depth)))


def psnr_of(hogel, folder, texture, depth, views):
    s = positions(SAMPLES, PITCH)
    u = positions(views, 2 * HALF / views)
    radiance = np.empty((SAMPLES, SAMPLES, views, views), "f4")
    for l in range(views):
        for k in range(views):
            radiance[:, :, l, k] = texture.at(s + u[k] * depth, -s - u[l] * depth)
    write_light_field(folder / "plane.h5", radiance[None], PITCH, HALF, depth=np.full(radiance.shape, depth, "f4"))
    run(hogel, "hologram", folder / "plane.h5", "-o", folder / "hologram.h5", "--method", "olas", "--phase", "fixed",
        "--pitch", f"{PITCH * 1e6!r}um", "--wavelength", f"{WAVELENGTH * 1e9!r}nm")
    inner = (slice(BORDER, -BORDER),) * 2
    shown = shown_at(read_field(folder / "hologram.h5"), depth)[inner]
    exact = np.sqrt(texture.at(s, -s))[inner]
    return 10 * np.log10(exact.max() ** 2 / np.mean((shown * exact.mean() / shown.mean() - exact) ** 2))


def disc(hogels, pitch, step, directions, depth, radius):
    """The radiance of a bright disc on the axis, [t][s][v][u]."""
    s, u = positions(hogels, pitch), positions(directions, step)
    square = (s[:, None] + u * depth) ** 2
    return (square[:, None, :, None] + square[None, :, None, :] <= radius**2).astype("f4")


def defocus_of(hogel, folder, step, directions, seeds=6, samples=4, hogels=60, depth=6e-3):
    """The windows' step of directions, and the places where its multiples see the disc over those by geometry."""
    pitch, wavelength = 3e-6, 532e-9
    rays = disc(hogels, samples * pitch, step, directions, depth, 60e-6)
    write_light_field(folder / "disc.h5", rays[None], samples * pitch, directions * step / 2,
                      depth=np.where(rays > 0, depth, np.inf))
    windows_step = wavelength / (round(wavelength / (step * samples * pitch)) * samples * pitch)
    sine = -wavelength * np.fft.fftfreq(hogels * samples, pitch)  # of the rays, which run backwards
    x, middle = positions(hogels * samples, pitch), np.abs(sine)[:, None] < 3.5 * windows_step
    seen = windows_step * np.array([-3, -2, -1, 1, 2, 3])
    light = np.zeros((len(seen), len(x)))
    for seed in range(seeds):
        run(hogel, "hologram", folder / "disc.h5", "-o", folder / "hologram.h5", "--method", "olas", "--pitch", "3um",
            "--wavelength", "532nm", "--seed", seed)
        field = read_field(folder / "hologram.h5")
        for across in (field, field[::-1].T):
            spectrum = np.fft.fft2(across) * middle
            for i, direction in enumerate(seen):
                near = np.exp(-(((sine - direction) / (0.7 * windows_step)) ** 2))
                light[i] += (np.abs(np.fft.ifft2(spectrum * near)) ** 2).sum(axis=0)
    places = -(light @ x) / light.sum(axis=1)
    return windows_step, places @ seen / (seen @ seen) / depth


def main():
    hogel = pathlib.Path(sys.argv[1]).resolve()
    checks, texture = Checks(), Texture()
    with tempfile.TemporaryDirectory() as folder:
        for depth, views, held in HELD:
            checks.at_least(f"{views} x {views} views, {depth * 1e3:g} mm, PSNR in dB",
                            psnr_of(hogel, pathlib.Path(folder), texture, depth, views), held)
        for step, directions in STEPS:
            windows_step, defocus = defocus_of(hogel, pathlib.Path(folder), step, directions)
            checks.at_most(f"steps of {step:.4f} by windows of {windows_step:.4f}, 6 mm, defocus {defocus:.3f} beside their "
                           f"ratio {step / windows_step:.3f}", abs(defocus - step / windows_step), 0.04)
    checks.finish()


main()
