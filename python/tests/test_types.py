# SPDX-License-Identifier: Apache-2.0
"""The package is typed: mypy finds nothing, and the stub of the extension module is that of the module."""
import shutil
import subprocess
import sys
import unittest

from common import SOURCES, unless_sanitized

sys.path.insert(0, str(SOURCES / "python"))


class Types(unittest.TestCase):
    @unless_sanitized  # mypy itself would take minutes
    def test_mypy(self):
        options = ["--strict", "--allow-untyped-calls", "--no-warn-return-any", "--no-warn-unused-ignores", "--cache-dir=/dev/null"]
        done = subprocess.run(["mypy", *options, str(SOURCES / "python" / "hogel")], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_the_stub_is_up_to_date(self):
        import make_stub

        written = (SOURCES / "python" / "hogel" / "_core.pyi").read_text()
        self.assertTrue(written == make_stub.stub(), "run python/make_stub.py python/hogel/_core.pyi")


if __name__ == "__main__":
    if shutil.which("mypy") is None or shutil.which("stubgen") is None:
        print("skipped: mypy is not installed")
        sys.exit(77)
    unittest.main()
