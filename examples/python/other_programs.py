# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # Beside other programs
#
# h5py reads hogel's files, xarray names the axes of its arrays, OpenCV, imageio or Pillow change its views, and scipy
# propagates its holograms as odak does.

# %%
import h5py
import hogel
import numpy as np
import scipy.fft
from hogel import deg, mm, nm

scene = hogel.Scene.load("chandelier")
scene.render(hogels=96, directions=16, size=4.8 * mm, fov=12 * deg, focal_plane=-300 * mm).save("views.h5")

# %% [markdown]
# h5py: a dataset [c][t][s][v][u], which is read by slices there too.

# %%
with h5py.File("views.h5") as file:
    names = [name for name, item in file.items() if isinstance(item, h5py.Dataset)]
    values = file[names[0]]
    middle = values[:, :, :, values.shape[3] // 2, values.shape[4] // 2]
    print(f"h5py: {names[0]}{values.shape}, {values.dtype}")
light_field = hogel.LightField.open("views.h5")
assert np.array_equal(middle.astype(np.float32), light_field.part(v=8, u=8))

# %% [markdown]
# xarray: the same with names and coordinates, so that a direction is asked for by its tangent.

# %%
try:
    import xarray

    named = xarray.DataArray(np.asarray(light_field), dims=light_field.dims, coords=light_field.coords)
    print(f"xarray: {named.sel(u=0, v=0, method='nearest').shape} looks straight on")
except ImportError:
    print("xarray is not installed")

# %% [markdown]
# Views: pictures of a camera array, changed by another program, and a light field again. The stripes are on the pictures, so
# they are on the plane of the hologram.

# %%
light_field.export("views", force=True)
try:
    import cv2

    read, write = (lambda name: cv2.imread(name)[..., ::-1]), (lambda name, p: cv2.imwrite(name, p[..., ::-1]))
except ImportError:
    try:
        import imageio

        read, write = imageio.imread, imageio.imwrite
    except ImportError:
        from PIL import Image

        read, write = (lambda name: np.asarray(Image.open(name))), (lambda name, p: Image.fromarray(p).save(name))
for row in range(16):
    for column in range(16):
        name = f"views/{row:03}_{column:03}.png"
        view = np.asarray(read(name))
        view = np.where(np.indices(view.shape[:2]).sum(axis=0)[..., None] % 24 < 3, view // 2, view)  # stripes on the plane
        write(name, np.ascontiguousarray(view.astype(np.uint8)))
striped = hogel.import_views("views", size=4.8 * mm)
print(striped)
tiles = [np.moveaxis(striped.part(v=8, u=u), 0, -1) for u in (0, 8, 15)]
hogel.Picture(np.concatenate(tiles, axis=1)).save("views.png")
# views.png: a chandelier with stripes across it from the left, the middle and the right

# %% [markdown]
# scipy: the angular spectrum of a hologram, as odak has it, against hogel's.

# %%
parallel = scene.render(hogels=128, directions=24, size=4 * mm, fov=12 * deg)
field = parallel.hologram(wavelength=532 * nm, pitch="2.5um").load()[0]
samples, plane = np.asarray(field), field.grid


def angular_spectrum(samples, distance):
    """Padded to twice the side, without the waves that leave the window."""
    rows, columns = (2 * length for length in samples.shape)
    fy = scipy.fft.fftfreq(rows, plane.pitch_y)[:, None]
    fx = scipy.fft.fftfreq(columns, plane.pitch_x)[None]
    along = np.sqrt(np.maximum(0, field.wavelength**-2 - fx**2 - fy**2))
    spectrum = scipy.fft.fft2(samples, (rows, columns), workers=2) * np.exp(2j * np.pi * distance * along)
    return scipy.fft.ifft2(spectrum, workers=2)[: samples.shape[0], : samples.shape[1]]


depth = 1 * mm
theirs, ours = angular_spectrum(samples, -depth), np.asarray(field.propagate(-depth))
error = np.linalg.norm(theirs - ours) / np.linalg.norm(ours)
print(f"scipy's angular spectrum differs by {error:.1e}")
assert error < 1e-2
back = hogel.Field.from_array(theirs.astype(np.complex64), grid=plane, wavelength=field.wavelength)
again = np.linalg.norm(np.asarray(back.propagate(depth)) - samples) / np.linalg.norm(samples)
print(f"there by scipy and back by hogel: {again:.1e}, of which light that left the window is a part")
assert again < 0.2

# %% [markdown]
# The hologram in focus at three depths, by scipy alone.

# %%
stack = []
for depth in (-1 * mm, 0.2 * mm, 2 * mm):
    light = np.abs(angular_spectrum(samples, -depth)) ** 2
    side = 6  # the mean of squares of samples, against speckle
    rows, columns = (length // side for length in light.shape)
    stack.append(light[: rows * side, : columns * side].reshape(rows, side, columns, side).mean(axis=(1, 3)))
hogel.Picture(np.concatenate(stack, axis=1)).save("refocused.png")
# refocused.png: a chandelier in focus at three depths
