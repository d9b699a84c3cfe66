# SPDX-License-Identifier: Apache-2.0
"""Light fields: arrays [c][t][s][v][u] of radiance, in memory, in files, rendered or computed when they are read."""
from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np

from . import _core, units
from ._indices import Axis, arranged, axes_of
from ._progress import Progress, reporting
from .camera import camera
from .errors import UsageError
from .picture import Picture

if TYPE_CHECKING:
    from .hologram import Hologram

Path = Union[str, "os.PathLike[str]"]


def array_of(values: Any, kind: Any) -> "np.ndarray[Any, Any]":
    """An array of NumPy of anything that lends its memory, by DLPack too (torch, cupy, jax); copied only to change the
    type of its numbers."""
    if not isinstance(values, np.ndarray) and hasattr(values, "__dlpack__"):
        values = np.from_dlpack(values)
    return np.require(values, dtype=kind, requirements="A")


class Face:
    """The samples of one face of a light field, or their depths: an array that is read when it is indexed."""

    def __init__(self, light_field: _core.LightField, index: int, depth: bool) -> None:
        self._light_field, self._index, self._of_depth = light_field, index, depth
        self.grid: _core.LightFieldGrid = light_field.grids()[index]
        self.shape: tuple[int, ...] = self.grid.shape[1:] if depth else self.grid.shape
        self.dtype = np.dtype(np.float32)
        self.ndim = len(self.shape)

    @property
    def name(self) -> str:
        """front, left, right, top or bottom."""
        return _core.face_name(self.grid.face)

    @property
    def depth(self) -> "Face":
        """The depths [t][s][v][u], metres behind the hologram, of what the rays meet; infinite where they meet nothing."""
        if not self._light_field.has_depth():
            raise UsageError("depth: this light field has none")
        return Face(self._light_field, self._index, True)

    def _memory(self) -> Optional["np.ndarray[Any, Any]"]:
        find = _core.depth_in_memory if self._of_depth else _core.memory_of
        return find(self._light_field, self._index)

    def read(self, key: Any = (), progress: Progress = None) -> "np.ndarray[Any, Any]":
        """The elements that slices and whole numbers take. Of a file only the tiles that hold them are read."""
        axes = axes_of(key, self.shape)
        memory = self._memory()
        if memory is not None:
            return memory[tuple(axis.key for axis in axes)]
        wanted = ([Axis(0, 1, 1, slice(None))] if self._of_depth else []) + axes
        slices = [number for axis in wanted for number in (axis.begin, axis.count, axis.step)]
        with reporting(progress, "reading") as report:
            values = _core.read_slices(self._light_field, self._index, slices, self._of_depth, report)
        return arranged(values[0] if self._of_depth else values, axes)

    def __getitem__(self, key: Any) -> "np.ndarray[Any, Any]":
        return self.read(key)

    def __len__(self) -> int:
        return self.shape[0]

    def __array__(self, dtype: Any = None) -> "np.ndarray[Any, Any]":
        values = self.read()
        return values if dtype is None else values.astype(dtype, copy=False)

    def __repr__(self) -> str:
        return f"Face({self.name}{', depth' if self._of_depth else ''}, {self.shape})"


class LightField:
    """A light field L[c][t][s][v][u]: channels, rows and columns of hogels, rows and columns of directions; row 0 at the
    top, column 0 at the left (docs/files.md). Made by Scene.render(), open(), from_array() and from_function().

    `lf[c, t, s, v, u]` reads what slices and whole numbers take, of a file no more than the tiles that hold it. Four
    of them are t, s, v and u, of all channels: `lf[10:20, :, 4, 4]` is [c][10][S].

    >>> import hogel, numpy as np
    >>> lf = hogel.LightField.from_array(np.ones((1, 6, 8, 4, 5), np.float32), size="8mm", fov="16deg")
    >>> lf
    LightField(8x6 hogels of 5x4 directions, 1 channel, 8 mm x 6 mm, 16°, 3.8 kB, in memory)
    >>> lf[2:4, :, 1, 1].shape
    (1, 2, 8)
    """

    def __init__(self, light_field: _core.LightField, where: str) -> None:
        self._light_field, self.where = light_field, where

    @classmethod
    def open(cls, path: Path, *, progress: Progress = None) -> "LightField":
        """Opens a light field (.h5, .hgl), or imports a set of views. Samples are read when they are needed."""
        with reporting(progress, "opening") as report:
            return cls(_core.open_light_field(os.fspath(path), report), os.fspath(path))

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
        """The light field of an array [c][t][s][v][u] of radiances, or [t][s][v][u] of one channel, and optionally of one
        [t][s][v][u] of depths. Arrays of single floats are not copied, whatever their strides; do not change them while the
        light field is in use. What `grid` does not say, size, fov, toward and focal_plane do as those of Scene.render()."""
        from .scene import request

        values = array_of(radiance, np.float32)
        if values.ndim == 4:
            values = values[None]
        if values.ndim != 5:
            raise UsageError(f"radiance: an array [c][t][s][v][u] was expected, not one of {values.ndim} axes")
        if grid is None:
            channels, rows, columns, down, across = values.shape
            grid = request(
                hogels=(columns, rows), directions=(across, down), size=size, fov=fov, toward=toward, focal_plane=focal_plane
            ).grid
            grid.channels = channels
        depths = None if depth is None else array_of(depth, np.float32)
        return cls(_core.light_field_of_array(grid, values, depths, metadata), "in memory")

    @classmethod
    def from_function(
        cls, function: Callable[..., Any], *, channels: int = 3, depth: bool = False, metadata: Any = None, **options: Any
    ) -> "LightField":
        """The light field of a function of one's own, which computes it when it is read: function(s, t, u, v) gets the
        positions of hogels (metres) and the directions (tangents) as arrays with the axes [t][s][v][u], each of length
        one along the others' axes, and returns radiances that can be broadcast to [c][t][s][v][u]; with `depth` also
        depths, as a pair. The options are those of Scene.render() that say the sampling.

        >>> import hogel
        >>> stripes = hogel.LightField.from_function(lambda s, t, u, v: 0.5 + 0.5 * (abs(u) < 0.05), channels=1,
        ...                                          hogels=4, directions=8, size="4mm", fov="16deg")
        >>> stripes[0, 0, 0, 0, :].tolist()
        [0.5, 0.5, 0.5, 1.0, 1.0, 0.5, 0.5, 0.5]
        """
        from .scene import request

        grid = request(**options).grid
        grid.channels = channels
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

    @property
    def grid(self) -> _core.LightFieldGrid:
        """The sampling of the front."""
        return self._light_field.grid

    @property
    def faces(self) -> list[Face]:
        """All faces, the front first: one, or the three or five of a hemisquare or hemicube."""
        return [Face(self._light_field, index, False) for index in range(self._light_field.faces)]

    @property
    def shape(self) -> tuple[int, ...]:
        """Of the front: (channels, rows of hogels, columns, rows of directions, columns)."""
        return self.grid.shape

    @property
    def ndim(self) -> int:
        """5."""
        return 5

    @property
    def dtype(self) -> "np.dtype[Any]":
        """Single floats."""
        return np.dtype(np.float32)

    @property
    def nbytes(self) -> int:
        """Bytes of all samples as single floats."""
        return 4 * int(self._light_field.samples())

    @property
    def has_depth(self) -> bool:
        """Whether the depth of every ray is known."""
        return self._light_field.has_depth()

    @property
    def depth(self) -> Face:
        """The depths of the front, [t][s][v][u]: an array that is read when it is indexed."""
        return self.faces[0].depth

    @property
    def metadata(self) -> dict[str, str]:
        """What made the light field."""
        return dict(self._light_field.metadata)

    def __len__(self) -> int:
        return self.shape[0]

    def __getitem__(self, key: Any) -> "np.ndarray[Any, Any]":
        if isinstance(key, tuple) and len(key) == 4 and not any(part is Ellipsis for part in key):
            key = (slice(None), *key)
        return self.faces[0].read(key)

    def __array__(self, dtype: Any = None) -> "np.ndarray[Any, Any]":
        return self.faces[0].__array__(dtype)

    def __dlpack__(self, stream: Any = None) -> Any:
        return np.asarray(self).__dlpack__()

    def __dlpack_device__(self) -> tuple[int, int]:
        return 1, 0  # the processor's memory

    def load(self, *, depth: Optional[bool] = None, progress: Progress = None) -> "LightField":
        """The same light field in memory; with its depth where it has one, unless depth=False."""
        with reporting(progress, "reading") as report:
            with_depth = self.has_depth if depth is None else depth
            return LightField(_core.load(self._light_field, with_depth, report), "in memory")

    def stream(self, sink: Callable[..., Any], *, face: int = 0, depth: bool = False, progress: Progress = None) -> None:
        """Calls sink(s, t, radiance, depth) with every tile, one at a time in any order: the first column and row of its
        hogels, an array [c][t][s][v][u], and one [t][s][v][u] or None. Memory: a few tiles."""
        with reporting(progress, "reading") as report:
            _core.stream(self._light_field, face, sink, depth, report)

    def with_common_directions(self) -> "LightField":
        """The same light field with the same directions at all hogels, which holograms need."""
        return LightField(_core.with_common_directions(self._light_field), self.where)

    def compare(self, other: "LightField", *, progress: Progress = None) -> dict[str, float]:
        """sqnr and psnr (decibels) and max_error of another light field of this sampling."""
        with reporting(progress, "comparing") as report:
            sqnr, psnr, max_error = _core.compare(self._light_field, other._light_field, report)
        return {"sqnr": sqnr, "psnr": psnr, "max_error": max_error}

    def _prepared(self, times: int, depth: bool, progress: Progress) -> _core.LightField:
        """For readers that read it several times; what is rendered when it is read is then rendered once."""
        if self.where not in ("rendered when read", "computed when read"):
            return self._light_field
        with reporting(progress, "rendering") as report:
            return _core.prepare_for_reading(self._light_field, times, depth, report)

    def save(
        self,
        path: Path,
        *,
        float: bool = False,
        depth: bool = False,
        sqnr: Optional[float] = None,
        metadata: Any = None,
        progress: Progress = None,
    ) -> None:
        """Writes the light field: .h5, with half floats or with float=True single ones, or .hgl of this signal to
        quantisation noise ratio (decibels). The file appears under its name when it is complete."""
        name = os.fspath(path)
        _core.require_writable(name)
        if metadata is None:
            metadata = [("software", f"hogel {_core.__version__}"), ("command", "hogel.LightField.save")]
        if os.path.splitext(name)[1] == ".hgl":
            if float:
                raise UsageError(f"float: belongs to HDF5 files; {name} is a compressed one")
            options = _core.CompressionOptions()
            options.target = _core.Sqnr(_core.defaults["sqnr"] if sqnr is None else sqnr)
            options.with_depth = depth
            options.set_metadata(metadata)
            prepared = self._prepared(2, depth, progress)
            with reporting(progress, "compressing") as report:
                _core.compress(prepared, name, options, report)
            return
        if sqnr is not None:
            raise UsageError(f"sqnr: belongs to compressed files, whose names end in .hgl, not to {name}")
        _core.require_hdf5(name)
        with reporting(progress, "writing") as report:
            _core.write_light_field(name, self._light_field, float, depth, metadata, report)

    def compress(
        self,
        path: Path,
        *,
        sqnr: Optional[float] = None,
        ppb: Optional[float] = None,
        rule: str = "search",
        overhead: Optional[float] = None,
        step: Optional[float] = None,
        max_error: Optional[float] = None,
        lossless: bool = False,
        coder: str = "hogel",
        transform: str = "",
        table: str = "own",
        symbols: str = "bits",
        hemicube: str = "faces",
        no_depth: bool = False,
        depth_error: Optional[units.Length] = None,
        tone: str = "none",
        tone_decades: Optional[float] = None,
        chrominance: float = 1,
        tile: Optional[units.Counts] = None,
        metadata: Any = None,
        progress: Progress = None,
    ) -> dict[str, Any]:
        """Writes a compressed light field, .hgl, as `hogel compress` does. One of sqnr (decibels), ppb (rays a bit), step,
        max_error (radiance) and lossless=True says how well; without one it is 40 dB. Returns bytes, sqnr, pixels_per_bit,
        step, passes, depth_bytes and depth_error of the file."""
        name = os.fspath(path)
        _core.require_writable(name)
        _core.require_name(name, "hgl")
        options = _core.CompressionOptions()
        options.target = _target(sqnr, ppb, rule, overhead, step, max_error, lossless)
        method = _core.CodingMethod()
        method.coder, method.transform = coder, transform
        method.table = _choice(_core.QuantisationTable, table, "table")
        method.symbols = _choice(_core.ZerotreeSymbols, symbols, "symbols")
        options.method = method
        if hemicube == "unfolded":
            options.layout = _core.StreamLayout.unfolded
        elif hemicube != "faces":
            raise UsageError(f"hemicube: faces or unfolded were expected, not '{hemicube}'")
        options.with_depth = self.has_depth and not no_depth
        if depth_error is not None:
            if not options.with_depth:
                raise UsageError("depth_error: there is no depth to keep")
            options.depth_error = units.length(depth_error, "depth_error")
        if tone == "histogram":
            options.tone_decades = _core.defaults["tone_decades"] if tone_decades is None else tone_decades
        elif tone != "none" or tone_decades is not None:
            raise UsageError("tone, tone_decades: none or histogram were expected, and decades with histogram alone")
        options.chrominance = chrominance
        if tile is not None:
            options.set_tile(*units.counts(tile, "tile"))
        if metadata is None:
            metadata = [("software", f"hogel {_core.__version__}"), ("command", "hogel.LightField.compress")]
        options.set_metadata(metadata)
        prepared = self._prepared(2, options.with_depth, progress)
        with reporting(progress, "compressing") as report:
            return _core.compress(prepared, name, options, report)

    def hologram(
        self,
        *,
        wavelength: Union[units.Length, Sequence[units.Length], None] = None,
        pitch: Optional[units.Length] = None,
        method: str = "fourier",
        phase: Optional[str] = None,
        lobes: str = "radiance",
        basis: Optional[str] = None,
        tolerance: float = 0,
        line_pitch: Optional[units.Length] = None,
        looks: int = 1,
        seed: int = 1,
        progress: Progress = None,
    ) -> "Hologram":
        """The hologram of the light field, computed when it is read: one field for each wavelength, without any three
        (red, green, blue). The options are those of `hogel hologram`."""
        from .hologram import Hologram, hologram_request

        wanted = hologram_request(wavelength, pitch, method, phase, lobes, basis, tolerance, line_pitch, looks, seed)
        common = LightField(_core.with_common_directions(self._light_field), self.where)
        _core.require_holograms(common._light_field, wanted)
        prepared = common._prepared(len(wanted.channels), _core.needs_depth(wanted.method), progress)
        fields = _core.make_holograms(prepared, wanted)
        return Hologram(fields, "computed when read", known=(prepared, wanted))

    def photograph(
        self, *, cameras: Optional[Sequence[_core.Camera]] = None, pupil_samples: Optional[int] = None,
        progress: Progress = None, **options: Any
    ) -> Any:
        """A picture by rays, through the camera that the options describe (hogel.camera()): eye, gaze, focus, pupil,
        resolution and so on. With `cameras` a list of pictures, one for each."""
        points = _core.defaults["pupil_samples"] if pupil_samples is None else int(pupil_samples)
        views = [camera(self.grid.width, self.grid.height, **options)] if cameras is None else list(cameras)
        with reporting(progress, "photograph") as report:
            pictures = [Picture(image) for image in _core.photograph_rays(self._light_field, views, points, report)]
        return pictures[0] if cameras is None else pictures

    def views(self) -> Picture:
        """The picture of the middle direction, a pixel a hogel."""
        middle = self[:, :, self.shape[3] // 2, self.shape[4] // 2]
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
    import math

    def angle(half: float, center: float) -> str:
        if grid.has_frequencies:
            return units.say_angle(2 * math.asin(min(1.0, half)))
        return units.say_angle(math.atan(center + half) - math.atan(center - half))

    across, down = angle(grid.view.half_u, grid.view.center_u), angle(grid.view.half_v, grid.view.center_v)
    text = across if across == down else f"{across} x {down}"
    if isinstance(grid.view, _core.FocalPlane):
        text += f" through the plane {units.say_length(grid.view.depth)} behind"
    return text


def _choice(kind: Any, name: str, what: str) -> Any:
    members = kind.__members__
    if name not in members:
        raise UsageError(f"{what}: {' or '.join(members)} were expected, not '{name}'")
    return members[name]


def _target(
    sqnr: Optional[float],
    ppb: Optional[float],
    rule: str,
    overhead: Optional[float],
    step: Optional[float],
    max_error: Optional[float],
    lossless: bool,
) -> Any:
    given = [value for value in (sqnr, ppb, step, max_error) if value is not None]
    if len(given) + bool(lossless) > 1:
        raise UsageError("sqnr, ppb, step, max_error, lossless: only one of them can be asked for")
    if ppb is None and (rule != "search" or overhead is not None):
        raise UsageError("rule, overhead: belong to ppb")
    if ppb is not None:
        return _core.PixelsPerBit(ppb, _choice(_core.RateRule, rule, "rule"), overhead)
    if step is not None:
        return _core.Step(step)
    if max_error is not None:
        return _core.MaxError(max_error)
    if lossless:
        return _core.Lossless()
    return _core.Sqnr(_core.defaults["sqnr"] if sqnr is None else sqnr)
