#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks that the manual pages, written by cmake/package/manual.py, hold every word of the program's help, in its order.

usage: check_manual.py FOLDER, with hogel in the PATH
"""
import gzip
import pathlib
import re
import subprocess
import sys

MACROS = {".TH", ".SH", ".SS", ".TP", ".PP", ".br", ".nf", ".fi"}


def words(text):
    return re.findall(r"[^\s:]+", text)


def plain(page):
    """The text of a page without its title and the list of other pages."""
    lines = page.split(".SH SEE ALSO")[0].splitlines()
    unknown = [line for line in lines if line.startswith(".") and line.split()[0] not in MACROS]
    if unknown:
        sys.exit(f"not a macro of manual pages: {unknown}")
    text = "\n".join(line for line in lines if not line.startswith((".TH", ".SH")))
    text = re.sub(r"^\.(SS|TP|PP|br|nf|fi)", "", text, flags=re.M)
    return re.sub(r"\\f[BR]|\\&", "", text).replace("\\-", "-").replace("\\e", "\\")


def main():
    pages = sorted(pathlib.Path(sys.argv[1]).glob("*.1.gz"))
    for path in pages:
        command = path.name.removesuffix(".1.gz").partition("-")[2]
        told = subprocess.run(["hogel", *(["help", command, "all"] if command else ["--help"])], check=True, capture_output=True,
                              text=True).stdout
        page = plain(gzip.decompress(path.read_bytes()).decode())
        # The first line is the name and, in small letters, the summary.
        summary, rest = told.split("\n", 1)
        name, _, body = page.strip().partition("\n")
        if name.partition(" - ")[2].lower() != summary.removeprefix("hogel: ").lower():
            sys.exit(f"{path.name} begins with: {name}")
        rest = re.sub(r"^(Usage|Options|Commands|Examples):", "", rest, flags=re.M)
        # What --help prints after its commands stands where it prints it; operands come after the usage in both.
        if words(rest) != words(body):
            at = next(i for i, (a, b) in enumerate(zip(words(rest) + [""], words(body) + [""])) if a != b)
            sys.exit(f"{path.name} differs from help near: {' '.join(words(rest)[max(at - 5, 0):at + 5])}\n"
                     f"in the page: {' '.join(words(body)[max(at - 5, 0):at + 5])}")
    print(f"{len(pages)} pages")


main()
