# SPDX-License-Identifier: Apache-2.0
"""Plots of light fields, fringes and photographs with matplotlib, with axes in millimetres and degrees. Each function
returns a figure, which notebooks display and figure.savefig() writes.

>>> import hogel
>>> import hogel.plot as plot
>>> lf = hogel.Scene.load("pumpkin").render(hogels=24, directions=8, size="2mm", fov="16deg").load()
>>> figure = plot.light_field(lf)
>>> len(figure.axes)
9
"""
from __future__ import annotations

import math
import os
import tempfile
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Optional, Union

import numpy as np

from . import _core, units
from ._keywords import passes_options_to
from ._progress import Progress
from .errors import NotBuiltInError, UsageError, usage_error
from .field import Field
from .hologram import Hologram
from .light_field import LightField
from .picture import Picture

if TYPE_CHECKING:
    from matplotlib.figure import Figure  # type: ignore[import]

_MM, _DEG = 1e3, 180 / math.pi


def _figure(columns: int, rows: int, width: float, height: float, **options: Any) -> Any:
    """Returns a figure with panels of this size in inches, and its axes as an array."""
    try:
        from matplotlib import pyplot  # type: ignore[import]
    except ImportError:
        raise NotBuiltInError("plot: needs matplotlib; on Debian: apt-get install python3-matplotlib") from None
    return pyplot.subplots(
        rows, columns, figsize=(columns * width, rows * height + 0.3), squeeze=False, layout="constrained", **options
    )


def _shown(pixels: Any, exposure: float) -> "np.ndarray[Any, Any]":
    """Converts linear values to sRGB display values, [y][x][3]."""
    linear = np.clip(np.asarray(pixels, np.float64) * exposure, 0, 1)
    low = linear <= 0.0031308
    display = np.where(low, 12.92 * linear, 1.055 * np.where(low, 1, linear) ** (1 / 2.4) - 0.055)
    return np.repeat(display, 3, axis=-1) if display.shape[-1] == 1 else display


def _exposure_of(pictures: Sequence[Any], exposure: Union[str, float]) -> float:
    if exposure != "auto":
        return float(exposure)
    return float(_core.automatic_exposure(Picture(np.concatenate([np.asarray(p) for p in pictures], axis=1))._image))


def _extent(width: float, height: float, x: float = 0, y: float = 0) -> tuple[float, float, float, float]:
    """Returns the extent of a plane for imshow(), millimetres."""
    left, right, low, high = x - width / 2, x + width / 2, y - height / 2, y + height / 2
    return left * _MM, right * _MM, low * _MM, high * _MM


def _angle(grid: _core.LightFieldGrid, tangent: float) -> float:
    """Converts a direction u or v to degrees."""
    return math.asin(max(-1, min(1, tangent))) * _DEG if grid.has_frequencies else math.atan(tangent) * _DEG


def _middle(*lengths: int) -> list[int]:
    return [length // 2 for length in lengths]


def light_field(
    lf: LightField, *, columns: int = 3, rows: int = 3, exposure: Union[str, float] = "auto"
) -> "Figure":
    """Plots a grid of views of a light field from evenly spaced directions. Views from the left are at the left.

    >>> import hogel, hogel.plot as plot
    >>> lf = hogel.Scene.load("pumpkin").render(hogels=12, directions=4, size="1mm").load()
    >>> len(plot.light_field(lf, columns=2, rows=2).axes)
    4
    """
    grid = lf.grid
    across = np.linspace(0, grid.directions_u - 1, min(columns, grid.directions_u)).round().astype(int)
    down = np.linspace(0, grid.directions_v - 1, min(rows, grid.directions_v)).round().astype(int)
    # Directions point from the scene towards the viewer's side: a viewpoint at the left sees rays with positive u.
    views = [[np.moveaxis(lf.part(v=int(v), u=int(u)), 0, -1) for u in across[::-1]] for v in down[::-1]]
    factor = _exposure_of([view for row in views for view in row], exposure)
    figure, axes = _figure(len(across), len(down), 2.2, 2.2 * grid.height / grid.width, sharex=True, sharey=True)
    for j, v in enumerate(down[::-1]):
        for i, u in enumerate(across[::-1]):
            axis = axes[j][i]
            axis.imshow(_shown(views[j][i], factor), extent=_extent(grid.width, grid.height))
            seen = -_angle(grid, grid.u(int(u))), -_angle(grid, grid.v(int(v)))
            axis.set_title(f"from {seen[0]:+.1f}°, {seen[1]:+.1f}°", fontsize=8)
            axis.tick_params(labelsize=7)
    figure.supxlabel("s, mm", fontsize=9)
    figure.supylabel("t, mm", fontsize=9)
    return figure


def epipolar(
    lf: LightField, *, t: Optional[int] = None, s: Optional[int] = None, exposure: Union[str, float] = "auto"
) -> "Figure":
    """Plots the epipolar plane images of a row `t` and a column `s` of hogels; default: the middle ones. They show radiance
    over position and direction. Scene points appear as lines; the slope depends on depth.

    >>> import hogel, hogel.plot as plot
    >>> lf = hogel.Scene.load("pumpkin").render(hogels=12, directions=4, size="1mm").load()
    >>> len(plot.epipolar(lf).axes)
    2
    """
    grid = lf.grid
    column, row = _middle(grid.hogels_s, grid.hogels_t)
    column, row = column if s is None else s, row if t is None else t
    v, u = _middle(grid.directions_v, grid.directions_u)
    across = np.moveaxis(lf.part(t=row, v=v), 0, -1)  # [s][u][c]
    down = np.moveaxis(lf.part(s=column, u=u), 0, -1)  # [t][v][c]
    factor = _exposure_of([np.moveaxis(across, 0, 1).reshape(1, -1, grid.channels)], exposure)
    figure, (axes,) = _figure(2, 1, 4.5, 3.2)
    plots = (
        (axes[0], np.moveaxis(across, 0, 1), grid.width, grid.u, grid.directions_u, "s", f"t = {grid.t(row) * _MM:.2f} mm"),
        (axes[1], np.moveaxis(down, 0, 1)[:, ::-1], grid.height, grid.v, grid.directions_v, "t", f"s = {grid.s(column) * _MM:.2f} mm"),
    )
    for axis, plane, length, direction, number, name, where in plots:
        first, last = _angle(grid, direction(0)), _angle(grid, direction(number - 1))
        half = (last - first) / (2 * max(1, number - 1))
        extent = (-length / 2 * _MM, length / 2 * _MM, last + half, first - half)
        axis.imshow(_shown(plane, factor), extent=extent, aspect="auto", interpolation="nearest")
        axis.set(xlabel=f"{name}, mm", ylabel="direction, degrees", title=where)
    return figure


def fringe(
    field: Union[Field, Hologram], *, number: int = 0, side: int = 512, decades: float = 5, progress: Progress = None
) -> "Figure":
    """Plots modulus, phase and angular spectrum of the middle of a fringe pattern. `side`: width of the square region,
    samples; `decades`: range of the spectrum's intensity from black to white.

    >>> import hogel, hogel.plot as plot
    >>> lf = hogel.Scene.load("pumpkin").render(hogels=4, directions=16, size="0.2mm")
    >>> figure = plot.fringe(lf.hologram(wavelength="532nm"), side=64)
    >>> figure.axes[0].get_title()
    'modulus'
    """
    selected = field[number] if isinstance(field, Hologram) else field
    grid = selected.grid
    columns, rows = min(side, grid.width), min(side, grid.height)
    x0, y0 = (grid.width - columns) // 2, (grid.height - rows) // 2
    samples = selected.read((slice(y0, y0 + rows), slice(x0, x0 + columns)), progress)
    window = np.hanning(rows + 2)[1:-1, None] * np.hanning(columns + 2)[None, 1:-1]
    power = np.abs(np.fft.fftshift(np.fft.fft2(samples * window))) ** 2
    level = np.log10(np.maximum(power / max(power.max(), 1e-300), 10.0**-decades))
    figure, (axes,) = _figure(3, 1, 4, 3.4)
    extent = _extent(columns * grid.pitch_x, rows * grid.pitch_y, grid.center_x, grid.center_y)
    modulus = np.abs(samples)
    top = float(np.quantile(modulus, 0.999)) or 1.0
    shown = axes[0].imshow(modulus, extent=extent, cmap="gray", vmin=0, vmax=top)
    figure.colorbar(shown, ax=axes[0], shrink=0.8)
    axes[0].set(title="modulus", xlabel="x, mm", ylabel="y, mm")
    shown = axes[1].imshow(np.angle(samples), extent=extent, cmap="twilight", vmin=-math.pi, vmax=math.pi, interpolation="nearest")
    figure.colorbar(shown, ax=axes[1], shrink=0.8, ticks=(-math.pi, 0, math.pi)).ax.set_yticklabels(("-π", "0", "π"))
    axes[1].set(title="phase", xlabel="x, mm")
    max_angles = [math.asin(min(1.0, selected.wavelength / (2 * pitch))) * _DEG for pitch in (grid.pitch_x, grid.pitch_y)]
    # Row 0 is at the top: frequencies increase downwards in the array, directions upwards.
    shown = axes[2].imshow(level, extent=(-max_angles[0], max_angles[0], -max_angles[1], max_angles[1]), cmap="magma", vmin=-decades, vmax=0)
    figure.colorbar(shown, ax=axes[2], shrink=0.8, label="log₁₀ of intensity")
    axes[2].set(title=f"spectrum, {units.say_length(selected.wavelength)}", xlabel="across, degrees", ylabel="up, degrees")
    return figure


def _photograph_axes(axis: Any, picture: Picture, factor: float, title: str) -> None:
    camera = picture.camera
    if camera is None:
        axis.imshow(_shown(picture, factor))
    else:
        plane = camera.picture
        axis.imshow(_shown(picture, factor), extent=_extent(plane.size_x, plane.size_y, plane.center_x, plane.center_y))
    axis.set_title(title, fontsize=9)
    axis.set_xlabel("x, mm", fontsize=8)
    axis.tick_params(labelsize=7)


@passes_options_to(LightField.photograph, Hologram.photograph)
def focal_stack(
    source: Union[LightField, Hologram],
    depths: Sequence[units.Length] = ("-4mm", "0mm", "4mm"),
    *,
    exposure: Union[str, float] = "auto",
    **camera: Any,
) -> "Figure":
    """Plots photographs focused at several depths, of a light field by rays or of a hologram by waves. The options are those
    of photograph().

    >>> import hogel, hogel.plot as plot
    >>> lf = hogel.Scene.load("pumpkin").render(hogels=12, directions=4, size="1mm").load()
    >>> len(plot.focal_stack(lf, ("-1mm", 0), resolution=16).axes)
    2
    """
    depth_values = [units.length(depth, "depths") for depth in depths]
    if not depth_values:
        raise usage_error("depths", "expected at least one")
    pictures = [source.photograph(focus=depth, **camera) for depth in depth_values]
    factor = _exposure_of(pictures, exposure)
    shape = pictures[0].height / pictures[0].width
    figure, (axes,) = _figure(len(pictures), 1, 2.8, 2.8 * shape + 0.3, sharey=True)
    for axis, depth, picture in zip(axes, depth_values, pictures):
        where = "on the hologram" if depth == 0 else f"{abs(depth) * _MM:.3g} mm {'behind' if depth > 0 else 'in front'}"
        _photograph_axes(axis, picture, factor, f"in focus {where}")
    axes[0].set_ylabel("y, mm", fontsize=8)
    return figure


@passes_options_to(LightField.photograph, Hologram.photograph)
def twins(
    hologram: Hologram, lf: LightField, *, exposure: Union[str, float] = "auto", **camera: Any
) -> "Figure":
    """Plots a photograph of a hologram by waves, one of the light field by rays with the same camera, and their
    difference.

    >>> import hogel, hogel.plot as plot
    >>> lf = hogel.Scene.load("pumpkin").render(hogels=8, directions=16, size="0.4mm")
    >>> plot.twins(lf.hologram(), lf, resolution=12, pupil="20mm").axes[0].get_title()
    'by waves'
    """
    waves = hologram.photograph(**camera)
    rays = lf.photograph(**camera)
    factor = _exposure_of([rays], exposure)
    ratio = waves.compare(rays, factor)["psnr"] if waves.channels == rays.channels else float("nan")
    figure, (axes,) = _figure(3, 1, 3.2, 3.2 * rays.height / rays.width + 0.3, sharey=True)
    _photograph_axes(axes[0], waves, factor, "by waves")
    _photograph_axes(axes[1], rays, factor, "by rays")
    a, b = _shown(waves, factor).mean(axis=-1), _shown(rays, factor).mean(axis=-1)
    plane = rays.camera.picture
    shown = axes[2].imshow(
        a - b, extent=_extent(plane.size_x, plane.size_y, plane.center_x, plane.center_y), cmap="RdBu_r", vmin=-0.25, vmax=0.25
    )
    figure.colorbar(shown, ax=axes[2], shrink=0.8, label="display values")
    axes[2].set_title("waves - rays" + (f", PSNR {ratio:.1f} dB" if math.isfinite(ratio) else ""), fontsize=9)
    axes[2].set_xlabel("x, mm", fontsize=8)
    axes[2].tick_params(labelsize=7)
    axes[0].set_ylabel("y, mm", fontsize=8)
    return figure


def rate_distortion(
    lf: LightField,
    ppb: Sequence[float] = (1, 2, 4, 8, 16, 32),
    *,
    methods: Optional[Mapping[str, Mapping[str, Any]]] = None,
    progress: Progress = None,
) -> "Figure":
    """Plots the signal-to-noise ratio over the rate (rays per bit) of the light field, compressed at each rate. `methods`:
    one curve per entry, a name and options of compress(), such as {"ezw, cdf97": dict(coder="ezw", transform="cdf97")};
    default: all coders. Rates that a coder cannot reach are omitted.

    >>> import hogel, hogel.plot as plot
    >>> lf = hogel.Scene.load("pumpkin").render(hogels=32, directions=8, size="1mm")
    >>> len(plot.rate_distortion(lf, (2, 4), methods={"hogel": {}}).axes[0].lines)
    1
    """
    curves = methods if methods is not None else {coder: {"coder": coder} for coder in ("hogel", "threepass", "ezw", "jpeg4d")}
    figure, ((axis,),) = _figure(1, 1, 5.2, 3.6)
    # Colours that remain distinguishable with colour blindness; each curve also has its own marker.
    colours = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9")
    loaded = lf if lf.where == "in memory" else lf.load(progress=progress)
    with tempfile.TemporaryDirectory() as folder:
        for number, (name, options) in enumerate(curves.items()):
            path = os.path.join(folder, "coded.hgl")
            points: list[tuple[float, float]] = []
            last_error = usage_error("ppb", "expected at least one rate")
            for rate in ppb:
                try:
                    made = loaded.compress(path, ppb=rate, no_depth=True, progress=progress, **options)
                except UsageError as error:  # the coder cannot reach this rate
                    last_error = error
                    continue
                points.append((made["pixels_per_bit"], made["sqnr"]))
            if not points:
                raise last_error
            rates, ratios = zip(*points)
            colour = colours[number % len(colours)]
            axis.plot(rates, ratios, marker="osD^vP"[number % 6], markersize=4, color=colour)
            axis.annotate(name, (rates[-1], ratios[-1]), xytext=(6, 0), textcoords="offset points", va="center", color=colour, fontsize=8)
    axis.set_xscale("log", base=2)
    axis.set_xticks(ppb, [f"{rate:g}" for rate in ppb])
    axis.margins(x=0.15)
    axis.grid(alpha=0.3)
    axis.set(xlabel="rays a bit", ylabel="signal to error, dB")
    return figure
