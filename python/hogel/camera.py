# SPDX-License-Identifier: Apache-2.0
"""Cameras, from the options of the command line."""
from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Optional

from . import _core, units
from ._core import Camera
from ._keywords import takes
from .errors import usage_error


@takes(_core.camera_keywords())
def camera(width: units.Length, height: Optional[units.Length] = None, **options: Any) -> Camera:
    """Returns the camera for a hologram of this width and height (metres).

    >>> import hogel
    >>> view = hogel.camera("20mm", eye="0,0,300mm", focus="5mm")
    >>> view.picture.width, view.focus_depth
    (400, 0.005)
    """
    wide = units.length(width, "width")
    return _core.camera(options, wide, wide if height is None else units.length(height, "height"))


def cameras_of(cameras: Optional[Sequence[Camera]], width: float, height: float, options: dict[str, Any]) -> list[Camera]:
    """Returns the given cameras, or the one described by options, for a hologram of this size."""
    if cameras is None:
        return [_core.camera(options, width, height)]
    described = [name for name, _, _ in _core.camera_keywords() if options.get(name) is not None]
    if described:
        raise usage_error(", ".join(["cameras", *described]), "give either cameras or options that describe one")
    return list(cameras)
