# SPDX-License-Identifier: Apache-2.0
"""Samples of light fields."""
from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, Optional

import numpy as np

from . import _core, _record, units
from ._progress import Progress, reporting
from ._samples import Samples
from .errors import UsageError
from .face import Face
from .picture import Picture


class Rays(Samples):
    """Base class of LightField: sampling, reading and display of samples. Functions that write light fields use it."""

    #: Names of the axes.
    dims = ("c", "t", "s", "v", "u")

    def __init__(self, light_field: _core.LightField, where: str, made: Optional[_record.Record] = None) -> None:
        # `made`: options of the command line that created or opened it; None if there is no equivalent command.
        self._light_field, self.where, self._made = light_field, where, made
        self._rendering: Any = None  # if rendered on demand: request, number of triangles and shading model
        self._views: Any = None  # facts about an imported set of views
        self._identity: Optional[str] = None  # identifies its input, for resuming

    @property
    def grid(self) -> _core.LightFieldGrid:
        """Sampling of the front."""
        return self._light_field.grid

    @property
    def coords(self) -> dict[str, "np.ndarray[Any, Any]"]:
        """Coordinates of the axes t, s (metres), v and u (tangents, or sines for frequency grids), for xarray."""
        g = self.grid
        lengths = {"t": (g.t, g.hogels_t), "s": (g.s, g.hogels_s), "v": (g.v, g.directions_v), "u": (g.u, g.directions_u)}
        return {name: np.array([at(index) for index in range(length)]) for name, (at, length) in lengths.items()}

    @property
    def faces(self) -> list[Face]:
        """All faces, the front first: one, three of a hemisquare, or five of a hemicube."""
        return [Face(self._light_field, index, False) for index in range(self._light_field.faces)]

    @property
    def shape(self) -> tuple[int, ...]:
        """Shape of the front: (channels, rows of hogels, columns, rows of directions, columns)."""
        return self.grid.shape

    @property
    def nbytes(self) -> int:
        """Size of all samples in bytes as single floats."""
        return 4 * int(self._light_field.samples())

    @property
    def has_depth(self) -> bool:
        """Whether the depth of every ray is available."""
        return self._light_field.has_depth()

    @property
    def depth(self) -> Face:
        """Depths of the front, [t][s][v][u]: an array that is read on indexing."""
        return self.faces[0].depth

    @property
    def metadata(self) -> dict[str, str]:
        """Provenance of the light field."""
        return dict(self._light_field.metadata)

    def __getitem__(self, key: Any) -> "np.ndarray[Any, Any]":
        if isinstance(key, tuple) and len(key) == 4 and not any(part is Ellipsis for part in key):
            key = (slice(None), *key)
        return self.read(key)

    def read(self, key: Any = (), progress: Progress = None) -> "np.ndarray[Any, Any]":
        """Returns the elements selected by slices and integers, by NumPy's rules. Reads only the tiles of a file that
        contain them.

        >>> import hogel, numpy as np
        >>> lf = hogel.LightField.from_array(np.ones((1, 6, 8, 4, 5), np.float32), size="8mm", fov="16deg")
        >>> lf.read((0, slice(2, 4), slice(None, None, 2), 1, 1)).shape
        (2, 4)
        """
        return self.faces[0].read(key, progress)

    def part(self, **indices: Any) -> "np.ndarray[Any, Any]":
        """Returns the elements selected by slices and integers for named axes c, t, s, v and u, and all elements along the
        other axes: lf.part(t=slice(10, 20), v=4, u=4).

        >>> import hogel, numpy as np
        >>> lf = hogel.LightField.from_array(np.ones((3, 6, 8, 4, 5), np.float32), size="8mm", fov="16deg")
        >>> lf.part(t=slice(2, 4), v=1, u=1).shape
        (3, 2, 8)
        """
        unknown = set(indices) - set(self.dims)
        if unknown:
            raise UsageError(f"part: {', '.join(sorted(unknown))}: expected the axes c, t, s, v and u")
        return self.read(tuple(indices.get(name, slice(None)) for name in self.dims))

    def stream(self, sink: Callable[..., Any], *, face: int = 0, depth: bool = False, progress: Progress = None) -> None:
        """Calls sink(s, t, radiance, depth) for every tile, one at a time, in any order. s, t: first column and row of its
        hogels; radiance: array [c][t][s][v][u]; depth: array [t][s][v][u] or None. Needs memory for a few tiles.

        >>> import hogel, numpy as np
        >>> lf = hogel.LightField.from_array(np.ones((1, 6, 8, 4, 5), np.float32), size="8mm", fov="16deg")
        >>> seen = []
        >>> lf.stream(lambda s, t, radiance, depth: seen.append(radiance.size))
        >>> sum(seen) == lf.size
        True
        """
        with reporting(progress, "reading") as report:
            _core.stream(self._light_field, face, sink, depth, report)

    def _prepared(self, times: int, depth: bool, progress: Progress) -> _core.LightField:
        """Returns the light field for `times` reads. One that is rendered on demand is then rendered only once."""
        if self.where not in ("rendered when read", "computed when read"):
            return self._light_field
        with reporting(progress, "rendering") as report:
            return _core.prepare_for_reading(self._light_field, times, depth, report)

    def views(self) -> Picture:
        """Returns the picture of the middle direction, one pixel per hogel.

        >>> import hogel, numpy as np
        >>> lf = hogel.LightField.from_array(np.ones((1, 6, 8, 4, 5), np.float32), size="8mm", fov="16deg")
        >>> lf.views()
        Picture(8x6 pixels, 1 channel)
        """
        middle = self.part(v=self.shape[3] // 2, u=self.shape[4] // 2)
        return Picture(np.moveaxis(middle, 0, -1))

    def _repr_png_(self) -> bytes:
        return self.views().png()

    def __repr__(self) -> str:
        g = self.grid
        channels = f"{g.channels} channel{'' if g.channels == 1 else 's'}"
        sides = "" if self._light_field.faces == 1 else f" and {self._light_field.faces - 1} sides"
        size = f"{units.say_length(g.width)} x {units.say_length(g.height)}"
        return (
            f"LightField({g.hogels_s}x{g.hogels_t} hogels of {g.directions_u}x{g.directions_v} directions{sides}, {channels}, "
            f"{size}, {_say_view(g)}, {units.say_bytes(self.nbytes)}, {self.where})"
        )


def _say_view(grid: _core.LightFieldGrid) -> str:
    def angle(half: float, center: float) -> str:
        if grid.has_frequencies:
            return units.say_angle(2 * math.asin(min(1.0, half)))
        return units.say_angle(math.atan(center + half) - math.atan(center - half))

    across, down = angle(grid.view.half_u, grid.view.center_u), angle(grid.view.half_v, grid.view.center_v)
    text = across if across == down else f"{across} x {down}"
    if isinstance(grid.view, _core.FocalPlane):
        text += f" through the plane {units.say_length(grid.view.depth)} behind"
    return text
