# SPDX-License-Identifier: Apache-2.0
"""Holograms of scenes without a light field between them."""
from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, Optional

from . import _core, _record, units
from ._progress import Progress, reporting
from .errors import usage_error
from .hologram import Hologram
from .requests import request


def scene_hologram(
    place: Callable[[_core.LightFieldRequest], _core.Scene],
    record_of: Optional[Callable[[_core.Scene], _record.Record]],
    method: str,
    wavelength: Any,
    pitch: Any,
    spacing: Any,
    planes: Any,
    seed: int,
    options: dict[str, Any],
    progress: Progress,
) -> Hologram:
    """See Scene.hologram(): of the scene that place(request) makes, and whose options of the command line record_of(placed)
    says, if they are known."""
    known = {name: (uses_spacing, uses_planes) for name, _, uses_spacing, uses_planes in _core.scene_hologram_methods()}
    if method not in known:
        _core.throw_unknown("method", method, list(known), "method")
    defaults = _core.defaults
    step = units.optional_length(pitch, defaults["pitch"], "pitch")
    apart = units.optional_length(spacing, defaults["spacing"], "spacing")
    number = int(defaults["planes"] if planes is None else planes)
    if wavelength is None:
        waves = [defaults["red"], defaults["green"], defaults["blue"]]
    else:
        waves = units.lengths(wavelength, "wavelength")
    # cache_spacing is in widths of a ray, and there are no rays.
    without: dict[str, Any] = {**options, "cache_spacing": 0}
    wanted = request(**without)
    width = units.optional_length(options.get("size"), defaults["size"], "size")
    height = width * wanted.grid.hogels_t / wanted.grid.hogels_s
    if not (width >= step and height >= step):
        raise usage_error("size, pitch", "the hologram must hold samples")
    plane = _core.Grid(math.floor(width / step + 0.5), math.floor(height / step + 0.5), step, step)
    placed = place(wanted)
    with reporting(progress, "lighting") as report:
        shaded = _core.light_scene(placed, wanted, report)
    fields = []
    for wave in waves:
        with reporting(progress, "hologram") as report:
            grid = _core.FieldGrid(plane, wave)
            fields.append(_core.make_scene_hologram(method, shaded, grid, _core.channel_of(wave), seed, apart, number, report))
    made = Hologram(fields)
    if record_of is not None:
        rendering = dict(_core.light_field_record(options, placed, False, shaded))
        acted = {name: rendering[name] for name in ("hogels", "size", "shading", "shadow-map") if name in rendering}
        acted.update(record_of(placed))
        acted.pop("background", None)  # what no surface sends out is not seen
        acted.update(
            wavelength="rgb" if wavelength is None else _record.length(wavelength),
            pitch=_record.length(pitch, defaults["pitch"]),
            method=method,
            seed=str(seed),
        )
        if known[method][0]:
            acted["spacing"] = _record.length(spacing, defaults["spacing"])
        if known[method][1]:
            acted["planes"] = str(number)
        made._made = _record.renamed(acted, "scene", "input")
        made._history = [entry for entry in shaded.metadata if entry[0] != "background"]
    return made
