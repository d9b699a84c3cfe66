#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the outputs of two builds of hogel byte by byte: samples, coefficients, pixels, patterns and streams.

usage: same_bytes.py OLD NEW [--all] [--only WORD] [--keep FOLDER]

OLD and NEW are the program folders of two builds, such as build/release/bin of this tree and of a git worktree of the commit
before a change. The old hogel runs each command of COMMANDS once. The new one runs it with 1 to 7 threads, on every SIMD target of
this processor and, if it has hogel-mpi, on 1 to 4 ranks: one variant of each kind in turn, with --all every variant. Both run the
scripts of tests/cli. Output files must have the same bytes, or the same contents if they store their provenance. Printed texts
must be equal except for times. Exit status 1: a difference was found.
"""
import argparse
import fnmatch
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import zlib

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[1]
CLI = ROOT / "tests" / "cli"
SIZE = "--hogels 24x20 --directions 24x24 --size 4mm"
CAMERA = "--resolution 60 --eye 0,0,200mm --pupil 5mm"
DEVICE = "--pixels 600x500 --pixel-pitch 8um"

# Inputs, computed once by the old program.
INPUTS = f"""
rays.h5       render pumpkin {SIZE} --depth
regions.h5    render pumpkin {SIZE} --region 3x3 --float
rows.h5       render pumpkin --hogels 40x24 --directions 32x1 --size 4mm
hemicube.h5   render tower {SIZE} --hemicube
packed.hgl    compress rays.h5 --sqnr 30
colours.h5    hologram rays.h5 --wavelength rgb
green.h5      hologram rays.h5 --wavelength 532nm
narrow.h5     render pumpkin --hogels 24x20 --directions 24x24 --size 4.608mm --fov 2.5deg --depth
coarse.h5     hologram narrow.h5 --wavelength 532nm --pitch 8um
wide.h5       hologram narrow.h5 --wavelength rgb --pitch 8um
"""

# Output and command. Commands marked 1 are not distributed over ranks.
COMMANDS = f"""
epi.h5          render pumpkin {SIZE} --depth
church.h5       render church --hogels 12x10 --directions 24x24 --size 4mm
raytrace.h5     render tower {SIZE} --algorithm raytrace
zbuffer.h5      render pumpkin {SIZE} --algorithm zbuffer
simplex.h5      render pumpkin --hogels 8x8 --directions 12x12 --size 4mm --algorithm simplex
mvr.h5          render pumpkin {SIZE} --algorithm mvr
oblique.h5      render pumpkin {SIZE} --algorithm oblique
faces.h5        render tower {SIZE} --hemicube
float.h5        render pumpkin {SIZE} --float
stream.hgl      render pumpkin {SIZE} --sqnr 30
sqnr.hgl        compress rays.h5 --sqnr 30 --tile 4x4
rate.hgl        compress rays.h5 --no-depth --ppb 2 --tile 5x4 --tone histogram
ezw.hgl         compress rays.h5 --no-depth --ppb 2 --coder ezw --tile 5x4
threepass.hgl   compress rays.h5 --no-depth --ppb 2 --rule histogram --coder threepass --tile 6x5
lossless.hgl    compress rays.h5 --lossless --tile 6x5
faces.hgl       compress hemicube.h5 --step 0.01
rows.hgl        compress rows.h5 --sqnr 25
unpacked.h5     decompress packed.hgl
fourier.h5      hologram rays.h5 --wavelength rgb
half.h5         hologram rays.h5 --wavelength rgb --half
olas.h5         hologram rays.h5 --wavelength 532nm --method olas
smooth.h5       hologram rays.h5 --wavelength 532nm --method olas --phase fixed
added.h5        hologram rays.h5 --wavelength 532nm --method phase-added
exact.h5        hologram rays.h5 --wavelength 532nm --method phase-added-exact
basis.h5        hologram regions.h5 --method basis --wavelength 633nm
lines.h5        hologram rows.h5 --wavelength 532nm
of_stream.h5    hologram packed.hgl --wavelength 532nm
of_faces.h5     hologram hemicube.h5 --wavelength 532nm --pitch 1um
of_scene.h5     hologram pumpkin {SIZE}
points.h5       hologram tower --hogels 8x8 --size 1mm --method points --spacing 60um
visible.h5      hologram tower --hogels 8x8 --size 1mm --method points-visible --spacing 60um
planes.h5       hologram tower --hogels 8x8 --size 1mm --method planes
polygons.h5     hologram plane --hogels 8x8 --size 1mm --method polygons
rays.exr        photo rays.h5 {CAMERA} --pupil-samples 16 --focus 20mm
scene.exr       photo tower {SIZE} {CAMERA} --geometric --pupil-samples 8
eye.exr         photo rays.h5 {CAMERA} --wave --looks 3 --camera eye
eyes.exr        photo tower {SIZE} {CAMERA} --wave --looks 2 --camera eye
looks.exr       photo rays.h5 {CAMERA} --wave --looks 13 --camera eye
bent.exr        photo rays.h5 {CAMERA} --wave --looks 9 --camera eye --focus 40mm
preview.exr     photo rays.h5 {CAMERA} --wave --looks 2 --camera eye --preview
expected.exr    photo rays.h5 {CAMERA} --looks expected --wave --focus 3mm
narrow.exr      photo colours.h5 {CAMERA}
narrow_tilt.exr photo green.h5 {CAMERA} --focus-tilt 20deg
beside.exr      photo green.h5 {CAMERA} --angle-of-view 2deg --focus 10mm
full.exr        photo colours.h5 {CAMERA} --camera full --focus 1mm
tilted.exr      photo green.h5 {CAMERA} --camera full --focus-tilt 20deg
film.png        photo green.h5 {CAMERA} --camera full --film-distance 50mm
phase.png       photo green.h5 {CAMERA} --camera full --display phase
shown.png       photo colours.h5 {CAMERA}
near.h5         propagate colours.h5 --distance 3mm
far.h5          propagate colours.h5 --distance 40mm --output-pitch 9um --output-samples 300x200 --offset-x 1mm
far.npy         propagate coarse.h5 --distance 40mm --output-pitch 9um --output-samples 300x200 --offset-x 1mm
back.png        propagate colours.h5 --distance -2mm
phase_only.png  slm coarse.h5 {DEVICE} --encoding phase
double.png      slm wide.h5 {DEVICE} --encoding double-phase
gradient.png    slm coarse.h5 {DEVICE} --encoding gradient --iterations 3
gradients.png   slm wide.h5 {DEVICE} --encoding gradient --iterations 3
saxton.png      slm coarse.h5 {DEVICE} --encoding gerchberg-saxton --iterations 3
intensity.png   slm coarse.h5 {DEVICE} --encoding intensity
bipolar.png     slm coarse.h5 {DEVICE} --encoding bipolar
burckhardt.png  slm coarse.h5 {DEVICE} --encoding burckhardt
lee.png         slm coarse.h5 {DEVICE} --encoding lee
binary.png      slm coarse.h5 {DEVICE} --encoding binary
made            make pumpkin {SIZE} --resolution 48 --looks 2 --pupil-samples 16 --store-hologram --keep-light-field
prints          1 print rays.h5
views           1 export rays.h5
baked.glb       1 bake tower
"""

# Preloaded library that restricts Highway to one SIMD target: HWY_TARGET is its bit.
PRELOADED = """#include <cstdint>
#include <cstdlib>
namespace hwy { __attribute__((visibility("default"))) int64_t SupportedTargets() { return std::atoll(std::getenv("HWY_TARGET")); } }
"""
LIST_TARGETS = """#include <hwy/targets.h>
#include <cstdio>
int main() { for (const int64_t target : hwy::SupportedAndGeneratedTargets()) std::printf("%lld %s\\n", (long long)target, hwy::TargetName(target)); }
"""
# Scripts that test times, the network, or files that contain the time of day.
NOT_COMPARED = {"view.txt", "json.txt", "manual.txt", "options.txt", "provenance.txt", "provenance_photo.txt"}
TIMES = re.compile(r"\b[\d.]+ ?(s|ms|min|minutes?|seconds?|h)\b|\d[\d.,]* [kMG]?B/s|\"(seconds|threads)\": *[\d.e+-]+|\d+ threads?")


def png_pixels(data):
    """Returns header, palette and pixels of a PNG file, without texts."""
    at, kept, packed = 8, [], b""
    while at + 8 <= len(data):
        size, kind = int.from_bytes(data[at:at + 4], "big"), data[at + 4:at + 8]
        body = data[at + 8:at + 8 + size]
        if kind == b"IDAT":
            packed += body
        elif kind not in (b"tEXt", b"zTXt", b"iTXt", b"tIME"):
            kept.append((kind, body))
        at += 12 + size
    return kept, zlib.decompress(packed)


def hdf5_contents(path):
    import h5py
    found = {}

    def visit(name, item):
        values = {key: value.tobytes() if hasattr(value, "tobytes") else value for key, value in item.attrs.items()
                  if not isinstance(value, str)}
        found[name] = (values, item[()].tobytes() if isinstance(item, h5py.Dataset) else None)

    with h5py.File(path) as file:
        visit("/", file)
        file.visititems(visit)
    return found


def same_contents(a, b):
    """Returns None if two files contain the same numbers, otherwise a description of the difference."""
    one, other = a.read_bytes(), b.read_bytes()
    if one == other:
        return None
    try:
        if one[:8] == b"\x89PNG\r\n\x1a\n" and png_pixels(one) == png_pixels(other):
            return None
        if one[:4] == b"\x89HDF" and hdf5_contents(a) == hdf5_contents(b):
            return None
    except (OSError, ValueError, zlib.error, ImportError) as problem:
        return f"cannot be compared: {problem}"
    if a.suffix in (".html", ".json", ".txt", ".md", ".svg"):
        return None if TIMES.sub("T", a.read_text()) == TIMES.sub("T", b.read_text()) else "other words"
    first = next((at for at, (x, y) in enumerate(zip(one, other)) if x != y), min(len(one), len(other)))
    return f"{len(one)} and {len(other)} bytes, first difference at {first}"


def differences(old, new):
    """Returns the differences of two files or folders."""
    if old.exists() != new.exists():
        return [f"{(old if old.exists() else new).name}: only the {'old' if old.exists() else 'new'} program wrote it"]
    if old.is_dir():
        names = sorted({path.relative_to(top) for top in (old, new) for path in top.rglob("*") if path.is_file()})
        return [line for name in names for line in differences(old / name, new / name)]
    if not old.exists():
        return []
    problem = same_contents(old, new)
    return [f"{old.name}: {problem}"] if problem else []


class Build:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder).resolve()
        if not (self.folder / "hogel").is_file():
            sys.exit(f"{folder}: has no program hogel; expected a folder such as build/release/bin")

    def run(self, words, folder, threads=2, ranks=None, environment=None):
        command = [self.folder / "hogel", *words, "--threads", str(threads)]
        if ranks:
            command = ["mpirun", "--oversubscribe", "--bind-to", "none", "-n", str(ranks), self.folder / "hogel-mpi", *words,
                       "--threads", str(threads)]
        allowed = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
        done = subprocess.run(command, cwd=folder, env=os.environ | allowed | (environment or {}), stdin=subprocess.DEVNULL,
                              capture_output=True, text=True)
        return done.returncode, done.stderr


class Comparison:
    def __init__(self, asked, folder):
        self.old, self.new, self.all = Build(asked.old), Build(asked.new), asked.all
        self.only, self.folder = asked.only or "", folder
        self.runs, self.found = 0, []
        self.targets = self.simd_targets()

    def simd_targets(self):
        (self.folder / "targets.cpp").write_text(LIST_TARGETS)
        (self.folder / "preloaded.cpp").write_text(PRELOADED)
        self.preloaded = self.folder / "preloaded.so"
        compiler = os.environ.get("CXX", "c++")
        subprocess.run([compiler, "-std=c++20", "targets.cpp", "-o", "targets", "-lhwy"], cwd=self.folder, check=True)
        subprocess.run([compiler, "-std=c++20", "-shared", "-fPIC", "preloaded.cpp", "-o", self.preloaded], cwd=self.folder,
                       check=True)
        listed = subprocess.run(["./targets"], cwd=self.folder, check=True, capture_output=True, text=True).stdout
        return [tuple(line.split()) for line in listed.splitlines()]

    def say(self, name, lines):
        self.runs += 1
        for line in lines:
            self.found.append(name)
            print(f"{name}: {line}", flush=True)

    def variants(self, number, shared):
        """Yields the variants for the new program: title and arguments of Build.run()."""
        threads = [(f"{n} threads", {"threads": n}) for n in range(1, 8)]
        targets = [(name, {"environment": {"LD_PRELOAD": str(self.preloaded), "HWY_TARGET": bit}}) for bit, name in self.targets]
        ranks = [(f"{n} processes", {"threads": 1, "ranks": n}) for n in range(1, 5)] if shared else []
        for kind in (threads, targets, ranks):
            if kind and self.all:
                yield from kind
            elif kind:
                yield kind[number % len(kind)]

    def inside(self, name, inputs):
        """Creates a folder that contains only the inputs."""
        folder = self.folder / name
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        for each in inputs:
            (folder / each).hardlink_to(self.folder / "old" / each)
        return folder

    def compare_commands(self):
        old = self.folder / "old"
        old.mkdir()
        for line in INPUTS.strip().splitlines():
            output, *words = line.split()
            status, error = self.old.run([*words, "-o", output], old)
            if status:
                sys.exit(f"the old program could not make {output}: {error}")
        inputs = [path.name for path in old.iterdir()]
        has_mpi = (self.new.folder / "hogel-mpi").is_file() and shutil.which("mpirun")
        for number, line in enumerate(COMMANDS.strip().splitlines()):
            output, *words = line.split()
            shared = words[0] != "1" and has_mpi
            words = words[words[0] == "1":]
            if self.only not in line:
                continue
            words += ["-o", output]
            expected = self.old.run(words, old)[0]
            for title, how in self.variants(number, shared):
                # Only the SIMD target may change bytes.
                reference = self.inside("old_target", inputs) if "environment" in how else old
                if reference != old:
                    expected = self.old.run(words, reference, **how)[0]
                new = self.inside("new", inputs)
                status, error = self.new.run(words, new, **how)
                lines = differences(reference / output, new / output)
                if status != expected:
                    lines.append(f"status {status} instead of {expected}: {error.strip()}")
                self.say(f"{output}, {title}", lines)

    def compare_scripts(self):
        for script in sorted(CLI.glob("*.txt")):
            if script.name in NOT_COMPARED or self.only not in script.name:
                continue
            lines = script.read_text().splitlines()
            folders = [self.folder / f"{script.stem}.{name}" for name in ("old", "new")]
            environments = []
            for folder, build in zip(folders, (self.old, self.new)):
                (folder / "work").mkdir(parents=True)
                environments.append({"PATH": f"{build.folder}:{os.environ['PATH']}", "HOME": str(folder), "LC_ALL": "C.UTF-8",
                                     "TOOLS": str(CLI), "PYTHON": sys.executable, "HOGEL_THOROUGH": ""})
            if any(subprocess.run(["bash", "-c", line[6:]], env=environments[0], capture_output=True).returncode
                   for line in lines if line.startswith("needs ")):
                continue
            for number, line in enumerate(lines, 1):
                if line.startswith("$ "):
                    self.say(f"{script.name}:{number}", self.compare_step(line[2:], folders, environments))
            for folder in folders:
                shutil.rmtree(folder)

    def compare_step(self, command, folders, environments):
        before = [{path: path.stat().st_mtime_ns for path in (folder / "work").rglob("*") if path.is_file()} for folder in folders]
        done = [subprocess.run(["bash", "-c", command], cwd=folder / "work", env=environment, stdin=subprocess.DEVNULL,
                               capture_output=True, text=True, errors="replace")
                for folder, environment in zip(folders, environments)]
        lines = []
        if done[0].returncode != done[1].returncode:
            lines.append(f"status {done[1].returncode} instead of {done[0].returncode}: {done[1].stderr.strip()}")
        for name, streams in (("output", [each.stdout for each in done]), ("messages", [each.stderr for each in done])):
            texts = [TIMES.sub("T", stream.replace(str(folder), "")) for stream, folder in zip(streams, folders)]
            if texts[0] != texts[1]:
                lines.append(f"other {name}:\n  - {texts[0].strip()}\n  + {texts[1].strip()}")
        changed = {path.relative_to(folder) for folder, known in zip(folders, before)
                   for path in (folder / "work").rglob("*") if path.is_file() and known.get(path) != path.stat().st_mtime_ns}
        for path in sorted(changed):
            if not fnmatch.fnmatch(path.name, "*.py"):
                lines += differences(folders[0] / path, folders[1] / path)
        return lines


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    arguments.add_argument("old", metavar="OLD")
    arguments.add_argument("new", metavar="NEW")
    arguments.add_argument("--all", action="store_true", help="run each command with every number of threads and ranks and every target")
    arguments.add_argument("--only", metavar="WORD", help="run only the commands and scripts that contain WORD")
    arguments.add_argument("--keep", metavar="FOLDER", help="new folder for the outputs")
    asked = arguments.parse_args()
    folder = pathlib.Path(asked.keep or tempfile.mkdtemp(prefix="hogel-same-"))
    folder.mkdir(exist_ok=True)
    try:
        comparison = Comparison(asked, folder)
        comparison.compare_commands()
        comparison.compare_scripts()
    finally:
        if not asked.keep:
            shutil.rmtree(folder)
    print(f"{comparison.runs} runs compared, {len(comparison.found)} differences")
    return 1 if comparison.found else 0


sys.exit(main())
