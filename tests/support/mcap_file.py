# SPDX-License-Identifier: Apache-2.0
"""Reads a closed MCAP file (https://mcap.dev/spec) by its indexes, with nothing of ours: chunks with the offsets of each
channel's messages, the records of runs of indurop/runs, and metadata records."""

import ctypes
import struct

SCHEMA, CHANNEL, CHUNK_INDEX, METADATA_INDEX = 3, 4, 8, 13


class McapFile:
    def __init__(self, path):
        self.bytes = path.read_bytes()
        footer = len(self.bytes) - 8 - 20
        summary = struct.unpack_from("<Q", self.bytes, footer)[0]
        self.topics, self.metadata, self.chunks, self.records = {}, {}, [], []
        self.schemas, schemas = {}, {0: b""}  # what it says about the type: by channel, by number
        at = summary
        while at < footer - 9:
            opcode, length = struct.unpack_from("<BQ", self.bytes, at)
            content = self.bytes[at + 9:at + 9 + length]
            if opcode == CHANNEL:
                self._take_channel(content)
            elif opcode == SCHEMA:
                schemas[struct.unpack_from("<H", content)[0]] = content[2:]
            elif opcode == CHUNK_INDEX:
                self.chunks.append(Chunk(content))
            elif opcode == METADATA_INDEX:
                self._take_metadata(struct.unpack_from("<Q", content)[0])
            at += 9 + length
        self.schemas = {channel: schemas[schema] for channel, schema in self.schemas.items()}

    def _take_channel(self, content):
        number, schema = struct.unpack_from("<HH", content)
        self.schemas[number] = schema
        topic, at = text_at(content, 4)
        _, at = text_at(content, at)
        self.topics[number], self.metadata[number] = topic, map_at(content, at)

    def _take_metadata(self, offset):
        name, at = text_at(self.bytes, offset + 9)
        self.records.append((name, map_at(self.bytes, at)))

    def records_of(self, chunk):
        """The uncompressed records of a chunk."""
        at = chunk.offset + 9 + 8 + 8
        size, _ = struct.unpack_from("<QI", self.bytes, at)
        _, at = text_at(self.bytes, at + 12)
        length = struct.unpack_from("<Q", self.bytes, at)[0]
        return decompressed(self.bytes[at + 8:at + 8 + length], size)

    def messages_of(self, chunk, topic):
        """(log time, sequence, data) of the messages of a topic, found by the index of the chunk."""
        records, found = None, []
        for number, name in self.topics.items():
            if name != topic or number not in chunk.indexes:
                continue
            records = records if records is not None else self.records_of(chunk)
            at = chunk.indexes[number] + 9 + 2
            end = at + 4 + struct.unpack_from("<I", self.bytes, at)[0]
            for entry in range(at + 4, end, 16):
                _, offset = struct.unpack_from("<QQ", self.bytes, entry)
                length = struct.unpack_from("<Q", records, offset + 1)[0]
                _, sequence, log, _ = struct.unpack_from("<HIQQ", records, offset + 9)
                found.append((log, sequence, records[offset + 9 + 22:offset + 9 + length]))
        return found

    def runs(self):
        """(log time, module's name, number, tick) of all runs, in the order in which they ended."""
        channel = next(number for number, name in self.topics.items() if name == "indurop/runs")
        found = []
        for chunk in self.chunks:
            for log, _, data in self.messages_of(chunk, "indurop/runs"):
                number, _, tick = struct.unpack_from("<QQQ", data, 4)
                module = struct.unpack_from("<I", data, 4 + 48)[0]
                if str(module) in self.metadata[channel]:  # else: what no module wrote
                    found.append((log, self.metadata[channel][str(module)], number, tick))
        return sorted(found, key=lambda run: run[0])


class Chunk:
    def __init__(self, content):
        self.start, self.end, self.offset, self.length, size = struct.unpack_from("<QQQQI", content)
        self.indexes = {}  # where the index of a channel's messages is
        for at in range(36, 36 + size, 10):
            number, offset = struct.unpack_from("<HQ", content, at)
            self.indexes[number] = offset


def map_at(content, at):
    end = at + 4 + struct.unpack_from("<I", content, at)[0]
    at, found = at + 4, {}
    while at < end:
        key, at = text_at(content, at)
        found[key], at = text_at(content, at)
    return found


def text_at(content, at):
    length = struct.unpack_from("<I", content, at)[0]
    return content[at + 4:at + 4 + length].decode(), at + 4 + length


def decompressed(data, size):
    zstd = ctypes.CDLL("libzstd.so.1")
    zstd.ZSTD_decompress.restype = ctypes.c_size_t
    out = ctypes.create_string_buffer(size)
    got = zstd.ZSTD_decompress(out, ctypes.c_size_t(size), data, ctypes.c_size_t(len(data)))
    assert got == size, "a chunk that zstd cannot read"
    return out.raw
