# SPDX-License-Identifier: Apache-2.0
"""The whole recipe: from a scene to its hologram and photographs."""
from __future__ import annotations

import os
import warnings
from dataclasses import dataclass
from typing import Any, Optional, Sequence, Union

from . import _core, _record, units
from ._keywords import passes_options_to
from ._progress import Progress, reporting
from .errors import usage_error
from .hologram import Hologram
from .light_field import LightField
from .method import hologram_request
from .photographs import wave_camera
from .picture import Picture
from .requests import request
from .scene import Scene


@dataclass(frozen=True)
class Photographs:
    """The photographs of make() by one camera. Comparisons are those of Picture.compare() with the picture by rays.

    >>> import hogel
    >>> made = hogel.make("sphere", hogels=8, directions=8, size="0.4mm", resolution=16, looks=1)
    >>> made.photographs[0].eye, made.photographs[0].focus, made.photographs[0].rays
    ('left', 'near', Picture(16x16 pixels, 3 channels))
    """

    eye: str
    focus: str
    camera: _core.Camera
    rays: Picture
    #: The mean of the looks; None with looks="expected".
    waves: Optional[Picture]
    waves_comparison: Optional[dict[str, float]]
    #: The mean of infinitely many looks; None where it would take long.
    speckle_free: Optional[Picture]
    speckle_free_comparison: Optional[dict[str, float]]


class Made:
    """What make() has made: the light field, the hologram, and the photographs by each camera with their exposure.

    >>> import hogel
    >>> made = hogel.make("sphere", hogels=8, directions=8, size="0.4mm", resolution=16, looks=1)
    >>> made
    Made(8x8 hogels, 256x256 samples, photographs by 6 cameras)
    """

    def __init__(self, made: _core.Made) -> None:
        self._made = made
        #: The light field, in memory.
        self.light_field = LightField(made.light_field, "in memory")
        #: The hologram, computed when it is read.
        self.hologram = Hologram(list(made.holograms), "computed when read", known=(made.light_field, made.request.hologram))
        #: The factor by which files show all pictures.
        self.exposure: float = made.exposure
        #: The photographs by each camera.
        self.photographs: Sequence[Photographs] = [_photographs(by) for by in made.photographs]

    def save(self, folder: Union[str, "os.PathLike[str]"], *, metadata: Any = None) -> None:
        """Writes all photographs into a folder that exists, under the names of `hogel make`.

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


@passes_options_to(request)
def make(
    scene: Union[str, "os.PathLike[str]", Scene],
    *,
    wavelength: Union[units.Length, Sequence[units.Length], None] = None,
    pitch: Optional[units.Length] = None,
    eye_distance: Optional[units.Length] = None,
    pupil: Optional[units.Length] = None,
    resolution: Optional[int] = None,
    looks: Union[int, str, None] = None,
    pupil_samples: Optional[int] = None,
    camera: str = "auto",
    seed: int = 1,
    progress: Progress = None,
    **options: Any,
) -> Made:
    """Renders a scene, makes its hologram, and photographs it by waves and by rays from three eyes with two focuses, all in
    memory: the pictures of `hogel make`. `scene`: a name, a file, or a Scene; the options are those of `hogel make`, among
    them those of Scene.render().

    eye_distance, pupil, resolution  of the camera: metres, metres, pixels across
    looks          photographs averaged against speckle, enough without; "expected": the mean of infinitely many alone
    pupil_samples  points of the pupil in photographs by rays
    camera         how waves are photographed: see Hologram.photograph()

    >>> import hogel
    >>> made = hogel.make("pumpkin", hogels=8, directions=8, size="0.4mm", resolution=16, looks=2)
    >>> [(by.eye, by.focus) for by in made.photographs][:2]
    [('left', 'near'), ('high', 'near')]
    >>> made.photographs[0].speckle_free_comparison["psnr"] > made.photographs[0].waves_comparison["psnr"]
    True
    """
    defaults = _core.defaults
    wanted = _core.MakeRequest()
    wanted.light_field = request(**options)
    expected = looks == "expected"
    if isinstance(looks, str) and not expected:
        raise usage_error("looks", f"a number of pictures or expected was expected, not '{looks}'")
    count = 0 if looks is None else 1 if expected else int(looks)
    if looks is not None and count < 1:
        raise usage_error("looks", "a positive number was expected")
    wanted.hologram = hologram_request(wavelength=wavelength, pitch=pitch, looks=count, seed=seed)
    wanted.adapt_pitch = pitch is None
    wanted.camera = wave_camera(camera, expected)
    wanted.eye_distance = units.optional_length(eye_distance, defaults["eye_distance"], "eye_distance")
    wanted.pupil = units.optional_length(pupil, defaults["pupil"], "pupil")
    wanted.resolution = defaults["resolution"] if resolution is None else int(resolution)
    wanted.pupil_samples = defaults["pupil_samples"] if pupil_samples is None else int(pupil_samples)
    placed = (scene if isinstance(scene, Scene) else Scene.load(scene)).placed(wanted.light_field, progress)
    with reporting(progress, "make") as report:
        made = _core.make(placed, wanted, report)
    if made.request.hologram.pitch != wanted.hologram.pitch:
        taken, usual = units.say_length(made.request.hologram.pitch), units.say_length(wanted.hologram.pitch)
        warnings.warn(f"pitch: {taken}, which diffracts the field of view; {usual}, the default, does not", stacklevel=3)
    return Made(made)
