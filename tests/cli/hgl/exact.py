# SPDX-License-Identifier: Apache-2.0
"""The coders "lossless" and "bounded": a tile of the coder "hogel", and the residuals that make it exact."""
import numpy as np

from .arithmetic import Bytes, Decoder, Models
from .tile import Tile, joined

f32 = np.float32


class Exact:
    """The code of the residuals of a row of hogels, or of one hogel."""

    def __init__(self, data):
        self.decoder, self.models = Decoder(data), Models()

    def residual(self, around):
        """around: for each neighbour its size (negative for negative numbers, 33 for special), its weight, and whether it
        is the one to the left or above."""
        bit, models = self.decoder.bit, self.models
        beside = [size for size, weight, near in around if near]
        special, sign = beside.count(33), sum((size > 0) - (size < 0) for size in beside if size != 33)
        weights = sum(weight for size, weight, _ in around if size != 33)
        total = sum(weight * abs(size) for size, weight, _ in around if size != 33)
        mean = (total + weights // 2) // weights if weights else 0
        node = 1
        for _ in range(6):
            node = node * 2 + bit(models["size", special, mean, node])
        size = node - 64
        if size == 33 or size == 0:
            return None if size == 33 else 0, size
        negative, number, left = bit(models["sign", sign]), 1, size - 1
        for _ in range(min(2, left)):
            left -= 1
            number = number << 1 | bit(models["below", size, number & 3])
        number = number << left | self.decoder.raw(left)
        return (-number, -size) if negative else (number, size)


def ordered(value):
    bits = int(np.array(value, f32).view("u4"))
    return bits ^ (0xFFFFFFFF if bits >> 31 else 0x80000000)


def exact(coder, data, shape, aspect, counts):
    channels, rows, columns, n_v, n_u = shape
    source = Bytes(data)
    length = source.take("I")
    tile = joined(Tile(data[4:4 + length], columns, rows, (channels, n_v, n_u), aspect), shape)
    source.at += length
    if coder == "lossless":
        zero = source.take("B")
        apart, zero = zero >> 7, zero & 127
        half = 1 << zero >> 1
    else:
        bound = source.take("d")
        apart, bound = bound < 0, abs(bound)
    sizes = [source.take("I") for _ in range(rows * columns if apart else rows)]
    for t in range(rows):
        for s in range(columns):
            if apart or s == 0:
                size = sizes.pop(0)
                code = Exact(data[source.at:source.at + size])
                source.at += size
            before = None
            for c in range(channels):
                seen = np.zeros((n_v, n_u), int)
                for v, u in np.argwhere(counts):
                    around = [(int(seen[v, u - 1]), 2, True)] if u else []
                    if v:
                        around.append((int(seen[v - 1, u]), 2, True))
                        around += [(int(seen[v - 1, k]), 1, False) for k in (u - 1, u + 1) if 0 <= k < n_u]
                    if before is not None:
                        around.append((int(before[v, u]), 2, False))
                    number, seen[v, u] = code.residual(around)
                    here = tile[c, t, s]
                    if coder == "bounded":
                        raw = code.decoder.raw(32) if number is None else None
                        here[v, u] = np.uint32(raw).view(f32) if raw is not None else f32(
                            float(here[v, u]) + 2 * bound * number)
                        continue
                    value = 0x80000000  # of +0
                    if number is not None:
                        expected = ordered(here[v, u])
                        expected = (expected if expected > 0xFFFFFFFF - half else expected + half) >> zero
                        value = (expected + number) % (1 << (32 - zero)) << zero
                    bits = value - 2**31 if value >> 31 else ~(value | ((1 << zero) - 1)) & 0xFFFFFFFF
                    here[v, u] = np.uint32(bits).view(f32)
                before = seen
    assert source.at == len(data)
    return tile
