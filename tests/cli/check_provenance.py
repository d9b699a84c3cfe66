#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that files store the options that acted on them, and no other.

Each case is a command line. An option of the command gets another value, and the output is compared with that
of the case. An option that changes it must be stored with that value, and one that does not must not be; and where the
case stores an option, or has a default that acts, another value must change the output. So what is stored is held to
what acted, not to a list.

With HOGEL_THOROUGH=1 in the environment each option is tried in every case of its command. Otherwise it is tried in the
cases that are about it, those whose line names it or whose table has another value for it, and then in others, by turns,
until it acts; where it acts in none, in no others.

usage: check_provenance.py COMMAND...    in a folder with the files that make_provenance_inputs.sh makes; hogel in the PATH
"""
import concurrent.futures
import functools
import io
import json
import os
import re
import struct
import subprocess
import sys

import h5py

# Options that decide how the work is done or where its result goes.
SILENT = "help quiet verbose threads output resume part region json force store-hologram".split()

# An option that acts, although no other value shows it: another is refused, or the scene of the case looks the same.
ACTS = object()

# Another value of every option, with further options that it needs; None: the flag alone.
OTHER = {
    # renderings
    "algorithm": "mvr", "shading": "direct", "shadow-map": "4", "cache-spacing": "2", "cull-back-faces": None,
    "hogels": "5x4", "directions": "9x8", "samples": "2", "size": "1.3mm", "fov": "14deg", "toward": "0.5deg",
    "front": "0.7", "as-is": None, "fit": None, "hemicube": None, "frequencies": "633nm", "focal-plane": "-50mm", "interpolate": "2",
    "depth": None, "float": None,
    # scenes
    "up": "z", "rotate": "10,20,30deg", "scene-camera": "1", "scale": "0.6", "move": "0.1,0.05,0.1mm", "colour": "#3060c0", "texture": "other.exr",
    "light": "1,1,1:red:2", "background": "#406080", "ground": "#907050", "point-size": "0.5",
    "seed": "7",
    # holograms
    "wavelength": "560nm", "pitch": "1.3um", "line-pitch": "10um", "method": "basis", "phase": "designed",
    "lobes": "amplitude", "basis": "haar", "tolerance": "0.5", "spacing": "70um", "planes": "2", "half": None,
    # cameras
    "eye": "2,0,40mm", "gaze": "0.1,0,0mm", "focus": "2mm", "focus-tilt": "20deg", "pupil": "2mm", "f-number": "20",
    "focal-length": "30mm", "angle-of-view": "1deg", "resolution": "9", "to-eye": "2,0,40mm --frames 3", "to-focus": "3mm --frames 3",
    "frames": "3", "frame-rate": "24", "looks": "3", "exposure": "0.1", "display": "log", "camera": "full",
    "film-distance": "30mm", "preview": ACTS, "diffuser": ACTS, "geometric": None, "wave": None, "pupil-samples": "5", "values": "phase",
    "imaginary": "imaginary.exr", "variable": "b", "conjugate": None, "phase-code": "odak", "input-phase-code": "odak",
    "phases": "imaginary.exr", "zero": "99", "aperture": "0.1", "reference-source": "0,0,-20mm",
    "reconstruct": "fourier --focal 40mm", "focal": "50mm",
    # compression
    "sqnr": "25", "ppb": "3", "step": "0.1", "max-error": "0.1", "lossless": None, "coder": "threepass",
    "transform": "haar", "table": "jpeg", "no-depth": None, "depth-error": "1mm", "tone": "histogram --tone-decades 0.1",
    "tone-decades": "0.2", "symbols": "alphabets", "rule": "histogram", "overhead": "1", "chrominance": "9", "tile": "3x2", "layers": "1",
    # fields and patterns
    "distance": "3mm", "output-pitch": "2um", "output-samples": "70x60", "offset-x": "40um", "offset-y": "40um",
    "encoding": "double-phase", "reference": "1.2deg", "clip": "0.3", "window": "9", "iterations": "2",
    "device": "leto", "pixels": "90x70", "pixel-pitch": ACTS, "levels": "4",
    # sets of views
    "layout": ACTS, "transfer": "linear", "views": "6x8", "mirror": "columns", "projection": "orthographic", "disparity": "1",
    "column": "first", "depth-scale": "7", "middle": "4x4", "densify": "2 --estimate-disparity", "estimate-disparity": ACTS,
    # prints
    "strips": None, "order": "rows",
}

# Options that act in no case of these commands.
IDLE = {
    "render": "fit interpolate scene-camera seed",
    "hologram": "cache-spacing fit scene-camera texture point-size",
    "propagate": "values variable seed",
    "slm": "device pixel-pitch pitch wavelength values input-phase-code imaginary phases zero variable conjugate order reconstruct "
           "focal seed",
    "compress": "seed",
    "decompress": "seed",
    "import": "depth sqnr layout depth-scale estimate-disparity seed",
    "print": "seed",
    "photo": "frame-rate preview line-pitch basis tolerance algorithm shadow-map cache-spacing toward fit scene-camera texture point-size "
             "phase-code imaginary phases zero variable order reconstruct focal",
}

SMALL = "--hogels 6x4 --directions 8x6 --size 1mm"
LIGHT = "--hogels 6x4 --directions 8x6 --size 0.5mm --pitch 1.6um"
PHOTO = "--eye 0,0,40mm --pupil 4mm --resolution 8"
MODULATOR = "--pixels 128x96 --pixel-pitch 6.4um --window 32"

# Name, command line, output, and other values in place of those above.
CASES = [
    ("render", f"render m.obj {SMALL} --float", "o.h5", {}),
    ("render as is", f"render m.obj --as-is {SMALL} --float", "o.h5", {"ground": ACTS}),
    ("render posed", f"render m.obj --rotate 5,6,7deg --light 1,0,1 --scale 0.9 {SMALL} --float", "o.h5", {}),
    ("render textured", f"render u.obj {SMALL} --float", "o.h5", {"cull-back-faces": ACTS}),
    ("render points", f"render cloud.xyz {SMALL} --float", "o.h5", {}),
    ("render built-in", f"render sphere {SMALL} --float", "o.h5", {"cull-back-faces": ACTS}),
    ("render by samples", f"render m.obj {SMALL} --float --shading direct", "o.h5", {"shading": "vertex"}),
    ("render hemicube", "render m.obj --hogels 6x4 --directions 8x6 --size 1mm --float --hemicube", "o.h5",
     {"directions": "8x4", "fov": "120deg"}),
    ("render frequencies", "render m.obj --algorithm raytrace --frequencies 633nm --hogels 6x4 --size 0.2mm --float", "o.h5",
     {"frequencies": "500nm", "algorithm": ACTS, "fov": "10deg"}),
    ("render focal plane", f"render m.obj --focal-plane -40mm {SMALL} --float", "o.h5", {}),
    ("render interpolated", f"render m.obj --algorithm simplex --interpolate 3 --front -0.2 --shading direct {SMALL} --float", "o.h5",
     {"algorithm": ACTS, "shading": "vertex", "front": "-0.3", "interpolate": ACTS, "as-is": ACTS, "hemicube": ACTS}),
    ("render compressed", f"render m.obj {SMALL}", "o.hgl", {}),
    ("hologram", "hologram x.h5 --wavelength 532nm --pitch 1.6um", "o.h5", {}),
    ("hologram lines", "hologram row.h5 --wavelength 532nm --pitch 1.6um --method lines", "o.h5", {}),
    ("hologram basis lines", "hologram row.h5 --wavelength 532nm --pitch 1.6um --method basis-lines", "o.h5", {"method": "lines"}),
    ("hologram basis", "hologram x.h5 --wavelength 532nm --pitch 1.6um --method basis", "o.h5", {"method": "fourier"}),
    ("hologram of coefficients", "hologram fringes.hgl --wavelength 532nm --pitch 1.6um --method basis", "o.h5",
     {"method": "fourier", "basis": "cdf97"}),
    ("hologram added", "hologram deep.h5 --wavelength 532nm --pitch 1.6um --method phase-added", "o.h5", {}),
    ("hologram olas", "hologram deep.h5 --wavelength 532nm --pitch 1.6um --method olas", "o.h5", {"phase": "fixed"}),
    ("hologram smooth", "hologram deep.h5 --wavelength 532nm --pitch 1.6um --method olas --phase fixed", "o.h5",
     {"phase": "random"}),
    ("hologram of a scene", f"hologram m.obj {LIGHT} --wavelength 532nm", "o.h5", {}),
    ("points", "hologram m.obj --method points --spacing 60um --size 0.2mm --pitch 2um --wavelength 532nm", "o.h5",
     {"method": "edges", "hogels": "10x7"}),
    ("fresnel", "hologram m.obj --method fresnel --size 0.2mm --pitch 2um --wavelength 532nm --front -12 --shading shadowed",
     "o.h5", {"method": "edges", "hogels": "10x7", "shading": "vertex", "front": "-14", "size": "0.25mm", "as-is": ACTS}),
    ("photo of lines", "photo lines.h5 --eye 0,0,40mm --pupil 1mm --resolution 8 --focus 1mm --diffuser vertical", "o.png",
     {"diffuser": "none", "camera": ACTS, "focus-tilt": ACTS}),
    ("photo of a hologram", f"photo f.h5 {PHOTO} --focus 1mm", "o.png", {"camera": ACTS}),
    ("photo, full camera", "photo f.h5 --eye 0,0,40mm --pupil 1mm --resolution 8 --camera full", "o.exr", {"camera": "narrow"}),
    ("photo, f-number", f"photo f.h5 --eye 0,0,40mm --f-number 12 --resolution 8", "o.exr", {}),
    ("photo, linear", f"photo f.h5 {PHOTO}", "o.exr", {}),
    ("photo, logarithmic", f"photo f.h5 {PHOTO} --display log", "o.exr", {"display": "intensity"}),
    ("photo, frames", f"photo f.h5 {PHOTO} --frames 2 --to-eye 1,0,40mm", "o##.png",
     {"to-eye": "2,0,40mm", "to-focus": "3mm"}),
    ("photo by rays", f"photo x.h5 {PHOTO} --focus 1mm", "o.exr", {"focus-tilt": ACTS}),
    ("photo by waves", f"photo x.h5 {PHOTO} --wave --pitch 1.6um --looks 2", "o.exr", {}),
    ("photo without speckle", "photo x.h5 --eye 0,0,40mm --pupil 1mm --resolution 8 --wave --pitch 1.6um --looks expected",
     "o.exr", {"camera": ACTS, "method": ACTS, "phase": ACTS, "focus-tilt": ACTS, "wave": ACTS}),
    ("photo of a scene", f"photo m.obj {LIGHT} {PHOTO} --looks 2", "o.exr", {"algorithm": ACTS, "toward": ACTS, "size": "0.6mm"}),
    ("photo of an array", f"photo f.npy {PHOTO} --pitch 1.6um --wavelength 532nm", "o.exr", {}),
    ("photo of phases", f"photo real.npy {PHOTO} --pitch 1.6um --wavelength 532nm --values phase", "o.png",
     {"values": "amplitude"}),
    ("propagate, two pictures", "propagate real.exr --imaginary imaginary.exr --distance 1mm --pitch 1.6um --wavelength 532nm",
     "o.h5", {"imaginary": "other.exr"}),
    ("propagate, two levels", "propagate re.png --imaginary im.png --distance 1mm --pitch 1.6um --wavelength 532nm", "o.h5",
     {"imaginary": "re.png"}),
    ("propagate, phase picture", "propagate re.png --phase-code odak --distance 1mm --pitch 1.6um --wavelength 532nm", "o.h5",
     {"phase-code": "slmsuite"}),
    ("propagate, amplitude and phase", "propagate re.png --phases im.png --phase-code odak --distance 1mm --pitch 1.6um --wavelength 532nm",
     "o.h5", {"phase-code": "slmsuite", "phases": "re.png"}),
    ("propagate, pattern", "propagate pattern.png --distance 1mm", "o.h5", {"phase-code": "slmsuite"}),
    ("propagate, archive", "propagate f.npz --distance 1mm", "o.h5", {}),
    ("propagate, order", "propagate f.h5 --distance 1mm --order +1", "o.h5", {"order": "-1"}),
    ("propagate, behind a lens", "propagate f.h5 --distance 1mm --reconstruct fourier --focal 40mm", "o.h5",
     {"reconstruct": "fresnel", "output-pitch": ACTS}),  # its image has samples of two pitches
    ("propagate", "propagate f.h5 --distance 1mm", "o.h5", {}),
    ("propagate, picture", "propagate f.npy --distance 1mm --pitch 1.6um --wavelength 532nm", "o.png", {"conjugate": None}),
    ("phase", f"slm s.h5 {MODULATOR} --encoding phase", "o.png", {}),
    ("double phase", f"slm s.h5 {MODULATOR} --encoding double-phase", "o.png", {"encoding": "phase"}),
    ("Gerchberg-Saxton", f"slm s.h5 {MODULATOR} --encoding gerchberg-saxton", "o.png", {}),
    ("gradient", f"slm s.h5 {MODULATOR} --encoding gradient", "o.png", {}),
    ("bipolar", f"slm s.h5 {MODULATOR} --encoding bipolar", "o.png", {}),
    ("binary", f"slm s.h5 {MODULATOR} --encoding binary", "o.png", {}),
    ("burckhardt", f"slm s.h5 {MODULATOR} --encoding burckhardt", "o.png", {}),
    ("slm device", "slm s.h5 --device leto --encoding phase", "o.png", {"device": ACTS}),
    ("compress", "compress deep.h5", "o.hgl", {}),
    ("compress, wavelets", "compress x.h5 --coder threepass --step 0.01", "o.hgl",
     {"coder": "ezw", "step": "0.05", "symbols": ACTS}),
    ("compress, rule", "compress x.h5 --coder threepass --ppb 0.07 --rule histogram", "o.hgl",
     {"ppb": "0.1", "rule": "search", "coder": "fringes", "tone": ACTS, "chrominance": ACTS}),
    ("compress, jpeg", "compress x.h5 --coder jpeg4d --sqnr 30", "o.hgl", {"transform": ACTS}),
    ("compress, hemicube", "compress five.h5 --tone histogram --tone-decades 0.1", "o.hgl",
     {"hemicube": "unfolded", "tone": "none"}),
    ("compress, rate", "compress x.h5 --coder ezw --ppb 0.13", "o.hgl",
     {"ppb": "0.14", "coder": ACTS, "transform": ACTS, "tone": ACTS, "chrominance": ACTS}),
    ("compress, bounded", "compress x.h5 --max-error 0.05", "o.hgl", {"coder": ACTS}),
    ("compress, exact", "compress x.h5 --lossless", "o.hgl", {"coder": ACTS}),
    ("decompress", "decompress x.hgl", "o.h5", {}),
    ("decompress exact", "decompress exact.hgl", "o.h5", {}),
    ("import cameras", "import views --views 8x6 --projection cameras", "o.h5", {"spacing": "9mm"}),
    ("import by disparity", "import views --views 8x6 --projection cameras --densify 2 --estimate-disparity --depth", "o.h5",
     {"spacing": "9mm", "mirror": ACTS, "densify": "3", "depth": ACTS}),
    ("import orthographic", "import views --views 8x6", "o.h5", {"projection": "cameras"}),
    ("import rows and columns", "import ordered --column second", "o.h5", {"views": ACTS, "projection": "orthographic"}),
    ("print", "print x.h5 --strips", "o", {"strips": None}),
]


def hogel(*words):
    return subprocess.run(["hogel", *words], capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=120)


@functools.cache
def options_of(command):
    """The options of a command, and whether the help shows a default."""
    parts = re.split(r"^  (?:-\w,)?--([a-z-]+)", hogel("help", command).stdout, flags=re.M)
    return {name: re.search(r" \[[^\]]+\]$", text, re.M) is not None for name, text in zip(parts[1::2], parts[2::2])}


def made(output):
    """The files of an output: its folder's, or its numbered pictures."""
    if os.path.isdir(output):
        return sorted(os.path.join(output, name) for name in os.listdir(output))
    if "##" in output:
        return sorted(name for name in os.listdir(".") if re.fullmatch(output.replace("##", r"\d\d"), name))
    return [output] if os.path.exists(output) else []


def run(words, output):
    """Runs a command line and returns its files, or none if it was refused."""
    for name in made(output):
        os.remove(name)
    done = hogel(*words, "-o", output, "-q", "--threads", "1")
    if done.returncode not in (0, 2, 3):
        sys.exit(f"hogel {' '.join(words)}: status {done.returncode}: {done.stderr}")
    return [File(name) for name in made(output)] if done.returncode == 0 else []


class File:
    """`options`: what it stores of the command that made it; `facts`: what else it says, and what it holds."""
    MADE_BY = re.compile(r"(source )*(software|command|option .*|camera|(efficiency|correlation|iterations|reference angle) at .*)|exposure|shading"
                         r"|renderer|filler")

    def __init__(self, name):
        self.name = name
        with open(name, "rb") as file:
            self.bytes = file.read()
        metadata, self.contents = READERS[os.path.splitext(name)[1]](self.bytes)
        self.options = {key[7:]: {"yes": True, "no": False}.get(value, value)
                        for key, value in metadata.items() if key.startswith("option ")}
        self.facts = {key: value for key, value in metadata.items() if not self.MADE_BY.fullmatch(key)}


def read_hdf5(data):
    """Texts of the file, and datasets and groups with their attributes."""
    contents = {}

    def add(name, item):
        contents[name] = {key: repr(value) for key, value in item.attrs.items()}
        if isinstance(item, h5py.Dataset):
            contents[name]["data"] = (item.shape, item.dtype, item[()].tobytes())

    with h5py.File(io.BytesIO(data)) as file:
        file.visititems(add)
        return {key: value.decode() if isinstance(value, bytes) else value for key, value in file.attrs.items()}, contents


def read_png(data):
    """Texts, and the other parts."""
    texts, parts, at = {}, [], 8
    while at < len(data):
        size, kind = struct.unpack_from(">I4s", data, at)
        part = data[at + 8:at + 8 + size]
        if kind == b"tEXt":
            name, text = part.decode("latin-1").split("\0")
            texts[name] = text
        else:
            parts.append((kind, part))
        at += size + 12
    return texts, parts


def read_exr(data):
    """Texts, and the other attributes with the blocks of pixels, which follow the table of their places."""
    texts, others, at = {}, {}, 8
    while data[at]:
        name, kind, rest = data[at:].split(b"\0", 2)
        size, = struct.unpack_from("<i", rest)
        at += len(name) + len(kind) + 6
        (texts if kind == b"string" else others)[name.decode()] = data[at:at + size].decode() if kind == b"string" else data[at:at + size]
        at += size
    first, = struct.unpack_from("<Q", data, at + 1)
    return texts, (others, data[first:])


def read_hgl(data):
    """Texts; what it holds is for hogel to decode."""
    def text():
        nonlocal at
        size, = struct.unpack_from("<I", data, at)
        at += 4 + size
        return data[at - size:at].decode()

    at = 16 + 5 * 8 + 5 * 8  # behind the extents and the geometry: docs/format.md
    text()
    at += 16
    text(), text()
    count, = struct.unpack_from("<I", data, at)
    at += 4
    return {text(): text() for _ in range(count)}, None


READERS = {".h5": read_hdf5, ".png": read_png, ".exr": read_exr, ".hgl": read_hgl}


def told(name):
    """What hogel says of a stream, without how it was made and how many bytes it takes."""
    left_out = re.compile(r"bytes|.*_bytes|pixels_per_bit|layers_end_at")
    said = json.loads(hogel("info", "--json", name).stdout)
    return {key: value for key, value in said.items() if not File.MADE_BY.fullmatch(key) and not left_out.fullmatch(key)}


def same_stream(one, other):
    """Whether two streams are decoded to the same."""
    compared = hogel("compare", "--json", one.name, other.name)
    return compared.returncode == 0 and json.loads(compared.stdout)["max_error"] == 0 and told(one.name) == told(other.name)


def same_contents(one, other):
    if one.bytes == other.bytes:
        return True
    if one.facts != other.facts:
        return False
    return same_stream(one, other) if one.contents is None else one.contents == other.contents


def same(a, b):
    """Whether two outputs have the same contents."""
    return len(a) == len(b) and all(map(same_contents, a, b))


def with_option(words, option, value):
    """The command line with another value of an option; a flag that is there is taken away."""
    words = list(words)
    if f"--{option}" in words:
        at = words.index(f"--{option}")
        if value is None:
            return words[:at] + words[at + 1:]
        return words[:at + 1] + value.split() + words[at + 2:]
    return words + [f"--{option}"] + ([] if value is None else value.split())


class Case:
    """A command line, its output, and what became of it with other values of its options."""

    def __init__(self, name, line, output, others):
        self.name, self.line, self.output, self.others = name, line, output, others
        self.words = line.split()
        self.command = self.words[0]
        # Trials run at the same time, so each has a file of its own.
        self.stem = re.sub("[^a-z]", "", name)
        self.base = f"{self.stem}-base-{output}"
        self.tried = {}  # option: whether it acted

    def make(self):
        """The output as the line says; returns complaints."""
        self.first = run(self.words, self.base)
        if not self.first:
            return [f"{self.name}: refused: {hogel(*self.words, '-o', self.base).stderr}"]
        self.acted = dict(self.first[0].options)
        positional = {"render": "scene", "import": "source"}.get(self.command, "input")
        return [] if self.acted.pop(positional, None) == self.words[1] else [f"{self.name}: {positional} is not stored"]

    def other_value(self, option):
        return self.others.get(option, OTHER.get(option, ""))

    def names(self, option):
        return f"--{option}" in self.words

    def attempt(self, option):
        """The output with another value of an option; returns complaints."""
        value = self.other_value(option)
        if value == "":
            return [f"{self.name}: no other value of --{option} is known"]
        output = f"{self.stem}-{option}-{self.output}"
        files = run(with_option(self.words, option, value), output)
        acts = bool(files) and not same(self.first, files)
        alike = bool(files) and files[0].bytes == self.first[0].bytes
        says = (self.first if alike else files)[0].options.get(option) if files else None
        self.tried[option] = acts
        remove(output)
        return self.judged(option, value, bool(files), acts, says)

    def judged(self, option, value, made_any, acts, says):
        """`says`: what the output with the other value stores of the option."""
        complaints, stored = [], self.acted.get(option)
        is_default = stored is True and not self.names(option)  # a flag that stands for a default
        if stored is not None and not acts and not is_default:
            complaints.append(f"{self.name}: --{option} is stored as {stored} but does not act")
        if made_any and not acts and says is not None and not is_default:
            complaints.append(f"{self.name}: --{option} does not act, but is stored where it is given")
        if acts and stored is None and options_of(self.command)[option]:
            complaints.append(f"{self.name}: the default of --{option} acts, but is not stored")
        if acts and stored is None and self.names(option):
            complaints.append(f"{self.name}: --{option} acts, but is not stored")
        wanted = not self.names(option) if value is None else value.split()[0]
        if acts and says != wanted and not (wanted is False and says is None) and option != "pitch":
            complaints.append(f"{self.name}: --{option} {value} acts, but is stored as {says}")
        return complaints


def remove(output):
    for file in made(output):
        os.remove(file)
    if os.path.isdir(output):
        os.rmdir(output)


def tried_options(command):
    return [option for option in options_of(command) if option not in SILENT]


def about(case, option, cases):
    """Whether a case is about an option: its table has another value for it, or its line names it and most others do not."""
    naming = sum(each.names(option) for each in cases)
    return option in case.others or case.names(option) and 2 * naming < len(cases)


def try_option(option, cases):
    """Returns complaints."""
    cases = [case for case in cases if case.other_value(option) is not ACTS]
    wanted = cases if THOROUGH else [case for case in cases if about(case, option, ALL[case.command])]
    complaints = [line for case in wanted for line in case.attempt(option)]
    for case in others_by_turns(option, [case for case in cases if case not in wanted]):
        if any(each.tried.get(option) for each in cases):
            break
        complaints += case.attempt(option)
    return complaints


def others_by_turns(option, cases):
    """Each option begins with another case, first of those that store it, where there are any, and goes on with those that
    store the most others."""
    if not cases or option in IDLE[cases[0].command].split():
        return []
    turn = tried_options(cases[0].command).index(option) % len(cases)
    first, *rest = sorted(cases[turn:] + cases[:turn], key=lambda case: option not in case.acted)
    return [first, *sorted(rest, key=lambda case: (option not in case.acted, -len(case.acted)))]


def check_idle(command, cases):
    """That IDLE is right."""
    acting = {option for case in cases for option, acts in case.tried.items() if acts}
    idle = set(tried_options(command)) - acting
    return [f"{command}: no case lets --{option} act" for option in idle - set(IDLE[command].split())] + \
           [f"{command}: --{option} acts" for option in set(IDLE[command].split()) - idle]


# What defaults stand for: a command line, and values that its output stores of options that were not given.
DEFAULTS = [
    ("hologram x.h5 --wavelength 532nm --pitch 1.7um", "o.h5", {"pitch": "1.70068um", "phase": "random", "method": "fourier"}),
    ("hologram x.h5 --wavelength 532nm --pitch 1.6um --method basis", "o.h5", {"basis": "cdf97", "phase": "fixed"}),
    ("hologram fringes.hgl --wavelength 532nm --pitch 1.6um --method basis", "o.h5", {"basis": "haar"}),
    ("compress x.h5", "o.hgl", {"sqnr": "40"}),
    ("compress x.h5 --coder threepass", "o.hgl", {"sqnr": "40", "transform": "cdf97", "symbols": "bits"}),
    ("compress x.h5 --coder threepass --ppb 0.08 --rule planes", "o.hgl", {"rule": "planes", "overhead": "2.5"}),
    ("compress x.h5 --coder jpeg4d", "o.hgl", {"transform": "dct8", "table": "own"}),
    (f"render m.obj {SMALL}", "o.hgl", {"sqnr": "40"}),
    ("decompress exact.hgl", "o.h5", {"float": True}),
    ("propagate f.h5 --distance 1mm", "o.h5", {"output-samples": "312x208", "output-pitch": "1.60256um"}),
    (f"photo x.h5 {PHOTO}", "o.png", {"geometric": True}),
    (f"photo x.h5 {PHOTO} --wave --pitch 1.6um", "o.png", {"wave": True, "looks": "16"}),
]


def check_default(line, output, values):
    name = f"default{DEFAULTS.index((line, output, values))}{output}"
    files = run(line.split(), name)
    if not files:
        return [f"{line}: refused"]
    said = files[0].options
    remove(name)
    return [f"{line}: {option} is stored as {said.get(option)}, not {value}"
            for option, value in values.items() if said.get(option) != value]


def write_numbers():
    head = b"{'descr': '<f4', 'fortran_order': False, 'shape': (200, 200)}"
    head += b" " * (-(len(head) + 11) % 64) + b"\n"
    with open("real.npy", "wb") as file:
        file.write(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head)
        file.write(struct.pack("<40000f", *(i * i % 63 / 10 for i in range(40000))))


def main():
    write_numbers()
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        complaints = [line for lines in pool.map(Case.make, sum(ALL.values(), [])) for line in lines]
        work = [(try_option, (option, cases)) for command, cases in ALL.items() for option in tried_options(command)]
        work += [(check_default, case) for case in DEFAULTS if case[0].split()[0] in ALL]
        if not complaints:
            complaints = [line for lines in pool.map(lambda task: task[0](*task[1]), work) for line in lines]
            complaints += [line for command, cases in ALL.items() for line in check_idle(command, cases)]
    for command, cases in ALL.items():
        print(f"{sum(len(case.tried) for case in cases)} trials in {len(cases)} cases of {command}")
    print("\n".join(complaints))
    for output in ["real.npy", *(case.base for cases in ALL.values() for case in cases)]:
        remove(output)
    sys.exit(1 if complaints else 0)


THOROUGH = os.environ.get("HOGEL_THOROUGH") == "1"
ALL = {command: [Case(*case) for case in CASES if case[1].split()[0] == command] for command in sys.argv[1:]}
main()
