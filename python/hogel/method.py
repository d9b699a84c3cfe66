# SPDX-License-Identifier: Apache-2.0
"""How light fields become holograms."""
from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, Optional, Union

from . import _core, _record, units
from ._samples import choice
from .errors import usage_error


def _method(
    name: str, phase: Optional[str], lobes: str, basis: Optional[str], tolerance: float, line_pitch: Optional[units.Length]
) -> Any:
    method = _core.hologram_method(name)
    if basis is not None and basis != "pieces" and basis not in _core.transform_names():
        _core.throw_unknown("transform", basis, _core.transform_names(), "basis")
    if line_pitch is not None:
        if not hasattr(method, "line_pitch") or method.line_pitch is None:
            raise usage_error("line_pitch", f"belongs to the methods lines and basis-lines, not {name}")
        method.line_pitch = units.length(line_pitch, "line_pitch")
    average = choice(_core.LobeAverage, lobes, "lobes")
    if isinstance(method, (_core.Fourier, _core.Lines)):
        method.average = average
        if phase is not None:
            method.phases = choice(_core.Phases, phase, "phase")
    elif isinstance(method, _core.Basis):
        method.transform = basis or _core.defaults["basis"]
        method.tolerance = tolerance
        if phase is not None:
            method.phases = choice(_core.SharedPhases, phase, "phase")
    elif isinstance(method, _core.OverlapAdd):
        if phase is not None:
            method.phases = choice(_core.PointPhases, phase, "phase")
    elif phase is not None:
        raise usage_error("phase", f"is not for the method {name}, whose phases are those of the points")
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
    """What `hogel hologram` asks for, by the names of its options: see LightField.hologram().

    >>> import hogel
    >>> wanted = hogel.hologram_request(wavelength="633nm", method="basis", tolerance=0.1)
    >>> wanted.method.transform, wanted.channels
    ('cdf97', [(6.33e-07, 0)])
    """
    wanted = _core.HologramRequest()
    if wavelength is not None:
        wanted.channels = [(value, _core.channel_of(value)) for value in units.lengths(wavelength, "wavelength")]
    wanted.pitch = units.optional_length(pitch, _core.defaults["pitch"], "pitch")
    wanted.method = _method(method, phase, lobes, basis, tolerance, line_pitch)
    wanted.looks, wanted.seed = looks, seed
    return wanted


def hologram_record(
    wanted: _core.HologramRequest,
    grid: _core.LightFieldGrid,
    wavelength: Any,
    pitch: Any,
    method: str,
    phase: Optional[str],
    lobes: str,
    tolerance: float,
) -> _record.Record:
    """The options of hologram_request() that act, as `hogel hologram` says them."""
    # The samples divide a hogel evenly, so they may be a little farther apart or closer than was asked.
    effective = grid.pitch / max(1.0, math.floor(grid.pitch / wanted.pitch + 0.5))
    acted = {
        "wavelength": _record.length(wavelength) if wavelength is not None else "rgb",
        "pitch": _record.length(effective if abs(effective - wanted.pitch) > 1e-9 * wanted.pitch else pitch, wanted.pitch),
        "method": method,
    }
    how, seeded = wanted.method, True
    if isinstance(how, (_core.Fourier, _core.Lines)):
        acted.update(phase=phase or "random", lobes=lobes)
    elif isinstance(how, _core.Basis):
        acted.update(phase=phase or "fixed", basis=how.transform, tolerance=_record.number(tolerance))
    elif isinstance(how, _core.OverlapAdd):
        acted["phase"] = phase or "random"
        seeded = how.phases == _core.PointPhases.random
    apart = _core.line_pitch(how)
    if apart is not None:
        acted["line-pitch"] = _record.length(apart if apart > 0 else effective)
    if seeded:
        acted["seed"] = str(wanted.seed)
    return acted
