# SPDX-License-Identifier: Apache-2.0
"""Sets of views: light fields of other programs."""
from __future__ import annotations

import os
from typing import Any, Optional

from . import _core
from ._keywords import takes
from ._progress import Progress, reporting
from ._samples import Path
from .errors import UsageError
from .light_field import LightField


def view_layouts() -> dict[str, str]:
    """Returns the layouts of sets of views, for `layout`: names and descriptions.

    >>> import hogel
    >>> "rows-columns" in hogel.view_layouts()
    True
    """
    return {name: text for name, text, _, _ in _core.view_layouts()}


def is_view_set(source: Path) -> bool:
    """Returns whether a folder or file is a set of views in a known layout.

    >>> import hogel, tempfile
    >>> hogel.is_view_set(tempfile.mkdtemp())
    False
    """
    return _core.is_view_set(os.fspath(source))


@takes(_core.import_keywords())
def import_views(source: Path, *, spool: Optional[Path] = None, progress: Progress = None, **options: Any) -> LightField:
    """Imports a set of views, a folder or a file, as a light field. The options are those of `hogel import`. `spool` is a
    folder for a temporary file if the set does not fit into memory. `views_of(light_field)` returns facts about the set.

    >>> import hogel, os, tempfile
    >>> lf = hogel.Scene.load("pumpkin").render(hogels=8, directions=3, size="4mm", focal_plane="-300mm")
    >>> views = os.path.join(tempfile.mkdtemp(), "views")
    >>> made = lf.export(views)
    >>> hogel.import_views(views, size="4mm").shape
    (3, 8, 8, 3, 3)
    """
    name = os.fspath(source)
    import_options = _core.import_options(options, os.fspath(spool or ""))
    with reporting(progress, "looking at the views") as report:
        imported = _core.import_views(name, import_options, report)
    light_field = LightField(imported.light_field, name, {"source": name, **dict(_core.import_record(options, imported))})
    light_field._views = imported
    return light_field


@takes(_core.cameras_keywords())
def write_cameras(path: Path, **options: Any) -> list[str]:
    """Writes the cameras of a light field of this sampling as transforms.json, as `hogel cameras` does. Returns notes for
    users of the cameras.

    >>> import hogel, os, tempfile
    >>> path = os.path.join(tempfile.mkdtemp(), "cameras.json")
    >>> said = hogel.write_cameras(path, hogels=(80, 60), directions=5, size="100mm")
    >>> os.path.exists(path)
    True
    """
    name = os.fspath(path)
    if os.path.splitext(name)[1] != ".json":
        raise UsageError(f"{name}: expected a name that ends in .json")
    _core.require_writable(name)
    return list(_core.write_cameras(_core.cameras_grid(options), name))
