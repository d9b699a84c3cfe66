#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks what every command writes with --json: one object, nothing else on the standard output, exactly the keys and
types of the table, and of a light field or a hologram what `hogel info` says of the file.

usage: check_json.py     in an empty folder; hogel in the PATH
"""
import json
import pathlib
import subprocess

COUNT, REAL, TRUTH, WORD = "int", "float", "bool", "str"
NUMBER = "int float"  # whole where it happens to be
DECIBELS = "float NoneType"  # null where nothing differs

GRID = {"hogels_s": COUNT, "hogels_t": COUNT, "hogel_pitch_m": NUMBER, "width_m": NUMBER, "height_m": NUMBER,
        "directions_u": COUNT, "directions_v": COUNT, "tan_half_u": NUMBER, "tan_half_v": NUMBER, "center_u": NUMBER,
        "center_v": NUMBER, "field_of_view_u_deg": NUMBER, "field_of_view_v_deg": NUMBER, "channels": COUNT}
CAMERAS = {name: kind for name, kind in GRID.items() if not name.startswith("tan_")} | {
    "focal_half_u": NUMBER, "focal_half_v": NUMBER, "focal_plane_m": NUMBER}
FILE = {"file": WORD, "bytes": COUNT, "seconds": REAL}
SAMPLES = FILE | {"format": WORD, "format_version": COUNT}
LIGHT_FIELD = SAMPLES | GRID | {"faces": WORD, "samples": WORD, "depth": TRUTH}
STREAM = SAMPLES | GRID | {"coder": WORD, "layers": WORD, "layers_end_at": WORD, "depth": TRUTH, "tile_s": COUNT,
                           "tile_t": COUNT, "pixels_per_bit": REAL, "sqnr": DECIBELS, "step": REAL, "passes": COUNT}
DEPTH = {"depth_bytes": COUNT, "depth_error_m": REAL}
FIELD = {"wavelength_m": REAL, "samples_x": COUNT, "samples_y": COUNT, "pitch_x_m": REAL, "pitch_y_m": REAL,
         "width_m": NUMBER, "height_m": NUMBER, "center_x_m": NUMBER, "center_y_m": NUMBER}


def hologram(fields):
    keys = SAMPLES | {"samples": WORD, "fields": COUNT, "wavelengths_m": [REAL]}
    return keys | {f"field{i}_{name}": kind for i in range(fields) for name, kind in FIELD.items()}


VIEWS = {"layout": WORD, "views_across": COUNT, "views_down": COUNT, "bits": COUNT, "transfer": WORD,
         "camera_spacing_m": NUMBER, "camera_distance_m": NUMBER, "scale": NUMBER, "parallax": NUMBER, "disparity_estimated": TRUTH}
PHOTO = FILE | {"pictures": COUNT, "width": COUNT, "height": COUNT, "channels": COUNT, "exposure": NUMBER, "geometric": TRUTH}
PROPAGATED = {"wavelengths_m": [REAL], "distance_m": REAL,
              "propagations": [{"wavelength_m": REAL, "method": WORD, "fresnel_number": NUMBER, "predicted_error": REAL,
                                "frequencies_x": COUNT, "frequencies_y": COUNT, "tiles": COUNT, "light_share": REAL}]}
PLANE = FILE | PROPAGATED | {"pitch_x_m": REAL, "pitch_y_m": REAL}
SLM = FILE | {"width": COUNT, "height": COUNT, "pixel_pitch_m": REAL, "levels": COUNT, "encoding": WORD}
PATTERN = {"wavelength_m": REAL, "efficiency": REAL, "power": REAL, "aperture_cycles": REAL, "aperture_x_cycles": REAL,
           "aperture_y_cycles": REAL, "aperture_per_focal_length": REAL}
MADE = {"folder": WORD, "report": WORD, "triangles": COUNT, "wavelengths_m": [REAL], "looks": COUNT, "width": COUNT,
        "height": COUNT, "exposure": REAL, "seconds": REAL,
        "photographs": [{"file": WORD, "expected_file": WORD, "geometric_file": WORD, "psnr": DECIBELS, "ssim": REAL}]}
SMALL = "--hogels 6x4 --directions 8x6 --size 1mm"
EYE = "--eye 0,0,40mm --pupil 4mm --resolution 8"

TABLE = [
    (f"render sphere -o x.h5 {SMALL} --depth", LIGHT_FIELD),
    (f"render sphere -o x.hgl {SMALL}", STREAM),
    (f"render sphere -o y.h5 {SMALL} --depth --part 1/1", FILE | {"part": COUNT, "parts": COUNT}),
    ("join y.part-1-of-1 -o y.h5", LIGHT_FIELD),
    ("compress x.h5 -o deep.hgl --sqnr 30", STREAM | DEPTH),
    ("decompress deep.hgl -o back.h5", LIGHT_FIELD),
    ("compare x.h5 back.h5", {"sqnr": DECIBELS, "psnr": DECIBELS, "max_error": REAL}),
    ("hologram x.h5 -o f.h5 --pitch 1.3um", hologram(3)),
    ("hologram sphere -o points.h5 --method points --size 0.1mm --hogels 4 --spacing 50um --wavelength 633nm", hologram(1)),
    (f"photo f.h5 -o wave.png {EYE}", PHOTO),
    (f"photo x.h5 -o ray##.png --frames 2 {EYE}", PHOTO),
    ("compare wave.png ray00.png", {"psnr": DECIBELS, "ssim": REAL, "max_error": REAL, "exposure": REAL}),
    ("propagate f.h5 -o there.h5 --distance 1.5mm", hologram(3) | PROPAGATED),
    ("propagate f.h5 -o there.png --distance 1.5mm", PLANE | {"width": COUNT, "height": COUNT, "exposure": REAL}),
    ("propagate points.h5 -o there.npy --distance 1.5mm", PLANE | {"samples_x": COUNT, "samples_y": COUNT}),
    ("hologram sphere -o s.h5 --hogels 4x3 --directions 12 --size 1.6384mm --pitch 6.4um --fov 0.4deg --wavelength 633nm",
     hologram(1)),
    ("focus points.h5 --from -1mm --to 1mm --planes 33",
     {"wavelengths_m": [REAL], "depth_of_focus_m": REAL, "light_depth_of_focus_m": REAL, "seconds": REAL, "depths_m": [REAL], "contrasts": [[REAL]],
      "planes": [{"depth_m": REAL, "prominence": REAL, "contrast": WORD, "cell": COUNT}]}),
    ("slm s.h5 -o slm.png --pixels 64x48 --pixel-pitch 6.4um",
     SLM | {"patterns": [PATTERN | {"light_field_efficiency": REAL, "correlation": REAL, "iterations": COUNT}]}),
    ("slm s.h5 -o slm.bmp --pixels 64x48 --pixel-pitch 6.4um --encoding binary",
     SLM | {"patterns": [PATTERN | {"reference_angle_deg": REAL}]}),
    ("print x.h5 -o hogels", {"folder": WORD, "bytes": COUNT, "pictures": COUNT, "first": WORD, "last": WORD,
                              "exposure": REAL, "samples": COUNT, "clipped": COUNT, "seconds": REAL}),
    ("export x.h5 -o views --layout numbered", {"folder": WORD, "bytes": COUNT, "layout": WORD, "views_across": COUNT,
                                                "views_down": COUNT, "files": COUNT, "exposure": NUMBER, "seconds": REAL}),
    ("export x.h5 -o views.npy --layout npy", FILE | {"layout": WORD, "views_across": COUNT, "views_down": COUNT, "files": COUNT,
                                                     "exposure": NUMBER}),
    ("cameras -o cameras.json", FILE | {"views_across": COUNT, "views_down": COUNT, "camera_spacing_m": REAL,
                                        "camera_distance_m": REAL}),
    ("import views -o imported.h5 --views 8x6 --projection cameras", SAMPLES | CAMERAS | {"faces": WORD, "samples": WORD,
                                                                                         "depth": TRUTH} | VIEWS),
    ("bake sphere -o baked.glb --rays 1", FILE | {"triangles": COUNT}),
    ("make sphere -o made --hogels 8 --directions 12 --size 1mm --eye-distance 40mm --pupil 1mm --resolution 16 --looks 1",
     MADE),
    ("info wave.png", None),
    ("scenes", {"scenes": [{"name": WORD, "text": WORD}]}),
    ("completion bash", {"shell": WORD, "script": WORD}),
]


def wrong(value, kind, name):
    """What is wrong with a value, or nothing."""
    if isinstance(kind, dict):
        if set(value) != set(kind):
            return f"{name}: missing {sorted(set(kind) - set(value))}, unexpected {sorted(set(value) - set(kind))}"
        return "; ".join(filter(None, (wrong(value[key], kind[key], key) for key in kind)))
    if isinstance(kind, list):
        return "; ".join(filter(None, (wrong(each, kind[0], name) for each in value))) if value else f"{name}: is empty"
    return "" if type(value).__name__ in kind.split() else f"{name}: {value!r} is no {kind}"


def run(line):
    done = subprocess.run(["hogel", *line.split(), "--json"], capture_output=True, text=True, timeout=120)
    if done.returncode != 0:
        raise SystemExit(f"hogel {line}\n  status {done.returncode}: {done.stderr}")
    return json.loads(done.stdout)  # refuses anything before and behind the object


for line, keys in TABLE:
    result = run(line)
    complaint = wrong(result, keys, "result") if keys else ""
    if keys and "format" in keys:
        told = run(f"info {result['file']}")
        for key in set(result) - {"file", "seconds", "sqnr", "step", "passes", "wavelengths_m", "distance_m", "propagations"} - set(VIEWS):
            if result[key] != told.get(key):
                complaint += f"; {key} is {result[key]}, but info says {told.get(key)}"
    elif "file" in result and "#" not in result["file"]:
        if result["bytes"] != pathlib.Path(result["file"]).stat().st_size:
            complaint += "; bytes are not those of the file"
    if complaint:
        print(f"hogel {line}\n  {complaint}")

commands = subprocess.run(["hogel", "--help"], capture_output=True, text=True).stdout.split("\nCommands:\n")[1].split("\n\n")[0]
names = {line.split()[0] for line in commands.splitlines()}
print(len(names), "commands; not in the table:", names - {line.split()[0] for line, _ in TABLE} or "none")
