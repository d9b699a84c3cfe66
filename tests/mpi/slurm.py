#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Submits the batch files of examples/cluster to a Slurm of one node, which this script starts and ends, and compares their
files with those of hogel. Ends with status 77 where slurm-wlm, munge or root is missing.

usage: slurm.py HOGEL HOGEL_MPI EXAMPLES
"""
import getpass
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scancel", "scontrol")
SIZES = {"HOGELS": "48x48", "SIZE": "6mm", "DIRECTIONS": "32x32"}


def find(program):
    return shutil.which(program) or shutil.which(program, path="/usr/sbin:/sbin")


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for each in sockets:
        each.bind(("127.0.0.1", 0))
    ports = [each.getsockname()[1] for each in sockets]
    for each in sockets:
        each.close()
    return ports


def require(condition, *what):
    if not condition:
        sys.exit("failed: " + " ".join(str(each) for each in what))


class Slurm:
    def __init__(self, folder):
        self.folder, self.processes = folder, []
        self.environment = os.environ | SIZES | {
            "SLURM_CONF": str(folder / "slurm.conf"), "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
            "OMPI_MCA_btl": "self,vader"}

    def __enter__(self):
        name, (control, daemon) = socket.gethostname().split(".")[0], free_ports(2)
        (self.folder / "munge.key").write_bytes(os.urandom(1024))
        (self.folder / "munge.key").chmod(0o400)
        for part in ("state", "spool"):
            (self.folder / part).mkdir()
        (self.folder / "slurm.conf").write_text(f"""ClusterName=hogel
SlurmctldHost={name}(127.0.0.1)
SlurmUser={getpass.getuser()}
SlurmdUser={getpass.getuser()}
SlurmctldPort={control}
SlurmdPort={daemon}
CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
AuthInfo=socket={self.folder}/munge.socket
StateSaveLocation={self.folder}/state
SlurmdSpoolDir={self.folder}/spool
SlurmctldPidFile={self.folder}/slurmctld.pid
SlurmdPidFile={self.folder}/slurmd.pid
SlurmctldLogFile={self.folder}/slurmctld.log
SlurmdLogFile={self.folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
KillWait=5
NodeName={name} NodeAddr=127.0.0.1 CPUs={os.cpu_count()} State=UNKNOWN
PartitionName=all Nodes={name} Default=YES MaxTime=INFINITE State=UP
""")
        self.start("munged", "--foreground", "--force", f"--key-file={self.folder}/munge.key", f"--socket={self.folder}/munge.socket",
                   f"--pid-file={self.folder}/munged.pid", f"--log-file={self.folder}/munged.log",
                   f"--seed-file={self.folder}/munged.seed")
        self.wait(lambda: (self.folder / "munge.socket").exists(), "munged")
        self.start("slurmctld", "-D", "-c")
        self.start("slurmd", "-D", "-c", "-N", name)
        self.wait(lambda: "idle" in self.run("sinfo", "-h", "-o", "%t").stdout, "the node")
        return self

    def __exit__(self, *_):
        for process in reversed(self.processes):
            process.send_signal(signal.SIGTERM)
        for process in self.processes:
            try:
                process.wait(10)
            except subprocess.TimeoutExpired:
                process.kill()

    def start(self, program, *arguments):
        with open(self.folder / f"{program}.out", "w") as out:
            self.processes.append(subprocess.Popen([find(program), *arguments], env=self.environment, stdout=out, stderr=out))

    def wait(self, until, what, seconds=300):
        end = time.monotonic() + seconds
        while not until():
            if time.monotonic() > end:
                logs = "".join(path.read_text()[-1500:] for path in self.folder.glob("*.log"))
                sys.exit(f"failed: {what} did not come within {seconds} s\n{logs}")
            time.sleep(0.2)

    def run(self, *command):
        return subprocess.run([find(command[0]) or command[0], *command[1:]], env=self.environment, cwd=self.folder, text=True,
                              capture_output=True)

    def submit(self, *arguments):
        done = self.run("sbatch", "--parsable", *arguments)
        require(done.returncode == 0, arguments, done.stderr)
        return done.stdout.strip()

    def running(self, job):
        return self.run("squeue", "-h", "-j", job, "-o", "%T").stdout.split()

    def finish(self, job, seconds=300):
        self.wait(lambda: not [state for state in self.running(job) if state != "COMPLETING"], f"the end of job {job}", seconds)

    def said(self):
        return "".join(path.read_text() for path in sorted(self.folder.glob("slurm-*.out")))


def alone(hogel, folder):
    run = lambda *arguments: subprocess.run([hogel, *arguments], cwd=folder, check=True, capture_output=True)
    run("render", "tower", "-o", "whole.h5", "--hogels", SIZES["HOGELS"], "--size", SIZES["SIZE"], "--directions", SIZES["DIRECTIONS"])
    (folder / "whole.h5").rename(folder / "tower.h5")
    run("hologram", "tower.h5", "-o", "hologram.h5", "--wavelength", "rgb", "--half")
    whole = [(folder / name).read_bytes() for name in ("tower.h5", "hologram.h5")]
    for name in ("tower.h5", "hologram.h5"):
        (folder / name).unlink()
    return whole


def ranks(slurm, examples, whole):
    job = slurm.submit("--nodes=1", f"--ntasks-per-node={min(2, os.cpu_count())}", examples / "ranks.sbatch")
    slurm.finish(job)
    for name, bytes_of in zip(("tower.h5", "hologram.h5"), whole):
        require((slurm.folder / name).exists(), name, "was not written:", slurm.said())
        require((slurm.folder / name).read_bytes() == bytes_of, name, "has other bytes")
    print("ranks: the same bytes")


# The batch system's signal stops the work within its time, and the job that is submitted again completes it.
def stopped(slurm, examples, whole):
    (slurm.folder / "hologram.h5").unlink()
    job = slurm.submit("--nodes=1", f"--ntasks-per-node={min(2, os.cpu_count())}", examples / "ranks.sbatch")
    slurm.wait(lambda: (slurm.folder / "hologram.h5.part").exists() or (slurm.folder / "hologram.h5").exists(), "work")
    began = time.monotonic()
    slurm.run("scancel", "--signal=TERM", job)
    slurm.finish(job)
    complete = (slurm.folder / "hologram.h5").exists()
    print(f"stopped: {'was complete' if complete else f'within {time.monotonic() - began:.1f} s'}")
    if not complete:
        slurm.finish(slurm.submit("--nodes=1", "--ntasks-per-node=1", examples / "ranks.sbatch"))
    require((slurm.folder / "hologram.h5").read_bytes() == whole[1], "other bytes after a stop", slurm.said())


def parts(slurm, examples, whole, hogel):
    (slurm.folder / "tower.h5").unlink()
    slurm.finish(slurm.submit("--array=1-3", "--cpus-per-task=1", examples / "parts.sbatch"))
    joined = sorted(path.name for path in slurm.folder.glob("tower.part-*-of-3"))
    require(len(joined) == 3, "parts:", joined, slurm.said())
    subprocess.run([hogel, "join", *joined, "-o", "tower.h5"], cwd=slurm.folder, check=True, capture_output=True)
    require((slurm.folder / "tower.h5").read_bytes() == whole[0], "other bytes of joined parts")
    print("parts: the same bytes")


def main():
    if not all(find(program) for program in PROGRAMS) or os.geteuid() != 0:
        print("slurm-wlm, munge or root is missing")
        sys.exit(77)
    hogel, hogel_mpi, examples = (pathlib.Path(path).resolve() for path in sys.argv[1:4])
    os.environ["PATH"] = f"{hogel.parent}:{hogel_mpi.parent}:{os.environ['PATH']}"
    with tempfile.TemporaryDirectory(prefix="hogel_slurm_") as folder:
        os.chmod(folder, 0o755)
        whole = alone(hogel, pathlib.Path(folder))
        with Slurm(pathlib.Path(folder)) as slurm:
            ranks(slurm, examples, whole)
            stopped(slurm, examples, whole)
            parts(slurm, examples, whole, hogel)


if __name__ == "__main__":
    main()
