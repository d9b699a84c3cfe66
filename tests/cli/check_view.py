#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks what `hogel view` serves, as a browser and as a stranger would ask: the page, pictures that equal those of
`hogel photo`, the WebSocket, and what must be refused or survived.

usage: check_view.py X.h5 H.h5 X.hgl     in a folder with that light field, 24x20 hogels of a sphere with depth, its hologram,
                                         and what it is compressed to; hogel in the PATH
"""
import json
import os
import pathlib
import resource
import signal
import struct
import subprocess
import sys

from view_client import VIEW, Server, WebSocket, expect, next_state
from view_strangers import check_drops, check_gone, check_refusals, check_token

INPUT, HOLOGRAM, STREAM = sys.argv[1:]


def pixels(file):
    """The numbers of an 8-bit PNG file."""
    name = pathlib.Path("pixels.png")
    name.write_bytes(file)
    done = subprocess.run(["hogel", "compare", "photo.png", "pixels.png", "--json"], capture_output=True, text=True)
    return json.loads(done.stdout)


def check_pages(server, state):
    status, headers, page = server.get("/")
    expect(status == 200 and b"<!doctype html>" in page, "the page")
    expect("default-src 'none'" in headers["Content-Security-Policy"], "the page's policy")
    expect(b"http://" not in page and b"https://" not in page, "the page names another server")
    for name in ("main.js", "view.js", "link.js", "stage.js", "keys.js", "inside.js", "finder.js", "scene.js", "drop.js", "levels.js", "marks.js", "style.css", "icon.svg"):
        expect(server.get("/" + name)[0] == 200, name)
    expect((state["hogels_s"], state["hogels_t"], state["directions_u"], state["depth"]) == (24, 20, 16, True), "state")


def check_pictures(server, state):
    options = " ".join(f"--{word.replace('=', ' ', 1)}" for word in VIEW.split("&"))
    for more, path in (("", ""), ("--display log", "&display=log"), ("--exposure 0.4", "&exposure=0.4")):
        exposure = "" if "exposure" in more else f"--exposure {state['exposure']!r}"
        subprocess.run(f"{state['photo']} -q -o photo.png --geometric {options} {more} {exposure}", shell=True, check=True)
        status, headers, file = server.get(f"/picture?{VIEW}{path}&format=png")
        expect(status == 200 and headers["Content-Type"] == "image/png", f"picture {path}: {status} {file[:200]}")
        expect(pixels(file)["max_error"] == 0, f"picture {path} is not that of hogel photo")
    status, headers, file = server.get(f"/picture?{VIEW}&quality=95")
    expect(headers["Content-Type"] == "image/jpeg" and file[:3] == b"\xff\xd8\xff", "a JPEG picture")


def check_waves(server, state):
    """Looks add up to what hogel photo --wave takes, and the newest view stops them."""
    small = "eye=5,-3,100mm&focus=2mm&pupil=3mm&resolution=40x32"
    options = " ".join(f"--{word.replace('=', ' ', 1)}" for word in small.split("&"))
    page = WebSocket(server)
    page.send(f"picture?{small}&by=waves&looks=3&format=png&id=w")
    pictures = [page.until("picture")]
    while pictures[-1]["looks"] < 3:
        pictures.append(page.until("picture"))
    expect(all(each["of_looks"] == 3 for each in pictures), "the number of looks")
    subprocess.run(f"{state['photo']} -q -o photo.png --wave --looks 3 {options} --exposure {state['exposure']!r}", shell=True,
                   check=True)
    expect(pixels(pictures[-1]["file"])["max_error"] == 0, "the mean of three looks is not that of hogel photo")
    expect(pictures[-1]["file"] == server.get(f"/picture?{small}&by=waves&looks=3&format=png")[2], "waves by both ways")
    both = server.get(f"/picture?{small}&by=side&looks=1&format=png")[2]
    expect(struct.unpack(">II", both[16:24]) == (80, 32), "side by side")
    page.send(f"picture?{small}&by=difference&looks=1&id=d")
    while (told := page.until("picture"))["id"] != "d":
        pass
    expect(told["psnr"] > 3, f"rays beside waves: {told['psnr']} dB")
    page.send(f"picture?{small}&by=waves&looks=1000&id=long")
    page.send(f"picture?{small}&id=rays")
    while page.until("picture")["id"] != "rays":
        pass
    status, headers, file = server.get(f"/picture?{small}&format=exr")
    expect(status == 200 and file[:4] == b"\x76\x2f\x31\x01", "an EXR picture")
    expect(server.get(f"/picture?{small}&by=difference&eyes=63mm")[0] == 400, "a difference of two eyes")


def check_insides(server):
    there = f"{VIEW}&x=0.4&y=0.6"
    for what in ("hogel", "views", "s-u", "t-v", "depth", "coverage"):
        status, headers, file = server.get(f"/inside?{there}&what={what}&side=200")
        expect(status == 200 and file[1:4] == b"PNG", f"inside {what}: {status} {file[:200]}")
    expect(struct.unpack(">II", server.get(f"/inside?{there}&what=s-u")[2][16:24]) == (24, 16), "24 hogels, 16 directions")
    for query in ("what=hogel", f"{there}&what=rate", f"{there}&what=phase", f"{there}&what=", f"{there}&what=hogel&side=5000", f"{there}&what=hogel&colour=4"):
        expect(server.get("/inside?" + query)[0] == 400, query)
    expect(server.get("/sharpness?")[0] == 400, "the depths of a light field")


def check_hologram():
    server = Server(input=HOLOGRAM)
    state = server.wait()
    expect(state["kind"] == "hologram" and not state["rays"] and 0 < state["efficiency"] < 1, f"state {state}")
    subprocess.run(f"{state['photo']} -q -o photo.png --eye 1,0,100mm --resolution 40x33 --exposure 1", shell=True, check=True)
    file = server.get("/picture?eye=1,0,100mm&resolution=40x33&exposure=1&by=waves&format=png")[2]
    expect(pixels(file)["max_error"] == 0, "a picture of the hologram is not that of hogel photo")
    expect(server.get("/picture?eye=1,0,100mm")[0] == 400, "a hologram by rays")
    for what in ("intensity", "phase", "real", "spectrum"):
        file = server.get(f"/inside?eye=1,0,100mm&x=0.5&y=0.5&side=64&colour=2&what={what}")[2]
        expect(struct.unpack(">II", file[16:24]) == (64, 64), f"inside {what}")
    levels = json.loads(server.get("/levels?encoding=double-phase")[2])
    expect(sum(levels["counts"]) == levels["width"] * levels["height"] and 0 < levels["efficiency"] < 1, f"levels {levels}")
    expect(server.get("/levels?encoding=sound")[0] == 400, "an encoding that is none")
    reading = json.loads(server.get("/reading?eye=1,0,100mm&x=0.5&y=0.5")[2])
    expect(reading["inside"] and -180 <= reading["phase_deg"] <= 180, f"reading {reading}")
    server.stop(signal.SIGTERM)


def check_readings(server):
    reading = json.loads(server.get(f"/reading?eye=0,0,100mm&resolution=90x75&x=0.5&y=0.5")[2])
    expect(reading["inside"] and abs(reading["x_m"]) < 1e-9 and abs(reading["across_deg"]) < 1e-6, f"reading {reading}")
    expect("depth_m" in reading and len(reading["radiance"]) == 3, f"the sphere in the middle: {reading}")
    left = json.loads(server.get(f"/reading?eye=0,0,100mm&resolution=90x75&x=0&y=0")[2])
    expect(abs(left["x_m"] + 0.003) < 1e-9 and left["y_m"] > 0 and left["across_deg"] < 0, f"reading {left}")


def check_web_socket(server):
    page = WebSocket(server)
    expect(page.status == 101 and page.receive()["type"] == "state", "the state comes first")
    page.send(f"picture?{VIEW}&format=png&id=7")
    picture = page.until("picture")
    expect(picture["id"] == "7" and picture["width"] == 90, "a picture")
    expect(picture["file"] == server.get(f"/picture?{VIEW}&format=png")[2], "by both ways the same picture")
    for message in ("", "picture", "picture?eye=1", "dance?", "picture?" + "%" * 50, "\x00" * 20, "focus?x=2&y=0", "reading?"):
        page.send(message)
        if message != "picture":
            expect(page.until("error")["message"], f"{message!r}")
    page.send(f"picture?{VIEW}&by=original&id=refused")
    refused = page.until("error")
    expect((refused["id"], refused["parameter"]) == ("refused", ["by"]), f"a picture that is refused: {refused}")
    page.send(os.urandom(50), opcode=2)  # no text: nothing is said
    page.send(f"picture?{VIEW}&id=8")
    while page.until("picture")["id"] != "8":
        pass
    large = WebSocket(server)
    large.send("picture?" + "a" * 5000)
    try:
        while large.receive()["type"] == "state":
            pass
        sys.exit("wrong: a message of 5000 bytes is answered")
    except (EOFError, OSError):
        pass


def check_newest_wins(server):
    page = WebSocket(server)
    big = "eye=0,0,100mm&resolution=1500x1250&pupil-samples=256"
    # In one piece, so that all are there before a picture can be made.
    page.send(*(f"picture?{big}&id={i}" for i in range(40)), f"picture?{VIEW}&id=last")
    ids = []
    while not ids or ids[-1] != "last":
        ids.append(page.until("picture")["id"])
    expect(len(ids) < 20, f"pictures that nobody wants were made: {ids}")


def check_focus(server):
    page = WebSocket(server)
    where = "eye=0,0,100mm&pupil=3mm&resolution=90x75"
    reading = json.loads(server.get(f"/reading?{where}&x=0.5&y=0.5")[2])
    page.send(f"focus?{where}&x=0.5&y=0.5")
    expect(page.until("focus")["depth_m"] == reading["depth_m"], "the depth of what was clicked")


def check_scene():
    """A scene changes as the command line would change it; the commands that are shown make the same."""
    server = Server("--hogels", "24x20", "--directions", "16", "--size", "6mm", "--wavelength", "633nm", input="sphere")
    server.wait()
    page = WebSocket(server)
    before = page.until("state")
    expect(not before["scene"]["is_file"] and before["scene"]["make"].startswith("hogel hologram sphere --wavelength 633nm --hogels 24x20"), f"{before['scene']}")
    page.send("change?rotate=0,30,0deg&light=1,0.5,1:white:3&hogels=30x25&fov=20deg")
    state = next_state(page, lambda each: each["ready"] and each["hogels_s"] == 30 and not each["work"])
    expect((state["hogels_t"], state["scene"]["rotate_deg"], state["scene"]["lights"]) == (25, [0, 30, 0], ["1,0.5,1:white:3"]), f"{state['scene']}")
    expect(state["exposure"] == before["exposure"], "the exposure changes with the light")
    subprocess.run(f"{state['photo']} -q -o photo.png --geometric --eye 5,-3,100mm --resolution 60 --pupil-samples 16 --exposure 1", shell=True, check=True)
    file = server.get("/picture?eye=5,-3,100mm&resolution=60&pupil-samples=16&exposure=1&format=png")[2]
    expect(pixels(file)["max_error"] == 0, "the changed scene is not that of hogel photo")
    # Another pitch keeps the light field; what aliases is told with the number that would do, and that does.
    page.send("change?pitch=4um")
    state = next_state(page, lambda each: each["generation"] > state["generation"])
    advice = {each["option"]: each for each in state["scene"]["advice"]}
    expect(advice["pitch"]["refused"] and "would do" in advice["pitch"]["text"], f"{advice}")
    status, headers, answer = server.get("/picture?eye=0,0,100mm&resolution=20&by=waves&looks=1")
    expect(status == 400 and "pitch" in json.loads(answer)["parameter"], f"a pitch that aliases: {answer}")
    page.send(f"change?pitch={advice['pitch']['enough'] * 1e6}um")
    state = next_state(page, lambda each: each["generation"] > state["generation"])
    expect("pitch" not in [told["option"] for told in state["scene"]["advice"]], f"{state['scene']}")
    expect(server.get("/picture?eye=0,0,100mm&resolution=20&by=waves&looks=1")[0] == 200, "the pitch that would do")
    done = subprocess.run(f"{state['scene']['make']} -q", shell=True, capture_output=True, text=True)
    expect(done.returncode == 0 and pathlib.Path("hologram.h5").exists(), f"{state['scene']['make']}: {done.stderr}")
    for change in ("hogels=0", "hogels=x", "threads=7", "rotate=1", "front=2", "hogels=100000"):
        page.send(f"change?{change}")
        problem = page.until("problem")
        expect(problem["message"] and change.split("=")[0] in problem["parameter"], f"{change}: {problem}")
    page.send("change?hogels=&light=&rotate=&fov=")
    state = next_state(page, lambda each: each["hogels_s"] == 24 and not each["work"])
    expect("rotate" not in state["scene"]["make"] and state["scene"]["lights"] == [], "as it was")
    made = Server("--hogels", "20", "--directions", "16", "--size", "4mm", input="sphere")
    make = made.wait()["scene"]["make"]
    made.stop(signal.SIGTERM)
    done = subprocess.run(f"{make} --resolution 8 --looks 1 --force -q", shell=True, capture_output=True, text=True)
    expect(done.returncode == 0 and pathlib.Path("made/report.json").exists(), f"{make}: {done.stderr}")
    # The newest of many changes is what stays.
    for i in range(60):
        page.send(f"change?hogels={20 + i}&moving=yes")
    page.send("change?hogels=33")
    next_state(page, lambda each: each["hogels_s"] == 33 and each["shown_hogels_s"] == 33 and not each["work"])
    server.stop(signal.SIGTERM)


def check_stream():
    """Layers of a compressed light field, beside what it was made of."""
    server = Server("--original", INPUT, input=STREAM)
    server.wait()
    page = WebSocket(server)
    state = next_state(page, lambda each: "sqnr_db" in each.get("stream", {}))
    all_layers = state["stream"]["of_layers"]
    expect(state["stream"]["layers"] == all_layers > 2 and state["has_original"] and state["hogel_bytes"][0] > 0, f"{state['stream']}")
    told = json.loads(subprocess.run(["hogel", "compare", INPUT, STREAM, "--json"], capture_output=True, text=True).stdout)
    expect(abs(told["sqnr"] - state["stream"]["sqnr_db"]) < 1e-6, f"SQNR {state['stream']} beside {told}")
    there = f"{VIEW}&format=png&exposure=1"
    subprocess.run(f"{state['photo_original']} -q -o photo.png --geometric --eye 5,-3,100mm --focus 2mm --pupil 3mm --resolution 90x70 --pupil-samples 16 --exposure 1",
                   shell=True, check=True)
    expect(pixels(server.get(f"/picture?{there}&by=original")[2])["max_error"] == 0, "the original")
    errors = [server.get(f"/picture?{there}&by=error")[2]]
    expect(server.get(f"/inside?{there}&x=0.5&y=0.5&what=rate")[0] == 200, "rates")
    expect(json.loads(server.get(f"/reading?{VIEW}&x=0.5&y=0.5")[2])["hogel_bytes"] > 0, "the bytes of a hogel")
    sqnr = state["stream"]["sqnr_db"]
    for layers in range(all_layers - 1, 0, -1):
        page.send(f"change?layers={layers}")
        state = next_state(page, lambda each: each["stream"]["layers"] == layers and "sqnr_db" in each["stream"])
        expect(state["stream"]["sqnr_db"] < sqnr, f"layer {layers}: {state['stream']['sqnr_db']} dB, one more {sqnr} dB")
        sqnr = state["stream"]["sqnr_db"]
    expect(server.get(f"/picture?{there}&by=error")[2] not in errors, "the error of one layer")
    subprocess.run(state["photo"].replace("decompress", "decompress -q") + " -q -o photo.png --geometric --eye 5,-3,100mm --focus 2mm --pupil 3mm --resolution 90x70 --pupil-samples 16 --exposure 1",
                   shell=True, check=True)
    # hogel decompress writes halves.
    expect((pixels(server.get(f"/picture?{there}")[2])["psnr"] or 99) > 50, "one layer is not that of hogel decompress")
    page.send(f"change?layers={all_layers + 1}")
    expect("layers" in page.until("problem")["message"], "more layers than there are")
    server.stop(signal.SIGTERM)


def check_stop(server):
    """A signal ends the server, also while it makes a picture of more looks than a test has time for."""
    page = WebSocket(server)
    page.send("picture?eye=0,0,100mm&resolution=200x165&by=waves&looks=1000")
    looks = page.until("picture")["looks"]
    for number, running in ((signal.SIGINT, server), (signal.SIGTERM, Server(input=INPUT)), (signal.SIGHUP, Server(input=INPUT))):
        status, words = running.stop(number)
        expect(status == 128 + number and words == "hogel: stopped\n", f"stop: {status} {words}")
    try:
        while True:
            looks = page.until("picture")["looks"]
    except (EOFError, OSError):
        expect(looks < 1000, "all looks come")


def main():
    most = resource.getrlimit(resource.RLIMIT_NOFILE)[1]
    resource.setrlimit(resource.RLIMIT_NOFILE, (min(4096, most) if most > 0 else 4096, most))
    server = Server(input=INPUT)
    expect(server.address == f"http://127.0.0.1:{server.port}/", server.address)
    state = server.wait()
    check_pages(server, state)
    check_pictures(server, state)
    check_waves(server, state)
    check_insides(server)
    check_hologram()
    check_readings(server)
    check_refusals(server)
    check_gone(server)
    check_web_socket(server)
    check_newest_wins(server)
    check_focus(server)
    check_drops(INPUT)
    check_scene()
    check_stream()
    check_token(INPUT)
    check_stop(server)
    print("address, page, state, pictures, waves, insides, hologram, readings, refusals, askers that are gone, web socket, newest wins, depth in focus, dropped files, scene, layers, stop")


if __name__ == "__main__":
    main()
