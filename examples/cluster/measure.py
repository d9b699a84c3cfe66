#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures what the stages of hogel take on this machine, for model.py: processor seconds of one thread at several sizes.

usage: measure.py [HOGEL] > measured.json       about one minute
"""
import json
import pathlib
import platform
import resource
import subprocess
import sys
import tempfile

HOGEL_MM, DIRECTIONS, PITCH = 0.256, 128, "1um"
SIDES = (12, 24, 40)  # hogels across and down
STREAMED_SIDES = (90, 123, 174)  # whose samples are read in blocks as large as those of any larger hologram


def spent(*command, folder):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([*command, "--threads", "1"], cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(done.stderr)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


# A photograph of a scene's hologram that is never stored. The eye is where hogels of any of these sizes can send it light.
def streamed(side):
    return ["photo", "tower", "--hogels", f"{side}x{side}", "--size", f"{side * HOGEL_MM:g}mm", "--directions",
            f"{DIRECTIONS}x{DIRECTIONS}", "--fov", "22deg", "--eye", "0,0,900mm", "--wave", "--camera", "narrow", "--looks", "1",
            "--wavelength", "532nm", "--pitch", PITCH, "--resolution", "256"]


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
            seconds = spent(hogel, "propagate", "waves.h5", "-o", "there.h5", "--distance", "2mm", folder=folder)
            runs.append(("propagate", samples, seconds, size("there.h5")))
        for side in STREAMED_SIDES:
            seconds = spent(hogel, *streamed(side), "-o", "photo.exr", folder=folder)
            runs.append(("streamed photo", side * side * round(HOGEL_MM * 1000)**2, seconds, size("photo.exr")))
    json.dump({"processor": processor(),
               "runs": [dict(zip(("stage", "samples", "seconds", "bytes"), run)) for run in runs]}, sys.stdout, indent=1)
    print()


if __name__ == "__main__":
    main()
