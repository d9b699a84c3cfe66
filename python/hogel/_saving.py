# SPDX-License-Identifier: Apache-2.0
"""Writes light fields to files."""
from __future__ import annotations

import os
from typing import Any, Optional

from . import _core, _record
from ._progress import Progress, reporting
from ._rays import Rays
from ._samples import Path
from .errors import usage_error


def save_light_field(
    light_field: Rays,
    path: Path,
    single: bool,
    half: bool,
    depth: bool,
    sqnr: Optional[float],
    resume: bool,
    part: Optional[tuple[int, int]],
    metadata: Any,
    progress: Progress,
) -> None:
    """See LightField.save()."""
    name, made = os.fspath(path), light_field._made
    _core.require_writable(name)
    rendered = made is not None and "scene" in made
    imported = made is not None and "source" in made
    stored = made is not None and "input" in made and ".hgl" in light_field.where
    command = "render" if rendered else "import" if imported else "decompress" if stored else ""
    acted = dict(made or {})
    if rendered or (imported and depth):
        acted["depth"] = _record.yes_or_no(depth)
    if os.path.splitext(name)[1] == ".hgl":
        if single or resume or part:
            raise usage_error("float" if single else "resume" if resume else "part", f"applies to HDF5 files; {name} is a compressed one")
        options = _core.CompressionOptions()
        ratio = _core.defaults["sqnr"] if sqnr is None else sqnr
        options.target = _core.Sqnr(ratio)
        options.with_depth = depth
        acted["sqnr"] = _record.number(ratio)
        entries = _record.entries(command, acted) if command in ("render", "import") else _record.by_function("LightField.save")
        options.metadata = entries if metadata is None else metadata
        prepared = light_field._prepared(2, depth, progress)
        with reporting(progress, "compressing") as report:
            _core.compress(prepared, name, options, report)
        return
    if sqnr is not None:
        raise usage_error("sqnr", f"applies to compressed files (.hgl), not to {name}")
    if part is None:
        _core.require_hdf5(name)
    if stored:
        # Samples of exact coders are not rounded to half floats.
        exact = _core.read_stream_info(light_field.where)["coder"] in ("lossless", "bounded")
        single = single or (exact and not half)
        depth = light_field.has_depth
        acted["float" if single else "half"] = "yes"
    elif half and single:
        raise usage_error("float, half", "give only one of them")
    else:
        acted["float"] = _record.yes_or_no(single)
    if metadata is None:
        metadata = _record.entries(command, acted) if command else _record.by_function("LightField.save")
    with reporting(progress, "writing") as report:
        if imported:
            _core.write_views(name, light_field._light_field, single, depth, metadata, report)
            return
        identity = None
        if part is not None:
            if resume:
                raise usage_error("part, resume", "give only one of them")
            file_part = _core.FilePart(int(part[0]), int(part[1]), light_field._identity or "")
            _core.write_light_field_part(name, light_field._light_field, single, depth, metadata, file_part, report)
            return
        if resume:
            identity = light_field._identity or (_core.describe_input(light_field.where) if made is not None else None)
            if identity is None:
                raise usage_error("resume", "work on arrays or functions cannot be resumed")
        _core.write_light_field(name, light_field._light_field, single, depth, metadata, identity, report)
