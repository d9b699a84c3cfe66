# SPDX-License-Identifier: Apache-2.0
"""Other libraries' arrays and files."""
import importlib.util
import tempfile
import unittest
from pathlib import Path

import hogel
import numpy as np
from common import InFolder, light_field
from hogel import mm, nm, um


def needs(name):
    return unittest.skipUnless(importlib.util.find_spec(name), f"{name} is not installed")


def wave(seed=1, side=64, pitch=2 * um):
    """A field of noise without frequencies near the limit of its samples."""
    noise = np.random.default_rng(seed).normal(size=(2, side, side))
    spectrum = np.fft.fft2(noise[0] + 1j * noise[1])
    frequency = np.abs(np.fft.fftfreq(side))
    spectrum[np.maximum(frequency, frequency[:, None]) > 0.25] = 0
    return hogel.Field.from_array(np.fft.ifft2(spectrum).astype(np.complex64), pitch=pitch, wavelength=532 * nm)


def product(a, b):
    return np.vdot(np.asarray(a, np.complex128), np.asarray(b, np.complex128))


class Adjoint(unittest.TestCase):
    def assert_adjoint(self, f, g, distance, **options):
        there = product(g, f.propagate(distance, **options))
        back = product(g.propagate_adjoint(distance, grid=f.grid), f)
        self.assertLess(abs(there - back), 2e-3 * np.sqrt(abs(product(f, f) * product(g, g))))
        self.assertGreater(abs(there), 0)

    def test_is_that_of_propagation(self):
        for distance in (0, 0.05 * mm, 1 * mm, -0.3 * mm, 10 * mm):
            with self.subTest(distance):
                self.assert_adjoint(wave(1), wave(2), distance)

    def test_of_another_sampling(self):
        g = wave(2, side=48, pitch=3 * um)
        self.assert_adjoint(wave(1), g, 0.4 * mm, output_pitch=3 * um, output_samples=48)
        # Without the areas of the samples it would not hold: 3²/2² is 2.25.
        f = wave(1)
        plain = g.propagate(-0.4 * mm, output_pitch=2 * um, output_samples=64)
        ratio = np.linalg.norm(g.propagate_adjoint(0.4 * mm, grid=f.grid)) / np.linalg.norm(plain)
        self.assertAlmostEqual(ratio, (2 / 3) ** 2, places=4)

    def test_gradient_of_phases(self):
        """The derivative of a focus' intensity by phases, against differences."""
        phase = np.random.default_rng(3).uniform(-3, 3, (32, 32))
        lengths = dict(pitch=4 * um, wavelength=532 * nm)

        def intensity(phase):
            field = hogel.Field.from_array(np.exp(1j * phase).astype(np.complex64), **lengths)
            return field, np.asarray(field.propagate(1 * mm))

        field, far = intensity(phase)
        point = np.zeros_like(far)
        point[16, 16] = 2 * far[16, 16]
        back = hogel.Field.from_array(point, **lengths).propagate_adjoint(1 * mm)
        slope = np.imag(np.conj(np.asarray(field)) * np.asarray(back))
        for y, x in ((16, 16), (3, 20), (30, 5)):
            changed = phase.copy()
            changed[y, x] += 0.05
            more = abs(intensity(changed)[1][16, 16]) ** 2
            changed[y, x] -= 0.1
            less = abs(intensity(changed)[1][16, 16]) ** 2
            self.assertAlmostEqual((more - less) / 0.1, slope[y, x], delta=0.02 * np.abs(slope).max())

    @needs("torch")
    def test_in_torch(self):
        import torch

        import hogel.autograd

        far = {"pitch": 4 * um, "wavelength": 532 * nm, "distance": 1 * mm}
        weight = torch.from_numpy(np.asarray(wave(2, side=16)).copy())

        def loss(phase):
            return (weight.conj() * hogel.autograd.propagate(torch.exp(1j * phase), **far)).real.sum()

        phase = torch.linspace(-3, 3, 256, dtype=torch.float64).reshape(16, 16).requires_grad_()
        torch.autograd.gradcheck(loss, (phase,), eps=0.05, atol=5e-2, rtol=2e-2)


class Libraries(InFolder):
    @needs("scipy")
    def test_angular_spectrum_of_scipy(self):
        import scipy.fft

        field, distance = wave(), 0.2 * mm
        grid = field.grid
        frequency = scipy.fft.fftfreq(4 * grid.width, grid.pitch_x)
        along = np.sqrt(np.maximum(0, field.wavelength**-2 - frequency**2 - frequency[:, None] ** 2))
        spectrum = scipy.fft.fft2(np.asarray(field), along.shape) * np.exp(2j * np.pi * along * distance)
        theirs = scipy.fft.ifft2(spectrum)[: grid.height, : grid.width]
        ours = np.asarray(field.propagate(distance))
        self.assertLess(np.linalg.norm(theirs - ours), 0.02 * np.linalg.norm(ours))

    @needs("torch")
    def test_dlpack_of_torch(self):
        import torch

        tensor = torch.rand(1, 4, 5, 6, 7)
        lf = hogel.LightField.from_array(tensor, size="1mm", fov="10deg")
        self.assertEqual(np.asarray(lf).ctypes.data, tensor.data_ptr())
        self.assertEqual(torch.from_dlpack(lf).data_ptr(), tensor.data_ptr())
        loaded = lf.load()
        self.assertEqual(torch.from_dlpack(loaded).data_ptr(), np.asarray(loaded).ctypes.data)
        samples = torch.rand(8, 9, dtype=torch.complex64)[::2, 1:]
        field = hogel.Field.from_array(samples, pitch=2 * um, wavelength=532 * nm)
        self.assertEqual(np.asarray(field).ctypes.data, samples.data_ptr())
        self.assertTrue(torch.equal(torch.from_dlpack(field.load()), samples))

    def test_meshes_of_other_libraries(self):
        """What trimesh (a subclass of ndarray), meshio (a dictionary of cells) and Fortran's order lend."""

        class Tracked(np.ndarray):
            pass

        corners = np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], float)
        cells = {"triangle": np.array([(0, 1, 2), (0, 2, 3)], np.int64)}
        lent = [
            (corners.view(Tracked), cells["triangle"].view(Tracked)),
            (np.asfortranarray(corners, np.float32), cells["triangle"].astype(np.int32)[:, ::1]),
            (corners[::-1][::-1], cells["triangle"].astype(np.uint32)),
        ]
        options = dict(hogels=8, directions=4, size="1mm", fov="10deg")
        pictures = [np.asarray(hogel.Scene.mesh(*arrays).render(**options)) for arrays in lent]
        self.assertGreater(pictures[0].max(), 0)
        for picture in pictures[1:]:
            np.testing.assert_array_equal(picture, pictures[0])

    @needs("h5py")
    def test_h5py_reads_and_writes(self):
        import h5py

        lf, values = light_field()
        lf.save("lf.h5", float=True)
        with h5py.File("lf.h5", "r+") as file:
            data = next(item for item in file.values() if isinstance(item, h5py.Dataset) and item.ndim == 5)
            self.assertTrue(np.array_equal(data[...], values))
            data[0] = 0
        values[0] = 0
        self.assertTrue(np.array_equal(np.asarray(hogel.LightField.open("lf.h5")), values))

    @needs("xarray")
    def test_xarray_with_names(self):
        import xarray

        lf, values = light_field()
        named = xarray.DataArray(np.asarray(lf), dims=lf.dims, coords=lf.coords)
        self.assertEqual(named.data.ctypes.data, values.ctypes.data)
        self.assertTrue(np.array_equal(named.isel(t=2, u=1), lf.part(t=2, u=1)))
        near = named.sel(s=lf.grid.s(3) + 1e-9, v=lf.grid.v(2), method="nearest")
        self.assertTrue(np.array_equal(near, lf.part(s=3, v=2)))
        field = wave(side=8)
        there = xarray.DataArray(np.asarray(field), dims=field.dims, coords=field.coords)
        self.assertEqual(complex(there.sel(x=field.grid.x(5), y=field.grid.y(2), method="nearest")), complex(field[2, 5]))
        again = hogel.LightField.from_array(named.data, grid=lf.grid)
        self.assertEqual(np.asarray(again).ctypes.data, np.asarray(lf).ctypes.data)

    def read_views(self, read):
        lf, values = light_field(hogels=(24, 16), directions=(3, 3))
        lf = hogel.LightField.from_array(values, size="4mm", fov="10deg", focal_plane="-300mm")
        made = lf.export("views")
        self.assertEqual((made.columns, made.rows, len(made.files)), (3, 3, 9))
        pictures = np.array([np.asarray(read(str(file)))[..., :3] for file in made.files])
        self.assertEqual(pictures.shape, (9, 16, 24, 3))
        again = hogel.import_views("views", size="4mm")
        self.assertEqual(again.shape, lf.shape)
        self.assertLess(np.abs(np.asarray(again) - values).max(), 0.01)
        self.assertIn("3x3", hogel.views_of(again).summary.replace(" ", "").replace("by", "x"))

    @needs("PIL")
    def test_views_by_pillow(self):
        from PIL import Image

        self.read_views(Image.open)

    @needs("cv2")
    def test_views_by_opencv(self):
        import cv2

        self.read_views(lambda name: cv2.imread(name)[..., ::-1])

    @needs("imageio")
    def test_views_by_imageio(self):
        try:
            from imageio.v2 import imread
        except ImportError:  # before 2.16, as in Debian 12, it has no other name
            from imageio import imread

        self.read_views(imread)

    def test_pattern_for_upload(self):
        """What slmsuite's slm.write() takes: rows and columns of the modulator, bytes, in the order of C."""
        shape = (48, 64)
        pattern = hogel.Hologram(wave()).slm(encoding="phase", pixels=shape[::-1], pixel_pitch=2 * um, phase_code="slmsuite")
        levels = np.ascontiguousarray(np.asarray(pattern)[:, :, 0])
        self.assertEqual((levels.shape, levels.dtype), (shape, np.uint8))
        # Their level n is the phase 2 pi (255 - n) / 256.
        shown = np.exp(2j * np.pi * (255.0 - levels) / 256)
        phase = np.exp(1j * np.angle(np.asarray(wave())[8:56]))
        self.assertLess(np.median(np.abs(np.angle(shown * np.conj(phase)))), np.pi / 256)


class OwnRenderers(unittest.TestCase):
    def test_by_name(self):
        seen = []

        def renderer(scene, grid):
            seen.append((len(scene.meshes), grid.hogels_s))
            return lambda s, t, u, v: np.stack(np.broadcast_arrays(s + 0 * t + 0 * u + 0 * v, t + 0 * s + 0 * u + 0 * v, u + 0 * s + 0 * t + 0 * v))

        hogel.add_renderer("positions", renderer)
        lf = hogel.Scene.load("pumpkin").render(algorithm="positions", hogels=(6, 4), directions=3, size=6 * mm)
        self.assertEqual(seen[0][1], 6)
        self.assertGreater(seen[0][0], 0)
        self.assertTrue(np.allclose(lf.part(c=0, t=0, v=0, u=0), (np.arange(6) - 2.5) * 1e-3))
        with self.assertRaisesRegex(hogel.UsageError, "a renderer of hogel"):
            hogel.add_renderer("epi", renderer)

    def test_light_of_a_scene(self):
        """A ray tracer of one's own asks for the radiance of points of triangles: that of a tilted square, as epi shows it."""
        square = np.array([(-1, -1, -0.2), (1, -1, -0.2), (1, 1, 0.2), (-1, 1, 0.2)])
        scene = hogel.Scene.mesh(square, [(0, 1, 2), (0, 2, 3)], colors=np.linspace(0.2, 1, 12).reshape(4, 3))
        wanted = hogel.request(hogels=8, directions=4, size="1mm", fov="10deg")
        shaded = hogel._core.light_scene(scene.placed(wanted), wanted, None)
        corners, triangles = shaded.positions, shaded.triangles
        self.assertEqual(triangles.shape, (2, 3))
        epi = hogel._core.make_renderer("epi", shaded, wanted.grid)
        shown = np.asarray(hogel.LightField(epi, "rendered when read"))
        grid = wanted.grid
        tried = 0
        for number in range(2):
            a, b, c = corners[triangles[number]]
            for j, i, l, k in np.ndindex(8, 8, 4, 4):
                # The ray x = s + U zeta, y = t + V zeta, zeta = -z meets the triangle at a + p (b - a) + q (c - a).
                start, along = np.array([grid.s(i), grid.t(j), 0]), np.array([grid.u(k), grid.v(l), -1])
                p, q, _ = np.linalg.solve(np.stack([b - a, c - a, -along], axis=1), start - a)
                if min(p, q, 1 - p - q) < 0.02:
                    continue
                light = hogel._core.radiance_at(shaded, [number], [[1 - p - q, p, q]], [-along / np.linalg.norm(along)], [0])
                np.testing.assert_allclose(light[0], shown[:, j, i, l, k], atol=2e-3)
                np.testing.assert_array_equal(hogel._core.opacity_at(shaded, [number], [[1 - p - q, p, q]], [(0, 0, 1)], [0]), 1)
                tried += 1
        self.assertGreater(tried, 50)
        with self.assertRaisesRegex(hogel.UsageError, "number 7"):
            hogel._core.radiance_at(shaded, [7], [[1, 0, 0]], [(0, 0, 1)], [0])


class Films(InFolder):
    def test_film(self):
        frames = [np.full((16, 24, 3), level, np.float32) for level in (0.1, 0.5, 1)]
        try:
            hogel.film("f.gif", frames, frame_rate=5)
        except hogel.NotBuiltInError as error:
            self.assertIn("ffmpeg", str(error))
            self.skipTest("ffmpeg is not installed")
        self.assertEqual(Path("f.gif").read_bytes()[:3], b"GIF")
        with self.assertRaisesRegex(hogel.UsageError, "equal size"):
            hogel.film("f.gif", [np.zeros((2, 2)), np.zeros((3, 2))])


class PlansAndResume(InFolder):
    def test_plans(self):
        lf = hogel.Scene.load("pumpkin").render(hogels=64, directions=16, size=2 * mm)
        plan = lf.plan()
        self.assertGreaterEqual(plan.disk, 64 * 64 * 16 * 16 * 3 * 2)
        self.assertLess(plan.disk, 1.2 * 64 * 64 * 16 * 16 * 3 * 2)
        self.assertGreater(plan.memory, 0)
        lf.save("lf.h5")
        self.assertLess(abs(Path("lf.h5").stat().st_size - plan.disk), 0.1 * plan.disk)
        self.assertGreaterEqual(lf.hologram(wavelength=532 * nm).plan().disk, 1280 * 1280 * 8)
        with self.assertRaisesRegex(hogel.UsageError, "rendered"):
            light_field()[0].plan()

    def test_resume(self):
        """Stopped and called again gives the bytes of a call that was not stopped."""
        options = dict(hogels=96, directions=16, size=4 * mm)
        scene = hogel.Scene.load("pumpkin")
        scene.render(**options).save("whole.h5")

        class Stop(Exception):
            pass

        def stop(fraction):
            if fraction > 0.2:
                raise Stop

        try:
            with hogel._core.ThreadLimit(1) if hasattr(hogel._core.ThreadLimit, "__enter__") else tempfile.TemporaryDirectory():
                scene.render(**options, progress=False).save("lf.h5", resume=True, progress=stop)
        except Stop:
            # The last report comes when all is done, and a quick machine gives no other.
            self.assertTrue(Path("lf.h5.part").exists() or Path("lf.h5").exists())
        scene.render(**options).save("lf.h5", resume=True)
        self.assertEqual(Path("lf.h5").read_bytes(), Path("whole.h5").read_bytes())
        with self.assertRaisesRegex(hogel.UsageError, "resume"):
            light_field()[0].save("x.h5", resume=True)


if __name__ == "__main__":
    unittest.main()
