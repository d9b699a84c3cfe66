#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs a command-line script and compares what it prints, and its exit status, with what the script says.

usage: run.py PROGRAM SCRIPT      PROGRAM: the one under test, hogel or hogel-bench; exit status 77 says that the script was skipped

A script is read line by line:
  # words            a comment
  needs command      skips the script unless bash runs this with exit status 0; before the first $
  $ command          is run by bash in an empty folder that the whole script shares; the program is in its PATH, and
                     PYTHON is the Python that runs this
  text               expected on its standard output
  ! text             expected on its standard error
  ? 3                expected exit status, 0 where none is given
In expected lines * stands for any text within the line; a line ... stands for any number of lines; empty lines count
on neither side.
After every command no temporary file may be left in the folder.
"""
import fnmatch
import os
import pathlib
import re
import subprocess
import sys
import tempfile


class Step:
    def __init__(self, line_number, command):
        self.line_number, self.command = line_number, command
        self.out, self.err, self.status = [], [], 0


def read_script(path):
    needs, steps = [], []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if line.startswith("$ "):
            steps.append(Step(number, line[2:]))
        elif line.startswith("#") or not line:
            continue
        elif line.startswith("needs ") and not steps:
            needs.append(line[6:])
        elif not steps:
            sys.exit(f"{path}:{number}: expectation before any command")
        elif line.startswith("! "):
            steps[-1].err.append(line[2:])
        elif line.startswith("? "):
            steps[-1].status = int(line[2:])
        else:
            steps[-1].out.append(line)
    if not steps:
        sys.exit(f"{path}: no command")
    return needs, steps


def matches(expected, text):
    parts = []
    for line in expected:
        if line == "...":
            parts.append(r"(?:.*\n)*?")
        else:
            parts.append("".join(".*" if piece == "*" else re.escape(piece) for piece in re.split(r"(\*)", line)) + "\n")
    return re.fullmatch("".join(parts), re.sub(r"\n\n+", "\n", text)) is not None


def run(command, folder, environment):
    return subprocess.run(["bash", "-c", command], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                          capture_output=True, text=True, timeout=550 if environment["HOGEL_THOROUGH"] != "1" else 3600)


def check(step, folder, environment):
    done = run(step.command, folder, environment)
    complaints = []
    for name, expected, text in (("stdout", step.out, done.stdout), ("stderr", step.err, done.stderr)):
        if not matches(expected, text):
            complaints.append(f"{name} expected:\n" + "".join(f"    {line}\n" for line in expected) +
                              "  was:\n" + "".join(f"    {line}\n" for line in text.splitlines()))
    if done.returncode != step.status:
        complaints.append(f"status expected {step.status}, was {done.returncode}\n")
    left = [str(p.relative_to(folder)) for p in folder.rglob("*") if fnmatch.fnmatch(p.name, "*.tmp")]
    if left:
        complaints.append(f"left behind: {' '.join(left)}\n")
    return complaints


def main():
    program, script = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2])
    failed = False
    with tempfile.TemporaryDirectory(prefix="hogel-cli-") as name:
        folder = pathlib.Path(name) / "work"
        folder.mkdir()
        environment = {"PATH": f"{program.parent}:{os.environ['PATH']}", "HOME": name, "LC_ALL": "C.UTF-8",
                       "TOOLS": str(pathlib.Path(__file__).parent.resolve()), "PYTHON": sys.executable,
                       "HOGEL_THOROUGH": os.environ.get("HOGEL_THOROUGH", "")}
        needs, steps = read_script(script)
        for command in needs:
            if run(command, folder, environment).returncode != 0:
                print(f"{script}: skipped, this machine lacks what it needs: {command}")
                return 77
        for step in steps:
            for complaint in check(step, folder, environment):
                failed = True
                print(f"{script}:{step.line_number}: $ {step.command}\n  {complaint}")
    return 1 if failed else 0


sys.exit(main())
