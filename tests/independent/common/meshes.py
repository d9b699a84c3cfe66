# SPDX-License-Identifier: Apache-2.0
"""Scenes as glTF 2.0 files, and the colours of vertices in binary ones."""
import base64
import json
import struct

import numpy as np


class Scene:
    """Surfaces of one material each."""

    def __init__(self):
        self.data = b""
        self.file = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}], "nodes": [], "meshes": [], "materials": [],
                     "accessors": [], "bufferViews": []}
        self.patches = []  # places, normal and triangles of each

    def accessor(self, values, kind, component):
        values = np.ascontiguousarray(values)
        view = {"buffer": 0, "byteOffset": len(self.data), "byteLength": values.nbytes}
        self.data += values.tobytes()
        entry = {"bufferView": len(self.file["bufferViews"]), "componentType": component, "count": len(values), "type": kind}
        if kind == "VEC3":
            entry["min"], entry["max"] = values.min(axis=0).tolist(), values.max(axis=0).tolist()
        self.file["bufferViews"].append(view)
        self.file["accessors"].append(entry)
        return len(self.file["accessors"]) - 1

    def patch(self, corner, right, up, cells, colour=(1, 1, 1), metallic=0.0, roughness=1.0, emission=(0, 0, 0)):
        """cells x cells squares on corner + p right + q up, 0 <= p, q <= 1; the front is where right x up points."""
        part = np.arange(cells + 1) / cells
        q, p = np.meshgrid(part, part, indexing="ij")
        places = np.asarray(corner) + p[..., None] * np.asarray(right) + q[..., None] * np.asarray(up)
        normal = np.cross(right, up)
        normal = normal / np.linalg.norm(normal)
        first = (np.arange(cells)[:, None] * (cells + 1) + np.arange(cells)).ravel()
        other = first + cells + 1
        triangles = np.concatenate([np.stack([first, first + 1, other + 1], 1), np.stack([first, other + 1, other], 1)])
        self.patches.append((places.reshape(-1, 3), normal, triangles))
        self.file["materials"].append({"pbrMetallicRoughness": {"baseColorFactor": [*colour, 1], "metallicFactor": metallic,
                                                                "roughnessFactor": roughness},
                                       "emissiveFactor": list(emission), "doubleSided": True})
        count = places.shape[0] * places.shape[1]
        self.file["meshes"].append({"primitives": [{
            "attributes": {"POSITION": self.accessor(places.reshape(-1, 3).astype("<f4"), "VEC3", 5126),
                           "NORMAL": self.accessor(np.tile(normal, (count, 1)).astype("<f4"), "VEC3", 5126)},
            "indices": self.accessor(triangles.astype("<u4").ravel(), "SCALAR", 5125),
            "material": len(self.file["materials"]) - 1}]})
        self.file["scenes"][0]["nodes"].append(len(self.file["nodes"]))
        self.file["nodes"].append({"mesh": len(self.file["meshes"]) - 1})

    def write(self, path):
        data = "data:application/octet-stream;base64," + base64.b64encode(self.data).decode()
        self.file["buffers"] = [{"byteLength": len(self.data), "uri": data}]
        with open(path, "w") as file:
            json.dump(self.file, file)


    def write_ply(self, path):
        """Without the materials."""
        lines, faces, first = [], [], 0
        for places, normal, triangles in self.patches:
            lines += [" ".join(map(repr, [*map(float, place), *map(float, normal)])) for place in places]
            faces += [f"3 {a + first} {b + first} {c + first}" for a, b, c in triangles]
            first += len(places)
        header = ["ply", "format ascii 1.0", f"element vertex {first}",
                  *(f"property float {name}" for name in ("x", "y", "z", "nx", "ny", "nz")), f"element face {len(faces)}",
                  "property list uchar int vertex_indices", "end_header"]
        path.write_text("\n".join([*header, *lines, *faces]) + "\n")


def read_colours(path):
    """COLOR_0 of all vertices of a binary glTF file, [vertex][channel]."""
    data = open(path, "rb").read()
    size, = struct.unpack_from("<I", data, 12)
    file, binary = json.loads(data[20:20 + size]), data[20 + size + 8:]
    colours = []
    for mesh in file["meshes"]:
        for primitive in mesh["primitives"]:
            entry = file["accessors"][primitive["attributes"]["COLOR_0"]]
            view = file["bufferViews"][entry["bufferView"]]
            assert entry["componentType"] == 5126, "floats were expected"
            width = {"VEC3": 3, "VEC4": 4}[entry["type"]]
            start = view.get("byteOffset", 0) + entry.get("byteOffset", 0)
            colours.append(np.frombuffer(binary, "<f4", entry["count"] * width, start).reshape(-1, width)[:, :3])
    return np.concatenate(colours)
