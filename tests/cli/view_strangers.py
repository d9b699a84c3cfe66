# SPDX-License-Identifier: Apache-2.0
"""What `hogel view` must refuse or survive: other hosts and origins, paths, malformed and large requests, idle connections, files."""
import json
import os
import pathlib
import signal
import socket

from view_client import PATIENCE, VIEW, Server, WebSocket, expect, next_state


def check_refusals(server):
    picture = f"/picture?{VIEW}"
    for headers in ({"Host": "evil.example"}, {"Host": f"evil.example:{server.port}"}, {"Origin": "http://evil.example"},
                    {"Origin": "null"}, {"Sec_Fetch_Site": "cross-site"}, {"Sec_Fetch_Site": "same-site"}):
        status, back, body = server.get(picture, **headers)
        expect(status == 403 and b"JFIF" not in body, f"{headers}: {status}")
        expect("Access-Control-Allow-Origin" not in back, "others may read")
        expect(server.get("/state", **headers)[0] == 403, f"state {headers}")
        socket_headers = {name.replace("_", "-"): value for name, value in headers.items()}
        expect(WebSocket(server, **socket_headers).status == 403, f"web socket {headers}")
    for path in ("/../../etc/passwd", "/..%2f..%2fetc/passwd", "//etc/passwd", "/web/main.js", "/main.js/", "/.", "/x.h5"):
        expect(server.get(path)[0] == 404, path)
    for query in ("eye=0,0,-1mm", "eye=x", "focus=-1m", "resolution=99999", "resolution=4000x4000", "pupil-samples=0", "format=gif", "word=1", "by=sound", "id=%00"):
        expect(server.get("/picture?" + query)[0] == 400, query)
    for method in ("POST", "PUT", "DELETE", "OPTIONS", "HEAD", "TRACE"):
        expect(server.get("/", method=method)[0] == 405, method)
    expect(server.get("/", method="POST", body="x" * 100)[0] == 405, "a body")
    expect(server.get("/", method="PUT", body="x" * 100)[0] == 400, "a body of another kind")
    expect(server.get("/picture?" + "a" * 3000)[0] == 400, "a long query")
    for text in (b"\0" * 100, b"GET / HTTP/9.9\r\n\r\n", b"\x16\x03\x01" + os.urandom(200), b"GET / HTTP/1.1\r\n" + b"a: b\r\n" * 9000,
                 b"GET /" + b"a" * 70000 + b" HTTP/1.1\r\n\r\n", b"GET / HTTP/1.1\r\nHost: a\r\nContent-Length: 99999999999\r\n\r\n"):
        expect(not server.raw(text).startswith(b"HTTP/1.1 200"), f"{text[:30]!r}")
    # Connections that say nothing: more than there may be, and the page still comes.
    idle = [socket.create_connection(("127.0.0.1", server.port), timeout=PATIENCE) for _ in range(1000)]
    for connection in idle[::2]:
        try:
            connection.sendall(b"GET / HTTP/1.1\r\nHo")
        except OSError:
            pass
    expect(server.get("/")[0] == 200, "the page beside 1,000 idle connections")
    for connection in idle:
        connection.close()
    expect(server.get("/")[0] == 200, "the page after 1,000 idle connections")


def check_drops(light_field):
    """Files from the page are opened; what is broken, too large or from elsewhere is not, and what was there stays."""
    server = Server("--hogels", "40", "--directions", "16", input=light_field)
    own = {"Origin": f"http://{server.host}"}
    page = WebSocket(server)
    mesh = b"ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n" \
           b"property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
    for headers in ({}, {"Origin": "http://evil.example"}, {"Origin": "null"}, own | {"Sec_Fetch_Site": "cross-site"}, own | {"Host": "evil.example"}):
        expect(server.get("/drop?name=a.ply", "POST", mesh, **headers)[0] == 403, f"a file of {headers}")
    for name in ("", "..", "../a.ply", "/etc/passwd", "a/b.ply", ".ply", "-o", "a" * 200, "%00"):
        expect(server.get(f"/drop?name={name}", "POST", mesh, **own)[0] == 400, f"a file named {name}")
    large = b"POST /drop?name=a.ply HTTP/1.1\r\nHost: %s\r\nOrigin: http://%s\r\nContent-Length: 99999999999\r\n\r\n" % (server.host.encode(), server.host.encode())
    expect(not server.raw(large, 2).startswith(b"HTTP/1.1 2"), "a file that is too large")
    before = json.loads(server.get("/state")[2])
    expect(server.get("/drop?name=bad.ply", "POST", b"ply\nformat ascii 1.0\n", **own)[0] == 200, "a broken file is taken")
    expect("bad.ply" in page.until("problem")["message"], "a broken file is not told")
    state = server.wait()  # also where the file came before the first input was shown, whose work goes on then
    expect(state["name"] == before["name"] and server.get(f"/picture?{VIEW}")[0] == 200, f"after a broken file: {state}")
    # Named like the value of an option, it is a file all the same, and so are those that follow.
    expect(server.get("/drop?name=40", "POST", pathlib.Path(light_field).read_bytes(), **own)[0] == 200, "a file named like a number of hogels")
    state = next_state(page, lambda each: each["name"] == "40" and each["hogels_s"] == 24 and not each["work"])
    expect(state["photo"] == "hogel photo 40 --hogels 40 --directions 16", f"{state['photo']}")
    expect(server.get("/drop?name=one%20mesh.ply", "POST", mesh, **own)[0] == 200, "a mesh")
    state = next_state(page, lambda each: each["name"] == "one mesh.ply" and each["ready"] and each.get("scene") and not each["work"])
    expect(state["scene"]["is_file"] and state["photo"] == "hogel photo 'one mesh.ply' --hogels 40 --directions 16", f"{state['photo']}")
    obj = b"mtllib o.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
    expect(server.get("/drop?name=o.mtl&more=yes", "POST", b"newmtl m\nKd 1 0 0\n", **own)[0] == 200, "a material")
    expect(server.get("/drop?name=o.obj", "POST", obj, **own)[0] == 200, "a mesh with a material")
    next_state(page, lambda each: each["name"] == "o.obj" and not each["work"])
    expect(server.get("/drop?name=x.h5", "POST", pathlib.Path(light_field).read_bytes(), **own)[0] == 200, "a light field")
    next_state(page, lambda each: each["name"] == "x.h5" and each["hogels_s"] == 24 and not each["work"])
    expect(server.get(f"/picture?{VIEW}")[0] == 200, "a picture of a light field that was dropped")
    server.stop(signal.SIGTERM)


def check_token(light_field):
    token = "abcdefghijklmnop-1"
    server = Server("--host", "0.0.0.0", "--token", token, input=light_field)
    expect(server.address.endswith(f"/?token={token}"), server.address)
    for path, status in (("/", 200), ("/state", 403), (f"/state?token={token}", 200), (f"/state?token={token}x", 403), ("/picture", 403)):
        expect(server.get(path)[0] == status, path)
    expect(server.get(f"/state?token={token}", Origin="http://evil.example")[0] == 403, "another page with the token")
    expect(WebSocket(server).status == 403 and WebSocket(server, f"/live?token={token}").status == 101, "web socket and token")
    # More strangers than there may be connections, who announce what they never send.
    for text in (b"GET / HTTP/1.1\r\nHost: a\r\nContent-Length: 10\r\n\r\n", b"POST /drop?name=a.ply HTTP/1.1\r\nHost: a\r\nContent-Length: 10\r\n\r\n"):
        strangers = [socket.create_connection(("127.0.0.1", server.port), timeout=PATIENCE) for _ in range(150)]
        for stranger in strangers:
            try:
                stranger.sendall(text)
            except OSError:
                pass
        expect(server.get(f"/state?token={token}")[0] == 200, f"the owner beside strangers who say {text[:30]}")
        for stranger in strangers:
            stranger.close()
    server.stop(signal.SIGTERM)


def check_gone(server):
    """Pictures whose askers are gone are not made: these would take minutes."""
    for path in ["/picture?eye=0,0,100mm&resolution=3800x2100&pupil-samples=1024"] * 60 + ["/picture?eye=0,0,100mm&by=waves&looks=1000&resolution=800"] * 60:
        with socket.create_connection(("127.0.0.1", server.port), timeout=PATIENCE) as connection:
            connection.sendall(f"GET {path} HTTP/1.1\r\nHost: {server.host}\r\n\r\n".encode())
    for by in ("rays", "waves"):
        expect(server.get(f"/picture?{VIEW}&looks=1&by={by}")[0] == 200, f"a picture by {by} after others that nobody waits for")
