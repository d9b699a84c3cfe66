#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Overlapping windows on a textured plane: the hologram propagated to the plane's depth, compared with the texture.

usage: olas_on_a_plane.py HOGEL      HOGEL: the program, built for release

520 nm, 6.4 um, one hogel per sample, views over the whole range of diffraction. The light field is made here from the
texture in closed form, and the field is propagated here, by the band-limited angular spectrum on twice the width.
"""
import subprocess
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np
from scipy.ndimage import gaussian_filter, map_coordinates

WAVELENGTH, PITCH, SAMPLES, MARGIN, BORDER = 520e-9, 6.4e-6, 384, 128, 64
HALF = 0.999 * np.tan(np.arcsin(WAVELENGTH / (2 * PITCH)))


def texture(size):
    random = np.random.default_rng(1)
    fine, coarse = (gaussian_filter(random.standard_normal((size, size)), width) for width in (3, 25))
    return np.clip(0.5 + 0.12 * fine / fine.std() + 0.15 * coarse / coarse.std(), 0.02, 1).astype("f4")


def write_light_field(path, plane, depth, views):
    step = 2 * HALF / views
    u = (np.arange(views) + 0.5 - views / 2) * step
    rows, columns = np.mgrid[0:SAMPLES, 0:SAMPLES].astype(float) + MARGIN
    radiance = np.empty((1, SAMPLES, SAMPLES, views, views), "f4")
    for l in range(views):
        for k in range(views):
            # Row 0 of the directions is the highest V, and rows of the picture are counted downwards.
            at = [rows - u[views - 1 - l] * depth / PITCH, columns + u[k] * depth / PITCH]
            radiance[0, :, :, l, k] = map_coordinates(plane, at, order=1)
    with h5py.File(path, "w", libver="v108") as file:
        file.attrs.update(format="hogel light field", format_version=1)
        file["radiance"] = radiance
        file["depth"] = np.full(radiance.shape[1:], depth, "f4")
        file["radiance"].attrs.update(axis_order="c,t,s,v,u", channels=1, hogels_s=SAMPLES, hogels_t=SAMPLES,
                                      hogel_pitch_m=PITCH, directions_u=views, directions_v=views, tan_half_u=HALF,
                                      tan_half_v=HALF)


def carried_back(field, depth):
    size = 2 * SAMPLES
    padded = np.zeros((size, size), complex)
    middle = slice(SAMPLES // 2, SAMPLES // 2 + SAMPLES)
    padded[middle, middle] = field
    fx, fy = np.meshgrid(*2 * [np.fft.fftfreq(size, PITCH)])
    limit = 1 / (WAVELENGTH * np.hypot(2 * depth / (size * PITCH), 1))
    fz = np.sqrt(np.maximum(1 / WAVELENGTH**2 - fx**2 - fy**2, 0))
    passes = np.exp(-2j * np.pi * depth * fz) * ((abs(fx) < limit) & (abs(fy) < limit))
    return np.fft.ifft2(np.fft.fft2(padded) * passes)[middle, middle]


def psnr(truth, seen):
    """The PSNR of two pictures, the second scaled to the first."""
    scale = (truth * seen).sum() / (seen * seen).sum()
    return -10 * np.log10(np.mean((truth - scale * seen) ** 2))


def main():
    hogel = str(Path(sys.argv[1]).resolve())
    whole = texture(SAMPLES + 2 * MARGIN)
    inside = slice(BORDER, -BORDER)
    truth = whole[MARGIN:-MARGIN, MARGIN:-MARGIN][inside, inside]
    print("| depth | views | phases | PSNR of amplitudes | of intensities |\n|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        light_field, hologram = Path(folder) / "l.h5", Path(folder) / "h.h5"
        for depth, views, phase in [(5e-4, 9, "fixed"), (2e-3, 9, "fixed"), (5e-3, 9, "fixed"), (5e-4, 17, "fixed"),
                                    (2e-3, 17, "fixed"), (5e-3, 17, "fixed"), (2e-3, 9, "random")]:
            write_light_field(light_field, whole, depth, views)
            subprocess.run([hogel, "hologram", light_field, "-o", hologram, "--method", "olas", "--phase", phase,
                            "--wavelength", f"{WAVELENGTH * 1e9:g}nm", "--pitch", f"{PITCH * 1e6:g}um", "-q"], check=True)
            with h5py.File(hologram) as file:
                seen = np.abs(carried_back(file["field0/samples"][...], depth))[inside, inside]
            print(f"| {depth * 1e3:g} mm | {views} × {views} | {phase} | {psnr(np.sqrt(truth), seen):.1f} dB | "
                  f"{psnr(truth, seen**2):.1f} dB |", flush=True)


main()
