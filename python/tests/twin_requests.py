# SPDX-License-Identifier: Apache-2.0
"""Requests of arrays in Python, and the same in C++ (twin/twin.cpp, which HOGEL_TWIN names): for test_overhead.py and
bench/python_overhead.py."""
import ctypes
import os

import hogel
import numpy as np
from common import random_array

PITCH = 1.5625e-6


class Requests:
    """Requests of a field [side][side] and of a light field [3][hogels][hogels][directions][directions], in Python by name,
    each a function that returns what came of it, and in C++."""

    def __init__(self, side, hogels, directions):
        samples = (random_array(side, side, 2, seed=2) - np.float32(0.5)).view(np.complex64)[..., 0]
        waves = np.sin(np.arange(3 * hogels**2 * directions**2, dtype=np.float32) / directions)
        radiance = 0.5 + 0.4 * waves.reshape(3, hogels, hogels, directions, directions)
        # In memory of the library, whose alignment the twin's arrays have too.
        made_of = dict(size=side * PITCH, fov="10deg")
        self.samples = np.asarray(hogel.Field.from_array(samples, pitch=PITCH, wavelength="532nm").load())
        self.radiance = np.asarray(hogel.LightField.from_array(radiance, **made_of).load())
        self.bytes = min(self.samples.nbytes, self.radiance.nbytes)
        field = hogel.Field.from_array(self.samples, pitch=PITCH, wavelength="532nm")
        holo = hogel.Hologram(field)
        lf = hogel.LightField.from_array(self.radiance, **made_of)
        view = dict(eye="10,0,300mm", pupil="20mm", resolution=300)
        self.python = {
            "load a field": lambda: field.load(),
            "load a light field": lambda: lf.load(),
            "save a hologram": lambda: holo.save("holo.h5"),
            "read a hologram": lambda: hogel.Hologram.open("holo.h5")[0][:],
            "save a light field": lambda: lf.save("lf.h5", float=True),
            "read a light field": lambda: hogel.LightField.open("lf.h5")[:],
            "photograph by rays": lambda: lf.photograph(**view),
            "photograph by waves": lambda: holo.photograph(**view),
            "hologram": lambda: lf.hologram(wavelength="532nm", pitch=PITCH).load()[0],
            "propagate": lambda: field.propagate("2mm"),
            "pattern": lambda: holo.slm(encoding="double-phase", pixels=side, pixel_pitch=PITCH),
            "compress": lambda: lf.compress("lf.hgl", step=0.05)["sqnr"],
        }
        self.twin = ctypes.CDLL(os.environ["HOGEL_TWIN"])
        self.twin.twin_do.restype = ctypes.c_double
        size, pointer = ctypes.c_size_t, ctypes.c_void_p
        self.twin.twin_take.argtypes = [pointer, size, ctypes.c_double, pointer, size, size]
        self.twin.twin_take(self.samples.ctypes.data, side, PITCH, self.radiance.ctypes.data, hogels, directions)

    def cpp(self, name, tell=False):
        """Runs a request in C++. Returns the sum of the moduli of its result, on request."""
        path = {"hologram": "holo.h5", "field": "lf.h5", "compress": "lf.hgl"}.get(name.split()[-1], "")
        answer = self.twin.twin_do(name.encode(), path.encode(), int(tell))
        assert not np.isnan(answer), name
        return answer
