# SPDX-License-Identifier: Apache-2.0
"""Every function, type and public member of the public headers exists in Python, or coverage.txt says where, or why not."""
import unittest

import hogel
import numpy
import public_headers
from common import SOURCES
from hogel import _core

WHAT_TO_DO = """
Declared in include/hogel, and not in Python. Either bind it under its own name, in the file of its noun in python/core, and
give it a method or a keyword in python/hogel; or add a line to python/tests/coverage.txt: 'header.h: name = where Python has it', or 'header.h: name: why Python does without it'."""


def declared():
    """Everything public: header.h: name, and whether the module has it under this name."""
    found = {}
    for header in sorted((SOURCES / "include" / "hogel").glob("*.h")):
        text = header.read_text()
        for name in public_headers.functions(text):
            found[f"{header.name}: {name}"] = hasattr(_core, name)
        for name, members in public_headers.types(text):
            kind = getattr(_core, name, None)
            found[f"{header.name}: {name}"] = kind is not None
            for member in members:
                found[f"{header.name}: {name}.{member}"] = hasattr(kind, member)
    return found


def listed():
    """Returns the lines of coverage.txt: name, its place in Python or None, and the reason for its absence or None."""
    lines = {}
    for line in (SOURCES / "python" / "tests" / "coverage.txt").read_text().splitlines():
        if line and not line.startswith("#"):
            header, rest = line.split(": ", 1)
            name, _, where = rest.partition(" = ")
            name, _, reason = (name, "", "") if where else rest.partition(": ")
            lines[f"{header}: {name}"] = where, reason
    return lines


class Coverage(unittest.TestCase):
    def test_everything(self):
        found, lines = declared(), listed()
        self.assertGreater(len(found), 800)
        # A type that is listed stands for its members.
        known = set(lines) | {name for name in found if name.rpartition(".")[0] in lines}
        missing = sorted(name for name, there in found.items() if not there and name not in known)
        self.assertEqual(missing, [], WHAT_TO_DO)
        self.assertEqual(sorted(set(lines) - set(found)), [], "coverage.txt has names that no header has")

    def test_what_is_listed_is_where_it_says(self):
        scope = {"hogel": hogel, "numpy": numpy, "_core": _core}
        for name, (where, reason) in listed().items():
            with self.subTest(name):
                self.assertTrue(where or reason)
                if where:
                    self.assertIsNotNone(eval(where, scope))
        self.assertLess(sum(1 for where, _ in listed().values() if not where), 20, "too much is only in C++")

    def test_headers_are_understood(self):
        text = """
        namespace hogel {
        /// A comment; with { signs }
        struct HOGEL_API Both : Base {
            enum class Kind { one, two = 3 };
            std::size_t a = 0, b{1}, c = f(2, 3);
            std::function<void(int, double)> call = nullptr;
            std::vector<std::pair<int, double>> pairs = {};
            double width() const { return static_cast<double>(a) * b; }
            void run(const std::string& text = "x; {");
            Both();
            friend bool operator==(const Both&, const Both&) = default;
        };
        class HOGEL_API Closed final {
          public:
            explicit Closed(int a);
            virtual int size() const = 0;
          private:
            int hidden_ = 0;
        };
        enum class Face { front, left };
        HOGEL_API void act(int a);
        }
        """
        found = dict(public_headers.types(text))
        self.assertEqual(found["Both"], {"Kind", "a", "b", "c", "call", "pairs", "width", "run"})
        self.assertEqual(found["Closed"], {"size"})
        self.assertEqual(found["Face"], {"front", "left"})


if __name__ == "__main__":
    unittest.main()
