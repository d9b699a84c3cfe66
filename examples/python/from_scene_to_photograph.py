# SPDX-License-Identifier: Apache-2.0
"""From a scene to photographs of its hologram: writes left.png, right.png and rays.png."""
import hogel
from hogel import deg, mm

scene = hogel.Scene.load("pumpkin")
light_field = scene.render(hogels=160, directions=32, size=8 * mm, fov=16 * deg)
print(light_field)

# Red, green and blue. Nothing is computed before a photograph or a file asks for it.
hologram = light_field.hologram(pitch="1.5625um", looks=4)
print(hologram)

for name, x in ("left", -30 * mm), ("right", 30 * mm):
    hologram.photograph(eye=(x, 0, 300 * mm), resolution=240).save(f"{name}.png")
light_field.photograph(resolution=240).save("rays.png")
