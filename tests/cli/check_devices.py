#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that each input gives, at the first try, a pattern for each modulator that hogel knows: of its pixels and bits.

usage: check_devices.py     in a folder with the inputs that devices.txt makes; hogel in the PATH

The profiles are those of share/hogel/devices, in a folder of the user, with fewer pixels: whole panels take minutes. The
numbers of pixels keep their remainders modulo 8, which decide how hogels divide them.
"""
import json
import os
import pathlib
import struct
import subprocess

PROFILES = pathlib.Path(__file__).parents[2] / "share" / "hogel" / "devices"


def png_header(path):
    """Returns columns, rows, bits of a sample and colour type."""
    return struct.unpack(">IIBB", path.read_bytes()[16:26])


def hogel(*words):
    done = subprocess.run(["hogel", *map(str, words), "-q"], capture_output=True, text=True)
    if done.returncode != 0:
        print(*words, "->", done.returncode, done.stderr.strip())
    return done.returncode == 0


def main():
    folder = pathlib.Path("config/hogel/devices")
    folder.mkdir(parents=True)
    os.environ["XDG_CONFIG_HOME"] = str(folder.parents[1].absolute())
    profiles = {file.stem: json.loads(file.read_text()) for file in sorted(PROFILES.glob("*.json"))}
    modulators = {name: profile for name, profile in profiles.items() if profile["kind"] == "modulator"}
    for name, profile in modulators.items():
        profile["pixels"] = [32 + profile["pixels"][0] % 8, 16 + profile["pixels"][1] % 8]
        (folder / f"{name}.json").write_text(json.dumps(profile))
    pattern = pathlib.Path("p.png")
    for name, profile in modulators.items():
        across, down = profile["pixels"]
        levels = profile.get("levels", 2 ** profile.get("bits", 0))
        # The light field has hogels of 2 pixels, which the panel shows without a remainder, or cut by one pixel.
        hogel("render", "mesh.obj", "-o", "lf.h5", "--hogels", f"{across // 2}x{down // 2}", "--directions", "5x5", "--fov",
              "1deg", "--size", f"{across // 2 * 2 * profile['pixel_pitch_um']}um")
        for words in (["mesh.obj"], ["rgb.ppm", "--depth-map", "depth.pgm"], ["rgb.ppm"], ["lf.h5"]):
            made = hogel("slm", *words, "--device", name, "--wavelength", "532nm", "--distance", "5mm", "-o", pattern)
            wanted = (across, down, 8 if levels <= 256 else 16, 0)
            if made and png_header(pattern) != wanted:
                print(name, *words, "gave", png_header(pattern), "instead of", wanted)
            pattern.unlink(missing_ok=True)
    print(len(modulators) > 0)


main()
