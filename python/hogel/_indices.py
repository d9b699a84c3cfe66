# SPDX-License-Identifier: Apache-2.0
"""Indexing of arrays that are not in memory, by slices and integers."""
from __future__ import annotations

import dataclasses
import operator
from typing import Any

import numpy as np


@dataclasses.dataclass(frozen=True)
class Axis:
    """Range of elements to read along an axis, with a positive step, and the index it was derived from."""

    begin: int
    count: int
    step: int
    key: Any  # an integer or a slice


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
        raise IndexError("only slices and integers can index this object; convert it with np.asarray() for other indices") from None
    if not -extent <= index < extent:
        raise IndexError(f"index {index} is out of bounds for axis {axis} with size {extent}")
    return Axis(index % extent, 1, 1, index)


def axes_of(key: Any, shape: tuple[int, ...]) -> list[Axis]:
    """Returns the ranges that an index selects from an array of this shape, by NumPy's rules."""
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
    """Reverses axes with negative steps in the values read, and removes the axes indexed by integers."""

    def take(axis: Axis) -> Any:
        if not isinstance(axis.key, slice):
            return 0
        return slice(None, None, -1) if axis.key.step is not None and axis.key.step < 0 else slice(None)

    return values[tuple(take(axis) for axis in axes)]
