#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the curves of hogel-bench thesis with the committed table to 0.1 dB.

usage: thesis_curves.py HOGEL_BENCH            small lumigraphs: thesis_small.table (seconds)
       thesis_curves.py HOGEL_BENCH --full     those of the thesis' size: thesis_full.table (a quarter of an hour)

After a change that is meant to change rates, write the table anew, with the command that its first line gives.
"""
import pathlib
import shlex
import subprocess
import sys

TOLERANCE = 0.1  # dB

table = pathlib.Path(__file__).parent / ("thesis_full.table" if "--full" in sys.argv else "thesis_small.table")


def rows(text):
    cells = [line.split() for line in text.splitlines() if line and not line.startswith("#")]
    return {tuple(row[:3]): row[3:] for row in cells}


text = table.read_text()
command = shlex.split(text.splitlines()[0].removeprefix("# hogel-bench "))
done = subprocess.run([sys.argv[1], *command], capture_output=True, text=True)
if done.returncode != 0:
    sys.exit(f"hogel-bench {' '.join(command)}: status {done.returncode}: {done.stderr}")
expected, measured = rows(text), rows(done.stdout)
complaints = [f"{' '.join(name)}: not in both tables" for name in expected.keys() ^ measured.keys()]
for name in expected.keys() & measured.keys():
    for rate, (before, now) in enumerate(zip(expected[name], measured[name], strict=True)):
        if (before == "nan") != (now == "nan") or abs(float(before) - float(now)) > TOLERANCE:
            complaints.append(f"{' '.join(name)}: {now} dB at {2**rate} pixels per bit, expected {before}")
print("\n".join(sorted(complaints)) if complaints else f"{len(expected)} curves")
sys.exit(1 if complaints else 0)
