# SPDX-License-Identifier: Apache-2.0
"""Long work stops on Ctrl-C, reports progress, and does not disturb other threads and processes."""
import os
import signal
import subprocess
import sys
import threading
import time
import unittest

import hogel
import numpy as np
from common import InFolder, light_field

# Work of minutes; says when it has begun, and how it ended.
PROGRAM = """
import hogel, sys
lf = hogel.Scene.load("pumpkin").render(hogels=1000, directions=64, size="20mm", algorithm="raytrace")
began = []
def report(fraction):
    if not began:
        began.append(True)
        print("began", flush=True)
try:
    lf.save("a.h5", progress=report)
    print("ended", flush=True)
except KeyboardInterrupt:
    print("stopped", flush=True)
"""

# Work before a fork, whose threads a child does not have, and the same work in two children.
FORKS = """
import hashlib, multiprocessing, sys
import numpy as np
import hogel

field = hogel.Field.from_function(lambda x, y: np.exp(1e8j * (x**2 + y**2)), samples=(500, 400), pitch="2um", wavelength="532nm")
lf = hogel.Scene.load("pumpkin").render(hogels=12, directions=8, size="2mm")

def work(distance):
    spread = np.asarray(field.propagate(distance=distance * 1e-3))
    return hashlib.sha256(spread.tobytes() + np.asarray(lf.load()).tobytes()).hexdigest()

here = [work(i) for i in range(1, 5)]
with multiprocessing.get_context("fork").Pool(2) as pool:
    there = pool.map_async(work, range(1, 5)).get(timeout=60)
print(here == there and len(set(here)) == 4)
"""


class Stopping(InFolder):
    def test_control_c(self):
        program = subprocess.Popen([sys.executable, "-c", PROGRAM], stdout=subprocess.PIPE, text=True)
        self.assertEqual(program.stdout.readline(), "began\n")
        time.sleep(0.5)
        program.send_signal(signal.SIGINT)
        self.assertEqual(program.stdout.readline(), "stopped\n")
        program.communicate(timeout=60)
        self.assertEqual(os.listdir(), [])  # nor the file of work that came to its end

    def test_a_progress_function_stops(self):
        lf = hogel.Scene.load("pumpkin").render(hogels=400, directions=64, size="20mm", algorithm="raytrace")
        with self.assertRaises(hogel.CancelledError) as caught:
            lf.save("a.h5", progress=lambda fraction: False)
        self.assertEqual((caught.exception.name, caught.exception.status), ("cancelled", 6))

        def broken(fraction):
            raise LookupError("mine")

        with self.assertRaisesRegex(LookupError, "mine"):
            lf.save("a.h5", progress=broken)
        self.assertEqual(os.listdir(), [])

    def test_progress_is_told(self):
        lf, _ = light_field()
        told = []
        lf.load(progress=told.append)
        self.assertEqual(told[-1], 1)
        self.assertEqual(told, sorted(told))


class Threads(unittest.TestCase):
    def test_other_threads_run_on(self):
        lf = hogel.Scene.load("pumpkin").render(hogels=64, directions=32, size="3mm", algorithm="raytrace")
        done = threading.Event()
        worker = threading.Thread(target=lambda: (lf.load(), done.set()))
        worker.start()
        turns = 0
        while not done.wait(0.001):
            turns += 1
        worker.join()
        self.assertGreater(turns, 3)  # the lock of the interpreter was free meanwhile

    def test_many_threads_read_one_light_field(self):
        lf, values = light_field(hogels=(32, 32))
        strided = hogel.LightField.from_function(lambda s, t, u, v: s + t + u + v, channels=1, hogels=16, directions=4, size="1mm",
                                                 fov="10deg")
        whole = np.asarray(strided)
        failures = []

        def read():
            for _ in range(20):
                if not np.array_equal(np.asarray(lf.load()), values) or not np.array_equal(strided[:, 3:7], whole[:, 3:7]):
                    failures.append(1)

        threads = [threading.Thread(target=read) for _ in range(4)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(failures, [])

    def test_processes_that_were_forked_work(self):
        done = subprocess.run([sys.executable, "-c", FORKS], capture_output=True, text=True, timeout=120)
        self.assertEqual(done.stdout, "True\n", done.stderr)


if __name__ == "__main__":
    unittest.main()
