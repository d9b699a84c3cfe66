# SPDX-License-Identifier: Apache-2.0
"""Runs commands whose standard output nobody reads, and prints their exit status and what they say.

usage: closed_pipe.py COMMAND...
"""
import os
import subprocess
import sys

for command in sys.argv[1:]:
    reads, writes = os.pipe()
    os.close(reads)
    done = subprocess.run(command.split(), stdout=writes, stderr=subprocess.PIPE, text=True)
    os.close(writes)
    print(f"{command}: {done.returncode}, {done.stderr.strip() or 'no word'}")
