#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes a few small valid files for each fuzz target to begin with.

usage: make_seeds.py HOGEL FOLDER      HOGEL: the program; seeds go to FOLDER/<target>/
"""
import base64
import json
import pathlib
import struct
import subprocess
import sys
import tempfile

try:
    import h5py
except ImportError:
    h5py = None  # then there are no files in chunks

SMALL = "--hogels 3x2 --directions 4x3 -q".split()
MESH_EXTENSIONS = [".gltf", ".glb", ".obj", ".ply", ".stl", ".off", ".fbx", ".xyz", ".dat", ".layers"]  # as in mesh_fuzz.cpp
PICTURE_EXTENSIONS = [".png", ".exr", ".bmp", ".jpg", ".tga", ".gif", ".hdr", ".ppm", ".pfm"]  # as in picture_fuzz.cpp

TRIANGLE = {
    ".obj": b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    ".off": b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
    ".ply": b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
            b"element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
    ".stl": b"solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
            b"endsolid a\n",
    ".gltf": b'{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],"meshes":[{"primitives":'
             b'[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",'
             b'"min":[0,0,0],"max":[1,1,0]}],"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":'
             b'"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}',
}

# Further files: point clouds, and a document with looks, instances and lights.
MORE_MESHES = {
    "stack.layers": b'{"layers":[{"picture":"none.png","depth":"-5mm"},{"picture":"no.png","depth":0.01}]}',
    "points.xyz": b"# x y z r g b\n0 0 0 255 0 0\n1 0 0 0 255 0\n0 1 0 0 0 255\n1 1 0 9 9 9\n0 0 1 1 2 3\n1 0 1 1 2 3\n0 1 1 1 2 3\n",
    "points.ply": b"ply\nformat ascii 1.0\nelement vertex 7\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
                  b"0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 0 1\n1 0 1\n0 1 1\n",
    "points.dat": b"7\n" + b"".join(b"%d %d %d %d 0.5 %d\n" % (i, i & 1, i >> 1 & 1, i >> 2, i) for i in range(7)),
    "faces.ply": b"ply\nformat ascii 1.0\ncomment TextureFile a.ppm\nelement face 1\nproperty list uchar int vertex_indices\n"
                 b"property list uchar float texcoord\nproperty int texnumber\nproperty uchar red\nproperty uchar green\n"
                 b"property uchar blue\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                 b"element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
                 b"3 0 1 2 6 0 0 1 0 0 1 0 255 0 0\n0 0 0\n1 0 0\n0 1 0\n7 0 1 2 -1 2 1 0\n",
    "faces.off": b"COFF\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n0 1 0 1 0 0 1\n3 0 1 2 255 0 0\n",
    # A triangle as libdraco packs it.
    "draco.gltf": TRIANGLE[".gltf"].replace(
        b'{"attributes":{"POSITION":0}}', b'{"attributes":{"POSITION":0},"extensions":{"KHR_draco_mesh_compression":'
        b'{"bufferView":0,"attributes":{"POSITION":0}}}}').replace(b'"accessors":[{"bufferView":0,', b'"accessors":[{').replace(
        b'"byteLength":36', b'"byteLength":61').replace(
        b"AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA",
        b"RFJBQ08CAgEAAAABAwEAAQIBAQAJAwAAAAAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAAAAA=="),
    "looks.gltf": TRIANGLE[".gltf"].replace(b'"nodes":[{"mesh":0}]', b'"nodes":[{"mesh":0,"extensions":{"EXT_mesh_gpu_instancing":'
                  b'{"attributes":{"TRANSLATION":0}},"KHR_lights_punctual":{"light":0}}}],"extensions":{"KHR_lights_punctual":'
                  b'{"lights":[{"type":"spot","color":[1,1,0]}]}},"materials":[{"alphaMode":"MASK","emissiveFactor":[1,1,1],'
                  b'"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,0.7]}}]').replace(
                  b'{"attributes":{"POSITION":0}}', b'{"attributes":{"POSITION":0},"material":0}'),
}


def pack_attributes(elements, stride):
    """Whole bytes as a stream of EXT_meshopt_compression, mode ATTRIBUTES: deltas of each byte, none of them shortened."""
    count = len(elements) // stride
    assert count <= 256 and stride % 4 == 0
    groups = (count + 15) // 16
    stream = bytes([0xa0])
    for k in range(stride):
        column = elements[k::stride]
        deltas = [(b - a) & 255 for a, b in zip(column[:1] + column, column)]
        coded = bytes(((d << 1) & 255) ^ (255 if d >= 128 else 0) for d in deltas)
        stream += bytes([255]) * ((groups + 3) // 4) + coded.ljust(16 * groups, b"\0")
    return stream + elements[:stride].rjust(max(stride, 32), b"\0")


def pack_indices(indices):
    """The same of mode INDICES: zigzag deltas, seven bits a byte."""
    stream, last = bytes([0xd1]), 0
    for index in indices:
        delta = index - last
        value, last = (2 * delta if delta >= 0 else -2 * delta - 1) << 1, index
        while value > 127:
            stream, value = stream + bytes([value & 127 | 128]), value >> 7
        stream += bytes([value])
    return stream + bytes(4)


def packed_gltf():
    positions, normals = struct.pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0), struct.pack("12b", *[0, 0, 127, 0] * 3)
    views = [(positions, 12, 3, "ATTRIBUTES", "NONE", pack_attributes(positions, 12)),
             (normals, 4, 3, "ATTRIBUTES", "OCTAHEDRAL", pack_attributes(normals, 4)),
             (bytes(6), 2, 3, "INDICES", "NONE", pack_indices([0, 1, 2]))]
    data, placed = b"", []
    for whole, stride, count, mode, filtered, stream in views:
        placed.append({"buffer": 1, "byteLength": len(whole), "extensions": {"EXT_meshopt_compression": {
            "buffer": 0, "byteOffset": len(data), "byteLength": len(stream), "byteStride": stride, "count": count, "mode": mode,
            "filter": filtered}}})
        if mode == "ATTRIBUTES":
            placed[-1]["byteStride"] = stride
        data += stream
    names = ["EXT_meshopt_compression", "KHR_mesh_quantization"]
    return json.dumps({
        "asset": {"version": "2.0"}, "extensionsUsed": names, "extensionsRequired": names, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2}]}], "bufferViews": placed,
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
                      {"bufferView": 1, "componentType": 5120, "normalized": True, "count": 3, "type": "VEC3"},
                      {"bufferView": 2, "componentType": 5123, "count": 3, "type": "SCALAR"}],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()},
                    {"byteLength": 66, "extensions": {"EXT_meshopt_compression": {"fallback": True}}}]}).encode()


MORE_MESHES["packed.gltf"] = packed_gltf()

PLAIN_PICTURES = {
    "8.ppm": b"P6\n# colours\n2 2\n255\n" + bytes(range(12)),
    "10.ppm": b"P5\n2 1\n1023\n" + bytes([3, 255, 0, 7]),
    "little.pfm": b"PF\n1 2\n-1.0\n" + bytes(24),
    "big.pfm": b"Pf\n2 1\n1.0\n" + bytes([63, 128, 0, 0, 64, 0, 0, 0]),
}

# Four cameras 1 apart, whose pictures agree at the distance 10.
CAMERAS = ('{"w": 2, "h": 2, "fl_x": 20, "frames": [' + ", ".join(
    f'{{"file_path": "input_Cam00{2 * r + c}.ppm", "cx": {1 + 2 * c}, "cy": {1 + 2 * r}, "transform_matrix": '
    f'[[1, 0, 0, {c}], [0, 1, 0, {-r}], [0, 0, 1, 0], [0, 0, 0, 1]]}}' for r in range(2) for c in range(2)) + "]}").encode()
PARAMETERS = (b"[intrinsics]\nfocal_length_mm = 100\nimage_resolution_x_px = 2\nimage_resolution_y_px = 2\nsensor_size_mm = 35\n"
              b"[extrinsics]\nnum_cams_x = 2\nnum_cams_y = 2\nbaseline_mm = 20\nfocus_distance_m = 0.6\n")

# Ways in which other programs store samples: the version of the format, which decides how chunks are found, and filters.
CHUNKS = {
    "v108": (("v108", "v108"), {}),
    "v108-gzip": (("v108", "v108"), {"compression": "gzip", "shuffle": True, "fletcher32": True}),
    "v108-lzf": (("v108", "v108"), {"compression": "lzf"}),
    "v110-fixed": (("latest", "latest"), {}),
    "v110-gzip": (("latest", "latest"), {"compression": "gzip"}),
    "v110-extensible": (("latest", "latest"), {"growing": 1, "shuffle": True}),
    "v110-tree": (("latest", "latest"), {"growing": 2, "fletcher32": True}),
    "v110-single": (("latest", "latest"), {"whole": True, "compression": "gzip"}),
}


def rewrite_in_chunks(source, target, storage):
    """The same file as h5py writes it, with samples in chunks."""
    versions, how = CHUNKS[storage]
    how = dict(how)
    growing, whole = how.pop("growing", 0), how.pop("whole", False)
    with h5py.File(source, "r") as old, h5py.File(target, "w", libver=versions) as new:
        def copy_attributes(a, b):
            for name, value in a.attrs.items():
                b.attrs[name] = value

        def visit(name, thing):
            if isinstance(thing, h5py.Group):
                copy_attributes(thing, new.require_group(name))
                return
            chunks = thing.shape if whole else tuple(max(1, (n + 1) // 2) for n in thing.shape)
            limits = tuple(None if axis < growing else n for axis, n in enumerate(thing.shape))
            copy_attributes(thing, new.create_dataset(name, data=thing[...], chunks=chunks, maxshape=limits, **how))

        copy_attributes(old, new)
        old.visititems(visit)


# A complex field of OpenHolo of 2 x 2 samples: two heads, a wavelength, real parts, imaginary parts.
OPENHOLO = (struct.pack("<2sQ2B3I", b"OH", 24 + 73 + 64, 5, 0, 0, 0, 97) +
            struct.pack("<3I2dBI7B2dQB", 73, 2, 2, 8e-6, 8e-6, 1, 1, 2, 2, 1, 10, 1, 2, 0, -1, 1, 64, 0) +
            struct.pack("<9d", 532e-9, *range(8)))


def make(hogel, corpus):
    def run(*words):
        subprocess.run([hogel, *words], check=True, cwd=corpus, stdout=subprocess.DEVNULL)

    def put(target, name, data):
        (corpus / target).mkdir(parents=True, exist_ok=True)
        (corpus / target / name).write_bytes(data)

    with tempfile.TemporaryDirectory() as folder:
        made = pathlib.Path(folder)
        run("render", "sphere", "-o", made / "a.h5", "--fov", "1deg", "--size", "0.3mm", *SMALL)
        run("hologram", made / "a.h5", "-o", made / "b.h5", "--wavelength", "532nm", "-q", "--pitch", "20um")
        for name in ("a.h5", "b.h5"):
            put("hdf5_fuzz", name, (made / name).read_bytes())
            for storage in CHUNKS if h5py else ():
                rewrite_in_chunks(made / name, made / "c.h5", storage)
                put("hdf5_fuzz", f"{storage}-{name}", (made / "c.h5").read_bytes())
        run("render", "sphere", "-o", made / "l.h5", "--fov", "1deg", "--size", "0.3mm", "--depth", "--part", "1/1", *SMALL)
        run("hologram", made / "a.h5", "-o", made / "f.h5", "--wavelength", "532nm", "-q", "--pitch", "20um", "--part", "1/1")
        for name in ("l", "f"):
            put("part_fuzz", name, (made / f"{name}.part-1-of-1").read_bytes())
        for coder in ("hogel", "threepass", "jpeg4d"):
            run("compress", made / "a.h5", "-o", made / "a.hgl", "--coder", coder, "-q")
            put("stream_fuzz", coder, (made / "a.hgl").read_bytes())
        run("propagate", made / "b.h5", "-o", made / "b.npy", "--distance", "1mm", "-q")
        put("external_field_fuzz", "npy", b"\0" + (made / "b.npy").read_bytes())
        for i, ending in ((1, "mat"), (2, "npz"), (4, "exr")):
            run("propagate", made / "b.h5", "-o", made / f"b.{ending}", "--distance", "1mm", "--display", "field", "-q")
            put("external_field_fuzz", ending, bytes([i]) + (made / f"b.{ending}").read_bytes())
        put("external_field_fuzz", "ohc", b"\3" + OPENHOLO)
        (made / "a.off").write_bytes(TRIANGLE[".off"])
        run("bake", made / "a.off", "-o", made / "a.glb", "--rays", "1", "-q")
        put("mesh_fuzz", "glb", bytes([MESH_EXTENSIONS.index(".glb")]) + (made / "a.glb").read_bytes())
        for extension, data in TRIANGLE.items():
            put("mesh_fuzz", extension[1:], bytes([MESH_EXTENSIONS.index(extension)]) + data)
        for name, data in MORE_MESHES.items():
            put("mesh_fuzz", name, bytes([MESH_EXTENSIONS.index(pathlib.Path(name).suffix)]) + data)
        for i, extension in enumerate(PICTURE_EXTENSIONS[:2]):
            run("photo", made / "a.h5", "-o", made / ("p" + extension), "--resolution", "8", "-q")
            put("picture_fuzz", extension[1:], bytes([i]) + (made / ("p" + extension)).read_bytes())
        run("export", made / "a.h5", "-o", made / "views.npy", "--layout", "npy", "-q")
        put("view_set_fuzz", "npy", b"\0" + (made / "views.npy").read_bytes())
        run("export", made / "a.h5", "-o", made / "views.mat", "--layout", "mat", "-q")
        put("view_set_fuzz", "mat", b"\5" + (made / "views.mat").read_bytes())
        put("view_set_fuzz", "quilt", b"\1" + PLAIN_PICTURES["8.ppm"])
        put("view_set_fuzz", "parameters", b"\2" + PARAMETERS)
        put("view_set_fuzz", "cameras", b"\4" + CAMERAS)
        put("view_set_fuzz", "picture", b"\3P5 2 2 255\nabcd")
        for name, data in PLAIN_PICTURES.items():
            put("picture_fuzz", name, bytes([PICTURE_EXTENSIONS.index(name[-4:])]) + data)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[2])
    folder.mkdir(parents=True, exist_ok=True)
    make(pathlib.Path(sys.argv[1]).absolute(), folder.absolute())
