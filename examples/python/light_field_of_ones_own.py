# SPDX-License-Identifier: Apache-2.0
"""A light field from a formula in NumPy: a chequered wall 6 mm behind the hologram and a ring in front of it. Writes
views.png (what the hologram shows from three directions) and photographs.png (in focus before, on and behind the
hologram)."""
import hogel
import numpy as np
from hogel import deg, mm


def radiance(s, t, u, v):
    """A ray is at (s + u z, t + v z) at the depth z behind the hologram."""
    x, y = s + u * 6 * mm, t + v * 6 * mm
    wall = 0.15 + 0.5 * ((np.floor(x / mm) + np.floor(y / mm)) % 2)
    distance = np.hypot(s - u * 4 * mm, t - v * 4 * mm)
    ring = np.abs(distance - 3 * mm) < 0.6 * mm
    return np.stack([np.where(ring, 1.0, wall * shade) for shade in (0.5, 0.7, 1.0)])


light_field = hogel.LightField.from_function(radiance, hogels=240, directions=24, size=12 * mm, fov=16 * deg).load()
print(light_field)

views = [light_field[:, :, 12, u] for u in (0, 12, 23)]  # [c][t][s], all channels
hogel.Picture(np.moveaxis(np.concatenate(views, axis=2), 0, -1)).save("views.png", exposure=1)

stack = [light_field.photograph(focus=focus, pupil=20 * mm, resolution=240) for focus in ("-4mm", "0mm", "6mm")]
hogel.Picture(np.concatenate([np.asarray(picture) for picture in stack], axis=1)).save("photographs.png", exposure=1)
