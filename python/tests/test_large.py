# SPDX-License-Identifier: Apache-2.0
"""A light field of 26 GB, in a sparse file, is opened and sliced in little memory."""
import importlib.util
import subprocess
import sys
import unittest
from pathlib import Path

import hogel
from common import InFolder, light_field, unless_sanitized

LOOK = """
import hogel
lf = hogel.LightField.open("large.h5")
assert lf.nbytes > 50e9, lf.nbytes  # of single floats
assert lf[10:20, :, 4, 4].shape == (3, 10, 1024)
assert lf.part(s=512, u=7).shape == (3, 1024, 64)
assert lf[..., 500:502, 500:502, :, :].shape == (3, 2, 2, 64, 64)
print(lf)
print([line.split()[1] for line in open("/proc/self/status") if line.startswith("VmHWM")][0])
"""


@unless_sanitized
@unittest.skipUnless(importlib.util.find_spec("h5py"), "h5py is not installed")
class Large(InFolder):
    def test_memory(self):
        import h5py

        light_field(hogels=(4, 4), directions=(64, 64))[0].save("small.h5")
        with h5py.File("small.h5") as small, h5py.File("large.h5", "w", libver="v108") as large:
            for name, value in small.attrs.items():
                large.attrs.create(name, value, dtype=small.attrs.get_id(name).dtype)
            for name, item in small.items():
                # Storage that is reserved, but to which nothing was written, takes no disk.
                how = h5py.h5p.create(h5py.h5p.DATASET_CREATE)
                how.set_alloc_time(h5py.h5d.ALLOC_TIME_EARLY)
                how.set_fill_time(h5py.h5d.FILL_TIME_NEVER)
                space = h5py.h5s.create_simple((3, 1024, 1024, 64, 64))
                kind = h5py.h5t.py_create(item.dtype)
                made = h5py.Dataset(h5py.h5d.create(large.id, name.encode(), kind, space, dcpl=how))
                for key, value in item.attrs.items():
                    value = 1024 if key in ("hogels_s", "hogels_t") else value
                    made.attrs.create(key, value, dtype=item.attrs.get_id(key).dtype)
        self.assertLess(Path("large.h5").stat().st_blocks * 512, 1e8)
        done = subprocess.run([sys.executable, "-c", LOOK], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        said, kilobytes = done.stdout.splitlines()
        self.assertIn("1024x1024 hogels of 64x64 directions", said)
        self.assertLess(int(kilobytes), 300_000)


if __name__ == "__main__":
    unittest.main()
