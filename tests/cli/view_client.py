# SPDX-License-Identifier: Apache-2.0
"""`hogel view` as a process, and the page's side of its HTTP and WebSocket."""
import base64
import hashlib
import http.client
import json
import os
import socket
import struct
import subprocess
import sys
import time

# After so many seconds a test that waits for an answer fails: a hang, whatever the machine.
PATIENCE = 120

VIEW = "eye=5,-3,100mm&focus=2mm&pupil=3mm&resolution=90x70&pupil-samples=16"


class Server:
    def __init__(self, *options, input):
        self.process = subprocess.Popen(["hogel", "view", input, "--no-browser", *options], stdout=subprocess.PIPE,
                                        stderr=subprocess.PIPE, text=True)
        self.address = self.process.stdout.readline().strip()
        self.port = int(self.address.split(":")[2].split("/")[0])
        self.host = f"127.0.0.1:{self.port}"

    def get(self, path, method="GET", body=None, **headers):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=PATIENCE)
        connection.request(method, path, body, {"Host": self.host, **{k.replace("_", "-"): v for k, v in headers.items()}})
        answer = connection.getresponse()
        return answer.status, dict(answer.getheaders()), answer.read()

    def wait(self):
        for _ in range(10 * PATIENCE):
            state = json.loads(self.get("/state")[2])
            if state["ready"] and not state["work"]:
                return state
            time.sleep(0.1)
        sys.exit("the light field does not come")

    def raw(self, text, timeout=5):
        """What comes back for any bytes, until the server closes or is silent."""
        with socket.create_connection(("127.0.0.1", self.port), timeout=timeout) as connection:
            connection.sendall(text)
            got = b""
            try:
                while part := connection.recv(65536):
                    got += part
            except OSError:
                pass
            return got

    def stop(self, number):
        """Its exit status, and what it has said."""
        self.process.send_signal(number)
        words = self.process.communicate(timeout=PATIENCE)[1]
        return self.process.returncode, words


class WebSocket:
    """The other end by RFC 6455, in as few lines as it takes."""

    def __init__(self, server, path="/live", **headers):
        self.socket = socket.create_connection(("127.0.0.1", server.port), timeout=PATIENCE)
        key = base64.b64encode(os.urandom(16)).decode()
        fields = {"Host": server.host, "Origin": f"http://{server.host}", "Upgrade": "websocket", "Connection": "Upgrade",
                  "Sec-WebSocket-Key": key, "Sec-WebSocket-Version": "13", **headers}
        lines = "".join(f"{name}: {value}\r\n" for name, value in fields.items() if value is not None)
        self.socket.sendall(f"GET {path} HTTP/1.1\r\n{lines}\r\n".encode())
        head = b""
        while b"\r\n\r\n" not in head:
            part = self.socket.recv(1)
            if not part:
                break
            head += part
        self.status = int(head.split()[1])
        if self.status == 101:
            accept = base64.b64encode(hashlib.sha1((key + "258EAFA5-E914-47DA-95CA-C5AB0DC85B11").encode()).digest())
            assert accept in head

    @staticmethod
    def frame(text, opcode):
        data, mask = text.encode() if isinstance(text, str) else text, os.urandom(4)
        length = bytes([0x80 | len(data)]) if len(data) < 126 else struct.pack(">BH", 0xFE, len(data))
        return bytes([0x80 | opcode]) + length + mask + bytes(b ^ mask[i % 4] for i, b in enumerate(data))

    def send(self, *texts, opcode=1):
        """All at once."""
        self.socket.sendall(b"".join(self.frame(text, opcode) for text in texts))

    def exactly(self, count):
        data = b""
        while len(data) < count:
            part = self.socket.recv(count - len(data))
            if not part:
                raise EOFError
            data += part
        return data

    def receive(self):
        """The next message: a dict of a text, or of a picture with its bytes under `file`."""
        whole, kind = b"", 0
        while True:
            first, second = self.exactly(2)
            length = second & 127
            if length > 125:
                length = struct.unpack(">H" if length == 126 else ">Q", self.exactly(2 if length == 126 else 8))[0]
            data = self.exactly(length)
            if first & 15 == 8:
                raise EOFError
            if first & 15 > 8:
                continue
            whole, kind = whole + data, kind or first & 15
            if first & 128:
                break
        if kind == 1:
            return json.loads(whole)
        head, file = whole.split(b"\n", 1)
        return json.loads(head) | {"file": file}

    def until(self, kind):
        while (message := self.receive())["type"] != kind:
            pass
        return message


def expect(truth, what):
    if not truth:
        sys.exit(f"wrong: {what}")


def next_state(page, test):
    while not test(state := page.until("state")):
        pass
    return state
