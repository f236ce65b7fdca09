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

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from mcap_file import McapFile  # noqa: E402

SECONDS = 60
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


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", type=pathlib.Path, required=True)
    parser.add_argument("--modules", type=pathlib.Path, required=True)
    options = parser.parse_args()
    node = f"late-{os.getpid()}"
    options.modules = options.modules.resolve()
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        environment = dict(os.environ, INDUROP_STATE_DIR=str(folder / "state"))
        configuration = folder / "module.xml"
        configuration.write_text(
            f"<root><module><filename>{options.modules}/rambler.so</filename><name>rambler</name><moduletype>thread</moduletype>"
            "<operationtype>periodic</operationtype><period>2ms</period><priority>2</priority></module></root>")

        def run(*words):
            return subprocess.run([options.bin / "indurop-node", *map(str, words), configuration], env=environment, timeout=300,
                                  capture_output=True, text=True)

        whole = folder / "run.mcap"
        done = run("--sim", "--until", f"{SECONDS}s", "-q", "--record", whole, "--node", node)
        assert done.returncode == 0, done.stderr
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
                    damaged[chunk.offset + 60:chunk.offset + chunk.length] = os.urandom(chunk.length - 60)
            part = folder / "part.mcap"
            part.write_bytes(damaged)
            done = run("--replay", part, "--replay-from", begin, "--replay-to", end, "--node", node)
            runs = end - begin + 1
            assert done.returncode == 0 and re.search(rf"^{runs} ticks, {runs} runs, {2 * runs} values: equal$", done.stdout, re.M), (
                begin, end, done.stdout, done.stderr)
            assert "damaged" not in done.stderr, done.stderr
        # What it needs, it reads.
        lost = max(needed)
        chunk = file.chunks[lost]
        damaged[chunk.offset + 60:chunk.offset + chunk.length] = os.urandom(chunk.length - 60)
        part.write_bytes(damaged)
        done = run("--replay", part, "--replay-from", begin, "--node", node)
        assert done.returncode == 1 and "damaged" in done.stderr, (done.stdout, done.stderr)
    print("late parts are replayed from their own chunks")


if __name__ == "__main__":
    main()
