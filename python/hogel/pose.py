# SPDX-License-Identifier: Apache-2.0
"""Colours, axes and lights of scenes, from the words of the command line."""
from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Union

from . import _core, _record, units
from .errors import usage_error

Colour = Union[str, Sequence[float]]
_NAMES = {
    "black": "#000000",
    "white": "#ffffff",
    "grey": "#808080",
    "red": "#ff0000",
    "green": "#00ff00",
    "blue": "#0000ff",
    "yellow": "#ffff00",
}


def linear(value: Colour, what: str) -> tuple[float, float, float]:
    """Linear R, G, B, of three linear numbers, a name or #rrggbb, which is sRGB."""
    if isinstance(value, str):
        code = _NAMES.get(value, value)
        try:
            if len(code) != 7 or code[0] != "#":
                raise ValueError
            parts = [int(code[i : i + 2], 16) for i in (1, 3, 5)]
        except ValueError:
            raise usage_error(what, f"'{value}' is not a colour; write #rrggbb, or {', '.join(_NAMES)}") from None
        return tuple(_core.srgb_decode(part / 255) for part in parts)  # type: ignore[return-value]
    red, green, blue = (float(part) for part in value)
    return red, green, blue


def up(value: Union[str, Sequence[float]]) -> tuple[float, float, float]:
    if isinstance(value, str):
        sign = -1.0 if value.startswith("-") else 1.0
        axis = value.lstrip("-")
        if axis not in ("x", "y", "z") or len(value) > 2:
            raise usage_error("up", f"'{value}' is not an axis; write x, y, z, -x, -y or -z")
        return tuple(sign * (axis == name) for name in "xyz")  # type: ignore[return-value]
    x, y, z = (float(part) for part in value)
    return x, y, z


def light(direction: Sequence[float], colour: Colour = "white", strength: float = 2.2) -> _core.Light:
    """A directional light that comes from `direction` (x, y, z), with its irradiance.

    >>> import hogel
    >>> [round(part, 3) for part in hogel.light((0, 0, 2), "white", 1.5).intensity]
    [1.5, 1.5, 1.5]
    """
    size = math.hypot(*direction)
    if not (size > 0 and math.isfinite(size)):
        raise usage_error("light", f"{direction!r} is not a direction")
    x, y, z = (-part / size for part in direction)
    red, green, blue = (strength * part for part in linear(colour, "light"))
    return _core.Light(direction=(x, y, z), intensity=(red, green, blue))


def light_of(text: str) -> _core.Light:
    """A light as the command line writes it: X,Y,Z[:COLOUR[:STRENGTH]]."""
    parts = text.split(":")
    try:
        direction = [float(part) for part in parts[0].split(",")]
        strength = float(parts[2]) if len(parts) > 2 else 2.2
        if len(direction) != 3 or len(parts) > 3 or not strength >= 0:
            raise ValueError
    except ValueError:
        raise usage_error(
            "light", f"'{text}' is not a light; write where it comes from, X,Y,Z, then :COLOUR and :STRENGTH if you like"
        ) from None
    return light(direction, parts[1] if len(parts) > 1 else "white", strength)


def say_light(of: _core.Light) -> str:
    x, y, z = (_record.number(-part or 0) for part in of.direction)
    return f"{x},{y},{z}:" + ",".join(f"{part:.6g}" for part in of.intensity)


def say_rotation(radians: Sequence[float]) -> str:
    return ",".join(f"{part / units.deg:.6g}" for part in radians) + "deg"
