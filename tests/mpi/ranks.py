#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs hogel-mpi with several numbers of ranks and compares its files with those of hogel.

usage: ranks.py TEST HOGEL HOGEL_MPI MPIRUN      TEST: same_bytes, refused, errors, killed or stopped
"""
import os
import pathlib
import random
import signal
import subprocess
import sys
import tempfile
import time

RANKS = (1, 2, 3, 4, 7)
ENVIRONMENT = os.environ | {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
}
SIZE = "--hogels 24x20 --directions 24x24 --size 4mm".split()
KILLS = int(os.environ.get("HOGEL_KILLS", 10))


class Run:
    def __init__(self, hogel, hogel_mpi, mpirun, folder):
        self.hogel, self.hogel_mpi, self.mpirun, self.folder = hogel, hogel_mpi, mpirun, folder

    def alone(self, *arguments):
        subprocess.run([self.hogel, *arguments], cwd=self.folder, check=True, capture_output=True)

    def start(self, ranks, *arguments):
        command = [self.mpirun, "--oversubscribe", "--bind-to", "none", "-n", str(ranks), self.hogel_mpi, *arguments,
                   "--threads", "1"]
        return subprocess.Popen(command, cwd=self.folder, env=ENVIRONMENT, text=True, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE)

    def ranks(self, ranks, *arguments):
        process = self.start(ranks, *arguments)
        out, error = process.communicate(timeout=300)
        return process.returncode, out, error

    def bytes(self, name):
        return (self.folder / name).read_bytes()

    def left(self):
        return sorted(path.name for path in self.folder.iterdir())


def require(condition, *what):
    if not condition:
        sys.exit("failed: " + " ".join(str(each) for each in what))


def lines_of_hogel(error):
    return [line for line in error.splitlines() if line.startswith("hogel: ")]


def same_bytes(run):
    commands = {
        "render.h5": ["render", "pumpkin", *SIZE, "--depth"],
        "hemicube.h5": ["render", "tower", *SIZE, "--hemicube"],
        "regions.h5": ["render", "pumpkin", *SIZE, "--region", "3x3", "--float"],
        "of_file.h5": ["hologram", "whole_render.h5", "--wavelength", "rgb", "--half"],
        "of_scene.h5": ["hologram", "pumpkin", *SIZE],
        "basis.h5": ["hologram", "whole_regions.h5", "--method", "basis", "--wavelength", "633nm"],
        "unpacked.h5": ["decompress", "packed.hgl"],
    }
    for name, command in commands.items():
        if name == "unpacked.h5":
            run.alone("compress", "whole_render.h5", "-o", "packed.hgl", "--sqnr", "30")
        run.alone(*command, "-o", name)
        whole = run.bytes(name)
        (run.folder / name).rename(run.folder / f"whole_{name}")
        for ranks in RANKS:
            status, _, error = run.ranks(ranks, *command, "-o", name)
            require(status == 0, name, ranks, "ranks ended with", status, error)
            require(run.bytes(name) == whole, name, "of", ranks, "ranks has other bytes")
            said = [line for line in error.splitlines() if line.startswith(f"{name}: ")]
            require(len(said) == 1, name, ranks, "ranks said", error)
            (run.folder / name).unlink()
    require(not [name for name in run.left() if name.startswith(".")], "left behind:", run.left())


def refused(run):
    run.alone("render", "point", *SIZE, "-o", "a.h5")
    run.alone("hologram", "a.h5", "-o", "h.h5")
    before = run.left()
    for command in (["photo", "h.h5", "-o", "p.png"], ["make", "point", "-o", "folder"], ["slm", "h.h5", "-o", "s.png"],
                    ["propagate", "h.h5", "--distance", "5mm", "-o", "q.h5"], ["compress", "a.h5", "-o", "a.hgl"], ["info", "a.h5"],
                    ["render", "point", "-o", "a.hgl"], ["hologram", "point", "--method", "points", "-o", "x.h5"]):
        status, _, error = run.ranks(3, *command)
        lines = lines_of_hogel(error)
        require(status == 5 and len(lines) == 1, command, "ended with", status, error)
        word = command[-1] if command[0] == "render" else "points" if "points" in command else command[0]
        require("cannot share the work" in lines[0] or "cannot share its work" in lines[0], lines)
        require(word in lines[0], word, "is not named in", lines)
    require(run.left() == before, "left behind:", run.left())


def errors(run):
    for ranks in (1, 2, 4):
        for expected, command in ((2, ["render", "no_such_scene", "-o", "x.h5"]),
                                  (2, ["render", "point", "--hogels", "none", "-o", "x.h5"]),
                                  (3, ["hologram", "missing.h5", "-o", "x.h5"]),
                                  (4, ["render", "point", *SIZE, "-o", "no_folder/x.h5"])):
            status, _, error = run.ranks(ranks, *command)
            require(status == expected, command, ranks, "ranks ended with", status, error)
            require(len(lines_of_hogel(error)) == 1, command, "printed", error)
    # One rank alone finds a damaged sample: the others wait for tiles, and none is left behind.
    import h5py
    run.alone("render", "pumpkin", "--hogels", "64x64", "--directions", "16x16", "--float", "-o", "a.h5")
    with h5py.File(run.folder / "a.h5", "r+") as file:
        file["radiance"][0, 40, 40, 3, 3] = float("nan")
    for ranks in (2, 4):
        status, _, error = run.ranks(ranks, "hologram", "a.h5", "-o", "x.h5", "--pitch", "1um")
        lines = lines_of_hogel(error)
        require(status == 3 and len(lines) == 1 and "40" in lines[0], ranks, "ranks ended with", status, error)
    require(run.left() == ["a.h5"], "left behind:", run.left())
    status, out, _ = run.ranks(3, "--version")
    require(status == 0 and out.count("hogel ") == 1, "printed", out)


def children(pid):
    listed = subprocess.run(["ps", "-o", "pid=", "--ppid", str(pid)], capture_output=True, text=True).stdout
    return [int(word) for word in listed.split()]


LONG = ["hologram", "a.h5", "-o", "x.h5", "--pitch", "1um", "--resume", "--seed", "3"]


def long_work(run):
    run.alone("render", "pumpkin", "--hogels", "64x64", "--directions", "48x48", "--size", "8mm", "-o", "a.h5")
    began = time.monotonic()
    run.alone(*LONG, "--threads", "1")
    whole = run.bytes("x.h5")
    (run.folder / "x.h5").unlink()
    return whole, time.monotonic() - began


# A rank that is killed at a random moment, ten times and again until the work is complete, each time with another number
# of ranks.
def killed(run):
    chance = random.Random(7)
    whole, seconds = long_work(run)
    kills = completed = resumed = 0
    while kills < KILLS or completed == 0:
        process = run.start(chance.choice(RANKS), *LONG)
        time.sleep(chance.uniform(0.1, 0.5 + seconds) if kills < KILLS else 0)
        ranks = children(process.pid) if kills < KILLS else []
        if ranks:
            os.kill(chance.choice(ranks), signal.SIGKILL)
            kills += 1
        _, error = process.communicate(timeout=300)
        # A rank may be killed after the file has got its name.
        if process.returncode == 0 or (run.folder / "x.h5").exists():
            completed += 1
            require(run.bytes("x.h5") == whole, "other bytes after", kills, "kills")
            (run.folder / "x.h5").unlink()
        elif kills == KILLS and not ranks:
            require(False, "ended with", process.returncode, error)
        resumed += (run.folder / "x.h5.part.journal").exists()
        wrong = [name for name in run.left() if name not in ("a.h5", "x.h5.part", "x.h5.part.journal")]
        require(not wrong, "left behind:", wrong)
    require(resumed > 0, "nothing was ever kept")
    print(f"{kills} kills, {completed} completed, {resumed} times something was kept")


# What SIGTERM reaches stops within seconds, says so once, and keeps what is done; --resume without ranks completes it.
def stopped(run):
    whole, seconds = long_work(run)
    for to in ("mpirun", "a rank"):
        for old in run.folder.glob("x.h5*"):
            old.unlink()
        process = run.start(3, *LONG)
        deadline = time.monotonic() + 60
        while not (run.folder / "x.h5.part").exists() and time.monotonic() < deadline:
            time.sleep(0.02)
        time.sleep(0.15 * seconds)  # which one rank took alone
        pids = children(process.pid)
        os.kill(process.pid if to == "mpirun" else pids[-1], signal.SIGTERM)
        began = time.monotonic()
        _, error = process.communicate(timeout=60)
        took = time.monotonic() - began
        if process.returncode == 0 or (run.folder / "x.h5").exists():  # a signal that comes late changes mpirun's status alone
            require(run.bytes("x.h5") == whole, "other bytes")
            print(f"{to}: was complete before it was stopped")
            continue
        require(took < 10, "took", took, "s to stop")
        if to == "a rank":
            require(process.returncode == 143, "ended with", process.returncode, error)
            require(lines_of_hogel(error) == ["hogel: stopped"], error)
        # mpirun kills what has not ended soon after it was stopped: then what was not yet in the journal is done again.
        done = run.bytes("x.h5.part.journal").count(b" done ")
        require(to == "mpirun" or done > 0, to, "nothing was kept")
        print(f"{to}: stopped within {took:.2f} s, {done} parts were kept")
    run.alone(*LONG)
    require(run.bytes("x.h5") == whole, "other bytes after a stop")


def main():
    test, programs = sys.argv[1], [os.path.abspath(program) for program in sys.argv[2:5]]
    with tempfile.TemporaryDirectory(prefix="hogel_ranks_") as folder:
        globals()[test](Run(*programs, pathlib.Path(folder)))


if __name__ == "__main__":
    main()
