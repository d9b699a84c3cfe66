# SPDX-License-Identifier: Apache-2.0
"""The same request gives the same bytes as the command line."""
import json
import subprocess
import sys
import unittest
from pathlib import Path

import hogel
import numpy as np
from common import InFolder, command_line
from hogel import deg, mm, nm

SMALL = ["--hogels", "16x12", "--directions", "16", "--size", "0.8mm", "--fov", "16deg"]
CAMERAS = ["--hogels", "16x12", "--directions", "4", "--size", "0.8mm", "--fov", "16deg", "--focal-plane", "-300mm"]
SQUARE = "v -1 -1 0\nv 1 -1 0\nv 1 1 1\nv -1 1 0\nf 1 2 3\nf 1 3 4\n"
RENDER = dict(hogels=(16, 12), directions=16, size=0.8 * mm, fov=16 * deg)


# The tests of each command.
TESTED = {
    "bake": "test_bake",
    "cameras": "test_cameras",
    "compare": "test_compare",
    "compress": "test_compress",
    "decompress": "test_decompress",
    "export": "test_export",
    "focus": "test_focus",
    "hologram": "test_hologram",
    "import": "test_import",
    "info": "test_info",
    "join": "test_join",
    "make": "test_make",
    "photo": "test_photo",
    "print": "test_print",
    "propagate": "test_propagate",
    "render": "test_render",
    "scenes": "test_scenes",
    "slm": "test_slm",
}
NOT_TESTED = {
    "completion": "prints a script for a shell, and writes no file",
    "help": "prints help, and writes no file",
    "view": "serves pictures to a browser, and writes no file; those of rays and waves are photograph()'s",
}


def answer(*words):
    """What the command line prints, as JSON."""
    words = [sys.executable, "-m", "hogel", *map(str, words), "--json"]
    return json.loads(subprocess.run(words, capture_output=True, text=True, check=True).stdout)


class Commands(unittest.TestCase):
    def test_every_command_is_tested_or_excluded(self):
        page = subprocess.run([sys.executable, "-m", "hogel", "--help"], capture_output=True, text=True, check=True).stdout
        lines = page[page.index("Commands:") :].split("\n")[1:]
        names = {line.split()[0] for line in lines[: lines.index("")] if line.startswith("  ") and line[2] != " "}
        self.assertGreater(len(names), 10)
        self.assertEqual(names - {"help"}, (TESTED.keys() | NOT_TESTED.keys()) - {"help"})
        for test in TESTED.values():
            self.assertTrue(hasattr(SameBytes, test), test)


class SameBytes(InFolder):
    def assert_same(self, a, b):
        self.assertTrue(Path(a).read_bytes() == Path(b).read_bytes(), f"{a} and {b} differ")

    def rendered(self):
        return hogel.Scene.load("pumpkin").render(**RENDER)

    def test_render(self):
        command_line("render", "pumpkin", "-o", "c.h5", *SMALL)
        self.rendered().save("p.h5")
        self.assert_same("c.h5", "p.h5")

    def test_render_with_depth_and_floats(self):
        command_line("render", "pumpkin", "-o", "c.h5", *SMALL, "--float", "--depth")
        self.rendered().save("p.h5", float=True, depth=True)
        self.assert_same("c.h5", "p.h5")

    def test_render_compressed(self):
        command_line("render", "pumpkin", "-o", "c.hgl", *SMALL, "--sqnr", "35")
        self.rendered().save("p.hgl", sqnr=35)
        self.assert_same("c.hgl", "p.hgl")

    def test_render_options(self):
        cases = [
            (["--toward", "5,-3deg"], dict(toward=(5 * deg, -3 * deg))),
            (["--hemicube"], dict(hemicube=True, fov=None)),
            (["--focal-plane", "-300mm"], dict(focal_plane="-300mm")),
            (["--samples", "2x1", "--algorithm", "raytrace"], dict(samples=(2, 1), algorithm="raytrace")),
            (["--shading", "direct", "--shadow-map", "64"], dict(shading="direct", shadow_map=64)),
            (["--cull-back-faces"], dict(cull_back_faces=True)),
        ]
        for number, (words, options) in enumerate(cases):
            with self.subTest(" ".join(words)):
                sampling = [word for word in SMALL if word not in ("--fov", "16deg")] if "--hemicube" in words else SMALL
                command_line("render", "pumpkin", "-o", f"c{number}.h5", *sampling, *words)
                made = hogel.Scene.load("pumpkin").render(**{**RENDER, **options})
                made.save(f"p{number}.h5")
                self.assert_same(f"c{number}.h5", f"p{number}.h5")

    def test_mesh_file_with_pose(self):
        Path("square.obj").write_text(SQUARE)
        words = ["--up", "z", "--rotate", "10,20,-30deg", "--scale", "0.9", "--move", "0.1,0,0mm", "--colour", "#804020",
                 "--light", "1,2,3:yellow:1.5", "--background", "grey", "--ground", "white", "--front", "0.4"]
        command_line("render", "square.obj", "-o", "c.h5", *SMALL, *words)
        scene = hogel.Scene.load("square.obj", up="z", rotate=(10 * deg, 20 * deg, -30 * deg), scale=0.9, move="0.1,0,0mm",
                                 colour="#804020", light=["1,2,3:yellow:1.5"], background="grey",
                                 ground="white")
        scene.render(**RENDER, front=0.4).save("p.h5")
        self.assert_same("c.h5", "p.h5")

    def test_compress(self):
        command_line("render", "pumpkin", "-o", "lf.h5", *SMALL, "--depth")
        cases = [
            ([], {}),
            (["--ppb", "1", "--no-depth"], dict(ppb=1, no_depth=True)),
            (["--lossless"], dict(lossless=True)),
            (["--max-error", "0.01"], dict(max_error=0.01)),
            (["--step", "0.05", "--chrominance", "2"], dict(step=0.05, chrominance=2)),
            (["--coder", "ezw", "--transform", "ai33", "--sqnr", "30"], dict(coder="ezw", transform="ai33", sqnr=30)),
            (["--coder", "jpeg4d", "--table", "jpeg"], dict(coder="jpeg4d", table="jpeg")),
            (["--tone", "histogram", "--depth-error", "1um"], dict(tone="histogram", depth_error="1um")),
            (["--tile", "8x6"], dict(tile=(8, 6))),
        ]
        for number, (words, options) in enumerate(cases):
            with self.subTest(" ".join(words)):
                command_line("compress", "lf.h5", "-o", f"c{number}.hgl", *words)
                result = hogel.LightField.open("lf.h5").compress(f"p{number}.hgl", **options)
                self.assert_same(f"c{number}.hgl", f"p{number}.hgl")
                self.assertEqual(result["bytes"], Path(f"p{number}.hgl").stat().st_size)

    def test_hologram(self):
        command_line("render", "pumpkin", "-o", "lf.h5", *SMALL, "--depth")
        cases = [
            ([], {}),
            (["--wavelength", "633nm", "--pitch", "1.6um"], dict(wavelength=633 * nm, pitch="1.6um")),
            (["--method", "basis", "--basis", "haar", "--tolerance", "0.1"], dict(method="basis", basis="haar", tolerance=0.1)),
            (["--method", "olas", "--phase", "fixed"], dict(method="olas", phase="fixed")),
            (["--lobes", "amplitude", "--phase", "designed"], dict(lobes="amplitude", phase="designed")),
            (["--seed", "7", "--half"], dict(seed=7)),
        ]
        for number, (words, options) in enumerate(cases):
            with self.subTest(" ".join(words)):
                command_line("hologram", "lf.h5", "-o", f"holo{number}.h5", *words)
                made = hogel.LightField.open("lf.h5").hologram(**options)
                made.save(f"p{number}.h5", half="--half" in words)
                self.assert_same(f"holo{number}.h5", f"p{number}.h5")

    def test_hologram_of_a_scene(self):
        command_line("hologram", "pumpkin", "-o", "holo.h5", *SMALL)
        self.rendered().hologram().save("p.h5")
        self.assert_same("holo.h5", "p.h5")

    def assert_same_picture(self, path, picture):
        picture.save("own.png")
        self.assert_same(path, "own.png")

    def test_photo(self):
        command_line("render", "pumpkin", "-o", "lf.h5", *SMALL)
        command_line("hologram", "lf.h5", "-o", "holo.h5")
        view = ["--pupil", "30mm", "--resolution", "40", "--eye", "10,5,300mm", "--focus", "1mm"]
        camera = dict(pupil=30 * mm, resolution=40, eye="10,5,300mm", focus=1 * mm)
        command_line("photo", "lf.h5", "-o", "rays.png", *view)
        self.assert_same_picture("rays.png", hogel.LightField.open("lf.h5").photograph(**camera))
        command_line("photo", "holo.h5", "-o", "waves.png", *view)
        self.assert_same_picture("waves.png", hogel.Hologram.open("holo.h5").photograph(**camera))
        command_line("hologram", "lf.h5", "-o", "red.h5", "--wavelength", "633nm")
        command_line("photo", "red.h5", "-o", "full.png", "--pupil", "2mm", "--resolution", "40", "--camera", "full")
        self.assert_same_picture("full.png", hogel.Hologram.open("red.h5").photograph(pupil="2mm", resolution=40, camera="plane-waves"))
        command_line("photo", "lf.h5", "-o", "expected.png", *view, "--wave", "--looks", "expected")
        expected = hogel.LightField.open("lf.h5").hologram().photograph(**camera, expected=True)
        self.assert_same_picture("expected.png", expected)

    def test_propagate(self):
        command_line("render", "pumpkin", "-o", "lf.h5", *SMALL)
        command_line("hologram", "lf.h5", "-o", "holo.h5", "--wavelength", "532nm")
        command_line("propagate", "holo.h5", "-o", "c.npy", "--distance", "2mm", "--output-samples", "100x90", "--offset-x", "20um")
        moved = hogel.Hologram.open("holo.h5").propagate("2mm", output_samples=(100, 90), offset_x="20um")
        moved.save("p.npy")
        self.assert_same("c.npy", "p.npy")
        command_line("propagate", "holo.h5", "-o", "c.h5", "--distance", "2mm", "--output-samples", "100x90")
        hogel.Hologram.open("holo.h5").propagate("2mm", output_samples=(100, 90)).save("p.h5")
        self.assert_same("c.h5", "p.h5")

    def test_slm(self):
        command_line("hologram", "pumpkin", "-o", "holo.h5", "--hogels", "8x6", "--directions", "8", "--size", "1.6384mm",
                     "--pitch", "6.4um", "--fov", "2.5deg", "--wavelength", "532nm")
        cases = [
            (["--encoding", "double-phase", "--pixels", "320x200", "--pixel-pitch", "6.4um"],
             dict(encoding="double-phase", pixels=(320, 200), pixel_pitch="6.4um")),
            (["--encoding", "gerchberg-saxton", "--device", "leto", "--iterations", "3", "--phase-code", "slmsuite"],
             dict(encoding="gerchberg-saxton", device="leto", iterations=3, phase_code="slmsuite")),
            (["--encoding", "phase", "--pixels", "256x192", "--pixel-pitch", "6.4um", "--levels", "64"],
             dict(encoding="phase", pixels=(256, 192), pixel_pitch="6.4um", levels=64)),
        ]
        for number, (words, options) in enumerate(cases):
            with self.subTest(" ".join(words)):
                command_line("slm", "holo.h5", "-o", f"c{number}.png", *words)
                pattern = hogel.Hologram.open("holo.h5").slm(**options)
                pattern.save(f"p{number}.png")
                self.assert_same(f"c{number}.png", f"p{number}.png")

    def test_supervised_patterns(self):
        modulator = ["--pixels", "64x48", "--pixel-pitch", "6.4um"]
        command_line("render", "pumpkin", "-o", "lf.h5", "--hogels", "8x6", "--directions", "6", "--size", "0.4096mm", "--fov",
                     "2.5deg", "--depth", "--float")
        command_line("slm", "lf.h5", "-o", "c#.png", *modulator, "--encoding", "supervised", "--frames", "2", "--iterations", "3",
                     "--wavelength", "532nm")
        holo = hogel.LightField.open("lf.h5").hologram(wavelength="532nm", pitch="6.4um")
        pattern = holo.slm(encoding="supervised", frames=2, iterations=3, pixels=(64, 48), pixel_pitch="6.4um")
        pattern.save("p#.png")
        self.assertEqual(np.asarray(pattern).shape, (2, 48, 64, 1))
        self.assertGreater(pattern.quality[0].psnr, 5)
        for frame in range(2):
            self.assertTrue(np.array_equal(hogel.Picture.open(f"c{frame}.png"), hogel.Picture.open(f"p{frame}.png")))
        with self.assertRaisesRegex(hogel.UsageError, "light field"):
            holo.load().slm(encoding="supervised", pixels=(64, 48), pixel_pitch="6.4um")

    def test_decompress(self):
        command_line("render", "pumpkin", "-o", "lf.h5", *SMALL, "--depth")
        cases = [([], [], {}), (["--lossless"], [], {}), ([], ["--layers", "2"], {"layers": 2}), ([], ["--float"], {})]
        for number, (coding, words, options) in enumerate(cases):
            with self.subTest(" ".join(coding + words)):
                command_line("compress", "lf.h5", "-o", "lf.hgl", *coding)
                command_line("decompress", "lf.hgl", "-o", f"c{number}.h5", *words)
                hogel.LightField.open("lf.hgl", **options).save(f"p{number}.h5", float="--float" in words)
                self.assert_same(f"c{number}.h5", f"p{number}.h5")

    def test_hologram_without_a_light_field(self):
        Path("square.obj").write_text(SQUARE)
        cases = [
            ("pumpkin", ["--method", "points", "--spacing", "15um", "--half"], {}, dict(method="points", spacing="15um")),
            ("square.obj", ["--method", "fresnel", "--planes", "3", "--front", "-12", "--seed", "5", "--rotate", "1,2,3deg",
                            "--background", "red"],
             dict(rotate="1,2,3deg", background="red"), dict(method="fresnel", planes=3, front=-12, seed=5)),
        ]
        for scene, words, pose, options in cases:
            with self.subTest(scene):
                command_line("hologram", scene, "-o", "c.h5", "--hogels", "4", "--size", "0.3mm", "--wavelength", "633nm,532nm", *words)
                loaded = hogel.Scene.load(scene, **pose)
                made = loaded.hologram(hogels=4, size="0.3mm", wavelength=(633 * nm, 532 * nm), **options)
                made.save("p.h5", half="--half" in words)
                self.assert_same("c.h5", "p.h5")

    def test_bake(self):
        Path("square.obj").write_text(SQUARE)
        cases = [
            ("sphere", ["--rays", "4", "--bounces", "1", "--size", "10mm"], {}, dict(rays=4, bounces=1, size="10mm")),
            ("square.obj", ["--rays", "5", "--tessellate", "2", "--seed", "3", "--light", "0,1,1:red", "--move", "1,0,0mm"],
             dict(light=["0,1,1:red"], move=(1 * mm, 0, 0)), dict(rays=5, tessellate=2, seed=3)),
        ]
        for scene, words, pose, options in cases:
            with self.subTest(scene):
                command_line("bake", scene, "-o", "c.glb", *words)
                hogel.Scene.load(scene, **pose).bake("p.glb", **options)
                self.assert_same("c.glb", "p.glb")

    def test_print(self):
        command_line("render", "pumpkin", "-o", "lf.h5", *SMALL)
        for strips in (False, True):
            words = ["--strips", "--order", "rows", "--dose", "1,0.8,0.6", "--mask", "circle"] if strips else []
            options = dict(strips=True, order="rows", dose=(1, 0.8, 0.6), mask="circle") if strips else {}
            command_line("print", "lf.h5", "-o", f"c{strips}", *words)
            made = hogel.LightField.open("lf.h5").print(f"p{strips}", **options)
            self.assertEqual(made.pictures, 12 if strips else 192)
            self.assert_same_folders(f"c{strips}", f"p{strips}", 13 if strips else 193)
        command_line("print", "pumpkin", "-o", "cscene", *SMALL, "--exposure", "auto")
        self.rendered().print("pscene", exposure="auto")
        self.assert_same_folders("cscene", "pscene", 193)

    def assert_same_folders(self, a, b, number):
        names = sorted(path.name for path in Path(a).iterdir())
        self.assertEqual(names, sorted(path.name for path in Path(b).iterdir()))
        self.assertEqual(len(names), number)
        for name in names:
            self.assert_same(Path(a) / name, Path(b) / name)

    def test_export(self):
        command_line("render", "pumpkin", "-o", "lf.h5", *CAMERAS)
        opened = hogel.LightField.open("lf.h5")
        command_line("export", "lf.h5", "-o", "c", "--exposure", "0.8")
        opened.export("p", exposure=0.8)
        self.assert_same_folders("c", "p", 16)
        command_line("export", "lf.h5", "-o", "c.npy")
        opened.export("p.npy")
        self.assert_same("c.npy", "p.npy")
        with self.assertRaisesRegex(hogel.CannotWriteError, "holds files already"):
            opened.export("p")

    def test_export_of_a_scene(self):
        cases = [
            ("views.npy", ["--hogels", "12x9", "--directions", "4x2", "--focal-plane", "-200mm", "--exposure", "auto"],
             dict(hogels=(12, 9), directions=(4, 2), focal_plane="-200mm", exposure="auto")),
            ("x_qs3x2a0.75.png", ["--hogels", "12x16", "--fov", "30deg", "--samples", "2x1"],
             dict(hogels=(12, 16), fov=30 * deg, samples=(2, 1))),
        ]
        for name, words, options in cases:
            with self.subTest(name):
                command_line("export", "pumpkin", "-o", f"c{name}", *words)
                hogel.Scene.load("pumpkin").export(f"p{name}", **options)
                self.assert_same(f"c{name}", f"p{name}")

    def test_import(self):
        command_line("render", "pumpkin", "-o", "lf.h5", *CAMERAS)
        command_line("export", "lf.h5", "-o", "views")
        cases = [
            ([], {}),
            (["--size", "4mm", "--distance", "200mm", "--fov", "10deg"], dict(size="4mm", distance="200mm", fov="10deg")),
            (["--mirror", "columns", "--transfer", "linear", "--middle", "2x2"],
             dict(mirror="columns", transfer="linear", middle=(2, 2))),
            (["--column", "second", "--projection", "cameras", "--spacing", "0.2mm", "--disparity", "-1.5"],
             dict(column="second", projection="cameras", spacing=0.2 * mm, disparity=-1.5)),
            (["--densify", "2", "--estimate-disparity", "--depth", "--depth-scale", "1000", "--views", "4x4"],
             dict(densify=2, estimate_disparity=True, depth=True, depth_scale=1000, views="4x4")),
        ]
        for number, (words, options) in enumerate(cases):
            with self.subTest(" ".join(words)):
                command_line("import", "views", "-o", f"c{number}.h5", *words)
                hogel.import_views("views", **options).save(f"p{number}.h5", depth="--depth" in words)
                self.assert_same(f"c{number}.h5", f"p{number}.h5")
        command_line("import", "views", "-o", "c.hgl", "--sqnr", "30")
        hogel.import_views("views").save("p.hgl", sqnr=30)
        self.assert_same("c.hgl", "p.hgl")

    def test_cameras(self):
        command_line("cameras", "-o", "c.json", "--size", "2m", "--distance", "10m", "--hogels", "80x60", "--directions", "5x1")
        hogel.write_cameras("p.json", size="2m", distance="10m", hogels=(80, 60), directions=(5, 1))
        self.assert_same("c.json", "p.json")

    def test_fields_of_other_programs(self):
        noise = np.random.default_rng(1).normal(size=(2, 48, 64)).astype(np.float32)
        np.save("wave.npy", noise[0] + 1j * noise[1])
        np.save("phase.npy", noise[0])
        levels = (127.5 + 40 * noise[0]).clip(0, 255).astype(np.uint8)[..., None]
        hogel._core.write_levels("levels.png", np.ascontiguousarray(levels), 255, None)
        sampling = (["--pitch", "4um", "--wavelength", "532nm"], dict(pitch="4um", wavelength=532 * nm))
        cases = [
            ("wave.npy", [], {}),
            ("wave.npy", ["--conjugate"], dict(conjugate=True)),
            ("phase.npy", ["--values", "phase"], dict(values="phase")),
            ("levels.png", ["--phase-code", "slmsuite"], dict(phase_code="slmsuite")),
            ("levels.png", ["--values", "intensity", "--order", "+1", "--aperture", "0.1"],
             dict(values="intensity", order="+1", aperture=0.1)),
            ("levels.png", ["--imaginary", "levels.png", "--zero", "128"], dict(imaginary=Path("levels.png"), zero=128.0)),
            ("wave.npy", ["--order", "0.1,0", "--reference-source", "0,1,-20mm"],
             dict(order="0.1,0", reference_source=(0, 1 * mm, -20 * mm))),
            ("wave.npy", ["--reconstruct", "fourier", "--focal", "100mm"], dict(reconstruct="fourier", focal=100 * mm)),
        ]
        for number, (name, words, options) in enumerate(cases):
            with self.subTest(f"{name} {' '.join(words)}"):
                command_line("propagate", name, "-o", f"c{number}.h5", "--distance", "2mm", *sampling[0], *words)
                opened = hogel.Hologram.open(name, **sampling[1], **options)
                opened.propagate("2mm").save(f"p{number}.h5")
                self.assert_same(f"c{number}.h5", f"p{number}.h5")
                if "--reconstruct" in words:
                    continue
                view = ["--eye", "0,0,20mm", "--pupil", "1mm", "--resolution", "20"]
                command_line("photo", name, "-o", f"c{number}.png", *view, *sampling[0], *words)
                self.assert_same_picture(f"c{number}.png", opened.photograph(eye="0,0,20mm", pupil="1mm", resolution=20))
                coded = [{"--phase-code": "--input-phase-code"}.get(word, word) for word in words]
                command_line("slm", name, "-o", f"s{number}.png", "--encoding", "phase", "--pixels", "64x48", "--pixel-pitch", "4um",
                             *sampling[0], *coded)
                opened.slm(encoding="phase", pixels=(64, 48), pixel_pitch="4um").save(f"q{number}.png")
                self.assert_same(f"s{number}.png", f"q{number}.png")

    def test_patterns_say_what_they_are(self):
        command_line("render", "sphere", "-o", "lf.h5", *SMALL[:-1], "2deg")
        command_line("hologram", "lf.h5", "-o", "h.h5", "--wavelength", "532nm", "--pitch", "1.5625um")
        for number, encoding in enumerate(("double-phase", "bipolar")):
            words = ["--encoding", encoding, "--pixels", "64x48", "--pixel-pitch", "1.5625um"]
            command_line("slm", "h.h5", "-o", f"c{number}.png", *words)
            made = hogel.Hologram.open("h.h5").slm(encoding=encoding, pixels=(64, 48), pixel_pitch="1.5625um")
            made.save(f"p{number}.png")
            self.assert_same(f"c{number}.png", f"p{number}.png")
            command_line("propagate", f"c{number}.png", "-o", f"c{number}.h5", "--distance", "2mm")
            opened = hogel.Hologram.open(f"c{number}.png")
            opened.propagate("2mm").save(f"q{number}.h5")
            self.assert_same(f"c{number}.h5", f"q{number}.h5")
            self.assertEqual(opened.wavelengths, [532e-9])

    def test_a_pitch_that_is_not_given(self):
        wide = ["--hogels", "4", "--directions", "8", "--size", "0.2mm", "--fov", "40deg"]
        command_line("render", "sphere", "-o", "lf.h5", *wide)
        command_line("hologram", "lf.h5", "-o", "c.h5", "--wavelength", "532nm")
        with self.assertWarns(UserWarning):
            hogel.LightField.open("lf.h5").hologram(wavelength="532nm").save("p.h5")
        self.assert_same("c.h5", "p.h5")

    def test_join(self):
        for number in (1, 2, 3):
            command_line("render", "pumpkin", "-o", "lf.h5", *SMALL, "--part", f"{number}/3")
            self.rendered().save(f"p{number}", part=(number, 3))
            self.assert_same(f"lf.part-{number}-of-3", f"p{number}")
        command_line("join", *(f"lf.part-{number}-of-3" for number in (1, 2, 3)), "-o", "c.h5")
        hogel.join("p.h5", ["p2", "p1", "p3"])
        self.assert_same("c.h5", "p.h5")
        self.rendered().save("whole.h5")
        self.assert_same("whole.h5", "p.h5")
        for number in (1, 2):
            command_line("hologram", "whole.h5", "-o", "holo.h5", "--part", f"{number}/2")
            hogel.LightField.open("whole.h5").hologram().save(f"h{number}", part=(number, 2))
            self.assert_same(f"holo.part-{number}-of-2", f"h{number}")
        with self.assertRaisesRegex(hogel.BadInputError, "part"):
            hogel.join("x.h5", ["p1", "p2"])

    def test_make(self):
        """`make` is these calls one after the other, and a page about them: what they say made them alone is its own."""
        command_line("make", "pumpkin", "-o", "c", *SMALL, "--keep-light-field", "--store-hologram", "--looks", "2", "--resolution", "40")

        def entries(command, made, like):
            """What our record says, as far as the file of `make` says it too, and in its name."""
            known = hogel.open(like).metadata
            ours = hogel._record.entries(command, made)
            said = {key for key in known if key.startswith("option ")}
            self.assertGreater(len(said), 1)
            self.assertEqual(said - {key for key, _ in ours}, set())
            return [(key, "hogel make" if key == "command" else text) for key, text in ours if key in known]

        lf = self.rendered()
        lf.save("p.h5", metadata=entries("render", lf._made, "c/lightfield.h5"))
        self.assert_same("c/lightfield.h5", "p.h5")
        opened = hogel.LightField.open("c/lightfield.h5")
        holo = opened.hologram(looks=2)
        holo.save("holo.h5", metadata=entries("hologram", holo._made, "c/hologram.h5"))
        self.assert_same("c/hologram.h5", "holo.h5")
        names = [f"c/photo_{eye}_{focus}" for focus in ("near", "far") for eye in ("left", "high", "right")]
        for ending, of in ("", holo), ("_geometric", opened):
            pictures = [hogel.Picture.open(f"{name}{ending}.exr") for name in names]
            made = of.photograph(cameras=[picture.camera for picture in pictures])
            for theirs, ours in zip(pictures, made):
                self.assertTrue(np.array_equal(theirs, np.asarray(ours).astype(np.float16)))  # .exr has halves

    def test_make_in_one_call(self):
        """The pictures of every camera, with their exposure, and of every kind."""
        words = ["--resolution", "40", "--eye-distance", "200mm", "--pupil", "4mm", "--pupil-samples", "16"]
        options = dict(resolution=40, eye_distance=200 * mm, pupil=4 * mm, pupil_samples=16)
        for number, looks in enumerate((2, "expected")):
            with self.subTest(looks):
                folder, ours = Path(f"c{number}"), Path(f"p{number}")
                command_line("make", "pumpkin", "-o", folder, *SMALL, *words, "--looks", looks, "--seed", 3)
                made = hogel.make("pumpkin", looks=looks, seed=3, **RENDER, **options)
                report = json.loads((folder / "report.json").read_text())
                self.assertEqual(report["exposure"], made.exposure)
                for theirs, by in zip(report["photographs"], made.photographs):
                    self.assertEqual((theirs["eye_name"], theirs["focus_name"]), (by.eye, by.focus))
                    self.assertEqual(theirs["expected_ssim"], by.speckle_free_comparison["ssim"])
                    self.assertEqual(theirs.get("psnr"), by.waves_comparison and by.waves_comparison["psnr"])
                ours.mkdir()
                made.save(ours)
                pictures = sorted(path.name for path in folder.iterdir() if path.suffix in (".png", ".exr"))
                self.assertEqual(len(pictures), 24 if looks == "expected" else 36)
                self.assertEqual(pictures, sorted(path.name for path in ours.iterdir()))
                for name in pictures:
                    a, b = hogel.Picture.open(folder / name), hogel.Picture.open(ours / name)
                    self.assertTrue(np.array_equal(a, b), name)
                    self.assertEqual(a.camera, b.camera)

    def test_compare(self):
        command_line("render", "pumpkin", "-o", "a.h5", *SMALL)
        command_line("compress", "a.h5", "-o", "b.hgl", "--sqnr", "30")
        self.assertEqual(answer("compare", "a.h5", "b.hgl"), hogel.compare("a.h5", "b.hgl"))

    def test_info(self):
        command_line("render", "pumpkin", "-o", "a.h5", *SMALL)
        told = answer("info", "a.h5")
        own = {"kind": "light field", **hogel.info("a.h5")}
        for name in ("option size", "renderer", "hogels_s", "hogel_pitch_m"):
            self.assertEqual(told[name], own[name])

    def test_focus(self):
        command_line("hologram", "pumpkin", "-o", "holo.h5", *SMALL, "--wavelength", "532nm")
        told = answer("focus", "holo.h5", "--from", "-2mm", "--to", "2mm", "--planes", "20")
        own = hogel.Hologram.open("holo.h5")[0].focus(between=("-2mm", "2mm"), planes=20)
        depths = [plane["depth_m"] for plane in told["planes"]]
        self.assertEqual(depths, [plane.depth for plane in own.planes][: len(depths)])

    def test_scenes(self):
        page = subprocess.run([sys.executable, "-m", "hogel", "scenes"], capture_output=True, text=True, check=True).stdout
        self.assertEqual([line.split()[0] for line in page.splitlines() if line and line[0] != " "], list(hogel.scenes()))


if __name__ == "__main__":
    unittest.main()
