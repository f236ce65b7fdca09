#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A late part of a recording is replayed without the rest. Which chunks it may need is computed here, from the indexes of the
file: all others are overwritten with garbage, and the replay still repeats every wanted run, bit for bit."""

import argparse
import os
import pathlib
import random
import re
import struct
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from mcap_file import McapFile  # noqa: E402
from nodes import new_node  # noqa: E402

SECONDS = 60
RECORDINGS = 25
LAST_TICK = SECONDS * 500 - 1  # a tick each 2 ms


def chunks_needed(file, first_tick, last_tick):
    """Those of the runs wanted, of the keyframe before them, of the last value of each topic before that, and of the first values."""
    keyframes = [(log, *struct.unpack_from("<QQ", data, 4)) for chunk in file.chunks
                 for log, _, data in file.messages_of(chunk, "indurop/keyframes/rambler")]
    runs = {number: (log, tick) for log, _, number, tick in file.runs()}
    begin = max(log for log, number, _ in keyframes if number in runs and runs[number][1] <= first_tick)
    end = max(log for log, tick in runs.values() if tick <= last_tick) + 1_100_000_000  # a second in which late runs may end
    needed = {0} | {i for i, chunk in enumerate(file.chunks) if chunk.end >= begin and chunk.start <= end}
    for topic in file.topics.values():
        before = [i for i, chunk in enumerate(file.chunks) if any(log < begin for log, _, _ in file.messages_of(chunk, topic))]
        needed |= set(before[-1:])
    return needed


class Node:
    """Runs one of the test modules as the only one, in virtual time, and replays."""

    def __init__(self, options, folder, module):
        self.programs, self.folder = options.bin, folder
        self.environment = dict(os.environ, INDUROP_STATE_DIR=str(folder / "state"))
        self.name = new_node(options.bin / "indurop", "late-")
        self.configuration = folder / f"{module}.xml"
        self.configuration.write_text(
            f"<root><module><filename>{options.modules}/{module}.so</filename><name>rambler</name><moduletype>thread</moduletype>"
            "<operationtype>periodic</operationtype><period>2ms</period><priority>2</priority></module></root>")

    def run(self, *words, name=None):
        return subprocess.run([self.programs / "indurop-node", *map(str, words), "--node", name or self.name, self.configuration],
                              env=self.environment, timeout=300, capture_output=True, text=True)

    def record(self, seconds, file):
        done = self.run("--sim", "--until", f"{seconds}s", "-q", "--record", file)
        assert done.returncode == 0, done.stderr

    def indurop(self, *words):
        return subprocess.run([self.programs / "indurop", *map(str, words)], env=self.environment, timeout=60, capture_output=True,
                              text=True)


def late_parts_are_replayed_alone(options, folder):
    node, whole, part = Node(options, folder, "rambler"), folder / "run.mcap", folder / "part.mcap"
    node.record(SECONDS, whole)
    bytes_of_whole = whole.read_bytes()
    file = McapFile(whole)
    assert len(file.chunks) > SECONDS / 2, len(file.chunks)
    seed = random.randrange(1 << 32)
    print(f"seed {seed}")
    choice = random.Random(seed)
    for begin in (LAST_TICK - 499, *(choice.randrange(500, LAST_TICK) for _ in range(8))):
        end = min(LAST_TICK, begin + choice.choice((0, 10, 700)))
        needed = chunks_needed(file, begin, end)
        assert len(needed) < 12, needed
        damaged = bytearray(bytes_of_whole)
        for i, chunk in enumerate(file.chunks):
            if i not in needed:
                damage(damaged, chunk)
        part.write_bytes(damaged)
        done = node.run("--replay", part, "--replay-from", begin, "--replay-to", end)
        runs = end - begin + 1
        assert done.returncode == 0 and re.search(rf"^{runs} ticks, {runs} runs, {2 * runs} values: equal$", done.stdout, re.M), (
            begin, end, done.stdout, done.stderr)
        assert "damaged" not in done.stderr, done.stderr
    # What it needs, it reads.
    damage(damaged, file.chunks[max(needed)])
    part.write_bytes(damaged)
    done = node.run("--replay", part, "--replay-from", begin)
    assert done.returncode == 1 and "damaged" in done.stderr, (done.stdout, done.stderr)


def what_was_written_before_stays(options, folder):
    """Live recordings of a module that seldom writes: one of ten begins with the run of a keyframe, and nothing is written in it."""
    node = Node(options, folder, "rambler_seldom")
    configuration = node.configuration.read_text().replace("2ms", "50ms")
    node.configuration.write_text(configuration)
    with subprocess.Popen([options.bin / "indurop-node", "-q", "--node", node.name, node.configuration], env=node.environment) as live:
        try:
            equal = 0
            for i in range(RECORDINGS):
                file = folder / f"live{i}.mcap"
                while True:  # as soon as the node is there
                    done = node.indurop("record", "-q", "--node", node.name, "--duration", "300ms", "-o", file)
                    assert live.poll() is None, "the node has ended"
                    if done.returncode == 0:
                        break
                    time.sleep(0.05)
                done = node.run("--replay", file, name=f"{node.name}-r")
                assert " differ" not in done.stdout, (i, done.stdout, done.stderr)
                equal += " values: equal" in done.stdout
            assert equal > RECORDINGS // 2, equal
        finally:
            live.terminate()


def damage(data, chunk):
    data[chunk.offset + 60:chunk.offset + chunk.length] = os.urandom(chunk.length - 60)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", type=pathlib.Path, required=True)
    parser.add_argument("--modules", type=pathlib.Path, required=True)
    options = parser.parse_args()
    options.modules = options.modules.resolve()
    with tempfile.TemporaryDirectory() as folder:
        late_parts_are_replayed_alone(options, pathlib.Path(folder))
        what_was_written_before_stays(options, pathlib.Path(folder))
    print("late parts are replayed from their own chunks")


if __name__ == "__main__":
    main()
