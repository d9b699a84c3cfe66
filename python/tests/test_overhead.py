# SPDX-License-Identifier: Apache-2.0
"""What Python adds to work on arrays above 10 MB: less than 1 % of the processor time of the same requests in C++
(twin/twin.cpp), which take turns with it, but for what each call costs whatever its arrays.
`PYTHONPATH=… HOGEL_TWIN=… python3 test_overhead.py figures [THREADS]` prints them."""
import ctypes
import os
import statistics
import subprocess
import sys
import time
import unittest

import hogel
import numpy as np
from common import InFolder, random_array, unless_sanitized

PITCH = 1.5625e-6
# Turns of a request: at least as many, and more until the bound is met or they have taken this processor time (seconds).
TURNS, PATIENCE = 5, 15.0
# Where memory lies in a process is worth up to two percent of a copy, in all of its turns: processes of which one must meet
# the bound.
PROCESSES = 3
BOUND = 0.01
# Of a call or two with arrays of any size (seconds): arguments, and another thread that is woken.
CALL = 100e-6


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
        """In C++; the sum of the moduli of what came of it, if it is to be told."""
        path = {"hologram": "holo.h5", "field": "lf.h5", "compress": "lf.hgl"}.get(name.split()[-1], "")
        answer = self.twin.twin_do(name.encode(), path.encode(), int(tell))
        assert not np.isnan(answer), name
        return answer

    def times(self, name, enough):
        """Processor times of the request in Python and in C++, which take turns, until enough(times)."""
        asked = {True: self.python[name], False: lambda: self.cpp(name)}
        times = {True: [], False: []}
        while True:
            for of_python in (True, False) if len(times[True]) % 2 else (False, True):
                at = time.process_time()
                asked[of_python]()
                times[of_python].append(time.process_time() - at)
            if len(times[True]) >= TURNS and (sum(map(sum, times.values())) > PATIENCE or enough(times)):
                return times


def overhead(times):
    """Of Python without CALL, as a part of the time in C++: of the quickest turns, which nothing disturbed, of those in the
    middle, or of the two of a turn, which the same disturbed; whichever is least."""
    shares = [(take(times[True]) - CALL) / take(times[False]) for take in (min, statistics.median)]
    pairs = statistics.median((python - CALL) / cpp for python, cpp in zip(times[True], times[False]))
    return min(*shares, pairs) - 1


# Work, of arrays just above 10 MB; what takes a few milliseconds of those, of larger ones, so that the time of a call hides
# nothing that is done with each element.
QUICK = "load", "read", "save", "hologram", "photograph"


def work():
    requests = Requests(1152, 36, 28)
    return requests, [name for name in requests.python if not name.startswith(QUICK)]


def quick_work():
    requests = Requests(2560, 80, 27)
    return requests, [name for name in requests.python if name.startswith(QUICK)]


def measured(requests, name):
    return overhead(requests.times(name, lambda times: overhead(times) < BOUND))


def measured_in_another_process(of_arrays, name):
    """In this folder, whose files it may read."""
    command = [sys.executable, "-B", __file__, "measure", of_arrays.__name__, name]
    return float(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


@unless_sanitized
class Overhead(InFolder):
    def setUp(self):
        super().setUp()
        self.limit = hogel.ThreadLimit(1)  # no thread waits busily for another

    def tearDown(self):
        self.limit = None
        super().tearDown()

    def assert_small(self, of_arrays):
        requests, names = of_arrays()
        self.assertGreater(requests.bytes, 10e6)
        for name in names:
            with self.subTest(name):
                part = measured(requests, name)
                for _ in range(PROCESSES - 1):
                    if part >= BOUND:
                        part = min(part, measured_in_another_process(of_arrays, name))
                self.assertLess(part, BOUND)

    def test_of_work(self):
        self.assert_small(work)

    def test_of_quick_work(self):
        self.assert_small(quick_work)

    def test_the_requests_are_the_same(self):
        requests = Requests(128, 4, 8)
        for name, ask in requests.python.items():
            made = ask()
            if made is None:  # a file, which is read below
                requests.cpp(name)
                continue
            values = np.asarray(made)
            sum_of_moduli = float(np.abs(values.view(np.float32) if values.dtype == np.complex64 else values).sum(dtype=float))
            self.assertAlmostEqual(requests.cpp(name, tell=True) / sum_of_moduli, 1, 9, name)


def figures(threads):
    import tempfile

    limit = hogel.ThreadLimit(threads)
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        for of_arrays in work, quick_work:
            requests, names = of_arrays()
            for name in names:
                times = requests.times(name, lambda times: sum(times[True]) > 4)
                least, middle = ([take(of) * 1e3 for of in (times[False], times[True])] for take in (min, statistics.median))
                shares = [100 * (python / cpp - 1) for cpp, python in (least, middle)]
                print(f"{name:20} {least[0]:8.2f} ms {least[1]:8.2f} ms, {shares[0]:+5.1f} %; medians {shares[1]:+5.1f} % of "
                      f"{len(times[True])} turns, {requests.bytes / 1e6:.1f} MB", flush=True)
        os.chdir("/")
    del limit


if __name__ == "__main__":
    if sys.argv[1:2] == ["figures"]:
        figures(int((sys.argv[2:] or [1])[0]))
    elif sys.argv[1:2] == ["measure"]:
        limit = hogel.ThreadLimit(1)
        print(measured({"work": work, "quick_work": quick_work}[sys.argv[2]]()[0], sys.argv[3]))
    else:
        unittest.main()
