#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks the installed Python module: renders and photographs a small scene with the same bytes as the command line."""
import pathlib
import subprocess
import sys

import hogel
import numpy as np

assert hogel.__file__ == "/usr/lib/python3/dist-packages/hogel/__init__.py", hogel.__file__
for name in "_core.pyi", "py.typed":
    assert pathlib.Path(hogel.__file__).with_name(name).exists(), name
hogel.Scene.load("pumpkin").render(hogels=20, directions=16, size="1mm").save("own.h5")
words = [sys.executable, "-m", "hogel", "render", "pumpkin", "-o", "line.h5", "-q", "--hogels", "20", "--directions", "16", "--size", "1mm"]
subprocess.run(words, check=True)
assert pathlib.Path("own.h5").read_bytes() == pathlib.Path("line.h5").read_bytes()
picture = hogel.LightField.open("own.h5").hologram().photograph(resolution=40)
assert np.asarray(picture).shape == (40, 40, 3) and np.asarray(picture).max() > 0
print(f"python3-hogel: {hogel.__version__}, {picture}")
