#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs hogel-mpi on three nodes: network namespaces of this machine, each with a name and an address of its own, which
mpirun reaches over a bridge and which lose their network or their processes. All of it is in namespaces that end with
this script. Ends with status 77 where root, ip or unshare is missing. Waits for a silent machine.

usage: nodes.py TEST HOGEL HOGEL_MPI MPIRUN      TEST: same or lost
"""
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time

import ranks
from ranks import lines_of_hogel, require

PATH = os.environ["PATH"] + ":/usr/sbin:/sbin"
ENVIRONMENT = ranks.ENVIRONMENT | {"PATH": PATH}
NODES = ("node1", "node2", "node3")
# As ssh: runs a command on a node, and waits for ever where the node went silent.
AGENT = """#!/bin/sh
node=$1
shift
ip netns exec "$node" unshare --uts sh -c "hostname $node; $*"
status=$?
test ! -e "$(dirname "$0")/silent" || exec sleep 1000
exit $status
"""
# A node without power sends nothing that ends its connections: mpirun asks for signs of life as docs/cluster.md says.
# Ranks that it stops have five seconds to keep what is done.
OF_LARGE_JOBS = ("--mca oob_tcp_keepalive_time 5 --mca oob_tcp_keepalive_intvl 1 --mca oob_tcp_keepalive_probes 5 "
                 "--mca odls_base_sigkill_timeout 5").split()
SIZE = "--hogels 24x20 --directions 24x24 --size 4mm".split()


def system(*command):
    subprocess.run(command, check=True, env=ENVIRONMENT)


class Cluster(ranks.Run):
    def __init__(self, hogel, hogel_mpi, mpirun, folder):
        super().__init__(hogel, hogel_mpi, mpirun, folder / "shared")
        self.folder.mkdir()
        self.agent, self.silent = folder / "agent", folder / "silent"
        self.agent.write_text(AGENT)
        self.agent.chmod(0o755)
        os.makedirs("/run/netns", exist_ok=True)
        system("mount", "-t", "tmpfs", "none", "/run/netns")
        system("ip", "link", "set", "lo", "up")
        system("ip", "link", "add", "bridge", "type", "bridge")
        system("ip", "address", "add", "10.77.0.1/24", "dev", "bridge")
        system("ip", "link", "set", "bridge", "up")
        for number, node in enumerate(NODES):
            system("ip", "netns", "add", node)
            system("ip", "link", "add", node, "type", "veth", "peer", "name", "eth0", "netns", node)
            system("ip", "link", "set", node, "master", "bridge", "up")
            system("ip", "-n", node, "address", "add", f"10.77.0.{10 + number}/24", "dev", "eth0")
            system("ip", "-n", node, "link", "set", "eth0", "up")
            system("ip", "-n", node, "link", "set", "lo", "up")

    # Ranks on nodes, from the first one on, so many on each.
    def start(self, on_nodes, *arguments):
        hosts = ",".join(f"{node}:{count}" for node, count in on_nodes.items())
        command = [self.mpirun, "--mca", "plm_rsh_agent", str(self.agent), "--mca", "btl", "tcp,vader,self",
                   "--mca", "btl_tcp_if_include", "10.77.0.0/24", "--mca", "oob_tcp_if_include", "10.77.0.0/24", *OF_LARGE_JOBS,
                   "--bind-to", "none", "--host", hosts, "-n", str(sum(on_nodes.values())), self.hogel_mpi, *arguments, "--threads", "1"]
        return subprocess.Popen(command, cwd=self.folder, env=ENVIRONMENT, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)

    def processes(self, node):
        listed = subprocess.run(["ip", "netns", "pids", node], capture_output=True, text=True, env=ENVIRONMENT)
        return [int(word) for word in listed.stdout.split()]

    # A machine that is switched off goes silent; one whose processes are killed still says that their connections end.
    def lose(self, node, silently):
        if silently:
            self.silent.touch()
            system("ip", "link", "set", node, "down")
        for process in self.processes(node):
            try:
                os.kill(process, signal.SIGKILL)
            except ProcessLookupError:
                pass

    def restore(self, node):
        self.silent.unlink(missing_ok=True)
        system("ip", "link", "set", node, "up")


def same(cluster):
    cluster.alone("render", "pumpkin", *SIZE, "--depth", "-o", "rays.h5")
    cluster.alone("hologram", "rays.h5", "--wavelength", "rgb", "-o", "hologram.h5")
    cluster.alone("render", "pumpkin", *SIZE[:-2], "--size", "4.608mm", "--fov", "2.5deg", "-o", "narrow.h5")
    cluster.alone("hologram", "narrow.h5", "--wavelength", "rgb", "--pitch", "8um", "-o", "colours.h5")
    camera = "--resolution 60 --eye 0,0,200mm --pupil 5mm".split()
    for name, command in {
        "render.h5": ["render", "pumpkin", *SIZE],
        "waves.h5": ["hologram", "rays.h5", "--wavelength", "rgb", "--half"],
        "packed.hgl": ["compress", "rays.h5", "--sqnr", "30", "--tile", "4x4"],
        "rays.exr": ["photo", "rays.h5", *camera, "--pupil-samples", "16"],
        "eye.exr": ["photo", "rays.h5", *camera, "--wave", "--looks", "9", "--camera", "eye"],
        "narrow.exr": ["photo", "hologram.h5", *camera],
        "full.exr": ["photo", "hologram.h5", *camera, "--camera", "full"],
        "near.h5": ["propagate", "hologram.h5", "--distance", "3mm"],
        "gradient.png": ["slm", "colours.h5", "--pixels", "600x500", "--pixel-pitch", "8um", "--encoding", "gradient", "--iterations", "3"],
    }.items():
        cluster.alone(*command, "-o", name)
        whole = cluster.bytes(name)
        for on_nodes in (dict.fromkeys(NODES, 1), {"node1": 1, "node2": 2}):
            (cluster.folder / name).unlink()
            status, _, error = cluster.ranks(on_nodes, *command, "-o", name)
            require(status == 0, name, on_nodes, "ended with", status, error)
            require(cluster.bytes(name) == whole, name, "of", on_nodes, "has other bytes")


# A node is lost while ranks of it compute: the job ends, mpirun names the node, what is done is kept, nothing goes on
# anywhere, and the same command completes the file on the nodes that are left.
def lost(cluster):
    cluster.alone("render", "pumpkin", "--hogels", "64x64", "--directions", "48x48", "--size", "8mm", "-o", "a.h5")
    cluster.alone("render", "pumpkin", "--hogels", "128x128", "--directions", "48x48", "--size", "8mm", "-o", "b.h5")
    for command in (["hologram", "a.h5", "-o", "x.h5", "--pitch", "1um", "--seed", "3"], ["compress", "b.h5", "-o", "x.hgl", "--step", "0.002"]):
        made = cluster.folder / command[command.index("-o") + 1]
        kept = ranks.Kept(made)
        cluster.alone(*command, "--threads", "1")
        whole = made.read_bytes()
        for node, silently in (("node2", False), ("node2", True), ("node1", True)):
            made.unlink()
            process = cluster.start(dict.fromkeys(NODES, 2), *command, "--resume")
            require(ranks.wait_until(process, kept.has_results), made.name, "was complete before it had results")
            cluster.lose(node, silently)
            began = time.monotonic()
            _, error = process.communicate(timeout=ranks.PATIENCE)
            took = time.monotonic() - began
            how = f"{made.name}, {node} {'silent' if silently else 'killed'}"
            # mpirun names the node; MPI ends ranks that had messages for it, and those that it stops say what is kept.
            require(process.returncode != 0 and not made.exists(), how, "ended with", process.returncode, error)
            require(f"node {node}" in error or lines_of_hogel(error), how, "said", error)
            require(not silently or f"node {node}" in error, how, "said", error)
            require(kept.part.exists(), how, "has kept nothing")
            print(f"{how}: ended within {took:.1f} s: {lines_of_hogel(error)}", flush=True)
            cluster.restore(node)
            left = [each for other in NODES for each in cluster.processes(other)]
            require(not left, how, "left processes", left)
            rest = {other: 1 for other in NODES if other != node}
            status, _, error = cluster.ranks(rest, *command, "--resume")
            require(status == 0 and made.read_bytes() == whole, how, "was resumed with", status, error)
            require(not kept.part.exists(), how, "left", kept.part)


def inside(test, programs):
    with tempfile.TemporaryDirectory(prefix="hogel_nodes_") as folder:
        globals()[test](Cluster(*programs, pathlib.Path(folder)))


def main():
    arguments = sys.argv[1:]
    if arguments[0] == "--inside":
        return inside(arguments[1], [os.path.abspath(program) for program in arguments[2:5]])
    own = "unshare --net --mount --pid --fork --mount-proc --kill-child".split()
    if os.geteuid() != 0 or not all(shutil.which(program, path=PATH) for program in ("ip", "unshare", "mount")):
        print("needs root, ip and unshare")
        sys.exit(77)
    if subprocess.run([*own, "ip", "netns", "list"], env=ENVIRONMENT, capture_output=True).returncode != 0:
        print("this system has no namespaces for its root")
        sys.exit(77)
    sys.exit(subprocess.run([*own, sys.executable, __file__, "--inside", *arguments], env=ENVIRONMENT).returncode)


if __name__ == "__main__":
    main()
