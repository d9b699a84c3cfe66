# SPDX-License-Identifier: Apache-2.0
"""Sets of views, as other programs store light fields."""
from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, Optional, Union

from . import _core, _record, units
from ._progress import Progress, reporting
from ._samples import Path, one_of
from .errors import UsageError, usage_error
from .light_field import LightField

def view_layouts() -> dict[str, str]:
    """The names of the ways to store a set of views, of `layout`, and a line about each.

    >>> import hogel
    >>> "rows-columns" in hogel.view_layouts()
    True
    """
    return {name: text for name, text, _, _ in _core.view_layouts()}


def is_view_set(source: Path) -> bool:
    """Whether a folder or file is a set of views that a layout recognises.

    >>> import hogel, tempfile
    >>> hogel.is_view_set(tempfile.mkdtemp())
    False
    """
    return _core.is_view_set(os.fspath(source))


def import_views(
    source: Path,
    *,
    layout: str = "",
    size: Optional[units.Length] = None,
    distance: Optional[units.Length] = None,
    spacing: Optional[units.Length] = None,
    fov: Optional[units.Angle] = None,
    disparity: float = 0,
    views: Optional[units.Counts] = None,
    middle: Optional[units.Counts] = None,
    column: Optional[str] = None,
    mirror: str = "none",
    projection: Optional[str] = None,
    transfer: Optional[str] = None,
    depth: bool = False,
    densify: int = 1,
    depth_scale: Optional[float] = None,
    estimate_disparity: bool = False,
    spool: Optional[Path] = None,
    progress: Progress = None,
) -> LightField:
    """The light field of a set of views, a folder or a file. The options are those of `hogel import`; `spool` is a folder
    for a temporary file of sets that do not fit into memory. What was understood of the set is `views_of(light_field)`.

    >>> import hogel, os, tempfile
    >>> lf = hogel.Scene.load("pumpkin").render(hogels=8, directions=3, size="4mm", focal_plane="-300mm")
    >>> views = os.path.join(tempfile.mkdtemp(), "views")
    >>> made = lf.export(views)
    >>> hogel.import_views(views, size="4mm").shape
    (3, 8, 8, 3, 3)
    """
    name = os.fspath(source)
    how = _core.ViewOptions()
    how.layout = layout
    if size is not None:
        how.size = units.length(size, "size")
    if distance is not None:
        how.distance = units.length(distance, "distance")
    if spacing is not None:
        how.spacing = units.length(spacing, "spacing")
    if fov is not None:
        if spacing is not None:
            raise usage_error("spacing, fov", "only one of them can be asked for")
        how.field_of_view = units.angle(fov, "fov")
    how.disparity, how.densify, how.estimate_disparity = disparity, densify, estimate_disparity
    if views is not None:
        how.columns, how.rows = units.counts(views, "views")
    if middle is not None:
        how.middle_columns, how.middle_rows = units.counts(middle, "middle")
    if one_of(column, ("first", "second"), "column") is not None:
        how.column_first = column == "first"
    one_of(mirror, ("none", "columns", "rows", "both"), "mirror")
    how.mirror_columns, how.mirror_rows = mirror in ("columns", "both"), mirror in ("rows", "both")
    if one_of(projection, ("cameras", "orthographic"), "projection") is not None:
        how.orthographic = projection == "orthographic"
    if transfer is not None:
        how.transfer = _core.transfer_named(transfer)
    how.with_depth = depth
    how.depth_scale = depth_scale or 0
    if spool is not None:
        how.spool = os.fspath(spool)
    with reporting(progress, "looking at the views") as report:
        found = _core.import_views(name, how, report)
    acted = {
        "source": name,
        "mirror": mirror,
        "layout": found.layout,
        "transfer": _core.transfer_names()[int(found.transfer)],
        "size": _record.length(found.light_field.grid.width),
    }
    for option, value in (("distance", distance), ("spacing", spacing)):
        if value is not None:
            acted[option] = _record.length(value)
    if fov is not None:
        acted["fov"] = _record.angle(fov)
    if projection is not None:
        acted["projection"] = projection
    if column is not None and found.layout in ("rows-columns", "mat"):
        acted["column"] = column
    for option, counts in (("views", views), ("middle", middle)):
        if counts is not None:
            acted[option] = _record.words(counts)
    if disparity != 0:
        acted["disparity"] = _record.number(disparity)
    if densify > 1:
        acted["densify"] = str(densify)
    if depth:
        acted["depth"] = "yes"
    if depth_scale and (densify > 1 or depth) and not found.estimated:
        acted["depth-scale"] = _record.number(depth_scale)
    if found.estimated:
        acted["estimate-disparity"] = "yes"
    made = LightField(found.light_field, name, acted)
    made._views = found
    return made


def write_cameras(
    path: Path,
    *,
    hogels: Optional[units.Counts] = None,
    directions: units.Counts = 9,
    size: Optional[units.Length] = None,
    fov: Union[units.Angle, Sequence[units.Angle], None] = None,
    distance: units.Length = 0.3,
) -> list[str]:
    """Writes the cameras whose pictures make a light field of this sampling, transforms.json, as `hogel cameras` does.
    Returns what a user of the cameras should know.

    >>> import hogel, os, tempfile
    >>> path = os.path.join(tempfile.mkdtemp(), "cameras.json")
    >>> said = hogel.write_cameras(path, hogels=(80, 60), directions=5, size="100mm")
    >>> os.path.exists(path)
    True
    """
    defaults, name = _core.defaults, os.fspath(path)
    if os.path.splitext(name)[1] != ".json":
        raise UsageError(f"{name}: cameras are written as .json")
    _core.require_writable(name)
    columns, rows = units.counts(defaults["hogels"] if hogels is None else hogels, "hogels")
    across, down = units.counts(directions, "directions")
    width = units.optional_length(size, defaults["size"], "size")
    wide, high = (defaults["field_of_view"],) * 2 if fov is None else units.angles(fov, "fov")
    view = _core.field_of_view(wide, high, 0, 0)
    plane = _core.FocalPlane(-units.length(distance, "distance"), view.half_u, view.half_v, view.center_u, view.center_v)
    return list(_core.write_cameras(_core.LightFieldGrid(columns, rows, width / columns, across, down, plane), name))
