#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fails when a program needs a shared library that the packages in the first section of packages.txt do not install.

usage: check_packages.py PROGRAM PACKAGE...
The libraries are those listed by ldd, except those built with the program. The packages are PACKAGE... and their dependencies
without recommended ones, as apt would install them on an empty machine.
"""
import os
import pathlib
import re
import subprocess
import sys


def output(*command):
    done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "LC_ALL": "C"})
    if done.returncode != 0:
        sys.exit(f"check_packages: failed: {' '.join(command)}\n{done.stdout}{done.stderr}")
    return done.stdout


def libraries(program):
    own = program.resolve().parent.parent
    for line in output("ldd", str(program)).splitlines():
        if "not found" in line:
            sys.exit(f"check_packages: {line.strip()}")
        path = re.search(r"(/\S+) \(0x", line)
        if path and own not in pathlib.Path(path.group(1)).resolve().parents:
            yield path.group(1)


def spellings(path):
    """Returns the names that dpkg may use for a file: with or without /usr, and the target of a link."""
    real = os.path.realpath(path)
    return {path, real, f"/usr{path}"} | {name.removeprefix("/usr") for name in (path, real)}


def owners(paths):
    """Returns the packages of each file."""
    names = sorted(set().union(*map(spellings, paths)))
    found = subprocess.run(["dpkg-query", "--search", *names], capture_output=True, text=True)
    packages = {}
    for line in found.stdout.splitlines():
        if not line.startswith("diversion "):
            owner, name = line.rsplit(": ", 1)
            packages.setdefault(name, set()).update(package.split(":")[0] for package in owner.split(", "))
    return {path: set().union(*(packages.get(name, set()) for name in spellings(path))) for path in paths}


def brought(packages):
    simulated = output("apt-get", "-o", "Dir::State::status=/dev/null", "install", "--simulate",
                       "--no-install-recommends", *packages)
    return set(re.findall(r"^Inst ([^ :]+)", simulated, re.MULTILINE))


def main():
    program, packages = pathlib.Path(sys.argv[1]), sys.argv[2:]
    allowed = brought(packages)
    owned = owners(list(libraries(program)))
    wrong = {path: names for path, names in owned.items() if not names & allowed}
    for path, names in wrong.items():
        print(f"{path}: from {', '.join(sorted(names)) or 'no package'}, which the first section of packages.txt does "
              "not bring", file=sys.stderr)
    print(f"{len(owned)} shared libraries, {len(wrong)} of them not from the {len(allowed)} packages of the first section")
    return 1 if wrong or not owned else 0


if __name__ == "__main__":
    sys.exit(main())
