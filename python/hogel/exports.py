# SPDX-License-Identifier: Apache-2.0
"""Exports of light fields and pictures for other programs: sets of views, pictures for printers, and films."""
from __future__ import annotations

import os
import tempfile
from collections.abc import Sequence
from typing import Any, Optional, Union

from . import _core, _record
from ._keywords import takes
from ._progress import Progress, reporting
from ._rays import Rays
from ._samples import Path
from .errors import CannotWriteError, UsageError
from .picture import Picture


def views_of(light_field: Rays) -> Any:
    """Returns the facts about the set of views from which import_views() created this light field: layout, columns, rows,
    bits, transfer, spacing, distance, scale, parallax, summary, assumed, notes. Returns None for other light fields.

    >>> import hogel
    >>> hogel.views_of(hogel.Scene.load("pumpkin").render(hogels=4, directions=4)) is None
    True
    """
    return light_field._views


@takes(_core.export_keywords())
def export_views(
    light_field: Rays, target: Path, *, force: bool = False, metadata: Any = None, progress: Progress = None, **options: Any
) -> Any:
    """Writes a light field as a set of views, one per direction, to a new folder or a file, or as a film of the middle row
    of views (.mp4, .gif, .apng). The options are those of `hogel export`. Returns columns, rows, files, notes and exposure.

    >>> import hogel, os, tempfile
    >>> lf = hogel.Scene.load("pumpkin").render(hogels=8, directions=3, size="4mm", focal_plane="-300mm")
    >>> hogel.export_views(lf, os.path.join(tempfile.mkdtemp(), "views.npy")).columns
    3
    """
    name = os.fspath(target)
    view_options, frame_rate, acted = _core.export_request(name, options)
    if _core.is_film(name):
        return _export_film(light_field, name, view_options, frame_rate, metadata, progress)
    if metadata is None:
        metadata = _record.by_function("LightField.export")
        if light_field._made is not None:
            made = _record.renamed(_record.renamed(light_field._made, "source", "input"), "scene", "input")
            metadata = _record.entries("export", {**made, **dict(acted)})
    view_options.metadata = metadata
    if light_field._rendering is not None:  # all views in memory, so that it is rendered once
        view_options.memory = max(view_options.memory, 4.0 * light_field.size)
    if {layout: is_folder for layout, _, is_folder, _ in _core.view_layouts()}[view_options.layout]:
        _make_folder(name, force)
    else:
        _core.require_writable(name)
    with reporting(progress, "exporting") as report:
        return _core.export_views(light_field._light_field, name, view_options, report)


def _make_folder(name: str, force: bool) -> None:
    if os.path.isdir(name) and any(not file.startswith(".") for file in os.listdir(name)) and not force:
        raise CannotWriteError(f"{name}: holds files already; use force=True to add files and overwrite them")
    try:
        os.makedirs(name, exist_ok=True)
    except OSError as error:
        raise CannotWriteError(f"{name}: {error.strerror}") from None


def _export_film(light_field: Rays, name: str, view_options: Any, frame_rate: float, metadata: Any, progress: Progress) -> Any:
    _core.require_writable(name)
    with tempfile.TemporaryDirectory(dir=os.path.dirname(os.path.abspath(name)), prefix=".hogel-") as folder:
        with reporting(progress, "exporting") as report:
            made = _core.export_views(light_field._light_field, folder, view_options, report)
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
    """Encodes pictures of equal size as a film (.mp4, .gif, .apng) with ffmpeg, all with the same exposure.

    >>> import hogel, numpy as np, os, tempfile
    >>> frames = [np.full((16, 16, 3), level) for level in (0.2, 0.8)]
    >>> if hogel._core.can_make_films():  # where ffmpeg is installed
    ...     hogel.film(os.path.join(tempfile.mkdtemp(), "grey.gif"), frames)
    """
    name = os.fspath(path)
    if not _core.is_film(name):
        raise UsageError(f"{name}: expected a film name that ends in .mp4, .gif or .apng")
    frames = [frame if isinstance(frame, Picture) else Picture(frame) for frame in pictures]
    if not frames:
        raise UsageError("film: expected at least one picture")
    if len({(frame.width, frame.height) for frame in frames}) > 1:
        raise UsageError("film: expected pictures of equal size")
    _core.require_writable(name)
    factor = min(frame.exposure("auto") for frame in frames) if exposure == "auto" else float(exposure)
    with tempfile.TemporaryDirectory(dir=os.path.dirname(os.path.abspath(name)), prefix=".hogel-") as folder:
        for number, frame in enumerate(frames):
            frame.save(os.path.join(folder, f"{number:06}.png"), exposure=factor)
        rate = _core.defaults["frame_rate"] if frame_rate is None else float(frame_rate)
        with reporting(progress, "film") as report:
            _core.make_film(name, folder, "%06d.png", rate, _comment(metadata), report)


@takes(_core.print_keywords())
def write_printer_images(
    light_field: Rays, folder: Path, *, force: bool = False, metadata: Any = None, progress: Progress = None, **options: Any
) -> _core.PrinterImages:
    """Writes a picture of the directions of every hogel, numbered in the order of printing, and manifest.json, as `hogel
    print` does. With strips=True each picture contains a row of hogels side by side. Returns pictures (their number), first,
    last, manifest, exposure, bytes, samples and clipped (samples brighter than white).

    >>> import hogel, os, tempfile
    >>> lf = hogel.Scene.load("pumpkin").render(hogels=8, directions=8, size="0.4mm")
    >>> hogel.exports.write_printer_images(lf, os.path.join(tempfile.mkdtemp(), "prints"), dose=(1, 0.8, 0.6)).pictures
    64
    """
    name = os.fspath(folder)
    acted = dict(_core.print_record(options))
    if metadata is None:
        metadata = _record.by_function("LightField.print")
        if light_field._made is not None:
            metadata = _record.entries("print", {**_record.renamed(light_field._made, "scene", "input"), **acted})
    _make_folder(name, force)
    with reporting(progress, "pictures") as report:
        return _core.write_printer_images(name, light_field._light_field, options, metadata, report)
