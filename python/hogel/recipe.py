# SPDX-License-Identifier: Apache-2.0
"""All steps from a scene to its hologram and photographs."""
from __future__ import annotations

import os
import warnings
from dataclasses import dataclass
from typing import Any, Optional, Sequence, Union

from . import _core, _record
from ._keywords import takes
from ._progress import Progress, reporting
from .hologram import Hologram
from .light_field import LightField
from .picture import Picture
from .scene import Scene


@dataclass(frozen=True)
class Photographs:
    """Photographs of make() with one camera. Comparisons are results of Picture.compare() with the picture by rays.

    >>> import hogel
    >>> made = hogel.make("sphere", hogels=8, directions=8, size="0.4mm", resolution=16, looks=1)
    >>> made.photographs[0].eye, made.photographs[0].focus, made.photographs[0].rays
    ('left', 'near', Picture(16x16 pixels, 3 channels))
    """

    eye: str
    focus: str
    camera: _core.Camera
    rays: Picture
    #: Mean of the looks; None with looks="expected".
    waves: Optional[Picture]
    waves_comparison: Optional[dict[str, float]]
    #: Speckle-free: mean of infinitely many looks; None if it would take long.
    speckle_free: Optional[Picture]
    speckle_free_comparison: Optional[dict[str, float]]


class Made:
    """Result of make(): the light field, the hologram, and the photographs of each camera with their exposure.

    >>> import hogel
    >>> made = hogel.make("sphere", hogels=8, directions=8, size="0.4mm", resolution=16, looks=1)
    >>> made
    Made(8x8 hogels, 256x256 samples, photographs by 6 cameras)
    """

    def __init__(self, made: _core.Made) -> None:
        self._made = made
        #: Light field, in memory.
        self.light_field = LightField(made.light_field, "in memory")
        #: Hologram, computed on demand.
        self.hologram = Hologram(list(made.holograms), "computed when read", known=(made.light_field, made.request.hologram))
        #: Exposure of all picture files.
        self.exposure: float = made.exposure
        #: Photographs of each camera.
        self.photographs: Sequence[Photographs] = [_photographs(by) for by in made.photographs]

    def save(self, folder: Union[str, "os.PathLike[str]"], *, metadata: Any = None) -> None:
        """Writes all photographs to an existing folder, with the file names of `hogel make`.

        >>> import hogel, os, tempfile
        >>> folder = tempfile.mkdtemp()
        >>> hogel.make("sphere", hogels=8, directions=8, size="0.4mm", resolution=16, looks="expected").save(folder)
        >>> len(os.listdir(folder)), "photo_left_near_expected.png" in os.listdir(folder)
        (24, True)
        """
        entries = _record.by_function("make") if metadata is None else metadata
        _core.write_photographs(os.fspath(folder), self._made, entries)

    def __repr__(self) -> str:
        grid, plane = self.light_field.grid, self.hologram.grid
        return (
            f"Made({grid.hogels_s}x{grid.hogels_t} hogels, {plane.width}x{plane.height} samples, "
            f"photographs by {len(self.photographs)} camera{'' if len(self.photographs) == 1 else 's'})"
        )


def _photographs(by: _core.MadePhotographs) -> Photographs:
    return Photographs(
        by.camera.eye_name,
        by.camera.focus_name,
        by.camera.camera,
        Picture(by.rays),
        *_compared(by.waves),
        *_compared(by.speckle_free),
    )


def _compared(made: Optional[_core.ComparedImage]) -> tuple[Optional[Picture], Optional[dict[str, float]]]:
    return (None, None) if made is None else (Picture(made.image), made.comparison)


@takes(_core.make_keywords())
def make(scene: Union[str, "os.PathLike[str]", Scene], *, progress: Progress = None, **options: Any) -> Made:
    """Renders a scene, computes its hologram, and photographs it by waves and by rays from three viewpoints with two focus
    depths, all in memory: the pictures of `hogel make`. `scene`: a name, a file, or a Scene. The options are those of `hogel
    make`, which include those of Scene.render().

    >>> import hogel
    >>> made = hogel.make("pumpkin", hogels=8, directions=8, size="0.4mm", resolution=16, looks=2)
    >>> [(by.eye, by.focus) for by in made.photographs][:2]
    [('left', 'near'), ('high', 'near')]
    >>> made.photographs[0].speckle_free_comparison["psnr"] > made.photographs[0].waves_comparison["psnr"]
    True
    """
    wanted = _core.make_request(options)
    placed = (scene if isinstance(scene, Scene) else Scene.load(scene)).placed(wanted.light_field, progress)
    with reporting(progress, "make") as report:
        made = _core.make(placed, wanted, report)
    if note := _core.make_note_about_pitch(options, made.request):
        warnings.warn(note, stacklevel=3)
    return Made(made)
