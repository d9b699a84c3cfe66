#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes sets of views with Pillow and NumPy as other programs store them, and reads with h5py, Pillow and NumPy what hogel
made of them, by the equations of docs/files.md and docs/exchange.md alone.

usage: check_exchange.py make|imported|exported|cameras     in the folder of exchange.txt
"""
import json
import os
import pathlib
import sys

import h5py
import numpy as np
from PIL import Image

ROWS = COLUMNS = 3
HEIGHT, WIDTH = 40, 48
RNG = np.random.default_rng(7)
# Smooth random pictures, each another. [row from the top][column from the left][y][x][c]; the third number is the camera's.
BASE = np.kron(RNG.integers(0, 200, (ROWS, COLUMNS, HEIGHT // 4, WIDTH // 4, 3)), np.ones((1, 1, 4, 4, 1))).astype(np.uint8)
FLOATS = (BASE / 77).astype("<f4")


def save(folder, name, picture):
    pathlib.Path(folder).mkdir(parents=True, exist_ok=True)
    Image.fromarray(picture).save(f"{folder}/{name}")


def write_ppm10(folder, name, picture):
    pathlib.Path(folder).mkdir(exist_ok=True)
    codes = picture.astype(np.uint16) * 4 + 3
    pathlib.Path(folder, name).write_bytes(b"P6\n%d %d\n1023\n" % (WIDTH, HEIGHT) + codes.astype(">u2").tobytes())


def write_pfm(folder, name, picture):
    pathlib.Path(folder).mkdir(exist_ok=True)
    pathlib.Path(folder, name).write_bytes(b"PF\n%d %d\n-1.0\n" % (WIDTH, HEIGHT) + picture[::-1].astype("<f4").tobytes())


def make():
    for r in range(ROWS):
        for c in range(COLUMNS):
            save("hci", f"input_Cam{r * COLUMNS + c:03}.png", BASE[r, c])
            save("chess", f"out_{ROWS - 1 - r:02}_{c:02}_{-700 + 10 * r:.6f}_{-3000 + 10 * c:.6f}_.png", BASE[r, c])
            save("nerf/images", f"{9 * c + r}.png", BASE[r, c])
            write_ppm10("pleno", f"{c:03}_{r:03}.ppm", BASE[r, c])  # the column first
            write_pfm("pfm", f"v_{r}_{c}.pfm", FLOATS[r, c])
    pathlib.Path("hci/parameters.cfg").write_text(
        "[intrinsics]\nfocal_length_mm = 100\nimage_resolution_x_px = 48\nimage_resolution_y_px = 40\nsensor_size_mm = 35\n"
        "[extrinsics]\nnum_cams_x = 3\nnum_cams_y = 3\nbaseline_mm = 20\nfocus_distance_m = 0.6\noffset = 4.57\n"
        "[meta]\nscene = test\n")
    # Cameras 0.5 apart in a world whose y is forwards and z up, 15 before the plane on which the pictures agree.
    frames = [{"file_path": f"images/{9 * c + r}", "cx": 24 + (c - 1) * 0.5 * 60 / 15, "cy": 20 + (r - 1) * 0.5 * 60 / 15,
               "transform_matrix": [[1, 0, 0, 0.5 * c], [0, 0, -1, -3], [0, 1, 0, 4 - 0.5 * r], [0, 0, 0, 1]]}
              for r in range(ROWS) for c in range(COLUMNS)]
    pathlib.Path("nerf/transforms.json").write_text(json.dumps({"w": WIDTH, "h": HEIGHT, "fl_x": 60, "fl_y": 60, "frames": frames}))
    save(".", "walk_qs3x1a1.2.png", np.concatenate(list(BASE[1]), axis=1))
    np.save("floats.npy", FLOATS.astype(">f4"))


def linear(codes, last):
    v = codes / last
    return np.where(v <= 0.04045, v / 12.92, ((v + 0.055) / 1.055) ** 2.4)


def rays_are(name, views, tolerance):
    """Whether sample (k, l) of every hogel is the camera that the ray comes from: x = s + U zeta at zeta = the focal plane."""
    with h5py.File(f"{name}.h5", "r") as file:
        radiance = file["radiance"]
        a = radiance.attrs
        depth = a["focal_plane_m"]
        n, m = radiance.shape[4], radiance.shape[3]
        u = (np.arange(n) + 0.5 - n / 2) * 2 * a["focal_half_u"] / n
        v = (m / 2 - np.arange(m) - 0.5) * 2 * a["focal_half_v"] / m
        left_to_right, top_to_bottom = np.argsort(u * depth), np.argsort(-v * depth)
        values = radiance[...].astype(float)
    worst = 0
    for r, l in enumerate(top_to_bottom):
        for c, k in enumerate(left_to_right):
            worst = max(worst, np.abs(values[:, :, :, l, k] - views[r, c].transpose(2, 0, 1)).max())
    print(f"{name}: rays as docs/files.md says" if worst <= tolerance else f"{name}: off by {worst}")


def imported():
    half = 2.0 ** -11
    eight = linear(BASE.astype(float), 255)
    rays_are("hci", eight, half)
    rays_are("chess", eight, half)
    rays_are("pleno", linear(BASE * 4.0 + 3, 1023), half)
    rays_are("walk", eight[1:2], half)
    rays_are("nerf", eight, half)
    rays_are("floats", FLOATS, 0)
    rays_are("pfm", FLOATS, 0)


def same_files(name, folder, made):
    names = sorted(path.name for path in pathlib.Path(folder).iterdir() if path.suffix != ".cfg")
    pictures = sum(pathlib.Path(folder, each).exists() and made(pathlib.Path(folder, each)) for each in names)
    print(f"{name}: {pictures} pictures are the same")


def exported():
    def png_as(order):
        return lambda path: np.array_equal(np.asarray(Image.open(path)), BASE[order(path.stem)])
    same_files("hci", "out_hci", png_as(lambda stem: divmod(int(stem[-3:]), COLUMNS)))
    same_files("chess", "out_chess", png_as(lambda stem: (ROWS - 1 - int(stem[4:6]), int(stem[7:9]))))

    def ppm(path):
        header, data = path.read_bytes().split(b"1023\n", 1)
        r, c = (int(number) for number in path.stem.split("_"))
        return np.array_equal(np.frombuffer(data, ">u2").reshape(HEIGHT, WIDTH, 3), BASE[r, c].astype(int) * 4 + 3)
    same_files("pleno", "out_pleno", ppm)
    quilt = [np.asarray(Image.open(path)) for path in ("out_qs3x1a1.2.png", "walk_qs3x1a1.2.png")]
    print("quilt: the same" if np.array_equal(*quilt) else "quilt: differs")
    views = np.load("out.npy")
    print(f"npy: {views.dtype} of shape {views.shape},", "the same" if np.array_equal(views, FLOATS) else "differs")

    def pfm(path):
        data = path.read_bytes().split(b"-1.0\n", 1)[1]
        r, c = (int(number) for number in path.stem.split("_"))
        return np.array_equal(np.frombuffer(data, "<f4").reshape(HEIGHT, WIDTH, 3)[::-1], FLOATS[r, c])
    same_files("pfm", "out_pfm", pfm)
    # Pillow reads 16-bit colours as 8-bit ones; the header says what is stored.
    deep = pathlib.Path("deep/000_000.png").read_bytes()
    print(f"deep: {deep[24]} bits" if np.array_equal(np.asarray(Image.open("deep/000_000.png")), BASE[0, 0]) else "deep: differs")


def cameras():
    """Every camera of the file sees the point of the hologram at a hogel's middle in that hogel's pixel."""
    file = json.loads(pathlib.Path("cameras.json").read_text())
    worst, places = 0, set()
    for frame in file["frames"]:
        matrix = np.array(frame["transform_matrix"])
        places.add((round(matrix[0, 3], 9), round(matrix[1, 3], 9)))
        for i, j in ((0, 0), (file["w"] - 1, 0), (5, file["h"] - 1)):
            pitch = 0.06 / file["w"]
            point = np.array([(i + 0.5 - file["w"] / 2) * pitch, (file["h"] / 2 - j - 0.5) * pitch, 0, 1])
            x, y, z, _ = np.linalg.inv(matrix) @ point
            pixel = file["cx"] if "cx" in file else frame["cx"], frame["cy"]
            worst = max(worst, abs(pixel[0] + file["fl_x"] * x / -z - (i + 0.5)), abs(pixel[1] - file["fl_y"] * y / -z - (j + 0.5)))
    print(f"{len(places)} cameras of {file['w']}x{file['h']} pixels,", "which agree on the hologram" if worst < 1e-9 else f"off by {worst}")
    left, right = (min(places), max(places))
    print(f"{(right[0] - left[0]) / 4 * 1e3:.4f} mm apart")


{"cameras": cameras, "make": make, "imported": imported, "exported": exported}[sys.argv[1]]()
