# SPDX-License-Identifier: Apache-2.0
"""A tile of the coder "hogel": the hogels in their order, predicted from each other, and their residuals."""
import math

import numpy as np

from .arithmetic import Bytes, Decoder, Models
from .order import model_names, order_of

f32 = np.float32


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
