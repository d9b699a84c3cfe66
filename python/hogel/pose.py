# SPDX-License-Identifier: Apache-2.0
"""Lights of scenes."""
from __future__ import annotations

from collections.abc import Sequence
from typing import Union

from . import _core

Colour = Union[str, Sequence[float]]


def light(direction: Sequence[float], colour: Colour = "white", strength: float = 2.2) -> _core.Light:
    """Returns a directional light from `direction` (x, y, z). `strength` is its irradiance.

    >>> import hogel
    >>> [round(part, 3) for part in hogel.light((0, 0, 2), "white", 1.5).intensity]
    [1.5, 1.5, 1.5]
    """
    name = colour if isinstance(colour, str) else ",".join(repr(float(part)) for part in colour)
    return _core.parse_light(f"{','.join(repr(float(part)) for part in direction)}:{name}:{float(strength)!r}")
