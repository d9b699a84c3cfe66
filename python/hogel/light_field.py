# SPDX-License-Identifier: Apache-2.0
"""Light fields: arrays [c][t][s][v][u] of radiance, in memory, in files, rendered or computed on demand."""
from __future__ import annotations

import os
import warnings
from collections.abc import Callable, Sequence
from typing import Any, Optional, Union

import numpy as np

from . import _core, _record, units
from ._keywords import passes_options_to, takes
from ._progress import Progress, reporting
from ._rays import Rays
from ._samples import Path, array_of
from ._saving import save_light_field
from .camera import cameras_of
from .compression import compress
from .errors import UsageError, usage_error
from .exports import export_views, write_printer_images
from .hologram import Hologram
from .method import hologram_record, hologram_request
from .picture import Picture
from .requests import request


class LightField(Rays):
    """Light field L[c][t][s][v][u]: channels, rows and columns of hogels, rows and columns of directions; row 0 at the top,
    column 0 at the left (docs/files.md). Created by Scene.render(), open(), from_array() and from_function().

    `lf[c, t, s, v, u]` reads the elements selected by slices and integers, and only the tiles of a file that contain them.
    Four indices are t, s, v and u, for all channels: `lf[10:20, :, 4, 4]` has the shape [c][10][S].

    >>> import hogel, numpy as np
    >>> lf = hogel.LightField.from_array(np.ones((1, 6, 8, 4, 5), np.float32), size="8mm", fov="16deg")
    >>> lf
    LightField(8x6 hogels of 5x4 directions, 1 channel, 8 mm x 6 mm, 16°, 3.8 kB, in memory)
    >>> lf[2:4, :, 1, 1].shape
    (1, 2, 8)
    """

    compress = compress

    @classmethod
    def open(cls, path: Path, *, layers: Optional[int] = None, progress: Progress = None) -> "LightField":
        """Opens a light field (.h5, .hgl), or imports a set of views with default options (see import_views()). Samples are
        read on demand. `layers`: decodes only the first layers of a compressed light field, coarser.

        >>> import hogel, os, tempfile
        >>> lf = hogel.Scene.load("pumpkin").render(hogels=8, directions=8, size="0.4mm")
        >>> path = os.path.join(tempfile.mkdtemp(), "lf.h5")
        >>> lf.save(path)
        >>> hogel.LightField.open(path)[:, 2, 2].shape
        (3, 8, 8)
        """
        name = os.fspath(path)
        if layers is not None:
            return cls(_core.open_stream(name, layers=int(layers)), name, {"input": name, "layers": str(layers)})
        with reporting(progress, "opening") as report:
            return cls(_core.open_light_field(name, report), name, {"input": name})

    @classmethod
    def from_array(
        cls,
        radiance: Any,
        *,
        size: Optional[units.Length] = None,
        fov: Union[units.Angle, Sequence[units.Angle], None] = None,
        toward: Union[units.Angle, Sequence[units.Angle]] = 0,
        focal_plane: Optional[units.Length] = None,
        grid: Optional[_core.LightFieldGrid] = None,
        depth: Any = None,
        metadata: Any = None,
    ) -> "LightField":
        """Creates a light field from an array [c][t][s][v][u] of radiances, or [t][s][v][u] for one channel, and optionally
        an array [t][s][v][u] of depths. Does not copy arrays of single floats, whatever their strides; do not change them
        while the light field is in use. Without `grid`, size, fov, toward and focal_plane are as for Scene.render().

        >>> import hogel, numpy as np
        >>> lf = hogel.LightField.from_array(np.ones((1, 6, 8, 4, 5), np.float32), size="8mm", fov="16deg")
        >>> lf.shape
        (1, 6, 8, 4, 5)
        """
        values = array_of(radiance, np.float32)
        if values.ndim == 4:
            values = values[None]
        if values.ndim != 5:
            raise usage_error("radiance", f"expected an array [c][t][s][v][u], not one of {values.ndim} axes")
        if grid is None:
            channels, rows, columns, down, across = values.shape
            grid = request(
                hogels=(columns, rows), directions=(across, down), size=size, fov=fov, toward=toward, focal_plane=focal_plane
            ).grid
            grid.channels = channels
        depths = None if depth is None else array_of(depth, np.float32)
        return cls(_core.light_field_of_array(grid, values, depths, metadata), "in memory")

    @classmethod
    @passes_options_to(request)
    def from_function(
        cls, function: Callable[..., Any], *, channels: int = 3, depth: bool = False, metadata: Any = None, **options: Any
    ) -> "LightField":
        """Creates a light field from a function that computes samples on demand. function(s, t, u, v) gets the positions of
        hogels (metres) and the directions (tangents) as arrays with the axes [t][s][v][u], each of length one along the
        axes of the others. It returns radiances that broadcast to [c][t][s][v][u]; with `depth`, a pair of radiances and
        depths. The options are the sampling options of Scene.render().

        >>> import hogel
        >>> stripes = hogel.LightField.from_function(lambda s, t, u, v: 0.5 + 0.5 * (abs(u) < 0.05), channels=1,
        ...                                          hogels=4, directions=8, size="4mm", fov="16deg")
        >>> stripes[0, 0, 0, 0, :].tolist()
        [0.5, 0.5, 0.5, 1.0, 1.0, 0.5, 0.5, 0.5]
        """
        grid = request(**options).grid
        grid.channels = channels
        return cls.of_grid(function, grid, depth=depth, metadata=metadata)

    @classmethod
    def of_grid(
        cls, function: Callable[..., Any], grid: _core.LightFieldGrid, *, depth: bool = False, metadata: Any = None
    ) -> "LightField":
        """Creates a light field from a function on a given grid: see from_function().

        >>> import hogel, numpy as np
        >>> lf = hogel.LightField.from_array(np.ones((1, 6, 8, 4, 5), np.float32), size="8mm", fov="16deg")
        >>> hogel.LightField.of_grid(lambda s, t, u, v: 0.5 + 0 * s, lf.grid).shape
        (1, 6, 8, 4, 5)
        """
        channels = grid.channels
        offset = grid.view.depth if isinstance(grid.view, _core.FocalPlane) else None
        u = np.array([grid.u(k) for k in range(grid.directions_u)])[None, None, None, :]
        v = np.array([grid.v(k) for k in range(grid.directions_v)])[None, None, :, None]

        def tile(s0: int, t0: int, ns: int, nt: int) -> Any:
            s = np.array([grid.s(i) for i in range(s0, s0 + ns)])[None, :, None, None]
            t = np.array([grid.t(j) for j in range(t0, t0 + nt)])[:, None, None, None]
            shape = (nt, ns, grid.directions_v, grid.directions_u)
            of_hogel = (u, v) if offset is None else (u - s / offset, v - t / offset)
            made = function(s, t, *of_hogel)
            if not depth:
                return np.broadcast_to(np.asarray(made, np.float32), (channels, *shape))
            radiance, depths = made
            return np.broadcast_to(np.asarray(radiance, np.float32), (channels, *shape)), np.broadcast_to(
                np.asarray(depths, np.float32), shape
            )

        return cls(_core.light_field_of_function(grid, tile, depth, metadata), "computed when read")

    def load(self, *, depth: Optional[bool] = None, progress: Progress = None) -> "LightField":
        """Returns the same light field in memory, with its depth if it has one, unless depth=False.

        >>> import hogel, os, tempfile
        >>> lf = hogel.Scene.load("pumpkin").render(hogels=8, directions=8, size="0.4mm")
        >>> np.asarray(lf.load()).shape
        (3, 8, 8, 8, 8)
        """
        with reporting(progress, "reading") as report:
            with_depth = self.has_depth if depth is None else depth
            return LightField(_core.load(self._light_field, with_depth, report), "in memory", self._made)

    def with_common_directions(self) -> "LightField":
        """Returns the light field resampled to common directions for all hogels, which holograms need.

        >>> import hogel, numpy as np
        >>> lf = hogel.LightField.from_array(np.ones((1, 6, 8, 4, 5), np.float32), size="8mm", fov="16deg")
        >>> lf.with_common_directions().grid == lf.grid
        True
        """
        return LightField(_core.with_common_directions(self._light_field), self.where, self._made)

    def with_scale(self, pitch: units.Length, factor: float = 1) -> "LightField":
        """Returns the light field at another scale: hogels `pitch` apart, and all directions U and V times `factor`. Depth
        keeps the disparity between neighbouring directions. A fixed focal plane becomes common directions.

        >>> import hogel, numpy as np
        >>> lf = hogel.LightField.from_array(np.ones((1, 6, 8, 4, 5), np.float32), size="8mm", fov="16deg")
        >>> lf.with_scale("0.5mm", 0.2).grid.pitch
        0.0005
        """
        return LightField(_core.with_scale(self._light_field, units.length(pitch, "pitch"), factor), self.where, self._made)

    def every_nth_hogel(self, n: int) -> "LightField":
        """Returns a light field with every n-th hogel across and down, as a preview of a large one. n must be odd.

        >>> import hogel, numpy as np
        >>> lf = hogel.LightField.from_array(np.ones((1, 9, 9, 4, 4), np.float32), size="9mm", fov="16deg")
        >>> lf.every_nth_hogel(3).shape
        (1, 3, 3, 4, 4)
        """
        return LightField(_core.every_nth_hogel(self._light_field, n), self.where)

    def compare(self, other: "LightField", *, progress: Progress = None) -> dict[str, float]:
        """Returns sqnr and psnr (decibels) and max_error of another light field of the same sampling.

        >>> import hogel, numpy as np
        >>> lf = hogel.LightField.from_array(np.ones((1, 6, 8, 4, 5), np.float32), size="8mm", fov="16deg")
        >>> lf.compare(lf)["max_error"]
        0.0
        """
        with reporting(progress, "comparing") as report:
            sqnr, psnr, max_error = _core.compare(self._light_field, other._light_field, report)
        return {"sqnr": sqnr, "psnr": psnr, "max_error": max_error}

    def save(
        self,
        path: Path,
        *,
        float: bool = False,
        half: bool = False,
        depth: bool = False,
        sqnr: Optional[float] = None,
        resume: bool = False,
        part: Optional[tuple[int, int]] = None,
        metadata: Any = None,
        progress: Progress = None,
    ) -> None:
        """Writes .h5 with half floats, or single floats with float=True, or .hgl with the signal-to-quantisation-noise ratio
        `sqnr` (decibels). The file appears under its name when it is complete. With resume=True the same call continues an
        interrupted one. part=(2, 8) writes the second of eight parts, one per process; hogel.join() joins them to a file.

        >>> import hogel, os, tempfile
        >>> path = os.path.join(tempfile.mkdtemp(), "small.h5")
        >>> hogel.Scene.load("pumpkin").render(hogels=4, directions=4).save(path)
        >>> hogel.LightField.open(path).shape
        (3, 4, 4, 4, 4)
        """
        save_light_field(self, path, float, half, depth, sqnr, resume, part, metadata, progress)

    def plan(self, *, depth: bool = False, float: bool = False) -> _core.Plan:
        """Returns the memory (bytes), disk space (bytes) and time (seconds; 0: no estimate) of save() for a rendered light
        field.

        >>> import hogel, os, tempfile
        >>> lf = hogel.Scene.load("pumpkin").render(hogels=8, directions=8, size="0.4mm")
        >>> lf.plan().disk >= 8 * 8 * 8 * 8 * 3 * 2
        True
        """
        if self._rendering is None:
            raise UsageError("plan: only for light fields that are rendered on demand")
        wanted, triangles, model = self._rendering
        shading = wanted.shading
        shading.model = model
        wanted.shading = shading
        return _core.plan_light_field(self._light_field, wanted, triangles, float, depth)

    @passes_options_to(hologram_request)
    def hologram(self, *, progress: Progress = None, **options: Any) -> Hologram:
        """Returns the hologram of the light field, computed on demand: one field for each wavelength; default: red, green
        and blue. The options are those of `hogel hologram`. The default pitch is that of hogel.defaults. If that cannot
        diffract the field of view, a smaller pitch is chosen and reported by a UserWarning.

        >>> import hogel, os, tempfile
        >>> lf = hogel.Scene.load("pumpkin").render(hogels=8, directions=8, size="0.4mm")
        >>> lf.hologram(wavelength="532nm", pitch="1.5625um")
        Hologram(256x256 samples 1.5625 um apart, 0.4 mm x 0.4 mm, 532 nm, computed when read)
        """
        wanted = hologram_request(**options)
        common = self._for_holograms(wanted, options.get("basis") is None)
        wanted.pitch = _core.hologram_request(options, common).pitch
        note = _core.note_about_pitch(options, wanted, common.grid)
        if note:
            warnings.warn(note, stacklevel=3)
        _core.require_holograms(common, wanted)
        resampled = LightField(common, self.where)
        prepared = resampled._prepared(len(wanted.channels), _core.needs_depth(wanted.method), progress)
        fields = _core.make_holograms(prepared, wanted)
        record = None
        if self._made is not None:
            acted = hologram_record(wanted, self.grid, **options)
            record = {**_record.renamed(self._made, "scene", "input"), **acted}
        made = Hologram(fields, "computed when read", known=(prepared, wanted), made=record)
        made._identity = self._identity
        return made

    def _for_holograms(self, wanted: _core.HologramRequest, any_transform: bool) -> _core.LightField:
        """Returns the light field with common directions for all hogels, or the basis-fringe coefficients of a file."""
        if isinstance(wanted.method, _core.Basis) and self.where.endswith(".hgl"):
            return _core.open_for_holograms(self.where, wanted, any_transform)
        return _core.with_common_directions(self._light_field)

    @takes(_core.ray_photograph_keywords())
    def photograph(self, *, cameras: Optional[Sequence[_core.Camera]] = None, progress: Progress = None, **options: Any) -> Any:
        """Photographs by rays. The options describe the camera (hogel.camera()): eye, gaze, focus, pupil, resolution and so
        on. With `cameras` returns a list of pictures, one for each.

        >>> import hogel, os, tempfile
        >>> lf = hogel.Scene.load("pumpkin").render(hogels=8, directions=8, size="0.4mm")
        >>> lf.photograph(eye="10,0,300mm", focus="1mm", resolution=24)
        Picture(24x24 pixels, 3 channels)
        """
        points = _core.pupil_samples(options)
        views = cameras_of(cameras, self.grid.width, self.grid.height, options)
        with reporting(progress, "photograph") as report:
            pictures = [Picture(image) for image in _core.photograph_rays(self._light_field, views, points, report)]
        if cameras is not None:
            return pictures
        if self._made is not None:
            acted = dict(_core.ray_photograph_record(options))
            pictures[0]._made = ("photo", {**_record.renamed(self._made, "scene", "input"), **acted})
        return pictures[0]

    @passes_options_to(export_views)
    def export(self, target: Path, **options: Any) -> _core.ExportedViews:
        """Writes the light field as a set of views, or as a film of the middle row: see hogel.export_views().

        >>> import hogel, os, tempfile
        >>> lf = hogel.Scene.load("pumpkin").render(hogels=8, directions=3, size="4mm", focal_plane="-300mm")
        >>> made = lf.export(os.path.join(tempfile.mkdtemp(), "views"))
        >>> made.columns, made.rows, len(made.files)
        (3, 3, 9)
        """
        return export_views(self, target, **options)

    @passes_options_to(write_printer_images)
    def print(self, folder: Path, **options: Any) -> _core.PrinterImages:
        """Writes the pictures for a hologram printer: see hogel.exports.write_printer_images().

        >>> import hogel, os, tempfile
        >>> lf = hogel.Scene.load("pumpkin").render(hogels=8, directions=8, size="0.4mm")
        >>> lf.print(os.path.join(tempfile.mkdtemp(), "prints"), strips=True).pictures
        8
        """
        return write_printer_images(self, folder, **options)
