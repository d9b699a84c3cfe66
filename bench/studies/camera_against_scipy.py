#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The same field through hogel and through plain scipy: to another plane, and photographed through a lens.

usage: camera_against_scipy.py HOGEL      HOGEL: the program, built for release

scipy's side is written from the equations alone, in double precision: pad, transform, multiply by e^(2 pi i f_z z), transform
back. Where LightPipes or odak are installed, the field goes to the other plane by them too. Printed: how alike the results are,
and the processor time of both (hogel's with reading and writing its files).
"""
import os
import resource
import subprocess
import sys
import tempfile
import time

import matplotlib.image
import numpy as np
import scipy.fft

PITCH, WAVELENGTH, SAMPLES = 1.5e-6, 532e-9, 1024


def frequencies(n):
    f = scipy.fft.fftfreq(n, PITCH)
    square = 1 / WAVELENGTH**2 - f[None, :] ** 2 - f[:, None] ** 2
    return f, np.sqrt(np.maximum(square, 0)), square > 0


def padded(field, n):
    before = (n - field.shape[0]) // 2
    window = np.zeros((n, n), complex)
    window[before : before + field.shape[0], before : before + field.shape[1]] = field
    return window, slice(before, before + field.shape[0])


def elsewhere(window, z):
    """The wave propagated by z; directions that would leave the window are dropped."""
    f, fz, travels = frequencies(window.shape[0])
    reach = 0.5 * window.shape[0] * PITCH
    with np.errstate(divide="ignore"):
        stays = travels & (np.abs(z * f[None, :] / fz) < reach) & (np.abs(z * f[:, None] / fz) < reach)
    return scipy.fft.ifft2(scipy.fft.fft2(window, workers=1) * np.where(stays, np.exp(2j * np.pi * fz * z), 0), workers=1)


def alike(a, b):
    return np.abs(np.vdot(a, b)) / np.sqrt(np.vdot(a, a).real * np.vdot(b, b).real)


HOGEL = os.path.abspath(sys.argv[1])


def hogel(*words):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([HOGEL, *words, "--threads", "1", "-q"], check=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def read_picture(path):
    display = matplotlib.image.imread(path).astype(float)
    if display.ndim == 3:
        display = display[..., 0]
    return np.where(display <= 0.04045, display / 12.92, ((display + 0.055) / 1.055) ** 2.4).ravel()


def by_lightpipes(window, z):
    import LightPipes

    field = LightPipes.Begin(window.shape[0] * PITCH, WAVELENGTH, window.shape[0])
    field.field = window
    return LightPipes.Forvard(field, z).field


def by_odak(window, z):
    import odak.learn.wave
    import torch

    kind, padding = "Bandlimited Angular Spectrum", [False, False, False]
    wave = torch.from_numpy(window.astype(np.complex64))
    number = odak.learn.wave.wavenumber(WAVELENGTH)
    there = odak.learn.wave.propagate_beam(wave, number, z, PITCH, WAVELENGTH, kind, zero_padding=padding)
    return there.squeeze().numpy()


def main():
    random = np.random.default_rng(1)
    noise = random.standard_normal((2, SAMPLES, SAMPLES))
    # Light of all directions up to half of what the samples carry.
    spectrum = scipy.fft.fft2(noise[0] + 1j * noise[1])
    f = np.abs(scipy.fft.fftfreq(SAMPLES))
    spectrum[(f[None, :] > 0.25) | (f[:, None] > 0.25)] = 0
    field = (0.1 * scipy.fft.ifft2(spectrum)).astype(np.complex64)
    given = ["--pitch", "1.5um", "--wavelength", "532nm"]
    os.chdir(tempfile.mkdtemp())
    np.save("field.npy", field)

    seconds = hogel("propagate", "field.npy", "-o", "there.npy", "--distance", "2mm", *given)
    start = time.process_time()
    window, inside = padded(field, 5 * SAMPLES // 2)
    there = elsewhere(window, 2e-3)[inside, inside]
    print(f"2 mm on: correlation {alike(there, np.load('there.npy').astype(complex)):.6f}, "
          f"hogel {seconds:.2f} s, scipy {time.process_time() - start:.2f} s")
    for other in [by_lightpipes, by_odak]:
        try:
            start = time.process_time()
            theirs = other(padded(field, 5 * SAMPLES // 2)[0], 2e-3)[inside, inside]
            seconds = time.process_time() - start
            same = alike(theirs, np.load("there.npy").astype(complex))
            print(f"  {other.__name__}: correlation {same:.6f}, {seconds:.2f} s")
        except ImportError as error:
            print(f"  {other.__name__}: left out, {error}")

    eye, pupil, pixels = 60e-3, 2e-3, 64
    for camera in ["narrow", "full"]:
        seconds = hogel("photo", "field.npy", "-o", camera + ".png", "--camera", camera, "--eye", "0,0,60mm", "--pupil",
                        "2mm", "--resolution", str(pixels), "--exposure", "0.3", *given)
        print(f"photograph, {camera}: hogel {seconds:.2f} s")
    start = time.process_time()
    window, inside = padded(field, 2560)
    lens = elsewhere(window, eye)
    x = (np.arange(2560) + 0.5 - 1280) * PITCH
    lens[np.hypot(x[None, :], x[:, None]) > pupil / 2] = 0
    film = np.abs(elsewhere(lens, -eye)[inside, inside]) ** 2
    picture = film.reshape(pixels, SAMPLES // pixels, pixels, SAMPLES // pixels).mean((1, 3)).ravel()
    print(f"photograph: scipy {time.process_time() - start:.2f} s")
    for camera in ["narrow", "full"]:
        print(f"  against {camera}: correlation {np.corrcoef(picture, read_picture(camera + '.png'))[0, 1]:.6f}")


main()
