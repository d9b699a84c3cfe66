#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures the overhead of Python for work on arrays above 10 MB, in processor time, against the same requests in C++
(python/tests/twin/twin.cpp). Both run alternately. The constant cost of a call is subtracted.

usage: python_overhead.py                      overhead of each request, with one thread; time of `import hogel`
       python_overhead.py figures [THREADS]    the times themselves

PYTHONPATH names the folder of the module, BUILD/python, and HOGEL_TWIN the library BUILD/lib/libpython_twin.so, both built
for release (the target python_tests). Goal: less than 1 % of each request.
"""
import os
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "python" / "tests"))

import hogel
from twin_requests import Requests

# Minimum number of turns of a request, and limit of processor seconds for further turns until the goal is met.
TURNS, PATIENCE = 5, 15.0
# Number of processes per request; the best counts. The memory layout of a process changes the time of a copy by up to two
# percent, in all of its turns.
PROCESSES = 3
GOAL = 0.01
# Constant cost of one or two calls in seconds: arguments, and waking another thread.
CALL = 100e-6


def times_of(requests, name, enough):
    """Processor times of the request in Python and in C++, which take turns, until enough(times)."""
    asked = {True: requests.python[name], False: lambda: requests.cpp(name)}
    times = {True: [], False: []}
    while True:
        for of_python in (True, False) if len(times[True]) % 2 else (False, True):
            at = time.process_time()
            asked[of_python]()
            times[of_python].append(time.process_time() - at)
        if len(times[True]) >= TURNS and (sum(map(sum, times.values())) > PATIENCE or enough(times)):
            return times


def overhead(times):
    """Overhead of Python without CALL, as a fraction of the time in C++: the smallest of three estimates, from the fastest
    turns, from the medians, and from the median ratio of the two runs of a turn, which share disturbances."""
    shares = [(take(times[True]) - CALL) / take(times[False]) for take in (min, statistics.median)]
    pairs = statistics.median((python - CALL) / cpp for python, cpp in zip(times[True], times[False]))
    return min(*shares, pairs) - 1


# Requests on arrays just above 10 MB. Requests that take a few milliseconds use larger arrays, so that the constant cost of
# a call does not hide work per element.
QUICK = "load", "read", "save", "hologram", "photograph"


def work():
    requests = Requests(1152, 36, 28)
    return requests, [name for name in requests.python if not name.startswith(QUICK)]


def quick_work():
    requests = Requests(2560, 80, 27)
    return requests, [name for name in requests.python if name.startswith(QUICK)]


def measured(requests, name):
    return overhead(times_of(requests, name, lambda times: overhead(times) < GOAL))


def measured_in_another_process(of_arrays, name):
    """Measures in a new process with this working folder, so that it can read the files."""
    command = [sys.executable, "-B", os.path.abspath(__file__), "measure", of_arrays.__name__, name]
    return float(subprocess.run(command, check=True, capture_output=True, text=True).stdout)


def overheads():
    limit = hogel.ThreadLimit(1)  # no busy waiting for other threads
    for of_arrays in work, quick_work:
        requests, names = of_arrays()
        for name in names:
            part = measured(requests, name)
            for _ in range(PROCESSES - 1):
                if part >= GOAL:
                    part = min(part, measured_in_another_process(of_arrays, name))
            print(f"{name:20} {100 * part:+5.1f} %{'' if part < GOAL else ', above the goal'}", flush=True)
    del limit


def time_to_import():
    words = [sys.executable, "-c", "import time; began = time.process_time(); import hogel; print(time.process_time() - began)"]
    print(f"import hogel         {min(float(subprocess.check_output(words)) for _ in range(3)):5.2f} s")


def figures(threads):
    limit = hogel.ThreadLimit(threads)
    for of_arrays in work, quick_work:
        requests, names = of_arrays()
        for name in names:
            times = times_of(requests, name, lambda times: sum(times[True]) > 4)
            least, middle = ([take(of) * 1e3 for of in (times[False], times[True])] for take in (min, statistics.median))
            shares = [100 * (python / cpp - 1) for cpp, python in (least, middle)]
            print(f"{name:20} {least[0]:8.2f} ms {least[1]:8.2f} ms, {shares[0]:+5.1f} %; medians {shares[1]:+5.1f} % of "
                  f"{len(times[True])} turns, {requests.bytes / 1e6:.1f} MB", flush=True)
    del limit


def main():
    words = sys.argv[1:]
    if words[:1] == ["measure"]:  # one request, for a parent process in the same folder
        limit = hogel.ThreadLimit(1)
        print(measured({"work": work, "quick_work": quick_work}[words[1]]()[0], words[2]))
        del limit
        return
    for name in "PYTHONPATH", "HOGEL_TWIN":  # also for child processes in other folders
        if name in os.environ:
            os.environ[name] = os.path.abspath(os.environ[name])
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        if words[:1] == ["figures"]:
            figures(int((words[1:] or [1])[0]))
        else:
            overheads()
            time_to_import()
        os.chdir("/")


if __name__ == "__main__":
    main()
