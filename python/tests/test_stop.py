# SPDX-License-Identifier: Apache-2.0
"""Long work stops on Ctrl-C, tells how far it is, and leaves other threads alone."""
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
except KeyboardInterrupt:
    print("stopped", flush=True)
"""


class Stopping(InFolder):
    def test_control_c(self):
        program = subprocess.Popen([sys.executable, "-c", PROGRAM], stdout=subprocess.PIPE, text=True)
        self.assertEqual(program.stdout.readline(), "began\n")
        time.sleep(0.5)
        program.send_signal(signal.SIGINT)
        asked = time.monotonic()
        self.assertEqual(program.stdout.readline(), "stopped\n")
        took = time.monotonic() - asked
        program.communicate(timeout=60)
        self.assertLess(took, 1)
        self.assertEqual(os.listdir(), [])

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


if __name__ == "__main__":
    unittest.main()
