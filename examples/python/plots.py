# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # Plots
#
# `hogel.plot` draws by matplotlib, a line a plot, with axes in millimetres and degrees.

# %%
import matplotlib

matplotlib.use("Agg")  # draw into files
import hogel
import hogel.plot as plot
from hogel import deg, mm, nm

light_field = hogel.Scene.load("pumpkin").render(hogels=128, directions=32, size=6.4 * mm, fov=16 * deg).load()
hologram = light_field.hologram(wavelength=532 * nm)
camera = dict(resolution=200, pupil=8 * mm)

# %% [markdown]
# Views from nine directions.

# %%
plot.light_field(light_field).savefig("light-field.png", dpi=100)
# light-field.png: nine views of a pumpkin, with axes in millimetres

# %% [markdown]
# Epipolar planes of the middle row and column: position across, direction up.

# %%
plot.epipolar(light_field).savefig("epipolar.png", dpi=100)
# epipolar.png: two epipolar planes: bands that lean, the more the deeper what they show

# %% [markdown]
# The middle of the green fringe, and in which directions it sends light.

# %%
plot.fringe(hologram, side=160).savefig("fringe.png", dpi=100)
# fringe.png: modulus, phase and spectrum of a fringe; the spectrum is an even square out to 8 degrees

# %% [markdown]
# A focal stack by rays.

# %%
plot.focal_stack(light_field, ("-3mm", "0mm", "6mm"), resolution=200, pupil=20 * mm).savefig("focal-stack.png", dpi=100)
# focal-stack.png: photographs in focus in front of, on and behind the hologram

# %% [markdown]
# Waves beside rays.

# %%
plot.twins(light_field.hologram(looks=6), light_field, **camera).savefig("twins.png", dpi=100)
# twins.png: a pumpkin photographed by waves, by rays, and their difference, which is speckle

# %% [markdown]
# How well two coders do at several rates, of a part of the light field.

# %%
small = light_field[:, 48:80, 48:80]
part = hogel.LightField.from_array(small, size=1.6 * mm, fov=16 * deg)
plot.rate_distortion(part, (4, 8, 16, 32), methods={"hogel": {}, "ezw": {"coder": "ezw"}}).savefig("rate-distortion.png", dpi=100)
# rate-distortion.png: signal to error of two coders, which falls with the rays a bit
