#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Fails if a program loads a shared library that is not on the reviewed list of licences, or is only under the GPL.

usage: check_licences.py PROGRAM LIST [--except NAME]
The libraries are those listed by ldd, except the project's own (NAME, without .so). A library is only under the GPL unless
every part of it may be used under another licence: "A AND B" requires both, "A OR B" is a choice.
"""
import os
import pathlib
import re
import subprocess
import sys


def libraries(program):
    """Returns the sonames that a program loads."""
    done = subprocess.run(["ldd", str(program)], capture_output=True, text=True, env={**os.environ, "LC_ALL": "C"})
    if done.returncode != 0:
        sys.exit(f"check_licences: ldd {program}: {done.stdout}{done.stderr}")
    lines = [line.split() for line in done.stdout.splitlines()]
    return [pathlib.Path(words[0]).name for words in lines if words and not words[0].startswith("linux-vdso")]


def read_list(path):
    """Returns a dictionary: soname -> SPDX expression."""
    listed = {}
    for number, line in enumerate(pathlib.Path(path).read_text().splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        parts = [part.strip() for part in line.split("|")]
        if len(parts) != 3 or not all(parts):
            sys.exit(f"{path}:{number}: expected: soname | SPDX expression | where that is said")
        if parts[0] in listed:
            sys.exit(f"{path}:{number}: {parts[0]} occurs twice")
        listed[parts[0]] = parts[1]
    return listed


def gpl_alone(expression):
    """Returns whether an SPDX expression requires the GPL. Operator precedence as in SPDX: WITH, AND, OR."""
    tokens = re.findall(r"[()]|[^\s()]+", expression)

    def take(wanted=None):
        if not tokens or (wanted and tokens[0] != wanted):
            sys.exit(f"check_licences: not an SPDX expression: {expression}")
        return tokens.pop(0)

    def simple():
        if tokens and tokens[0] == "(":
            take("(")
            value = either()
            take(")")
            return value
        name = take()
        if tokens and tokens[0] == "WITH":
            take("WITH")
            # The exception for the compiler's libraries permits linking; other exceptions are unknown here.
            return name.startswith(("GPL-", "AGPL-")) and take() != "GCC-exception-3.1"
        return name.startswith(("GPL-", "AGPL-"))

    def both():
        value = simple()
        while tokens and tokens[0] == "AND":
            take("AND")
            value = simple() or value
        return value

    def either():
        value = both()
        while tokens and tokens[0] == "OR":
            take("OR")
            value = both() and value
        return value

    value = either()
    if tokens:
        sys.exit(f"check_licences: not an SPDX expression: {expression}")
    return value


def main():
    program, list_path = sys.argv[1], sys.argv[2]
    own = sys.argv[4] if sys.argv[3:4] == ["--except"] else None
    listed = read_list(list_path)
    loaded = [name for name in libraries(program) if not (own and name.startswith(own + ".so"))]
    wrong = 0
    for name in loaded:
        if name not in listed:
            print(f"{name}: not in {list_path}; add it with the licence that its copyright file names", file=sys.stderr)
            wrong += 1
        elif gpl_alone(listed[name]):
            print(f"{name}: {listed[name]}, which would put {program} under the GPL as a whole", file=sys.stderr)
            wrong += 1
    print(f"{len(loaded)} shared libraries, {wrong} of them without a licence that hogel may be linked with")
    return 1 if wrong or not loaded else 0


if __name__ == "__main__":
    sys.exit(main())
