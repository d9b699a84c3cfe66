# SPDX-License-Identifier: Apache-2.0
"""What Python adds to work on arrays: no copy of them. bench/python_overhead.py measures the time that it adds, beside the same
requests in C++, of which this says that they are the same."""
import tracemalloc
import unittest

import hogel
import numpy as np
from common import InFolder
from twin_requests import Requests


class Overhead(InFolder):
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

    def test_a_request_copies_no_array(self):
        """NumPy tells tracemalloc of all memory that it takes, and the library of none: nothing large is taken beside what is
        returned, and that is in memory of the library where it is an array of floats."""
        requests = Requests(1024, 32, 24)
        for name, ask in requests.python.items():
            with self.subTest(name):
                ask()  # modules that are imported by the first call
                tracemalloc.start()
                try:
                    made = ask()
                    kept, most = tracemalloc.get_traced_memory()
                finally:
                    tracemalloc.stop()
                self.assertLess(most - kept, requests.bytes / 20)
                if name == "pattern":
                    self.assertLess(kept, np.asarray(made).nbytes + requests.bytes / 20)
                else:
                    self.assertLess(kept, requests.bytes / 20)


if __name__ == "__main__":
    unittest.main()
