# SPDX-License-Identifier: Apache-2.0
"""Cameras, from the words of the command line."""
from __future__ import annotations

from typing import Any, Optional

from . import _core, units
from ._core import Camera
from ._keywords import takes


@takes(_core.camera_keywords())
def camera(width: units.Length, height: Optional[units.Length] = None, **options: Any) -> Camera:
    """The camera that photographs a hologram of this width and height (metres).

    >>> import hogel
    >>> view = hogel.camera("20mm", eye="0,0,300mm", focus="5mm")
    >>> view.picture.width, view.focus_depth
    (400, 0.005)
    """
    wide = units.length(width, "width")
    return _core.camera(options, wide, wide if height is None else units.length(height, "height"))
