# SPDX-License-Identifier: Apache-2.0
"""Wave photographs of fields."""
from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Optional

import numpy as np

from . import _core, _record
from ._progress import Progress, reporting
from .camera import cameras_of
from .errors import BadInputError, UsageError
from .picture import Picture


def photograph_fields(
    fields: list[_core.FieldSource],
    origin: Any,
    made: Optional[_record.Record],
    cameras: Optional[Sequence[_core.Camera]],
    progress: Progress,
    options: dict[str, Any],
) -> Any:
    """See Hologram.photograph(). `origin`: light field and request from which the fields are computed, or None; `made`:
    options of the equivalent command, or None."""
    if len(fields) not in (1, 3):
        raise UsageError(f"photograph: a photograph takes one or three wavelengths, not {len(fields)}")
    plane = fields[0].grid.plane
    views = cameras_of(cameras, plane.size_x, plane.size_y, options)
    model = _core.wave_camera(options, fields)
    for field in fields:
        for view in views:
            _core.require_light_towards(field.grid, view, getattr(model, "vertical_diffuser", False))
    with reporting(progress, "wave photograph") as report:
        images = _core.photograph_colours(fields, views, model, report)
    pictures = [Picture(image) for image in images]
    if not any(np.asarray(picture).any() for picture in pictures):
        raise BadInputError("hologram: is empty; no light comes from it to the eye")
    if cameras is not None:
        return pictures
    if made is not None:
        record = {**made, **dict(_core.wave_photograph_record(options, origin, views))}
        if record.get("speckle") == "none":
            record.pop("seed", None)
        pictures[0]._made = ("photo", record)
    return pictures[0]
