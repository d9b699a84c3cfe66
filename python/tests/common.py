# SPDX-License-Identifier: Apache-2.0
"""Common helpers of the tests. Each test program runs on its own, in an empty folder: python3 test_x.py"""
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import hogel
import numpy as np

SOURCES = Path(os.environ.get("HOGEL_SOURCES", Path(__file__).resolve().parents[2]))


#: Whether the address sanitizer is active, which delays the release of memory and is slow.
SANITIZED = "libasan" in Path("/proc/self/maps").read_text()
unless_sanitized = unittest.skipIf(SANITIZED, "the address sanitizer takes memory and time of its own")


class InFolder(unittest.TestCase):
    """Tests that write files; after each no temporary file may be left."""

    def setUp(self):
        self._folder = tempfile.TemporaryDirectory()
        self._before = os.getcwd()
        os.chdir(self._folder.name)

    def tearDown(self):
        left = [name for name in os.listdir() if name.startswith(".") or name.endswith(".tmp")]
        os.chdir(self._before)
        self._folder.cleanup()
        self.assertEqual(left, [])


def command_line(*words):
    """Runs the command line."""
    done = subprocess.run([sys.executable, "-m", "hogel", *map(str, words)], capture_output=True, text=True)
    if done.returncode != 0:
        raise AssertionError(f"hogel {' '.join(map(str, words))}: {done.stderr}")


def random_array(*shape, seed=1):
    """Radiances from 0 to 1."""
    return np.random.default_rng(seed).random(shape, dtype=np.float32)


def light_field(hogels=(8, 6), directions=(5, 4), channels=3, seed=1):
    """A light field of noise, in memory."""
    values = random_array(channels, hogels[1], hogels[0], directions[1], directions[0], seed=seed)
    return hogel.LightField.from_array(values, size="1mm", fov="16deg"), values


def resident():
    """Bytes of memory of this process."""
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")
