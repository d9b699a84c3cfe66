#!/usr/bin/env python3
"""Fails when a file of src/hogel includes a header that the module table does not allow.

usage: check_includes.py TABLE SOURCE_DIR      TABLE: a line "module:used,used" each, from hogel_module() in CMakeLists.txt
A module may include itself, what it uses, and what those use. A third-party header may be included by the modules
named in THIRD_PARTY alone, and by no public header.
"""
import pathlib
import re
import sys

THIRD_PARTY = {  # first part of the include path -> the modules whose .cpp files may name it
    "tbb": {"core"}, "fftw3.h": {"math"}, "OpenImageIO": {"image"}, "assimp": {"scene"}, "embree3": {"trace"},
    "hdf5.h": {"io"}, "hwy": {"codec", "core", "direct", "hologram", "math", "optics", "render", "shading"}, "fmt": None,
    "gtest": None,
}
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]')


def closure(table, module):
    seen, todo = set(), [module]
    while todo:
        name = todo.pop()
        if name not in seen:
            seen.add(name)
            todo += table[name]
    return seen


def main():
    table = {}
    for line in pathlib.Path(sys.argv[1]).read_text().splitlines():
        name, uses = line.split(":")
        table[name] = [u for u in uses.split(",") if u]
    root = pathlib.Path(sys.argv[2])
    wrong = []
    for path in sorted(root.rglob("*")):
        if path.suffix not in (".h", ".cpp"):
            continue
        module = path.relative_to(root).parts[0]
        allowed = closure(table, module) if module in table else set()
        is_test = path.name.endswith("_test.cpp")
        for number, line in enumerate(path.read_text().splitlines(), 1):
            match = INCLUDE.match(line)
            if not match:
                continue
            header = match.group(1)
            first = header.split("/")[0]
            if first == "hogel":
                used = header.split("/")[1]
                if used in table and used not in allowed and not is_test:
                    wrong.append(f"{path}:{number}: module '{module}' may not include '{header}'")
            elif first in THIRD_PARTY:
                owners = THIRD_PARTY[first]
                if path.suffix == ".h" and not path.name.endswith("_internal.h"):
                    wrong.append(f"{path}:{number}: a public header may not include '{header}'")
                elif owners is not None and module not in owners and not is_test:
                    wrong.append(f"{path}:{number}: only {', '.join(sorted(owners))} may include '{header}'")
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


sys.exit(main())
