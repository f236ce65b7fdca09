# SPDX-License-Identifier: Apache-2.0
"""A disk with a write cache whose power can be lost at any instant of its past: a server of the NBD protocol (fixed newstyle)
that logs what it is given. What was not flushed at an instant is in the cache only; at a loss of power, each sector of it is on
the disk or not, in any combination."""

import random
import socket
import struct
import threading
import time

SECTOR = 512
MAGIC, OPTION_MAGIC, REPLY_MAGIC = 0x4E42444D41474943, 0x49484156454F5054, 0x3E889045565A9
REQUEST_MAGIC, ANSWER_MAGIC = 0x25609513, 0x67446698
EXPORT_NAME, ABORT, INFO, GO = 1, 2, 6, 7
ACK, INFO_REPLY, UNSUPPORTED = 1, 3, 0x80000001
READ, WRITE, DISCONNECT, FLUSH = 0, 1, 2, 3
HAS_FLAGS, SENDS_FLUSH = 1, 4
INVALID = 22


class LoggedDisk:
    """`log` is what happened: (instant, offset, data) of a write, (instant, None, b"") of a flush. `instant` is time.monotonic()."""

    def __init__(self, path, image):
        """`path`: the socket. `image`: the bytes on the disk, a multiple of the sector."""
        self.content = bytearray(image)
        self.log = []
        self.lock = threading.Lock()
        self.server = socket.socket(socket.AF_UNIX)
        self.server.bind(path)
        self.server.listen()
        threading.Thread(target=self._serve, daemon=True).start()

    def close(self):
        self.server.shutdown(socket.SHUT_RDWR)
        self.server.close()

    def _write(self, offset, data):
        with self.lock:
            self.content[offset:offset + len(data)] = data
            self.log.append((time.monotonic(), offset, data))

    def _flush(self):
        with self.lock:
            self.log.append((time.monotonic(), None, b""))

    def _serve(self):
        while True:
            try:
                client, _ = self.server.accept()
            except OSError:  # closed
                return
            threading.Thread(target=self._attend, args=(client,), daemon=True).start()

    def _attend(self, client):
        with client:
            try:
                if self._shake_hands(client):
                    self._answer(client)
            except (ConnectionError, EOFError):
                pass

    @staticmethod
    def _receive(client, size):
        data = bytearray()
        while len(data) < size:
            piece = client.recv(min(size - len(data), 1 << 20))
            if not piece:
                raise EOFError
            data += piece
        return bytes(data)

    def _shake_hands(self, client):
        client.sendall(struct.pack(">QQH", MAGIC, OPTION_MAGIC, 1))
        self._receive(client, 4)
        flags = HAS_FLAGS | SENDS_FLUSH
        while True:
            _, option, size = struct.unpack(">QII", self._receive(client, 16))
            self._receive(client, size)

            def reply(kind, data=b"", option=option):
                client.sendall(struct.pack(">QIII", REPLY_MAGIC, option, kind, len(data)) + data)

            if option in (INFO, GO):
                reply(INFO_REPLY, struct.pack(">HQH", 0, len(self.content), flags))
                reply(ACK)
                if option == GO:
                    return True
            elif option == EXPORT_NAME:
                client.sendall(struct.pack(">QH", len(self.content), flags) + bytes(124))
                return True
            elif option == ABORT:
                reply(ACK)
                return False
            else:
                reply(UNSUPPORTED)

    def _answer(self, client):
        while True:
            magic, _, kind, handle, offset, size = struct.unpack(">IHHQQI", self._receive(client, 28))
            assert magic == REQUEST_MAGIC
            error, data = 0, b""
            if kind == READ:
                data = bytes(self.content[offset:offset + size])
            elif kind == WRITE:
                self._write(offset, self._receive(client, size))
            elif kind == FLUSH:
                self._flush()
            elif kind == DISCONNECT:
                return
            else:
                error = INVALID
            client.sendall(struct.pack(">IIQ", ANSWER_MAGIC, error, handle) + data)


class Past:
    """The disk at the instants of a log, in ascending order."""

    def __init__(self, image, log):
        self.safe = bytearray(image)
        self.cache = {}  # number of a sector -> its bytes
        self.log = log
        self.place = 0

    def go_to(self, place):
        """To just before the entry number `place` of the log."""
        for _, offset, data in self.log[self.place:place]:
            if offset is None:
                self._flush()
            else:
                for start in range(0, len(data), SECTOR):
                    self.cache[(offset + start) // SECTOR] = data[start:start + SECTOR]
        self.place = max(self.place, place)

    def _flush(self):
        for sector, data in self.cache.items():
            self.safe[sector * SECTOR:(sector + 1) * SECTOR] = data
        self.cache.clear()

    def cut(self, dice: random.Random):
        """What a loss of power leaves: the bytes on the disk, how many sectors were in the cache, and which of them reached it."""
        share = dice.choice((0, 1, dice.random()))
        kept = [sector for sector in sorted(self.cache) if dice.random() < share]
        left = bytearray(self.safe)
        for sector in kept:
            left[sector * SECTOR:(sector + 1) * SECTOR] = self.cache[sector]
        return left, len(self.cache), kept
