#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The floor that `hogel-bench stereogram` is compared with: a stereogram's transforms and random phases in plain NumPy and scipy.

usage: stereogram_against_scipy.py [MEGASAMPLES]      default 16

For each size of hogel a Markdown row of million samples per second of processor time, one thread, single precision:
scipy.fft.ifft2 of sqrt(L) times random phases, all hogels at once and 64 at once, and the transforms alone. Nothing is
resampled, and hogels stay where they are made.
"""
import sys
import time

import numpy as np
import scipy.fft

ROUNDS = 3


def stereogram(radiance, random):
    phases = random.random(radiance.shape, dtype=np.float32)
    waves = np.sqrt(radiance) * np.exp(np.complex64(2j * np.pi) * phases)
    return scipy.fft.ifft2(waves, workers=1, overwrite_x=True)


def best(work):
    times = []
    for _ in range(ROUNDS):
        start = time.process_time()
        work()
        times.append(time.process_time() - start)
    return min(times)


def main():
    samples = int(1e6 * float(sys.argv[1]) if len(sys.argv) > 1 else 16e6)
    random = np.random.default_rng(1)
    print("| samples a hogel | scipy, whole | 64 hogels at once | its transforms alone |\n|---|---|---|---|")
    for side in (32, 64, 128, 256):
        hogels = samples // side**2
        radiance = random.random((hogels, side, side), dtype=np.float32)
        waves = radiance.astype(np.complex64)
        parts = np.array_split(radiance, max(1, hogels // 64))
        seconds = [best(lambda: stereogram(radiance, random)), best(lambda: [stereogram(part, random) for part in parts]),
                   best(lambda: scipy.fft.ifft2(waves, workers=1))]
        print(f"| {side} × {side} | " + " | ".join(f"{radiance.size * 1e-6 / s:.0f}" for s in seconds) + " |")


main()
