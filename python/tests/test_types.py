# SPDX-License-Identifier: Apache-2.0
"""The package is typed: mypy finds nothing, and the stub of the extension module has its names."""
import ast
import subprocess
import sys
import unittest
from pathlib import Path

import hogel
from hogel import _core

PACKAGE = Path(hogel.__file__).parent
STUB = PACKAGE / "_core.pyi"


def public(names):
    return {name for name in names if not name.startswith("_")}


def declared(body):
    """The public names that statements of a stub declare."""
    names = {node.name for node in body if isinstance(node, (ast.ClassDef, ast.FunctionDef))}
    return public(names | {node.target.id for node in body if isinstance(node, ast.AnnAssign)})


class Types(unittest.TestCase):
    def test_mypy(self):
        options = ["--strict", "--allow-untyped-calls", "--no-warn-return-any", "--no-warn-unused-ignores", "--cache-dir=/dev/null"]
        done = subprocess.run([sys.executable, "-m", "mypy", *options, str(PACKAGE)], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_the_stub_has_every_name(self):
        stub = ast.parse(STUB.read_text()).body
        self.assertEqual(public(dir(_core)) - declared(stub), set())
        classes = {node.name: declared(node.body) for node in stub if isinstance(node, ast.ClassDef)}
        self.assertGreater(len(classes), 50)
        for name, members in classes.items():
            with self.subTest(name):
                self.assertEqual(public(vars(getattr(_core, name))) - members, set())


if __name__ == "__main__":
    if not STUB.exists():
        print("skipped: the build had no mypy, or has a sanitizer")
        sys.exit(77)
    unittest.main()
