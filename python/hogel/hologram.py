# SPDX-License-Identifier: Apache-2.0
"""Complex fields on a plane, and holograms: fields of one or several wavelengths."""
from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from typing import Any, Optional, Union

import numpy as np

from . import _core, units
from ._indices import arranged, axes_of
from ._progress import Progress, reporting
from .camera import camera as camera_of
from .errors import BadInputError, UsageError
from .light_field import Path, _choice, array_of
from .pattern import Pattern, modulator_of, pattern_of
from .picture import Picture


def _channel(wavelength: float) -> int:
    """The channel of a picture for light of a wavelength: 0 red, 1 green, 2 blue."""
    return 0 if wavelength >= 580e-9 else 1 if wavelength >= 490e-9 else 2


def _method(
    name: str, phase: Optional[str], lobes: str, basis: Optional[str], tolerance: float, line_pitch: Optional[units.Length]
) -> Any:
    method = _core.hologram_method(name)
    if basis is not None and basis != "pieces" and basis not in _core.transform_names():
        _core.throw_unknown("transform", basis, _core.transform_names())
    if line_pitch is not None:
        if not hasattr(method, "line_pitch") or method.line_pitch is None:
            raise UsageError(f"line_pitch: belongs to the methods lines and basis-lines, not {name}")
        method.line_pitch = units.length(line_pitch, "line_pitch")
    average = _choice(_core.LobeAverage, lobes, "lobes")
    if isinstance(method, (_core.Fourier, _core.Lines)):
        method.average = average
        if phase is not None:
            method.phases = _choice(_core.Phases, phase, "phase")
    elif isinstance(method, _core.Basis):
        method.transform = basis or _core.defaults["basis"]
        method.tolerance = tolerance
        if phase is not None:
            method.phases = _choice(_core.SharedPhases, phase, "phase")
    elif isinstance(method, _core.OverlapAdd):
        if phase is not None:
            method.phases = _choice(_core.PointPhases, phase, "phase")
    elif phase is not None:
        raise UsageError(f"phase: is not for the method {name}, whose phases are those of the points")
    return method


def hologram_request(
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
) -> _core.HologramRequest:
    """What `hogel hologram` asks for, by the names of its options: see LightField.hologram()."""
    wanted = _core.HologramRequest()
    if wavelength is not None:
        wanted.channels = [(value, _channel(value)) for value in units.lengths(wavelength, "wavelength")]
    wanted.pitch = units.optional_length(pitch, _core.defaults["pitch"], "pitch")
    wanted.method = _method(method, phase, lobes, basis, tolerance, line_pitch)
    wanted.looks, wanted.seed = looks, seed
    return wanted


class Field:
    """A monochromatic complex field F[y][x], row 0 at the top: in memory, in a file, or computed when it is read. What is
    read of it are arrays of complex64.

    >>> import hogel, numpy as np
    >>> wave = hogel.Field.from_array(np.ones((64, 64), np.complex64), pitch="2um", wavelength="633nm")
    >>> wave
    Field(64x64 samples 2 um apart, 0.128 mm x 0.128 mm, 633 nm, in memory)
    >>> far = wave.propagate("1mm")
    >>> round(float(abs(far[32, 32])), 3) < 2
    True
    """

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
        """The field of an array [y][x], around x = y = 0 or with `grid` anywhere. An array of complex64 is not copied,
        whatever its strides; do not change it while the field is in use."""
        values = array_of(samples, np.complex64)
        if values.ndim != 2:
            raise UsageError(f"samples: an array [y][x] was expected, not one of {values.ndim} axes")
        if grid is None:
            if pitch is None:
                raise UsageError("pitch: a field needs the distance of its samples")
            step = units.length(pitch, "pitch")
            grid = _core.Grid(values.shape[1], values.shape[0], step, step)
        sampling = _core.FieldGrid(grid, units.length(wavelength, "wavelength"))
        return cls(_core.field_of_array(sampling, values, metadata), "in memory")

    @property
    def grid(self) -> _core.Grid:
        """The positions of the samples."""
        return self._source.grid.plane

    @property
    def wavelength(self) -> float:
        """Metres."""
        return self._source.grid.wavelength

    @property
    def looks(self) -> int:
        """How many statistically independent fields of the same object there are."""
        return self._source.looks

    @property
    def shape(self) -> tuple[int, int]:
        """(rows, columns)."""
        return self.grid.height, self.grid.width

    @property
    def ndim(self) -> int:
        """2."""
        return 2

    @property
    def dtype(self) -> "np.dtype[Any]":
        """complex64."""
        return np.dtype(np.complex64)

    @property
    def nbytes(self) -> int:
        """Bytes of all samples."""
        return 8 * self.grid.width * self.grid.height

    @property
    def metadata(self) -> dict[str, str]:
        """What made the field."""
        return dict(self._source.metadata)

    def read(self, key: Any = (), progress: Progress = None) -> "np.ndarray[Any, Any]":
        """The samples that slices and whole numbers take; no others are read or computed than those between them."""
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

    def __getitem__(self, key: Any) -> "np.ndarray[Any, Any]":
        return self.read(key)

    def __len__(self) -> int:
        return self.shape[0]

    def __array__(self, dtype: Any = None) -> "np.ndarray[Any, Any]":
        values = self.read()
        return values if dtype is None else values.astype(dtype, copy=False)

    def __dlpack__(self, stream: Any = None) -> Any:
        return np.asarray(self).__dlpack__()

    def __dlpack_device__(self) -> tuple[int, int]:
        return 1, 0  # the processor's memory

    def look(self, number: int) -> "Field":
        """The field of one look, completely in memory."""
        if not 0 <= number < self.looks:
            raise IndexError(f"look {number}: there are {self.looks}")
        return Field(_core.load_field(self._source, number, None), "in memory")

    def load(self, *, progress: Progress = None) -> "Field":
        """The same field in memory."""
        with reporting(progress, "reading") as report:
            return Field(_core.load_field(self._source, self._look, report), "in memory")

    def propagate(
        self,
        distance: units.Length,
        *,
        output_pitch: Optional[units.Length] = None,
        output_samples: Optional[units.Counts] = None,
        offset_x: units.Length = 0,
        offset_y: units.Length = 0,
        max_error: float = 1e-3,
        progress: Progress = None,
    ) -> "Field":
        """The field on a parallel plane, farther along +z, towards the viewer, or backwards if negative: its plane waves,
        exactly, at the samples of the field or at others."""
        output = self._output(output_pitch, output_samples, offset_x, offset_y)
        far = units.length(distance, "distance")
        with reporting(progress, "propagating") as report:
            moved = _core.propagate(self._source, far, output, self._look, max_error, report)
        return Field(moved, "in memory")

    def _output(self, pitch: Any, samples: Any, offset_x: Any, offset_y: Any) -> _core.Grid:
        field = self.grid
        width, height = (field.width, field.height) if samples is None else units.counts(samples, "output_samples")
        step = None if pitch is None else units.length(pitch, "output_pitch")
        return _core.Grid(
            width,
            height,
            field.pitch_x if step is None else step,
            field.pitch_y if step is None else step,
            field.center_x + units.length(offset_x, "offset_x"),
            field.center_y + units.length(offset_y, "offset_y"),
        )

    def focus(
        self,
        *,
        between: Optional[Sequence[units.Length]] = None,
        planes: int = 0,
        max_side: int = 1024,
        progress: Progress = None,
    ) -> _core.FocusSearch:
        """Where an unknown field is in focus: `planes` of the result, the clearest first, each with its depth behind the
        hologram, prominence, brightest and cell; and the contrasts at all depths. `between`: two depths to search between."""
        first, last = (0.0, 0.0) if between is None else units.lengths(between, "between")
        if between is not None and first == last:
            raise UsageError("between: two different depths were expected")
        with reporting(progress, "focus") as report:
            return _core.find_focus(self._source, first, last, planes, max_side, report)

    def fourier_image(self, focal_length: units.Length, *, progress: Progress = None) -> "Field":
        """The field in the back focal plane of a lens in whose front focal plane this one lies."""
        with reporting(progress, "propagating") as report:
            return Field(_core.fourier_image(self._source, units.length(focal_length, "focal_length"), report), "in memory")

    def fresnel_image(self, distance: units.Length, *, progress: Progress = None) -> "Field":
        """The field at a distance by one Fourier transform, Fresnel's approximation."""
        with reporting(progress, "propagating") as report:
            return Field(_core.fresnel_image(self._source, units.length(distance, "distance"), report), "in memory")

    def intensity(self) -> Picture:
        """The picture of |F|²."""
        values = np.asarray(self)
        return Picture(values.real**2 + values.imag**2)

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


class Hologram:
    """A hologram: a field for each wavelength. Made by LightField.hologram(), open(), or of fields.

    >>> import hogel
    >>> from hogel import mm, deg, nm
    >>> lf = hogel.Scene.load("pumpkin").render(hogels=8, directions=16, size=0.4*mm, fov=16*deg)
    >>> holo = lf.hologram(wavelength=633*nm, pitch="1.5625um")
    >>> holo
    Hologram(256x256 samples 1.5625 um apart, 0.4 mm x 0.4 mm, 633 nm, computed when read)
    >>> holo[0].shape, np.asarray(holo[0]).dtype
    ((256, 256), dtype('complex64'))
    """

    def __init__(self, fields: Any, where: str = "in memory", known: Any = None) -> None:
        if isinstance(fields, Field):
            fields = [fields]
        self._sources = [field._source if isinstance(field, Field) else field for field in fields]
        self.where, self._known = where, known
        if not self._sources:
            raise UsageError("hologram: at least one field was expected")

    @classmethod
    def open(
        cls,
        path: Path,
        *,
        pitch: Optional[units.Length] = None,
        wavelength: Union[units.Length, Sequence[units.Length], None] = None,
        values: Optional[str] = None,
        phase_code: Union[str, _core.PhaseCode, None] = None,
        imaginary: Optional[Path] = None,
        phases: Optional[Path] = None,
        zero: Optional[float] = None,
        variable: str = "",
        conjugate: bool = False,
    ) -> "Hologram":
        """Opens a hologram (.h5), or the field of another program: .npy, .npz, .mat, .ohc, .exr, or pictures of amplitudes,
        phases, or real and imaginary parts. Pitch and wavelength are for files that do not say them; values is "amplitude" or
        "phase"; the rest are the options of `hogel photo` of these names (docs/holograms-from-elsewhere.md)."""
        name = os.fspath(path)
        described = values is not None or phase_code is not None or imaginary is not None or phases is not None
        if not described and not _core.is_external_field(name):
            if pitch is not None or wavelength is not None:
                raise UsageError(f"pitch, wavelength: {name} has its own")
            return cls(_core.open_hologram(name), name)
        return cls(_external(name, pitch, wavelength, _description(values, phase_code, imaginary, phases, zero, variable, conjugate)), name)

    def __len__(self) -> int:
        return len(self._sources)

    def __getitem__(self, number: int) -> Field:
        return Field(self._sources[number], self.where)

    def __iter__(self) -> Iterator[Field]:
        return (self[number] for number in range(len(self)))

    @property
    def grid(self) -> _core.Grid:
        """The positions of the samples of the first field."""
        return self[0].grid

    @property
    def wavelengths(self) -> list[float]:
        """Metres."""
        return [field.wavelength for field in self]

    @property
    def metadata(self) -> dict[str, str]:
        """What made the hologram."""
        return self[0].metadata

    def save(self, path: Path, *, half: bool = False, metadata: Any = None, progress: Progress = None) -> None:
        """Writes .h5, with single floats or with half=True half floats, or fields for other programs: .npy, .npz, .mat,
        .exr. The file appears under its name when it is complete."""
        name = os.fspath(path)
        _core.require_writable(name)
        if metadata is None:
            metadata = [("software", f"hogel {_core.__version__}"), ("command", "hogel.Hologram.save")]
        with reporting(progress, "hologram") as report:
            if os.path.splitext(name)[1] in (".npy", ".npz", ".mat", ".exr"):
                if half:
                    raise UsageError(f"half: belongs to HDF5 files, not to {name}")
                _core.write_fields(name, self._sources, metadata, report)
                return
            _core.require_hdf5(name)
            _core.write_holograms(name, self._sources, half, metadata, report)

    def load(self, *, progress: Progress = None) -> "Hologram":
        """The same hologram in memory, its first look."""
        return Hologram([field.load(progress=progress) for field in self])

    def propagate(self, distance: units.Length, **options: Any) -> "Hologram":
        """All fields on a parallel plane: Field.propagate()."""
        return Hologram([field.propagate(distance, **options) for field in self])

    def photograph(
        self,
        *,
        cameras: Optional[Sequence[_core.Camera]] = None,
        camera: str = "auto",
        expected: bool = False,
        diffuser: str = "none",
        film_distance: units.Length = 0,
        progress: Progress = None,
        **options: Any,
    ) -> Any:
        """A picture by waves, through the camera that the options describe (hogel.camera()): eye, gaze, focus, pupil,
        resolution and so on. With `cameras` a list of pictures, one for each.

        camera        how waves are photographed: auto, eye, narrow or full
        expected      the mean of infinitely many looks, of a hologram that is computed when it is read
        diffuser      "vertical": a diffuser before a hologram with horizontal parallax only
        """
        if len(self) not in (1, 3):
            raise UsageError(f"photograph: a photograph takes one or three wavelengths, not {len(self)}")
        views = [camera_of(self.grid.size_x, self.grid.size_y, **options)] if cameras is None else list(cameras)
        how = _wave_camera(camera, expected, diffuser, units.length(film_distance, "film_distance"))
        for field in self:
            for view in views:
                _core.require_light_towards(field._source.grid, view, diffuser == "vertical")
        with reporting(progress, "wave photograph") as report:
            images = _core.photograph_colours(self._sources, views, how, report)
        pictures = [Picture(image) for image in images]
        if not any(np.asarray(picture).any() for picture in pictures):
            raise BadInputError("hologram: is empty; no light comes from it to the eye")
        return pictures[0] if cameras is None else pictures

    def slm(
        self,
        *,
        encoding: str = "auto",
        device: Optional[str] = None,
        pixels: Optional[units.Counts] = None,
        pixel_pitch: Optional[units.Length] = None,
        levels: int = 256,
        reference: units.Angle = 0,
        clip: Optional[float] = None,
        window: Optional[int] = None,
        iterations: int = 0,
        phase_code: Union[str, _core.PhaseCode] = "hogel",
        progress: Progress = None,
    ) -> Pattern:
        """The pattern of a modulator that shows the hologram: a device by name (hogel.modulators()), or pixels and
        pixel_pitch. The options are those of `hogel slm`.

        >>> import hogel, numpy as np
        >>> wave = hogel.Field.from_array(np.exp(1j * np.arange(64.0))[:, None] * np.ones(64), pitch="8um", wavelength="532nm")
        >>> pattern = hogel.Hologram(wave).slm(encoding="phase", pixels=64, pixel_pitch="8um")
        >>> np.asarray(pattern).shape, np.asarray(pattern).dtype
        ((64, 64, 1), dtype('uint8'))
        """
        modulator = modulator_of(device, pixels, pixel_pitch, levels)
        return pattern_of(self, encoding, modulator, reference, clip, window, iterations, phase_code, progress)

    def compare(self, other: "Hologram", *, progress: Progress = None) -> dict[str, float]:
        """sqnr and psnr (decibels) and max_error of another hologram of this sampling."""
        with reporting(progress, "comparing") as report:
            sqnr, psnr, max_error = _core.compare_fields(self._sources, other._sources, report)
        return {"sqnr": sqnr, "psnr": psnr, "max_error": max_error}

    def __repr__(self) -> str:
        text = repr(self[0])
        waves = ", ".join(units.say_length(value) for value in self.wavelengths)
        return text.replace("Field(", "Hologram(", 1).replace(units.say_length(self.wavelengths[0]), waves, 1)


def _description(
    values: Optional[str], phase_code: Any, imaginary: Any, phases: Any, zero: Optional[float], variable: str, conjugate: bool
) -> _core.ExternalField:
    what = _core.ExternalField()
    if phase_code is not None:
        what.phase_code = _core.parse_phase_code(phase_code) if isinstance(phase_code, str) else phase_code
        if phases is None:
            what.values = _core.ExternalField.Values.phase
    if values is not None:
        what.values = _choice(_core.ExternalField.Values, values, "values")
    if imaginary is not None:
        what.imaginary = os.fspath(imaginary)
    if phases is not None:
        what.phases = os.fspath(phases)
    what.zero, what.variable, what.conjugate = zero, variable, conjugate
    return what


def _external(name: str, pitch: Any, wavelength: Any, what: _core.ExternalField) -> list[_core.FieldSource]:
    facts = _core.external_facts(name, what)
    if pitch is not None:
        what.pitch_x = what.pitch_y = units.length(pitch, "pitch")
    waves = list(facts.wavelengths) if wavelength is None else units.lengths(wavelength, "wavelength")
    if pitch is None and not facts.pitch_x > 0:
        raise UsageError(f"pitch: {name} does not say the distance of its samples")
    if len(waves) != facts.colours:
        raise UsageError(f"wavelength: {name} has {facts.colours} field{'' if facts.colours == 1 else 's'}, and {len(waves)} were said")
    fields = []
    for colour, wave in enumerate(waves):
        what.colour, what.wavelength = colour, wave
        fields.append(_core.open_external_field(name, what))
    return fields


def _wave_camera(name: str, expected: bool, diffuser: str, film_distance: float) -> Any:
    if name not in ("auto", "eye", "narrow", "full"):
        raise UsageError(f"camera: auto, eye, narrow or full were expected, not '{name}'")
    if diffuser not in ("none", "vertical"):
        raise UsageError(f"diffuser: none or vertical were expected, not '{diffuser}'")
    if film_distance != 0 and name != "full":
        raise UsageError("film_distance: the thin lens belongs to the full camera; add camera='full'")
    if name == "full":
        if expected or diffuser != "none":
            raise UsageError("expected, diffuser: are not for the full camera")
        return _core.PlaneWaveCameraOptions(film_distance=film_distance)
    options = _core.PhotographOptions()
    options.from_ = {"eye": _core.LightFrom.hogels, "narrow": _core.LightFrom.samples}.get(name, _core.LightFrom.cheaper)
    options.expected = expected
    options.vertical_diffuser = diffuser == "vertical"
    return options
