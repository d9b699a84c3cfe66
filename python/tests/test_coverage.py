# SPDX-License-Identifier: Apache-2.0
"""Python has every function of the public headers, or coverage.txt says why not."""
import re
import unittest

from common import SOURCES
from hogel import _core

NAMESPACE = re.compile(r"^HOGEL_API\s+(?:\[\[\w+\]\]\s*)?[^;{()=]*?\b(\w+)\(", re.MULTILINE)
NORETURN = re.compile(r"^\[\[noreturn\]\] HOGEL_API void (\w+)\(", re.MULTILINE)
INLINE = re.compile(r"^(?:inline|constexpr) [^;{()=]*?\b(\w+)\(", re.MULTILINE)


def functions():
    """The functions in namespace hogel, as header.h: name."""
    found = set()
    for header in sorted((SOURCES / "include" / "hogel").glob("*.h")):
        text = re.sub(r"//.*", "", header.read_text())
        for pattern in NAMESPACE, NORETURN, INLINE:
            found.update(f"{header.name}: {name}" for name in pattern.findall(text) if name != "operator")
    return found


def excluded():
    """The list of what Python does without: lines 'header.h: name  reason'."""
    reasons = {}
    for line in (SOURCES / "python" / "tests" / "coverage.txt").read_text().splitlines():
        if line and not line.startswith("#"):
            name, _, reason = line.partition("  ")
            reasons[name] = reason.strip()
    return reasons


class Coverage(unittest.TestCase):
    def test_every_function(self):
        found, reasons = functions(), excluded()
        self.assertGreater(len(found), 150)
        covered = {entry for entry in found if hasattr(_core, entry.split(": ")[1])}
        missing = sorted(found - covered - set(reasons))
        self.assertEqual(missing, [], "neither in hogel._core nor in coverage.txt")
        self.assertEqual(sorted(set(reasons) - found), [], "coverage.txt has names that no header has")
        self.assertEqual(sorted(set(reasons) & covered), [], "coverage.txt has names that hogel._core has")
        self.assertEqual([name for name, reason in reasons.items() if not reason], [], "coverage.txt has names without a reason")


if __name__ == "__main__":
    unittest.main()
