#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Measures each stage with 1 rank of 2 threads and with 2 ranks of 1 thread, alternately, including files and the start of
MPI. Prints a table; docs/cluster.md shows its elapsed times. Figures are valid only on an idle machine with two processors.

usage: mpi_efficiency.py HOGEL HOGEL_MPI MPIRUN [--stages NAME,NAME] [--rounds N] [--small | --large] [--require]
       --small: small sizes, for testing this program; --large: four times the work
       --require: fails unless each stage reaches its limit in one of three tries, or if there are fewer than two processors
"""
import argparse
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

ENVIRONMENT = os.environ | {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
LIMIT = 0.95
# A virtual machine may return memory that is free for some seconds to its host. Getting it back takes up to three seconds
# per gigabyte. So this number of bytes is touched before each run: more than the run needs, because the host reclaims a
# sixteenth of the free memory every two seconds.
MEMORY_AT_HAND = min(6 << 30, os.sysconf("SC_AVPHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") // 2)
TOUCH = f"""
import mmap
memory = mmap.mmap(-1, {MEMORY_AT_HAND}, flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)
memory.madvise(mmap.MADV_HUGEPAGE)
for place in range(0, {MEMORY_AT_HAND}, 4096):
    memory[place] = 1
"""
# Lower limits of stages for which docs/cluster.md states and explains a lower ratio, with a tenth for other work on the
# machine. Three stages with three jobs, one per colour, have no limit.
LIMITS = {"compress": 0.85, "hologram": 0.85, "photo by rays": 0.85, "photo, camera narrow": 0.85,
          "photo, camera narrow, streamed": 0.85, "photo, camera eye": 0, "photo, looks expected": 0, "photo, camera full": 0.85,
          "propagate": 0.85, "slm": 0, "make": 0.75}


# name: inputs, command
FULL = {
    "render": ((), "render church --hogels 288x288 --directions 64x64 --samples 2x2 -o out.h5"),
    "compress": (("rays",), "compress rays.h5 --step 0.01 -o out.hgl"),
    "decompress": (("packed",), "decompress packed.hgl -o out.h5"),
    "hologram": (("wide",), "hologram wide.h5 --wavelength 532nm --pitch 1.25um --half -o out.h5"),
    "photo by rays": (("rays",), "photo rays.h5 --frames 8 --to-eye 30mm,0,300mm --resolution 256 --pupil-samples 4096 -o out####.png"),
    "photo, camera narrow": (("waves",), "photo waves.h5 --resolution 256 -o out.exr"),
    "photo, camera narrow, streamed": (("wide",), "photo wide.h5 --wave --camera narrow --looks 1 --wavelength 532nm "
                                       "--pitch 1.25um --resolution 256 -o out.exr"),
    "photo, camera eye": (("wide",), "photo wide.h5 --wave --camera eye --looks 8 --resolution 256 -o out.exr"),
    "photo, looks expected": (("wide",), "photo wide.h5 --wave --looks expected --frames 4 --eye=-15mm,0,400mm --to-eye 15mm,0,400mm --resolution 512 -o out####.png"),
    "photo, camera full": (("field",), "photo field.h5 --camera full --resolution 256 -o out.exr"),
    "propagate": (("field",), "propagate field.h5 --distance 5mm -o out.h5"),
    "slm": (("colours",), "slm colours.h5 --pixels 2400x2000 --pixel-pitch 8um --encoding gradient --iterations 20 -o out.png"),
    "make": ((), "make pumpkin --hogels 192x192 --size 12mm -o out"),
}
INPUTS = {
    "rays": "render pumpkin --hogels 160x160 --directions 64x64 --size 20mm -o rays.h5",
    "wide": "render pumpkin --hogels 320x320 --directions 64x64 --size 40mm -o wide.h5",
    "packed": "compress wide.h5 --step 0.01 -o packed.hgl",
    "waves": "hologram rays.h5 --wavelength rgb --pitch 1.25um --half -o waves.h5",
    "field": "hologram rays.h5 --wavelength 532nm --pitch 1.9um --half -o field.h5",
    "slow": "render pumpkin --hogels 160x160 --directions 64x64 --size 19.2mm --fov 2.5deg -o slow.h5",
    "colours": "hologram slow.h5 --wavelength rgb --pitch 8um -o colours.h5",
}
NEEDS = {"packed": ("wide",), "waves": ("rays",), "field": ("rays",), "colours": ("slow",)}


def smaller(command):
    for large, small in (("192x192", "16x16"), ("288x288", "16x16"), ("160x160", "24x24"), ("320x320", "24x24"),
                         ("20mm", "3mm"), ("40mm", "3mm"), ("19.2mm", "4.608mm"), ("12mm", "2mm"),
                         ("resolution 512", "resolution 48"), ("4096", "16"), ("2400x2000", "600x500")):
        command = command.replace(large, small)
    return command


def larger(command):
    for usual, large in (("192x192", "384x384"), ("288x288", "576x576"), ("320x320", "640x640"), ("160x160", "320x320"),
                         ("40mm", "80mm"), ("20mm", "40mm"), ("19.2mm", "38.4mm"), ("12mm", "24mm"),
                         ("2400x2000", "4800x4000"), ("resolution 512", "resolution 1024")):
        command = command.replace(usual, large)
    return command


class Bench:
    def __init__(self, options, folder):
        self.hogel, self.hogel_mpi, self.mpirun = (os.path.abspath(each) for each in (options.hogel, options.hogel_mpi, options.mpirun))
        self.sized = smaller if options.small else larger if options.large else str
        self.folder, self.made = folder, set()

    def prepare(self, name):
        for needed in NEEDS.get(name, ()):
            self.prepare(needed)
        if name not in self.made:
            self.call([self.hogel, *self.sized(INPUTS[name]).split()])
            self.made.add(name)

    def call(self, command):
        before, began = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
        done = subprocess.run(command, cwd=self.folder, env=ENVIRONMENT, capture_output=True, text=True)
        took, after = time.monotonic() - began, resource.getrusage(resource.RUSAGE_CHILDREN)
        if done.returncode != 0:
            sys.exit(f"{' '.join(command)}: {done.stderr}")
        return took, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime

    def ranks(self, ranks, command):
        for old in self.folder.glob("out*"):
            subprocess.run(["rm", "-r", str(old)], check=True)
        subprocess.run([sys.executable, "-c", TOUCH], check=False)  # or the available memory
        return self.call([self.mpirun, "--oversubscribe", "--bind-to", "none", "-n", str(ranks), self.hogel_mpi,
                          *command.split(), "--threads", str(2 // ranks)])

    # Returns elapsed and processor seconds of the fastest run of both, because other work on the machine only adds to a
    # run, and the ratio of the elapsed seconds.
    def compare(self, command, rounds):
        runs = {1: [], 2: []}
        for turn in range(rounds):
            for ranks in ((1, 2), (2, 1))[turn % 2]:
                runs[ranks].append(self.ranks(ranks, command))
        one, two = min(runs[1]), min(runs[2])
        return *one, *two, one[0] / two[0]


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    for name in ("hogel", "hogel_mpi", "mpirun"):
        parser.add_argument(name)
    parser.add_argument("--stages", default=",".join(name.replace(",", "") for name in FULL))
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--small", action="store_true")
    parser.add_argument("--large", action="store_true")
    parser.add_argument("--require", action="store_true")
    options = parser.parse_args()
    if options.require and len(os.sched_getaffinity(0)) < 2:
        sys.exit("two processors are needed")
    wanted, low = options.stages.split(","), []
    with tempfile.TemporaryDirectory(prefix="hogel_efficiency_") as folder:
        bench = Bench(options, pathlib.Path(folder))
        start = bench.compare("--version", options.rounds)
        print(f"start alone: {start[0]:.2f} s and {start[2]:.2f} s\n", flush=True)
        print("| stage | 1 rank × 2 threads: elapsed, processor time | 2 ranks × 1 thread | ratio |\n|---|---|---|---|", flush=True)
        for name, (inputs, command) in FULL.items():
            if name.replace(",", "") not in wanted:
                continue
            for each in inputs:
                bench.prepare(each)
            limit = LIMITS.get(name, LIMIT) if options.require else 0
            for _ in range(3):  # other work may disturb one
                one, one_work, two, two_work, ratio = bench.compare(bench.sized(command), options.rounds)
                print(f"| {name} | {one:.1f} s, {one_work:.1f} s | {two:.1f} s, {two_work:.1f} s | {ratio:.2f} |", flush=True)
                if ratio >= limit:
                    break
            else:
                low.append(name)
    if options.require and low:
        sys.exit("below the limits of docs/cluster.md: " + "; ".join(low))


if __name__ == "__main__":
    main()
