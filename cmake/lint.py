#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs clang-tidy on compiled files, one process per processor.

usage: lint.py BUILD [--minutes N | --all]    BUILD: a build folder with compile_commands.json
Checks files that differ from the first parent of HEAD first, then one file for each changed header, then other files in an
order shuffled per commit, for N minutes (default: 5). Prints the number of files not reached. Status 1 if clang-tidy reports
something in a changed file, with --all in any file.
"""
import concurrent.futures
import json
import os
import pathlib
import random
import subprocess
import sys
import time


def git(*words):
    done = subprocess.run(["git", *words], capture_output=True, text=True)
    return done.stdout.splitlines() if done.returncode == 0 else []


def compiled_files(build):
    """Returns the project's files in the compile commands, as relative paths."""
    here = pathlib.Path.cwd()
    paths = {pathlib.Path(entry["file"]) for entry in json.loads((build / "compile_commands.json").read_text())}
    return sorted(str(path.relative_to(here)) for path in paths if path.is_relative_to(here) and not path.is_relative_to(build.resolve()))


def changed_files():
    """Returns the files that differ from the first parent of HEAD (from HEAD without a parent), including new files."""
    base = (git("rev-parse", "--verify", "--quiet", "HEAD^1") or ["HEAD"])[0]
    return set(git("diff", "--name-only", "--diff-filter=d", base) + git("ls-files", "--others", "--exclude-standard"))


def includer(header, files):
    """Returns the first file that includes a header, or None."""
    name = header.removeprefix("include/").removeprefix("src/").removeprefix("apps/")
    return next((file for file in files if f'"{name}"' in pathlib.Path(file).read_text()), None)


def ordered(files):
    """Returns all files in the order of checking, and the number of changed ones among them."""
    changed = changed_files()
    first = sorted((file for file in files if file in changed), key=lambda file: (file.endswith("_test.cpp"), file))
    for header in sorted(file for file in changed if file.endswith(".h")):
        file = includer(header, files)
        if file and file not in first:
            first.append(file)
    others = [file for file in files if file not in first]
    random.Random("".join(git("rev-parse", "HEAD"))).shuffle(others)
    return first + others, len(first)


def lint(build, file, deadline):
    """Returns the output of clang-tidy for a file and whether it is clean; None if time is up."""
    if time.monotonic() > deadline:
        return None
    done = subprocess.run(["clang-tidy-16", "--quiet", "-p", build, file], capture_output=True, text=True)
    return done.stdout + (done.stderr if done.returncode != 0 else ""), done.returncode == 0


def main():
    build = pathlib.Path(sys.argv[1])
    minutes = float("inf") if "--all" in sys.argv else float(sys.argv[sys.argv.index("--minutes") + 1]) if "--minutes" in sys.argv else 5
    files, changed = ordered(compiled_files(build))
    deadline = time.monotonic() + 60 * minutes
    linted = failed = elsewhere = 0
    with concurrent.futures.ThreadPoolExecutor(len(os.sched_getaffinity(0))) as pool:
        for i, result in enumerate(pool.map(lambda file: lint(build, file, deadline), files)):
            if result:
                text, clean = result
                linted += 1
                failed += not clean and (i < changed or "--all" in sys.argv)
                elsewhere += not clean and i >= changed
                print(text, end="", flush=True)
    print(f"lint: {linted} of {len(files)} files, {min(linted, changed)} of {changed} that the last commit changed; "
          f"findings in {failed} that count, in {elsewhere} that did not change")
    return 1 if failed else 0


sys.exit(main())
