#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Computes from decompressed samples the signal-to-noise ratios, rates and bounds that `hogel compress` and `compare` tell.

usage: sqnr.py HOGEL      exit status 77: numpy or h5py is missing

docs/codec.md; SQNR is 10 log10(sum f^2 / sum (f - f')^2), PSNR has N max f^2 in place of the first sum, the rate is rays with all
their colours over the bits of the file.
"""
import json
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
try:
    import h5py
    import numpy as np

    from common.light_fields import positions, read_radiance, write_field, write_light_field
except ImportError as missing:
    print(missing)
    sys.exit(77)
from common.checks import Checks, run
from common.pictures import write_png

HOGELS, DIRECTIONS, PITCH, HALF = 16, 24, 0.2e-3, 0.2
MAX_DECIBELS = 1e-6  # of ratios, which are told in full


def scene(random):
    """A textured plane behind another with a hole, both tilted: radiance [c][t][s][v][u] and depth [t][s][v][u]."""
    s = positions(HOGELS, PITCH)
    u = positions(DIRECTIONS, 2 * HALF / DIRECTIONS)
    t, s, v, u = np.meshgrid(-s, s, -u, u, indexing="ij")
    waves = random.uniform(-6e3, 6e3, (6, 2))
    turns = random.uniform(0, 2 * np.pi, (2, 3, 6))
    radiance, depth = np.zeros((3, *s.shape)), np.full(s.shape, np.inf)
    for plane, (middle, slope) in enumerate(((3e-3, 0.3), (-1e-3, -0.2))):
        zeta = (middle + slope * s) / (1 - slope * u)
        x, y = s + u * zeta, t + v * zeta
        seen = (np.hypot(x, y) > 0.5e-3) & (np.abs(y) < 1e-3) if plane else np.abs(x) < 1.6e-3
        for c in range(3):
            texture = 0.5 + sum(np.sin(waves[i, 0] * x + waves[i, 1] * y + turns[plane, c, i]) for i in range(6)) / 13
            radiance[c][seen] = texture[seen]
        depth[seen] = zeta[seen]
    return radiance, depth


def decibels(signal, error):
    return np.inf if error == 0 else 10 * np.log10(signal / error)


def measures(a, b):
    error = (np.abs(a - b) ** 2).sum()
    return decibels((np.abs(a) ** 2).sum(), error), decibels(a.size * (np.abs(a) ** 2).max(), error), np.abs(a - b).max()


def told(hogel, *arguments):
    return json.loads(run(hogel, *arguments, "--json"))


def apart(a, b):
    """Of two ratios in decibels; null is infinite."""
    a = np.inf if a is None else a
    return 0.0 if a == b else abs(a - b)


def check_comparison(checks, name, said, a, b):
    sqnr, psnr, largest = measures(a, b)
    checks.at_most(f"{name}, compare says {said['sqnr'] or np.inf:.4f} dB, error", apart(said["sqnr"], sqnr), MAX_DECIBELS)
    checks.at_most(f"{name}, compare's psnr, error", apart(said["psnr"], psnr), MAX_DECIBELS)
    checks.at_most(f"{name}, compare's largest error, error", abs(said["max_error"] - largest), 1e-8)


def coders(checks, hogel, folder, rays):
    radiance = read_radiance(folder / "scene.h5")
    for coder in ("hogel", "threepass", "ezw", "fringes", "jpeg4d"):
        for target in (("--sqnr", 30), ("--ppb", 3)):
            said = told(hogel, "compress", folder / "scene.h5", "-o", folder / "scene.hgl", "--coder", coder, "--no-depth", *target)
            run(hogel, "decompress", folder / "scene.hgl", "-o", folder / "decoded.h5", "--float")
            decoded = read_radiance(folder / "decoded.h5")
            name = f"{coder} {' '.join(map(str, target))}"
            sqnr = measures(radiance, decoded)[0]
            checks.at_most(f"{name}, compress says {said['sqnr']:.4f} dB, error", apart(said["sqnr"], sqnr), MAX_DECIBELS)
            size = (folder / "scene.hgl").stat().st_size
            checks.equal(f"{name}, bytes told", said["bytes"], size)
            checks.at_most(f"{name}, pixels per bit told, error", abs(said["pixels_per_bit"] * 8 * size / rays - 1), 1e-9)
            if target[0] == "--ppb":
                checks.equal(f"{name}, bytes", size, int(rays / 8 / 3))
            else:
                checks.at_most(f"{name}, decibels above 30 or 10 below", (sqnr - 30) if sqnr >= 30 else 10 * (30 - sqnr), 0.1)
            check_comparison(checks, name, told(hogel, "compare", folder / "scene.h5", folder / "scene.hgl"), radiance, decoded)


def read_depth(path):
    with h5py.File(path) as file:
        return file["depth"][()]


def bounds(checks, hogel, folder):
    radiance, depth = read_radiance(folder / "scene.h5"), read_depth(folder / "scene.h5")
    seen = np.isfinite(depth)

    def decoded(*options):
        run(hogel, "compress", folder / "scene.h5", "-o", folder / "scene.hgl", *options)
        run(hogel, "decompress", folder / "scene.hgl", "-o", folder / "decoded.h5")
        return read_radiance(folder / "decoded.h5"), read_depth(folder / "decoded.h5")

    light, far = decoded("--lossless")
    checks.equal("--lossless, the same radiance and depth", (np.array_equal(light, radiance), np.array_equal(far, depth)), (True, True))
    light, far = decoded("--max-error", "0.01", "--depth-error", "1um")
    checks.at_most("--max-error 0.01, largest error", np.abs(light - radiance).max(), 0.01)
    checks.equal("--depth-error, the same rays meet nothing", np.array_equal(np.isfinite(far), seen), True)
    checks.at_most("--depth-error 1um, largest error in metres", np.abs(far[seen].astype(float) - depth[seen]).max(), 1e-6 * (1 + 1e-6))
    light, far = decoded()
    default = min(PITCH / 32000 / HALF, (depth[seen].max() - depth[seen].min()) / 1000)
    checks.at_most("depth by default, largest error in metres", np.abs(far[seen].astype(float) - depth[seen]).max(), default)


def holograms(checks, hogel, folder, random):
    a = random.normal(size=(48, 64)) + 1j * random.normal(size=(48, 64))
    b = a + 0.03 * (random.normal(size=a.shape) + 1j * random.normal(size=a.shape))
    for name, field in (("a", a), ("b", b)):
        write_field(folder / f"{name}.h5", field, 1e-6, 633e-9)
    a, b = a.astype(np.complex64).astype(complex), b.astype(np.complex64).astype(complex)
    check_comparison(checks, "holograms", told(hogel, "compare", folder / "a.h5", folder / "b.h5"), a, b)
    check_comparison(checks, "one hologram", told(hogel, "compare", folder / "a.h5", folder / "a.h5"), a, a)


def similarity(a, b):
    """SSIM: means, variances and covariance under a Gaussian of 11 pixels, sigma 1.5, wherever it lies within the picture."""
    weight = np.exp(-((np.arange(11) - 5) ** 2) / 4.5)
    weight /= weight.sum()

    def smooth(values):
        windows = np.lib.stride_tricks.sliding_window_view(values, (11, 11))
        return np.einsum("jiyx,y,x->ji", windows, weight, weight)

    ma, mb = smooth(a), smooth(b)
    va, vb, vab = smooth(a * a) - ma**2, smooth(b * b) - mb**2, smooth(a * b) - ma * mb
    return ((2 * ma * mb + 1e-4) * (2 * vab + 9e-4) / ((ma**2 + mb**2 + 1e-4) * (va + vb + 9e-4))).mean()


def pictures(checks, hogel, folder, random):
    y, x = np.mgrid[0:40, 0:56]
    a = np.rint(127 + 90 * np.sin(x / 5) * np.cos(y / 7))
    b = np.clip(a + np.rint(random.normal(scale=12, size=a.shape)), 0, 255)
    write_png(folder / "a.png", a)
    write_png(folder / "b.png", b)
    said = told(hogel, "compare", folder / "a.png", folder / "b.png", "--exposure", "1")
    a, b = a / 255, b / 255
    checks.at_most("pictures, psnr, error", abs(said["psnr"] - decibels(a.size, ((a - b) ** 2).sum())), 1e-4)
    checks.at_most("pictures, largest error, error", abs(said["max_error"] - np.abs(a - b).max()), 1e-6)
    checks.at_most("pictures, ssim, error", abs(said["ssim"] - similarity(a, b)), 1e-6)


def main():
    hogel = pathlib.Path(sys.argv[1]).resolve()
    checks, random = Checks(), np.random.default_rng(4)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        radiance, depth = scene(random)
        write_light_field(folder / "scene.h5", radiance, PITCH, HALF, depth=depth)
        coders(checks, hogel, folder, depth.size)
        bounds(checks, hogel, folder)
        holograms(checks, hogel, folder, random)
        pictures(checks, hogel, folder, random)
    checks.finish()


main()
