#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares holograms by basis fringes with sums of fringes made from their definition, for a front, a hemicube and lines.

usage: fringes.py HOGEL      exit status 77: numpy or h5py is missing

[K] (3.24): a hogel is the sum of the fringes of the basis functions of its directions, each times its coefficient. Here the
coefficients are those of Haar's transform of sqrt(L), face by face, and a fringe is a sum of waves, sample by sample, whose moduli
are means of the basis function over the waves' lobes. Only the waves' phases, which all hogels share, are taken from a hologram,
that of uniform light.
"""
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
try:
    import numpy as np

    from common.light_fields import add_side, read_field, write_light_field
except ImportError as missing:
    print(missing)
    sys.exit(77)
from common.checks import Checks, run

WAVELENGTH = 532e-9
POINTS = 24  # of a lobe, along a side
MAX_FRONT = 1e-2
MAX_FACES = 4e-2  # lobes of several faces are means of two points a ray, which see steps between rays coarsely
# To (right, up, forward) of a face from the direction (x, y, zeta) of a ray.
PICTURE = {"front": lambda x, y, z: (x, y, z), "left": lambda x, y, z: (z, y, -x), "right": lambda x, y, z: (-z, y, x),
           "top": lambda x, y, z: (x, -z, y), "bottom": lambda x, y, z: (x, z, -y)}


class Face:
    def __init__(self, name, across, down, half=(1, 1), centre=(0, 0)):
        self.name, self.across, self.down, self.half, self.centre = name, across, down, half, centre

    def shape(self):
        return self.down, self.across

    def rays(self, x, y, z):
        """Which directions are on the face, and the rays beside each with their weights."""
        right, up, forward = PICTURE[self.name](x, y, z)
        forward_or_one = np.where(forward > 1e-9, forward, 1)
        u, v = right / forward_or_one - self.centre[0], up / forward_or_one - self.centre[1]
        on = (forward > 1e-9) & (np.abs(u) <= self.half[0] + 1e-12) & (np.abs(v) <= self.half[1] + 1e-12)
        if self.down == 1:
            on = (forward > 1e-9) & (np.abs(u) <= self.half[0] + 1e-12)
        k = np.clip((u / self.half[0] + 1) / 2 * self.across - 0.5, 0, self.across - 1)
        l = np.clip((1 - v / self.half[1]) / 2 * self.down - 0.5, 0, self.down - 1)
        i, j = np.minimum(k.astype(int), max(self.across - 2, 0)), np.minimum(l.astype(int), max(self.down - 2, 0))
        beside = []
        for row, weight_v in ((j, 1 - (l - j)), (j + 1, l - j)):
            for column, weight_u in ((i, 1 - (k - i)), (i + 1, k - i)):
                inside = (row < self.down) & (column < self.across)
                beside.append((np.where(inside, row * self.across + column, 0), np.where(inside, weight_u * weight_v, 0)))
        return on, beside


def lobe_means(faces, side, pitch, line):
    """[lobe][ray]: the weight of each ray in the mean over each lobe; and the sines of the lobes, as [(column, row)]."""
    step = WAVELENGTH / (side * pitch)
    reach = (side - 1) // 2
    offset = ((np.arange(POINTS) + 0.5) / POINTS - 0.5) * step
    rays = sum(face.across * face.down for face in faces)
    lobes, weights = [], []
    for j in range(0, 1) if line else range(-reach, reach + 1):
        for i in range(-reach, reach + 1):
            if (i * step) ** 2 + (j * step) ** 2 >= 1:
                continue
            sx, sy = np.meshgrid(i * step + offset, [0.0] if line else j * step + offset)
            square = sx**2 + sy**2
            z = np.sqrt(np.maximum(1 - square, 0))
            left, row = square < 1, np.zeros(rays)
            first = 0
            for face in faces:
                # The wave of sines (sx, sy) runs along (-U, -V, 1).
                on, beside = face.rays(-sx, -sy, z)
                on &= left
                left &= ~on
                for number, weight in beside:
                    np.add.at(row, first + number[on], weight[on] / sx.size)
                first += face.across * face.down
            lobes.append((i, j))
            weights.append(row)
    return lobes, np.array(weights)


def haar_matrix(count):
    """The inverse of Haar's transform of a line, basis functions as columns."""
    if count == 1:
        return np.eye(1)
    half = count // 2
    coarse, detail = np.zeros((count, half)), np.zeros((count, half))
    coarse[2 * np.arange(half), np.arange(half)] = coarse[2 * np.arange(half) + 1, np.arange(half)] = 1
    detail[2 * np.arange(half), np.arange(half)] = 0.5
    detail[2 * np.arange(half) + 1, np.arange(half)] = -0.5
    return np.hstack([coarse @ haar_matrix(half), detail])


def basis_of(faces):
    """[ray][function]: all basis functions, products of lines on each face."""
    rays = sum(face.across * face.down for face in faces)
    basis, first = np.zeros((rays, rays)), 0
    for face in faces:
        size = face.across * face.down
        basis[first:first + size, first:first + size] = np.kron(haar_matrix(face.down), haar_matrix(face.across))
        first += size
    return basis


def write(path, faces, values, hogel):
    """`values` is [t][s][ray]."""
    first = 0
    for face in faces:
        size = face.across * face.down
        part = values[:, :, first:first + size].reshape((1, *values.shape[:2], *face.shape()))
        if face.name == "front":
            write_light_field(path, part, hogel, face.half[0], face.half[1], centre=face.centre)
        else:
            add_side(path, face.name, part, hogel, face.half, face.centre)
        first += size


def waves_of(field, rows, columns, height, side, lobes, line):
    """[t][s][line][lobe]: the waves of each hogel, or of each of its lines."""
    samples = field.reshape(rows, height, columns, side).transpose(0, 2, 1, 3)
    across = np.exp(-2j * np.pi * np.outer([i for i, _ in lobes], np.arange(side)) / side)
    if line:
        return np.einsum("tsyx,lx->tsyl", samples, across) / side
    down = np.exp(2j * np.pi * np.outer([j for _, j in lobes], np.arange(side)) / side)
    return np.einsum("tsyx,ly,lx->tsl", samples, down, across)[:, :, None, :] / side**2


def difference(a, b):
    return np.sqrt((np.abs(a - b) ** 2).sum() / (np.abs(b) ** 2).sum())


def compare(checks, hogel, folder, random, name, faces, side, pitch, lines, limit):
    """`lines` is their number in a hogel, 0 for both parallaxes."""
    line = lines > 0
    width, height = side * pitch, lines if line else side
    options = ["--wavelength", f"{WAVELENGTH}m", "--pitch", f"{pitch:.9f}m", "--basis", "haar", "--method",
               "basis-lines" if line else "basis"]
    if line:
        options += ["--line-pitch", f"{width / lines:.9f}m"]

    def make(source):
        run(hogel, "hologram", folder / source, "-o", folder / "o.h5", *options)
        return read_field(folder / "o.h5")

    rays = sum(face.across * face.down for face in faces)
    lobes, weights = lobe_means(faces, side, pitch, line)
    rows, columns = 2, 3
    write(folder / "uniform.h5", faces, np.ones((rows, columns, rays)), width)
    uniform = waves_of(make("uniform.h5"), rows, columns, height, side, lobes, line)
    lit = np.abs(uniform).min(axis=(0, 1, 2)) > 1e-3 * np.abs(uniform).max()
    phases = np.where(lit, uniform / np.maximum(np.abs(uniform), 1e-12), 0)[0, 0] if not line else None
    # Smooth light that differs from hogel to hogel.
    amplitude = 0.5 + 0.2 * random.random((rows, columns, rays)) + 0.3 * np.sin(np.arange(rays) / 7 + random.random((rows, columns, 1)))
    write(folder / "x.h5", faces, amplitude**2, width)
    field = make("x.h5")
    # By (3.24): moduli of a basis function's waves, its fringe, and the sum.
    basis = basis_of(faces)
    coefficients = np.linalg.solve(basis, amplitude.reshape(-1, rays).T).T.reshape(rows, columns, rays)
    step = WAVELENGTH / width
    sines = np.array(lobes) * step
    moduli = (weights @ basis) / np.sqrt(np.sqrt(1 - (sines**2).sum(axis=1)))[:, None]
    moduli *= np.sqrt(step * step * (lines if line else 1))
    across = np.exp(2j * np.pi * np.outer(np.arange(side), [i for i, _ in lobes]) / side)
    summed = np.zeros((rows, height, columns, side), complex)
    for t in range(rows):
        for s in range(columns):
            for y in range(height):
                turn = np.where(lit, uniform[t, s, y] / np.maximum(np.abs(uniform[t, s, y]), 1e-12), 0) if line else phases[0]
                if not line:
                    turn = turn * np.exp(-2j * np.pi * np.array([j for _, j in lobes]) * y / side)
                fringes = across @ (turn[:, None] * moduli)  # [x][function], of this row of samples
                summed[t, y, s] = fringes @ coefficients[t, s]
    summed = summed.reshape(rows * height, columns * side)
    checks.at_most(f"{name}, sum of {rays} fringes", difference(field, summed), limit)
    run(hogel, "compress", folder / "x.h5", "-o", folder / "x.hgl", "--coder", "fringes", "--transform", "haar", "--sqnr", "55")
    checks.at_most(f"{name}, from compressed coefficients", difference(make("x.hgl"), summed), limit + 2e-3)


def main():
    hogel = pathlib.Path(sys.argv[1]).resolve()
    checks, random = Checks(), np.random.default_rng(1)
    front = Face("front", 8, 8)

    def halves(count, rows):
        """The sides of a hemicube, or of a hemisquare of one row."""
        tall = 1 if rows > 1 else 0.1
        sides = [Face("left", count // 2, rows, (0.5, tall), (0.5, 0)), Face("right", count // 2, rows, (0.5, tall), (-0.5, 0))]
        if rows > 1:
            sides += [Face("top", count, rows // 2, (1, 0.5), (0, -0.5)), Face("bottom", count, rows // 2, (1, 0.5), (0, 0.5))]
        return sides

    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        compare(checks, hogel, folder, random, "front", [Face("front", 8, 8, (0.2, 0.2))], 16, 1e-6, 0, MAX_FRONT)
        compare(checks, hogel, folder, random, "hemicube", [front, *halves(8, 8)], 24, 0.25e-6, 0, MAX_FACES)
        compare(checks, hogel, folder, random, "lines", [Face("front", 16, 1, (0.2, 0.01))], 32, 1e-6, 4, MAX_FRONT)
        compare(checks, hogel, folder, random, "lines of a hemisquare", [Face("front", 16, 1, (1, 0.1)), *halves(16, 1)], 32, 0.25e-6, 4,
                MAX_FACES)
    checks.finish()


main()
