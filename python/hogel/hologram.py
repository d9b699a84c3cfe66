# SPDX-License-Identifier: Apache-2.0
"""Holograms: fields of one or several wavelengths."""
from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from typing import Any, Optional

import numpy as np

from . import _core, _record, units
from ._keywords import passes_options_to, takes
from ._progress import Progress, reporting
from ._samples import Path
from .errors import UsageError, usage_error
from .field import Field
from .pattern import Pattern, pattern_of
from .photographs import photograph_fields


class Hologram:
    """Hologram: a field for each wavelength. Created by LightField.hologram(), open(), or from fields.

    >>> import hogel
    >>> from hogel import mm, deg, nm
    >>> lf = hogel.Scene.load("pumpkin").render(hogels=8, directions=16, size=0.4*mm, fov=16*deg)
    >>> holo = lf.hologram(wavelength=633*nm, pitch="1.5625um")
    >>> holo
    Hologram(256x256 samples 1.5625 um apart, 0.4 mm x 0.4 mm, 633 nm, computed when read)
    >>> holo[0].shape, np.asarray(holo[0]).dtype
    ((256, 256), dtype('complex64'))
    """

    def __init__(self, fields: Any, where: str = "in memory", known: Any = None, made: Optional[_record.Record] = None) -> None:
        # `known`: light field and request from which it is computed; `made`: options of the equivalent command.
        if isinstance(fields, Field):
            fields = [fields]
        self._sources = [field._source if isinstance(field, Field) else field for field in fields]
        self.where, self._known, self._made = where, known, made
        self._identity: Optional[str] = None  # identifies its input, for resuming
        self._history: list[tuple[str, str]] = []  # provenance of a scene without a light field
        if not self._sources:
            raise UsageError("hologram: expected at least one field")

    @classmethod
    @takes(_core.field_keywords())
    def open(cls, path: Path, *, progress: Progress = None, **options: Any) -> "Hologram":
        """Opens a hologram (.h5), a pattern of slm(), which describes itself, or another program's field: .npy, .npz, .mat,
        .ohc, .exr, or pictures of amplitudes, phases, or real and imaginary parts. The options are those of `hogel photo`
        (docs/holograms-from-elsewhere.md). `phase_code` may also be a PhaseCode; `order` is "0", "+1", "-1" or a frequency
        "FX,FY", cycles per sample; `reconstruct` is "fourier" or "fresnel".

        >>> import hogel, numpy as np, os, tempfile
        >>> path = os.path.join(tempfile.mkdtemp(), "wave.npy")
        >>> np.save(path, np.ones((8, 16), np.complex64))
        >>> hogel.Hologram.open(path, pitch="2um", wavelength="532nm")[0].shape
        (8, 16)
        """
        name = os.fspath(path)
        with reporting(progress, "opening the hologram") as report:
            fields, record = _core.open_fields(options, name, report)
        return cls(fields, name, made={"input": name, **dict(record)})

    def __len__(self) -> int:
        return len(self._sources)

    def __getitem__(self, number: int) -> Field:
        return Field(self._sources[number], self.where)

    def __iter__(self) -> Iterator[Field]:
        return (self[number] for number in range(len(self)))

    @property
    def grid(self) -> _core.Grid:
        """Positions of the samples of the first field."""
        return self[0].grid

    @property
    def wavelengths(self) -> list[float]:
        """Wavelengths, metres."""
        return [field.wavelength for field in self]

    @property
    def metadata(self) -> dict[str, str]:
        """Provenance of the hologram."""
        return self[0].metadata

    @property
    def is_opened(self) -> bool:
        """Whether it was opened from a file, not computed or propagated."""
        return self._made is not None and "input" in self._made and not {"method", "distance"} & self._made.keys()

    def save(
        self,
        path: Path,
        *,
        half: bool = False,
        resume: bool = False,
        part: Optional[tuple[int, int]] = None,
        metadata: Any = None,
        progress: Progress = None,
    ) -> None:
        """Writes .h5 with single floats, or half floats with half=True, or arrays for other programs: .npy, .npz, .mat,
        .exr. The file appears under its name when it is complete. With resume=True the same call continues an interrupted
        one. part=(2, 8) writes the second of eight parts, one per process; hogel.join() joins them to a file.

        >>> import hogel, os, tempfile
        >>> lf = hogel.Scene.load("pumpkin").render(hogels=8, directions=8, size="0.4mm")
        >>> path = os.path.join(tempfile.mkdtemp(), "holo.h5")
        >>> lf.hologram(wavelength="532nm").save(path)
        >>> len(hogel.Hologram.open(path))
        1
        """
        name = os.fspath(path)
        _core.require_writable(name)
        if metadata is None:
            metadata = self._entries(half)
        with reporting(progress, "hologram") as report:
            if part is not None:
                if resume:
                    raise usage_error("part, resume", "give only one of them")
                _core.write_holograms_part(name, self._sources, half, metadata, self._part(part), report)
                return
            if os.path.splitext(name)[1] in (".npy", ".npz", ".mat", ".exr"):
                if half or resume:
                    raise usage_error("half" if half else "resume", f"applies to HDF5 files, not to {name}")
                _core.write_fields(name, self._sources, metadata, report)
                return
            _core.require_hdf5(name)
            identity = None
            if resume:
                # A file is identified by its name and date, a scene by its checksum.
                identity = self._identity or (_core.describe_input(self._made["input"]) if self._made else None)
                if identity is None:
                    raise usage_error("resume", "work on arrays or functions cannot be resumed")
            _core.write_holograms(name, self._sources, half, metadata, identity, report)

    def _part(self, part: tuple[int, int]) -> _core.FilePart:
        """Returns the part of a file, with its input identified by name and size, or a scene by its checksum."""
        source = self._identity or ""
        if self._made is not None and not source and os.path.isfile(self._made["input"]):
            source = f"{self._made['input']}, {os.path.getsize(self._made['input'])} bytes"
        return _core.FilePart(int(part[0]), int(part[1]), source)

    def _entries(self, half: bool) -> list[tuple[str, str]]:
        """Returns the metadata stored in its file."""
        if self._made is None:
            return _record.by_function("Hologram.save")
        if "distance" in self._made:
            return _record.entries("propagate", self._made)
        if "method" in self._made:
            entries = _record.entries("hologram", {**self._made, "half": _record.yes_or_no(half)})
            return _core.with_history(entries, self._history) if self._history else entries
        return _record.by_function("Hologram.save")

    def plan(self, *, half: bool = False) -> _core.Plan:
        """Returns the memory (bytes), disk space (bytes) and time (seconds) of save(), without the cost of the light field.

        >>> import hogel, os, tempfile
        >>> lf = hogel.Scene.load("pumpkin").render(hogels=8, directions=8, size="0.4mm")
        >>> lf.hologram(wavelength="532nm").plan().disk > 0
        True
        """
        if self._known is None:
            raise UsageError("plan: only for holograms that are computed on demand")
        light_field, wanted = self._known
        return _core.plan_holograms(light_field, wanted, half)

    def load(self, *, progress: Progress = None) -> "Hologram":
        """Returns the first look of the hologram in memory.

        >>> import hogel, os, tempfile
        >>> lf = hogel.Scene.load("pumpkin").render(hogels=8, directions=8, size="0.4mm")
        >>> lf.hologram(wavelength="532nm").load().where
        'in memory'
        """
        return Hologram([field.load(progress=progress) for field in self])

    @passes_options_to(Field.propagate)
    def propagate(self, distance: units.Length, **options: Any) -> "Hologram":
        """Propagates all fields to a parallel plane: see Field.propagate().

        >>> import hogel, os, tempfile
        >>> lf = hogel.Scene.load("pumpkin").render(hogels=8, directions=8, size="0.4mm")
        >>> lf.hologram(wavelength="532nm").propagate("1mm", output_samples=64)
        Hologram(64x64 samples 1.5625 um apart, 0.1 mm x 0.1 mm, 532 nm, in memory)
        """
        made = Hologram([field.propagate(distance, **options) for field in self])
        if self._made is not None and self.is_opened:
            record = _core.propagate_record({"distance": distance, **options}, made.grid)
            made._made = {**self._made, **dict(record)}
        return made

    @takes(_core.wave_photograph_keywords())
    def photograph(self, *, cameras: Optional[Sequence[_core.Camera]] = None, progress: Progress = None, **options: Any) -> Any:
        """Photographs by waves. The options describe the camera (hogel.camera()): eye, gaze, focus, pupil, resolution and so
        on. With `cameras` returns a list of pictures, one for each. `camera` is the model of wave propagation: auto, eye
        (hogel-spectra), narrow (samples) or full (plane-waves).

        >>> import hogel, os, tempfile
        >>> lf = hogel.Scene.load("pumpkin").render(hogels=8, directions=8, size="0.4mm")
        >>> lf.hologram().photograph(eye="10,0,300mm", pupil="20mm", resolution=24)
        Picture(24x24 pixels, 3 channels)
        """
        return photograph_fields(self._sources, self._known, self._made, cameras, progress, options)

    @passes_options_to(pattern_of)
    def slm(self, **options: Any) -> Pattern:
        """Encodes the hologram as a modulator pattern. The modulator is a device by name (hogel.modulators()), or described
        by pixels and pixel_pitch. The options are those of `hogel slm`: encoding, device, pixels, pixel_pitch, levels,
        reference, clip, window, iterations, frames, phase_code, lut, correction, flip, lens and blaze. `supervised` needs a
        hologram that LightField.hologram() returned.

        >>> import hogel, numpy as np
        >>> wave = hogel.Field.from_array(np.exp(1j * np.arange(64.0))[:, None] * np.ones(64), pitch="8um", wavelength="532nm")
        >>> pattern = hogel.Hologram(wave).slm(encoding="phase", pixels=64, pixel_pitch="8um")
        >>> np.asarray(pattern).shape, np.asarray(pattern).dtype
        ((64, 64, 1), dtype('uint8'))
        """
        return pattern_of(self._sources, self._made if self.is_opened else None, self._known, **options)

    def compare(self, other: "Hologram", *, progress: Progress = None) -> dict[str, float]:
        """Returns sqnr and psnr (decibels) and max_error of another hologram of the same sampling.

        >>> import hogel, os, tempfile
        >>> lf = hogel.Scene.load("pumpkin").render(hogels=8, directions=8, size="0.4mm")
        >>> holo = lf.hologram(wavelength="532nm")
        >>> holo.compare(holo.load())["max_error"]
        0.0
        """
        with reporting(progress, "comparing") as report:
            sqnr, psnr, max_error = _core.compare_fields(self._sources, other._sources, report)
        return {"sqnr": sqnr, "psnr": psnr, "max_error": max_error}

    def __repr__(self) -> str:
        text = repr(self[0])
        waves = ", ".join(units.say_length(value) for value in self.wavelengths)
        return text.replace("Field(", "Hologram(", 1).replace(units.say_length(self.wavelengths[0]), waves, 1)
