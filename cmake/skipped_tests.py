#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Lists the tests that ctest skipped because a program is missing.

usage: skipped_tests.py FILE               prints a regular expression of ctest for them; nothing if there are none
       skipped_tests.py FILE --allow-none  names them; status 1 if there are any
FILE is the output of `ctest --output-junit`.
"""
import pathlib
import re
import sys
import xml.etree.ElementTree


def is_skipped(case):
    skipped = case.find("skipped")
    return case.get("status") != "run" and skipped is not None and skipped.get("message", "").startswith("SKIP_")


def main():
    file = pathlib.Path(sys.argv[1])
    cases = xml.etree.ElementTree.parse(file).getroot().iter("testcase") if file.exists() else []
    names = [case.get("name") for case in cases if is_skipped(case)]
    if "--allow-none" in sys.argv:
        for name in names:
            print(f"skipped: {name}")
        return 1 if names else 0
    if names:
        print("^(" + "|".join(re.escape(name) for name in names) + ")$")
    return 0


sys.exit(main())
