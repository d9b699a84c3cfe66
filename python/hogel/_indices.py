# SPDX-License-Identifier: Apache-2.0
"""What slices and whole numbers take of an array that is not in memory."""
from __future__ import annotations

import dataclasses
import operator
from typing import Any

import numpy as np


@dataclasses.dataclass(frozen=True)
class Axis:
    """The elements that are read along an axis, with a positive step, and what was asked for."""

    begin: int
    count: int
    step: int
    key: Any  # a whole number or a slice


def _axis(key: Any, extent: int, axis: int) -> Axis:
    if isinstance(key, slice):
        begin, end, step = key.indices(extent)
        taken = range(begin, end, step)
        if not taken:
            return Axis(0, 0, 1, key)
        return Axis(min(taken[0], taken[-1]), len(taken), abs(step), key)
    try:
        index = operator.index(key)
    except TypeError:
        raise IndexError("only slices and whole numbers read a part of this; np.asarray() of it takes other indices") from None
    if not -extent <= index < extent:
        raise IndexError(f"index {index} is out of bounds for axis {axis} with size {extent}")
    return Axis(index % extent, 1, 1, index)


def axes_of(key: Any, shape: tuple[int, ...]) -> list[Axis]:
    """The axes of an array of this shape under an index, by NumPy's rules."""
    parts = list(key) if isinstance(key, tuple) else [key]
    holes = [position for position, part in enumerate(parts) if part is Ellipsis]
    if len(holes) > 1:
        raise IndexError("an index can only have a single ellipsis ('...')")
    missing = len(shape) - (len(parts) - len(holes))
    if missing < 0:
        raise IndexError(f"too many indices: there are {len(shape)} axes, but {len(parts) - len(holes)} were indexed")
    hole = holes[0] if holes else len(parts)
    parts[hole : hole + len(holes)] = [slice(None)] * missing
    return [_axis(part, extent, axis) for axis, (part, extent) in enumerate(zip(parts, shape))]


def arranged(values: "np.ndarray[Any, Any]", axes: list[Axis]) -> "np.ndarray[Any, Any]":
    """What was read, backwards where a step was negative, and without the axes of whole numbers."""

    def take(axis: Axis) -> Any:
        if not isinstance(axis.key, slice):
            return 0
        return slice(None, None, -1) if axis.key.step is not None and axis.key.step < 0 else slice(None)

    return values[tuple(take(axis) for axis in axes)]
