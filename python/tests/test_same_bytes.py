# SPDX-License-Identifier: Apache-2.0
"""The same request gives the same bytes as the command line."""
import itertools
import re
import unittest
from pathlib import Path

import hogel
from common import InFolder, command_line
from hogel import _core, deg, mm, nm

SMALL = ["--hogels", "16x12", "--directions", "16", "--size", "0.8mm", "--fov", "16deg"]
RENDER = dict(hogels=(16, 12), directions=16, size=0.8 * mm, fov=16 * deg)


class SameBytes(InFolder):
    def assert_same(self, a, b):
        self.assertTrue(Path(a).read_bytes() == Path(b).read_bytes(), f"{a} and {b} differ")

    def rendered(self):
        return hogel.Scene.load("pumpkin").render(**RENDER)

    def made_by(self, path):
        """The entries of a file of the command line, with which the other file is written. HDF5 tells them by the alphabet;
        they are put back into the order in which they lie in the file."""
        if path.endswith(".hgl"):
            return _core.open_light_field(path, None).metadata
        opened = _core.open_hologram(path)[0] if path.startswith("holo") else _core.open_light_field(path, None)
        stored = Path(path).read_bytes()
        return sorted(opened.metadata, key=lambda entry: re.search(rb"(?<![a-z ])" + re.escape(entry[0].encode()) + rb"\0", stored).start())

    def test_render(self):
        command_line("render", "pumpkin", "-o", "c.h5", *SMALL)
        self.rendered().save("p.h5", metadata=self.made_by("c.h5"))
        self.assert_same("c.h5", "p.h5")

    def test_render_with_depth_and_floats(self):
        command_line("render", "pumpkin", "-o", "c.h5", *SMALL, "--float", "--depth")
        self.rendered().save("p.h5", float=True, depth=True, metadata=self.made_by("c.h5"))
        self.assert_same("c.h5", "p.h5")

    def test_render_compressed(self):
        command_line("render", "pumpkin", "-o", "c.hgl", *SMALL, "--sqnr", "35")
        self.rendered().save("p.hgl", sqnr=35, metadata=self.made_by("c.hgl"))
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
                made.save(f"p{number}.h5", metadata=self.made_by(f"c{number}.h5"))
                self.assert_same(f"c{number}.h5", f"p{number}.h5")

    def test_mesh_file_with_pose(self):
        Path("square.obj").write_text("v -1 -1 0\nv 1 -1 0\nv 1 1 1\nv -1 1 0\nf 1 2 3\nf 1 3 4\n")
        words = ["--up", "z", "--rotate", "10,20,-30deg", "--scale", "0.9", "--move", "0.1,0,0mm", "--colour", "#804020",
                 "--light", "1,2,3:yellow:1.5", "--background", "grey", "--ground", "white", "--front", "0.4"]
        command_line("render", "square.obj", "-o", "c.h5", *SMALL, *words)
        scene = hogel.Scene.load("square.obj", up="z", rotate=(10 * deg, 20 * deg, -30 * deg), scale=0.9, move="0.1,0,0mm",
                                 colour="#804020", light=[hogel.light((1, 2, 3), "yellow", 1.5)], background="grey",
                                 ground="white")
        scene.render(**RENDER, front=0.4).save("p.h5", metadata=self.made_by("c.h5"))
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
                result = hogel.LightField.open("lf.h5").compress(f"p{number}.hgl", **options, metadata=self.made_by(f"c{number}.hgl"))
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
                made.save(f"p{number}.h5", half="--half" in words, metadata=self.made_by(f"holo{number}.h5"))
                self.assert_same(f"holo{number}.h5", f"p{number}.h5")

    def test_hologram_of_a_scene(self):
        command_line("hologram", "pumpkin", "-o", "holo.h5", *SMALL)
        self.rendered().hologram().save("p.h5", metadata=self.made_by("holo.h5"))
        self.assert_same("holo.h5", "p.h5")

    def assert_same_picture(self, path, picture):
        """Of the picture, saved with the entries of the other; from its camera on it has them itself."""
        entries = list(itertools.takewhile(lambda entry: entry[0] != "camera", _core.read_metadata(path)))
        picture.save("own.png", metadata=entries)
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
        self.assert_same_picture("full.png", hogel.Hologram.open("red.h5").photograph(pupil="2mm", resolution=40, camera="full"))
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
                pattern.save(f"p{number}.png", metadata=_core.read_metadata(f"c{number}.png"))
                self.assert_same(f"c{number}.png", f"p{number}.png")


if __name__ == "__main__":
    unittest.main()
