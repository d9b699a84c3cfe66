# SPDX-License-Identifier: Apache-2.0
"""Exports the view of a Blender camera as a GLB file in the frame of a hologram, for `hogel render FILE.glb --as-is`:

    blender SCENE.blend --background --python tools/blender_export.py -- scene.glb --width 100mm

The hologram is the rectangle of the camera's picture at a distance. It is centred at the origin of the file, x to the
right, y upwards, z towards the camera, in metres. The distance is --distance, or that of an object (--at), or the focus
distance of a camera with depth of field, or the middle of the visible depths. The script prints the size of the hologram
and the position of the camera as options of hogel. See docs/scenes.md, "From Blender".
"""
import argparse
import math
import os
import sys

import bpy
from mathutils import Matrix, Vector

UNITS = {"m": 1, "cm": 1e-2, "mm": 1e-3, "um": 1e-6}


class Refusal(Exception):
    """Error with a one-line message and an exit status of hogel: 2 bad request, 3 bad scene, 4 output not writable."""

    def __init__(self, message, status=2):
        super().__init__(message)
        self.status = status


def length(text):
    """Parses a length with its unit. Returns metres."""
    number = text.rstrip("mcu")
    try:
        metres = float(number) * UNITS[text[len(number) :]]
        if not (metres > 0 and math.isfinite(metres)):
            raise ValueError
    except (KeyError, ValueError):
        raise argparse.ArgumentTypeError(f"'{text}' is not a length; write a positive number and m, cm, mm or um, such as 100mm") from None
    return metres


def options():
    words = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []
    parser = argparse.ArgumentParser(prog="blender_export.py", description="Exports the view of a camera as a GLB file in the frame of a hologram.")
    parser.add_argument("output", metavar="FILE.glb")
    parser.add_argument("--camera", metavar="NAME", help="the camera (default: the scene's)")
    parser.add_argument("--width", type=length, default=0.1, metavar="LENGTH", help="width of the hologram (default: 100mm)")
    where = parser.add_mutually_exclusive_group()
    where.add_argument("--distance", type=float, metavar="UNITS", help="distance of the hologram from the camera, in Blender's units")
    where.add_argument("--at", metavar="OBJECT", help="put the hologram at the depth of this object's origin")
    parser.add_argument("--frame", type=int, metavar="N", help="frame of an animation (default: the file's)")
    return parser.parse_args(words)


def find(kind, name):
    """Returns an object of the scene by name."""
    found = bpy.context.scene.objects.get(name)
    if found is None:
        raise Refusal(f"{kind} '{name}': the scene has no object of this name")
    return found


def camera_of(name):
    camera = find("--camera", name) if name else bpy.context.scene.camera
    if camera is None:
        raise Refusal("the scene has no active camera; set one, or name one with --camera", 3)
    if camera.type != "CAMERA":
        raise Refusal(f"--camera '{name}': is of type {camera.type.lower()}, not a camera")
    if camera.data.type == "PANO":
        raise Refusal(f"camera '{camera.name}': is panoramic; expected perspective or orthographic")
    return camera


def drawn(depsgraph):
    """Yields all rendered objects, evaluated, with their matrices, including instances of collections and modifiers."""
    for instance in depsgraph.object_instances:
        if instance.show_self and not instance.object.original.hide_render:
            yield instance.object, instance.matrix_world.copy()


# Curves and texts appear as mesh instances in the depsgraph.
SURFACES = ("MESH",)


def plane_distance(camera, wanted, depsgraph):
    """Returns the distance of the hologram from the camera."""
    to_camera = camera.matrix_world.normalized().inverted()

    def depth(point):
        return -(to_camera @ point).z

    focus = camera.data.dof
    if wanted.distance is not None:
        distance, of = wanted.distance, "--distance"
    elif wanted.at:
        distance, of = depth(find("--at", wanted.at).matrix_world.translation), f"--at '{wanted.at}'"
    elif focus.use_dof and focus.focus_object:
        distance, of = depth(focus.focus_object.matrix_world.translation), f"focus on '{focus.focus_object.name}'"
    elif focus.use_dof:
        distance, of = focus.focus_distance, "focus"
    else:
        depths = [depth(at @ Vector(corner)) for thing, at in drawn(depsgraph) if thing.type in SURFACES for corner in thing.bound_box]
        near, far = max(min(depths, default=0), camera.data.clip_start), max(depths, default=0)
        distance, of = (near + far) / 2 if far > near else 0, "middle of the visible depths"
    if not distance > 0:
        raise Refusal(f"{of}: is not before the camera '{camera.name}'")
    return distance


def window(camera, distance):
    """Returns centre, width and height of the camera's view at a distance, in camera axes."""
    corners = camera.data.view_frame(scene=bpy.context.scene)
    if camera.data.type == "PERSP":
        corners = [corner * (distance / -corner.z) for corner in corners]
    x, y = [corner.x for corner in corners], [corner.y for corner in corners]
    middle = Vector(((min(x) + max(x)) / 2, (min(y) + max(y)) / 2, -distance))
    return middle, max(x) - min(x), max(y) - min(y)


# Blender's exporter converts 1 W of a lamp to this many lumens, but not the power of emissive surfaces.
LUMENS = 683


def light_copy(thing, scale):
    """Returns a copy of a lamp's data. The power of lamps other than suns is scaled with the square of distances."""
    data = thing.original.data.copy()
    data.energy /= LUMENS
    if data.type != "SUN":
        data.energy *= scale * scale
    return data


def into(collection, data, name, matrix):
    """Creates an object. If its matrix has shear, applies the matrix to the mesh."""
    made = bpy.data.objects.new(name, data)
    if isinstance(data, bpy.types.Mesh):
        plain = Matrix.LocRotScale(*matrix.decompose())
        size = max(abs(number) for row in matrix for number in row)
        if max(abs(a - b) for p, m in zip(plain, matrix) for a, b in zip(p, m)) > 1e-5 * size:
            made.data = data.copy()
            made.data.transform(matrix)
            if matrix.determinant() < 0:
                made.data.flip_normals()
            matrix = Matrix.Identity(4)
    made.matrix_world = matrix
    collection.objects.link(made)
    return made


def copies(depsgraph, frame, scale):
    """Yields copies of all visible meshes and lamps with their names and matrices in the frame of the hologram. Data must
    be copied at once: an object of the depsgraph is invalid in the next iteration."""
    meshes, left = {}, set()
    for thing, at in drawn(depsgraph):
        matrix = frame @ at
        if thing.type in SURFACES:
            key = thing.data.as_pointer()
            if key not in meshes:
                meshes[key] = bpy.data.meshes.new_from_object(thing)
            if meshes[key].polygons:
                yield meshes[key], thing.name, matrix
        elif thing.type == "LIGHT" and thing.data.type != "AREA":
            # The scale of a lamp's axes has no meaning.
            yield light_copy(thing, scale), thing.name, Matrix.LocRotScale(matrix.translation, matrix.to_quaternion(), None)
        elif thing.type == "LIGHT" or thing.type in ("VOLUME", "CURVES", "POINTCLOUD"):
            left.add(f"{'area light' if thing.type == 'LIGHT' else thing.type.lower()} '{thing.name}'")
    for what in sorted(left):
        print(f"note: {what}: not supported by glTF; left out")


def export(camera, wanted):
    """Writes the file. Returns the height of the hologram and the position of the camera relative to it, in metres."""
    if wanted.frame is not None:
        bpy.context.scene.frame_set(wanted.frame)
    depsgraph = bpy.context.evaluated_depsgraph_get()
    distance = plane_distance(camera, wanted, depsgraph)
    middle, width, height = window(camera, distance)
    scale = wanted.width / width
    axes = camera.matrix_world.normalized()  # position and orientation without scale
    frame = Matrix.Scale(scale, 4) @ Matrix.Translation(-middle) @ axes.inverted()
    scene = bpy.data.scenes.new("hologram")
    made = [into(scene.collection, *copy) for copy in list(copies(depsgraph, frame, scale))]
    if not any(thing.type == "MESH" for thing in made):
        raise Refusal("the scene has no surfaces", 3)
    lens = camera.data.copy()
    lens.clip_start, lens.clip_end = lens.clip_start * scale, lens.clip_end * scale
    lens.ortho_scale *= scale
    into(scene.collection, lens, camera.name, frame @ axes @ Matrix.Scale(1 / scale, 4))
    for side in "resolution_x", "resolution_y", "pixel_aspect_x", "pixel_aspect_y":  # determine the aspect ratio of the camera
        setattr(scene.render, side, getattr(bpy.context.scene.render, side))
    bpy.context.window.scene = scene
    folder, name = os.path.split(os.path.abspath(wanted.output))
    if not os.access(folder, os.W_OK):
        raise Refusal(f"{wanted.output}: cannot be written", 4)
    temporary = os.path.join(folder, f".{name[:-4]}.{os.getpid()}.tmp.glb")
    try:
        bpy.ops.export_scene.gltf(
            filepath=temporary, export_format="GLB", export_yup=False, export_cameras=True, export_lights=True,
            use_active_scene=True, export_animations=False, export_apply=False)
        os.replace(temporary, wanted.output)
    except (OSError, RuntimeError) as error:
        raise Refusal(f"{wanted.output}: cannot be written ({str(error).strip().splitlines()[-1]})", 4) from None
    finally:
        if os.path.exists(temporary):
            os.remove(temporary)
    return height * scale, Vector((-middle.x or 0, -middle.y or 0, distance)) * scale


def main():
    wanted = options()
    if not wanted.output.endswith(".glb"):
        raise Refusal(f"{wanted.output}: the file's name must end in .glb")
    camera = camera_of(wanted.camera)
    height, eye = export(camera, wanted)
    rows = max(1, round(256 * height / wanted.width))
    # Field of view that covers the farthest edge of the hologram seen from the camera.
    across, down = (2 * math.degrees(math.atan((side / 2 + abs(off)) / eye.z)) for side, off in ((wanted.width, eye.x), (height, eye.y)))
    width, place = f"{wanted.width * 1e3:.6g}mm", ",".join(f"{part * 1e3:.6g}" for part in eye) + "mm"
    print(f"{wanted.output}: the hologram is {width} x {height * 1e3:.6g}mm; the camera was at {place}")
    print(f"hogel render {wanted.output} -o scene.h5 --as-is --size {width} --hogels 256x{rows} --fov {across:.4g},{down:.4g}deg")
    print(f"hogel photo scene.h5 -o photo.png --eye {place}")


if __name__ == "__main__":
    try:
        main()
    except Refusal as refusal:
        print(f"blender_export.py: {refusal}", file=sys.stderr)
        sys.exit(refusal.status)
