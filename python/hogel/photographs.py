# SPDX-License-Identifier: Apache-2.0
"""Photographs of fields by waves."""
from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Optional

import numpy as np

from . import _core, _record, units
from ._keywords import passes_options_to
from ._progress import Progress, reporting
from .camera import camera as camera_of
from .camera import camera_record
from .errors import BadInputError, UsageError, usage_error
from .picture import Picture

#: The names of the library's camera models, beside the shorter ones.
_CAMERA_MODELS = {"hogel-spectra": "eye", "samples": "narrow", "plane-waves": "full"}


def wave_camera(
    name: str, expected: bool = False, diffuser: str = "none", film_distance: float = 0, preview: bool = False
) -> Any:
    """The library's model of a camera by its name, see Hologram.photograph()."""
    name = _CAMERA_MODELS.get(name, name)
    if name not in ("auto", "eye", "narrow", "full"):
        raise usage_error("camera", f"auto, eye, narrow or full were expected, not '{name}'")
    if diffuser not in ("none", "vertical"):
        raise usage_error("diffuser", f"none or vertical were expected, not '{diffuser}'")
    if film_distance != 0 and name != "full":
        raise usage_error("film_distance", "the thin lens belongs to the full camera; add camera='full'")
    if name == "full":
        if expected or preview or diffuser != "none":
            raise usage_error("expected, preview, diffuser", "are not for the full camera")
        return _core.PlaneWaveCamera(film_distance=film_distance)
    if preview and (expected or name == "narrow"):
        raise usage_error("preview", "is for a number of looks and the eye camera")
    if expected:
        if diffuser != "none":
            raise usage_error("expected", "the mean of infinitely many looks is not known behind a diffuser")
        return _core.SpeckleFreeCamera()
    model = _core.BandCamera()
    model.preview = preview
    sources = {"eye": _core.BandSource.hogel_spectra, "narrow": _core.BandSource.samples}
    model.source = sources.get(name, _core.BandSource.automatic)
    model.vertical_diffuser = diffuser == "vertical"
    return model


@passes_options_to(camera_of)
def photograph_fields(
    fields: list[_core.FieldSource],
    known: Any,
    made: Optional[_record.Record],
    *,
    cameras: Optional[Sequence[_core.Camera]] = None,
    camera: str = "auto",
    expected: bool = False,
    diffuser: str = "none",
    film_distance: units.Length = 0,
    preview: bool = False,
    progress: Progress = None,
    **options: Any,
) -> Any:
    """See Hologram.photograph(). `known`: the light field and the request of which the fields are computed; `made`: the
    options of the command line that made them, both if there are any."""
    if len(fields) not in (1, 3):
        raise UsageError(f"photograph: a photograph takes one or three wavelengths, not {len(fields)}")
    plane = fields[0].grid.plane
    views = [camera_of(plane.size_x, plane.size_y, **options)] if cameras is None else list(cameras)
    camera = _CAMERA_MODELS.get(camera, camera)
    how = wave_camera(camera, expected, diffuser, units.length(film_distance, "film_distance"), preview)
    if preview and known is None:
        raise usage_error("preview", "leaves out waves of hogels; of a hologram in a file or memory only samples are known")
    for field in fields:
        for view in views:
            _core.require_light_towards(field.grid, view, diffuser == "vertical")
    with reporting(progress, "wave photograph") as report:
        images = _core.photograph_colours(fields, views, how, report)
    pictures = [Picture(image) for image in images]
    if not any(np.asarray(picture).any() for picture in pictures):
        raise BadInputError("hologram: is empty; no light comes from it to the eye")
    if made is not None and cameras is None:
        acted = {**_acted(known, made, views, camera, expected, diffuser, film_distance), **camera_record(**options)}
        acted["preview"] = "yes" if preview else ""
        pictures[0]._made = ("photo", {name: text for name, text in {**made, **acted}.items() if text})
    return pictures[0] if cameras is None else pictures


def _acted(
    known: Any, made: _record.Record, views: Any, camera: str, expected: bool, diffuser: str, film_distance: Any
) -> _record.Record:
    """The options of photograph_fields() that act beside those of its camera."""
    acted = {"display": "intensity", "camera": camera}
    if camera == "full":
        acted["film-distance"] = _record.length(film_distance)
    if known is None:
        if camera == "auto":
            acted["camera"] = "narrow"
        if camera != "full":
            acted["diffuser"] = diffuser
        return acted
    light_field, wanted = known
    acted["wave"] = "yes"
    if camera != "full":
        how = wave_camera(camera, expected, diffuser)
        chosen, _ = _core.choose_band_source(light_field, wanted, views, how)
        acted["camera"] = "eye" if chosen == _core.BandSource.hogel_spectra else "narrow"
    if "seed" in made:
        acted["looks"] = "expected" if expected else str(wanted.looks)
    if expected:
        acted["seed"] = ""
    return acted
