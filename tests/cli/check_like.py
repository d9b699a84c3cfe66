# SPDX-License-Identifier: Apache-2.0
"""Checks that a file says all that it takes to make it again: what `--like FILE` makes has the same bytes.

Each case is a command line, which is run as it stands, and then with values that are drawn for its options. What a command
takes is read from its help, so that a new option is tried as soon as there is one.

usage: check_like.py [DRAWS]      in a folder with the files that make_like_inputs.sh makes; hogel in the PATH
"""
import concurrent.futures
import json
import os
import pathlib
import random
import shutil
import struct
import subprocess
import sys

SMALL = "--hogels 6x4 --directions 8x6 --size 1mm"
LIGHT = "--hogels 6x4 --directions 8x6 --size 0.5mm --pitch 1.6um"
PHOTO = "--eye 0,0,40mm --pupil 4mm --resolution 8"
MODULATOR = "--pixels 128x96 --pixel-pitch 6.4um --window 32"
FIELD = "--pitch 1.6um --wavelength 532nm"

# Command lines and their outputs.
CASES = [
    (f"render m.obj {SMALL} --float", "o.h5"),
    (f"render m.obj --as-is {SMALL} --float", "o.h5"),
    (f"render m.obj --rotate 5,6,7deg --light 1,0,1 --light 0,1,1:#ff8000:2 --scale 0.9 {SMALL} --float", "o.h5"),
    (f"render u.obj {SMALL} --float --texture other.exr", "o.h5"),
    (f"render cloud.xyz {SMALL} --point-size 0.7", "o.h5"),
    (f"render sphere {SMALL} --depth", "o.h5"),
    (f"render other.exr --depth-map real.exr --depth-values disparity --near -0.1mm --far 0.2mm {SMALL} --float", "o.h5"),
    (f"render m.obj {SMALL} --float --shading direct --colour #3060c0 --ground #907050", "o.h5"),
    ("render m.obj --hogels 6x4 --directions 8x6 --size 1mm --float --hemicube", "o.h5"),
    ("render m.obj --algorithm raytrace --frequencies 633nm --hogels 6x4 --size 0.2mm", "o.h5"),
    (f"render m.obj --focal-plane -40mm {SMALL} --float", "o.h5"),
    (f"render m.obj --algorithm simplex --interpolate 3 --front -0.2 --shading direct {SMALL}", "o.h5"),
    (f"render m.obj {SMALL}", "o.hgl"),
    (f"hologram x.h5 {FIELD}", "o.h5"),
    ("hologram x.h5", "o.h5"),
    (f"hologram row.h5 {FIELD} --method lines", "o.h5"),
    (f"hologram row.h5 {FIELD} --method basis-lines --line-pitch 10um", "o.h5"),
    (f"hologram x.h5 {FIELD} --method basis --tolerance 0.3", "o.h5"),
    (f"hologram fringes.hgl {FIELD} --method basis", "o.h5"),
    (f"hologram deep.h5 {FIELD} --method phase-added", "o.h5"),
    (f"hologram deep.h5 {FIELD} --method olas --phase fixed", "o.h5"),
    (f"hologram m.obj {LIGHT} --wavelength 532nm --half", "o.h5"),
    ("hologram m.obj --method points --spacing 60um --size 0.2mm --pitch 2um --wavelength 532nm", "o.h5"),
    ("hologram m.obj --method fresnel --size 0.2mm --pitch 2um --wavelength 532nm --front -12 --shading shadowed", "o.h5"),
    ("photo lines.h5 --eye 0,0,40mm --pupil 1mm --resolution 8 --focus 1mm --diffuser vertical", "o.png"),
    (f"photo f.h5 {PHOTO} --focus 1mm", "o.png"),
    ("photo f.h5 --eye 0,0,40mm --pupil 1mm --resolution 8 --camera full", "o.exr"),
    ("photo f.h5 --eye 0,0,40mm --f-number 12 --resolution 8", "o.exr"),
    (f"photo f.h5 {PHOTO} --display log", "o.exr"),
    (f"photo f.h5 {PHOTO} --frames 2 --to-eye 1,0,40mm", "o##.png"),
    (f"photo x.h5 {PHOTO} --focus 1mm", "o.exr"),
    (f"photo x.h5 {PHOTO} --wave --pitch 1.6um --looks 2", "o.exr"),
    ("photo x.h5 --eye 0,0,40mm --pupil 1mm --resolution 8 --wave --pitch 1.6um --looks expected", "o.exr"),
    ("photo x.h5 --eye 0,0,40mm --pupil 1mm --resolution 8 --wave --pitch 1.6um --speckle none", "o.exr"),
    (f"photo m.obj {LIGHT} {PHOTO} --looks 2", "o.exr"),
    (f"photo other.exr --wave --depth-map re.png {LIGHT} {PHOTO} --looks 2", "o.exr"),
    (f"photo f.npy {PHOTO} {FIELD}", "o.exr"),
    (f"photo real.npy {PHOTO} {FIELD} --values phase", "o.png"),
    (f"propagate real.exr --imaginary imaginary.exr --distance 1mm {FIELD}", "o.h5"),
    (f"propagate re.png --imaginary im.png --distance 1mm {FIELD}", "o.h5"),
    (f"propagate re.png --phases im.png --phase-code odak --distance 1mm {FIELD}", "o.h5"),
    ("propagate pattern.png --distance 1mm", "o.h5"),
    ("propagate f.npz --distance 1mm", "o.h5"),
    ("propagate f.h5 --distance 1mm --order +1", "o.h5"),
    ("propagate f.h5 --distance 1mm --reconstruct fourier --focal 40mm", "o.h5"),
    (f"propagate f.npy --distance 1mm {FIELD}", "o.png"),
    ("propagate f.h5 --distance 1mm --display field", "o.exr"),
    (f"slm s.h5 {MODULATOR} --encoding phase", "o.png"),
    (f"slm s.h5 {MODULATOR} --encoding gerchberg-saxton", "o.png"),
    (f"slm s.h5 {MODULATOR} --encoding burckhardt", "o.png"),
    ("slm s.h5 --device leto --encoding phase", "o.png"),
    ("compress deep.h5", "o.hgl"),
    ("compress x.h5 --coder threepass --step 0.01", "o.hgl"),
    ("compress x.h5 --coder threepass --ppb 0.07 --rule histogram", "o.hgl"),
    ("compress x.h5 --coder jpeg4d --sqnr 30", "o.hgl"),
    ("compress five.h5 --tone histogram --tone-decades 0.1", "o.hgl"),
    ("compress x.h5 --lossless", "o.hgl"),
    ("decompress x.hgl", "o.h5"),
    ("decompress exact.hgl", "o.h5"),
    ("import views --views 8x6 --projection cameras", "o.h5"),
    ("import views --views 8x6 --projection cameras --densify 2 --estimate-disparity --depth", "o.h5"),
    ("import ordered --column second", "o.h5"),
    ("bake m.obj --rays 3 --size 1mm", "o.glb"),
    ("print x.h5 --strips", "o"),
    ("export wide.h5 --layout numbered", "o"),
    ("export m.obj --size 1mm --hogels 24x32 --layout quilt", "o_qs3x2a0.75.png"),
    ("make m.obj --hogels 24x24 --directions 12x12 --size 1.2mm --resolution 24 --eye-distance 60mm --pupil 3mm", "o"),
]

# Options that are not drawn: where results go and how the work is done, files, and what takes long.
FIXED = set("output quiet verbose threads json resume part region force store-hologram keep-light-field like method device bounces rays "
            "iterations camera film-distance densify layers size pitch pixels resolution hogels directions frames planes pictures".split())


def hogel(*words):
    return subprocess.run(["hogel", *words], capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=120)


def drawn_value(option, source):
    """Words for an option with a value of its kind, or none where values of its kind cannot be drawn."""
    number = source.uniform(option.get("least", 0.2), option.get("greatest", 3))
    values = {
        "flag": [], "choice": [source.choice(option.get("choices", [""]))], "number": [f"{number:.3g}"],
        "count": [str(source.randint(1, 4))], "whole": [str(source.randint(0, 99))],
        "counts": [f"{source.randint(1, 3)}x{source.randint(1, 3)}"], "length": [f"{source.uniform(-2, 2):.4g}mm"],
        "positive_length": [f"{source.uniform(0.4, 3):.4g}um"], "angle": [f"{source.uniform(-2, 2):.3g}deg"],
        "angles": [f"{source.uniform(1, 9):.3g},{source.uniform(1, 9):.3g}deg"],
        "point": [f"{source.uniform(-1, 1):.3g},{source.uniform(-1, 1):.3g},{source.uniform(30, 50):.3g}mm"],
        "wavelengths": [f"{source.randint(500, 650)}nm"],
    }
    return values.get(option["kind"])


def drawn(line, options, source):
    """The command line with a few more options."""
    words = line.split()
    free = [o for o in options if not o.get("positional") and o["name"] not in FIXED and f"--{o['name']}" not in words]
    for option in source.sample(free, min(len(free), 3)):
        value = drawn_value(option, source)
        if value is not None:
            words += [f"--{option['name']}", *value]
    return words


def files_of(output):
    if os.path.isdir(output):
        return sorted(path for path in pathlib.Path(output).iterdir() if path.name not in ("report.json", "report.html"))
    if "##" in output:
        return sorted(pathlib.Path(".").glob(output.replace("##", "[0-9][0-9]")))
    return [pathlib.Path(output)]


def remove(output):
    if os.path.isdir(output):
        shutil.rmtree(output)
    else:
        for file in files_of(output):
            file.unlink(missing_ok=True)


def try_again(number, words, output):
    """Makes an output, and again by --like. Returns a complaint, or None, and whether the words were accepted."""
    stem, ending = f"t{number}", output[1:]
    first, again = f"{stem}a{ending}", f"{stem}b{ending}"
    line = " ".join(words)
    try:
        made = hogel(*words, "-o", first, "-q", "--threads", "1")
        if made.returncode != 0:
            return (None if made.returncode in (2, 3) else f"{line}: status {made.returncode}: {made.stderr}"), False
        like = first if words[0] == "make" else str(files_of(first)[0])
        repeated = hogel(words[0], "--like", like, "-o", again, "-q", "--threads", "1")
        if repeated.returncode != 0:
            return f"{line}: --like: {repeated.stderr}", True
        one, other = files_of(first), files_of(again)
        same = len(one) == len(other) and all(a.read_bytes() == b.read_bytes() for a, b in zip(one, other))
        return (None if same else f"{line}: --like makes other bytes"), True
    finally:
        remove(first)
        remove(again)


def write_numbers():
    head = b"{'descr': '<f4', 'fortran_order': False, 'shape': (200, 200)}"
    head += b" " * (-(len(head) + 11) % 64) + b"\n"
    with open("real.npy", "wb") as file:
        file.write(b"\x93NUMPY\x01\x00" + struct.pack("<H", len(head)) + head)
        file.write(struct.pack("<40000f", *(i * i % 63 / 10 for i in range(40000))))


def main():
    write_numbers()
    draws = int(sys.argv[1]) if len(sys.argv) > 1 else 1
    source = random.Random(55)
    options = {command: json.loads(hogel("help", command, "--json").stdout)["parameters"]
               for command in sorted({line.split()[0] for line, _ in CASES})}
    trials = [(line.split(), output) for line, output in CASES]
    trials += [(drawn(line, options[line.split()[0]], source), output) for line, output in CASES for _ in range(draws)]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        results = list(pool.map(lambda item: try_again(item[0], *item[1]), enumerate(trials)))
    complaints = [complaint for complaint, _ in results if complaint]
    complaints += [f"{' '.join(words)}: refused" for (words, _), (_, taken) in zip(trials[:len(CASES)], results) if not taken]
    accepted = sum(taken for _, taken in results[len(CASES):])
    if 3 * accepted < draws * len(CASES):
        complaints.append(f"only {accepted} of {draws * len(CASES)} drawn command lines were accepted")
    print("\n".join(complaints) or f"{len(CASES)} command lines, and {accepted} of those that were drawn")


main()
