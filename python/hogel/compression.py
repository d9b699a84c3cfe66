# SPDX-License-Identifier: Apache-2.0
"""Compressed light fields."""
from __future__ import annotations

import os
from typing import Any

from . import _core, _record
from ._keywords import takes
from ._progress import Progress, reporting
from ._rays import Rays
from ._samples import Path


@takes(_core.compression_keywords())
def compress(self: Rays, path: Path, *, metadata: Any = None, progress: Progress = None, **options: Any) -> dict[str, Any]:
    """Writes a compressed light field, .hgl, as `hogel compress` does. The target is one of sqnr (decibels), ppb (rays per
    bit), step, max_error (radiance) and lossless=True; default: 40 dB. Returns bytes, sqnr, pixels_per_bit, step, passes,
    depth_bytes and depth_error of the file.

    >>> import hogel, os, tempfile
    >>> lf = hogel.Scene.load("pumpkin").render(hogels=8, directions=8, size="0.4mm")
    >>> made = lf.compress(os.path.join(tempfile.mkdtemp(), "lf.hgl"), sqnr=35)
    >>> made["sqnr"] > 34, made["bytes"] > 0
    (True, True)
    """
    name = os.fspath(path)
    _core.require_writable(name)
    _core.require_name(name, "hgl")
    request = _core.compression_options(options, self._light_field)
    if metadata is None and self._made is not None and "input" in self._made:
        record = dict(_core.compression_record(options, self._light_field))
        metadata = _record.entries("compress", {**self._made, **record})
    request.metadata = _record.by_function("LightField.compress") if metadata is None else metadata
    prepared = self._prepared(2, request.with_depth, progress)
    with reporting(progress, "compressing") as report:
        return _core.compress(prepared, name, request, report)
