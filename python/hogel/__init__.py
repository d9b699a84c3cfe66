# SPDX-License-Identifier: Apache-2.0
"""hogel: full-parallax holographic stereograms, from scene to photograph.

>>> import hogel
>>> from hogel import mm, deg, nm
>>> scene = hogel.Scene.load("pumpkin")
>>> lf = scene.render(hogels=(16, 16), directions=(16, 16), size=0.8*mm, fov=16*deg)
>>> holo = lf.hologram(wavelength=633*nm, pitch="1.5625um")
>>> holo.photograph(eye="0,0,300mm", pupil="20mm", resolution=32)
Picture(32x32 pixels, 1 channel)

Lengths are metres and angles radians: floats, products with mm, um, nm, deg, or texts such as "16mm". Keywords are the
options of the command line (docs/command-line.md), which `python -m hogel` runs.
"""
from __future__ import annotations

import os as _os
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
    ThreadLimit,
    __version__,
    parts,
    thread_count,
)
from .camera import camera
from .errors import BadInputError, CancelledError, CannotWriteError, Error, InternalError, NotBuiltInError, UsageError
from .hologram import Field, Hologram, hologram_request
from .light_field import Face, LightField
from .pattern import Pattern
from .picture import Picture
from .scene import Scene, light, request
from .units import angle, cm, deg, length, m, mm, nm, rad, um


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
    "Material",
    "NotBuiltInError",
    "Pattern",
    "Perspective",
    "Picture",
    "Scene",
    "ThreadLimit",
    "UsageError",
    "__version__",
    "angle",
    "camera",
    "cm",
    "coders",
    "deg",
    "defaults",
    "encodings",
    "hologram_methods",
    "hologram_request",
    "length",
    "light",
    "m",
    "mm",
    "modulators",
    "nm",
    "open",
    "parts",
    "program",
    "rad",
    "renderers",
    "request",
    "scenes",
    "shading_models",
    "show_progress",
    "thread_count",
    "um",
]

#: The defaults of all options, in metres and radians.
defaults: dict[str, object] = dict(_core.defaults)


def scenes() -> dict[str, str]:
    """The built-in scenes: names, and a line about each."""
    return dict(_core.scenes())


def renderers() -> list[str]:
    """The names of the renderers, of `algorithm`."""
    return _core.renderers()


def shading_models() -> list[str]:
    """The names of the shading models, of `shading`."""
    return _core.shading_models()


def hologram_methods() -> list[str]:
    """The names of the methods by which a light field becomes fringes, of `method`."""
    return _core.hologram_methods()


def encodings() -> list[str]:
    """The names of the ways to show a field by a modulator, of `encoding`."""
    return _core.encodings()


def modulators() -> list[str]:
    """The names of common modulators, of `device`."""
    return _core.modulators()


def coders() -> list[str]:
    """The names of the coders of compressed light fields, of `coder`."""
    return _core.coders()


def show_progress(shown: _Union[bool, None]) -> None:
    """Whether long work shows a bar: True, False, or None, in terminals and notebooks alone. Each call can say otherwise
    with progress=True, False, or a function of the fraction done, which stops the work by returning False."""
    _progress.default = shown


def open(path: _Union[str, "_os.PathLike[str]"]) -> _Union[LightField, Hologram, Picture, Scene]:
    """The light field, hologram, picture or scene of a file, whichever it holds."""
    kinds = _core.FileKind
    kind = kinds.light_field if _os.path.isdir(path) else _core.file_kind(_os.fspath(path))
    if kind == kinds.light_field:
        return LightField.open(path)
    if kind == kinds.hologram:
        return Hologram.open(path)
    if kind == kinds.picture:
        return Picture.open(path)
    return Scene.load(path)


def program() -> str:
    """The path of the command-line program that belongs to this module."""
    from .__main__ import find

    return find()
