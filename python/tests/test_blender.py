# SPDX-License-Identifier: Apache-2.0
"""tools/blender_export.py: what a camera of Blender sees, as a GLB file in the frame of a hologram. Blender's own projection
(bpy_extras.object_utils.world_to_camera_view) says where every vertex must be. Without Blender the file that is checked in
is tested; `BLENDER_WRITES=1 python3 test_blender.py` writes it anew."""
import json
import os
import re
import shutil
import subprocess
import unittest
from pathlib import Path

import hogel
import numpy as np
from common import SOURCES, InFolder

KEPT = Path(__file__).resolve().parent / "blender.glb"

# A scene with all that makes matrices hard: a camera that is turned, scaled and has a shifted lens, a sheared and a
# mirrored mesh, copies of a collection, a modifier, a text, and an object that is not rendered.
SCENE = """
import bpy, json, os
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Vector

bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
scene.render.resolution_x, scene.render.resolution_y = 320, 200

def add(make, **where):
    make(**where)
    return bpy.context.object

stretched = add(bpy.ops.object.empty_add, location=(0.5, 1, 0), rotation=(0.3, 0.2, 0.4))
stretched.scale = (1, 2.5, 0.7)
sheared = add(bpy.ops.mesh.primitive_cube_add, size=0.8, rotation=(0.5, 0.1, 0.9))
sheared.parent = stretched
mirrored = add(bpy.ops.mesh.primitive_cone_add, vertices=5, location=(-1, 0.2, 0.3), rotation=(0.2, 0, 0.1))
mirrored.scale = (-0.5, 0.5, 0.5)
row = add(bpy.ops.mesh.primitive_plane_add, size=0.5, location=(-1, -1, -0.4))
array = row.modifiers.new("array", "ARRAY")
array.count = 3
add(bpy.ops.mesh.primitive_cube_add, location=(0, 0, 4)).hide_render = True
text = add(bpy.ops.object.text_add, location=(0, -0.5, 0.5))
text.data.body, text.data.resolution_u = "I", 1
copied = bpy.data.collections.new("copied")
copied.objects.link(bpy.data.objects.new("tile", row.data.copy()))
for place in (1.5, 0, 0), (1.5, 1, 0.5):
    instance = add(bpy.ops.object.empty_add, location=place, rotation=(0.1, 0.7, 0))
    instance.instance_type, instance.instance_collection = "COLLECTION", copied
sun = add(bpy.ops.object.light_add, type="SUN", rotation=(0.6, 0.3, 0.1))
sun.data.energy = 3
lamp = add(bpy.ops.object.light_add, type="POINT", location=(2, -2, 3))
lamp.data.energy = 200
area = add(bpy.ops.object.light_add, type="AREA", location=(0, 0, 5))
camera = add(bpy.ops.object.camera_add, location=(2, -5, 2), rotation=(1.25, 0.15, 0.4))
camera.scale = (2, 2, 2)
camera.data.shift_x, camera.data.shift_y = 0.1, -0.05
flat = add(bpy.ops.object.camera_add, location=(0, -6, 0.5), rotation=(1.5, 0, 0))
flat.name, flat.data.type, flat.data.ortho_scale = "flat", "ORTHO", 6
scene.camera = camera
bpy.context.view_layer.update()
depsgraph = bpy.context.evaluated_depsgraph_get()
seen = {"Camera": [], "flat": []}
for instance in depsgraph.object_instances:
    if instance.object.type == "MESH" and not instance.object.original.hide_render:
        mesh = instance.object.to_mesh()
        for vertex in mesh.vertices:
            for of in camera, flat:
                seen[of.name].append(list(world_to_camera_view(scene, of, instance.matrix_world @ vertex.co)))
        instance.object.to_mesh_clear()
to_sun = camera.matrix_world.normalized().inverted().to_3x3() @ (sun.matrix_world.to_3x3() @ Vector((0, 0, -1)))
json.dump({"seen": seen, "sun": list(to_sun)}, open("seen.json", "w"))
bpy.ops.wm.save_as_mainfile(filepath=os.path.abspath("scene.blend"))
"""

DISTANCE, WIDTH = 5.0, 0.08


def blender(*words):
    # Blender takes names of files to be beside PWD.
    return subprocess.run(["blender", *words], capture_output=True, text=True, env={**os.environ, "PWD": os.getcwd()})


def exported(output, *options):
    """What the script prints."""
    script = str(SOURCES / "tools" / "blender_export.py")
    return blender("scene.blend", "--background", "--python", script, "--", output, *options)


def facts(said):
    """The height of the hologram and the eye, metres, of what the script prints."""
    height = float(re.search(r"the hologram is [\d.]+mm x ([\d.]+)mm", said).group(1)) * 1e-3
    eye = [float(part) * 1e-3 for part in re.search(r"camera was at (\S+)mm", said).group(1).split(",")]
    return height, eye


def vertices(path):
    scene = hogel.Scene.load(path).placed(hogel.request(as_is=True, size=WIDTH))
    return np.concatenate([np.asarray(mesh.positions) for mesh in scene.meshes]), scene


class Checks:
    def assert_seen(self, points, height, eye, seen, flat=False):
        """Every vertex lies on the line from the eye through the point of the window where the camera saw it, as deep."""
        depth = eye[2] - points[:, 2]
        share = np.ones(len(points)) if flat else eye[2] / depth
        window = np.array(eye[:2]) * (0 if flat else 1) + (points[:, :2] - np.array(eye[:2]) * (0 if flat else 1)) * share[:, None]
        ours = np.column_stack([window[:, 0] / WIDTH + 0.5, window[:, 1] / height + 0.5, depth / eye[2] * DISTANCE])
        theirs = np.array(seen)
        apart = np.abs(ours[:, None] - theirs[None]).max(axis=2)
        self.assertLess(apart.min(axis=1).max(), 2e-5)
        self.assertLess(apart.min(axis=0).max(), 2e-5)
        self.assertGreater(len(theirs), 30)


class Kept(Checks, unittest.TestCase):
    def test_of_the_file_that_is_checked_in(self):
        kept = json.loads(KEPT.with_suffix(".json").read_text())
        self.assert_seen(vertices(KEPT)[0], kept["height"], kept["eye"], kept["seen"])


@unittest.skipUnless(shutil.which("blender"), "Blender is not installed")
class Export(InFolder, Checks):
    def setUp(self):
        super().setUp()
        done = blender("--background", "--python-expr", SCENE)
        self.assertTrue(Path("scene.blend").exists(), done.stdout + done.stderr)
        self.known = json.loads(Path("seen.json").read_text())

    def export(self, *options):
        done = exported("scene.glb", "--width", "80mm", "--distance", str(DISTANCE), *options)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return (*facts(done.stdout), done.stdout)

    def test_perspective(self):
        height, eye, said = self.export()
        points, scene = vertices("scene.glb")
        self.assert_seen(points, height, eye, self.known["seen"]["Camera"])
        # The sun shines as before, the lamp with as much less power as it is nearer; glTF has no lights with an area.
        sun, lamp = sorted(scene.lights, key=lambda light: light.kind.name)
        np.testing.assert_allclose(sun.direction, self.known["sun"], atol=1e-5)
        np.testing.assert_allclose(sun.intensity, 3, rtol=1e-5)
        np.testing.assert_allclose(lamp.intensity, 200 / (4 * np.pi) * (eye[2] / DISTANCE) ** 2, rtol=1e-3)
        self.assertIn("note: area light 'Area'", said)
        if os.environ.get("BLENDER_WRITES"):
            shutil.copy("scene.glb", KEPT)
            seen = np.round(self.known["seen"]["Camera"], 6).tolist()
            KEPT.with_suffix(".json").write_text(json.dumps({"height": height, "eye": eye, "seen": seen}) + "\n")
        kept, _ = vertices(KEPT)
        self.assertLess(np.abs(kept[:, None] - points[None]).max(axis=2).min(axis=1).max(), 1e-7, "another file than the one checked in")
        # The line that the script prints is one that hogel understands.
        words = next(line for line in said.splitlines() if line.startswith("hogel render")).split()[1:]
        words[words.index("--hogels") + 1] = "32x20"
        made = subprocess.run([hogel.program(), *words, "--directions", "4"], capture_output=True, text=True)
        self.assertEqual(made.returncode, 0, made.stderr)

    def test_orthographic(self):
        height, eye, _ = self.export("--camera", "flat")
        self.assert_seen(vertices("scene.glb")[0], height, eye, self.known["seen"]["flat"], flat=True)

    def test_errors(self):
        cases = [
            (["a.glb", "--camera", "none"], 2, "--camera 'none'"),
            (["a.glb", "--camera", "Sun"], 2, "not a camera"),
            (["a.glb", "--width", "80"], 2, "is not a length"),
            (["a.glb", "--distance", "-1"], 2, "is not before the camera"),
            (["a.obj"], 2, "must end in .glb"),
            (["no/a.glb"], 4, "cannot be written"),
        ]
        for words, status, text in cases:
            with self.subTest(words):
                done = exported(*words)
                self.assertEqual(done.returncode, status, done.stderr)
                self.assertIn(text, done.stderr)
                self.assertNotIn("Traceback", done.stderr)
        self.assertEqual(list(Path().rglob("*.glb")), [])


@unittest.skipUnless(shutil.which("blender"), "Blender is not installed")
class InBlender(InFolder):
    def test_meshes_lend_their_arrays(self):
        """hogel inside Blender: vertices and triangles by foreach_get()."""
        program = f"""
import sys
sys.path[:0] = {[str(Path(hogel.__file__).parents[1])]!r}
import bpy, hogel, numpy as np
bpy.ops.mesh.primitive_uv_sphere_add(segments=16, ring_count=8, radius=0.005)
mesh = bpy.context.object.data
mesh.calc_loop_triangles()
vertices, triangles = np.empty(3 * len(mesh.vertices), "f"), np.empty(3 * len(mesh.loop_triangles), "i")
mesh.vertices.foreach_get("co", vertices)
mesh.loop_triangles.foreach_get("vertices", triangles)
scene = hogel.Scene.mesh(vertices.reshape(-1, 3), triangles.reshape(-1, 3))
lf = scene.render(hogels=24, directions=4, size="12mm", as_is=True)
np.save("ball.npy", np.asarray(lf))
"""
        done = blender("--background", "--python-exit-code", "3", "--python-expr", program)
        if "No module named 'hogel._core'" in done.stdout + done.stderr:
            self.skipTest("Blender's Python is another one")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        lit = np.load("ball.npy")[:, :, :, 1, 1].max(axis=0) > 0
        self.assertAlmostEqual(lit.sum() / lit.size, np.pi * 25 / 144, delta=0.06)


if __name__ == "__main__":
    unittest.main()
