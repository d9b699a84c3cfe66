# SPDX-License-Identifier: Apache-2.0
"""Pictures, from the descriptions of their formats: EXR in scanlines, compressed by ZIP or
not at all, and PNG of 8 bits a channel, not interlaced."""
import struct
import zlib

import numpy as np


def read_exr(path):
    """Array [channel][y][x] in double precision, R G B or Y."""
    data = open(path, "rb").read()
    magic, version = struct.unpack_from("<ii", data)
    assert magic == 20000630 and version & ~0x400 == 2, "an EXR file of scanlines was expected"
    at, header = 8, {}
    while data[at]:
        name, kind, rest = data[at:].split(b"\0", 2)
        size, = struct.unpack_from("<i", rest)
        at += len(name) + len(kind) + 6
        header[name.decode()] = data[at:at + size]
        at += size
    x0, y0, x1, y1 = struct.unpack("<4i", header["dataWindow"])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    channels, table = [], header["channels"]
    while table[0]:
        name, rest = table.split(b"\0", 1)
        channels.append((name.decode(), {1: "<f2", 2: "<f4"}[struct.unpack_from("<i", rest)[0]]))
        table = rest[16:]
    rows = {0: 1, 2: 1, 3: 16}[header["compression"][0]]
    blocks = -(-height // rows)
    picture = {name: np.empty((height, width)) for name, _ in channels}
    for offset in struct.unpack_from(f"<{blocks}q", data, at + 1):
        y, size = struct.unpack_from("<ii", data, offset)
        packed = data[offset + 8:offset + 8 + size]
        count = min(rows, y1 + 1 - y)
        full = sum(np.dtype(kind).itemsize for _, kind in channels) * width * count
        raw = packed if size == full else unpredicted(zlib.decompress(packed))
        place = 0
        for row in range(y - y0, y - y0 + count):
            for name, kind in channels:
                picture[name][row] = np.frombuffer(raw, kind, width, place)
                place += width * np.dtype(kind).itemsize
    return np.array([picture[name] for name in ("R", "G", "B", "Y") if name in picture])


def unpredicted(data):
    """Undoes EXR's differences of bytes and its halves of even and odd bytes."""
    steps = np.frombuffer(data, np.uint8).astype(np.int64)
    steps[1:] -= 128
    summed = (np.cumsum(steps) & 255).astype(np.uint8)
    both = np.empty_like(summed)
    half = (len(summed) + 1) // 2
    both[0::2], both[1::2] = summed[:half], summed[half:]
    return both.tobytes()


def read_png(path):
    """Array [channel][y][x] of whole numbers from 0 to 255."""
    data = open(path, "rb").read()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", "a PNG file was expected"
    at, packed = 8, b""
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        body = data[at + 8:at + 8 + size]
        if kind == b"IHDR":
            width, height, depth, colour, _, _, interlaced = struct.unpack(">2I5B", body)
            assert depth == 8 and colour in (0, 2) and not interlaced, "8 bits a channel, grey or RGB, were expected"
        if kind == b"IDAT":
            packed += body
        at += size + 12
    channels = 3 if colour == 2 else 1
    lines = np.frombuffer(zlib.decompress(packed), np.uint8).reshape(height, -1)
    rows = np.zeros((height + 1, width * channels), np.uint8)
    for y, line in enumerate(lines):
        rows[y + 1] = unfiltered(int(line[0]), line[1:], rows[y], channels)
    return rows[1:].reshape(height, width, channels).transpose(2, 0, 1)


def unfiltered(kind, line, above, step):
    if kind == 0:
        return line
    if kind == 2:
        return line + above
    row = line.astype(int)
    up = above.astype(int)
    for x in range(len(row)):
        left = row[x - step] if x >= step else 0
        corner = up[x - step] if x >= step else 0
        nearest = min((left, up[x], corner), key=lambda v: abs(left + up[x] - corner - v))
        row[x] = (row[x] + {1: left, 3: (left + up[x]) // 2, 4: nearest}[kind]) & 255
    return row.astype(np.uint8)


def write_png(path, levels):
    """`levels` is [y][x] of 8 bits, grey."""
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    height, width = levels.shape
    lines = np.hstack([np.zeros((height, 1), np.uint8), levels.astype(np.uint8)]).tobytes()
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">2I5B", width, height, 8, 0, 0, 0, 0)) +
                   chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b""))
