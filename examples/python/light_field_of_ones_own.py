# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # A light field from a formula
#
# Any function of rays is a light field: here a chequered wall 6 mm behind the hologram and a ring 4 mm in front of it.

# %%
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

# %% [markdown]
# The function gets arrays whose axes are those of a light field, and returns radiances that can be broadcast to it.

# %%
light_field = hogel.LightField.from_function(radiance, hogels=240, directions=24, size=12 * mm, fov=16 * deg).load()
print(light_field)

# %% [markdown]
# What the hologram shows from three directions: the ring moves against the wall.

# %%
views = [light_field[:, :, 12, u] for u in (0, 12, 23)]  # [c][t][s], all channels
hogel.Picture(np.moveaxis(np.concatenate(views, axis=2), 0, -1)).save("views.png", exposure=1)
# views.png: the ring and the wall from the left, the middle and the right

# %% [markdown]
# Photographs with a wide lens, in focus before, on and behind the hologram.

# %%
stack = [light_field.photograph(focus=focus, pupil=20 * mm, resolution=240) for focus in ("-4mm", "0mm", "6mm")]
hogel.Picture(np.concatenate([np.asarray(picture) for picture in stack], axis=1)).save("photographs.png", exposure=1)
# photographs.png: the ring is sharp in the first photograph, the wall in the last
