# SPDX-License-Identifier: Apache-2.0
"""The coder "jpeg4d": cosine transforms of four dimensions."""
import math
import struct

import numpy as np

from .arithmetic import Bytes, Decoder, Models


class Counts:
    """The frequencies of the symbols of an alphabet."""

    def __init__(self, count):
        self.seen = [1] * count

    def learn(self, symbol):
        self.seen[symbol] += 32
        if sum(self.seen) > 2**16:
            self.seen = [(n + 1) // 2 for n in self.seen]


def symbol(decoder, counts):
    unit = decoder.range // sum(counts.seen)
    place, before, result = decoder.code // unit, 0, 0
    while before + counts.seen[result] <= place:
        before += counts.seen[result]
        result += 1
    decoder.narrow(unit * before, unit * counts.seen[result])
    counts.learn(result)
    return result


JPEG = [[16, 11, 10, 16, 24, 40, 51, 61], [12, 12, 14, 19, 26, 58, 60, 55], [14, 13, 16, 24, 40, 57, 69, 56],
        [14, 17, 22, 29, 51, 87, 80, 62], [18, 22, 37, 56, 68, 109, 103, 77], [24, 35, 55, 64, 81, 104, 113, 92],
        [49, 64, 78, 87, 103, 121, 120, 101], [72, 92, 95, 98, 112, 100, 103, 99]]


def in_zigzag(extents):
    return sorted(np.ndindex(*extents), key=lambda f: (sum(f), [k if sum(f) % 2 else -k for k in f]))


def own_table(decoder, shape):
    """e of each frequency that blocks of this array can have."""
    models, table, differs = Models(), {}, 0
    for f in in_zigzag([(min(n, 8) - 1) * 8 // min(n, 8) + 1 for n in shape]):
        lower = [table[f[:a] + (f[a] - 1,) + f[a + 1:]] for a in range(4) if f[a]]
        table[f] = sum(lower) // len(lower) if lower else 0
        differs = decoder.bit(models["differs", differs])
        if differs:
            sign, size = -1 if decoder.bit(models["sign"]) else 1, 1
            while size < 24 and decoder.bit(models["more", size]):
                size += 1
            table[f] += sign * size
        assert 0 <= table[f] <= 24
    return table


def cosines(n):
    return np.array([[math.sqrt((1 if k == 0 else 2) / n) * math.cos(math.pi * k * (2 * j + 1) / (2 * n))
                      for j in range(n)] for k in range(n)])


def jpeg4d_channel(code, shape):
    """One channel, [t][s][v][u]."""
    scale, levels_byte = struct.unpack_from("<fB", code)
    decoder, models, result = Decoder(code[5:]), Models(), np.zeros(shape)
    table = own_table(decoder, shape) if levels_byte & 128 else None
    tuples = Counts(32 * ((levels_byte & 127) + 1))
    for block in np.ndindex(*[-(-n // 8) for n in shape]):
        place = [slice(8 * b, min(8 * b + 8, n)) for b, n in zip(block, shape)]
        extents = [p.stop - p.start for p in place]
        order, values, at = in_zigzag(extents), np.zeros(extents), 0
        while at < len(order):
            found = symbol(decoder, tuples)
            bits, zeros = found // 32, found % 32
            if found == 0:
                break
            at += zeros
            if bits == 0:
                continue
            negative, level = decoder.raw(1), 1
            if bits > 1:
                level = 2 | decoder.bit(models["second", bits])
                level = level << (bits - 2) | decoder.raw(bits - 2)
            f = tuple(k * 8 // n for k, n in zip(order[at], extents))
            step = 2**(table[f] / 4) if table else JPEG[f[0]][f[1]] * JPEG[f[2]][f[3]]
            values[order[at]] = scale * step * (-level if negative else level)
            at += 1
        for axis, n in enumerate(extents):
            values = np.moveaxis(np.tensordot(cosines(n), values, axes=(0, axis)), 0, axis)
        result[tuple(place)] = values
    return result


def jpeg4d(data, shape):
    source, channels = Bytes(data), []
    for _ in range(shape[0]):
        length = source.take("I")
        channels.append(jpeg4d_channel(data[source.at:source.at + length], shape[1:]))
        source.at += length
    assert source.at == len(data)
    if len(channels) == 3:
        a, b, c = (factor * p for factor, p in zip((3**-0.5, 2**-0.5, 6**-0.5), channels))
        channels = [a + b + c, a - 2 * c, a - b + c]
    return np.stack(channels)
