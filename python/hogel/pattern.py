# SPDX-License-Identifier: Apache-2.0
"""Patterns of spatial light modulators."""
from __future__ import annotations

import os
from typing import Any, Optional, Union

import numpy as np

from . import _core, _record, units
from ._progress import Progress, reporting
from .errors import UsageError, usage_error


class Pattern:
    """The levels of a modulator's pixels, for one wavelength or three: `np.asarray(pattern)` is [y][x][c] of bytes. Made
    by Hologram.slm().

    >>> import hogel, numpy as np
    >>> wave = hogel.Field.from_array(np.ones((32, 32), np.complex64), pitch="8um", wavelength="532nm")
    >>> pattern = hogel.Hologram(wave).slm(encoding="phase", pixels=32, pixel_pitch="8um")
    >>> np.asarray(pattern).shape
    (32, 32, 1)
    """

    def __init__(
        self,
        levels: "np.ndarray[Any, Any]",
        encoding: str,
        modulator: _core.Modulator,
        parts: list[_core.Pattern],
        fields: list[_core.FieldSource],
        phase_code: _core.PhaseCode,
    ) -> None:
        self.levels, self.encoding, self.modulator, self._parts = levels, encoding, modulator, parts
        self._fields, self._phase_code = fields, phase_code
        self._made: Optional[_record.Record] = None

    def __array__(self, dtype: Any = None) -> "np.ndarray[Any, Any]":
        return self.levels if dtype is None else self.levels.astype(dtype, copy=False)

    @property
    def efficiency(self) -> list[float]:
        """For each wavelength, the share of the light on the modulator that goes into the hologram's wave."""
        return [part.efficiency for part in self._parts]

    @property
    def correlation(self) -> list[float]:
        """For each wavelength, of patterns of phases: how like the hologram's wave theirs is behind the aperture."""
        return [part.correlation for part in self._parts]

    @property
    def aperture(self) -> list[_core.Aperture]:
        """For each wavelength, the round aperture in the plane of the spectrum that lets the hologram's light through, its
        middle (x to the right, y downwards) and radius in cycles per pixel."""
        return [part.aperture for part in self._parts]

    @property
    def power(self) -> list[float]:
        """For each wavelength, the power of the light on a pixel that makes the pattern as bright as the hologram; their
        ratio is that of the powers which show the hologram's colours."""
        return [part.power for part in self._parts]

    @property
    def reference_angle(self) -> list[float]:
        """For each wavelength, the angle of the reference wave, radians; 0 without one."""
        return [part.reference_angle for part in self._parts]

    def transmission(self, number: int = 0) -> "np.ndarray[Any, Any]":
        """The complex transmission [y][x] of the modulator for a wavelength, before a phase code other than hogel's.

        >>> import hogel, numpy as np
        >>> wave = hogel.Field.from_array(np.ones((32, 32), np.complex64), pitch="8um", wavelength="532nm")
        >>> pattern = hogel.Hologram(wave).slm(encoding="phase", pixels=32, pixel_pitch="8um")
        >>> float(abs(pattern.transmission()[0, 0]).round(6))
        1.0
        """
        return _core.transmission(self._parts[number], _core.encoding(self.encoding))

    def save(self, path: Union[str, "os.PathLike[str]"], *, metadata: Any = None) -> None:
        """Writes .png or .bmp of 8 bits, the levels as they are. Files but .bmp describe their field: pitch,
        wavelength and phase code, by which hogel opens them without being told.

        >>> import hogel, numpy as np, os, tempfile
        >>> wave = hogel.Field.from_array(np.ones((32, 32), np.complex64), pitch="8um", wavelength="532nm")
        >>> pattern = hogel.Hologram(wave).slm(encoding="phase", pixels=32, pixel_pitch="8um")
        >>> pattern.save(os.path.join(tempfile.mkdtemp(), "pattern.png"))
        """
        name = os.fspath(path)
        _core.require_writable(name)
        if metadata is None:
            metadata = _record.by_function("Hologram.slm") + self._field_entries() if self._made is None else self._entries()
        _core.write_raw_pixels(name, self.levels, metadata)

    def _entries(self) -> list[tuple[str, str]]:
        """What its file says made it, the facts of each wavelength, and the history of the hologram."""
        entries = _record.entries("slm", self._made or {})
        phases = _core.is_phase_only(_core.encoding(self.encoding))
        for part, field in zip(self._parts, self._fields):
            name = units.say_length(field.grid.wavelength)
            entries.append((f"efficiency at {name}", f"{part.efficiency:.6f}"))
            if phases:
                entries.append((f"correlation at {name}", f"{part.correlation:.6f}"))
            if part.iterations > 0:
                entries.append((f"iterations at {name}", str(part.iterations)))
            if part.reference_angle != 0:
                entries.append((f"reference angle at {name}", f"{part.reference_angle / units.deg:.6f}deg"))
            entries.append((f"power at {name}", f"{part.power:.6g}"))
            entries.append((f"aperture at {name}", _in_words(part.aperture, field.grid.wavelength / self.modulator.pitch)))
        return _core.with_history(entries + self._field_entries(), self._fields[0].provenance)

    def _field_entries(self) -> list[tuple[str, str]]:
        """The texts by which its file describes its field."""
        what, values = _core.ExternalField(), _core.ExternalField.Values
        what.pitch_x = what.pitch_y = self.modulator.pitch
        what.values = values.phase if _core.is_phase_only(_core.encoding(self.encoding)) else values.amplitude
        what.phase_code = self._phase_code
        return _core.field_entries(what, [field.grid.wavelength for field in self._fields])

    def __repr__(self) -> str:
        m = self.modulator
        shares = ", ".join(f"{100 * share:.3g} %" for share in self.efficiency)
        return f"Pattern({m.width}x{m.height} pixels {units.say_length(m.pitch)} apart, {self.encoding}, efficiency {shares})"


def _in_words(aperture: _core.Aperture, per_cycle: float) -> str:
    """The words of `hogel slm`; per_cycle: wavelength over pixel pitch."""
    middle = ""
    if aperture.x != 0 or aperture.y != 0:
        middle = f" around {aperture.x:.4f} to the right and {0.0 - aperture.y:.4f} up"
    return f"radius {aperture.radius:.4f} cycles a pixel{middle}, {aperture.radius * per_cycle * 0.2 / 1e-3:.2f} mm at a lens of 200 mm"


def modulator_of(
    device: Optional[str], pixels: Optional[units.Counts], pixel_pitch: Optional[units.Length], levels: int
) -> _core.Modulator:
    """A modulator by name, or described."""
    described = pixels is not None or pixel_pitch is not None
    if (device is None) != described:
        raise usage_error("device, pixels, pixel_pitch", "name a modulator, or describe one by its pixels and their pitch")
    if device is not None:
        return _core.modulator(device.lower())
    if pixels is None or pixel_pitch is None:
        raise usage_error("pixels, pixel_pitch", "a modulator is described by both")
    columns, rows = units.counts(pixels, "pixels")
    if not 1 <= min(columns, rows) <= max(columns, rows) <= 65536:
        raise usage_error("pixels", "1 to 65536 were expected on a side")
    if not 2 <= levels <= 256:
        raise usage_error("levels", "2 to 256 were expected")
    return _core.Modulator(columns, rows, units.length(pixel_pitch, "pixel_pitch"), levels)


def pattern_of(
    fields: list[_core.FieldSource],
    made: Optional[_record.Record],
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
    """See Hologram.slm(). `made`: the options of the command line that opened the fields, if they were opened."""
    modulator = modulator_of(device, pixels, pixel_pitch, levels)
    if len(fields) not in (1, 3):
        raise UsageError(f"slm: a pattern takes one or three wavelengths, not {len(fields)}")
    options = _core.PatternOptions(modulator)
    options.reference_angle = units.angle(reference, "reference")
    if clip is not None:
        options.clip = clip
    if window is not None:
        options.window = window
    options.iterations = iterations
    options.phase_code = _core.parse_phase_code(phase_code) if isinstance(phase_code, str) else phase_code
    with reporting(progress, "pattern") as report:
        if encoding == "auto":
            options.encoding, parts = _core.encode_suitably(fields, options, report)
            encoding = options.encoding.name.replace("_", "-")
        else:
            options.encoding = _core.encoding(encoding)
            parts = [_core.encode_pattern(field, options, report) for field in fields]
    pattern = Pattern(np.stack([part.levels for part in parts], axis=-1), encoding, modulator, parts, fields, options.phase_code)
    if made is None:
        return pattern
    acted = {**_record.renamed(made, "phase-code", "input-phase-code"), "encoding": encoding}
    if _core.is_phase_only(options.encoding):
        acted["phase-code"] = phase_code if isinstance(phase_code, str) else ""
    if device is None:
        acted.update(pixels=_record.words(pixels), **{"pixel-pitch": _record.length(pixel_pitch)})
        if encoding != "binary":
            acted["levels"] = str(modulator.levels)
    else:
        acted["device"] = device
    if encoding == "gerchberg-saxton":
        acted["window"] = str(options.window)
    if encoding in ("gerchberg-saxton", "gradient") and iterations:
        acted["iterations"] = str(iterations)
    acted["clip"] = _record.number(options.clip)
    if encoding in ("intensity", "bipolar", "binary"):
        acted["reference"] = _record.angle(reference)
    pattern._made = acted
    return pattern
