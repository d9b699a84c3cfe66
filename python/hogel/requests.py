# SPDX-License-Identifier: Apache-2.0
"""Requests for light fields of scenes."""
from __future__ import annotations

from typing import Any

from . import _core
from ._keywords import takes


@takes(_core.light_field_keywords())
def request(**options: Any) -> _core.LightFieldRequest:
    """Returns the request of `hogel render` with these options: see Scene.render().

    >>> import hogel
    >>> hogel.request(hogels=(64, 48), directions=16, size="6.4mm").grid.shape
    (3, 48, 64, 16, 16)
    """
    return _core.light_field_request(options)

