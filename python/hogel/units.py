# SPDX-License-Identifier: Apache-2.0
"""Units: lengths are in metres and angles in radians, as floats. Every function also accepts texts with units.

>>> import hogel
>>> from hogel import mm, deg
>>> 16 * mm, round(180 * deg, 6)
(0.016, 3.141593)
>>> hogel.length("633nm")
6.33e-07
"""
from __future__ import annotations

import math
import numbers
from collections.abc import Callable, Iterable, Sequence
from typing import Union

from . import _core
from .errors import UsageError, usage_error

m = 1.0
cm = 1e-2
mm = 1e-3
um = 1e-6
nm = 1e-9
deg = math.pi / 180
rad = 1.0

Length = Union[float, str]
Angle = Union[float, str]
Counts = Union[int, str, Sequence[int]]


def _number(value: object, what: str, expected: str) -> float:
    if isinstance(value, numbers.Real) and not isinstance(value, bool) and math.isfinite(value):
        return float(value)
    raise usage_error(what, f"{value!r} is not {expected}")


def _parsed(parse: Callable[[str, str], float], text: str, what: str) -> float:
    try:
        return parse(text, what)
    except UsageError as error:
        error.parameter = what
        raise


def length(value: Length, what: str = "length") -> float:
    """Returns a length in metres, from a number of metres or a text such as "16mm".

    >>> import hogel
    >>> hogel.length("1.5um"), hogel.length(0.25)
    (1.5e-06, 0.25)
    """
    if isinstance(value, str):
        return _parsed(_core.parse_length, value, what)
    return _number(value, what, "a length; write metres, such as 0.016 or 16*mm, or a text such as '16mm'")


def angle(value: Angle, what: str = "angle") -> float:
    """Returns an angle in radians, from a number of radians or a text such as "16deg".

    >>> import hogel
    >>> round(hogel.angle("180deg"), 6)
    3.141593
    """
    if isinstance(value, str):
        return _parsed(_core.parse_angle, value, what)
    return _number(value, what, "an angle; write radians, such as 16*deg, or a text such as '16deg'")


def lengths(value: Union[Length, Sequence[Length]], what: str) -> list[float]:
    """Returns one or several lengths in metres, from numbers or texts such as "633nm" or "633,532,460nm".

    >>> from hogel.units import lengths
    >>> lengths("633,532nm", "wavelength")
    [6.33e-07, 5.32e-07]
    """
    if isinstance(value, str):
        *first, last = value.split(",")
        unit = last.lstrip("+-.0123456789eE ")
        return [length(part if part.endswith(unit) else part + unit, what) for part in (*first, last)]
    return [length(part, what) for part in value] if isinstance(value, Iterable) else [length(value, what)]


def point(value: Union[str, Sequence[Length]], what: str) -> tuple[float, float, float]:
    """Returns a point x, y, z in metres, from three lengths or a text such as "-30,0,300mm".

    >>> from hogel.units import point
    >>> point("-30,0,300mm", "eye")
    (-0.03, 0.0, 0.3)
    """
    three = lengths(value, what)
    if len(three) != 3:
        raise usage_error(what, f"expected three lengths x, y and z, not {value!r}")
    return three[0], three[1], three[2]


def counts(value: Counts, what: str) -> tuple[int, int]:
    """Returns columns and rows, from a pair (64, 48), one number for both, or a text "64x48".

    >>> from hogel.units import counts
    >>> counts("64x48", "hogels"), counts(16, "hogels")
    ((64, 48), (16, 16))
    """
    parts: Sequence[object]
    if isinstance(value, str):
        parts = value.split("x")
    else:
        parts = list(value) if isinstance(value, Iterable) else [value]
    try:
        both = [int(part) for part in parts]  # type: ignore[call-overload]
        if len(both) not in (1, 2) or min(both) < 0 or any(isinstance(part, float) and part != int(part) for part in parts):
            raise ValueError
    except (TypeError, ValueError):
        raise usage_error(what, f"{value!r} is neither a number nor a pair; write 64, (64, 48) or '64x48'") from None
    return both[0], both[-1]


def say_length(metres: float) -> str:
    """Returns a length as text with a suitable unit.

    >>> from hogel.units import say_length
    >>> say_length(633e-9)
    '633 nm'
    """
    return _core.format_length(metres)


def say_angle(radians: float) -> str:
    """Returns an angle as text in degrees.

    >>> from hogel.units import deg, say_angle
    >>> say_angle(16 * deg)
    '16°'
    """
    return f"{radians / deg:.4g}°"


def say_bytes(count: float) -> str:
    """Returns a number of bytes as text with a suitable unit.

    >>> from hogel.units import say_bytes
    >>> say_bytes(1500)
    '1.5 kB'
    """
    return _core.format_bytes(float(count))
