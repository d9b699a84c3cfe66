#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fails when a file includes a header that the module table does not allow.

usage: check_includes.py TABLE PROJECT_DIR
    TABLE: a line "module:folder:used,used:public,public" each, from hogel_module() in CMakeLists.txt

A module may include its own headers and those of modules that it uses, directly or indirectly. Its table row lists further
allowed modules. The rule holds for private headers (src/hogel/MODULE/...) and public ones (include/hogel/HEADER.h).
FORBIDDEN_IN excludes folders for some folders. Public headers and front ends (apps) include only public headers. A third-party
header may be included only by the modules or folders in THIRD_PARTY, and by no public header.
"""
import pathlib
import re
import sys

THIRD_PARTY = {  # first part of the include path -> the modules or folders that may name it; None: any
    "tbb": {"core", "work"}, "fftw3.h": {"math"}, "OpenEXR": {"image/formats"}, "Imath": {"image/formats"}, "png.h": {"image/formats"},
    "jpeglib.h": {"image/formats"}, "stb": {"image/formats"}, "tiffio.h": {"image/formats"}, "webp": {"image/formats"}, "assimp": {"scene"}, "draco": {"scene"}, "meshoptimizer.h": {"scene"}, "embree3": {"trace"},
    "hdf5.h": {"io/hdf5"}, "hwy": {"camera", "codec", "core", "direct", "fringes", "lightfield", "math", "optics",
            "render", "shading", "simplex", "stereogram"}, "fmt": None,
    "nlohmann": {"core", "scene", "exchange", "patterns"}, "gtest": None, "boost": set(),
}
FORBIDDEN_IN = {  # folder -> folders that it may not include
    "codec/format": ("codec/encode", "codec/decode"),
    "codec/decode": ("codec/encode",),
    "thesis/zerotrees": ("codec/encode", "codec/decode"),
    "render/epi": ("render/baselines",),
    "render/baselines": ("render/epi",),
    "thesis/simplex": ("render/epi", "render/baselines"),
    "optics/focus": ("optics/distributed",),
    **{folder: ("optics/distributed",) for folder in ("camera", "camera/film", "camera/hogel_spectra", "camera/narrow_band",
                                                      "camera/rays", "camera/speckle_free")},
    "io/hdf5": ("io/arrays",), "io/arrays": ("io/hdf5",),
}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]')


class Table:
    def __init__(self, path):
        self.folder, self.uses, self.owner = {}, {}, {}
        for line in path.read_text().splitlines():
            name, folder, uses, public = line.split(":")
            self.folder[name] = folder
            self.uses[name] = [used for used in uses.split(",") if used]
            for header in public.split(","):
                if header:
                    self.owner[f"hogel/{header}.h"] = name

    def closure(self, module):
        seen, todo = set(), [module]
        while todo:
            name = todo.pop()
            if name not in seen:
                seen.add(name)
                todo += self.uses[name]
        return seen

    def module_of(self, header):
        """Returns the module of a header of the project."""
        if header in self.owner:
            return self.owner[header]
        for name, folder in self.folder.items():
            if header.startswith(folder.removeprefix("src/") + "/"):
                return name
        return None


def includes(path):
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1)


def sources(folder):
    return (path for path in sorted(folder.rglob("*")) if path.suffix in (".h", ".cpp"))


def check_module(table, module, root, wrong):
    allowed = table.closure(module)
    for path in sources(root / table.folder[module]):
        if path.name.endswith("_test.cpp"):
            continue
        inside = str(path.parent.relative_to(root)).removeprefix("src/hogel/")
        for number, header in includes(path):
            owner = table.module_of(header)
            if owner is not None and owner not in allowed:
                wrong.append(f"{path}:{number}: module '{module}' may not include '{header}' of '{owner}'")
            for folder in FORBIDDEN_IN.get(inside, ()):
                if header.startswith(f"hogel/{folder}/"):
                    wrong.append(f"{path}:{number}: {inside} may not include '{header}'")
            owners = THIRD_PARTY.get(header.split("/")[0])
            if owners is not None and not owners & {module, inside}:
                wrong.append(f"{path}:{number}: only {', '.join(sorted(owners))} may include '{header}'")


def check_face(table, root, wrong):
    """Checks that public headers and front ends include only public headers."""
    public = root / "include"
    own = {str(path.relative_to(public)) for path in public.rglob("*.h")} | {"hogel/version.h"}
    for header in sorted(own - set(table.owner) - {"hogel/hogel.h", "hogel/version.h", "hogel/export.h"}):
        wrong.append(f"include/{header}: is in no module's row of the module table")
    all_of_them = {header for _, header in includes(public / "hogel/hogel.h")}
    for header in sorted(own - all_of_them - {"hogel/hogel.h", "hogel/export.h"}):
        wrong.append(f"include/hogel/hogel.h: leaves out {header}")
    for path in sources(public):
        for number, header in includes(path):
            if header.split("/")[0] in THIRD_PARTY or (header.startswith("hogel/") and header not in own):
                wrong.append(f"{path}:{number}: a public header may not include '{header}'")
    for path in sources(root / "apps"):
        for number, header in includes(path):
            if header.startswith(("hogel/", "showpieces/", "thesis/")) and header not in own:
                wrong.append(f"{path}:{number}: a front end may not include '{header}', which is private")


def main():
    table, root = Table(pathlib.Path(sys.argv[1])), pathlib.Path(sys.argv[2])
    wrong = []
    for module in table.folder:
        check_module(table, module, root, wrong)
    check_face(table, root, wrong)
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


sys.exit(main())
