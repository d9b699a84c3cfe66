# SPDX-License-Identifier: Apache-2.0
"""Errors are of the fitting classes and name what was wrong; units are taken everywhere."""
import re
import unittest
import warnings
from pathlib import Path

import hogel
import numpy as np
from common import SOURCES, InFolder, command_line, light_field
from hogel import deg, mm, um


class Errors(InFolder):
    def test_classes(self):
        lf, _ = light_field()
        Path("torn.h5").write_bytes(b"\x89HDF\r\n\x1a\n torn")
        cases = [
            (lambda: lf.photograph(eye="0,0,-1mm"), hogel.UsageError, ValueError, "usage", 2),
            (lambda: hogel.open("torn.h5"), hogel.BadInputError, ValueError, "bad_input", 3),
            (lambda: hogel.Scene.load("nothing.ply"), hogel.BadInputError, ValueError, "bad_input", 3),
            (lambda: lf.save("no/folder.h5"), hogel.CannotWriteError, OSError, "cannot_write", 4),
            (lambda: hogel.Picture(np.ones((2, 2))).save("a.tif"), hogel.NotBuiltInError, NotImplementedError, "not_built_in", 5),
        ]
        for work, kind, builtin, name, status in cases:
            with self.subTest(name), self.assertRaises(kind) as caught:
                work()
            self.assertIsInstance(caught.exception, hogel.Error)
            self.assertIsInstance(caught.exception, builtin)
            self.assertEqual((caught.exception.name, caught.exception.status), (name, status))
            self.assertEqual(len(str(caught.exception).splitlines()), 1)

    def test_parameters(self):
        lf, _ = light_field()
        cases = [
            (lambda: lf.photograph(pupil=-1), "pupil"),
            (lambda: lf.save("a.hgl", sqnr=-1), "sqnr"),
            (lambda: hogel.Scene.load("sphere").render(algorithm="magic"), "algorithm"),
            (lambda: lf.hologram(pitch="50um"), "fov, pitch"),
            (lambda: hogel.open("nothing.h5"), ""),
            (lambda: hogel.Scene.load("sphere").hologram(method="fourier"), "method"),
            (lambda: hogel.Scene.load("sphere").hologram(method="points", size="1um"), "size, pitch"),
            (lambda: hogel.Scene.load("sphere").hologram(method="points", cull_back_faces=True), "cull_back_faces"),
            (lambda: hogel.import_views(".", spacing="1mm", fov="16deg"), "spacing, fov"),
            (lambda: lf.export("views", layout="magic"), "layout"),
            (lambda: lf.photograph(cameras=[hogel.camera(0.01)], eye="0,0,1m"), "cameras, eye"),
            # Values that are something else than their keyword takes.
            (lambda: hogel.request(size=False), "size"),
            (lambda: hogel.request(hogels=True), "hogels"),
            (lambda: hogel.request(fov=1e308), "fov"),
            (lambda: hogel.request(fov=(0.1, 0.2, 0.3)), "fov"),
            (lambda: hogel.request(hemicube=float("nan")), "hemicube"),
            (lambda: hogel.request(algorithm="\ud800"), "algorithm"),
            (lambda: hogel.hologram_request(looks=-1), "looks"),
            (lambda: hogel.hologram_request(looks=2.5), "looks"),
            (lambda: lf.compress("a.hgl", lossless=np.array([1, 2])), "lossless"),
            (lambda: hogel.Scene.load("sphere", move=b"5mm"), "move"),
            (lambda: hogel.Scene.load("sphere", colour=(-1, 0, 0)), "colour"),
            (lambda: hogel.Scene.load("sphere", light=5), "light"),
            (lambda: hogel.Scene.load("sphere", light=[None]), "light"),
            # Errors of the module's own.
            (lambda: lf.photograph(pupil=1, f_number=2), "pupil, f_number"),
            (lambda: lf.save("a.hgl", half=True, resume=True), "resume"),
            (lambda: lf.hologram().photograph(expected=True, diffuser="vertical"), "expected"),
            (lambda: lf.hologram().slm(pixels=8), "pixels, pixel_pitch"),
            (lambda: hogel.Scene.load("sphere").render(hogels=0), "hogels"),
            (lambda: hogel.Field.from_array(np.ones((2, 2), np.complex64), wavelength=1e-6), "pitch"),
            (lambda: hogel.Picture(np.ones((2, 2, 2))), "pixels"),
            (lambda: hogel.angle("16", "fov"), "fov"),
            (lambda: hogel.film("film.mp3", []), ""),
        ]
        # What is off excludes nothing, an array without axes is a number, and one light needs no list.
        self.assertEqual(hogel.request(hemicube=np.False_, toward="5deg"), hogel.request(hemicube=0, toward="5deg"))
        self.assertEqual(hogel.request(size=np.array(0.01)), hogel.request(size="10mm"))
        self.assertEqual(len(hogel.Scene.load("sphere", light=hogel.light((1, 2, 3)))._pose.lights), 1)
        for work, parameter in cases:
            with self.subTest(parameter), self.assertRaises(hogel.Error) as caught:
                work()
            self.assertEqual(caught.exception.parameter, parameter)

    def test_texts_of_strangers_are_one_plain_line(self):
        name = "torn\x1b[31m\n" + 200 * "x" + ".h5"
        with self.assertRaises(hogel.UsageError) as caught:
            hogel.length("12\x1b[2J\n\u202e" + 500 * "x", "size")
        with self.assertRaises(hogel.BadInputError) as missing:
            hogel.Scene.load(name)
        for error in (caught.exception, missing.exception):
            self.assertTrue(str(error).isprintable(), repr(str(error)))
            self.assertLessEqual(len(str(error)), 403)

    def test_a_pitch_that_is_not_given_diffracts_the_field_of_view(self):
        wide = hogel.Scene.load("sphere").render(hogels=4, directions=8, size="0.2mm", fov=40 * deg)
        with self.assertWarnsRegex(UserWarning, "^pitch: .*, as the field of view needs; the default, 1.5625 um, is too coarse$"):
            made = wide.hologram(wavelength="532nm")
        self.assertLess(made.grid.pitch_x, 0.532e-6 / (2 * np.sin(20 * deg)))
        with self.assertRaisesRegex(hogel.UsageError, "pitch"):
            wide.hologram(wavelength="532nm", pitch="1.5625um")
        narrow, _ = light_field()
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertAlmostEqual(narrow.hologram(wavelength="532nm").grid.pitch_x, hogel.defaults["pitch"], delta=0.1e-6)

    def test_messages_name_the_keyword(self):
        lf, _ = light_field()
        scene = hogel.Scene.load("pumpkin")
        cases = [
            (lambda: scene.render(size="16"), "^size: "),
            (lambda: scene.render(fov="16"), "^fov: "),
            (lambda: scene.render(hogels="16by16"), "^hogels: "),
            (lambda: scene.render(hogels=2.5), "^hogels: "),
            (lambda: scene.render(algorithm="epy"), "did you mean 'epi'"),
            (lambda: scene.render(size=float("nan")), "^size: "),
            (lambda: lf.hologram(wavelength="red"), "^wavelength: "),
            (lambda: lf.hologram(method="fourrier"), "fourier"),
            (lambda: lf.hologram(phase="odd"), "^phase: "),
            (lambda: lf.compress("a.hgl", sqnr=40, ppb=8), "only one"),
            (lambda: lf.compress("a.h5"), "hgl"),
            (lambda: lf.save("a.hgl", float=True), "^float: "),
            (lambda: lf.photograph(focus_tilt="95deg"), "^focus_tilt: "),
            (lambda: hogel.import_views(".", column="third"), "^column: "),
            (lambda: lf.export("views", pictures="gif"), "^pictures: "),
            (lambda: lf.print("prints", order="columns"), "^order: "),
            (lambda: hogel.write_cameras("cameras.json", distance="-1m"), "^distance: "),
            (lambda: scene.bake("baked.glb", rays=0), "^rays: "),
            (lambda: lf.photograph(pupil=1, f_number=2), "^pupil, f_number: "),
            (lambda: lf.hologram().photograph(camera="best"), "^camera: "),
            (lambda: lf.hologram().photograph(camera="narrow", expected=True), "^expected: "),
            (lambda: lf.hologram().load().photograph(preview=True), "^preview: "),
            (lambda: lf.hologram().photograph(film_distance="20mm"), "^film_distance: "),
            (lambda: hogel.Scene.load("pumpkin", up="w"), "^up: "),
            (lambda: hogel.Scene.load("pumpkin", colour="orange"), "^colour: "),
            (lambda: hogel.LightField.from_array(np.ones((2, 2))), "^radiance: "),
            (lambda: hogel.Field.from_array(np.ones((2, 2)), wavelength=1), "^pitch: "),
            (lambda: scene.render(size=20), r"20 m wide; .* 20\*mm"),
            (lambda: lf.hologram(wavelength=633), r"633 m; .* 633\*nm"),
            (lambda: hogel.Field.from_array(np.ones((2, 2)), wavelength=633, pitch="1um"), r"633 m; .* 633\*nm"),
        ]
        for number, (work, pattern) in enumerate(cases):
            with self.subTest(f"{number} {pattern}"):
                with self.assertRaisesRegex(hogel.UsageError, pattern) as caught:
                    work()
                if pattern.startswith("^"):
                    self.assertEqual(caught.exception.parameter, pattern[1:-2])

    def test_every_raise_names_its_parameter(self):
        # usage_error() takes the parameter; the rest are about the whole call of a function, or a file.
        calls = r"part|plan|photograph|slm|hologram|add_renderer|film|{name}"
        for source in sorted((SOURCES / "python" / "hogel").glob("*.py")):
            if source.name != "errors.py":
                for text in re.findall(r"\bUsageError\(.*", source.read_text()):
                    self.assertRegex(text, rf'^UsageError\(f?"({calls}): ', source.name)

    def test_an_unknown_option_names_the_function_that_was_called(self):
        lf, _ = light_field()
        scene = hogel.Scene.load("pumpkin")
        cases = [
            (lambda: scene.render(hogel=16), r"^Scene\.render\(\) .* 'hogel'; did you mean 'hogels'\?$"),
            (lambda: scene.advise(sizes=1), r"^Scene\.advise\(\) .*'size'"),
            (lambda: scene.hologram(methods="points"), r"^Scene\.hologram\(\) .*'method'"),
            (lambda: hogel.LightField.from_function(abs, hogel=1), r"^LightField\.from_function\(\) .*'hogels'"),
            (lambda: lf.photograph(resolutions=3), r"^LightField\.photograph\(\) .*'resolution'"),
            (lambda: lf.photograph(cameras=[], nonsense=3), r"^LightField\.photograph\(\) .* argument 'nonsense'$"),
            (lambda: lf.export("views", layouts="hci"), r"^LightField\.export\(\) .*'layout'"),
            (lambda: lf.print("prints", strip=True), r"^LightField\.print\(\) .*'strips'"),
            (lambda: hogel.import_views("views", mirrors="rows"), r"^import_views\(\) .*'mirror'"),
            (lambda: hogel.write_cameras("cameras.json", distances=1), r"^write_cameras\(\) .*'distance'"),
            (lambda: scene.bake("baked.glb", ray=1), r"^Scene\.bake\(\) .*'rays'"),
            (lambda: lf.hologram().photograph(pupils=1), r"^Hologram\.photograph\(\) .*'pupil'"),
            (lambda: lf.hologram().propagate("1mm", ofset_x=1), r"^Hologram\.propagate\(\) .*'offset_x'"),
        ]
        for number, (work, pattern) in enumerate(cases):
            with self.subTest(f"{number} {pattern}"), self.assertRaisesRegex(TypeError, pattern):
                work()

    def test_nothing_is_written_after_an_error(self):
        lf, _ = light_field()
        with self.assertRaises(hogel.UsageError):
            lf.compress("a.hgl", coder="none")
        self.assertFalse(Path("a.hgl").exists())

    def test_the_command_line(self):
        command_line("--version")
        with self.assertRaisesRegex(AssertionError, "unknown|nonsense"):
            command_line("nonsense")


class Units(unittest.TestCase):
    def test_texts_and_floats(self):
        for text, metres in ("16mm", 16 * mm), ("1.5um", 1.5 * um), ("-2mm", -2 * mm), (0.25, 0.25), (np.float32(0.5), 0.5):
            self.assertAlmostEqual(hogel.length(text), metres, 15)
        for text, radians in ("16deg", 16 * deg), ("0.5rad", 0.5), (0.5, 0.5):
            self.assertAlmostEqual(hogel.angle(text), radians, 15)
        for wrong in "16", "mm", "", None, True, float("inf"), [1]:
            with self.assertRaises(hogel.UsageError):
                hogel.length(wrong)

    def test_wherever_a_length_is_taken(self):
        a = hogel.Scene.load("pumpkin").render(hogels="8x6", directions="4", size="2mm", fov="16,12deg")
        b = hogel.Scene.load("pumpkin").render(hogels=(8, 6), directions=4, size=2 * mm, fov=(16 * deg, 12 * deg))
        self.assertEqual(a.grid, b.grid)
        self.assertEqual(hogel.camera("2mm", eye="0,10,300mm", focus="1mm"), hogel.camera(2 * mm, eye=(0, 10 * mm, "300mm"), focus=1 * mm))


if __name__ == "__main__":
    unittest.main()
