#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Decodes compressed light fields (.hgl) of the coders "hogel", "lossless", "bounded" and "jpeg4d" as docs/format.md
describes them, slowly and plainly, and compares them with what `hogel decompress --float` made of them. Every sample
must be the same to the last bit (with "jpeg4d", whose sums have no fixed order, to rounding), and so must every depth.
The corners of an unfolded hemicube belong to no face and are not compared.

usage: decode_hgl.py STREAM.hgl LIGHT_FIELD.h5 [STREAM.hgl LIGHT_FIELD.h5 ...]
"""
import sys
import zlib

import h5py
import numpy as np

from hgl.arithmetic import Bytes
from hgl.exact import exact
from hgl.fields import fields_of, unmapped
from hgl.jpeg4d import jpeg4d
from hgl.tile import Tile, joined

f32 = np.float32


def check(data, file, beyond=None):
    """Compares a stream with a light field; with `beyond`, which means infinity, with its depths."""
    source = Bytes(data)
    assert data[:8] == b"\x89HGL\r\n\x1a\n"
    source.at = 8
    version, length = source.take("II")
    assert version == 1
    channels, columns, rows, n_u, n_v = source.take("5Q")
    _, tan_u, tan_v, _, _ = source.take("5d")
    assert source.text() == "front"
    tile_s, tile_t = source.take("2Q")
    coder = source.text()
    assert (coder, source.text()) in [("hogel", ""), ("lossless", ""), ("bounded", ""), ("jpeg4d", "dct8")]
    for _ in range(source.take("I")):
        source.text(), source.text()
    # For each array of directions its size, and the faces in it: name, columns and rows.
    parts = [(n_u, n_v, tan_u, tan_v, [("radiance", 0, n_u, 0, n_v)])]
    layout, sides = source.text(), {}
    for _ in range(source.take("I")):
        name = source.text()
        sides[name] = source.take("QQ4d")
    if layout in ("faces", "stacked"):
        parts += [(u, v, a, b, [(f"{name}/radiance", 0, u, 0, v)]) for name, (u, v, a, b, _, _) in sides.items()]
    else:
        assert layout == "unfolded"
        u0, v0 = sides["left"][0], sides["top"][1]
        u1, v1 = u0 + n_u, v0 + n_v
        u2, v2 = u1 + sides["right"][0], v1 + sides["bottom"][1]
        places = [("radiance", u0, u1, v0, v1), ("left/radiance", 0, u0, v0, v1),
                  ("right/radiance", u1, u2, v0, v1), ("top/radiance", u0, u1, 0, v0),
                  ("bottom/radiance", u0, u1, v1, v2)]
        parts = [(u2, v2, tan_u * u2 / n_u, tan_v * v2 / n_v, places)]
    layers = source.take("I")
    mapping, (depth_bytes, depth_beyond) = fields_of(source, 16 + length)
    if depth_bytes:
        check(data[-depth_bytes:], file, depth_beyond)
        data = data[:-depth_bytes]
    assert source.at == 16 + length
    assert source.take("I") == zlib.crc32(data[:16 + length])
    tiles = len(parts) * -(-rows // tile_t) * -(-columns // tile_s)
    begin, end = source.at, source.at + 8 * layers * tiles
    entries = [source.take("II") for _ in range(layers * tiles)]
    assert source.take("I") == zlib.crc32(data[begin:end])
    # The layers of each tile, concatenated.
    codes = [b""] * tiles
    for number, (size, checksum) in enumerate(entries):
        code = data[source.at:source.at + size]
        source.at += size
        assert zlib.crc32(code) == checksum
        codes[number % tiles] += code
    assert source.at == len(data)
    codes = iter(codes)
    for u, v, tan_u, tan_v, faces in parts:
        aspect = f32((2 * tan_u / u) / (2 * tan_v / v))
        if beyond is None:
            expected = {name: file[name][:] for name, *_ in faces}
        else:
            expected = {name: file[name.replace("radiance", "depth")][:][np.newaxis] for name, *_ in faces}
        for t0 in range(0, rows, tile_t):
            for s0 in range(0, columns, tile_s):
                code = next(codes)
                across, down = min(tile_s, columns - s0), min(tile_t, rows - t0)
                shape = channels, down, across, v, u
                if layout == "stacked":
                    shape = (channels, 1, across, down, u) if v == 1 else (channels, 1, down, across, v)
                counts = np.zeros(shape[3:], bool)
                for _, u0, u1, v0, v1 in faces if layout != "stacked" else [(None, 0, shape[4], 0, shape[3])]:
                    counts[v0:v1, u0:u1] = True
                if coder == "hogel":
                    tile = joined(Tile(code, shape[2], shape[1], (channels, *shape[3:]), aspect), shape)
                elif coder == "jpeg4d":
                    tile = jpeg4d(code, shape)
                else:
                    tile = exact(coder, code, shape, aspect, counts)
                if layout == "stacked" and v == 1:
                    tile = tile.transpose(0, 3, 2, 1, 4)
                tile = tile.reshape(channels, down, across, v, u)
                if beyond is not None:
                    tile = np.where(tile < beyond, tile, f32(np.inf))
                for name, u0, u1, v0, v1 in faces:
                    truth = expected[name][:, t0:t0 + down, s0:s0 + across]
                    face = unmapped(tile[..., v0:v1, u0:u1], *mapping)
                    if coder == "jpeg4d":
                        assert np.abs(face - truth).max() <= 1e-5 * np.abs(truth).max(), "differs"
                        continue
                    assert np.array_equal(face.view("u4"), truth.view("u4")), "samples differ"


pairs = list(zip(sys.argv[1::2], sys.argv[2::2]))
for stream, light_field in pairs:
    try:
        check(open(stream, "rb").read(), h5py.File(light_field, "r"))
    except Exception as error:
        sys.exit(f"{stream} and {light_field}: {error!r}")
print(f"the same: {len(pairs)} streams")
