# SPDX-License-Identifier: Apache-2.0
"""Requests for holograms of light fields."""
from __future__ import annotations

from typing import Any

from . import _core, _record
from ._keywords import takes


@takes(_core.hologram_keywords())
def hologram_request(**options: Any) -> _core.HologramRequest:
    """Returns the request of `hogel hologram` with these options: see LightField.hologram().

    >>> import hogel
    >>> wanted = hogel.hologram_request(wavelength="633nm", method="basis", tolerance=0.1)
    >>> wanted.method.transform, wanted.channels
    ('cdf97', [(6.33e-07, 0)])
    """
    return _core.hologram_request(options)


def hologram_record(wanted: _core.HologramRequest, grid: _core.LightFieldGrid, **options: Any) -> _record.Record:
    """Returns the options of hologram_request() that act, as stored by `hogel hologram`."""
    return dict(_core.hologram_record(options, wanted, grid))
