# SPDX-License-Identifier: Apache-2.0
"""A WebSocket client of the standard library alone, and one that misbehaves where a test wants it to."""

import base64
import json
import os
import socket
import struct

TEXT, BINARY, CLOSE, PING, PONG = 1, 2, 8, 9, 10


class Closed(Exception):
    """The server has closed; code is None if it did without a close frame."""

    def __init__(self, code):
        super().__init__(f"closed with {code}")
        self.code = code


class Refused(Exception):
    """The server did not make it a WebSocket."""

    def __init__(self, status, body):
        super().__init__(f"{status}: {body}")
        self.status = status


class WebSocket:
    def __init__(self, port, protocols=("indurop.v1",), origin=None, path="/api/v1/stream", host=None, timeout=20):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=timeout)
        lines = [f"GET {path} HTTP/1.1", f"Host: {host or f'127.0.0.1:{port}'}", "Upgrade: websocket",
                 "Connection: Upgrade", "Sec-WebSocket-Version: 13",
                 "Sec-WebSocket-Key: " + base64.b64encode(os.urandom(16)).decode()]
        if protocols:
            lines.append("Sec-WebSocket-Protocol: " + ", ".join(protocols))
        if origin:
            lines.append("Origin: " + origin)
        self.socket.sendall(("\r\n".join(lines) + "\r\n\r\n").encode())
        self.file = self.socket.makefile("rb")
        status = int(self.file.readline().split()[1])
        length = 0
        while (line := self.file.readline().strip()):
            if line.lower().startswith(b"content-length:"):
                length = int(line.split(b":")[1])
        if status != 101:
            raise Refused(status, self.file.read(length))

    def close(self):
        self.file.close()
        self.socket.close()

    def send_frame(self, opcode, data, mask=True, final=True, reserved=0):
        head = bytes([(0x80 if final else 0) | reserved << 4 | opcode])
        marked = 0x80 if mask else 0
        if len(data) < 126:
            head += bytes([marked | len(data)])
        elif len(data) < 65536:
            head += bytes([marked | 126]) + struct.pack(">H", len(data))
        else:
            head += bytes([marked | 127]) + struct.pack(">Q", len(data))
        if mask:
            key = os.urandom(4)
            data = key + bytes(byte ^ key[i % 4] for i, byte in enumerate(data))
        self.socket.sendall(head + data)

    def say(self, **word):
        self.send_frame(TEXT, json.dumps(word).encode())

    def frame(self):
        """The next data frame: (opcode, bytes). Pings are answered."""
        while True:
            head = self.file.read(2)
            if len(head) < 2:
                raise Closed(None)
            length = head[1] & 0x7F
            if length == 126:
                length = struct.unpack(">H", self.file.read(2))[0]
            elif length == 127:
                length = struct.unpack(">Q", self.file.read(8))[0]
            data = self.file.read(length)
            opcode = head[0] & 0x0F
            if opcode == PING:
                self.send_frame(PONG, data)
            elif opcode == CLOSE:
                raise Closed(struct.unpack(">H", data[:2])[0] if len(data) >= 2 else None)
            elif opcode != PONG:
                return opcode, data

    def heard(self, kind):
        """The next message of this type; others are passed over. Binary frames are of type "binary"."""
        while True:
            opcode, data = self.frame()
            if opcode == BINARY:
                if kind == "binary":
                    return data
                continue
            word = json.loads(data)
            if word["type"] == kind:
                return word
