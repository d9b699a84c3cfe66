# SPDX-License-Identifier: Apache-2.0
"""Sets of views, as other programs store light fields, pictures for printers, and films."""
from __future__ import annotations

import os
import tempfile
from collections.abc import Sequence
from typing import Any, Optional, Union

from . import _core, _record, units
from ._progress import Progress, reporting
from ._samples import Path
from .errors import CannotWriteError, UsageError
from .light_field import LightField

_FILMS = (".mp4", ".gif", ".apng")


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


def _one_of(value: Optional[str], known: Sequence[str], what: str) -> Optional[str]:
    if value is not None and value not in known:
        raise UsageError(f"{what}: {' or '.join(known)} were expected, not '{value}'")
    return value


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
            raise UsageError("spacing, fov: only one of them can be asked for")
        how.field_of_view = units.angle(fov, "fov")
    how.disparity, how.densify, how.estimate_disparity = disparity, densify, estimate_disparity
    if views is not None:
        how.columns, how.rows = units.counts(views, "views")
    if middle is not None:
        how.middle_columns, how.middle_rows = units.counts(middle, "middle")
    if _one_of(column, ("first", "second"), "column") is not None:
        how.column_first = column == "first"
    _one_of(mirror, ("none", "columns", "rows", "both"), "mirror")
    how.mirror_columns, how.mirror_rows = mirror in ("columns", "both"), mirror in ("rows", "both")
    if _one_of(projection, ("cameras", "orthographic"), "projection") is not None:
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


def views_of(light_field: LightField) -> Any:
    """What import_views() understood of the set of views that it made this light field of: layout, columns, rows, bits,
    transfer, spacing, distance, scale, parallax, summary, assumed, notes; None for others.

    >>> import hogel
    >>> hogel.views_of(hogel.Scene.load("pumpkin").render(hogels=4, directions=4)) is None
    True
    """
    return light_field._views


def export_views(
    light_field: LightField,
    target: Path,
    *,
    layout: Optional[str] = None,
    pictures: str = "",
    bits: int = 0,
    transfer: Optional[str] = None,
    exposure: float = 1,
    frame_rate: float = 24,
    force: bool = False,
    metadata: Any = None,
    progress: Progress = None,
) -> Any:
    """Writes a light field as a set of views, one for each direction: in a folder, which is made, or a file; or as a film
    of its middle row of views (.mp4, .gif, .apng). The options are those of `hogel export`. Returns columns, rows, files
    and notes.

    >>> import hogel, os, tempfile
    >>> lf = hogel.Scene.load("pumpkin").render(hogels=8, directions=3, size="4mm", focal_plane="-300mm")
    >>> hogel.export_views(lf, os.path.join(tempfile.mkdtemp(), "views.npy")).columns
    3
    """
    name = os.fspath(target)
    stem, ending = os.path.splitext(os.path.basename(name))
    if ending in _FILMS:
        return _export_film(light_field, name, exposure, frame_rate, metadata, progress)
    how = _core.ViewExportOptions()
    if layout is None:
        quilt = bool(ending) and "_qs" in stem
        layout = {".npy": "npy", ".mat": "mat"}.get(ending, "quilt" if quilt else "rows-columns")
    known = {row[0]: row[2] for row in _core.view_layouts()}
    if layout not in known:
        _core.throw_unknown("layout", layout, list(known))
    how.layout = layout
    how.format = pictures or (ending[1:] if layout == "quilt" else "")
    how.bits, how.exposure = bits, exposure
    if transfer is not None:
        how.transfer = _core.transfer_named(transfer)
    if metadata is None:
        metadata = _record.by_function("LightField.export")
        if light_field._made is not None:
            acted = {"layout": layout, "exposure": _record.number(exposure)}
            metadata = _record.entries("export", {**_record.renamed(light_field._made, "source", "input"), **acted})
    how.metadata = metadata
    if known[layout]:
        _make_folder(name, force)
    else:
        _core.require_writable(name)
    with reporting(progress, "exporting") as report:
        return _core.export_views(light_field._light_field, name, how, report)


def _make_folder(name: str, force: bool) -> None:
    if os.path.isdir(name) and os.listdir(name) and not force:
        raise CannotWriteError(f"{name}: holds files already; force=True writes beside and over them")
    try:
        os.makedirs(name, exist_ok=True)
    except OSError as error:
        raise CannotWriteError(f"{name}: {error.strerror}") from None


def _export_film(light_field: LightField, name: str, exposure: float, frame_rate: float, metadata: Any, progress: Progress) -> Any:
    _core.require_writable(name)
    how = _core.ViewExportOptions()
    how.layout, how.format, how.bits, how.exposure = "rows-columns", "png", 8, exposure
    how.transfer = _core.Transfer.srgb
    with tempfile.TemporaryDirectory(dir=os.path.dirname(os.path.abspath(name)), prefix=".hogel-") as folder:
        with reporting(progress, "exporting") as report:
            made = _core.export_views(light_field._light_field, folder, how, report)
        with reporting(progress, "film") as report:
            _core.make_film(name, folder, f"{made.rows // 2:03}_%03d.png", frame_rate, _comment(metadata), report)
    return made


def _comment(metadata: Any) -> str:
    entries = metadata.items() if isinstance(metadata, dict) else metadata or _record.by_function("film")
    return "\n".join(f"{key}: {text}" for key, text in entries)


def film(
    path: Path,
    pictures: Sequence[Any],
    *,
    frame_rate: Optional[float] = None,
    exposure: Union[str, float] = "auto",
    metadata: Any = None,
    progress: Progress = None,
) -> None:
    """Makes a film (.mp4, .gif, .apng), by the program ffmpeg, of pictures of one size, all with the same exposure.

    >>> import hogel, numpy as np, os, tempfile
    >>> frames = [np.full((16, 16, 3), level) for level in (0.2, 0.8)]
    >>> if hogel._core.can_make_films():  # where ffmpeg is installed
    ...     hogel.film(os.path.join(tempfile.mkdtemp(), "grey.gif"), frames)
    """
    from .picture import Picture

    name = os.fspath(path)
    if os.path.splitext(name)[1] not in _FILMS:
        raise UsageError(f"{name}: films end in {', '.join(_FILMS)}")
    frames = [frame if isinstance(frame, Picture) else Picture(frame) for frame in pictures]
    if not frames:
        raise UsageError("film: at least one picture was expected")
    if len({(frame.width, frame.height) for frame in frames}) > 1:
        raise UsageError("film: pictures of one size were expected")
    _core.require_writable(name)
    factor = min(frame.exposure("auto") for frame in frames) if exposure == "auto" else float(exposure)
    with tempfile.TemporaryDirectory(dir=os.path.dirname(os.path.abspath(name)), prefix=".hogel-") as folder:
        for number, frame in enumerate(frames):
            frame.save(os.path.join(folder, f"{number:06}.png"), exposure=factor)
        rate = _core.defaults["frame_rate"] if frame_rate is None else float(frame_rate)
        with reporting(progress, "film") as report:
            _core.make_film(name, folder, "%06d.png", rate, _comment(metadata), report)


def write_printer_images(
    light_field: LightField,
    folder: Path,
    *,
    strips: bool = False,
    order: str = "serpentine",
    exposure: float = 1,
    force: bool = False,
    metadata: Any = None,
    progress: Progress = None,
) -> list[str]:
    """Writes the directions of every hogel as a picture, numbered in the order of printing, or with strips=True those of a
    row of hogels side by side, as `hogel print` does. Returns the files.

    >>> import hogel, os, tempfile
    >>> lf = hogel.Scene.load("pumpkin").render(hogels=8, directions=8, size="0.4mm")
    >>> len(hogel.views.write_printer_images(lf, os.path.join(tempfile.mkdtemp(), "prints")))
    64
    """
    name = os.fspath(folder)
    _one_of(order, ("serpentine", "rows"), "order")
    if metadata is None:
        metadata = _record.by_function("LightField.print")
        if light_field._made is not None:
            acted = {"strips": _record.words(strips), "order": order, "exposure": _record.number(exposure)}
            metadata = _record.entries("print", {**light_field._made, **acted})
    _make_folder(name, force)
    with reporting(progress, "pictures") as report:
        made = _core.write_printer_images(name, light_field._light_field, strips, order == "serpentine", exposure, metadata, report)
    return [os.fspath(file) for file in made]


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
