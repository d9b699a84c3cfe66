#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the radiance of rendered and baked scenes with closed forms.

usage: radiometry.py HOGEL      exit status 77: numpy or h5py is missing

docs/shading.md, and docs/scenes.md for the lights of mesh files and for the scenes with a closed form. Light of the irradiance E at
normal incidence shows on a matt surface of colour a as a E max(0, n l)/pi, ambient light as a times its radiance.
"""
import pathlib
import sys
import tempfile

sys.dont_write_bytecode = True
try:
    import h5py
    import numpy as np

    from common.light_fields import positions, read_radiance
    from common.meshes import Scene, read_colours
except ImportError as missing:
    print(missing)
    sys.exit(77)
from common.checks import Checks, run

ALGORITHMS = ("epi", "raytrace", "zbuffer", "simplex", "simplex-strips", "simploid", "simplex3d", "oblique", "mvr")
HOGELS, DIRECTIONS, SIZE, FIELD = 12, 12, 4e-3, 40  # degrees
# The way to each of the two lights of mesh files, and its irradiance at normal incidence.
LIGHTS = [(np.array(way) / np.linalg.norm(way), np.array(irradiance))
          for way, irradiance in (((-0.6, 0.75, 0.6), (2.4, 2.34, 2.24)), ((0.8, 0.1, 0.5), (0.42, 0.46, 0.54)))]
AMBIENT = np.array([0.08, 0.08, 0.09])
BALL = {"colour": np.array([0.8, 0.55, 0.3]), "ambient": np.array([0.1, 0.1, 0.12]), "irradiance": np.array([2.4, 2.3, 2.1]),
        "light": np.array([-0.5, 0.6, 0.7]) / np.sqrt(1.1),
        "radius": 0.3 * SIZE}


def shaped(colours):
    """[channel] as [c][t][s][v][u]."""
    return np.asarray(colours)[:, None, None, None, None]


def rays():
    s = positions(HOGELS, SIZE / HOGELS)
    u = positions(DIRECTIONS, 2 * np.tan(np.radians(FIELD / 2)) / DIRECTIONS)
    t, s, v, u = np.meshgrid(-s, s, -u, u, indexing="ij")
    return s, t, u, v


def render(hogel, folder, scene, *options):
    run(hogel, "render", scene, "-o", folder / "light.h5", "--hogels", f"{HOGELS}x{HOGELS}", "--directions",
        f"{DIRECTIONS}x{DIRECTIONS}", "--size", f"{SIZE * 1e3!r}mm", "--fov", f"{FIELD}deg", "--float", "--depth", *options)
    return read_radiance(folder / "light.h5")


class Plane:
    """A tilted square about (0, 0, -4 mm) and what rays meet of it."""

    def __init__(self):
        self.right = np.array([12e-3, 0, 2.4e-3])
        self.up = np.array([0, 12e-3, -1.8e-3])
        self.corner = np.array([0, 0, -4e-3]) - (self.right + self.up) / 2
        normal = np.cross(self.right, self.up)
        self.normal = normal / np.linalg.norm(normal)
        s, t, u, v = rays()
        # The ray's points are (s, t, 0) + zeta (u, v, -1).
        zeta = (self.normal @ self.corner - (self.normal[0] * s + self.normal[1] * t)) / (
            self.normal[0] * u + self.normal[1] * v - self.normal[2])
        self.depth = zeta
        self.seen = np.stack([s + u * zeta, t + v * zeta, -zeta], axis=-1)
        viewer = np.stack([-u, -v, np.ones_like(u)], axis=-1)
        self.viewer = viewer / np.linalg.norm(viewer, axis=-1, keepdims=True)


def matt(checks, hogel, folder, plane):
    """A PLY file without materials: white, and no lobe."""
    square = Scene()
    square.patch(plane.corner, plane.right, plane.up, 10)
    square.write_ply(folder / "matt.ply")
    right = shaped(AMBIENT + sum(irradiance * (way @ plane.normal) for way, irradiance in LIGHTS) / np.pi)
    for shading in ("vertex", "direct", "shadowed"):
        for algorithm in ALGORITHMS if shading != "shadowed" else ("epi",):
            light = render(hogel, folder, folder / "matt.ply", "--as-is", "--shading", shading, "--algorithm", algorithm)
            checks.at_most(f"matt, {shading}, {algorithm}, largest error of radiance", np.abs(light / right - 1).max(), 1e-5)
            with h5py.File(folder / "light.h5") as file:
                checks.at_most(f"matt, {shading}, {algorithm}, largest error of depth in metres",
                               np.abs(file["depth"][()] - plane.depth).max(), 1e-8)


def lobe(normal, viewer, way, roughness):
    """Of a reflectance at normal incidence of 0 and of 1: distribution of Trowbridge and Reitz, Smith's correlated masking,
    Schlick's reflectance; times the cosine of the light."""
    half = way + viewer
    half = half / np.linalg.norm(half, axis=-1, keepdims=True)
    nl, nv, nh = (np.maximum(0, (each * normal).sum(axis=-1)) for each in (way, viewer, half))
    a2 = roughness**4
    spread = a2 / (np.pi * (nh**2 * (a2 - 1) + 1) ** 2)
    masking = 0.5 / (nl * np.sqrt(nv**2 * (1 - a2) + a2) + nv * np.sqrt(nl**2 * (1 - a2) + a2) + 1e-12)
    grazing = (1 - (viewer * half).sum(axis=-1)) ** 5
    return spread * masking * nl * grazing, spread * masking * nl


def albedos(cosines, roughness):
    """Of the lobe, by a sum over half vectors of the distribution: the light in uniform surroundings of radiance 1."""
    count = 200
    at, turn = np.meshgrid((np.arange(count) + 0.5) / count, 2 * np.pi * (np.arange(count) + 0.5) / count)
    a2 = roughness**4
    nh = np.sqrt((1 - at) / (1 + (a2 - 1) * at))
    sine = np.sqrt(1 - nh**2)
    half = np.stack([sine * np.cos(turn), sine * np.sin(turn), nh], axis=-1)
    found = []
    for cosine in cosines:
        viewer = np.array([np.sqrt(1 - cosine**2), 0, cosine])
        vh = half @ viewer
        way = 2 * vh[..., None] * half - viewer
        nl = np.maximum(0, way[..., 2])
        masking = 0.5 / (nl * np.sqrt(cosine**2 * (1 - a2) + a2) + cosine * np.sqrt(nl**2 * (1 - a2) + a2) + 1e-12)
        # The density of half vectors is D nh, that of ways D nh/4 vh.
        weight = np.where((vh > 0) & (nl > 0), masking * nl * 4 * vh / nh, 0)
        found.append(((weight * (1 - vh) ** 5).mean(), weight.mean()))
    return np.array(found).T


def reflected(pair, colour):
    grazing, normal = pair
    return grazing + colour * (normal - grazing)


def glossy(checks, hogel, folder, plane):
    """A metal has no matt part; under the lobe of lacquer it gets what that leaves on the way in and out."""
    colour = np.array([0.9, 0.6, 0.3])
    cosine = plane.viewer @ plane.normal
    table = np.linspace(cosine.min(), cosine.max(), 12)
    node, weight = np.polynomial.legendre.leggauss(24)
    for metallic, roughness in ((1.0, 0.3), (1.0, 0.6), (1.0, 0.9), (0.0, 0.4), (0.0, 1.0)):
        scene = Scene()
        scene.patch(plane.corner, plane.right, plane.up, 4, colour, metallic=metallic, roughness=roughness)
        scene.write(folder / "glossy.gltf")
        lobes = [lobe(plane.normal, plane.viewer, way, roughness) for way, _ in LIGHTS]
        seen = [np.interp(cosine, table, row) for row in albedos(table, roughness)]
        lit = albedos([way @ plane.normal for way, _ in LIGHTS], roughness)
        mean = (albedos((node + 1) / 2, roughness) * weight * (node + 1) / 2).sum(axis=1)
        right = []
        for c in range(3):
            normal = colour[c] if metallic else 0.04
            below = (1 - metallic) * colour[c] * (1 - reflected(seen, normal))
            light = AMBIENT[c] * (reflected(seen, normal) + below)
            for (way, irradiance), pair, albedo in zip(LIGHTS, lobes, lit.T):
                through = (1 - reflected(albedo, normal)) / (1 - reflected(mean, normal))
                light = light + irradiance[c] * (reflected(pair, normal) + below * through * (way @ plane.normal) / np.pi)
            right.append(light)
        right = np.stack(right)
        for algorithm in ("epi", "raytrace", "oblique"):
            light = render(hogel, folder, folder / "glossy.gltf", "--as-is", "--shading", "direct", "--algorithm", algorithm,
                           "--cache-spacing", "0")
            checks.at_most(f"{'metal' if metallic else 'lacquer'} of roughness {roughness}, {algorithm}, largest error over the "
                           "largest radiance", np.abs(light - right).max() / right.max(), 1e-3)


def shadows(checks, hogel, folder, plane):
    """A square hides the lights from parts of the plane."""
    scene = Scene()
    scene.patch(plane.corner, plane.right, plane.up, 240)
    middle, side = np.array([0.2e-3, 0.3e-3, -2.4e-3]), 1.8e-3
    scene.patch(middle - np.array([side, side, 0]) / 2, [side, 0, 0], [0, side, 0], 1)
    scene.write_ply(folder / "shadow.ply")
    s, t, u, v = rays()
    x, y = s - u * middle[2], t - v * middle[2]
    clear = np.maximum(np.abs(x - middle[0]), np.abs(y - middle[1])) - side / 2 > 0.02e-3
    right, states = shaped(AMBIENT), 0
    for way, irradiance in LIGHTS:
        # Where the way to the light crosses the square's plane.
        crossing = plane.seen + ((middle[2] - plane.seen[..., 2]) / way[2])[..., None] * way
        beside = np.maximum(np.abs(crossing[..., 0] - middle[0]), np.abs(crossing[..., 1] - middle[1])) - side / 2
        clear &= np.abs(beside) > 0.1e-3  # by vertices edges are as wide as four squares
        right = right + shaped(irradiance) * (way @ plane.normal) / np.pi * (beside > 0)
        states = 2 * states + (beside > 0)
    counts = "/".join(str((clear & (states == state)).sum()) for state in range(4))
    for shading in ("vertex", "direct", "shadowed"):
        light = render(hogel, folder, folder / "shadow.ply", "--as-is", "--shading", shading)
        checks.at_most(f"shadow, {shading}, largest error away from its edges, {counts} rays in light of none/one/other/both",
                       np.abs(light / right - 1)[:, clear].max(), 2e-3)


def ball(checks, hogel, folder):
    s, t, u, v = rays()
    origin, direction = np.stack([s, t, 0 * s], axis=-1), np.stack([u, v, -np.ones_like(u)], axis=-1)
    square = (direction**2).sum(axis=-1)
    nearest = -(origin * direction).sum(axis=-1) / square
    distance = np.linalg.norm(origin + nearest[..., None] * direction, axis=-1)
    met = distance < BALL["radius"]
    depth = nearest - np.sqrt(np.maximum(0, BALL["radius"] ** 2 - distance**2) / square)
    normal = (origin + depth[..., None] * direction) / BALL["radius"]
    lit = np.maximum(0, normal @ BALL["light"]) / np.pi
    right = np.where(met, shaped(BALL["colour"]) * (shaped(BALL["ambient"]) + shaped(BALL["irradiance"]) * lit),
                     shaped((0.02, 0.02, 0.03)))
    clear = np.abs(distance - BALL["radius"]) > SIZE / 1000
    for algorithm in ("epi", "raytrace", "zbuffer", "oblique", "mvr"):
        light = render(hogel, folder, "sphere", "--algorithm", algorithm)
        checks.at_most(f"sphere, {algorithm}, largest error of radiance", np.abs(light - right)[:, clear].max(), 1e-3)
        with h5py.File(folder / "light.h5") as file:
            checks.at_most(f"sphere, {algorithm}, largest error of depth over D",
                           np.abs(file["depth"][()] - depth)[clear & met].max() / SIZE, 1e-3)


def shining(checks, hogel, folder):
    """The built-in disc of radiance 1 and radius 0.005 D at (0.1 D, 0.05 D, zeta = 0.15 D)."""
    s, t, u, v = rays()
    radius = 0.005 * SIZE
    for algorithm in ALGORITHMS:
        light = render(hogel, folder, "point", "--algorithm", algorithm)
        away = np.hypot(s + u * 0.15 * SIZE - 0.1 * SIZE, t + v * 0.15 * SIZE - 0.05 * SIZE)
        inside, outside = away < 0.98 * radius, away > 1.02 * radius
        checks.at_most(f"disc, {algorithm}, {inside.sum()} rays inside, error", np.abs(light[:, inside] - 1).max(), 1e-6)
        checks.at_most(f"disc, {algorithm}, light outside", light[:, outside].max(), 0)


def baked(checks, hogel, folder):
    """In a closed room whose walls glow and reflect, n bounces give e (1 + a + ... + a^n)."""
    emission, colour, bounces = 0.25, np.array([0.9, 0.5, 0.1]), 6
    scene = Scene()
    for axis in range(3):
        right, up = np.roll([1, 0, 0], axis + 1) * 2e-3, np.roll([1, 0, 0], axis + 2) * 2e-3
        out = np.roll([1, 0, 0], axis) * 1e-3
        scene.patch(-out - (right + up) / 2, right, up, 6, colour, emission=[emission] * 3)
        scene.patch(out - (right + up) / 2, up, right, 6, colour, emission=[emission] * 3)
    scene.write(folder / "room.gltf")
    run(hogel, "bake", folder / "room.gltf", "-o", folder / "room.glb", "--bounces", bounces, "--rays", 64)
    colours = read_colours(folder / "room.glb")
    right = emission * (1 - colour ** (bounces + 1)) / (1 - colour)
    checks.at_most("room, radiance of walls, largest error", np.abs(colours / right - 1).max(), 1e-4)


def main():
    hogel = pathlib.Path(sys.argv[1]).resolve()
    checks, plane = Checks(), Plane()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        matt(checks, hogel, folder, plane)
        glossy(checks, hogel, folder, plane)
        shadows(checks, hogel, folder, plane)
        ball(checks, hogel, folder)
        shining(checks, hogel, folder)
        baked(checks, hogel, folder)
    checks.finish()


main()
