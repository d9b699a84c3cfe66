# SPDX-License-Identifier: Apache-2.0
"""pip installs the module, the library and the program into a folder of its own, without a network."""
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from common import SOURCES, hogel, unless_sanitized

LOOK = """
import hogel, sys
assert hogel.__file__.startswith(sys.prefix), hogel.__file__
assert hogel.program().startswith(sys.prefix), hogel.program()
print(hogel.LightField.from_array([[[[0.5]]]], size="1mm", fov="10deg"))
"""


@unless_sanitized
class Install(unittest.TestCase):
    def run_it(self, *words, **options):
        environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
        environment["HOGEL_BUILD"] = str(Path(hogel.__file__).parents[2])
        done = subprocess.run([str(word) for word in words], capture_output=True, text=True, env=environment, **options)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def test_in_a_folder_of_its_own(self):
        with tempfile.TemporaryDirectory() as folder:
            self.run_it(sys.executable, "-m", "venv", "--system-site-packages", folder)
            python = Path(folder, "bin", "python")
            self.run_it(Path(folder, "bin", "pip"), "install", "--no-index", "--no-build-isolation", SOURCES)
            self.assertIn("LightField(1x1 hogels", self.run_it(python, "-c", LOOK, cwd=folder))
            self.assertIn("hogel 0.", self.run_it(python, "-m", "hogel", "--version", cwd=folder))

    def test_another_python_is_told_what_to_do(self):
        word = "import importlib.util; importlib.util.find_spec = lambda name: None; import build_backend"
        done = subprocess.run([sys.executable, "-c", word], capture_output=True, text=True, cwd=SOURCES / "python")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("apt-get install", done.stderr)
        self.assertNotIn("Traceback", done.stderr)


@unless_sanitized
class Start(unittest.TestCase):
    def test_import_is_quick(self):
        words = [sys.executable, "-c", "import time; began = time.process_time(); import hogel; print(time.process_time() - began)"]
        self.assertLess(min(float(subprocess.check_output(words)) for _ in range(3)), 0.3)


if __name__ == "__main__":
    unittest.main()
