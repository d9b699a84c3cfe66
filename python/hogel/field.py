# SPDX-License-Identifier: Apache-2.0
"""Complex fields on a plane."""
from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, Optional

import numpy as np

from . import _core, units
from ._indices import arranged, axes_of
from ._keywords import passes_options_to, takes
from ._progress import Progress, reporting
from ._samples import Samples, array_of, choice
from .errors import usage_error
from .pattern import Pattern, pattern_of
from .photographs import photograph_fields
from .picture import Picture


class Field(Samples):
    """Monochromatic complex field F[y][x], row 0 at the top, in memory, in a file, or computed on demand. Reading returns
    arrays of complex64.

    >>> import hogel, numpy as np
    >>> wave = hogel.Field.from_array(np.ones((64, 64), np.complex64), pitch="2um", wavelength="633nm")
    >>> wave
    Field(64x64 samples 2 um apart, 0.128 mm x 0.128 mm, 633 nm, in memory)
    >>> far = wave.propagate("1mm")
    >>> round(float(abs(far[32, 32])), 3) < 2
    True
    """

    dtype = np.dtype(np.complex64)
    #: Names of the axes.
    dims = ("y", "x")

    def __init__(self, source: _core.FieldSource, where: str, look: int = 0) -> None:
        self._source, self.where, self._look = source, where, look

    @classmethod
    def from_array(
        cls,
        samples: Any,
        *,
        wavelength: units.Length,
        pitch: Optional[units.Length] = None,
        grid: Optional[_core.Grid] = None,
        metadata: Any = None,
    ) -> "Field":
        """Creates a field from an array [y][x], centred at x = y = 0, or at the positions of `grid`. Does not copy an array
        of complex64, whatever its strides; do not change it while the field is in use.

        >>> import hogel, numpy as np
        >>> wave = hogel.Field.from_array(np.ones((32, 64), np.complex64), pitch="2um", wavelength="633nm")
        >>> wave.shape, np.asarray(wave).dtype
        ((32, 64), dtype('complex64'))
        """
        values = array_of(samples, np.complex64)
        if values.ndim != 2:
            raise usage_error("samples", f"expected an array [y][x], not one of {values.ndim} axes")
        if grid is None:
            if pitch is None:
                raise usage_error("pitch", "a field needs the pitch of its samples")
            step = units.length(pitch, "pitch")
            grid = _core.Grid(values.shape[1], values.shape[0], step, step)
        sampling = _core.FieldGrid(grid, units.length(wavelength, "wavelength"))
        return cls(_core.field_of_array(sampling, values, metadata), "in memory")

    @classmethod
    def from_function(
        cls,
        function: Callable[..., Any],
        *,
        wavelength: units.Length,
        samples: Optional[units.Counts] = None,
        pitch: Optional[units.Length] = None,
        grid: Optional[_core.Grid] = None,
        metadata: Any = None,
    ) -> "Field":
        """Creates a field from a function that computes samples on demand. function(x, y) gets the positions of samples
        (metres) as arrays [1][x] and [y][1] and returns complex values that broadcast to [y][x]. The grid has `samples`
        columns and rows at `pitch`, centred at x = y = 0, or is given as `grid`.

        >>> import hogel, numpy as np
        >>> tilted = hogel.Field.from_function(lambda x, y: np.exp(2e5j * x), samples=(64, 32), pitch="2um", wavelength="633nm")
        >>> tilted
        Field(64x32 samples 2 um apart, 0.128 mm x 64 um, 633 nm, computed when read)
        >>> tilted[0, :3].shape
        (3,)
        """
        if grid is None:
            if samples is None or pitch is None:
                raise usage_error("samples, pitch", "a field needs the number and the pitch of its samples")
            columns, rows = units.counts(samples, "samples")
            step = units.length(pitch, "pitch")
            grid = _core.Grid(columns, rows, step, step)
        plane = grid

        def region(x0: int, y0: int, width: int, height: int) -> Any:
            x = np.array([plane.x(i) for i in range(x0, x0 + width)])[None, :]
            y = np.array([plane.y(j) for j in range(y0, y0 + height)])[:, None]
            return np.broadcast_to(np.asarray(function(x, y), np.complex64), (height, width))

        sampling = _core.FieldGrid(plane, units.length(wavelength, "wavelength"))
        return cls(_core.field_of_function(sampling, region, metadata), "computed when read")

    @property
    def grid(self) -> _core.Grid:
        """Positions of the samples."""
        return self._source.grid.plane

    @property
    def coords(self) -> dict[str, "np.ndarray[Any, Any]"]:
        """Coordinates of the axes y and x, metres, for xarray."""
        g = self.grid
        return {"y": np.array([g.y(j) for j in range(g.height)]), "x": np.array([g.x(i) for i in range(g.width)])}

    @property
    def wavelength(self) -> float:
        """Wavelength, metres."""
        return self._source.grid.wavelength

    @property
    def looks(self) -> int:
        """Number of looks: statistically independent speckle realisations of the same object."""
        return self._source.looks

    @property
    def shape(self) -> tuple[int, int]:
        """(rows, columns)."""
        return self.grid.height, self.grid.width

    @property
    def metadata(self) -> dict[str, str]:
        """Provenance of the field."""
        return dict(self._source.metadata)

    def read(self, key: Any = (), progress: Progress = None) -> "np.ndarray[Any, Any]":
        """Returns the samples selected by slices and integers. Reads or computes only the region that contains them.

        >>> import hogel, numpy as np
        >>> wave = hogel.Field.from_array(np.ones((32, 64), np.complex64), pitch="2um", wavelength="633nm")
        >>> wave.read((slice(0, 8), 3)).shape
        (8,)
        """
        axes = axes_of(key, self.shape)
        memory = _core.samples_in_memory(self._source)
        if memory is not None:
            return memory[tuple(axis.key for axis in axes)]
        y, x = axes
        width = (x.count - 1) * x.step + 1 if x.count else 0
        height = (y.count - 1) * y.step + 1 if y.count else 0
        with reporting(progress, "reading") as report:
            values = _core.read_region(self._source, x.begin, y.begin, width, height, self._look, report)
        return arranged(values[:: y.step, :: x.step], axes)

    def look(self, number: int) -> "Field":
        """Returns the field of one look, in memory.

        >>> import hogel, numpy as np
        >>> wave = hogel.Field.from_array(np.ones((32, 64), np.complex64), pitch="2um", wavelength="633nm")
        >>> wave.look(0).shape
        (32, 64)
        """
        if not 0 <= number < self.looks:
            raise IndexError(f"look {number}: there are {self.looks}")
        return Field(_core.load_field(self._source, number, None), "in memory")

    def load(self, *, progress: Progress = None) -> "Field":
        """Returns the same field in memory.

        >>> import hogel, numpy as np
        >>> wave = hogel.Field.from_array(np.ones((32, 64), np.complex64), pitch="2um", wavelength="633nm")
        >>> wave.propagate("1mm").load().where
        'in memory'
        """
        with reporting(progress, "reading") as report:
            return Field(_core.load_field(self._source, self._look, report), "in memory")

    @takes(_core.propagate_keywords())
    def propagate(self, distance: units.Length, *, progress: Progress = None, **options: Any) -> "Field":
        """Propagates the field to a parallel plane by the exact propagation of plane waves. A positive distance is along
        +z, towards the viewer. The output has the samples of this field or those given by options.

        >>> import hogel, numpy as np
        >>> wave = hogel.Field.from_array(np.ones((32, 64), np.complex64), pitch="2um", wavelength="633nm")
        >>> wave.propagate("1mm", output_samples=(16, 8), output_pitch="4um")
        Field(16x8 samples 4 um apart, 64 um x 32 um, 633 nm, in memory)
        """
        with reporting(progress, "propagating") as report:
            propagated = _core.propagate_by({"distance": distance, **options}, self._source, self._look, report)
        return Field(propagated, "in memory")

    def propagate_adjoint(
        self, distance: units.Length, *, grid: Optional[_core.Grid] = None, max_error: float = 1e-3, progress: Progress = None
    ) -> "Field":
        """Applies the adjoint P* of P = propagate(distance): <P f, g> = <f, P* g>, sums over samples. This field g is on the
        output samples of P; the result is on `grid`, default: the samples of this field. Gradients need it: propagation
        backwards, times the ratio of sample areas.

        >>> import hogel, numpy as np
        >>> def noise(seed):
        ...     parts = np.random.default_rng(seed).normal(size=(2, 32, 32))
        ...     return hogel.Field.from_array((parts[0] + 1j * parts[1]).astype(np.complex64), pitch="2um", wavelength="633nm")
        >>> f, g = noise(1), noise(2)
        >>> there = np.vdot(g, f.propagate("0.1mm"))
        >>> back = np.vdot(g.propagate_adjoint("0.1mm"), f)
        >>> bool(abs(there - back) < 1e-3 * abs(there))
        True
        """
        source_grid = self.grid
        target = source_grid if grid is None else grid
        area = target.pitch_x * target.pitch_y / (source_grid.pitch_x * source_grid.pitch_y)
        with reporting(progress, "propagating") as report:
            far = -units.length(distance, "distance")
            propagated = Field(_core.propagate(self._source, far, target, self._look, max_error, report), "in memory")
        if area != 1:
            np.multiply(np.asarray(propagated), np.float32(area), out=np.asarray(propagated))
        return propagated

    def focus(
        self,
        *,
        between: Optional[Sequence[units.Length]] = None,
        planes: int = 0,
        max_side: int = 1024,
        progress: Progress = None,
    ) -> _core.FocusSearch:
        """Finds the depths at which an unknown field is in focus. `planes` of the result are sorted by prominence; each has
        depth (metres behind the hologram), prominence, brightest and cell. The result also contains the contrasts at all
        depths. `between`: first and last depth of the search.

        >>> import hogel, numpy as np
        >>> points = np.zeros((128, 128), np.complex64)
        >>> points[32::32, 32::32] = 1
        >>> far = hogel.Field.from_array(points, pitch="4um", wavelength="532nm").propagate("3mm")
        >>> found = far.focus(between=("1mm", "5mm"))
        >>> round(found.planes[0].depth * 1e3, 1)
        3.0
        """
        first, last = (0.0, 0.0) if between is None else units.lengths(between, "between")
        if between is not None and first == last:
            raise usage_error("between", "expected two different depths")
        with reporting(progress, "focus") as report:
            return _core.find_focus(self._source, first, last, planes, max_side, report)

    def fourier_image(self, focal_length: units.Length, *, progress: Progress = None) -> "Field":
        """Returns the field in the back focal plane of a lens, with this field in the front focal plane.

        >>> import hogel, numpy as np
        >>> wave = hogel.Field.from_array(np.ones((32, 64), np.complex64), pitch="2um", wavelength="633nm")
        >>> wave.fourier_image("100mm").shape
        (32, 64)
        """
        with reporting(progress, "propagating") as report:
            return Field(_core.fourier_image(self._source, units.length(focal_length, "focal_length"), report), "in memory")

    def fresnel_image(self, distance: units.Length, *, progress: Progress = None) -> "Field":
        """Returns the field at a distance in the Fresnel approximation, by one Fourier transform.

        >>> import hogel, numpy as np
        >>> wave = hogel.Field.from_array(np.ones((32, 64), np.complex64), pitch="2um", wavelength="633nm")
        >>> wave.fresnel_image("100mm").shape
        (32, 64)
        """
        with reporting(progress, "propagating") as report:
            return Field(_core.fresnel_image(self._source, units.length(distance, "distance"), report), "in memory")

    def select_order(
        self,
        order: str = "right",
        *,
        at: Optional[Sequence[float]] = None,
        aperture: float = 0,
        without_mean: bool = True,
        reference_source: Any = None,
        progress: Progress = None,
    ) -> "Field":
        """Selects the object's diffraction order of a recorded or encoded hologram and moves it to frequency zero. `order`:
        "right" or "left", the brightest at positive or negative frequencies, or "center"; or `at`, a frequency x, y (cycles
        per sample). `aperture`: radius to keep, cycles per sample; default: half the distance to frequency zero. Subtracts
        the mean first, and multiplies by the wave of a reference source at a point x, y, z.

        >>> import hogel, numpy as np
        >>> fringes = 1 + np.cos(np.pi / 2 * np.arange(64.0)) * np.ones((64, 1))
        >>> recorded = hogel.Field.from_array(fringes.astype(np.complex64), pitch="4um", wavelength="532nm")
        >>> recorded.select_order("right").shape
        (64, 64)
        """
        selection = _core.OrderSelection()
        selection.which = choice(_core.OrderSelection.Which, "at" if at is not None else order, "order")
        if at is not None:
            selection.frequency_x, selection.frequency_y = (float(part) for part in at)
        selection.radius, selection.without_mean = aperture, without_mean
        if reference_source is not None:
            selection.reference_source = units.point(reference_source, "reference_source")
        with reporting(progress, "cutting the order out") as report:
            return Field(_core.select_order(self._source, selection, report)[0], "in memory")

    def photograph_on_bench(
        self,
        focal: Any,
        *,
        at: Sequence[float] = (0, 0),
        aperture: float = 0,
        focus: Any = 0,
        fill_factor: float = 1,
        zero_order_stop: float = 0,
        source: str = "laser",
        progress: Progress = None,
    ) -> tuple[Picture, dict[str, Any]]:
        """Photographs the field as the reflectance of a modulator's pixels on an optical bench with lenses of a focal length,
        as `hogel photo --focal`. `at`, `aperture`: middle (x, y) and radius of the aperture, cycles per pixel. Returns the
        picture, in which a mirror is 1, and the speckle contrast, efficiency, resolution and source of docs/modulators.md.

        >>> import hogel, numpy as np
        >>> mirror = hogel.Field.from_array(np.ones((64, 64), np.complex64), pitch="8um", wavelength="532nm")
        >>> picture, measures = mirror.photograph_on_bench("200mm", aperture=0.25, source="sources:4,1mm")
        >>> picture, measures["points"], round(measures["resolution"] * 1e6, 2)
        (Picture(64x64 pixels, 1 channel), 4, 19.52)
        """
        bench = _core.Bench()
        bench.focal_length, bench.focus = units.length(focal, "focal"), units.length(focus, "focus")
        bench.aperture = _core.Aperture(float(at[0]), -float(at[1]), aperture)
        bench.fill_factor, bench.zero_order_stop = fill_factor, zero_order_stop
        bench.source = _core.parse_light_source(source)
        with reporting(progress, "photograph on the bench") as report:
            taken = _core.photograph_on_bench(self._source, bench, report)
        names = ("contrast", "efficiency", "resolution", "points", "wavelengths", "is_converged")
        return Picture(taken.picture), {name: getattr(taken, name) for name in names}

    @takes(_core.wave_photograph_keywords())
    def photograph(self, *, cameras: Optional[Sequence[_core.Camera]] = None, progress: Progress = None, **options: Any) -> Any:
        """Photographs the field as a hologram of one wavelength: see Hologram.photograph().

        >>> import hogel, numpy as np
        >>> wave = hogel.Field.from_array(np.ones((64, 64), np.complex64), pitch="4um", wavelength="633nm")
        >>> wave.photograph(pupil="10mm", resolution=16)
        Picture(16x16 pixels, 1 channel)
        """
        return photograph_fields([self._source], None, None, cameras, progress, options)

    @passes_options_to(pattern_of)
    def slm(self, **options: Any) -> Pattern:
        """Returns the modulator pattern of the field: see Hologram.slm().

        >>> import hogel, numpy as np
        >>> wave = hogel.Field.from_array(np.ones((32, 32), np.complex64), pitch="8um", wavelength="532nm")
        >>> np.asarray(wave.slm(encoding="phase", pixels=32, pixel_pitch="8um")).shape
        (32, 32, 1)
        """
        return pattern_of([self._source], None, **options)

    def picture(self, display: str = "intensity", *, progress: Progress = None) -> Picture:
        """Returns a picture of the samples, as `hogel propagate --display`: intensity |F|², amplitude, phase (black at -pi,
        white at pi), real (real part, black at minus the largest modulus, white at plus), or log, the logarithm of the
        intensity over four decades.

        >>> import hogel, numpy as np
        >>> wave = hogel.Field.from_array(np.full((32, 64), 2j, np.complex64), pitch="2um", wavelength="633nm")
        >>> [round(float(np.asarray(wave.picture(display))[0, 0, 0]), 2) for display in ("intensity", "amplitude", "phase")]
        [4.0, 2.0, 0.52]
        """
        quantity = choice(_core.FieldQuantity, "intensity" if display == "log" else display, "display")
        with reporting(progress, "reading") as report:
            image = _core.picture_of(self._source, quantity, self._look, report)
        return Picture(_core.logarithmic(image) if display == "log" else image)

    def intensity(self) -> Picture:
        """Returns the picture of |F|².

        >>> import hogel, numpy as np
        >>> wave = hogel.Field.from_array(np.ones((32, 64), np.complex64), pitch="2um", wavelength="633nm")
        >>> wave.intensity()
        Picture(64x32 pixels, 1 channel)
        """
        return self.picture()

    def _repr_png_(self) -> bytes:
        return self.intensity().png()

    def __repr__(self) -> str:
        g = self.grid
        apart = units.say_length(g.pitch_x) + ("" if g.pitch_x == g.pitch_y else f" x {units.say_length(g.pitch_y)}")
        looks = "" if self.looks == 1 else f", {self.looks} looks"
        return (
            f"Field({g.width}x{g.height} samples {apart} apart, {units.say_length(g.size_x)} x {units.say_length(g.size_y)}, "
            f"{units.say_length(self.wavelength)}{looks}, {self.where})"
        )
