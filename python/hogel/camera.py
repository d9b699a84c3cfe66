# SPDX-License-Identifier: Apache-2.0
"""Cameras, from the words of the command line."""
from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, Optional, Union

from . import _core, _record, units
from ._core import Camera
from .errors import usage_error


def camera(
    width: units.Length,
    height: Optional[units.Length] = None,
    *,
    eye: Union[str, Sequence[units.Length], None] = None,
    gaze: Union[str, Sequence[units.Length]] = (0, 0, 0),
    focus: units.Length = 0,
    focus_tilt: Union[units.Angle, Sequence[units.Angle]] = 0,
    pupil: Optional[units.Length] = None,
    f_number: Optional[float] = None,
    focal_length: Optional[units.Length] = None,
    angle_of_view: units.Angle = 0,
    resolution: Union[units.Counts, None] = None,
) -> Camera:
    """The camera that photographs a hologram of this width and height (metres).

    eye, gaze      points x, y, z: the centre of the lens, and what is in the middle of the picture
    focus          depth in focus, positive behind the hologram
    focus_tilt     angles of the plane in focus, to the right and upwards
    pupil          diameter of the lens; or f_number, a part of focal_length
    angle_of_view  across; 0: what shows the hologram
    resolution     pixels across, or across and down

    >>> import hogel
    >>> view = hogel.camera("20mm", eye="0,0,300mm", focus="5mm")
    >>> view.picture.width, view.focus_depth
    (400, 0.005)
    """
    defaults = _core.defaults
    wide = units.length(width, "width")
    high = wide if height is None else units.length(height, "height")
    x, y, z = (0.0, 0.0, defaults["eye_distance"]) if eye is None else units.point(eye, "eye")
    gaze_x, gaze_y, gaze_z = units.point(gaze, "gaze")
    tilt_x, tilt_y = units.angles(focus_tilt, "focus_tilt")
    if not max(abs(tilt_x), abs(tilt_y)) < math.pi / 2:
        raise usage_error("focus_tilt", "angles between -90deg and 90deg were expected")
    if f_number is not None:
        if pupil is not None:
            raise usage_error("pupil, f_number", "only one of them says how wide the lens is")
        if not f_number > 0:
            raise usage_error("f_number", "a positive number was expected")
        pupil = units.optional_length(focal_length, defaults["focal_length"], "focal_length") / f_number
    opening = units.optional_length(pupil, defaults["pupil"], "pupil")
    if not z > 0:
        raise usage_error("eye", f"the eye is in front of the hologram, at z > 0, not at {units.say_length(z)}")
    if not gaze_z < z:
        raise usage_error("gaze", "the eye looks at a point in front of it, not beside or behind it")
    view = units.angle(angle_of_view, "angle_of_view")
    if not 0 <= view < 3.1:
        raise usage_error("angle_of_view", "an angle below 180deg was expected")
    # The middle of the picture is where the line of sight to that point meets the hologram plane.
    along = z / (z - gaze_z)
    shown = 2 * z * math.tan(0.5 * view) if view > 0 else wide
    given = defaults["resolution"] if resolution is None else resolution
    columns, rows = units.counts(given, "resolution")
    if columns < 1 or rows < 1:
        raise usage_error("resolution", "at least one pixel was expected")
    pixel = shown / columns
    if isinstance(given, int) or (isinstance(given, str) and "x" not in given):
        # std::lround() rounds halves away from zero.
        rows = max(1, math.floor(shown * high / wide / pixel + 0.5))
    grid = _core.Grid(columns, rows, pixel, pixel, x + along * (gaze_x - x), y + along * (gaze_y - y))
    made = Camera(
        eye=(x, y, z),
        focus_depth=units.length(focus, "focus"),
        focus_slope_x=math.tan(tilt_x),
        focus_slope_y=math.tan(tilt_y),
        pupil=opening,
        picture=grid,
    )
    _core.validate_camera(made)
    return made


def camera_record(**given: Any) -> _record.Record:
    """The options of camera() as `hogel photo` says them."""
    defaults = _core.defaults
    acted = {
        "eye": _record.length(given.get("eye"), (0.0, 0.0, defaults["eye_distance"])),
        "gaze": _record.length(given.get("gaze"), (0.0, 0.0, 0.0)),
        "focus": _record.length(given.get("focus")),
        "focus-tilt": _record.angle(given.get("focus_tilt")),
        "angle-of-view": _record.angle(given.get("angle_of_view")),
        "resolution": _record.words(given.get("resolution"), defaults["resolution"]),
    }
    if given.get("f_number"):
        acted["f-number"] = _record.number(given["f_number"])
        acted["focal-length"] = _record.length(given.get("focal_length"), defaults["focal_length"])
    else:
        acted["pupil"] = _record.length(given.get("pupil"), defaults["pupil"])
    return acted
