# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # Waves are arrays
#
# A wave of green light behind two slits. `Field.from_array()` takes any array of NumPy as it is, without a copy.

# %%
import hogel
import numpy as np
from hogel import mm, nm, um

pitch, wavelength = 2 * um, 532 * nm
x = (np.arange(512) - 255.5) * pitch
slits = (np.abs(np.abs(x) - 60 * um) < 15 * um) & (np.abs(x[:, None]) < 300 * um)
field = hogel.Field.from_array(slits.astype(np.complex64), pitch=pitch, wavelength=wavelength)

# %% [markdown]
# hogel propagates by sums of plane waves at whatever samples are asked for; a few lines of NumPy do the same where the
# samples stay where they are.

# %%
def angular_spectrum(samples, distance):
    """The same by Fourier transforms of samples that are padded to four times their side."""
    frequency = np.fft.fftfreq(4 * len(samples), pitch)
    along = np.maximum(0, wavelength**-2 - frequency**2 - frequency[:, None] ** 2) ** 0.5
    spectrum = np.fft.fft2(samples, along.shape) * np.exp(2j * np.pi * along * distance)
    return np.fft.ifft2(spectrum)[: len(samples), : len(samples)]


near = field.propagate(1 * mm)
other = angular_spectrum(np.asarray(field), 1 * mm)
error = np.linalg.norm(np.asarray(near) - other) / np.linalg.norm(other)
print(f"{near}: differs from NumPy's by {error:.1e}")
assert error < 1e-2

# %% [markdown]
# The intensity along a line at growing distances: first two shadows, then fringes.

# %%
rows = [np.abs(field.propagate(z * mm, output_samples=(512, 1))[0]) ** 2 for z in np.linspace(0.05, 20, 48)]
light = np.sqrt(np.repeat(rows, 5, axis=0))  # darker fringes are seen too
colour = np.stack([light * shade for shade in (0.35, 1.0, 0.55)], axis=-1)
hogel.Picture(colour).save("slits.png")
# slits.png: two bands of light behind the slits that spread and make fringes, from 0.05 mm at the top to 20 mm at the bottom
