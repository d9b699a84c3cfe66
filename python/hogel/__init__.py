# SPDX-License-Identifier: Apache-2.0
"""hogel: full-parallax holographic stereograms, from scene to photograph.

>>> import hogel
>>> from hogel import mm, deg, nm
>>> scene = hogel.Scene.load("pumpkin")
>>> lf = scene.render(hogels=(16, 16), directions=(16, 16), size=0.8*mm, fov=16*deg)
>>> holo = lf.hologram(wavelength=633*nm, pitch="1.5625um")
>>> holo.photograph(eye="0,0,300mm", pupil="20mm", resolution=32)
Picture(32x32 pixels, 1 channel)

Lengths are in metres and angles in radians: floats, products with mm, um, nm, deg, or texts such as "16mm". Keyword
arguments are the options of the command line (docs/command-line.md). `python -m hogel` runs the command line.
"""
from __future__ import annotations

import os as _os
from collections.abc import Iterable as _Iterable
from typing import Union as _Union

from . import _core, _progress
from ._core import (
    Camera,
    FieldGrid,
    FocalPlane,
    Frequencies,
    Grid,
    Light,
    LightFieldGrid,
    Material,
    Perspective,
    Plan,
    ThreadLimit,
    __version__,
    parts,
    thread_count,
)
from ._options import add_value_semantics as _add_value_semantics
from .camera import camera
from .errors import BadInputError, CancelledError, CannotWriteError, Error, InternalError, NotBuiltInError, UsageError
from .exports import export_views, film, views_of
from .face import Face
from .field import Field
from .hologram import Hologram
from .light_field import LightField
from .method import hologram_request
from .pattern import Pattern
from .recipe import Made, Photographs, make
from .picture import Picture
from .pose import light
from .requests import request
from .scene import Scene, add_renderer
from .views import import_views, is_view_set, view_layouts, write_cameras
from .units import angle, cm, deg, length, m, mm, nm, rad, um

_add_value_semantics()

__all__ = [
    "BadInputError",
    "Camera",
    "CancelledError",
    "CannotWriteError",
    "Error",
    "Face",
    "Field",
    "FieldGrid",
    "FocalPlane",
    "Frequencies",
    "Grid",
    "Hologram",
    "InternalError",
    "Light",
    "LightField",
    "LightFieldGrid",
    "Made",
    "Material",
    "NotBuiltInError",
    "Pattern",
    "Perspective",
    "Photographs",
    "Picture",
    "Plan",
    "Scene",
    "ThreadLimit",
    "UsageError",
    "__version__",
    "add_renderer",
    "angle",
    "camera",
    "cm",
    "coders",
    "compare",
    "defaults",
    "deg",
    "encodings",
    "export_views",
    "film",
    "hologram_methods",
    "hologram_request",
    "import_views",
    "info",
    "is_view_set",
    "join",
    "length",
    "light",
    "m",
    "make",
    "mm",
    "modulators",
    "nm",
    "open",
    "parts",
    "program",
    "quilt_displays",
    "rad",
    "renderers",
    "request",
    "scene_hologram_methods",
    "scenes",
    "shading_models",
    "show_progress",
    "thread_count",
    "um",
    "view_layouts",
    "views_of",
    "write_cameras",
]

#: Defaults of all options, in metres and radians.
defaults: dict[str, object] = dict(_core.defaults)


def scenes() -> dict[str, str]:
    """Returns the built-in scenes: names and descriptions.

    >>> import hogel
    >>> "pumpkin" in hogel.scenes()
    True
    """
    return dict(_core.scenes())


def renderers() -> list[str]:
    """Returns the names of the renderers, for `algorithm`.

    >>> import hogel
    >>> "epi" in hogel.renderers()
    True
    """
    return _core.renderers()


def shading_models() -> list[str]:
    """Returns the names of the shading models, for `shading`.

    >>> import hogel
    >>> "direct" in hogel.shading_models()
    True
    """
    return _core.shading_models()


def hologram_methods() -> list[str]:
    """Returns the names of the methods that compute holograms of light fields, for `method`.

    >>> import hogel
    >>> "fourier" in hogel.hologram_methods()
    True
    """
    return _core.hologram_methods()


def scene_hologram_methods() -> dict[str, str]:
    """Returns the methods of Scene.hologram(), which need no light field: names and descriptions.

    >>> import hogel
    >>> "points" in hogel.scene_hologram_methods()
    True
    """
    return dict(_core.scene_hologram_methods())


def encodings() -> list[str]:
    """Returns the names of the encodings of fields for modulators, for `encoding`.

    >>> import hogel
    >>> "double-phase" in hogel.encodings()
    True
    """
    return _core.encodings()


def modulators() -> list[str]:
    """Returns the names of modulators with a profile, and their other names, for `device`.

    >>> import hogel
    >>> "leto" in hogel.modulators()
    True
    """
    return _core.modulators()


def quilt_displays() -> list[str]:
    """Returns the names of displays for quilts, and their other names, for `device` of export().

    >>> import hogel
    >>> "lkg-portrait" in hogel.quilt_displays()
    True
    """
    return _core.quilt_display_names()


def coders() -> list[str]:
    """Returns the names of the coders of compressed light fields, for `coder`.

    >>> import hogel
    >>> "hogel" in hogel.coders()
    True
    """
    return _core.coders()


def show_progress(shown: _Union[bool, None]) -> None:
    """Sets whether long work shows a progress bar: True, False, or None for terminals and notebooks only. The argument
    `progress` of a call overrides this: True, False, or a function of the fraction done, which returns False to stop.

    >>> import hogel
    >>> hogel.show_progress(False)  # from now on no bars
    >>> hogel.show_progress(None)
    """
    _progress.default = shown


def open(path: _Union[str, "_os.PathLike[str]"]) -> _Union[LightField, Hologram, Picture, Scene]:
    """Opens a file as a light field, hologram, picture or scene, according to its contents.

    >>> import hogel, numpy as np, os, tempfile
    >>> path = os.path.join(tempfile.mkdtemp(), "grey.png")
    >>> hogel.Picture(np.full((2, 3, 1), 0.5)).save(path)
    >>> hogel.open(path)
    Picture(3x2 pixels, 1 channel)
    """
    kinds = _core.FileKind
    kind = kinds.light_field if _os.path.isdir(path) else _core.file_kind(_os.fspath(path))
    if kind == kinds.light_field:
        return LightField.open(path)
    if kind == kinds.hologram:
        return Hologram.open(path)
    if kind == kinds.picture:
        return Picture.open(path)
    return Scene.load(path)


def info(path: _Union[str, "_os.PathLike[str]"]) -> dict[str, object]:
    """Returns the output of `hogel info` for a file: facts and provenance as texts, and numbers.

    >>> import hogel, os, tempfile
    >>> lf = hogel.Scene.load("pumpkin").render(hogels=8, directions=8, size="0.4mm")
    >>> path = os.path.join(tempfile.mkdtemp(), "lf.h5")
    >>> lf.save(path)
    >>> hogel.info(path)["hogels_s"]
    8.0
    """
    _, text, numbers = _core.summarize(_os.fspath(path))
    return {**dict(text), **dict(numbers)}


def compare(
    a: _Union[str, "_os.PathLike[str]"], b: _Union[str, "_os.PathLike[str]"], *, exposure: _Union[float, None] = None
) -> dict[str, float]:
    """Compares two pictures, light fields or holograms, as `hogel compare` does. `a` is the reference.

    >>> import hogel, os, tempfile
    >>> lf = hogel.Scene.load("pumpkin").render(hogels=8, directions=8, size="0.4mm")
    >>> folder = tempfile.mkdtemp()
    >>> for name in "a.h5", "b.hgl":
    ...     lf.save(os.path.join(folder, name))
    >>> hogel.compare(os.path.join(folder, "a.h5"), os.path.join(folder, "b.hgl"))["sqnr"] > 35
    True
    """
    truth, other = open(a), open(b)
    if isinstance(truth, Picture) and isinstance(other, Picture):
        factor = min(1.0, truth.exposure("auto")) if exposure is None else float(exposure)
        return truth.compare(other, factor)
    if isinstance(truth, LightField) and isinstance(other, LightField):
        return truth.compare(other)
    if isinstance(truth, Hologram) and isinstance(other, Hologram):
        return truth.compare(other)
    raise BadInputError(f"{a} and {b} are not files of one kind")


def join(
    path: _Union[str, "_os.PathLike[str]"], parts: _Iterable[_Union[str, "_os.PathLike[str]"]], *, progress: _progress.Progress = None
) -> None:
    """Joins the parts of a light field or hologram file, which save(part=...) and `--part` of the command line write. The
    result has the same bytes as a file written at once.

    >>> import hogel, os, tempfile
    >>> folder = tempfile.mkdtemp()
    >>> lf = hogel.Scene.load("pumpkin").render(hogels=4, directions=4)
    >>> parts = [os.path.join(folder, f"part{number}") for number in (1, 2)]
    >>> for number, name in enumerate(parts, 1):
    ...     lf.save(name, part=(number, 2))
    >>> hogel.join(os.path.join(folder, "whole.h5"), parts)
    """
    name = _os.fspath(path)
    _core.require_writable(name)
    _core.require_hdf5(name)
    with _progress.reporting(progress, "joining") as report:
        _core.join_parts(name, [_os.fspath(part) for part in parts], report)


def program() -> str:
    """Returns the path of the command-line program that belongs to this module.

    >>> import hogel
    >>> hogel.program().endswith("hogel")
    True
    """
    from .__main__ import find

    return find()
