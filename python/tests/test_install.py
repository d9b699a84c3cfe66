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
import hogel, pathlib, sys
assert hogel.__file__.startswith(sys.prefix), hogel.__file__
assert hogel.program().startswith(sys.prefix), hogel.program()
package = pathlib.Path(hogel.__file__).parent
assert "class LightFieldGrid" in (package / "_core.pyi").read_text() and (package / "py.typed").exists(), package
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


# What is imported beside NumPy, the packages of it that are not Python's own first.
COUNT = """
import sys
import numpy
before = set(sys.modules)
import hogel
new = [name for name in sys.modules if name not in before]
print(*{name.partition(".")[0] for name in new} - sys.stdlib_module_names)
print(len([name for name in new if not name.startswith("hogel")]))
"""


class Start(unittest.TestCase):
    def test_import_brings_little_beside_numpy(self):
        """Plotting and bars of progress bring their packages when they are used. bench/python_overhead.py measures the time."""
        packages, modules = subprocess.check_output([sys.executable, "-c", COUNT], text=True).splitlines()
        self.assertEqual(packages, "hogel")
        self.assertLess(int(modules), 40)


if __name__ == "__main__":
    unittest.main()
