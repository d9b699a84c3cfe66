#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Summarises the tests that ctest ran.

usage: test_summary.py FILE            names what failed and what was skipped, then counts; status 1 if a test was
                                       skipped and the environment has HOGEL_REQUIRE_TOOLS=1
       test_summary.py --skipped FILE  prints a regular expression of ctest for the tests that were skipped, if any
FILE is what `ctest --output-junit` wrote.
"""
import os
import re
import sys
import xml.etree.ElementTree


def outcome(case):
    if case.get("status") == "run":
        return "passed"
    skipped = case.find("skipped")
    return "skipped" if skipped is not None and skipped.get("message", "").startswith("SKIP_") else "failed"


def main():
    names = {"passed": [], "failed": [], "skipped": []}
    for case in xml.etree.ElementTree.parse(sys.argv[-1]).getroot().iter("testcase"):
        names[outcome(case)].append(case.get("name"))
    if "--skipped" in sys.argv:
        if names["skipped"]:
            print("^(" + "|".join(re.escape(name) for name in names["skipped"]) + ")$")
        return 0
    for kind in ("skipped", "failed"):
        for name in names[kind]:
            print(f"{kind}: {name}")
    required = os.environ.get("HOGEL_REQUIRE_TOOLS") == "1"
    if names["skipped"]:
        print(f"{len(names['skipped'])} skipped" + (", which HOGEL_REQUIRE_TOOLS=1 does not allow" if required else ""))
    print(f"{len(names['passed'])} passed, {len(names['failed'])} failed", flush=True)
    return 1 if required and names["skipped"] else 0


sys.exit(main())
