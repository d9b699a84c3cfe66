#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Tests examples/cluster/model.py: the fit, laws of its predictions, and that docs/cluster.md shows what it prints.

usage: cluster_model_test.py SOURCE_DIR
"""
import argparse
import importlib.util
import pathlib
import subprocess
import sys
import unittest

SOURCE = pathlib.Path(sys.argv.pop()).resolve()
PROGRAM = SOURCE / "examples/cluster/model.py"
spec = importlib.util.spec_from_file_location("model", PROGRAM)
model = importlib.util.module_from_spec(spec)
spec.loader.exec_module(model)

RATES = {"render": 1e-9, "compress": 5e-9, "hologram": 1.2e-8, "photo": 3e-9, "streamed photo": 9e-9, "propagate": 9e-8}


def runs():
    return [{"stage": stage, "samples": n, "seconds": 0.2 + rate * n} for stage, rate in RATES.items() for n in (1e7, 4e7, 1e8)]


def options(**changes):
    values = {"side": 1, "pitch": 1e-6, "hogel": 0.25e-3, "directions": 256, "colours": 3, "wavelength": 532e-9, "pupil": 6e-3,
              "distance": 0.3, "cores": 64, "disk": 1e10, "network": 3e9, "merge": 1e9, "price": 3, "nodes": [16, 64, 256]}
    return argparse.Namespace(**(values | changes))


class ModelTest(unittest.TestCase):
    def setUp(self):
        self.model = model.Model({"runs": runs()})

    def test_the_fit_recovers_what_runs_were_made_of(self):
        for stage, rate in RATES.items():
            start, slope = self.model.rates[stage]
            self.assertAlmostEqual(start, 0.2, 6)
            self.assertAlmostEqual(slope / rate, 1, 6)

    def test_four_times_the_area_takes_four_times_as_much(self):
        one, two = self.model.stages(options()), self.model.stages(options(side=2))
        for stage in one:
            for a, b in zip(one[stage], two[stage]):
                self.assertGreaterEqual(b, 4 * a * (1 - 1e-3))
                self.assertLessEqual(b, 4 * a * (1.06 if stage == "propagate" else 1 + 1e-3))  # n log n

    def test_more_nodes_help_what_they_divide_and_nothing_else(self):
        for stage in self.model.stages(options()).values():
            few, many = model.seconds(stage, 16, options()), model.seconds(stage, 64, options())
            self.assertAlmostEqual(few["processors"], 4 * many["processors"], 6)
            self.assertEqual(few["disk"], many["disk"])
            self.assertEqual(few["first rank"], many["first rank"])
            self.assertLessEqual(many["network"], few["network"])

    def test_the_page_shows_what_the_program_prints(self):
        printed = subprocess.run([sys.executable, PROGRAM], capture_output=True, text=True, check=True).stdout
        page = (SOURCE / "docs/cluster.md").read_text()
        for line in printed.splitlines():
            self.assertIn(line, page)


if __name__ == "__main__":
    unittest.main()
