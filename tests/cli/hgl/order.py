# SPDX-License-Identifier: Apache-2.0
"""The order of the hogels of a tile, with the hogels that each is predicted from, and the models of a hogel's code."""


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
