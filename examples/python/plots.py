# SPDX-License-Identifier: Apache-2.0
"""hogel.plot, a line a plot: what a light field, its hologram and their photographs look like. Writes six pictures."""
import matplotlib

matplotlib.use("Agg")  # draw into files
import hogel
import hogel.plot as plot
from hogel import deg, mm, nm

light_field = hogel.Scene.load("pumpkin").render(hogels=128, directions=32, size=6.4 * mm, fov=16 * deg).load()
hologram = light_field.hologram(wavelength=532 * nm)
camera = dict(resolution=200, pupil=8 * mm)

plot.light_field(light_field).savefig("light-field.png", dpi=100)
plot.epipolar(light_field).savefig("epipolar.png", dpi=100)
plot.fringe(hologram, side=160).savefig("fringe.png", dpi=100)
plot.focal_stack(light_field, ("-3mm", "0mm", "6mm"), resolution=200, pupil=20 * mm).savefig("focal-stack.png", dpi=100)
plot.twins(light_field.hologram(looks=6), light_field, **camera).savefig("twins.png", dpi=100)
small = light_field[:, 48:80, 48:80]
part = hogel.LightField.from_array(small, size=1.6 * mm, fov=16 * deg)
plot.rate_distortion(part, (4, 8, 16, 32), methods={"hogel": {}, "ezw": {"coder": "ezw"}}).savefig("rate-distortion.png", dpi=100)
