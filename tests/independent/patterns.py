#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Decodes the pictures of 8 bits that `hogel slm` and `hogel print` write, and compares with what was encoded.

usage: patterns.py HOGEL      exit status 77: numpy or h5py is missing

docs/holograms.md, "Patterns for modulators". Each pixel must be the value of the encoding's formula to half a level. What the
pixels transmit, multiplied by the conjugate of the order's carrier and low-passed to the field's band, must be the field: the
unlikeness is that of the best multiple, the root of 1 - |<a, b>|^2/<a, a><b, b>. Efficiencies must be those of the pictures.
"""
import json
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
try:
    import numpy as np

    from common.light_fields import write_field, write_light_field
except ImportError as missing:
    print(missing)
    sys.exit(77)
from common.checks import Checks, run
from common.pictures import read_png

SAMPLES, PITCH, WAVELENGTH, BAND = 128, 8e-6, 532e-9, 0.07  # cycles a pixel
WINDOW = 32
CARRIER = 40 / SAMPLES
# The order against the field. What is left is what the formula leaves in the band, not the rounding.
MAX_UNLIKENESS = {"phase": 0.4, "double-phase": 0.06, "intensity": 0.01, "bipolar": 0.01, "burckhardt": 0.12, "lee": 0.06,
                  "binary": 0.5}


def smooth_field(random):
    """Noise of the band alone, of the largest modulus 1."""
    f = np.fft.fftfreq(SAMPLES)
    spectrum = (random.normal(size=(SAMPLES, SAMPLES)) + 1j * random.normal(size=(SAMPLES, SAMPLES))) * in_band(f, f)
    field = np.fft.ifft2(spectrum)
    return field / np.abs(field).max()


def in_band(fx, fy):
    return (np.abs(fx) <= BAND) & (np.abs(fy)[:, None] <= BAND)


def low_passed(waves):
    f = np.fft.fftfreq(SAMPLES)
    return np.fft.ifft2(np.fft.fft2(waves) * in_band(f, f))


def product(a, b):
    return abs(np.vdot(a, b)) ** 2


def unlikeness(a, b):
    return np.sqrt(max(0, 1 - product(a, b) / (np.vdot(a, a).real * np.vdot(b, b).real)))


def wrapped(angle):
    return np.angle(np.exp(1j * angle))


def components(field, count):
    """Non-negative real numbers on `count` axes around the circle of which the field is the sum, one for each column by turns."""
    sector = 2 * np.pi / count
    angle = np.angle(field) % (2 * np.pi)
    axis = np.floor(angle / sector)
    within = angle - axis * sector
    column = np.arange(SAMPLES) % count
    before = np.abs(field) * np.sin(sector - within) / np.sin(sector)
    after = np.abs(field) * np.sin(within) / np.sin(sector)
    return np.where(column == axis, before, np.where(column == (axis + 1) % count, after, 0))


def encode(hogel, folder, encoding, *options):
    told = run(hogel, "slm", folder / "field.h5", "-o", folder / "pattern.png", "--encoding", encoding, "--pixels",
               f"{SAMPLES}x{SAMPLES}", "--pixel-pitch", "8um", "--clip", "0", "--json", *options)
    return read_png(folder / "pattern.png")[0], json.loads(told)["patterns"][0]


def local_spectra(field, start=0):
    count = (SAMPLES - start) // WINDOW
    part = field[start:start + count * WINDOW, start:start + count * WINDOW]
    return np.abs(np.fft.fft2(part.reshape(count, WINDOW, count, WINDOW).transpose(0, 2, 1, 3)))


def light_field_share(shown, wanted):
    a, b = local_spectra(shown), local_spectra(wanted)
    return ((a * b).sum(axis=(2, 3)) ** 2 / (b**2).sum(axis=(2, 3))).sum() / (a**2).sum()


def phases(checks, hogel, folder, field):
    for encoding in ("phase", "double-phase"):
        levels, told = encode(hogel, folder, encoding)
        shown = np.exp(2j * np.pi * levels / 256)
        angle = np.angle(field)
        if encoding == "double-phase":
            signs = 1 - 2 * ((np.arange(SAMPLES) + np.arange(SAMPLES)[:, None]) % 2)
            angle = angle + signs * np.arccos(np.minimum(1, np.abs(field)))
        checks.at_most(f"{encoding}, levels from the formula", np.abs(wrapped(np.angle(shown) - angle)).max() * 256 / (2 * np.pi), 0.51)
        checks.at_most(f"{encoding}, unlikeness of the order", unlikeness(low_passed(shown), field), MAX_UNLIKENESS[encoding])
        share = product(field, shown) / np.vdot(field, field).real / field.size
        checks.at_most(f"{encoding}, told efficiency {told['efficiency']:.4f}, error", abs(share / told["efficiency"] - 1), 1e-4)


def iterated(checks, hogel, folder, field):
    """Moduli of local spectra: what a light field shows. The descent leaves what is outside of the field's band free."""
    alone = np.exp(1j * np.angle(field))
    for encoding, seen, squares, limit in (("gerchberg-saxton", lambda waves: waves, ((0, "its squares"),), 0.2),
                                           ("gradient", low_passed, ((0, "squares"), (WINDOW // 2, "squares halfway between")), 0.12)):
        levels, told = encode(hogel, folder, encoding, "--window", WINDOW)
        shown = np.exp(2j * np.pi * levels / 256)
        for start, where in squares:
            wanted = local_spectra(field, start)
            of_phase = unlikeness(local_spectra(seen(alone), start), wanted)
            checks.at_most(f"{encoding}, unlikeness of local spectra in {where} (of the phase alone {of_phase:.2f})",
                           unlikeness(local_spectra(seen(shown), start), wanted), limit)
        share = light_field_share(shown, field)
        checks.at_most(f"{encoding}, told light in its light field {told['light_field_efficiency']:.4f}, error",
                       abs(share / told["light_field_efficiency"] - 1), 1e-4)


def amplitudes(checks, hogel, folder, field):
    x = np.arange(SAMPLES)
    for encoding in ("intensity", "bipolar", "burckhardt", "lee", "binary"):
        # A whole number of cycles across, so that the light about zero does not reach into the order by its edges.
        options = [] if encoding in ("burckhardt", "lee") else ["--reference", f"{np.arcsin(CARRIER * WAVELENGTH / PITCH)!r}rad"]
        levels, told = encode(hogel, folder, encoding, *options)
        carrier = np.sin(np.radians(told["reference_angle_deg"])) * PITCH / WAVELENGTH
        reference = np.exp(2j * np.pi * carrier * x)
        fringe = field * reference.conj()
        value = {"intensity": lambda: np.abs(field + reference) ** 2 / 4,
                 "bipolar": lambda: (1 + fringe.real) / 2,
                 "binary": lambda: (fringe.real > 0).astype(float),
                 # A component may exceed the modulus by 1/sin 120 degrees.
                 "burckhardt": lambda: components(field, 3) * np.sin(2 * np.pi / 3),
                 "lee": lambda: components(field, 4)}[encoding]()
        off = np.abs(levels - 255 * value)
        if encoding == "binary":
            off[np.abs(fringe.real) < 1e-6] = 0
        checks.at_most(f"{encoding}, levels from the formula", off.max(), 0.51)
        wanted = {"burckhardt": 1 / 3, "lee": 1 / 4}.get(encoding, CARRIER)
        checks.at_most(f"{encoding}, told carrier, error", abs(carrier / wanted - 1), 1e-6)
        shown = levels / 255
        checks.at_most(f"{encoding}, unlikeness of the order", unlikeness(low_passed(shown * reference), field),
                       MAX_UNLIKENESS[encoding])
        share = product(fringe, shown) / np.vdot(field, field).real / field.size
        checks.at_most(f"{encoding}, told efficiency {told['efficiency']:.4f}, error", abs(share / told["efficiency"] - 1), 1e-4)


def printed(checks, hogel, folder, random):
    """Pictures for printers: sRGB of the light field, from the left and back."""
    radiance = random.random((3, 2, 3, 8, 10)) * 1.2
    write_light_field(folder / "rays.h5", radiance, 1e-3, 0.3)
    run(hogel, "print", folder / "rays.h5", "-o", folder / "hogels")
    files = sorted((folder / "hogels").glob("*.png"))
    checks.equal("print, pictures", len(files), 6)
    worst = 0
    for number, file in enumerate(files):
        row, column = divmod(number, 3)
        linear = np.clip(radiance[:, row, column if row == 0 else 2 - column], 0, 1)
        coded = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
        worst = max(worst, np.abs(read_png(file) - 255 * coded).max())
    checks.at_most("print, levels from sRGB", worst, 0.51)


def main():
    hogel = pathlib.Path(sys.argv[1]).resolve()
    checks, random = Checks(), np.random.default_rng(2)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        field = smooth_field(random)
        write_field(folder / "field.h5", field, PITCH, WAVELENGTH)
        phases(checks, hogel, folder, field)
        amplitudes(checks, hogel, folder, field)
        iterated(checks, hogel, folder, field)
        printed(checks, hogel, folder, random)
    checks.finish()


main()
