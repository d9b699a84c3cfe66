# SPDX-License-Identifier: Apache-2.0
"""The faces of light fields."""
from __future__ import annotations

from typing import Any, Optional

import numpy as np

from . import _core
from ._indices import Axis, arranged, axes_of
from ._progress import Progress, reporting
from ._samples import Samples
from .errors import usage_error


class Face(Samples):
    """Samples of one face of a light field, or their depths: an array that is read on indexing.

    >>> import hogel, numpy as np
    >>> lf = hogel.LightField.from_array(np.ones((1, 6, 8, 4, 5), np.float32), size="8mm", fov="16deg")
    >>> lf.faces[0]
    Face(front, (1, 6, 8, 4, 5))
    """

    def __init__(self, light_field: _core.LightField, index: int, depth: bool) -> None:
        self._light_field, self._index, self._of_depth = light_field, index, depth
        self.grid: _core.LightFieldGrid = light_field.grids()[index]

    @property
    def shape(self) -> tuple[int, ...]:
        """(channels, rows of hogels, columns, rows of directions, columns); without channels for depths."""
        return self.grid.shape[1:] if self._of_depth else self.grid.shape

    @property
    def name(self) -> str:
        """front, left, right, top or bottom."""
        return _core.face_name(self.grid.face)

    @property
    def depth(self) -> "Face":
        """Depths [t][s][v][u] of the ray hits, metres behind the hologram; infinite without a hit."""
        if not self._light_field.has_depth():
            raise usage_error("depth", "this light field has no depth")
        return Face(self._light_field, self._index, True)

    def _memory(self) -> Optional["np.ndarray[Any, Any]"]:
        find = _core.depth_in_memory if self._of_depth else _core.memory_of
        return find(self._light_field, self._index)

    def read(self, key: Any = (), progress: Progress = None) -> "np.ndarray[Any, Any]":
        """Returns the elements selected by slices and integers. Reads only the tiles of a file that contain them.

        >>> import hogel, numpy as np
        >>> lf = hogel.LightField.from_array(np.ones((1, 6, 8, 4, 5), np.float32), size="8mm", fov="16deg")
        >>> lf.faces[0].read((0, slice(2, 4), 0, 0, 0)).shape
        (2,)
        """
        axes = axes_of(key, self.shape)
        memory = self._memory()
        if memory is not None:
            return memory[tuple(axis.key for axis in axes)]
        wanted = ([Axis(0, 1, 1, slice(None))] if self._of_depth else []) + axes
        slices = [number for axis in wanted for number in (axis.begin, axis.count, axis.step)]
        with reporting(progress, "reading") as report:
            values = _core.read_slices(self._light_field, self._index, slices, self._of_depth, report)
        return arranged(values[0] if self._of_depth else values, axes)

    def __repr__(self) -> str:
        return f"Face({self.name}{', depth' if self._of_depth else ''}, {self.shape})"
