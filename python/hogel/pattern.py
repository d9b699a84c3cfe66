# SPDX-License-Identifier: Apache-2.0
"""Patterns of spatial light modulators."""
from __future__ import annotations

import os
import re
import warnings
from typing import Any, Optional, Union

import numpy as np

from . import _core, _record, units
from ._keywords import takes
from ._progress import Progress, reporting
from .errors import UsageError


class Pattern:
    """Levels of a modulator's pixels, for one or three wavelengths: `np.asarray(pattern)` is an array
    [y][x][c] of bytes, or of uint16 for more than 256 levels.
    Created by Hologram.slm().

    >>> import hogel, numpy as np
    >>> wave = hogel.Field.from_array(np.ones((32, 32), np.complex64), pitch="8um", wavelength="532nm")
    >>> pattern = hogel.Hologram(wave).slm(encoding="phase", pixels=32, pixel_pitch="8um")
    >>> np.asarray(pattern).shape
    (32, 32, 1)
    """

    def __init__(
        self, encoded: _core.SuitablePatterns, levels: list[Any], modulator: _core.Modulator, entries: list[tuple[str, str]]
    ) -> None:
        # `levels`: those that are sent to the panel. `entries`: metadata stored in its file.
        self._parts, self.modulator, self._entries = encoded.patterns, modulator, entries
        self._count = len(encoded.quality) or len(self._parts)  # wavelengths
        frames = [np.stack(levels[first : first + self._count], axis=-1) for first in range(0, len(levels), self._count)]
        self.levels = frames[0] if len(frames) == 1 else np.stack(frames)
        self.quality = encoded.quality
        self.encoding = encoded.encoding.name.replace("_", "-")

    def __array__(self, dtype: Any = None) -> "np.ndarray[Any, Any]":
        return self.levels if dtype is None else self.levels.astype(dtype, copy=False)

    @property
    def efficiency(self) -> list[float]:
        """For each wavelength, the fraction of the light on the modulator that forms the wave of the hologram."""
        return [part.efficiency for part in self._parts[: self._count]]

    @property
    def correlation(self) -> list[float]:
        """For each wavelength, the correlation of the wave behind the aperture with that of the hologram (phase patterns)."""
        return [part.correlation for part in self._parts[: self._count]]

    @property
    def aperture(self) -> list[_core.Aperture]:
        """For each wavelength, the round aperture in the Fourier plane that passes the light of the hologram: centre (x to
        the right, y downwards) and radius in cycles per pixel."""
        return [part.aperture for part in self._parts[: self._count]]

    @property
    def power(self) -> list[float]:
        """For each wavelength, the illumination power per pixel at which the pattern is as bright as the hologram. Their
        ratios reproduce the colours of the hologram."""
        return [part.power for part in self._parts[: self._count]]

    @property
    def reference_angle(self) -> list[float]:
        """For each wavelength, the angle of the reference wave, radians; 0: no reference wave."""
        return [part.reference_angle for part in self._parts[: self._count]]

    def transmission(self, number: int = 0) -> "np.ndarray[Any, Any]":
        """Returns the complex transmission [y][x] of the modulator for a wavelength, before conversion to another phase code and
        to the levels of the panel.

        >>> import hogel, numpy as np
        >>> wave = hogel.Field.from_array(np.ones((32, 32), np.complex64), pitch="8um", wavelength="532nm")
        >>> pattern = hogel.Hologram(wave).slm(encoding="phase", pixels=32, pixel_pitch="8um")
        >>> float(abs(pattern.transmission()[0, 0]).round(6))
        1.0
        """
        return _core.transmission(self._parts[number], _core.encoding(self.encoding))

    def save(self, path: Union[str, "os.PathLike[str]"], *, metadata: Any = None) -> None:
        """Writes the levels without conversion: as .png or .bmp, 8-bit, or 16-bit .png for more than 256 levels; as an array of
        NumPy, .npy; or as slmsuite's SLM.save_phase(), .h5, for one wavelength. A .png stores pitch, wavelength and phase
        code, so hogel opens it without options.

        >>> import hogel, numpy as np, os, tempfile
        >>> wave = hogel.Field.from_array(np.ones((32, 32), np.complex64), pitch="8um", wavelength="532nm")
        >>> pattern = hogel.Hologram(wave).slm(encoding="phase", pixels=32, pixel_pitch="8um")
        >>> pattern.save(os.path.join(tempfile.mkdtemp(), "pattern.png"))
        """
        name = os.fspath(path)
        entries = self._entries if metadata is None else metadata
        largest = self._parts[0].max_level
        if self.levels.ndim == 3:
            _core.require_writable(name)
            _core.write_levels(name, self.levels, largest, entries)
            return
        if "#" not in os.path.basename(name):
            raise UsageError(f"{name}: expected name####.png for {len(self.levels)} patterns")
        for frame, levels in enumerate(self.levels):
            _core.write_levels(numbered(name, frame), levels, largest, entries)

    def __repr__(self) -> str:
        m = self.modulator
        shares = ", ".join(f"{100 * share:.3g} %" for share in self.efficiency)
        return f"Pattern({m.width}x{m.height} pixels {units.say_length(m.pitch)} apart, {self.encoding}, efficiency {shares})"


def numbered(name: str, frame: int) -> str:
    """Returns name0007.png for name####.png and frame 7."""
    folder, base = os.path.split(name)
    return os.path.join(folder, re.sub("#+", lambda digits: str(frame).zfill(len(digits[0])), base, count=1))


@takes(_core.pattern_keywords())
def pattern_of(
    fields: list[_core.FieldSource],
    made: Optional[_record.Record],
    known: Optional[tuple[_core.LightField, _core.HologramRequest]] = None,
    *,
    progress: Progress = None,
    **options: Any,
) -> Pattern:
    """See Hologram.slm(). `made`: options of the command line for fields opened from a file. `known`: the light field of
    the holograms and their request."""
    modulator = _core.pattern_options(options).modulator
    if len(fields) not in (1, 3):
        raise UsageError(f"slm: a pattern takes one or three wavelengths, not {len(fields)}")
    with reporting(progress, "pattern") as report:
        if known is not None and options.get("encoding") == "supervised":
            encoded = _core.encode_light_field(options, *known, report)
        else:
            encoded = _core.encode_patterns(options, fields, report)
    for note in _core.pattern_notes(options, fields):
        warnings.warn(note, stacklevel=5)
    levels = _core.panel_levels(options, encoded, fields)
    facts = _core.pattern_metadata(options, encoded, fields)
    if made is None:
        return Pattern(encoded, levels, modulator, _record.by_function("Hologram.slm") + facts)
    record = {**_record.renamed(made, "phase-code", "input-phase-code"), **dict(_core.pattern_record(options, encoded.encoding))}
    entries = _core.with_history(_record.entries("slm", record) + facts, fields[0].provenance)
    return Pattern(encoded, levels, modulator, entries)
