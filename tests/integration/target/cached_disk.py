# SPDX-License-Identifier: Apache-2.0
"""A disk with a write cache, which loses power: a server of the NBD protocol (fixed newstyle, one client at a time). What was
not flushed is in the cache only; at a loss of power each sector of it is on the disk or not, in any combination."""

import random
import socket
import struct
import threading

SECTOR = 512
MAGIC, OPTION_MAGIC, REPLY_MAGIC = 0x4E42444D41474943, 0x49484156454F5054, 0x3E889045565A9
REQUEST_MAGIC, ANSWER_MAGIC = 0x25609513, 0x67446698
EXPORT_NAME, ABORT, INFO, GO = 1, 2, 6, 7
ACK, INFO_REPLY, UNSUPPORTED = 1, 3, 0x80000001
READ, WRITE, DISCONNECT, FLUSH = 0, 1, 2, 3
HAS_FLAGS, SENDS_FLUSH, SENDS_FUA = 1, 4, 8
FUA = 1
INVALID = 22


class CachedDisk:
    def __init__(self, path, image):
        """`path`: the socket. `image`: the bytes on the disk, a multiple of the sector."""
        self.safe = bytearray(image)
        self.seen = bytearray(image)
        self.cache = set()  # sectors that are not on the disk
        self.flushes = 0
        self.server = socket.socket(socket.AF_UNIX)
        self.server.bind(path)
        self.server.listen()
        threading.Thread(target=self._serve, daemon=True).start()
        self.done = threading.Event()

    def cut(self, dice: random.Random):
        """The machine has lost power (its process has ended): returns how many sectors were in the cache and how many of them
        reached the disk."""
        self.done.wait()
        self.done.clear()
        share = dice.choice((0, 1, dice.random()))
        kept = [sector for sector in sorted(self.cache) if dice.random() < share]
        cached = len(self.cache)
        for sector in kept:
            self._save(sector)
        for sector in self.cache:
            place = slice(sector * SECTOR, (sector + 1) * SECTOR)
            self.seen[place] = self.safe[place]
        self.cache.clear()
        return cached, len(kept)

    def _save(self, sector):
        place = slice(sector * SECTOR, (sector + 1) * SECTOR)
        self.safe[place] = self.seen[place]

    def _serve(self):
        while True:
            client, _ = self.server.accept()
            try:
                if self._shake_hands(client):
                    self._answer(client)
            except (ConnectionError, EOFError):
                pass
            client.close()
            self.done.set()

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
        flags = HAS_FLAGS | SENDS_FLUSH | SENDS_FUA
        while True:
            _, option, size = struct.unpack(">QII", self._receive(client, 16))
            self._receive(client, size)

            def reply(kind, data=b"", option=option):
                client.sendall(struct.pack(">QIII", REPLY_MAGIC, option, kind, len(data)) + data)

            if option in (INFO, GO):
                reply(INFO_REPLY, struct.pack(">HQH", 0, len(self.seen), flags))
                reply(ACK)
                if option == GO:
                    return True
            elif option == EXPORT_NAME:
                client.sendall(struct.pack(">QH", len(self.seen), flags) + bytes(124))
                return True
            elif option == ABORT:
                reply(ACK)
                return False
            else:
                reply(UNSUPPORTED)

    def _answer(self, client):
        while True:
            magic, flags, kind, handle, offset, size = struct.unpack(">IHHQQI", self._receive(client, 28))
            assert magic == REQUEST_MAGIC
            error, data = 0, b""
            if kind == READ:
                data = bytes(self.seen[offset:offset + size])
            elif kind == WRITE:
                self.seen[offset:offset + size] = self._receive(client, size)
                sectors = range(offset // SECTOR, (offset + size + SECTOR - 1) // SECTOR)
                self.cache.update(sectors)
                if flags & FUA:
                    for sector in sectors:
                        self._save(sector)
                    self.cache.difference_update(sectors)
            elif kind == FLUSH:
                for sector in self.cache:
                    self._save(sector)
                self.cache.clear()
                self.flushes += 1
            elif kind == DISCONNECT:
                return
            else:
                error = INVALID
            client.sendall(struct.pack(">IIQ", ANSWER_MAGIC, error, handle) + data)
