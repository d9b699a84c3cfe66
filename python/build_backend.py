# SPDX-License-Identifier: Apache-2.0
"""setuptools, once this Python is one that can build hogel; otherwise a word about what to do."""
import importlib.util
import sys
import sysconfig
from pathlib import Path

missing = [name for name in ("setuptools", "pybind11", "numpy", "mypy") if importlib.util.find_spec(name) is None]
if not Path(sysconfig.get_path("include"), "Python.h").exists():
    missing.append("Python.h")
if missing:
    whose = "Debian's Python" if sys.base_prefix == "/usr" else "another Python than Debian's"
    raise SystemExit(
        f"hogel: {sys.executable} is {whose} and has no {', no '.join(missing)}. On Debian 12:\n"
        "  apt-get install python3-venv python3-dev python3-setuptools python3-wheel python3-pybind11 pybind11-dev python3-numpy mypy\n"
        "  /usr/bin/python3 -m venv --system-site-packages v && v/bin/pip install --no-build-isolation .")

from setuptools.build_meta import *  # noqa: E402,F401,F403
