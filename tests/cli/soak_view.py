#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Drags in `hogel view` for long, half of the time in a light field by rays and by waves, with looks inside and pages that come
and go, half of it a scene that turns, and watches the memory of the server, which must stay what it was after the first quarter.

usage: soak_view.py HOGEL SECONDS
"""
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time

from view_client import Server, WebSocket


def memory(process):
    """Resident bytes of a process."""
    return int(pathlib.Path(f"/proc/{process.pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGESIZE")


class Watch:
    """The memory of a server for some seconds, in the first quarter of which it may grow."""

    def __init__(self, server, seconds):
        self.server, self.seconds, self.began = server, seconds, time.monotonic()
        self.rounds, self.early, self.late = 0, 0, 0

    def goes_on(self):
        passed = time.monotonic() - self.began
        if self.rounds and passed < self.seconds / 4:
            self.early = max(self.early, memory(self.server.process))
        elif self.rounds:
            self.late = max(self.late, memory(self.server.process))
        self.rounds += 1
        return passed < self.seconds

    def end(self, what):
        self.server.process.terminate()
        self.server.process.wait()
        text = f"{self.rounds} {what} in {self.seconds:.0f} s: {self.early / 1e6:.0f} MB in the first quarter, {self.late / 1e6:.0f} MB at most later"
        if self.late > 1.1 * self.early + 20e6:
            sys.exit(f"memory grows: {text}")
        print(text)


def drag_eye(seconds):
    subprocess.run(["hogel", "render", "pumpkin", "-o", "soak.h5", "--hogels", "64", "--directions", "16", "--size", "6mm", "--depth", "-q"], check=True)
    server = Server("--looks", "2", "--wavelength", "532nm", "--memory", "0.5", input="soak.h5")
    server.wait()
    page, watch = WebSocket(server), Watch(server, seconds)
    while watch.goes_on():
        rounds = watch.rounds
        x, y = 15 * math.cos(0.3 * rounds), 10 * math.sin(0.2 * rounds)
        by = "waves&looks=1" if rounds % 8 == 7 else "side&looks=2" if rounds % 16 == 0 else "rays"
        size = 128 + 16 * (rounds % 7)
        view = f"eye={x:.3f},{y:.3f},{250 + rounds % 90}mm&focus={rounds % 5 - 2}mm&resolution={size}x{size}"
        # Views that are overtaken, and one that is waited for.
        for i in range(3):
            page.send(f"picture?{view}&by={by}&pupil-samples=4&moving=yes&id={rounds}")
        page.send(f"reading?{view}&x=0.5&y=0.5")
        while page.until("picture")["id"] != str(rounds):
            pass
        if rounds % 10 == 0:
            server.get(f"/inside?{view}&x=0.4&y=0.5&what={('hogel', 's-u', 't-v', 'views', 'coverage')[rounds // 10 % 5]}")
        if rounds % 50 == 0:
            page.socket.close()
            page = WebSocket(server)
    watch.end("views")


def drag_scene(seconds):
    """Turns a scene, which rests now and then so that all of its hogels come."""
    server = Server("--hogels", "100", "--directions", "16", "--looks", "2", "--memory", "0.5", input="pumpkin")
    server.wait()
    page, watch = WebSocket(server), Watch(server, seconds)
    view, shown = "eye=5,0,300mm&resolution=200x200&pupil-samples=4", page.until("state")["generation"]
    while watch.goes_on():
        rounds = watch.rounds
        moving = "&moving=yes" if rounds % 10 else ""
        change = f"hogels={90 + rounds % 20}" if rounds % 30 == 0 else f"light=1,{rounds % 7},3" if rounds % 3 == 0 else f"rotate=0,{rounds % 180},{rounds % 11}deg"
        page.send(f"change?{change}{moving}")
        while (state := page.until("state"))["generation"] == shown or (not moving and state["work"]):
            pass
        shown = state["generation"]
        page.send(f"picture?{view}&id={rounds}")
        while page.until("picture")["id"] != str(rounds):
            pass
    watch.end("changes of a scene")


def main():
    hogel, seconds = pathlib.Path(sys.argv[1]).resolve(), float(sys.argv[2])
    os.environ["PATH"] = f"{hogel.parent}:{os.environ['PATH']}"
    os.chdir(tempfile.mkdtemp(prefix="hogel-soak-"))
    drag_eye(seconds / 2)
    drag_scene(seconds / 2)


main()
