#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Stops commands of hogel by a signal at moments spread evenly over their work, and prints the time from the signal to the end.
Each stop must end with the status of docs/errors.md, and leave no output, temporary file or process.

usage: stops.py HOGEL [--commands NAME,NAME] [--scene FILE] [--stops N] [--signal TERM|INT|HUP] [--small] [--require]
       --commands: only these of the table; --list: prints their names
       --scene: a mesh file for the commands of scenes, in addition to generated scenes
       --stops: number of stops of each command [5]; --small: small sizes, for testing this program
       --require: fails if a stop takes longer than a second in two tries at the same moment
"""
import argparse
import array
import os
import pathlib
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import threading
import time
import urllib.request

LIMIT = 1.0
MAX_SECONDS = 30  # part of a command's work in which it is stopped
VIEW_SECONDS = 12
NOT_BUILT = "this build of hogel"
SEED = "7"

# name: inputs, command. OUT is the output without its ending.
COMMANDS = {
    "render": ((), "render church --hogels 200x200 --directions 48x48 --samples 2x2 -o OUT.h5"),
    "render to hgl": ((), "render pumpkin --hogels 128x128 --directions 48x48 -o OUT.hgl"),
    "render one hogel": ((), "render pumpkin --hogels 1x1 --directions 12000x12000 --size 1mm -o OUT.h5"),
    "render a mesh, PLY": (("mesh.ply",), "render mesh.ply --hogels 32x32 -o OUT.h5"),
    "render a mesh, OBJ": (("mesh.obj",), "render mesh.obj --hogels 32x32 -o OUT.h5"),
    "render a mesh, STL": (("mesh.stl",), "render mesh.stl --hogels 32x32 -o OUT.h5"),
    "bake": (("mesh.ply",), "bake mesh.ply -o OUT.glb"),
    "info of a mesh": (("mesh.ply",), "info mesh.ply"),
    "hologram": (("rays",), "hologram rays.h5 --wavelength rgb --pitch 1.25um --half -o OUT.h5"),
    "hologram, olas": (("deep",), "hologram deep.h5 --wavelength 532nm --method olas -o OUT.h5"),
    "hologram, points-visible": ((), "hologram pumpkin --method points-visible --wavelength 532nm --hogels 40x40 --size 2mm -o OUT.h5"),
    "hologram, planes": ((), "hologram pumpkin --method planes --wavelength 532nm --hogels 200x200 --size 10mm -o OUT.h5"),
    "hologram, polygons": ((), "hologram pumpkin --method polygons --wavelength 532nm --hogels 16x16 --size 0.3mm -o OUT.h5"),
    "photo by rays": (("rays",), "photo rays.h5 --resolution 512 --pupil-samples 4096 -o OUT.exr"),
    "photo, camera eye": (("rays",), "photo rays.h5 --wave --camera eye --resolution 400 -o OUT.png"),
    "photo, camera narrow": (("rays",), "photo rays.h5 --wave --camera narrow --looks 2 --resolution 256 -o OUT.png"),
    "photo, camera full": (("field",), "photo field.h5 --camera full --resolution 256 -o OUT.exr"),
    "photo, looks expected": (("rays",), "photo rays.h5 --wave --looks expected --resolution 400 -o OUT.png"),
    "photo to a large PNG": (("few",), "photo few.h5 --resolution 8000 --pupil-samples 1 -o OUT.png"),
    "photo to a large EXR": (("few",), "photo few.h5 --resolution 8000 --pupil-samples 1 -o OUT.exr"),
    "photo to a large TIFF": (("few",), "photo few.h5 --resolution 8000 --pupil-samples 1 -o OUT.tif"),
    "compress": (("rays",), "compress rays.h5 --step 0.01 -o OUT.hgl"),
    "compress, threepass": (("rays",), "compress rays.h5 --coder threepass --step 0.01 -o OUT.hgl"),
    "compress, lossless": (("rays",), "compress rays.h5 --lossless -o OUT.hgl"),
    "decompress": (("packed",), "decompress packed.hgl -o OUT.h5"),
    "slm, double-phase": (("colours",), "slm colours.h5 --pixels 6000x5000 --pixel-pitch 8um --encoding double-phase -o OUT.png"),
    "slm, gradient": (("colours",), "slm colours.h5 --pixels 2400x2000 --pixel-pitch 8um --encoding gradient --iterations 20 -o OUT.png"),
    "slm, gerchberg-saxton": (("colours",), "slm colours.h5 --pixels 2400x2000 --pixel-pitch 8um --encoding gerchberg-saxton -o OUT.bmp"),
    "slm, auto": (("colours",), "slm colours.h5 --pixels 2400x2000 --pixel-pitch 8um -o OUT.png"),
    "print": (("rays",), "print rays.h5 -o OUT"),
    "print, strips": (("rays",), "print rays.h5 --strips -o OUT"),
    "export, numbered": (("cameras",), "export cameras.h5 --layout numbered -o OUT"),
    "export to npy": (("rays",), "export rays.h5 -o OUT.npy"),
    "export to mat": (("rays",), "export rays.h5 -o OUT.mat"),
    "export to a quilt": (("row",), "export row.h5 -o OUT_qs8x6a1.png"),
    "import": (("views",), "import views -o OUT.h5"),
    "import of a quilt": (("quilt",), "import quilt_qs8x6a1.png -o OUT.h5"),
    "make": ((), "make pumpkin --hogels 160x160 --size 10mm -o OUT"),
    "propagate to HDF5": (("field",), "propagate field.h5 --distance 5mm -o OUT.h5"),
    "propagate to npz": (("field",), "propagate field.h5 --distance 5mm -o OUT.npz"),
    "propagate to mat": (("field",), "propagate field.h5 --distance 5mm -o OUT.mat"),
    "propagate to PNG": (("field",), "propagate field.h5 --distance 5mm -o OUT.png"),
    "propagate of npz": (("field.npz",), "propagate field.npz --distance 5mm -o OUT.npy"),
    "focus": (("field",), "focus field.h5"),
    "compare light fields": (("rays",), "compare rays.h5 rays.h5"),
    "compare pictures": (("large.png",), "compare large.png large.png"),
    "info of a picture": (("large.png",), "info large.png"),
    "view": (("rays",), "view rays.h5 --no-browser"),
}
# Commands added by --scene.
SCENE_COMMANDS = {
    "scene: info": "info SCENE",
    "scene: render": "render SCENE --hogels 64x64 -o OUT.h5",
    "scene: photo": "photo SCENE --hogels 64x64 --size 4mm --looks 2 -o OUT.png",
    "scene: points": "hologram SCENE --method points --wavelength 532nm --hogels 16x16 --size 1mm -o OUT.h5",
    "scene: view": "view SCENE --no-browser",
}
INPUTS = {
    "rays": "render pumpkin --hogels 160x160 --directions 64x64 --size 20mm -o rays.h5",
    "deep": "render pumpkin --hogels 160x160 --directions 32x32 --size 10mm --depth -o deep.h5",
    "few": "render pumpkin --hogels 16x16 --directions 16x16 --size 20mm -o few.h5",
    "packed": "compress rays.h5 --step 0.01 -o packed.hgl",
    "field": "hologram rays.h5 --wavelength 532nm --pitch 1.9um -o field.h5",
    "field.npz": "propagate field.h5 --distance 1mm -o field.npz",
    "slow": "render pumpkin --hogels 400x400 --directions 32x32 --size 48mm --fov 2.5deg -o slow.h5",
    "colours": "hologram slow.h5 --wavelength rgb --pitch 8um -o colours.h5",
    "large.png": "photo few.h5 --resolution 8000 --pupil-samples 1 -o large.png",
    "cameras": "render pumpkin --focal-plane -300mm --hogels 160x160 --directions 64x64 --size 20mm --fov 20deg -o cameras.h5",
    "views": "export cameras.h5 --layout numbered -o views",
    "row": "render pumpkin --focal-plane -300mm --hogels 400x400 --directions 48x1 --size 20mm --fov 40deg -o row.h5",
    "quilt": "export row.h5 -o quilt_qs8x6a1.png",
}
NEEDS = {"packed": ("rays",), "field": ("rays",), "field.npz": ("field",), "colours": ("slow",), "large.png": ("few",),
         "views": ("cameras",), "quilt": ("row",)}


def smaller(command):
    for large, small in (("160x160", "16x16"), ("200x200", "16x16"), ("128x128", "16x16"), ("400x400", "24x24"),
                         ("40x40", "8x8"), ("12000x12000", "500x500"), ("8000", "200"), ("2400x2000", "300x200"),
                         ("6000x5000", "300x200"), ("20mm", "2mm"), ("10mm", "1mm"), ("48mm", "4.8mm"), ("4096", "16")):
        command = command.replace(large, small)
    return command


def mesh_of(name, side):
    """A wavy sheet of 2 (side - 1)² triangles, as bytes."""
    def height(x, y):
        return 0.05 * ((x * 7 // side + y * 5 // side) % 2) + 0.1 * x * y / side**2

    cells = [(y * side + x) for y in range(side - 1) for x in range(side - 1)]
    faces = [face for at in cells for face in ((at, at + 1, at + side), (at + 1, at + side + 1, at + side))]
    points = [(x / side, y / side, height(x, y)) for y in range(side) for x in range(side)]
    if name.endswith(".obj"):
        lines = [f"v {x:.6f} {y:.6f} {z:.6f}\n" for x, y, z in points]
        return "".join(lines + [f"f {a + 1} {b + 1} {c + 1}\n" for a, b, c in faces]).encode()
    if name.endswith(".stl"):
        body = bytearray(80) + len(faces).to_bytes(4, "little")
        for face in faces:
            body += array.array("f", (0, 0, 1, *points[face[0]], *points[face[1]], *points[face[2]])).tobytes() + b"\0\0"
        return bytes(body)
    head = (f"ply\nformat binary_little_endian 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\n"
            f"property float z\nelement face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n").encode()
    body = bytearray(head + array.array("f", (number for point in points for number in point)).tobytes())
    for face in faces:
        body += b"\3" + array.array("i", face).tobytes()
    return bytes(body)


class Bench:
    def __init__(self, options, folder):
        self.hogel, self.signal = os.path.abspath(options.hogel), getattr(signal, "SIG" + options.signal)
        self.sized = smaller if options.small else str
        self.side = 60 if options.small else 1000
        self.spool = folder / "spool"  # folder of temporary files outside the output's folder
        self.folder = folder / "work"
        self.spool.mkdir()
        self.folder.mkdir()
        self.made = set()

    def start(self, command):
        # Output goes to files: a full pipe would block the command.
        words = command.replace("OUT", "out").split()
        with open(self.spool.parent / "said", "wb") as said:
            return subprocess.Popen([self.hogel, *words, "--seed", SEED], cwd=self.folder, stdout=said, stderr=said,
                                    env=os.environ | {"TMPDIR": str(self.spool)}, start_new_session=True)

    def said(self):
        return (self.spool.parent / "said").read_text(errors="replace")

    def prepare(self, name):
        if name in self.made:
            return
        for needed in NEEDS.get(name, ()):
            self.prepare(needed)
        if name.startswith("mesh"):
            (self.folder / name).write_bytes(mesh_of(name, self.side))
        elif self.start(self.sized(INPUTS[name])).wait() != 0:
            sys.exit(f"{INPUTS[name]}: {self.said()}")
        self.made.add(name)

    def remove_output(self):
        for old in self.folder.glob("out*"):
            shutil.rmtree(old) if old.is_dir() else old.unlink()

    def files(self):
        return {str(each.relative_to(self.spool.parent)) for root in (self.spool, self.folder) for each in root.rglob("*")}

    def whole(self, command):
        """Returns the seconds of the complete command, up to MAX_SECONDS; None if it is not built in."""
        if command.startswith("view"):
            return VIEW_SECONDS
        began = time.monotonic()
        running = self.start(command)
        try:
            status = running.wait(timeout=MAX_SECONDS)
        except subprocess.TimeoutExpired:
            running.send_signal(self.signal)
            running.wait()
            status = 0
        took = time.monotonic() - began
        self.remove_output()
        if status != 0 and NOT_BUILT in self.said():
            return None
        if status != 0:
            sys.exit(f"{command}: {self.said()}")
        return min(took, MAX_SECONDS)

    def stop(self, command, moment):
        """Returns the seconds from a signal at this moment to the end (None if it ended before), and a text of the faults."""
        before = self.files()
        running = self.start(command)
        ended = threading.Event()
        if command.startswith("view"):
            threading.Thread(target=self.ask, args=(ended,), daemon=True).start()
        try:
            running.wait(timeout=moment)
            self.remove_output()
            return None, ""
        except subprocess.TimeoutExpired:
            pass
        at = time.monotonic()
        running.send_signal(self.signal)
        status = running.wait()
        took = time.monotonic() - at
        ended.set()
        wrong = self.faults(command, status, before) + self.processes_left(running.pid)
        self.remove_output()
        return took, wrong

    def faults(self, command, status, before):
        new = self.files() - before
        if command.startswith("make"):  # each of its files is complete
            new = {each for each in new if ".tmp" in each or ".part" in each}
        # The command may just have ended, or not have begun; a shell reports 128 + signal for both.
        expected = (0, -self.signal, 128 + self.signal)
        if status == 0:
            return ""
        faults = f"status {status}: {self.said().strip()[-200:]}; " if status not in expected else ""
        return faults + (f"left {', '.join(sorted(new)[:3])}; " if new else "")

    @staticmethod
    def processes_left(group):
        for _ in range(20):
            try:
                os.killpg(group, 0)
            except ProcessLookupError:
                return ""
            time.sleep(0.1)
        os.killpg(group, signal.SIGKILL)
        return "left a process; "

    def ask(self, ended):
        """Requests pictures from a viewer, one after the other, until `ended`."""
        number = 0
        while not ended.wait(0.2):
            number += 1
            address = next((word for word in self.said().split() if word.startswith("http")), "")
            try:
                view = f"eye={number % 30},0,300mm&focus=0mm&pupil=6mm&resolution=1200x1200&pupil-samples=400"
                urllib.request.urlopen(f"{address.rstrip('/')}/picture?{view}", timeout=5).read()
            except (OSError, ValueError):
                pass


def measure(bench, name, command, options):
    """Prints a row of the table; returns whether the command is within the limit."""
    whole = bench.whole(command)
    if whole is None:
        print(f"| {name} | not built | | | | |", flush=True)
        return True
    moments = [whole * (k + 0.5) / options.stops for k in range(options.stops)]
    times, wrong = [], ""
    for moment in moments:
        took, faults = bench.stop(command, moment)
        if took is not None and took > LIMIT:  # possibly disturbed by other work
            again, more = bench.stop(command, moment)
            took, faults = min(took, again if again is not None else took), faults + more
        times += [] if took is None else [took]
        wrong += faults
    figures = f"{max(times):.2f} s | {statistics.median(times):.2f} s" if times else "ended before | "
    print(f"| {name} | {whole:.1f} s | {len(times)} | {figures} | {wrong or 'as documented'} |", flush=True)
    return not wrong and max(times, default=0) <= LIMIT


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("hogel")
    parser.add_argument("--commands")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--scene")
    parser.add_argument("--stops", type=int, default=5)
    parser.add_argument("--signal", choices=("TERM", "INT", "HUP"), default="TERM")
    parser.add_argument("--small", action="store_true")
    parser.add_argument("--require", action="store_true")
    options = parser.parse_args()
    table = dict(COMMANDS)
    if options.scene:
        table |= {name: ((), command.replace("SCENE", os.path.abspath(options.scene))) for name, command in SCENE_COMMANDS.items()}
    names = {name.replace(",", ""): name for name in table}
    if options.list:
        print("\n".join(names))
        return
    wanted = [each.replace(",", "") for each in (options.commands.split(",") if options.commands else names)]
    if unknown := [each for each in wanted if each not in names]:
        sys.exit(f"unknown command '{unknown[0]}'; --list prints the names, without commas")
    late = []
    with tempfile.TemporaryDirectory(prefix="hogel_stops_") as folder:
        bench = Bench(options, pathlib.Path(folder))
        print("| command | whole | stops | longest | median | status and files |\n|---|---|---|---|---|---|", flush=True)
        for each in wanted:
            inputs, command = table[names[each]]
            for needed in inputs:
                bench.prepare(needed)
            if not measure(bench, names[each], bench.sized(command), options):
                late.append(each)
    if options.require and late:
        sys.exit("stopped after more than a second, or not as in docs/errors.md: " + "; ".join(late))


if __name__ == "__main__":
    main()
