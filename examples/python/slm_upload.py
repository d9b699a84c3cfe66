# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # Patterns for a light modulator
#
# Programs that drive a modulator take an array of bytes: slmsuite's `slm.write()`, or OpenCV's window on a second screen.

# %%
import hogel
import numpy as np
from hogel import deg, mm, nm, um

light_field = hogel.Scene.load("tower").render(hogels=(75, 60), directions=20, size=4.8 * mm, fov=3 * deg)
hologram = light_field.hologram(wavelength=532 * nm, pitch=8 * um).load()

# %% [markdown]
# A class of NumPy stands for the modulator, with the contract of slmsuite's classes, and shows what an eye would see on it.

# %%
class Modulator:
    """What slmsuite's classes have: a shape (rows, columns), bits, and write() of an array of grey levels."""

    shape, bitdepth, pitch = (512, 640), 8, 8 * um

    def write(self, levels):
        assert levels.shape == self.shape and levels.dtype == np.uint8 and levels.flags.c_contiguous
        self.levels = levels

    def photograph(self, wavelength):
        """What an eye sees on it, of an even beam. slmsuite's level n is the phase 2 pi (255 - n) / 256."""
        wave = np.exp(2j * np.pi * (255.0 - self.levels) / 256).astype(np.complex64)
        field = hogel.Field.from_array(wave, pitch=self.pitch, wavelength=wavelength)
        return hogel.Hologram(field).photograph(eye=(0, 0, 300 * mm), pupil=9 * mm, resolution=200)

# %% [markdown]
# Three encodings of the same hologram: its phase alone, pairs of phases, and a phase found by descent.

# %%
modulator = Modulator()
shown = []
for encoding in ("phase", "double-phase", "gradient"):
    pattern = hologram.slm(encoding=encoding, pixels=modulator.shape[::-1], pixel_pitch=modulator.pitch, phase_code="slmsuite")
    modulator.write(np.ascontiguousarray(np.asarray(pattern)[:, :, 0]))
    picture = np.asarray(modulator.photograph(532 * nm))
    shown.append(picture / np.quantile(picture, 0.99))
    print(pattern)
hogel.Picture(np.concatenate(shown, axis=1)).save("shown.png", exposure=1)
pattern.save("pattern.png")
# shown.png: a tower as an eye sees it by three encodings: the phase alone, double phases, and the phase by descent
# pattern.png: the levels of the last pattern
