#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures what the stages of hogel take on this machine, for model.py: processor seconds of one thread at several sizes.

usage: measure.py [HOGEL] > measured.json       about two minutes of processor time
"""
import json
import pathlib
import platform
import resource
import subprocess
import sys
import tempfile

HOGEL_MM, DIRECTIONS, PITCH = 0.25, 128, "1um"
SIDES = (12, 24, 40)  # hogels across and down


def spent(*command, folder):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([*command, "--threads", "1"], cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.split(":")[1].strip()
    return platform.processor()


def main():
    hogel = str(pathlib.Path(sys.argv[1]).resolve()) if len(sys.argv) > 1 else "hogel"
    runs = []
    with tempfile.TemporaryDirectory(prefix="hogel_measure_") as folder:
        size = lambda name: (pathlib.Path(folder) / name).stat().st_size
        for side in SIDES:
            hogels = f"{side}x{side}"
            rays = 3 * side * side * DIRECTIONS**2
            seconds = spent(hogel, "render", "pumpkin", "-o", "rays.h5", "--hogels", hogels, "--size", f"{side * HOGEL_MM}mm",
                            "--directions", f"{DIRECTIONS}x{DIRECTIONS}", folder=folder)
            runs.append(("render", rays, seconds, size("rays.h5")))
            seconds = spent(hogel, "compress", "rays.h5", "-o", "rays.hgl", "--sqnr", "35", folder=folder)
            runs.append(("compress", rays, seconds, size("rays.hgl")))
            seconds = spent(hogel, "hologram", "rays.h5", "-o", "waves.h5", "--wavelength", "532nm", "--pitch", PITCH, "--half",
                            folder=folder)
            samples = side * side * round(HOGEL_MM * 1000)**2
            runs.append(("hologram", samples, seconds, size("waves.h5")))
            seconds = spent(hogel, "photo", "waves.h5", "-o", "photo.exr", "--resolution", "128", folder=folder)
            runs.append(("photo", samples, seconds, size("photo.exr")))
            seconds = spent(hogel, "photo", "rays.h5", "-o", "photo.exr", "--resolution", "128", "--wave", "--camera", "narrow",
                            "--looks", "1", "--wavelength", "532nm", "--pitch", PITCH, folder=folder)
            runs.append(("streamed photo", samples, seconds, size("photo.exr")))
            seconds = spent(hogel, "propagate", "waves.h5", "-o", "there.h5", "--distance", "2mm", folder=folder)
            runs.append(("propagate", samples, seconds, size("there.h5")))
    json.dump({"processor": processor(),
               "runs": [dict(zip(("stage", "samples", "seconds", "bytes"), run)) for run in runs]}, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main()
