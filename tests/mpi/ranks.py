#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs hogel-mpi with several numbers of ranks and compares its files with those of hogel.

With HOGEL_THOROUGH=1 in the environment each command is run by every number of ranks, and ranks are killed 50 times in every
kind of work. Otherwise each command is run by one number of ranks, by turns, and ranks are killed in work of each kind of file.

usage: ranks.py TEST HOGEL HOGEL_MPI MPIRUN      TEST: same_files, same_streams, same_photographs, same_fields,
                                                       same_make, refused, errors, killed, lost or stopped
"""
import concurrent.futures
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

THOROUGH = os.environ.get("HOGEL_THOROUGH") == "1"
RANKS = (1, 2, 3, 4, 7)
TURNS = (2, 3, 7)
# Beside those by turns: fewer ranks than colours and looks, and more, share photographs in other ways.
ALSO = {"render.h5": (1, 4), "bent.exr": (2,), "colours.exr": (7,)}
ENVIRONMENT = os.environ | {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
}
SIZE = "--hogels 24x20 --directions 24x24 --size 4mm".split()
FILM = "--frames 5 --to-eye 20mm,0,200mm".split()
KILLS = int(os.environ.get("HOGEL_KILLS", 50))
PATIENCE = 300  # seconds, after which a process hangs


class Run:
    def __init__(self, hogel, hogel_mpi, mpirun, folder):
        self.hogel, self.hogel_mpi, self.mpirun, self.folder = hogel, hogel_mpi, mpirun, folder

    # The same programs in another folder, which has the files named.
    def inside(self, name, *files):
        folder = self.folder / name
        folder.mkdir()
        for file in files:
            (folder / file).hardlink_to(self.folder / file)
        return Run(self.hogel, self.hogel_mpi, self.mpirun, folder)

    def alone(self, *arguments):
        done = subprocess.run([self.hogel, *arguments], cwd=self.folder, capture_output=True, text=True)
        require(done.returncode == 0, arguments, "ended with", done.returncode, done.stderr)

    def start(self, ranks, *arguments):
        command = [self.mpirun, "--oversubscribe", "--bind-to", "none", "-n", str(ranks), self.hogel_mpi, *arguments,
                   "--threads", "1"]
        return subprocess.Popen(command, cwd=self.folder, env=ENVIRONMENT, text=True, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE)

    def ranks(self, ranks, *arguments):
        process = self.start(ranks, *arguments)
        out, error = process.communicate(timeout=PATIENCE)
        return process.returncode, out, error

    def bytes(self, name):
        return (self.folder / name).read_bytes()

    def left(self):
        return sorted(path.name for path in self.folder.iterdir())


# Two at once, because mpirun waits most of the time that it takes to start.
def in_pairs(function, *lists):
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        return list(pool.map(function, *lists))


def require(condition, *what):
    if not condition:
        sys.exit("failed: " + " ".join(str(each) for each in what))


def lines_of_hogel(error):
    return [line for line in error.splitlines() if line.startswith("hogel: ")]


def light_field(run):
    run.alone("render", "pumpkin", *SIZE, "--depth", "-o", "rays.h5")


# Each command gives the bytes of one process with any number of ranks, says so once and leaves nothing behind.
def require_same(run, commands):
    whole = run.inside("whole", *run.left())

    def compare(turn, name, command):
        whole.alone(*command, "-o", name)
        for ranks in RANKS if THOROUGH else (TURNS[turn % len(TURNS)], *ALSO.get(name, ())):
            status, _, error = run.ranks(ranks, *command, "-o", name)
            require(status == 0, name, ranks, "ranks ended with", status, error)
            require(run.bytes(name) == whole.bytes(name), name, "of", ranks, "ranks has other bytes")
            said = [line for line in error.splitlines() if line.startswith(f"{name}: ")]
            require(len(said) == 1, name, ranks, "ranks said", error)
            (run.folder / name).unlink()

    before = run.left()
    in_pairs(compare, range(len(commands)), commands.keys(), commands.values())
    require(run.left() == before, "left behind:", run.left())


def same_files(run):
    light_field(run)
    run.alone("render", "pumpkin", *SIZE, "--region", "3x3", "--float", "-o", "regions.h5")
    run.alone("compress", "rays.h5", "-o", "packed.hgl", "--sqnr", "30")
    require_same(run, {
        "render.h5": ["render", "pumpkin", *SIZE, "--depth"],
        "hemicube.h5": ["render", "tower", *SIZE, "--hemicube"],
        "of_file.h5": ["hologram", "rays.h5", "--wavelength", "rgb", "--half"],
        "of_scene.h5": ["hologram", "pumpkin", *SIZE],
        "basis.h5": ["hologram", "regions.h5", "--method", "basis", "--wavelength", "633nm"],
        "points.h5": ["hologram", "tower", "--hogels", "8x8", "--size", "1mm", "--method", "points", "--spacing", "60um"],
        "unpacked.h5": ["decompress", "packed.hgl"],
    })


def same_streams(run):
    light_field(run)
    run.alone("render", "tower", *SIZE, "--hemicube", "-o", "hemicube.h5")
    run.alone("render", "pumpkin", "--hogels", "40x24", "--directions", "32x1", "--size", "4mm", "-o", "rows.h5")
    require_same(run, {
        "sqnr.hgl": ["compress", "rays.h5", "--sqnr", "30", "--tile", "4x4"],
        "rate.hgl": ["compress", "rays.h5", "--no-depth", "--ppb", "2", "--tile", "5x4", "--tone", "histogram"],
        "cut.hgl": ["compress", "rays.h5", "--no-depth", "--ppb", "2", "--coder", "ezw", "--tile", "5x4"],
        "rule.hgl": ["compress", "rays.h5", "--no-depth", "--ppb", "2", "--rule", "histogram", "--coder", "threepass", "--tile", "6x5"],
        "lossless.hgl": ["compress", "rays.h5", "--lossless", "--tile", "6x5"],
        "hemicube.hgl": ["compress", "hemicube.h5", "--step", "0.01"],
        "rows.hgl": ["compress", "rows.h5", "--sqnr", "25"],
        "scene.hgl": ["render", "pumpkin", *SIZE, "--sqnr", "30"],
    })


def same_photographs(run):
    light_field(run)
    run.alone("hologram", "rays.h5", "--wavelength", "rgb", "-o", "hologram.h5")
    run.alone("hologram", "rays.h5", "--wavelength", "532nm", "-o", "green.h5")
    camera = "--resolution 60 --eye 0,0,200mm --pupil 5mm".split()
    require_same(run, {
        "rays.exr": ["photo", "rays.h5", *camera, "--pupil-samples", "16", "--focus", "20mm"],
        "scene.exr": ["photo", "tower", *SIZE, *camera, "--geometric", "--pupil-samples", "8"],
        "eye.exr": ["photo", "rays.h5", *camera, "--wave", "--looks", "3", "--camera", "eye"],
        "colours.exr": ["photo", "tower", *SIZE, *camera, "--wave", "--looks", "2", "--camera", "eye"],
        "looks.exr": ["photo", "rays.h5", *camera, "--wave", "--looks", "13", "--camera", "eye"],
        "bent.exr": ["photo", "rays.h5", *camera, "--wave", "--looks", "9", "--camera", "eye", "--focus", "40mm"],
        "expected.exr": ["photo", "rays.h5", *camera, "--looks", "expected", "--wave", "--focus", "3mm"],
        "film.apng": ["photo", "rays.h5", *camera, *FILM, "--pupil-samples", "4"],
        "clean.apng": ["photo", "rays.h5", *camera, *FILM, "--wave", "--looks", "expected"],
        "narrow.exr": ["photo", "hologram.h5", *camera],
        "full.exr": ["photo", "hologram.h5", *camera, "--camera", "full", "--focus", "1mm"],
        "tilted.exr": ["photo", "green.h5", *camera, "--camera", "full", "--focus-tilt", "20deg"],
        "film.png": ["photo", "green.h5", *camera, "--camera", "full", "--film-distance", "50mm"],
        "phase.png": ["photo", "green.h5", *camera, "--camera", "full", "--display", "phase"],
    })


def same_fields(run):
    light_field(run)
    run.alone("hologram", "rays.h5", "--wavelength", "rgb", "-o", "hologram.h5")
    run.alone("render", "pumpkin", *SIZE[:-2], "--size", "4.608mm", "--fov", "2.5deg", "-o", "narrow.h5")
    run.alone("hologram", "narrow.h5", "--wavelength", "532nm", "--pitch", "8um", "-o", "coarse.h5")
    run.alone("hologram", "narrow.h5", "--wavelength", "rgb", "--pitch", "8um", "-o", "colours.h5")
    far = "--distance 40mm --output-pitch 9um --output-samples 300x200 --offset-x 1mm".split()
    device = "--pixels 600x500 --pixel-pitch 8um".split()
    require_same(run, {
        "near.h5": ["propagate", "hologram.h5", "--distance", "3mm"],
        "far.h5": ["propagate", "hologram.h5", *far],
        "far.npy": ["propagate", "coarse.h5", *far],
        "back.png": ["propagate", "hologram.h5", "--distance", "-2mm"],
        "double.png": ["slm", "colours.h5", *device, "--encoding", "double-phase"],
        "gradient.png": ["slm", "coarse.h5", *device, "--encoding", "gradient", "--iterations", "3"],
        "gradients.png": ["slm", "colours.h5", *device, "--encoding", "gradient", "--iterations", "3"],
    })


# Its report says how long each stage took; everything else is the same.
def same_make(run):
    command = ["make", "pumpkin", *SIZE, "--resolution", "48", "--looks", "2", "--pupil-samples", "16",
               "--store-hologram", "--keep-light-field"]
    run.alone(*command, "-o", "whole")
    pictures = sorted(path.name for path in (run.folder / "whole").iterdir())
    require(len(pictures) > 25, "made", pictures)
    for ranks in RANKS if THOROUGH else (3,):
        status, _, error = run.ranks(ranks, *command, "-o", "made")
        require(status == 0, ranks, "ranks ended with", status, error)
        require(sorted(path.name for path in (run.folder / "made").iterdir()) == pictures, ranks, "ranks made others")
        for name in pictures:
            if not name.startswith("report"):
                require(run.bytes(f"made/{name}") == run.bytes(f"whole/{name}"), name, "of", ranks, "ranks has other bytes")
        for path in (run.folder / "made").iterdir():
            path.unlink()
        (run.folder / "made").rmdir()


def refused(run):
    run.alone("render", "point", *SIZE, "-o", "a.h5")
    before = run.left()
    commands = (["info", "a.h5"], ["compare", "a.h5", "a.h5"], ["print", "a.h5", "-o", "prints"])
    for command, (status, _, error) in zip(commands, in_pairs(lambda command: run.ranks(3, *command), commands)):
        lines = lines_of_hogel(error)
        require(status == 5 and len(lines) == 1, command, "ended with", status, error)
        require("cannot share its work" in lines[0] and command[0] in lines[0], lines)
    require(run.left() == before, "left behind:", run.left())
    # What is shared is tested here and described.
    shared = lines[0].split("expected ")[1].split(", or ")[0].split(", ")
    require(len(shared) >= 8, "few commands are shared:", shared)
    tests = pathlib.Path(__file__).read_text()
    page = (pathlib.Path(__file__).parents[2] / "docs" / "cluster.md").read_text()
    for command in shared:
        require(f'["{command}", ' in tests, command, "is not tested")
        require(f"`{command}`" in page, command, "is not in docs/cluster.md")


def errors(run):
    commands = ((2, ["render", "no_such_scene", "-o", "x.h5"]),
                (2, ["render", "point", "--hogels", "none", "-o", "x.h5"]),
                (3, ["hologram", "missing.h5", "-o", "x.h5"]),
                (4, ["render", "point", *SIZE, "-o", "no_folder/x.h5"]))

    def fail(turn, expected, command):
        for ranks in (1, 2, 4) if THOROUGH else ((2, 4, 1, 2)[turn],):
            status, _, error = run.ranks(ranks, *command)
            require(status == expected, command, ranks, "ranks ended with", status, error)
            require(len(lines_of_hogel(error)) == 1, command, "printed", error)

    in_pairs(fail, range(len(commands)), *zip(*commands))
    # One rank alone finds a damaged sample: the others wait for tiles, and none is left behind.
    import h5py
    run.alone("render", "pumpkin", "--hogels", "64x64", "--directions", "16x16", "--float", "-o", "a.h5")
    with h5py.File(run.folder / "a.h5", "r+") as file:
        file["radiance"][0, 40, 40, 3, 3] = float("nan")
    for ranks in (2, 4) if THOROUGH else (4,):
        status, _, error = run.ranks(ranks, "hologram", "a.h5", "-o", "x.h5", "--pitch", "1um")
        lines = lines_of_hogel(error)
        require(status == 3 and len(lines) == 1 and "40" in lines[0], ranks, "ranks ended with", status, error)
    require(run.left() == ["a.h5"], "left behind:", run.left())
    status, out, _ = run.ranks(3, "--version")
    require(status == 0 and out.count("hogel ") == 1, "printed", out)


def children(pid):
    listed = subprocess.run(["ps", "-o", "pid=", "--ppid", str(pid)], capture_output=True, text=True).stdout
    return [int(word) for word in listed.split()]


# Waits for mpirun. Open MPI 4.1 sometimes waits for itself for ever at its end where a rank was killed while it started
# (PMIx_server_finalize); by then all ranks have ended.
def end_of(process):
    deadline = time.monotonic() + PATIENCE
    while process.poll() is None:
        if time.monotonic() > deadline:
            process.kill()
            require(False, "did not end within", PATIENCE, "s")
        states = [pathlib.Path(f"/proc/{pid}/stat") for pid in children(process.pid)]
        alive = [path for path in states if path.exists() and ") Z " not in path.read_text()]
        if states and not alive:
            time.sleep(5)
            if process.poll() is None:
                process.kill()
        time.sleep(0.05)
    return process.communicate()


HOLOGRAM = ["hologram", "a.h5", "-o", "x.h5", "--pitch", "1.6um", "--resume", "--seed", "3"]
RENDER = ["render", "pumpkin", "--hogels", "80x80", "--directions", "48x48", "--size", "8mm",
          "--algorithm", "raytrace", "-o", "x.h5", "--resume"]
COMPRESS = ["compress", "a.h5", "-o", "x.hgl", "--step", "0.02", "--resume"]
PHOTO = ["photo", "a.h5", "-o", "x.exr", "--wave", "--camera", "narrow", "--looks", "4", "--resolution", "64", "--resume"]
WAVES = ["photo", "a.h5", "-o", "x.exr", "--wave", "--resume"]
EYE = [*WAVES, "--camera", "eye", "--looks", "32", "--resolution", "256"]
EXPECTED = [*WAVES, "--looks", "expected", "--resolution", "1024"]
FULL_CAMERA = [*WAVES, "--camera", "full", "--looks", "2", "--resolution", "64"]
RAYS = ["photo", "a.h5", "-o", "x.exr", "--resolution", "256", "--pupil-samples", "4096", "--resume"]
PATTERNS = ["slm", "w.h5", "-o", "x.png", "--pixels", "1000x1000", "--pixel-pitch", "7.8125um", "--encoding", "gradient",
            "--iterations", "20", "--resume"]
PROPAGATE = ["propagate", "p.h5", "-o", "x.h5", "--distance", "3mm", "--resume"]
LINES = ["photo", "l.h5", "-o", "x.exr", "--diffuser", "vertical", "--resolution", "24", "--resume"]
MAKE = ["make", "pumpkin", *"--hogels 96x96 --size 6mm --resolution 128 --store-hologram -o m --resume".split()]


# The file that a command makes by itself, and how long one thread takes for it.
def made_alone(run, command):
    made = run.folder / command[command.index("-o") + 1]
    began = time.monotonic()
    run.alone(*command, "--threads", "1")
    whole = made.read_bytes()
    made.unlink()
    return made, whole, time.monotonic() - began


# What is left of unfinished work, and how far it is. A journal is there when samples of an HDF5 file begin to be written where
# they belong; other results are added to a file that begins with less than 4 kB about the work.
class Kept:
    PIECES = 64

    def __init__(self, made):
        self.part, self.journal = (made.with_name(made.name + ending) for ending in (".part", ".part.journal"))
        self.is_hdf5 = made.suffix == ".h5"

    def is_there(self):
        return (self.journal if self.is_hdf5 else self.part).exists()

    def has_begun(self):
        try:
            return self.journal.exists() if self.is_hdf5 else self.part.stat().st_size >= 4096
        except FileNotFoundError:
            return False

    # A third of an HDF5 file, which is more than all ranks have under way.
    def has_results(self):
        return self.has_begun() and (not self.is_hdf5 or 3 * self.written() >= self.PIECES)

    # How many pieces all over the file are not zero.
    def written(self):
        try:
            with open(self.part, "rb") as file:
                size, written = self.part.stat().st_size, 0
                for piece in range(self.PIECES):
                    file.seek(size * piece // self.PIECES + 4096)
                    written += any(file.read(2048))
                return written
        except FileNotFoundError:  # it has just got its name
            return 0

    # The journal's records of parts of a light field, 8 numbers each, after one of 3 without a key.
    def parts(self):
        return (len(self.journal.read_bytes().split(b"\nrecords\n", 1)[1]) - 24) // 64

    def remove(self):
        for path in (self.part, self.journal):
            path.unlink(missing_ok=True)


# Whether it has happened before the process has ended.
def wait_until(process, happened):
    deadline = time.monotonic() + PATIENCE
    while not happened():
        if process.poll() is not None:
            return False
        require(time.monotonic() < deadline, "nothing has happened within", PATIENCE, "s")
        time.sleep(0.005)
    return True


# Processes may have ended just before.
def signal_all(pids, number):
    sent = 0
    for pid in pids:
        try:
            os.kill(pid, number)
            sent += 1
        except ProcessLookupError:
            pass
    return sent


# The processes of ranks that have results and stand still, so that what happens to them next happens before they go on.
def halted(process, kept):
    if not wait_until(process, kept.has_begun):
        require(False, "ended before it began:", *process.communicate())
    pids = children(process.pid)
    require(wait_until(process, kept.has_results), "was complete before it had results")
    signal_all(pids, signal.SIGSTOP)
    require(kept.is_there(), "was complete before it was halted")
    return pids


# Kills a rank when something has been kept, then at random moments, and again until the work is complete, each time with
# another number of ranks.
def kill_until_complete(run, chance, command, kills_wanted):
    inputs = run.left()
    made, whole, seconds = made_alone(run, command)
    kept = Kept(made)
    kills = completed = resumed = 0
    # A photograph by rays is kept whole, just before it is written.
    keeps = command != RAYS
    for _ in range(20 + kills_wanted):
        if kills >= kills_wanted and completed > 0 and (resumed > 0 or not keeps):
            break
        process = run.start(chance.choice(RANKS), *command)
        # A rank that is killed too late has completed the work, one that is killed too early has kept nothing.
        killing = kills < kills_wanted or (keeps and resumed == 0)
        if killing and keeps and resumed == 0:
            wait_until(process, kept.has_begun)
        elif killing:
            time.sleep(chance.uniform(0.1, 0.5 + seconds))
        ranks = children(process.pid) if killing else []
        if ranks:
            kills += signal_all([chance.choice(ranks)], signal.SIGKILL)
        _, error = end_of(process)
        # A rank may be killed after the file has got its name.
        if process.returncode == 0 or made.exists():
            completed += 1
            require(made.read_bytes() == whole, "other bytes after", kills, "kills")
            made.unlink()
        elif not killing:
            require(False, "ended with", process.returncode, error)
        resumed += kept.is_there()
        # A killed process leaves a temporary file, which the next one removes; of HDF5 files that is the kept one.
        wrong = [name for name in run.left() if name not in (*inputs, kept.part.name, kept.journal.name)
                 and not (made.suffix != ".h5" and name.endswith(".tmp"))]
        require(not wrong, "left behind:", wrong)
    require(completed > 0 and (resumed > 0 or not keeps), "completed", completed, "times, kept something", resumed, "times")
    print(f"{' '.join(command[:6])}: {kills} kills, {completed} completed, {resumed} times something was kept")
    kept.remove()


def killed(run):
    size = ["--hogels", "64x64", "--directions", "48x48", "--size", "8mm"]
    run.alone("render", "pumpkin", *size, "-o", "a.h5")
    if not THOROUGH:
        # An HDF5 file, a stream, a photograph and a folder.
        works = [(kill_until_complete, command, 2) for command in (HOLOGRAM, COMPRESS, EYE)] + [(kill_make_until_complete, MAKE, 1)]
    else:
        run.alone("render", "pumpkin", *size, "--fov", "2.5deg", "-o", "s.h5")
        run.alone("hologram", "s.h5", "--wavelength", "rgb", "--pitch", "8um", "-o", "w.h5")
        run.alone("hologram", "a.h5", "-o", "p.h5", "--wavelength", "rgb", "--pitch", "1.6um")
        run.alone("hologram", "tower", *"--hogels 64x96 --directions 64x1 --method lines --line-pitch 80um --size 8mm -o l.h5".split())
        (run.folder / "s.h5").unlink()
        commands = (HOLOGRAM, RENDER, COMPRESS, PHOTO, EYE, EXPECTED, FULL_CAMERA, RAYS, PATTERNS, PROPAGATE, LINES)
        works = [(kill_until_complete, command, (KILLS + i) // (len(commands) + 1)) for i, command in enumerate(commands)]
        works.append((kill_make_until_complete, MAKE, KILLS // (len(commands) + 1)))
    inputs = run.left()

    def work(number, kill, command, kills):
        kill(run.inside(f"work{number}", *inputs), random.Random(7 + number), command, kills)

    in_pairs(work, range(len(works)), *zip(*works))


# As above; what is made is a folder, which is complete when it has its report.
def kill_make_until_complete(run, chance, command, kills):
    made, whole = run.folder / "m", run.folder / "whole"
    began = time.monotonic()
    run.alone(*command, "--threads", "1")
    seconds, kept = time.monotonic() - began, Kept(made / "make")
    made.rename(whole)
    killed = resumed = 0
    for _ in range(20 + kills):
        process = run.start(chance.choice(RANKS), *command)
        # A rank that is killed too late has completed the work; the first rank removes a log in which nothing is kept yet.
        killing = killed < kills or resumed == 0
        if killing and resumed == 0:
            wait_until(process, kept.has_begun)
        elif killing:
            time.sleep(chance.uniform(0.5, 0.5 + seconds))
        if killing and (ranks := children(process.pid)):
            killed += signal_all([chance.choice(ranks)], signal.SIGKILL)
        _, error = end_of(process)
        resumed += kept.is_there()
        complete = (made / "report.html").exists()
        require(complete or killing, "ended with", process.returncode, error)
        if complete and resumed > 0:
            break
        if complete:
            shutil.rmtree(made)
    require(complete and resumed > 0, "resumed", resumed, "times, ended with", process.returncode, error)
    names = sorted(path.name for path in whole.iterdir())
    require(sorted(path.name for path in made.iterdir()) == names, "made", sorted(made.iterdir()))
    for name in names:
        require(name.startswith("report") or (made / name).read_bytes() == (whole / name).read_bytes(), name, "has other bytes")
    print(f"make: killed {killed} times, resumed {resumed} times")


# Some seconds of it, of which a third is done when its ranks are halted; and a minute, of which nobody sees the end.
RENDER_LONG = ["render", "pumpkin", *"--hogels 80x80 --directions 24x24 --size 8mm --algorithm raytrace --samples 2x2".split(),
               "-o", "x.h5", "--resume"]
RENDER_ENDLESS = [{"80x80": "160x160", "2x2": "3x3", "x.h5": "endless.h5"}.get(word, word) for word in RENDER_LONG]


def rank_of(pid):
    words = dict(word.partition("=")[::2] for word in pathlib.Path(f"/proc/{pid}/environ").read_text().split("\0"))
    return int(words["OMPI_COMM_WORLD_RANK"])


# The others of a rank that is killed name it, once, and keep what is done.
def lost(run):
    made, whole, _ = made_alone(run, RENDER_LONG)
    kept = Kept(made)
    for rank in (0, 2):
        kept.remove()
        process = run.start(4, *RENDER_LONG)
        pids = halted(process, kept)
        victim = next(pid for pid in pids if rank_of(pid) == rank)
        os.kill(victim, signal.SIGKILL)
        signal_all([pid for pid in pids if pid != victim], signal.SIGCONT)
        _, error = process.communicate(timeout=PATIENCE)
        lines = lines_of_hogel(error)
        require(process.returncode != 0 and len(lines) == 1, "ended with", process.returncode, error)
        require(lines[0].startswith(f"hogel: rank {rank} of 4 (process {victim}) was lost; completed work is saved"), lines)
        require(not made.exists() and kept.is_there(), "after the loss of rank", rank, "there is", run.left())
    status, _, error = run.ranks(3, *RENDER_LONG)
    require(status == 0 and made.read_bytes() == whole, "ended with", status, error)


# A rank that SIGTERM reaches stops all, says so once, and keeps what is done; --resume without ranks completes it.
def stopped(run):
    made, whole, _ = made_alone(run, RENDER_LONG)
    kept = Kept(made)
    process = run.start(3, *RENDER_LONG)
    pids = halted(process, kept)
    os.kill(pids[-1], signal.SIGTERM)
    signal_all(pids, signal.SIGCONT)
    _, error = process.communicate(timeout=PATIENCE)
    require(process.returncode == 143 and lines_of_hogel(error) == ["hogel: stopped"], "ended with", process.returncode, error)
    require(not made.exists() and kept.is_there(), "a rank was stopped, and there is", run.left())
    require(kept.parts() > 0, "nothing was kept")
    run.alone(*RENDER_LONG)
    require(made.read_bytes() == whole, "other bytes after a stop")
    stopped_by_mpirun(run)


# mpirun stops its ranks a second after it was stopped, and kills those that are left after another: what was not yet in the
# journal then is done again.
def stopped_by_mpirun(run):
    made = run.folder / "endless.h5"
    kept = Kept(made)
    process = run.start(3, *RENDER_ENDLESS)
    require(wait_until(process, lambda: kept.has_begun() and kept.written() > 0), "ended before it was stopped")
    process.send_signal(signal.SIGTERM)
    _, error = process.communicate(timeout=PATIENCE)
    require(process.returncode != 0 and lines_of_hogel(error) in ([], ["hogel: stopped"]), "ended with", process.returncode, error)
    require(not made.exists() and kept.is_there(), "mpirun was stopped, and there is", run.left())
    print(f"mpirun was stopped: {kept.parts()} parts were kept")


def main():
    test, programs = sys.argv[1], [os.path.abspath(program) for program in sys.argv[2:5]]
    with tempfile.TemporaryDirectory(prefix="hogel_ranks_") as folder:
        globals()[test](Run(*programs, pathlib.Path(folder)))


if __name__ == "__main__":
    main()
