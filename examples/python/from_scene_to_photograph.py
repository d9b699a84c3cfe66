# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # From a scene to photographs of its hologram
#
# The way of everything here: a scene becomes a light field, that becomes a hologram, and the hologram is photographed. Lengths
# are metres and angles radians; `mm` and `deg` make them readable.

# %%
import hogel
from hogel import deg, mm

scene = hogel.Scene.load("pumpkin")
light_field = scene.render(hogels=160, directions=32, size=8 * mm, fov=16 * deg)
print(light_field)

# %% [markdown]
# The hologram in red, green and blue. Nothing is computed before a photograph or a file asks for it. Each *look* has random
# phases of its own; the mean of several shows less speckle.

# %%
hologram = light_field.hologram(pitch="1.5625um", looks=4)
print(hologram)

# %% [markdown]
# Two eyes, 60 mm apart and 300 mm away, see the pumpkin from two sides.

# %%
for name, x in ("left", -30 * mm), ("right", 30 * mm):
    hologram.photograph(eye=(x, 0, 300 * mm), resolution=240).save(f"{name}.png")
# left.png: the pumpkin from the left, by waves of three colours
# right.png: the same pumpkin from the right

# %% [markdown]
# The light field itself, by rays: what the hologram should look like.

# %%
light_field.photograph(resolution=240).save("rays.png")
# rays.png: the pumpkin from the middle, by rays, without speckle
