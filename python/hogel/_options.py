# SPDX-License-Identifier: Apache-2.0
"""The manners of values of the extension module: they can be compared and pickled, and say what they are."""
from __future__ import annotations

from typing import Any

from . import _core

#: Values that are what their members are.
OPTIONS = (
    "BandCamera Basis BakeOptions CodingMethod CompressionOptions DirectCamera ExternalField FilePart Fourier HologramRequest Light "
    "LightFieldRequest Lines Lossless MakeRequest Material MaxError Modulator NamedCamera OrderSelection OverlapAdd PatternOptions PhaseAdded PhaseCode "
    "PixelsPerBit PlaneWaveCamera ScenePose ShadingOptions SpeckleFreeCamera Sqnr Step TextureSampling"
).split()
#: What is given when one is made; the other members are set after that.
_MADE_OF = {
    "Sqnr": ("decibels",),
    "PixelsPerBit": ("rate",),
    "Step": ("radiance",),
    "MaxError": ("radiance",),
    "Modulator": ("width", "height", "pitch", "levels", "name"),
    "PatternOptions": ("modulator",),
    "FilePart": ("number", "count"),
    "NamedCamera": ("eye_name", "focus_name", "camera"),
    "Light": ("direction", "intensity"),
}


def members(value: Any) -> dict[str, Any]:
    """The names and values of the properties of one of the module's values."""
    return {name: getattr(value, name) for name in _names(type(value))}


def _names(kind: type) -> list[str]:
    return [name for name, member in vars(kind).items() if isinstance(member, property)]


def rebuilt(kind: type, state: dict[str, Any]) -> Any:
    """The value whose members() these are."""
    made = kind(**{name: state[name] for name in _MADE_OF.get(kind.__name__, ())})
    for name, value in state.items():
        member = vars(kind)[name]
        if member.fset is not None and name not in _MADE_OF.get(kind.__name__, ()):
            setattr(made, name, value)
    return made


def _equal(self: Any, other: object) -> Any:
    return members(self) == members(other) if type(self) is type(other) else NotImplemented


def _say(self: Any) -> str:
    return f"{type(self).__name__}({', '.join(f'{name}={value!r}' for name, value in members(self).items())})"


def add_manners() -> None:
    for name in OPTIONS:
        kind: Any = getattr(_core, name, None)
        if kind is not None:
            kind.__eq__, kind.__hash__, kind.__repr__ = _equal, None, _say
            kind.__reduce__ = lambda self: (rebuilt, (type(self), members(self)))
