# SPDX-License-Identifier: Apache-2.0
"""Scenes, and the light fields that are rendered of them."""
from __future__ import annotations

import math
import os
from collections.abc import Sequence
from typing import Any, Optional, Union

import numpy as np

from . import _core, units
from ._progress import Progress, reporting
from .errors import UsageError
from .light_field import LightField

Colour = Union[str, Sequence[float]]
_NAMES = {
    "black": "#000000",
    "white": "#ffffff",
    "grey": "#808080",
    "red": "#ff0000",
    "green": "#00ff00",
    "blue": "#0000ff",
    "yellow": "#ffff00",
}


def _colour(value: Colour, what: str) -> tuple[float, float, float]:
    """Linear R, G, B, of three linear numbers, a name or #rrggbb, which is sRGB."""
    if isinstance(value, str):
        code = _NAMES.get(value, value)
        try:
            if len(code) != 7 or code[0] != "#":
                raise ValueError
            parts = [int(code[i : i + 2], 16) for i in (1, 3, 5)]
        except ValueError:
            raise UsageError(f"{what}: '{value}' is not a colour; write #rrggbb, or {', '.join(_NAMES)}") from None
        return tuple(_core.srgb_decode(part / 255) for part in parts)  # type: ignore[return-value]
    red, green, blue = (float(part) for part in value)
    return red, green, blue


def _up(value: Union[str, Sequence[float]]) -> tuple[float, float, float]:
    if isinstance(value, str):
        sign = -1.0 if value.startswith("-") else 1.0
        axis = value.lstrip("-")
        if axis not in ("x", "y", "z") or len(value) > 2:
            raise UsageError(f"up: '{value}' is not an axis; write x, y, z, -x, -y or -z")
        return tuple(sign * (axis == name) for name in "xyz")  # type: ignore[return-value]
    x, y, z = (float(part) for part in value)
    return x, y, z


def light(direction: Sequence[float], colour: Colour = "white", strength: float = 2.2) -> _core.Light:
    """A directional light that comes from `direction` (x, y, z), with its irradiance."""
    size = math.hypot(*direction)
    if not (size > 0 and math.isfinite(size)):
        raise UsageError(f"light: {direction!r} is not a direction")
    x, y, z = (-part / size for part in direction)
    red, green, blue = (strength * part for part in _colour(colour, "light"))
    return _core.Light(direction=(x, y, z), intensity=(red, green, blue))


def request(
    *,
    hogels: Optional[units.Counts] = None,
    directions: Optional[units.Counts] = None,
    size: Optional[units.Length] = None,
    fov: Union[units.Angle, Sequence[units.Angle], None] = None,
    toward: Union[units.Angle, Sequence[units.Angle]] = 0,
    algorithm: Optional[str] = None,
    shading: Optional[str] = None,
    shadow_map: Optional[int] = None,
    cache_spacing: Optional[float] = None,
    samples: units.Counts = 1,
    hemicube: bool = False,
    focal_plane: Optional[units.Length] = None,
    frequencies: Optional[units.Length] = None,
    interpolate: Optional[int] = None,
    cull_back_faces: bool = False,
    front: Optional[float] = None,
    as_is: bool = False,
) -> _core.LightFieldRequest:
    """What `hogel render` asks for, by the names of its options: see Scene.render()."""
    defaults = _core.defaults
    columns, rows = units.counts(defaults["hogels"] if hogels is None else hogels, "hogels")
    across, down = units.counts(defaults["directions"] if directions is None else directions, "directions")
    width = units.optional_length(size, defaults["size"], "size")
    if not (columns > 0 and rows > 0 and width > 0):
        raise UsageError("hogels, size: positive numbers were expected")
    made = _core.LightFieldRequest()
    if algorithm is not None:
        made.renderer = _known("renderer", algorithm, _core.renderers())
    lighting = _core.ShadingOptions()
    lighting.model = _core.defaults["shading"] if shading is None else _known("shading model", shading, _core.shading_models())
    lighting.shadow_map = defaults["shadow_map"] if shadow_map is None else int(shadow_map)
    made.shading = lighting
    if cache_spacing is not None:
        made.cache_spacing = float(cache_spacing)
    wide, high = (defaults["field_of_view"],) * 2 if fov is None else units.angles(fov, "fov")
    right, up = units.angles(toward, "toward")
    if sum([hemicube, focal_plane is not None, frequencies is not None]) > 1:
        raise UsageError("hemicube, focal_plane, frequencies: only one of them can be asked for")
    pitch = width / columns
    view: Union[_core.Perspective, _core.Frequencies, _core.FocalPlane]
    if hemicube:
        # The faces of a hemicube have ranges of their own, but for the height of a single row of directions.
        view = _core.field_of_view(defaults["field_of_view"], defaults["field_of_view"], right, up)
    else:
        view = _core.field_of_view(wide, high, right, up)
    if focal_plane is not None:
        view = _core.FocalPlane(units.length(focal_plane, "focal_plane"), view.half_u, view.half_v, view.center_u, view.center_v)
    if frequencies is not None:
        # As many frequencies j/d as fit into the field of view.
        step = units.length(frequencies, "frequencies") / pitch
        across = 2 * math.floor(math.sin(wide / 2) / step + 1e-9) + 1
        down = 2 * math.floor(math.sin(high / 2) / step + 1e-9) + 1
        view = _core.Frequencies(0.5 * across * step, 0.5 * down * step)
    made.grid = _core.LightFieldGrid(columns, rows, pitch, across, down, view)
    _core.validate_light_field(made.grid)
    made.hemicube = bool(hemicube)
    if hemicube and fov is not None:
        made.hemicube_across, made.hemicube_down = wide, high
    made.samples = units.counts(samples, "samples")
    _core.finer(made.grid, *made.samples)
    made.cull_back_faces = bool(cull_back_faces)
    made.interpolate = 0 if interpolate is None else int(interpolate)
    made.fit = not as_is
    if front is not None:
        made.front = float(front)
    made.grids()
    return made


def _known(kind: str, name: str, known: list[str]) -> str:
    if name not in known:
        _core.throw_unknown(kind, name, known)
    return name


class Scene:
    """Surfaces and lights: a built-in scene, a mesh file, or meshes from arrays.

    >>> import hogel, numpy as np
    >>> hogel.Scene.load("pumpkin")
    Scene('pumpkin', built in)
    >>> square = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
    >>> hogel.Scene.mesh(square, [(0, 1, 2), (0, 2, 3)])
    Scene('mesh', 2 triangles)
    """

    def __init__(self, name: str, scene: Optional[_core.Scene], pose: _core.ScenePose) -> None:
        self.name, self._scene, self._pose = name, scene, pose

    @classmethod
    def load(
        cls,
        name: Union[str, os.PathLike[str]],
        *,
        up: Union[str, Sequence[float]] = "y",
        rotate: Union[str, Sequence[units.Angle]] = (0, 0, 0),
        scale: float = 1,
        move: Union[str, Sequence[units.Length]] = (0, 0, 0),
        colour: Optional[Colour] = None,
        texture: Any = None,
        light: Sequence[_core.Light] = (),
        background: Optional[Colour] = None,
        ground: Optional[Colour] = None,
        point_size: float = 1,
        progress: Progress = None,
    ) -> "Scene":
        """A built-in scene of that name (hogel.scenes()), or a mesh file, which is read at once. The rest turns, places,
        colours and lights it, as the options of these names do; angles are about x, y and z."""
        pose = _core.ScenePose()
        pose.up = _up(up)
        if isinstance(rotate, str):
            if not rotate.endswith("deg"):
                raise UsageError(f"rotate: '{rotate}' is not a rotation; write the angles about x, y and z, such as -90,0,0deg")
            rotate = [part + "deg" for part in rotate[:-3].split(",")]
        rotations = [units.angle(part, "rotate") for part in rotate]
        if len(rotations) != 3:
            raise UsageError("rotate: three angles were expected, about x, y and z")
        pose.rotation = (rotations[0], rotations[1], rotations[2])
        pose.scale = float(scale)
        pose.shift = units.point(move, "move")
        if colour is not None:
            pose.color = _colour(colour, "colour")
        if texture is not None:
            from .picture import Picture

            pose.set_texture((texture if isinstance(texture, Picture) else Picture.open(texture))._image)
        pose.lights = list(light)
        if background is not None:
            pose.background = _colour(background, "background")
        if ground is not None:
            pose.ground = _colour(ground, "ground")
        text = os.fspath(name)
        if text in (known for known, _ in _core.scenes()):
            return cls(text, None, pose)
        if _core.input_kind(text) != _core.InputKind.scene:
            from .errors import BadInputError

            raise BadInputError(f"{text}: is not a scene")
        with reporting(progress, "scene") as report:
            return cls(text, _core.import_scene(text, float(point_size), report), pose)

    @classmethod
    def mesh(
        cls,
        vertices: Any,
        triangles: Any,
        *,
        normals: Any = None,
        colors: Any = None,
        radiance: Any = None,
        texture_coordinates: Any = None,
        material: Optional[_core.Material] = None,
        crease: units.Angle = 30 * units.deg,
        name: str = "mesh",
    ) -> "Scene":
        """One mesh from arrays, as trimesh, meshio and Blender lend them: vertices [n][3] (metres with as_is, otherwise
        any unit), triangles [m][3] of indices, and for each vertex optionally normals, linear colors, a given radiance
        [n][3] and texture_coordinates [n][2]. Without normals smooth ones are made, sharp where faces meet at more than
        `crease`."""
        index = np.asarray(triangles)
        if index.dtype.kind not in "iu" or (index.size and (index.min() < 0 or index.max() > 0xFFFFFFFF)):
            raise UsageError("triangles: whole numbers from 0 were expected")

        def row_array(rows: Any, kind: Any) -> Any:
            return None if rows is None else np.ascontiguousarray(rows, dtype=kind)

        made = _core.Mesh(
            positions=row_array(vertices, np.float64),
            triangles=np.ascontiguousarray(index, dtype=np.uint32),
            normals=row_array(normals, np.float64),
            colors=row_array(colors, np.float32),
            radiance=row_array(radiance, np.float32),
            texture_coordinates=row_array(texture_coordinates, np.float32),
            material=material or _core.Material(),
            name=name,
        )
        scene = _core.Scene()
        scene.name = name
        scene.meshes = [made]
        _core.validate_scene(scene)
        if normals is None and radiance is None:
            _core.add_missing_normals(scene, units.angle(crease, "crease"))
        return cls(name, scene, _core.ScenePose())

    @property
    def notes(self) -> list[str]:
        """What the file holds that is not shown, a line each."""
        return [] if self._scene is None else list(self._scene.notes)

    @property
    def triangles(self) -> Optional[int]:
        """The number of triangles; None for a built-in scene, which is made in the size of a hologram."""
        return None if self._scene is None else _core.triangle_count(self._scene)

    def placed(self, wanted: _core.LightFieldRequest, progress: Progress = None) -> _core.Scene:
        """The scene at the hologram of a request()."""
        wanted.pose = self._pose
        with reporting(progress, "scene") as report:
            if self._scene is None:
                return _core.load_scene(self.name, wanted, report)
            return _core.prepare_scene(self._scene, wanted)

    def render(self, *, progress: Progress = None, **options: Any) -> LightField:
        """The light field of the scene, rendered when it is read: by save(), np.asarray(), slices or load().

        hogels, directions  columns and rows: (256, 256), 256 or "256x256"
        size                width of the hologram
        fov, toward         full angles of view, and where their middle looks: across and down
        algorithm, shading  names of hogel.renderers() and hogel.shading_models()
        shadow_map, cache_spacing, samples, hemicube, focal_plane, frequencies, interpolate, cull_back_faces,
        front, as_is        as the options of `hogel render` of these names

        >>> import hogel
        >>> from hogel import deg, mm
        >>> hogel.Scene.load("pumpkin").render(hogels=(8, 6), directions=16, size=2*mm, fov=16*deg)
        LightField(8x6 hogels of 16x16 directions, 3 channels, 2 mm x 1.5 mm, 16°, 147 kB, rendered when read)
        """
        wanted = request(**options)
        placed = self.placed(wanted, progress)
        with reporting(progress, "lighting") as report:
            return LightField(_core.render_light_field(placed, wanted, report), "rendered when read")

    def __repr__(self) -> str:
        what = "built in" if self._scene is None else f"{self.triangles} triangle{'' if self.triangles == 1 else 's'}"
        return f"Scene({self.name!r}, {what})"
