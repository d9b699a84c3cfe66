# SPDX-License-Identifier: Apache-2.0
"""Scenes and rendering."""
from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from typing import Any, Optional, Union

import numpy as np

from . import _core, _record, units
from ._keywords import _keywords, passes_options_to, takes
from ._progress import Progress, reporting
from .errors import BadInputError, UsageError, usage_error
from .exports import export_views
from .hologram import Hologram
from .light_field import LightField
from .picture import Picture
from .requests import request

#: Custom renderers by name: see add_renderer().
own_renderers: dict[str, Callable[..., Any]] = {}


def add_renderer(name: str, renderer: Callable[..., Any]) -> None:
    """Registers a custom renderer for `algorithm`. renderer(scene, grid) gets the placed scene; its `meshes` have positions
    [n][3] (metres) and triangles [m][3]. It returns a function of rays for LightField.from_function().

    >>> import hogel
    >>> hogel.add_renderer("flat", lambda scene, grid: lambda s, t, u, v: 0.25 + 0 * s)
    >>> made = hogel.Scene.load("pumpkin").render(algorithm="flat", hogels=4, directions=4)
    >>> float(made[0, 0, 0, 0][0])
    0.25
    """
    if name in _core.renderers():
        raise UsageError(f"add_renderer: {name} is the name of a renderer of hogel")
    own_renderers[name] = renderer


class Scene:
    """Scene of surfaces and lights: a built-in scene, a mesh file, a picture, or meshes from arrays.

    >>> import hogel, numpy as np
    >>> hogel.Scene.load("pumpkin")
    Scene('pumpkin', built in)
    >>> square = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
    >>> hogel.Scene.mesh(square, [(0, 1, 2), (0, 2, 3)])
    Scene('mesh', 2 triangles)
    """

    def __init__(
        self, name: str, scene: Optional[_core.Scene], pose: _core.ScenePose, made: Optional[dict[str, Any]] = None
    ) -> None:
        # `made`: options of load(); None if the command line cannot express them.
        self.name, self._scene, self._pose, self._made = name, scene, pose, made

    @classmethod
    @takes(_core.scene_keywords())
    def load(cls, name: Union[str, os.PathLike[str]], *, progress: Progress = None, **options: Any) -> "Scene":
        """Loads a built-in scene (hogel.scenes()), or reads a mesh or picture file. The options rotate, place, colour and
        light it, and give the depths of a picture, as the options of the command line do. A colour is a text or three linear numbers, `texture` a file or a Picture,
        `light` a list of texts and hogel.light().

        >>> import hogel
        >>> hogel.Scene.load("sphere", colour="#804020", background="grey")
        Scene('sphere', built in)
        """
        texture, lights = options.pop("texture", None), options.pop("light", None)
        lights = [] if lights is None else lights
        if isinstance(lights, (str, _core.Light)):
            lights = [lights]
        if not isinstance(lights, Iterable) or not all(isinstance(light, (str, _core.Light)) for light in lights):
            raise usage_error("light", "expected a list of texts and hogel.light()")
        texts = [light if isinstance(light, str) else _core.light_text(light) for light in lights]
        picture = getattr(texture, "_image", None)
        if picture is None:
            options["texture"] = texture
        pose = _core.scene_pose(options)
        pose.lights = [_core.parse_light(light) if isinstance(light, str) else light for light in lights]
        if picture is not None:
            pose.texture = picture
        # The command line can express only texts.
        made = {**options, "light": texts} if picture is None and all(texts) else None
        text = os.fspath(name)
        if text in (known for known, _ in _core.scenes()):
            return cls(text, None, pose, made)
        if _core.input_kind(text) != _core.InputKind.scene:
            raise BadInputError(f"{text}: is not a scene")
        with reporting(progress, "scene") as report:
            return cls(text, _core.import_scene(text, _core.scene_import_options(options), report), pose, made)

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
        """Creates a scene of one mesh from arrays, as provided by trimesh, meshio and Blender: vertices [n][3] (metres with
        as_is, otherwise any unit), triangles [m][3] of indices, and optionally for each vertex normals, linear colors,
        radiance [n][3] and texture_coordinates [n][2]. Without normals, computes smooth ones with sharp edges above the
        angle `crease`.

        >>> import hogel, numpy as np
        >>> corners = np.array([(-1, -1, 0), (1, -1, 0), (0, 1, 0.5)])
        >>> hogel.Scene.mesh(corners, [(0, 1, 2)], name="sail")
        Scene('sail', 1 triangle)
        """
        index = np.asarray(triangles)
        if index.dtype.kind not in "iu" or (index.size and (index.min() < 0 or index.max() > 0xFFFFFFFF)):
            raise usage_error("triangles", "expected integers from 0")

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

    @classmethod
    def picture(
        cls,
        picture: Any,
        depth_map: Any = None,
        *,
        depth_values: str = "auto",
        near: Optional[units.Length] = None,
        far: Optional[units.Length] = None,
        name: str = "picture",
    ) -> "Scene":
        """Creates a scene that shows a Picture, or an array [y][x] or [y][x][c] of linear radiances. With a depth map, an
        array [y][x] of any size, its pixels lie at their depths. The other options are those of load().

        >>> import hogel, numpy as np
        >>> hogel.Scene.picture(np.ones((30, 40, 3)))
        Scene('picture', 2 triangles)
        >>> hogel.Scene.picture(np.ones((30, 40)), np.arange(12).reshape(3, 4), near="-2mm", far="3mm")
        Scene('picture', 46 triangles)
        """
        keywords = {"depth_values": depth_values, "near": near, "far": far}
        if depth_map is not None:
            keywords["depth_map"] = name
            depth_map = np.asarray(depth_map, dtype=np.float32)
        shown = picture if isinstance(picture, Picture) else Picture(picture)
        scene = _core.scene_of_picture(shown._image, depth_map, _core.scene_import_options(keywords))
        scene.name = name
        return cls(name, scene, _core.ScenePose())

    @property
    def notes(self) -> list[str]:
        """Notes about contents of the file that are not rendered, one line each."""
        return [] if self._scene is None else list(self._scene.notes)

    @property
    def triangles(self) -> Optional[int]:
        """Number of triangles; None for a built-in scene, which is generated in the size of a hologram."""
        return None if self._scene is None else _core.triangle_count(self._scene)

    def placed(self, wanted: _core.LightFieldRequest, progress: Progress = None) -> _core.Scene:
        """Returns the scene placed at the hologram of a request().

        >>> import hogel
        >>> placed = hogel.Scene.load("sphere").placed(hogel.request(size="10mm"))
        >>> placed.meshes[0].positions.shape[1]
        3
        """
        wanted.pose = self._pose
        with reporting(progress, "scene") as report:
            if self._scene is None:
                return _core.load_scene(self.name, wanted, report)
            return _core.prepare_scene(self._scene, wanted)

    @passes_options_to(request)
    def advise(
        self, hologram: Optional[_core.HologramRequest] = None, *, progress: Progress = None, **options: Any
    ) -> list[_core.Advice]:
        """Returns the sampling limits that the scene exceeds with these options of render() and this hologram_request().
        Each entry has the name of the parameter, a sentence, a sufficient value (metres, or a number across), and whether
        such holograms are refused.

        >>> import hogel
        >>> coarse = hogel.hologram_request(pitch="8um")
        >>> [(advice.parameter, advice.refused) for advice in hogel.Scene.load("sphere").advise(coarse, size="10mm")][0]
        ('pitch', True)
        """
        wanted = request(**options)
        return _core.advise(self.placed(wanted, progress), wanted, _core.HologramRequest() if hologram is None else hologram)

    @passes_options_to(request)
    def render(self, *, progress: Progress = None, **options: Any) -> LightField:
        """Returns the light field of the scene, rendered on demand by save(), np.asarray(), slices or load().

        hogels, directions  columns and rows: (256, 256), 256 or "256x256"
        size                width of the hologram
        fov, toward         full angles of view, and the direction of their middle: across and down
        algorithm, shading  names of hogel.renderers() and hogel.shading_models()
        shadow_map, cache_spacing, samples, hemicube, focal_plane, frequencies, interpolate, cull_back_faces,
        front, as_is        as the options of `hogel render` of these names

        >>> import hogel
        >>> from hogel import deg, mm
        >>> hogel.Scene.load("pumpkin").render(hogels=(8, 6), directions=16, size=2*mm, fov=16*deg)
        LightField(8x6 hogels of 16x16 directions, 3 channels, 2 mm x 1.5 mm, 16°, 147 kB, rendered when read)
        """
        algorithm = options.get("algorithm")
        if isinstance(algorithm, str) and algorithm in own_renderers:
            options.pop("algorithm")
            wanted = request(**options)
            placed = self.placed(wanted, progress)
            return LightField.of_grid(own_renderers[algorithm](placed, wanted.grid), wanted.grid)
        wanted = request(**options)
        placed = self.placed(wanted, progress)
        with reporting(progress, "lighting") as report:
            shaded = _core.light_scene(placed, wanted, report)
        made = LightField(_core.render_light_field(shaded, wanted), "rendered when read")
        made._rendering = wanted, _core.triangle_count(placed), _core.shading_model(placed, wanted.shading)
        if self._made is not None:
            of_scene = {**self._made, **options}
            record = _core.light_field_record(of_scene, placed, self._scene is not None, shaded)
            made._made = {"scene": self.name, **dict(record)}
            made._identity = _core.describe_input(self.name, placed)
        return made

    @passes_options_to(request, export_views)
    def export(self, target: Union[str, "os.PathLike[str]"], *, progress: Progress = None, **options: Any) -> _core.ExportedViews:
        """Renders the scene and writes its views, or a film of the middle row, as `hogel export` does. The options are those
        of render() and hogel.export_views(). A quilt chooses hogels, directions, fov and focal_plane for its display
        (hogel.quilt_displays()), by `device` or the name.

        >>> import hogel, os, tempfile
        >>> made = hogel.Scene.load("sphere").export(os.path.join(tempfile.mkdtemp(), "x_qs3x2a0.75.png"), hogels=(12, 16))
        >>> made.columns, made.rows, len(made.files)
        (6, 1, 1)
        """
        names = _keywords(export_views)
        of_views = {name: value for name, value in options.items() if name in names}
        of_scene = {name: value for name, value in options.items() if name not in names}
        parameters = {name: value for name, value in of_views.items() if name not in ("force", "metadata")}
        cameras, device = _core.export_cameras(os.fspath(target), parameters, of_scene)
        if device:
            of_views["device"] = device
        return self.render(progress=progress, **{**of_scene, **cameras}).export(target, progress=progress, **of_views)

    @takes(_core.scene_hologram_keywords())
    def hologram(self, *, method: str, progress: Progress = None, **options: Any) -> Hologram:
        """Computes the hologram of the scene without a light field, in memory, by a method of
        hogel.scene_hologram_methods(). The options of render() set its size.

        >>> import hogel
        >>> hogel.Scene.load("pumpkin").hologram(method="points", wavelength="633nm", size="0.2mm", hogels=4, spacing="20um")
        Hologram(128x128 samples 1.5625 um apart, 0.2 mm x 0.2 mm, 633 nm, in memory)
        """
        keywords = {**options, "method": method}
        place = _core.scene_hologram_place(keywords)
        placed = self.placed(place, progress)
        with reporting(progress, "lighting") as report:
            shaded = _core.light_scene(placed, place, report)
        with reporting(progress, "hologram") as report:
            made = Hologram(_core.make_scene_holograms(keywords, shaded, report))
        if self._made is not None:
            record = _core.scene_hologram_record({**self._made, **keywords}, placed, self._scene is not None)
            made._made = {"input": self.name, **dict(record)}
            # Only surfaces emit light.
            made._history = [entry for entry in shaded.metadata if entry[0] != "background"]
        return made

    @takes(_core.bake_keywords())
    def bake(
        self, path: Union[str, "os.PathLike[str]"], *, metadata: Any = None, progress: Progress = None, **options: Any
    ) -> int:
        """Bakes the lighting of the scene, indirect light included, into a mesh and writes it as .glb, as `hogel bake` does.
        Returns the number of triangles.

        >>> import hogel, os, tempfile
        >>> path = os.path.join(tempfile.mkdtemp(), "lit.glb")
        >>> hogel.Scene.load("sphere").bake(path, rays=4, bounces=1, size="10mm") > 0
        True
        """
        name = os.fspath(path)
        _core.require_baked_scene_name(name)
        _core.require_writable(name)
        placed = self.placed(request(size=options.get("size")), progress)
        with reporting(progress, "baking") as report:
            baked = _core.bake_scene(placed, options, report)
        if metadata is None:
            metadata = _record.by_function("Scene.bake")
            if self._made is not None:
                record = _core.bake_record({**self._made, **options}, placed, self._scene is not None)
                metadata = _record.entries("bake", {"scene": self.name, **dict(record)})
        _core.write_baked_scene(name, baked, metadata)
        return int(_core.triangle_count(baked))

    def __repr__(self) -> str:
        what = "built in" if self._scene is None else f"{self.triangles} triangle{'' if self.triangles == 1 else 's'}"
        return f"Scene({self.name!r}, {what})"
