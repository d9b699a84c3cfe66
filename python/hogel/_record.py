# SPDX-License-Identifier: Apache-2.0
"""What a file says of the request that made it: the same as the command line's (apps/cli/run_record.h), with the options
that acted, by their names there, in the order in which the command declares them."""
from __future__ import annotations

from collections.abc import Iterable
from typing import Any, Optional

from . import _core, units

Record = dict[str, str]

_SCENE = "up rotate scene-camera scale move colour texture light background ground point-size"
_RENDER = (
    "algorithm shading shadow-map cache-spacing cull-back-faces hogels directions samples size fov toward front as-is "
    + _SCENE + " region hemicube focal-plane frequencies interpolate"
)
_HOLOGRAM = "wavelength pitch line-pitch method phase lobes basis tolerance"
_FIELD = "values phase-code imaginary phases zero variable conjugate order aperture reference-source reconstruct focal"
_ORDERS = {
    "render": "scene depth float sqnr " + _RENDER,
    "compress": "input sqnr ppb rule overhead step max-error lossless coder transform table symbols hemicube no-depth "
    "depth-error tone tone-decades chrominance tile",
    "decompress": "input layers float half",
    "hologram": "input half " + _HOLOGRAM + " spacing planes " + _RENDER,
    "photo": "input eye gaze focus focus-tilt pupil f-number focal-length angle-of-view resolution to-eye to-focus frames "
    "frame-rate looks exposure display camera film-distance diffuser geometric wave pupil-samples "
    + _HOLOGRAM + " " + _RENDER + " " + _FIELD,
    "propagate": "input distance display output-pitch output-samples offset-x offset-y pitch wavelength " + _FIELD,
    "slm": "input encoding reference clip window iterations device pixels pixel-pitch levels phase-code pitch wavelength "
    + _FIELD.replace("phase-code", "input-phase-code"),
    "print": "input strips order exposure",
    "bake": "scene rays bounces tessellate size " + _SCENE,
    "export": "input layout exposure frame-rate",
    "import": "source depth float sqnr layout views middle column mirror projection transfer size distance spacing fov "
    "disparity densify depth-scale estimate-disparity",
}
#: The commands whose files say what made them.
commands = list(_ORDERS)


def entries(command: str, record: Record) -> list[tuple[str, str]]:
    """The version, the command and the options that acted, as pairs."""
    order = dict.fromkeys(("seed " + _ORDERS[command]).split())
    made = [("software", f"hogel {_core.__version__}"), ("command", f"hogel {command}")]
    return made + [(f"option {name}", record[name]) for name in order if record.get(name)]


def by_function(name: str) -> list[tuple[str, str]]:
    """What is said where no command does the same."""
    return [("software", f"hogel {_core.__version__}"), ("command", f"hogel.{name}")]


def words(value: Any, otherwise: Any = "") -> str:
    """A text as it was written; the default for None; a pair or a number of counts."""
    value = otherwise if value is None else value
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, str):
        return value
    if isinstance(value, Iterable):
        return "x".join(str(int(part)) for part in value)
    return number(value)


def number(value: float) -> str:
    """The shortest digits that give the number again."""
    return str(int(value)) if value == int(value) and abs(value) < 1e15 else repr(float(value))


def length(value: Any, otherwise: Any = 0.0) -> str:
    """A length, or several or the components of a point, with its unit."""
    value = otherwise if value is None else value
    if isinstance(value, str):
        return value
    if isinstance(value, Iterable):
        parts = [units.length(part) for part in value]
        largest = max([0.0, *(abs(part) for part in parts)])
        unit = "mm" if largest >= 1e-3 or largest == 0 else "um" if largest >= 1e-5 else "nm"
        scale = {"mm": 1e-3, "um": 1e-6, "nm": 1e-9}[unit]
        return ",".join(f"{part / scale:.10g}" for part in parts) + unit
    return _core.length_text(value)


def angle(value: Any, otherwise: Any = 0.0) -> str:
    """An angle, or two, with its unit."""
    value = otherwise if value is None else value
    if isinstance(value, str):
        return value
    parts = [units.angle(part) for part in value] if isinstance(value, Iterable) else [value]
    texts = [f"{part / units.deg:.6g}" for part in parts]
    return (texts[0] if len(set(texts)) == 1 else ",".join(texts)) + "deg"


def renamed(record: Optional[Record], before: str, after: str) -> Record:
    """The record of a command for another, whose input has another name."""
    return {after if name == before else name: text for name, text in (record or {}).items()}
