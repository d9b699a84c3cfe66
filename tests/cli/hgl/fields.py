# SPDX-License-Identifier: Apache-2.0
"""The optional fields of a stream's header, and the mapping of radiances that they describe."""
import numpy as np

f32 = np.float32


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
        elif name == "frequencies":
            assert size == 0  # likewise
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
