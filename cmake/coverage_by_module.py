#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Prints the test coverage of each module in lines.

usage: coverage_by_module.py BUILD     in the project's folder; BUILD: build folder with gcov's counts; coverage.html with the
                                       coverage of each line is written to it
A module is a folder of src/hogel or thesis; the public headers count as one.
"""
import collections
import json
import pathlib
import subprocess
import sys


def module(path):
    parts = pathlib.PurePath(path).parts
    if parts[0] == "thesis":
        return parts[1]
    return parts[2] if parts[:2] == ("src", "hogel") else "public headers"


def files(build):
    subprocess.run(["gcovr", "--root", ".", "--object-directory", build, "--filter", "include/", "--filter", "src/", "--filter", "thesis/",
                    "--exclude", r".*_test\.cpp$", "--json-summary", build / "coverage.json", "--html-details", build / "coverage.html"],
                   check=True)
    return json.loads((build / "coverage.json").read_text())["files"]


def main():
    lines, reached = collections.Counter(), collections.Counter()
    for file in files(pathlib.Path(sys.argv[1])):
        for name in (module(file["filename"]), "all"):
            lines[name] += file["line_total"]
            reached[name] += file["line_covered"]
    print(f"{'module':<16}{'lines':>8}{'reached':>9}")
    for name in sorted(lines, key=lambda name: (name == "all", name)):
        print(f"{name:<16}{lines[name]:>8}{reached[name] / max(1, lines[name]):>9.1%}")
    return 0 if lines["all"] else 1


sys.exit(main())
