# SPDX-License-Identifier: Apache-2.0
"""hogel.plot: axes are in millimetres and degrees, and say where things are."""
import importlib.util
import subprocess
import sys
import unittest

import hogel
import numpy as np
from hogel import deg, mm, nm

if importlib.util.find_spec("matplotlib") is not None:
    import matplotlib

    matplotlib.use("Agg")
    import hogel.plot as plot
    from matplotlib import pyplot


@unittest.skipUnless(importlib.util.find_spec("matplotlib"), "matplotlib is not installed")
class Plots(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        # A wall at the hologram whose brightness grows to the right, with a bright stripe for positive u.
        def radiance(s, t, u, v):
            return 0.2 + 0.1 * s / mm + 0.6 * (u > 0.06) + 0 * (t + v)

        cls.lf = hogel.LightField.from_function(radiance, channels=1, hogels=(16, 12), directions=8, size=4 * mm, fov=16 * deg).load()

    def tearDown(self):
        pyplot.close("all")

    def test_light_field(self):
        figure = plot.light_field(self.lf, columns=3, rows=2)
        left, _, right = figure.axes[:3]
        self.assertEqual(np.round(left.images[0].get_extent(), 6).tolist(), [-2, 2, -1.5, 1.5])
        # The eye at the left sees rays that run to the left, of positive u: the brighter ones.
        self.assertIn("from -", left.get_title())
        self.assertGreater(left.images[0].get_array().mean(), right.images[0].get_array().mean())

    def test_epipolar(self):
        across, down = plot.epipolar(self.lf).axes
        extent = across.images[0].get_extent()
        self.assertAlmostEqual(extent[0], -2)
        self.assertAlmostEqual(abs(extent[2]), 8, delta=0.05)
        plane = across.images[0].get_array()[..., 0]
        self.assertEqual(plane.shape, (8, 16))
        self.assertTrue((np.diff(plane, axis=1) >= 0).all())  # brighter to the right
        # The row of the largest angle, which the axis says, is the bright one.
        top_is_large = extent[3] > extent[2]
        self.assertEqual(plane[0].mean() > plane[-1].mean(), top_is_large)
        self.assertIn("mm", across.get_xlabel())
        self.assertIn("degrees", across.get_ylabel())

    def test_fringe_shows_where_light_goes(self):
        pitch, wavelength = 2e-6, 532 * nm
        x = (np.arange(128) - 63.5) * pitch
        y = -x[:, None]  # row 0 is at the top
        going = np.exp(2j * np.pi / wavelength * (np.sin(3 * deg) * x + np.sin(5 * deg) * y))
        field = hogel.Field.from_array(going.astype(np.complex64), pitch=pitch, wavelength=wavelength)
        axis = plot.fringe(field).axes[2]
        picture, (left, right, low, high) = axis.images[0].get_array(), axis.images[0].get_extent()
        row, column = np.unravel_index(np.argmax(picture), picture.shape)
        self.assertAlmostEqual(left + (column + 0.5) / 128 * (right - left), 3, delta=0.3)
        self.assertAlmostEqual(high - (row + 0.5) / 128 * (high - low), 5, delta=0.3)

    def test_photographs(self):
        stack = plot.focal_stack(self.lf, ("-1mm", 0, "1mm"), resolution=20)
        self.assertIn("in front", stack.axes[0].get_title())
        self.assertEqual(np.round(stack.axes[0].images[0].get_extent(), 6).tolist(), [-2, 2, -1.5, 1.5])
        holo = self.lf.hologram(wavelength=532 * nm, pitch="1.9um")
        self.assertIn("PSNR", plot.twins(holo, self.lf, resolution=10, pupil=20 * mm).axes[2].get_title())

    def test_rate_distortion(self):
        lf = hogel.Scene.load("pumpkin").render(hogels=32, directions=8, size=2 * mm)
        axis = plot.rate_distortion(lf, (1, 4, 4096), methods={"a": {"coder": "hogel"}, "b": {"coder": "ezw", "transform": "haar"}}).axes[0]
        self.assertEqual([text.get_text() for text in axis.texts], ["a", "b"])
        for line in axis.lines:
            self.assertGreater(line.get_ydata()[0], line.get_ydata()[1])


class WithoutMatplotlib(unittest.TestCase):
    def test_says_what_to_install(self):
        word = "import sys; sys.modules['matplotlib'] = None; import hogel, hogel.plot as p, numpy as n; p.fringe(hogel.Field.from_array(n.ones((4, 4), 'F'), pitch='2um', wavelength='633nm'))"
        done = subprocess.run([sys.executable, "-c", word], capture_output=True, text=True)
        self.assertIn("NotBuiltInError: plot: needs matplotlib", done.stderr)


if __name__ == "__main__":
    unittest.main()
