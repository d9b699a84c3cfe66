#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Puts the shared libraries that an installed hogel needs into its lib folder, with their licences.

usage: carry_libraries.py PREFIX
Copies every library that ldd lists for PREFIX/bin/hogel, except those of the C and C++ runtimes, which every Linux has
(SYSTEM). Sets their RUNPATH to $ORIGIN. Writes a table of the libraries, the copyright file of each Debian package, and the
licences named in these files to share/doc/hogel/licences.
"""
import pathlib
import re
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
from check_licences import gpl_alone, read_list  # noqa: E402
from check_packages import owners, output  # noqa: E402

SYSTEM = re.compile(r"^(ld-linux.*|lib(c|m|dl|rt|pthread|resolv|gcc_s|stdc\+\+))\.so\.\d+$")
README = """The libraries in lib that are not hogel's own are those of Debian packages, unchanged but for the folder in which they look
for each other (RUNPATH). `lib*.so.*` may be replaced by other builds with the same interface.

Of each package: its copyright file is PACKAGE.txt here; the licences that it names by a path in /usr/share/common-licenses are
in common-licenses; its source is https://snapshot.debian.org/package/SOURCE/VERSION/ for the last two columns below,
after the package and its version.

"""


def needed(program):
    """Returns a dictionary of the libraries to copy: soname -> path outside the prefix."""
    found = {}
    for line in output("ldd", str(program)).splitlines():
        if "not found" in line:
            sys.exit(f"carry_libraries: {line.strip()}")
        words = line.split()
        if "=>" in words and not SYSTEM.match(words[0]) and program.parent.parent not in pathlib.Path(words[2]).resolve().parents:
            found[words[0]] = words[2]
    return found


def copy_licences(packages, folder):
    """Returns the copyright files of packages, and the common licences named in them."""
    named = set()
    for package in packages:
        text = pathlib.Path(f"/usr/share/doc/{package}/copyright").read_text(encoding="utf-8", errors="replace")
        (folder / f"{package}.txt").write_text(text, encoding="utf-8")
        named |= {name.rstrip(".-") for name in re.findall(r"/usr/share/common-licenses/([A-Za-z0-9.-]+)", text)}
    common = folder / "common-licenses"
    common.mkdir()
    for name in sorted(named):
        source = pathlib.Path("/usr/share/common-licenses") / name
        if source.exists():
            shutil.copyfile(source, common / name)


def main():
    prefix = pathlib.Path(sys.argv[1]).resolve()
    listed = read_list(pathlib.Path(__file__).resolve().parent.parent / "licences.txt")
    lib, folder = prefix / "lib", prefix / "share/doc/hogel/licences"
    folder.mkdir(parents=True)
    found = needed(prefix / "bin/hogel")
    owner = {path: sorted(names)[0] for path, names in owners(list(found.values())).items() if names}
    rows = []
    for soname, path in sorted(found.items()):
        if path not in owner or soname not in listed or gpl_alone(listed[soname]):
            sys.exit(f"carry_libraries: {path} belongs to no Debian package, or its licence forbids copying it (cmake/licences.txt)")
        shutil.copyfile(path, lib / soname)
        (lib / soname).chmod(0o644)
        subprocess.run(["patchelf", "--set-rpath", "$ORIGIN", str(lib / soname)], check=True)
        described = output("dpkg-query", "-W", "-f", "${Package}\t${Version}\t${source:Package}\t${source:Version}\n", owner[path])
        rows.append((soname, listed[soname], *described.splitlines()[0].split("\t")))
    copy_licences(sorted(set(owner.values())), folder)
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    table = "".join("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() + "\n" for row in rows)
    (folder / "README.txt").write_text(README + table)


main()
