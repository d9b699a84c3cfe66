# SPDX-License-Identifier: Apache-2.0
"""Pictures in linear light."""
from __future__ import annotations

import os
from typing import Any, Optional, Union

import numpy as np

from . import _core, _record

Exposure = Union[str, float]


class Picture:
    """Picture in linear light, with one or three channels. `np.asarray(picture)` is its memory, [y][x][c].

    >>> import hogel, numpy as np
    >>> grey = hogel.Picture(np.full((2, 3), 0.5))
    >>> grey
    Picture(3x2 pixels, 1 channel)
    >>> np.asarray(grey).shape
    (2, 3, 1)
    """

    def __init__(self, pixels: Any) -> None:
        self._made: Optional[tuple[str, _record.Record]] = None  # equivalent command and its options
        if isinstance(pixels, _core.Image):
            self._image = pixels
        else:
            array = np.asarray(pixels, dtype=np.float32)
            self._image = _core.Image(array[..., None] if array.ndim == 2 else array)

    @classmethod
    def open(cls, path: Union[str, os.PathLike[str]]) -> "Picture":
        """Reads a PNG, JPEG, EXR, BMP, TGA, GIF, HDR, PNM or PFM file. Integer samples are interpreted as sRGB.

        >>> import hogel, numpy as np, os, tempfile
        >>> path = os.path.join(tempfile.mkdtemp(), "grey.png")
        >>> hogel.Picture(np.full((2, 3, 1), 0.5)).save(path, exposure=1)
        >>> round(float(np.asarray(hogel.Picture.open(path))[0, 0, 0]), 2)
        0.5
        """
        return cls(_core.read_image(os.fspath(path)))

    @property
    def width(self) -> int:
        """Width in pixels."""
        return self._image.width

    @property
    def height(self) -> int:
        """Height in pixels."""
        return self._image.height

    @property
    def channels(self) -> int:
        """Number of channels: 1, or 3 for R, G, B."""
        return self._image.channels

    @property
    def pixels(self) -> "np.ndarray[Any, Any]":
        """Memory of the picture, [y][x][c], linear."""
        return self._image.pixels

    @property
    def metadata(self) -> dict[str, str]:
        """Provenance of the picture."""
        return dict(self._image.metadata)

    @property
    def camera(self) -> Optional[_core.Camera]:
        """Camera that took the picture; None if unknown."""
        return self._image.camera

    def __array__(self, dtype: Any = None) -> "np.ndarray[Any, Any]":
        return self.pixels if dtype is None else self.pixels.astype(dtype, copy=False)

    def exposure(self, exposure: Exposure = "auto") -> float:
        """Returns the factor of linear values for an exposure; "auto": the brightest parts become white.

        >>> import hogel, numpy as np
        >>> hogel.Picture(np.full((2, 3, 1), 0.5)).exposure(2)
        2.0
        """
        return _core.automatic_exposure(self._image) if exposure == "auto" else float(exposure)

    def save(self, path: Union[str, os.PathLike[str]], *, exposure: Exposure = "auto", metadata: Any = None) -> None:
        """Writes .png (sRGB of values times the exposure) or .exr (linear). The file appears when it is complete.

        >>> import hogel, numpy as np, os, tempfile
        >>> hogel.Picture(np.full((2, 3, 3), 0.5)).save(os.path.join(tempfile.mkdtemp(), "grey.exr"))
        """
        name = os.fspath(path)
        _core.require_picture_name(name)
        factor = self.exposure(exposure)
        if metadata is None:
            metadata = [("software", f"hogel {_core.__version__}")]
            if self._made is not None:
                command, acted = self._made
                if not name.endswith(".exr"):
                    acted = {**acted, "exposure": exposure if isinstance(exposure, str) else _record.number(exposure)}
                metadata = _record.entries(command, acted)
            metadata.append(("exposure", f"{factor:.9g}"))
        _core.write_image(name, self._image, factor, metadata)

    def png(self, exposure: Exposure = "auto") -> bytes:
        """Returns the bytes of a PNG file.

        >>> import hogel, numpy as np
        >>> hogel.Picture(np.full((2, 3, 1), 0.5)).png()[:4]
        b'\x89PNG'
        """
        return _core.encode_png(self._image, self.exposure(exposure))

    def _repr_png_(self) -> bytes:
        return self.png()

    def compare(self, other: "Picture", exposure: float = 1) -> dict[str, float]:
        """Returns psnr and ssim of display values, max_error and linear_psnr of another picture of the same size.

        >>> import hogel, numpy as np
        >>> grey = hogel.Picture(np.full((16, 16, 1), 0.5))
        >>> grey.compare(grey)["max_error"]
        0.0
        """
        return _core.compare_images(self._image, other._image, exposure)

    def __repr__(self) -> str:
        return f"Picture({self.width}x{self.height} pixels, {self.channels} channel{'' if self.channels == 1 else 's'})"
