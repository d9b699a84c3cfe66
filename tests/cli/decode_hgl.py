#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Decodes compressed light fields (.hgl) of the coders "hogel", "lossless", "bounded" and "jpeg4d" as docs/format.md
describes them, slowly and plainly, and compares them with what `hogel decompress --float` made of them. Every sample
must be the same to the last bit (with "jpeg4d", whose sums have no fixed order, to rounding), and so must every depth.
The corners of an unfolded hemicube belong to no face and are not compared.

usage: decode_hgl.py STREAM.hgl LIGHT_FIELD.h5 [STREAM.hgl LIGHT_FIELD.h5 ...]
"""
import math
import struct
import sys
import zlib

import h5py
import numpy as np

f32 = np.float32


class Bytes:
    def __init__(self, data):
        self.data, self.at = data, 0

    def take(self, form):
        values = struct.unpack_from("<" + form, self.data, self.at)
        self.at += struct.calcsize("<" + form)
        return values if len(values) > 1 else values[0]

    def text(self):
        length = self.take("I")
        self.at += length
        return self.data[self.at - length:self.at].decode()


class Model:
    def __init__(self, zero=32768):
        self.a = self.b = zero


class Models(dict):
    """A model for each name; it starts in the state of that name when it is first used."""

    def __init__(self, states=None):
        self.states = states or {}

    def __missing__(self, name):
        self[name] = Model(round(65536 / (1 + 2**(-self.states.get(name, 0) / 4))))
        return self[name]


def model_names():
    """All models of a hogel's code, in the order in which a stream holds their states."""
    def of_first(of, w):
        return [(of, name, w, spread, around) for spread in range(4) for around in range(3)
                for name in ("not first", "none")]

    def of_disparity(of):
        names = of_first(of, 0)
        names += [(of, "which", spread, k) for spread in range(4) for k in range(4)]
        return names + [(of, "sign")] + [((of, "difference"), k) for k in range(31)]

    def of_coded(w, kinds):
        return [("coded", w, h, kind, r, around) for h in (False, True) for kind in kinds for r in (False, True)
                for around in range(3)]

    def of_mode(w):
        return [("mode", w, context, k) for context in range(3) for k in range(6)]

    names = of_mode(0)
    names += [("intra", k) for k in range(9)]
    names += of_disparity("main")
    names += of_coded(0, ("any", "side", "intra"))
    for of in [(h, intra) for h in (False, True) for intra in (False, True)]:
        for basis in ("cosines", "samples", "half"):
            name = (*of, basis)
            names += [(name, "last", node) for node in range(64)]
            names += [(name, size, around, place) for size in ("significant", "above 1") for around in range(12)
                      for place in range(3)]
            names += [(name, "above 2", around) for around in range(12)]
            names += [((name, "rest", around), k) for around in range(12) for k in range(31)]
            names += [(name, "sign", right, below) for right in range(3) for below in range(3)]
    names += [("basis", h, kind, k) for h in (False, True) for kind in ("any", "side", "intra", "partitioned")
              for k in range(3)]
    names += [("partitioned", 0, context) for context in range(3)]
    names += [(part, "side", k) for part in ("main", "second") for k in range(4)]
    names += [("angle", node) for node in range(32)] + [("offset", node) for node in range(4)]
    names += of_disparity("second")
    names += of_coded(0, ("partitioned",))
    for w in (1, 2):
        names += of_mode(w) + of_first("main", w) + of_coded(w, ("any", "side", "intra"))
        names += [("partitioned", w, context) for context in range(3)]
        names += of_first("second", w) + of_coded(w, ("partitioned",))
    names += [("angle_by", node) for node in range(32)]
    names += [("offset_by", of, node) for of in range(4) for node in range(4)]
    return names


class Decoder:
    def __init__(self, data):
        self.data, self.at, self.range, self.code = data, 0, 2**32 - 1, 0
        for _ in range(4):
            self.code = self.code << 8 | self.byte()

    def byte(self):
        self.at += 1
        return self.data[self.at - 1] if self.at <= len(self.data) else 0

    def narrow(self, start, size):
        self.code -= start
        self.range = size
        while self.range < 2**24:
            self.range <<= 8
            self.code = self.code << 8 | self.byte()

    def bit(self, model):
        zero = (self.range >> 16) * ((model.a + model.b) // 2)
        if self.code < zero:
            self.narrow(0, zero)
            model.a += (65536 - model.a) >> 4
            model.b += (65536 - model.b) >> 7
            return 0
        self.narrow(zero, self.range - zero)
        model.a -= model.a >> 4
        model.b -= model.b >> 7
        return 1

    def even(self):
        half = self.range >> 1
        value = min(self.code // half, 1)
        self.narrow(half * value, half)
        return value

    def raw(self, count):
        value = 0
        for done in range(0, count, 16):
            bits = min(16, count - done)
            unit = self.range >> bits
            part = min(self.code // unit, 2**bits - 1)
            self.narrow(unit * part, unit)
            value |= part << done
        return value

    def number(self, models, name):
        bits = 0
        while bits < 30 and self.bit(models[name, bits]):
            bits += 1
        value = 1
        for _ in range(bits):
            value = value << 1 | self.even()
        return value - 1


def layers_of_places(n):
    layer, ends, result = 2, sorted({0, (n - 1) // 2, n - 1}), [1] * n
    result[(n - 1) // 2] = 0
    while True:
        grown = []
        for a, b in zip(ends, ends[1:]):
            grown.append(a)
            if b - a >= 2:
                result[(a + b) // 2] = layer
                grown.append((a + b) // 2)
        grown.append(ends[-1])
        if len(grown) == len(ends):
            return result
        ends, layer = grown, layer + 1


class Hogel:
    def __init__(self, s, t, layer, references, context_references):
        self.s, self.t, self.layer = s, t, layer
        self.references, self.context_references, self.blocks = references, context_references, []


def nearest(references, count):
    """The nearest references (index in the order, i, j) to the left, to the right, above and below."""
    def far(side):
        distances = sorted(abs(i + j) for _, i, j in references if (i > 0, i < 0, j > 0, j < 0) == side)
        return distances[:count]

    return [(k, i, j) for k, i, j in references if abs(i + j) in far((i > 0, i < 0, j > 0, j < 0))]


def order_of(columns, rows, references_a_side):
    """The hogels in coding order with their references (index in the order, i, j), and the number of the last layer."""
    of_column, of_row = layers_of_places(columns), layers_of_places(rows)
    last = max(of_column + of_row)
    wavefronts = [[((columns - 1) // 2, (rows - 1) // 2)]]
    for layer in range(1, last + 1):
        for same in (False, True):
            wavefronts.append([(s, t) for t in range(rows) for s in range(columns)
                               if max(of_column[s], of_row[t]) == layer and (of_column[s] == of_row[t]) == same])
    hogels = []
    for wavefront in wavefronts:
        before = list(enumerate(hogels))
        for s, t in wavefront:
            references = [(k, h.s - s, 0) for k, h in before if h.t == t]
            references += [(k, 0, h.t - t) for k, h in before if h.s == s]
            hogels.append(Hogel(s, t, max(of_column[s], of_row[t]), nearest(references, references_a_side),
                                nearest(references, 1)))
    return hogels, last


ZIGZAG = []
for total in range(15):
    for k in range(total + 1):
        row = k if total % 2 else total - k
        if row < 8 and total - row < 8:
            ZIGZAG.append((row, total - row))

COSINES = np.array([[f32(np.rint((math.sqrt(1 / 8) if k == 0 else 0.5) * math.cos(math.pi * k * (2 * j + 1) / 16)
                                 * 2**20) / 2**20) for j in range(8)] for k in range(8)], f32)


# For each basis, whether it has samples (not cosines) along u, and along v.
BASES = (False, False), (True, True), (False, True), (True, False)


def taps_at(fraction):
    def sinc(x):
        return 1.0 if x == 0 else math.sin(x) / x

    weights = [sinc(math.pi * (k - 2 - fraction / 64)) * sinc(math.pi * (k - 2 - fraction / 64) / 3) for k in range(6)]
    return [f32(np.rint(w / sum(weights) * 2**14) / 2**14) for w in weights]


TAPS = [taps_at(fraction) for fraction in range(64)]


def second_partition(edge):
    """Which samples of a block belong to its second partition."""
    angle, offset = edge
    cosine, sine = (round(f(2 * math.pi * angle / 32) * 2**14) for f in (math.cos, math.sin))
    return np.array([[cosine * (2 * c - 7) + sine * (2 * r - 7) > 2 * offset * (abs(cosine) + abs(sine))
                      for c in range(8)] for r in range(8)])


# The squared sines of the expected noise.
ALIAS = [f32(np.rint(math.sin(math.pi * fraction / 64)**2 * 2**14) / 2**14) for fraction in range(64)]


def along_direction(edge, other, halves):
    block = np.zeros((8, 8), f32)
    for r in range(8):
        for c in range(8):
            at = 2 * c + halves * (r + 1)
            if at < -2:
                block[r, c] = other[r + 2 * (c + 1) // halves]
            elif at % 2 == 0:
                block[r, c] = edge[at // 2]
            else:
                block[r, c] = f32(0.5) * (edge[at // 2] + edge[at // 2 + 1])
    return block


class Tile:
    def __init__(self, data, columns, rows, shape, aspect):
        source = Bytes(data)
        step, growth = f32(source.take("f")), f32(source.take("f"))
        self.channels, self.height, self.width = shape
        self.across, self.down, self.aspect = -(-self.width // 8), -(-self.height // 8), aspect
        self.hogels, last = order_of(columns, rows, source.take("B"))
        self.steps = [step] * (last + 1)
        for layer in range(last - 1, -1, -1):
            self.steps[layer] = self.steps[layer + 1] / growth
        states = {}
        for layer in range(last + 1):
            hogels = [hogel for hogel in self.hogels if hogel.layer == layer]
            length = source.take("I")
            side = Decoder(data[source.at:source.at + length])
            source.at += length
            self.take_states(side, states)
            lengths = Models()
            codes = [side.number(lengths, "length") for _ in hogels]
            for hogel, length in zip(hogels, codes):
                self.decoder, self.models = Decoder(data[source.at:source.at + length]), Models(states)
                source.at += length
                self.decode(hogel)
        assert source.at == len(data)

    def take_states(self, side, states):
        models, changed = Models(), 0
        for name in model_names():
            changed = side.bit(models["changed", changed])
            if changed:
                sign = -1 if side.bit(models["sign"]) else 1
                state = states.get(name, 0) + sign * (side.number(models, "size") + 1)
                assert abs(state) <= 40
                states[name] = state

    def shift(self, disparity, reference):
        _, i, j = reference
        return -disparity * i, math.floor(float(-disparity * j) * float(self.aspect) + 0.5)

    def warped(self, hogel):
        kept = {}
        for reference in hogel.context_references:
            k, i, j = reference
            for n, block in enumerate(self.hogels[k].blocks):
                shift_u, shift_v = self.shift(block["disparity"], reference)
                u, v = n % self.across * 512 + 256 - shift_u, n // self.across * 512 + 256 - shift_v
                if not (0 <= u < 512 * self.across and 0 <= v < 512 * self.down):
                    continue
                place = v // 512 * self.across + u // 512
                far = (u % 512 - 256)**2 + (v % 512 - 256)**2 + (i * i + j * j) * 2048
                d = block["disparity"]
                if place not in kept or d > kept[place][0] + 12 or (d > kept[place][0] - 12 and far < kept[place][1]):
                    kept[place] = d, far, block
        return {place: block for place, (_, _, block) in kept.items()}

    def candidates(self, hogel, n, warped):
        blocks, result = hogel.blocks, []

        def add(value):
            value = max(-2**14, min(2**14, value))
            if value not in result:
                result.append(value)

        left, above = n % self.across > 0, n >= self.across
        if n in warped:
            add(warped[n]["disparity"])
        if left:
            add(blocks[n - 1]["disparity"])
        if above:
            add(blocks[n - self.across]["disparity"])
        if left and above:
            add(blocks[n - 1]["disparity"] + blocks[n - self.across]["disparity"]
                - blocks[n - self.across - 1]["disparity"])
        if hogel.context_references and len(result) < 4:
            add(self.hogels[hogel.context_references[0][0]].blocks[n]["disparity"])
        near = [blocks[k] for k in [n - 1] * left + [n - self.across] * above]
        near += [warped[n]] if n in warped else []
        for block in near:
            if block["mode"] == 6:
                add(block["second"])
        return result or [0]

    def unary(self, name, count):
        value = 0
        while value < count and self.decoder.bit(self.models[(*name, value)]):
            value += 1
        return value

    def tree(self, name, bits):
        node = 1
        for _ in range(bits):
            node = node * 2 + self.decoder.bit(self.models[(*name, node)])
        return node - 2**bits

    def disparity(self, of, candidates, before, around, unit):
        bit, models = self.decoder.bit, self.models
        far = max(abs(c - candidates[0]) for c in candidates)
        spread = 0 if far == 0 else 1 if far <= 2 else 2 if far <= 12 else 3
        if not bit(models[of, "not first", before, spread, around]):
            return candidates[0]
        if not bit(models[of, "none", before, spread, around]):
            k = 1
            while k + 1 < len(candidates) and bit(models[of, "which", spread, min(k, 3)]):
                k += 1
            return candidates[min(k, len(candidates) - 1)]
        sign = -1 if bit(models[of, "sign"]) else 1
        size = 1 + min(self.decoder.number(models, (of, "difference")), 2**16)
        return max(-2**14, min(2**14, candidates[0] + sign * unit * size))

    def levels(self, of, basis):
        """basis: whether levels stand for samples along u, and along v; otherwise for frequencies."""
        bit, models, (samples_u, samples_v) = self.decoder.bit, self.models, basis
        name = (*of, "half" if samples_u != samples_v else "samples" if samples_u else "cosines")
        order = ZIGZAG
        if samples_u:
            order = [(r, c) for r in range(8) for c in range(8)]
        elif samples_v:
            order = [(r, c) for c in range(8) for r in range(8)]
        last, result, seen = self.tree((name, "last"), 6), np.zeros((8, 8), f32), np.zeros((10, 10), int)
        for n in range(last, -1, -1):
            r, c = order[n]
            size = abs(seen)
            total = 2 * (size[r, c + 1] + size[r + 1, c]) + size[r + 1, c + 1] + size[r, c + 2] + size[r + 2, c]
            around = sum(total >= begin for begin in (1, 2, 3, 5, 8, 12, 18, 28, 44, 70, 120))
            frequency = r * (not samples_v) + c * (not samples_u)
            place = 0 if frequency == 0 else 1 if frequency < 3 else 2
            if n == last or bit(models[name, "significant", around, place]):
                size = 1
                if bit(models[name, "above 1", around, place]):
                    size = 2
                    if bit(models[name, "above 2", around]):
                        size = 3 + self.decoder.number(models, (name, "rest", around))
                if samples_u or samples_v:
                    known = samples_u * seen[r, c + 1], samples_v * seen[r + 1, c]
                    signs = [0 if level == 0 else 1 if level > 0 else 2 for level in known]
                    negative = bit(models[(name, "sign", *signs)])
                else:
                    negative = self.decoder.even()
                seen[r, c] = result[r, c] = -size if negative else size
        return result

    def decode(self, hogel):
        first, warped = not hogel.references, self.warped(hogel)
        nearest = min([abs(i) + abs(j) for _, i, j in hogel.references] + [64])
        unit = 1 if hogel.layer == 0 else max(1, 4 // nearest)
        self.picture = np.zeros((self.channels, 8 * self.down, 8 * self.across), f32)
        bit, models = self.decoder.bit, self.models
        for n in range(self.across * self.down):
            near = [hogel.blocks[n - 1] if n % self.across else None,
                    hogel.blocks[n - self.across] if n >= self.across else None]
            near = [b for b in near if b]
            block = {"mode": 0, "intra": 0}
            of = warped.get(n)
            before = 0 if of is None else 1 if of["mode"] == 1 else 2
            if not first:
                odd = sum(b["mode"] != 1 for b in near)
                if not bit(models["mode", before, odd, 0]):
                    block["mode"] = 1
                elif bit(models["partitioned", before, odd]):
                    block["mode"] = 6
                elif bit(models["mode", before, odd, 1]):
                    block["mode"] = 2
                    while block["mode"] < 5 and bit(models["mode", before, odd, block["mode"]]):
                        block["mode"] += 1
            if block["mode"] == 0:
                block["intra"] = self.unary(("intra",), 9)
            candidates = self.candidates(hogel, n, warped)
            block["disparity"] = candidates[0]
            if block["mode"] or first:
                block["disparity"] = self.disparity("main", candidates, before,
                                                    sum(b["not first"] for b in near), unit)
            if block["mode"] == 6:
                block["sides"] = [self.unary((part, "side"), 4) for part in ("main", "second")]
                if of and of["mode"] == 6:
                    angle, offset = of["edge"]
                    block["edge"] = (angle + self.tree(("angle_by",), 5)) % 32, self.tree(("offset_by", offset), 2)
                else:
                    block["edge"] = self.tree(("angle",), 5), self.tree(("offset",), 2)
                block["second"] = self.disparity("second", candidates, before, 0, unit)
            block["not first"] = block["disparity"] != candidates[0]
            kind = ("intra", "any", "side", "side", "side", "side", "partitioned")[block["mode"]]
            block["coded"] = []
            hogel.blocks.append(block)
            for c in range(self.channels):
                around = sum(b["coded"][c] for b in near)
                had = 0 if of is None else 2 if of["coded"][c] else 1
                block["coded"].append(bit(models["coded", had, c > 0, kind, block["not first"], around]))
                levels, basis, sort = None, BASES[0], (c > 0, kind == "intra")
                if block["coded"][c]:
                    basis = BASES[self.unary(("basis", c > 0, kind), 3)]
                    levels = self.levels(sort, basis)
                self.reconstruct(hogel, n, block, c, levels, basis)
        hogel.picture = self.picture

    def predict_intra(self, plane, x, y, how):
        left = plane[y:y + 8, x - 1] if x else np.full(8, plane[y - 1, x] if y else 0, f32)
        above = plane[y - 1, x:x + 8] if y else np.full(8, plane[y, x - 1] if x else 0, f32)
        if how == 2:
            return np.repeat(left[:, None], 8, 1)
        if how == 3:
            return np.repeat(above[None, :], 8, 0)
        if how == 1:
            mean = f32(0)
            for k in range(8):
                mean += left[k] + above[k]
            return np.full((8, 8), mean / f32(16), f32)
        if how > 3:
            corner = plane[y - 1, x - 1] if x and y else left[0] if x else above[0]
            columns = np.minimum(np.arange(x, x + 16), plane.shape[1] - 1)
            more = plane[y - 1, columns] if y else np.full(16, above[0], f32)
            left, above = [*left, *[left[7]] * 8, corner], [*more, corner]  # -1 is the corner
            if how < 8:
                return along_direction(above, left, (2, 1, -1, -2)[how - 4])
            return along_direction(left, above, (-1, 1)[how - 8]).T
        k = np.arange(8, dtype=f32)
        r, c = k[:, None], k[None, :]
        return ((7 - c) * left[:, None] + (c + 1) * above[7] + (7 - r) * above[None, :] + (r + 1) * left[7]) / f32(16)

    def predict_inter(self, hogel, c, x, y, disparity, side):
        found = []
        for reference in hogel.references:
            k, i, j = reference
            if side and not [i < 0, i > 0, j < 0, j > 0][side - 1]:
                continue
            ratio = self.steps[self.hogels[k].layer] / self.steps[0]
            u, v = self.shift(disparity, reference)
            noise = (f32(0.03) * (ratio * ratio) + f32(0.003) * f32(i * i + j * j)) + ALIAS[u % 64] + ALIAS[v % 64]
            found.append((noise, k, u, v))
        found.sort(key=lambda entry: entry[0])
        blocks = [self.interpolate(self.hogels[k].picture[c], x, y, u, v) for _, k, u, v in found[:2]]
        if side or len(blocks) == 1:
            return blocks[0]
        weight = found[1][0] / (found[0][0] + found[1][0])
        return weight * blocks[0] + (f32(1) - weight) * blocks[1]

    def interpolate(self, plane, x, y, u, v):
        rows = np.clip(np.arange(-2, 11) + y + (v >> 6), 0, plane.shape[0] - 1)
        columns = np.clip(np.arange(-2, 11) + x + (u >> 6), 0, plane.shape[1] - 1)
        window = plane[np.ix_(rows, columns)]
        across = window[:, 2:10]
        if u % 64:
            across = TAPS[u % 64][0] * window[:, 0:8]
            for k in range(1, 6):
                across = across + TAPS[u % 64][k] * window[:, k:k + 8]
        if v % 64 == 0:
            return across[2:10]
        block = TAPS[v % 64][0] * across[0:8]
        for k in range(1, 6):
            block = block + TAPS[v % 64][k] * across[k:k + 8]
        return block

    def reconstruct(self, hogel, n, block, c, levels, basis):
        x, y, plane = n % self.across * 8, n // self.across * 8, self.picture[c]
        if block["mode"]:
            main, side = (block["sides"] if block["mode"] == 6 else [block["mode"] - 1, None])
            prediction = self.predict_inter(hogel, c, x, y, block["disparity"], main)
            if side is not None:
                other = self.predict_inter(hogel, c, x, y, block["second"], side)
                prediction = np.where(second_partition(block["edge"]), other, prediction)
        else:
            prediction = self.predict_intra(plane, x, y, block["intra"])
        residual = np.zeros((8, 8), f32)
        if levels is not None:
            levels = levels + np.sign(levels) * f32(3 / 16 if block["mode"] else 1 / 16)
            residual = levels * self.steps[hogel.layer]
            samples_u, samples_v = basis
            if not samples_u:
                residual = sum((residual[:, j:j + 1] * COSINES[j:j + 1, :] for j in range(8)), np.zeros((8, 8), f32))
            if not samples_v:
                residual = sum((COSINES[r:r + 1, :].T * residual[r:r + 1, :] for r in range(8)), np.zeros((8, 8), f32))
        plane[y:y + 8, x:x + 8] = prediction + residual


def joined(tile, shape):
    """The samples of a tile, [c][t][s][v][u], in red, green and blue."""
    result = np.zeros(shape, f32)
    for hogel in tile.hogels:
        picture = hogel.picture[:, :shape[3], :shape[4]]
        if len(picture) == 3:
            a, b, c = (f32(factor) * p for factor, p in zip((3**-0.5, 2**-0.5, 6**-0.5), picture))
            picture = np.stack([a + b + c, a - f32(2) * c, a - b + c])
        result[:, hogel.t, hogel.s] = picture
    return result


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


def fields_of(source, end):
    """The optional fields of a header: the curve's points and values and the factor of chrominance; then the bytes of the
    depth stream and the smallest value that means infinity."""
    points = values = None
    chrominance, depth = f32(1), (0, None)
    while source.at < end:
        name, size = source.text(), source.take("I")
        if name == "tone":
            first, *values = source.take(f"I{size // 4 - 1}f")
            values = np.array(values, f32)
            points = ((first + np.arange(len(values), dtype="u4")) << np.uint32(20)).astype("u4").view(f32)
        elif name == "depth":
            depth_bytes, _, beyond = source.take("Qdd")
            assert size == 24
            depth = depth_bytes, beyond
        elif name == "focal_plane":
            assert size == 8 and source.take("d") != 0  # says what the directions are, not how they are coded
        else:
            assert name == "chrominance" and size == 4
            chrominance = f32(source.take("f"))
    return (points, values, chrominance), depth


def unmapped(tile, points, values, chrominance):
    """Inverts the mapping of radiances [c]...."""
    if values is None and chrominance == 1:
        return tile
    mean = (tile[0] + tile[1] + tile[2]) / f32(3) if len(tile) == 3 else tile[0]
    if chrominance != 1:
        tile = mean + (tile - mean) * chrominance
    if values is None:
        return tile
    y = np.abs(mean)
    piece = np.clip(np.searchsorted(values, y, side="right") - 1, 0, len(values) - 2)
    slope = (points[1:] - points[:-1]) / (values[1:] - values[:-1])
    with np.errstate(divide="ignore", invalid="ignore"):
        factor = (points[piece] + (y - values[piece]) * slope[piece]) / y
    factor = np.where(y > values[0], factor, points[0] / values[0])
    return tile * np.where(y < values[-1], factor, points[-1] / values[-1])


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
