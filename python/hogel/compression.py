# SPDX-License-Identifier: Apache-2.0
"""Compressed light fields."""
from __future__ import annotations

import os
from typing import Any, Optional

from . import _core, _record, units
from ._progress import Progress, reporting
from ._rays import Rays
from ._samples import Path, choice
from .errors import usage_error


def compress(
    self: Rays,
    path: Path,
    *,
    sqnr: Optional[float] = None,
    ppb: Optional[float] = None,
    rule: str = "search",
    overhead: Optional[float] = None,
    step: Optional[float] = None,
    max_error: Optional[float] = None,
    lossless: bool = False,
    coder: str = "hogel",
    transform: str = "",
    table: str = "own",
    symbols: str = "bits",
    hemicube: str = "faces",
    no_depth: bool = False,
    depth_error: Optional[units.Length] = None,
    tone: str = "none",
    tone_decades: Optional[float] = None,
    chrominance: float = 1,
    tile: Optional[units.Counts] = None,
    metadata: Any = None,
    progress: Progress = None,
) -> dict[str, Any]:
    """Writes a compressed light field, .hgl, as `hogel compress` does. One of sqnr (decibels), ppb (rays a bit), step,
    max_error (radiance) and lossless=True says how well; without one it is 40 dB. Returns bytes, sqnr, pixels_per_bit,
    step, passes, depth_bytes and depth_error of the file.

    >>> import hogel, os, tempfile
    >>> lf = hogel.Scene.load("pumpkin").render(hogels=8, directions=8, size="0.4mm")
    >>> made = lf.compress(os.path.join(tempfile.mkdtemp(), "lf.hgl"), sqnr=35)
    >>> made["sqnr"] > 34, made["bytes"] > 0
    (True, True)
    """
    name = os.fspath(path)
    _core.require_writable(name)
    _core.require_name(name, "hgl")
    options = _core.CompressionOptions()
    options.target = _target(sqnr, ppb, rule, overhead, step, max_error, lossless)
    method = _core.CodingMethod()
    method.coder, method.transform = coder, transform
    method.table = choice(_core.QuantisationTable, table, "table")
    method.symbols = choice(_core.ZerotreeSymbols, symbols, "symbols")
    options.method = method
    if hemicube == "unfolded":
        options.layout = _core.StreamLayout.unfolded
    elif hemicube != "faces":
        raise usage_error("hemicube", f"faces or unfolded were expected, not '{hemicube}'")
    options.with_depth = self.has_depth and not no_depth
    if depth_error is not None:
        if not options.with_depth:
            raise usage_error("depth_error", "there is no depth to keep")
        options.depth_error = units.length(depth_error, "depth_error")
    if tone == "histogram":
        options.tone_decades = _core.defaults["tone_decades"] if tone_decades is None else tone_decades
    elif tone != "none" or tone_decades is not None:
        raise usage_error("tone, tone_decades", "none or histogram were expected, and decades with histogram alone")
    options.chrominance = chrominance
    if tile is not None:
        options.tile = units.counts(tile, "tile")
    if metadata is None:
        if self._made is None or "input" not in self._made:
            metadata = _record.by_function("LightField.compress")
        else:
            acted = _acted(options, sqnr, ppb, rule, overhead, step, max_error, lossless, depth_error, tone, tile)
            if self._light_field.has_sides():
                acted["hemicube"] = hemicube
            if self.has_depth:
                acted["no-depth"] = _record.words(no_depth)
            metadata = _record.entries("compress", {**self._made, **acted})
    options.metadata = metadata
    prepared = self._prepared(2, options.with_depth, progress)
    with reporting(progress, "compressing") as report:
        return _core.compress(prepared, name, options, report)


def _acted(
    options: _core.CompressionOptions,
    sqnr: Optional[float],
    ppb: Optional[float],
    rule: str,
    overhead: Optional[float],
    step: Optional[float],
    max_error: Optional[float],
    lossless: bool,
    depth_error: Any,
    tone: str,
    tile: Any,
) -> _record.Record:
    """The options that acted, but for those of hemicubes and of depth."""
    method = options.method
    facts = _core.coder_info(method.coder)
    acted = {"coder": method.coder}
    if max_error is None and not lossless:
        acted.update(chrominance=_record.number(options.chrominance), tone=tone)
    if ppb is not None:
        acted["ppb"] = _record.number(ppb)
    elif step is not None:
        acted["step"] = _record.number(step)
    elif max_error is not None:
        acted["max-error"] = _record.number(max_error)
    elif lossless:
        acted["lossless"] = "yes"
    else:
        acted["sqnr"] = _record.number(_core.defaults["sqnr"] if sqnr is None else sqnr)
    if facts["transform"]:
        acted["transform"] = method.transform or facts["transform"]
    if facts["quantisation_table"]:
        acted["table"] = method.table.name
    if facts["three_pass"]:
        acted["symbols"] = method.symbols.name
        if ppb is not None:
            acted["rule"] = rule
    if ppb is not None and rule != "search":
        acted["overhead"] = _record.number(_core.default_overhead(method.symbols) if overhead is None else overhead)
    if options.with_depth and depth_error is not None:
        acted["depth-error"] = _record.length(depth_error)
    if options.tone_decades is not None:
        acted["tone-decades"] = _record.number(options.tone_decades)
    if tile is not None:
        acted["tile"] = _record.words(tile)
    return acted


def _target(
    sqnr: Optional[float],
    ppb: Optional[float],
    rule: str,
    overhead: Optional[float],
    step: Optional[float],
    max_error: Optional[float],
    lossless: bool,
) -> Any:
    given = [value for value in (sqnr, ppb, step, max_error) if value is not None]
    if len(given) + bool(lossless) > 1:
        raise usage_error("sqnr, ppb, step, max_error, lossless", "only one of them can be asked for")
    if ppb is None and (rule != "search" or overhead is not None):
        raise usage_error("rule, overhead", "belong to ppb")
    if ppb is not None:
        return _core.PixelsPerBit(ppb, choice(_core.RateRule, rule, "rule"), overhead)
    if step is not None:
        return _core.Step(step)
    if max_error is not None:
        return _core.MaxError(max_error)
    if lossless:
        return _core.Lossless()
    return _core.Sqnr(_core.defaults["sqnr"] if sqnr is None else sqnr)
