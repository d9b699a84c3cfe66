#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Drags in `hogel view` for long, by rays and by waves, with looks inside and pages that come and go, and watches the memory of
the server, which must stay what it was after the first quarter.

usage: soak_view.py HOGEL SECONDS
"""
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import time


def memory(process):
    """Resident bytes of a process."""
    return int(pathlib.Path(f"/proc/{process.pid}/statm").read_text().split()[1]) * os.sysconf("SC_PAGESIZE")


def main():
    hogel, seconds = pathlib.Path(sys.argv[1]).resolve(), float(sys.argv[2])
    os.environ["PATH"] = f"{hogel.parent}:{os.environ['PATH']}"
    os.chdir(tempfile.mkdtemp(prefix="hogel-soak-"))
    subprocess.run(["hogel", "render", "pumpkin", "-o", "soak.h5", "--hogels", "64", "--directions", "16", "--size", "6mm", "--depth", "-q"], check=True)
    import check_view
    server = check_view.Server("--looks", "2", "--wavelength", "532nm", "--memory", "0.5", input="soak.h5")
    server.wait()
    began = time.monotonic()
    page, rounds, early, late = check_view.WebSocket(server), 0, 0, 0
    while (passed := time.monotonic() - began) < seconds:
        rounds += 1
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
            server.get(f"/inside?{view}&x=0.4&y=0.5&what={('hogel', 's-u', 't-v', 'views')[rounds // 10 % 4]}")
        if rounds % 50 == 0:
            page.socket.close()
            page = check_view.WebSocket(server)
        if passed < seconds / 4:
            early = max(early, memory(server.process))
        else:
            late = max(late, memory(server.process))
    server.process.terminate()
    server.process.wait()
    text = f"{rounds} views in {seconds:.0f} s: {early / 1e6:.0f} MB in the first quarter, {late / 1e6:.0f} MB at most later"
    if late > 1.1 * early + 20e6:
        sys.exit(f"memory grows: {text}")
    print(text)


main()
