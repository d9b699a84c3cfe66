# SPDX-License-Identifier: Apache-2.0
"""One line a comparison, the exit status of them all, and which cases are compared."""
import os
import subprocess
import sys

# Whether every case is compared, or some by turns.
THOROUGH = os.environ.get("HOGEL_THOROUGH") == "1"


def by_turns(cases, turn):
    """One of the cases, or all."""
    return cases if THOROUGH else cases[turn % len(cases):][:1]


class Checks:
    def __init__(self):
        self.failed = 0

    def at_most(self, what, value, limit):
        """`value` is the size of an error; one that is not a number fails."""
        right = bool(value <= limit)
        self.failed += not right
        print(f"{what}: {value:.2g}, at most {limit:.2g}{'' if right else '   WRONG'}", flush=True)

    def at_least(self, what, value, limit):
        right = bool(value >= limit)
        self.failed += not right
        print(f"{what}: {value:.2g}, at least {limit:.2g}{'' if right else '   WRONG'}", flush=True)

    def equal(self, what, value, expected):
        right = value == expected
        self.failed += not right
        print(f"{what}: {value}{'' if right else f', expected {expected}   WRONG'}", flush=True)

    def finish(self):
        sys.exit(1 if self.failed else 0)


def run(hogel, *arguments):
    """What the program prints; ends with its message if it fails."""
    done = subprocess.run([str(hogel), *map(str, arguments), "-q"], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"hogel {' '.join(map(str, arguments))}: {done.stderr}")
    return done.stdout
