# SPDX-License-Identifier: Apache-2.0
"""Equality, repr() and pickling of value types of the extension module."""
from __future__ import annotations

from typing import Any

from . import _core

#: Value types, defined by their members.
OPTIONS = (
    "BandCamera Basis BakeOptions CodingMethod CompressionOptions DirectCamera ExternalField FilePart Fourier HologramRequest Light "
    "LightFieldRequest Lines Lossless MakeRequest Material MaxError Modulator NamedCamera OrderSelection OverlapAdd PanelLevels PatternOptions PhaseAdded PhaseCode "
    "PixelsPerBit PlaneWaveCamera ScenePose ShadingOptions SpeckleFreeCamera Sqnr Step TextureSampling"
).split()
#: Constructor arguments; the other members are set afterwards.
_CONSTRUCTOR_ARGUMENTS = {
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
    """Returns the names and values of the properties of a value of the module."""
    return {name: getattr(value, name) for name in _names(type(value))}


def _names(kind: type) -> list[str]:
    return [name for name, member in vars(kind).items() if isinstance(member, property)]


def rebuilt(kind: type, state: dict[str, Any]) -> Any:
    """Returns the value with these members()."""
    value_of_kind = kind(**{name: state[name] for name in _CONSTRUCTOR_ARGUMENTS.get(kind.__name__, ())})
    for name, value in state.items():
        member = vars(kind)[name]
        if member.fset is not None and name not in _CONSTRUCTOR_ARGUMENTS.get(kind.__name__, ()):
            setattr(value_of_kind, name, value)
    return value_of_kind


def _equal(self: Any, other: object) -> Any:
    return members(self) == members(other) if type(self) is type(other) else NotImplemented


def _repr(self: Any) -> str:
    return f"{type(self).__name__}({', '.join(f'{name}={value!r}' for name, value in members(self).items())})"


def add_value_semantics() -> None:
    for name in OPTIONS:
        kind: Any = getattr(_core, name, None)
        if kind is not None:
            kind.__eq__, kind.__hash__, kind.__repr__ = _equal, None, _repr
            kind.__reduce__ = lambda self: (rebuilt, (type(self), members(self)))
