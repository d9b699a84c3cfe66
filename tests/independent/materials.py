#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the materials of glTF files with Blender's: the mean of photographs by rays with that of pictures by Cycles.

usage: materials.py HOGEL      exit status 77: numpy or Blender is missing

docs/scenes.md, "Against Blender". A sphere of each material is lit by one directional light and seen from 0.3 m. Both programs read the
same file; Blender's lights are set here, because its importer takes lux for something else. Of matt surfaces under a lobe,
the light that the lobe takes is missing below it, here and in a matt shader under a glossy one; Blender's principled shader adds the two
and is brighter, as much as is stated there.
"""
import base64
import json
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib

sys.dont_write_bytecode = True
try:
    import numpy as np
except ImportError as missing:
    print(missing)
    sys.exit(77)
from common.checks import Checks, run
from common.pictures import read_exr

EYE = 0.3  # metres
SIDE = 20e-3  # of the hologram and of the picture
RADIUS = 8e-3
LIGHT = np.array([-0.5, 0.6, 0.7]) / np.sqrt(1.1)  # towards it
IRRADIANCE = 3.0
SAME, SUM = 0.03, 0.1  # the same model; a diffuse part that the lobe takes nothing from

BLENDER = """
import bpy, json, math, mathutils, sys
import numpy
for name in ('bool', 'int', 'float', 'object'):  # which its importer of version 3.4 uses, and numpy 1.24 has no more
    if name not in vars(numpy):
        setattr(numpy, name, __builtins__[name] if isinstance(__builtins__, dict) else getattr(__builtins__, name))
job = json.load(open(sys.argv[sys.argv.index('--') + 1]))


def layer(material):
    # In place of the principled shader a matt one under a glossy one, with Fresnel's shares.
    tree = material.node_tree
    old = next(n for n in tree.nodes if n.type == 'BSDF_PRINCIPLED')
    out = next(n for n in tree.nodes if n.type == 'OUTPUT_MATERIAL')

    def give(name, to):
        source = old.inputs[name]
        if source.links:
            tree.links.new(source.links[0].from_socket, to)
        elif name != 'Normal':
            to.default_value = source.default_value

    matt, glossy, fresnel, mix = (tree.nodes.new('ShaderNode' + n) for n in ('BsdfDiffuse', 'BsdfGlossy', 'Fresnel', 'MixShader'))
    fresnel.inputs['IOR'].default_value = 1.5
    glossy.inputs['Color'].default_value = (1, 1, 1, 1)
    give('Base Color', matt.inputs['Color'])
    give('Roughness', glossy.inputs['Roughness'])
    for node in (matt, glossy, fresnel):
        give('Normal', node.inputs['Normal'])
    tree.links.new(fresnel.outputs[0], mix.inputs[0])
    tree.links.new(matt.outputs[0], mix.inputs[1])
    tree.links.new(glossy.outputs[0], mix.inputs[2])
    if old.inputs['Alpha'].links:
        alpha, clear = tree.nodes.new('ShaderNodeMixShader'), tree.nodes.new('ShaderNodeBsdfTransparent')
        give('Alpha', alpha.inputs[0])
        tree.links.new(clear.outputs[0], alpha.inputs[1])
        tree.links.new(mix.outputs[0], alpha.inputs[2])
        mix = alpha
    tree.links.new(mix.outputs[0], out.inputs['Surface'])


for material, layered in [(f, False) for f in job['files']] + [(f, True) for f in job['layered']]:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=material)
    for thing in [o for o in bpy.data.objects if o.type in ('LIGHT', 'CAMERA')]:
        bpy.data.objects.remove(thing)
    if layered:
        layer(next(o for o in bpy.data.objects if o.type == 'MESH').data.materials[0])
    turned = lambda v: mathutils.Vector((v[0], -v[2], v[1]))  # y upwards becomes z upwards
    sun = bpy.data.objects.new('sun', bpy.data.lights.new('sun', 'SUN'))
    sun.data.energy, sun.data.angle = job['irradiance'], 0
    sun.rotation_euler = turned([-x for x in job['light']]).to_track_quat('-Z', 'Y').to_euler()
    camera = bpy.data.objects.new('camera', bpy.data.cameras.new('camera'))
    camera.location = turned((0, 0, job['eye']))
    camera.rotation_euler = (math.pi / 2, 0, 0)
    camera.data.angle, camera.data.clip_start = 2 * math.atan(job['side'] / 2 / job['eye']), 0.01
    scene = bpy.context.scene
    for thing in (sun, camera):
        scene.collection.objects.link(thing)
    scene.camera, scene.world = camera, None
    render = scene.render
    render.engine = 'CYCLES'
    render.resolution_x = render.resolution_y = 96
    render.image_settings.file_format, render.image_settings.color_depth = 'OPEN_EXR', '32'
    render.image_settings.color_mode = 'RGB'
    render.filepath = material.replace('.gltf', '.layered.exr' if layered else '.blender.exr')
    cycles = scene.cycles
    cycles.samples, cycles.use_adaptive_sampling, cycles.use_denoising = 64, False, False
    cycles.max_bounces, cycles.transparent_max_bounces, cycles.seed = 0, 16, 1
    bpy.ops.render.render(write_still=True)
"""


def png(texels):
    """Of rows of R, G, B or R, G, B, A, 0 to 255, as a data URI."""
    texels = np.asarray(texels, np.uint8)
    height, width, channels = texels.shape
    raw = b"".join(b"\0" + row.tobytes() for row in texels)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    head = struct.pack(">IIBBBBB", width, height, 8, {3: 2, 4: 6}[channels], 0, 0, 0)
    data = b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(raw)) + chunk(b"IEND", b"")
    return "data:image/png;base64," + base64.b64encode(data).decode()


def checks_of(a, b, squares=8):
    return [[a if (row // 4 + column // 4) % 2 else b for column in range(4 * squares)] for row in range(4 * squares)]


def waves():
    """A normal map of waves along u."""
    slopes = 0.5 * np.sin(2 * np.pi * np.arange(64) / 16)
    normals = np.stack([-slopes, 0 * slopes, 1 + 0 * slopes], -1) / np.sqrt(1 + slopes[:, None] ** 2)
    return np.repeat(np.round(127.5 * normals + 127.5)[None], 64, 0)


def sphere(columns=96, rows=48):
    u, v = np.meshgrid(np.linspace(0, 1, columns + 1), np.linspace(0, 1, rows + 1))
    around, down = 2 * np.pi * u, np.pi * v
    normals = np.stack([np.sin(down) * np.cos(around), np.cos(down), -np.sin(down) * np.sin(around)], -1).reshape(-1, 3)
    triangles = []
    for row in range(rows):
        for column in range(columns):
            a = row * (columns + 1) + column
            b, c, d = a + 1, a + columns + 1, a + columns + 2
            triangles += ([] if row == 0 else [(a, c, b)]) + ([] if row == rows - 1 else [(b, c, d)])
    return normals, np.stack([u, v], -1).reshape(-1, 2), np.array(triangles, np.uint32)


def write(path, material, pictures=()):
    normals, coordinates, triangles = sphere()
    positions = RADIUS * normals
    parts = [positions.astype("<f4"), normals.astype("<f4"), coordinates.astype("<f4"), triangles.astype("<u4")]
    views, offset = [], 0
    for part in parts:
        views.append({"buffer": 0, "byteOffset": offset, "byteLength": part.nbytes})
        offset += part.nbytes
    count = len(positions)
    used = ["KHR_lights_punctual", "KHR_texture_transform", *material.get("extensions", {})]
    turn = np.array([-LIGHT[1], LIGHT[0], 0, 1 + LIGHT[2]])  # the quaternion that takes z to the way to the light
    json.dump({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}], "extensionsUsed": used,
        "nodes": [{"mesh": 0}, {"rotation": list(turn / np.linalg.norm(turn)), "extensions": {"KHR_lights_punctual": {"light": 0}}}],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "directional", "intensity": IRRADIANCE}]}},
        # Cycles interpolates between texels before it decodes them, so that only nearest texels of colours are comparable.
        "materials": [material], "textures": [{"source": i, "sampler": 0} for i in range(len(pictures))],
        "samplers": [{"magFilter": 9729 if "normalTexture" in material else 9728}],
        "images": [{"uri": png(picture)} for picture in pictures],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3, "material": 0}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": count, "type": "VEC3", "min": [-RADIUS] * 3, "max": [RADIUS] * 3},
            {"bufferView": 1, "componentType": 5126, "count": count, "type": "VEC3"},
            {"bufferView": 2, "componentType": 5126, "count": count, "type": "VEC2"},
            {"bufferView": 3, "componentType": 5125, "count": triangles.size, "type": "SCALAR"}],
        "bufferViews": views,
        "buffers": [{"byteLength": offset, "uri": "data:application/octet-stream;base64," +
                     base64.b64encode(b"".join(part.tobytes() for part in parts)).decode()}]}, open(path, "w"))


def metal(color=(1, 1, 1, 1), metallic=0, roughness=0.5, **more):
    return {"baseColorFactor": list(color), "metallicFactor": metallic, "roughnessFactor": roughness, **more}


TEXTURE = {"index": 0}
MATERIALS = {
    # name: material, pictures, largest difference to a matt shader under a glossy one (none: not compared) and to the principled one
    "plaster": ({"pbrMetallicRoughness": metal(roughness=1)}, [], 0.06, SUM),
    "plastic": ({"pbrMetallicRoughness": metal((0.8, 0.1, 0.05, 1))}, [], SAME, SUM),
    "lacquer": ({"pbrMetallicRoughness": metal((0.1, 0.3, 0.8, 1), 0, 0.25)}, [], SAME, SUM),
    "gold": ({"pbrMetallicRoughness": metal((1, 0.77, 0.34, 1), 1, 0.4)}, [], None, SAME),
    "texture": ({"pbrMetallicRoughness": metal(baseColorTexture=TEXTURE)}, [checks_of((200, 60, 20), (30, 90, 220))], SAME, SUM),
    "transform": ({"pbrMetallicRoughness": metal(baseColorTexture={**TEXTURE, "extensions": {
        "KHR_texture_transform": {"offset": [0.25, 0.1], "rotation": 0.5, "scale": [0.5, 0.25]}}})},
                  [checks_of((250, 60, 20), (30, 90, 20))], SAME, SUM),
    "metal texture": ({"pbrMetallicRoughness": metal((0.9, 0.8, 0.7, 1), 1, 1, metallicRoughnessTexture=TEXTURE)},
                      [checks_of((0, 200, 255), (0, 100, 0))], None, SUM),
    "glow": ({"pbrMetallicRoughness": metal((0, 0, 0, 1), 0, 1), "emissiveFactor": [1, 1, 1], "emissiveTexture": TEXTURE,
              "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 3}}},
             [checks_of((255, 120, 60), (60, 90, 20))], None, SAME),
    "relief": ({"pbrMetallicRoughness": metal(roughness=0.6), "normalTexture": TEXTURE}, [waves()], None, SUM),
}


def read(path):
    """Pixels of each channel."""
    return np.asarray(read_exr(path)).reshape(3, -1)


def main():
    hogel = pathlib.Path(sys.argv[1]).resolve()
    blender = shutil.which("blender")
    if blender is None:
        print("skipped: Blender is not installed (Debian's package blender)")
        sys.exit(77)
    checks = Checks()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        files = []
        for key, (material, pictures, *_) in MATERIALS.items():
            files.append(folder / (key.replace(" ", "-") + ".gltf"))
            write(files[-1], material, pictures)
        layered = [str(file) for file, (_, _, limit, _) in zip(files, MATERIALS.values()) if limit]
        job = {"files": [str(file) for file in files], "layered": layered, "irradiance": IRRADIANCE, "light": list(LIGHT), "eye": EYE,
               "side": SIDE}
        (folder / "job.json").write_text(json.dumps(job))
        (folder / "render.py").write_text(BLENDER)
        made = subprocess.run([blender, "-b", "-noaudio", "--factory-startup", "-t", "2", "--python-exit-code", "1", "--python",
                               folder / "render.py", "--", folder / "job.json"], capture_output=True, text=True, check=False)
        if made.returncode != 0:
            print("skipped: Blender does not render these files:", made.stdout[-300:], made.stderr[-300:])
            sys.exit(77)
        for file, key in zip(files, MATERIALS):
            run(hogel, "photo", file, "-o", folder / "photograph.exr", "--as-is", "--shading", "direct", "--geometric", "--hogels",
                "96x96", "--size", f"{SIDE * 1e3}mm", "--pupil", "1mm", "--resolution", "96", "--samples", "2")
            picture = folder / "photograph.exr"
            for kind, limit in zip(("layered", "blender"), MATERIALS[key][2:]):
                if limit is None:
                    continue
                name = "Cycles' matt shader under a glossy one" if kind == "layered" else "Cycles' principled shader"
                ours, theirs = read(picture), read(file.with_suffix(f".{kind}.exr"))
                means = ours.mean(1), theirs.mean(1)
                checks.at_most(f"{key}: {means[0].round(4)}, by {name} {means[1].round(4)}, error of the mean",
                               abs(means[0].mean() / means[1].mean() - 1), limit)
                checks.at_least(f"{key}: correlation of the pictures", np.corrcoef(ours.ravel(), theirs.ravel())[0, 1], 0.95)
    checks.finish()


if __name__ == "__main__":
    main()
