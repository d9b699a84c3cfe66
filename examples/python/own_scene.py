# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # A scene from arrays
#
# `Scene.mesh()` takes vertices [n][3] and triangles [m][3], as trimesh (`mesh.vertices`, `mesh.faces`), meshio
# (`mesh.points`, `mesh.cells_dict["triangle"]`) and Blender (`foreach_get`) lend them. Here NumPy winds a tube around a knot.

# %%
import hogel
import numpy as np
from hogel import deg, mm

# A tube around a (2, 3) torus knot: rings of 24 vertices.
steps, ring = 400, 24
angle = np.linspace(0, 2 * np.pi, steps, endpoint=False)
radius = 2 + np.cos(3 * angle)
line = np.stack([radius * np.cos(2 * angle), radius * np.sin(2 * angle), np.sin(3 * angle)], axis=1)
along = np.roll(line, -1, axis=0) - np.roll(line, 1, axis=0)
along /= np.linalg.norm(along, axis=1, keepdims=True)
side = np.cross(along, (0, 0, 1.0))
side /= np.linalg.norm(side, axis=1, keepdims=True)
up = np.cross(side, along)
around = np.linspace(0, 2 * np.pi, ring, endpoint=False)
spokes = np.cos(around)[None, :, None] * side[:, None] + np.sin(around)[None, :, None] * up[:, None]
vertices = (line[:, None] + 0.42 * spokes).reshape(-1, 3)
here = np.arange(steps * ring).reshape(steps, ring)
there, beside = np.roll(here, -1, axis=0), np.roll(here, -1, axis=1)
corner = np.roll(there, -1, axis=1)
triangles = np.concatenate([np.stack([here, there, corner], -1).reshape(-1, 3), np.stack([here, corner, beside], -1).reshape(-1, 3)])
hue = np.repeat(angle, ring)
colours = 0.5 + 0.45 * np.stack([np.cos(hue), np.cos(hue - 2.1), np.cos(hue + 2.1)], axis=1)

# %% [markdown]
# The knot casts shadows on itself. It is placed and lit as a file would be.

# %%
knot = hogel.Scene.mesh(vertices, triangles, normals=spokes.reshape(-1, 3), colors=colours, name="knot")
print(knot)
light_field = knot.render(hogels=200, directions=32, size=10 * mm, fov=20 * deg, shading="shadowed").load()
print(light_field)

# %% [markdown]
# Eight eyes in a row, and a film of them where ffmpeg is installed.

# %%
eyes = [(x * mm, 8 * mm, 250 * mm) for x in np.linspace(-38, 38, 8)]
frames = [light_field.photograph(eye=eye, resolution=200, pupil=4 * mm) for eye in eyes]
rows = [np.concatenate([np.asarray(frame) for frame in frames[k : k + 4]], axis=1) for k in (0, 4)]
hogel.Picture(np.concatenate(rows, axis=0)).save("knot.png")
try:
    hogel.film("knot.gif", frames + frames[-2:0:-1], frame_rate=10)
except hogel.NotBuiltInError:
    print("ffmpeg is not installed: no film")
# knot.png: a knot in the colours of the rainbow from eight directions
# knot.gif: the knot as an eye sees it that moves from side to side
