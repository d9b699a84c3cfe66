# SPDX-License-Identifier: Apache-2.0
"""What is asked for when a scene is rendered."""
from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, Optional, Union

from . import _core, _record, units
from .errors import usage_error


def request(
    *,
    hogels: Optional[units.Counts] = None,
    directions: Optional[units.Counts] = None,
    size: Optional[units.Length] = None,
    fov: Union[units.Angle, Sequence[units.Angle], None] = None,
    toward: Union[units.Angle, Sequence[units.Angle]] = 0,
    algorithm: Optional[str] = None,
    shading: Optional[str] = None,
    shadow_map: Optional[int] = None,
    cache_spacing: Optional[float] = None,
    samples: units.Counts = 1,
    hemicube: bool = False,
    focal_plane: Optional[units.Length] = None,
    frequencies: Optional[units.Length] = None,
    interpolate: Optional[int] = None,
    cull_back_faces: bool = False,
    front: Optional[float] = None,
    as_is: bool = False,
) -> _core.LightFieldRequest:
    """What `hogel render` asks for, by the names of its options: see Scene.render().

    >>> import hogel
    >>> hogel.request(hogels=(64, 48), directions=16, size="6.4mm").grid.shape
    (3, 48, 64, 16, 16)
    """
    defaults = _core.defaults
    columns, rows = units.counts(defaults["hogels"] if hogels is None else hogels, "hogels")
    across, down = units.counts(defaults["directions"] if directions is None else directions, "directions")
    width = units.optional_length(size, defaults["size"], "size")
    if not (columns > 0 and rows > 0 and width > 0):
        raise usage_error("hogels, size", "positive numbers were expected")
    made = _core.LightFieldRequest()
    if algorithm is not None:
        made.renderer = _known("renderer", "algorithm", algorithm, _core.renderers())
    lighting = _core.ShadingOptions()
    lighting.model = _core.defaults["shading"]
    if shading is not None:
        lighting.model = _known("shading model", "shading", shading, _core.shading_models())
    lighting.shadow_map = defaults["shadow_map"] if shadow_map is None else int(shadow_map)
    made.shading = lighting
    if cache_spacing is not None:
        made.cache_spacing = float(cache_spacing)
    wide, high = (defaults["field_of_view"],) * 2 if fov is None else units.angles(fov, "fov")
    right, up = units.angles(toward, "toward")
    if sum([hemicube, focal_plane is not None, frequencies is not None]) > 1:
        raise usage_error("hemicube, focal_plane, frequencies", "only one of them can be asked for")
    pitch = width / columns
    view: Union[_core.Perspective, _core.Frequencies, _core.FocalPlane]
    if hemicube:
        # The faces of a hemicube have ranges of their own, but for the height of a single row of directions.
        view = _core.field_of_view(defaults["field_of_view"], defaults["field_of_view"], right, up)
    else:
        view = _core.field_of_view(wide, high, right, up)
    if focal_plane is not None:
        view = _core.FocalPlane(units.length(focal_plane, "focal_plane"), view.half_u, view.half_v, view.center_u, view.center_v)
    if frequencies is not None:
        # As many frequencies j/d as fit into the field of view.
        step = units.length(frequencies, "frequencies") / pitch
        across = 2 * math.floor(math.sin(wide / 2) / step + 1e-9) + 1
        down = 2 * math.floor(math.sin(high / 2) / step + 1e-9) + 1
        view = _core.Frequencies(0.5 * across * step, 0.5 * down * step)
    made.grid = _core.LightFieldGrid(columns, rows, pitch, across, down, view)
    _core.validate_light_field(made.grid)
    made.hemicube = bool(hemicube)
    if hemicube and fov is not None:
        made.hemicube_across, made.hemicube_down = wide, high
    made.samples = units.counts(samples, "samples")
    _core.finer(made.grid, *made.samples)
    made.cull_back_faces = bool(cull_back_faces)
    made.interpolate = 0 if interpolate is None else int(interpolate)
    made.fit = not as_is
    if front is not None:
        made.front = float(front)
    made.grids()
    return made


def _known(kind: str, parameter: str, name: str, known: list[str]) -> str:
    if name not in known:
        _core.throw_unknown(kind, name, known, parameter)
    return name


def render_record(wanted: _core.LightFieldRequest, placed: _core.Scene, shaded: _core.ShadedScene, **given: Any) -> _record.Record:
    """The options of request() that act, as `hogel render` says them."""
    defaults = _core.defaults
    hemicube, frequencies = wanted.hemicube, given.get("frequencies")
    acted = {
        "algorithm": wanted.renderer,
        "cull-back-faces": _record.words(wanted.cull_back_faces),
        "hogels": _record.words(given.get("hogels"), (defaults["hogels"],) * 2),
        "samples": _record.words(given.get("samples"), (1, 1)),
        "size": _record.length(given.get("size"), defaults["size"]),
        "fov": _record.angle(given.get("fov"), 180 * units.deg if hemicube else defaults["field_of_view"]),
    }
    if placed.is_lit:
        acted["shading"] = _core.shading_model(placed, wanted.shading)
    if _core.shadow_map_bytes(placed, wanted.shading) > 0:
        acted["shadow-map"] = _record.words(given.get("shadow_map"), defaults["shadow_map"])
    if frequencies is not None:
        acted["frequencies"] = _record.length(frequencies)
    else:
        acted["directions"] = _record.words(given.get("directions"), (defaults["directions"],) * 2)
        if given.get("focal_plane") is None:
            acted["hemicube"] = _record.words(hemicube)
        if not hemicube:
            acted["toward"] = _record.angle(given.get("toward"))
    if given.get("focal_plane") is not None:
        acted["focal-plane"] = _record.length(given["focal_plane"])
    if given.get("interpolate"):
        acted["interpolate"] = _record.words(given["interpolate"])
    if shaded.is_lit:
        acted["cache-spacing"] = _record.words(given.get("cache_spacing"), defaults["cache_spacing"])
    return acted
