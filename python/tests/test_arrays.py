# SPDX-License-Identifier: Apache-2.0
"""NumPy arrays share memory with the library, and slices read only their elements."""
import gc
import importlib.util
import pickle
import unittest

import hogel
import hogel._options
import numpy as np
from common import InFolder, light_field, random_array, resident, unless_sanitized


class Tensor:
    """A tensor of another library."""

    def __init__(self, array):
        self.array = array

    def __dlpack__(self, stream=None):
        return self.array.__dlpack__()

    def __dlpack_device__(self):
        return self.array.__dlpack_device__()


class Memory(unittest.TestCase):
    def test_light_fields_are_not_copied(self):
        lf, values = light_field()
        self.assertEqual(np.asarray(lf).ctypes.data, values.ctypes.data)
        self.assertEqual(lf[1:, 2].ctypes.data, values[1:, 2].ctypes.data)
        loaded = lf.load()
        first, second = np.asarray(loaded), np.asarray(loaded)
        self.assertEqual(first.ctypes.data, second.ctypes.data)
        del loaded, lf, second
        gc.collect()
        np.testing.assert_array_equal(first, values)  # its memory lives as long as it does

    def test_nothing_is_copied_on_any_way(self):
        """In and out, light fields, depths and fields: NumPy, the buffer protocol, DLPack, torch where it is installed."""
        radiance, depth, samples = random_array(3, 6, 8, 4, 5), random_array(6, 8, 4, 5), np.ones((6, 8), np.complex64)
        torch = importlib.import_module("torch") if importlib.util.find_spec("torch") else None
        into = {
            "numpy": lambda a: (a, a.ctypes.data),
            "buffer": lambda a: (memoryview(a), a.ctypes.data),
            "dlpack": lambda a: (Tensor(a), a.ctypes.data),
        }
        out = {
            "numpy": lambda x: np.asarray(x).ctypes.data,
            "buffer": lambda x: np.frombuffer(memoryview(np.asarray(x)), np.uint8).ctypes.data,
            "dlpack": lambda x: np.from_dlpack(x).ctypes.data,
        }
        if torch:
            into["torch"] = lambda a: (torch.from_numpy(a), a.ctypes.data)
            out["torch"] = lambda x: torch.from_dlpack(x).data_ptr()
        for way_in, lend in into.items():
            (r, at_r), (d, at_d), (f, at_f) = lend(radiance), lend(depth), lend(samples)
            lf = hogel.LightField.from_array(r, size="1mm", fov="10deg", depth=d)
            field = hogel.Field.from_array(f, pitch="1um", wavelength="633nm")
            for way_out, address in out.items():
                for made, at in (lf, at_r), (lf.faces[0], at_r), (lf.depth, at_d), (field, at_f):
                    with self.subTest(f"{way_in} to {way_out}, {made!r}"):
                        self.assertEqual(address(made), at)
        for made in lf.load(), field.load(), field.propagate("1mm"), lf.load().depth:  # memory of the library
            first = out["numpy"](made)
            for way_out, address in out.items():
                self.assertEqual(address(made), first, way_out)

    def test_fields_and_pictures_are_not_copied(self):
        samples = np.ones((6, 8), np.complex64)
        field = hogel.Field.from_array(samples, pitch="1um", wavelength="633nm")
        self.assertEqual(np.asarray(field).ctypes.data, samples.ctypes.data)
        loaded = field.load()
        self.assertEqual(np.asarray(loaded).ctypes.data, np.asarray(loaded).ctypes.data)
        picture = hogel.Picture(random_array(4, 5, 3))
        self.assertEqual(np.asarray(picture).ctypes.data, picture.pixels.ctypes.data)

    def test_any_strides(self):
        whole = random_array(3, 12, 16, 8, 10)
        for values in (whole[::-1, ::2, ::-2, 1:5, ::3], np.asfortranarray(whole), whole.transpose(0, 2, 1, 4, 3)):
            lf = hogel.LightField.from_array(values, size="1mm", fov="10deg")
            self.assertEqual(np.asarray(lf).ctypes.data, values.ctypes.data)
            np.testing.assert_array_equal(np.asarray(lf.load()), values)
        samples = random_array(8, 9).astype(np.complex64)[::-2, ::3]
        field = hogel.Field.from_array(samples, pitch="1um", wavelength="633nm")
        np.testing.assert_array_equal(np.asarray(field.load()), samples)

    def test_other_numbers_are_converted(self):
        values = random_array(2, 2, 2, 2).astype(np.float64)
        lf = hogel.LightField.from_array(values, size="1mm", fov="10deg")
        np.testing.assert_array_equal(np.asarray(lf)[0], values.astype(np.float32))

    def test_dlpack_both_ways(self):
        values = random_array(1, 2, 3, 4, 5)
        lf = hogel.LightField.from_array(Tensor(values), size="1mm", fov="10deg")
        self.assertEqual(np.asarray(lf).ctypes.data, values.ctypes.data)
        self.assertEqual(np.from_dlpack(lf.load()).shape, values.shape)
        writable = hogel.LightField.from_array(values, size="1mm", fov="10deg")
        self.assertEqual(np.from_dlpack(writable).ctypes.data, values.ctypes.data)

    @unless_sanitized
    def test_nothing_leaks(self):
        values = random_array(1, 4, 4, 4, 4)
        samples = np.ones((8, 8), np.complex64)

        def cycle():
            lf = hogel.LightField.from_array(values, size="1mm", fov="10deg", depth=values[0])
            np.asarray(lf), lf.grid, lf.depth, repr(lf)
            np.asarray(hogel.Field.from_array(samples, pitch="1um", wavelength="633nm"))
            hogel.Picture(values[0, 0, 0])
            try:
                hogel.length("1", "x")
            except hogel.UsageError:
                pass

        for _ in range(1000):
            cycle()
        before = resident()
        for _ in range(10000):
            cycle()
        self.assertLess(resident() - before, 4e6)  # 400 bytes a cycle would show

    @unless_sanitized
    def test_work_does_not_leak(self):
        lf, _ = light_field()
        for _ in range(200):
            lf.load()
        before = resident()
        for _ in range(1000):
            np.asarray(lf.load())
        self.assertLess(resident() - before, 4e6)


class Slices(InFolder):
    def keys(self, shape, count):
        """Random indices, whole numbers, slices of all kinds and ellipses among them."""
        rng = np.random.default_rng(2)

        def part(extent):
            if rng.random() < 0.3:
                return int(rng.integers(-extent, extent))
            ends = [None if rng.random() < 0.3 else int(rng.integers(-extent - 1, extent + 2)) for _ in range(2)]
            return slice(*ends, [None, 1, 2, 3, -1, -2][rng.integers(6)])

        for _ in range(count):
            key = [part(extent) for extent in shape]
            if rng.random() < 0.3:
                cut = sorted(rng.integers(0, len(shape) + 1, 2))
                key[cut[0] : cut[1]] = [Ellipsis]
            yield tuple(key)

    def test_of_files(self):
        lf, values = light_field(hogels=(13, 9))
        lf.save("a.h5", float=True)
        lf.compress("a.hgl", lossless=True)
        for name in "a.h5", "a.hgl":
            read = hogel.LightField.open(name)
            for key in self.keys(read.shape, 60):
                np.testing.assert_array_equal(read.faces[0][key], values[key], err_msg=f"{name} {key}")

    def test_four_indices_are_of_all_channels(self):
        lf, values = light_field(hogels=(13, 12))
        lf.save("a.h5", float=True)
        for read in lf, hogel.LightField.open("a.h5"):
            np.testing.assert_array_equal(read[2:9, :, 3, 1], values[:, 2:9, :, 3, 1])
            np.testing.assert_array_equal(read[1], values[1])
            np.testing.assert_array_equal(read[..., 2], values[..., 2])

    def test_of_fields(self):
        lf, _ = light_field(hogels=(4, 3), directions=(16, 16))
        holo = lf.hologram(wavelength="633nm", pitch="2.2um")
        whole = np.asarray(holo[0])
        for key in self.keys(whole.shape, 20):
            np.testing.assert_array_equal(holo[0][key], whole[key], err_msg=str(key))

    def test_depth(self):
        depth = random_array(6, 8, 4, 5, seed=3)
        lf = hogel.LightField.from_array(random_array(1, 6, 8, 4, 5), size="1mm", fov="10deg", depth=depth)
        lf.save("a.h5", depth=True)
        read = hogel.LightField.open("a.h5")
        np.testing.assert_array_equal(read.depth[2, ::3], depth[2, ::3])
        np.testing.assert_array_equal(np.asarray(read.load().depth), depth)

    def test_wrong_indices(self):
        lf, _ = light_field()
        lf.save("a.h5")
        read = hogel.LightField.open("a.h5")
        for key in (99, (0,) * 6, ([0, 1],), (..., ...), "t"):
            with self.assertRaises(IndexError):
                read[key]

    @unless_sanitized
    def test_a_large_file_is_not_loaded(self):
        big = hogel.LightField.from_function(lambda s, t, u, v: u + v, channels=1, hogels=256, directions=24, size="20mm", fov="16deg")
        big.save("big.h5", float=True)  # 151 MB
        before = resident()
        read = hogel.LightField.open("big.h5")
        part = read[10:12, :, 4, 4]
        self.assertEqual(part.shape, (1, 2, 256))
        self.assertAlmostEqual(part[0, 0, 0], big.grid.u(4) + big.grid.v(4), 6)
        self.assertLess(resident() - before, 60e6)


class Elsewhere(InFolder):
    def test_fields_of_other_programs(self):
        samples = (random_array(12, 16) - 0.5 + 1j * random_array(12, 16, seed=2)).astype(np.complex64)
        np.save("a.npy", samples)
        read = hogel.Hologram.open("a.npy", pitch="2um", wavelength="532nm")
        np.testing.assert_array_equal(np.asarray(read[0]), samples)
        np.testing.assert_array_equal(read[0][3:9:2, ::-3], samples[3:9:2, ::-3])
        other = hogel.Hologram.open("a.npy", pitch="2um", wavelength="532nm", conjugate=True)
        np.testing.assert_array_equal(np.asarray(other[0]), samples.conj())
        read.save("b.mat")
        self.assertEqual(hogel.Hologram.open("b.mat").wavelengths, [532e-9])
        with self.assertRaisesRegex(hogel.UsageError, "^pitch: "):
            hogel.Hologram.open("a.npy", wavelength="532nm")
        with self.assertRaisesRegex(hogel.UsageError, "^wavelength: "):
            hogel.Hologram.open("a.npy", pitch="2um")

    def test_patterns_come_back(self):
        phase = 2 * np.pi * random_array(32, 40)
        wave = hogel.Field.from_array(np.exp(1j * phase), pitch="8um", wavelength="532nm")
        pattern = hogel.Hologram(wave).slm(encoding="phase", pixels=(40, 32), pixel_pitch="8um")
        pattern.save("p.png")
        read = hogel.Hologram.open("p.png", phase_code="hogel", pitch="8um", wavelength="532nm")
        self.assertLess(np.abs(np.asarray(read[0]) - np.exp(1j * phase)).max(), 0.03)
        np.testing.assert_allclose(pattern.transmission(), np.asarray(read[0]), atol=1e-3)
        code = hogel._core.PhaseCode(range=np.pi, offset=1, inverted=True)
        own = hogel.Hologram.open("p.png", phase_code=code, pitch="8um", wavelength="532nm")
        expected = [[code.phase(level, 255) for level in row] for row in np.asarray(pattern)[..., 0]]
        # The file says the power of the light, with which the pattern is as bright as its field.
        shown = np.sqrt(pattern.power[0]) * np.exp(1j * np.array(expected))
        np.testing.assert_allclose(np.asarray(own[0]), shown, atol=1e-6)

    def test_holograms_describe_themselves(self):
        hogel.Hologram(hogel.Field.from_array(random_array(8, 8), pitch="8um", wavelength="532nm")).save("h.h5")
        for option, value in ("pitch", "8um"), ("phase_code", "hogel"), ("conjugate", True):
            with self.assertRaisesRegex(hogel.UsageError, f"^{option}: h.h5 is a hologram") as caught:
                hogel.Hologram.open("h.h5", **{option: value})
            self.assertEqual(caught.exception.parameter, option)
        with self.assertRaisesRegex(TypeError, "did you mean 'wavelength'"):
            hogel.Hologram.open("h.h5", wavelengths="532nm")

    def test_phase_codes_of_patterns_are_texts_or_objects(self):
        samples = np.exp(2j * np.pi * random_array(32, 40)).astype(np.complex64)
        wave = hogel.Field.from_array(samples, pitch="8um", wavelength="532nm")
        device = dict(encoding="phase", pixels=(40, 32), pixel_pitch="8um")
        for text in "hogel", "slmsuite", "range=300deg,offset=-20deg":
            code = hogel._core.parse_phase_code(text)
            self.assertTrue(np.array_equal(wave.slm(**device, phase_code=text), wave.slm(**device, phase_code=code)), text)
        of_no_name = hogel._core.PhaseCode(4.4, -0.3, True)
        levels = np.asarray(wave.slm(**device, phase_code=of_no_name))[:, :, 0]
        for row, column in (0, 0), (7, 11), (31, 39):
            self.assertEqual(levels[row, column], of_no_name.level(float(np.angle(samples[row, column])), 255))

    def test_a_field_is_a_hologram_of_one_wavelength(self):
        noise = random_array(2, 48, 64)
        wave = hogel.Field.from_array((noise[0] + 1j * noise[1]).astype(np.complex64), pitch="4um", wavelength="532nm")
        holo = hogel.Hologram(wave)
        view = dict(pupil="15mm", resolution=16, focus="1mm")
        self.assertTrue(np.array_equal(wave.photograph(**view), holo.photograph(**view)))
        device = dict(encoding="phase", pixels=(40, 32), pixel_pitch="4um")
        self.assertTrue(np.array_equal(wave.slm(**device), holo.slm(**device)))
        with self.assertRaisesRegex(TypeError, "did you mean 'eye'"):
            wave.photograph(eyes="0,0,300mm")

    def test_pictures_of_a_field(self):
        noise = random_array(2, 8, 16) - 0.5
        values = (noise[0] + 1j * noise[1]).astype(np.complex64)
        wave = hogel.Field.from_array(values, pitch="4um", wavelength="532nm")
        shown = {name: np.asarray(wave.picture(name))[..., 0] for name in ("intensity", "amplitude", "phase", "real", "log")}
        grey = np.vectorize(hogel._core.srgb_encode)
        np.testing.assert_allclose(shown["intensity"], abs(values) ** 2, rtol=1e-5)
        np.testing.assert_allclose(shown["amplitude"], abs(values), rtol=1e-5)
        np.testing.assert_allclose(grey(shown["phase"]), 0.5 + np.angle(values) / (2 * np.pi), atol=1e-5)
        np.testing.assert_allclose(grey(shown["real"]), 0.5 + 0.5 * values.real / abs(values).max(), atol=1e-5)
        np.testing.assert_allclose(grey(shown["log"]), 1 + np.log10(shown["intensity"] / shown["intensity"].max()) / 4, atol=1e-5)
        self.assertTrue(np.array_equal(wave.intensity(), wave.picture()))
        with self.assertRaises(hogel.UsageError):
            wave.picture("colour")

    def test_focus_is_found(self):
        points = np.zeros((256, 256), np.complex64)
        points[64::32, 64::32] = 1
        far = hogel.Field.from_array(points, pitch="4um", wavelength="532nm").propagate("3mm")
        found = far.focus(between=("1mm", "5mm"))
        self.assertAlmostEqual(found.planes[0].depth, 3e-3, delta=2 * found.depth_of_focus)


class OwnCode(unittest.TestCase):
    def test_functions(self):
        def colours(s, t, u, v):
            return np.stack(np.broadcast_arrays(s, t, u + v))

        lf = hogel.LightField.from_function(colours, hogels=(7, 5), directions=(3, 4), size="7mm", fov="16deg")
        g = lf.grid
        values = np.asarray(lf)
        self.assertAlmostEqual(values[0, 2, 6, 0, 0], g.s(6), 8)
        self.assertAlmostEqual(values[1, 4, 0, 0, 0], g.t(4), 8)
        self.assertAlmostEqual(values[2, 0, 0, 3, 1], g.u(1) + g.v(3), 6)

    def test_errors_of_functions_arrive(self):
        def broken(s, t, u, v):
            raise KeyError("mine")

        lf = hogel.LightField.from_function(broken, hogels=3, directions=2, size="1mm", fov="10deg")
        with self.assertRaisesRegex(KeyError, "mine"):
            lf.load()

    def test_sinks(self):
        lf, values = light_field()
        seen = np.zeros_like(values)

        def sink(s, t, radiance, depth):
            self.assertIsNone(depth)
            seen[:, t : t + radiance.shape[1], s : s + radiance.shape[2]] = radiance

        lf.stream(sink)
        np.testing.assert_array_equal(seen, values)

    def test_meshes(self):
        square = np.array([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], float)
        scene = hogel.Scene.mesh(square, [(0, 1, 2), (0, 2, 3)], radiance=np.full((4, 3), 0.25))
        lf = scene.render(hogels=8, directions=4, size="1mm", fov="10deg", shading="given")
        self.assertAlmostEqual(float(lf[0, 4, 4, 2, 2]), 0.25, 6)
        with self.assertRaisesRegex(hogel.BadInputError, "4"):
            hogel.Scene.mesh(square, [(0, 1, 4)])
        with self.assertRaises(hogel.UsageError):
            hogel.Scene.mesh(square, [(0.0, 1.0, 2.0)])

    def test_pickles(self):
        lf, _ = light_field()
        camera = hogel.camera("1mm", eye="1,2,300mm", focus="3mm", pupil="4mm")
        field = hogel.Field.from_array(np.ones((2, 3), np.complex64), pitch="1um", wavelength="633nm")
        for value in lf.grid, lf.grid.view, camera, field.grid, hogel.FocalPlane(-0.3, 0.1, 0.1), hogel.Frequencies(0.1, 0.1):
            self.assertEqual(pickle.loads(pickle.dumps(value)), value)

    def test_options_pickle(self):
        """Option values of the extension module survive pickling, with members that differ from the defaults."""
        core = hogel._core
        made = {
            "Modulator": core.Modulator(8, 6, 1e-6, 4, "own"),
            "PatternOptions": core.PatternOptions(core.Modulator(8, 6, 1e-6)),
            "Light": hogel.light((1, 2, 3), "yellow", 2),
            "NamedCamera": core.NamedCamera("left", "near", hogel.camera("1mm")),
            "Sqnr": core.Sqnr(31.0),
            "PixelsPerBit": core.PixelsPerBit(4.0, core.RateRule.planes, 0.1),
            "Step": core.Step(0.1),
            "MaxError": core.MaxError(0.1),
            "FilePart": core.FilePart(2, 3, "input"),
            "HologramRequest": hogel.hologram_request(wavelength="600nm", method="basis", tolerance=0.1, seed=7),
            "LightFieldRequest": hogel.request(hogels=(5, 4), focal_plane=-0.3, samples=2),
        }
        for name in hogel._options.OPTIONS:
            kind = getattr(core, name, None)
            if kind is None:
                continue
            with self.subTest(name):
                value = made[name] if name in made else kind()
                members = hogel._options.members(value)
                for member, old in members.items():
                    if isinstance(old, float) and vars(kind)[member].fset is not None:
                        setattr(value, member, old + 0.125)
                again = pickle.loads(pickle.dumps(value))
                self.assertEqual(again, value)
                self.assertIn(name, repr(again))
                if any(isinstance(old, float) for old in members.values()) and name not in made:
                    self.assertNotEqual(again, kind())

    def test_fields_of_functions(self):
        calls = []

        def wave(x, y):
            calls.append((x.shape, y.shape))
            return np.exp(1e5j * x) * (y > 0)

        field = hogel.Field.from_function(wave, samples=(64, 48), pitch="2um", wavelength="633nm")
        grid = field.grid
        x, y = [grid.x(i) for i in range(64)], [grid.y(j) for j in range(48)]
        expected = (np.exp(1e5j * np.array(x)) * (np.array(y)[:, None] > 0)).astype(np.complex64)
        np.testing.assert_array_equal(field[10:20, 5], expected[10:20, 5])
        self.assertEqual(calls, [((1, 1), (10, 1))])  # no more than was asked for
        np.testing.assert_array_equal(np.asarray(field), expected)
        there = field.propagate("0.2mm")
        self.assertEqual(there.shape, (48, 64))
        broken = hogel.Field.from_function(lambda x, y: x / {}, samples=4, pitch="2um", wavelength="633nm")
        with self.assertRaises(TypeError):
            np.asarray(broken)


if __name__ == "__main__":
    unittest.main()
