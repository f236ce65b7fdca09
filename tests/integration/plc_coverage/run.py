#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What `indurop plc coverage` says of a ladder that was driven a known way, and of files of counters that are damaged."""

import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from nodes import new_node  # noqa: E402


class Ladder:
    def __init__(self, options):
        self.indurop, self.work = options.indurop, options.work
        shutil.rmtree(self.work, ignore_errors=True)
        (self.work / "counts").mkdir(parents=True)
        self.node = new_node(options.indurop, "coverage")
        self.environment = dict(os.environ, INDUROP_PLC_COVERAGE=str(self.work / "counts"),
                                INDUROP_STATE_DIR=str(self.work / "state"))
        shutil.copy(options.program, self.work / "conveyor.xml")

    def tool(self, *words, code=0):
        done = subprocess.run([self.indurop, *map(str, words)], capture_output=True, text=True, env=self.environment,
                              cwd=self.work, check=False)
        if done.returncode != code:
            sys.exit(f"indurop {' '.join(map(str, words))}: {done.returncode}\n{done.stdout}{done.stderr}")
        return done.stdout + done.stderr

    def run(self, steps):
        """In simulation: what is forced, and how many ticks of 10 ms then. Returns how many there were in all."""
        node = subprocess.Popen([self.indurop, "run", "module.xml", "--sim", "--step", "--node", self.node], stdin=subprocess.PIPE,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=self.environment, cwd=self.work)

        def stands_at(tick):
            for line in node.stdout:
                if re.search(rf"\btick {tick},", line):
                    return
            sys.exit(f"it ended before tick {tick}")

        tick = 0
        stands_at(0)
        for forced, ticks in steps:
            for name, value in forced.items():
                self.tool("force", f"conveyor::{name}={value}", "--node", self.node)
            node.stdin.write(f"{ticks}\n")
            node.stdin.flush()
            tick += ticks
            stands_at(tick)
        node.stdin.write("q\n")
        node.stdin.close()
        ticks = re.search(r"; (\d+) ticks, 0 lost", node.stdout.read())
        node.wait()
        return int(ticks.group(1))

    def covered(self):
        pous = json.loads(self.tool("plc", "coverage", "counts", "--lcov", "coverage.info", "-o", "json"))["pous"]
        return pous[0]

    def lines(self):
        text = (self.work / "coverage.info").read_text(encoding="utf-8")
        return {int(line): int(count) for line, count in re.findall(r"^DA:(\d+),(\d+)$", text, re.M)}


def expect(is_so, what):
    if not is_so:
        sys.exit(f"not so: {what}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--indurop", type=lambda text: pathlib.Path(text).resolve(), required=True)
    parser.add_argument("--program", type=lambda text: pathlib.Path(text).resolve(), required=True)
    parser.add_argument("--work", type=lambda text: pathlib.Path(text).resolve(), required=True)
    sut = Ladder(parser.parse_args())
    expect("there are no counters" in sut.tool("plc", "coverage", "counts", code=1), "without a run there is nothing")
    modules = sut.tool("plc", "build", "conveyor.xml", "--coverage")
    (sut.work / "module.xml").write_text(
        "<root>" + re.search(r"<module>.*</module>", modules, re.S).group(0) + "</root>", encoding="utf-8")

    # The belt starts, the motor follows after two seconds. No box comes.
    scans = sut.run([({}, 10), ({"start": "true"}, 300)])
    first = sut.covered()
    expect(first["rungs"] == 1 and first["lines"] is None, f"all rungs ran: {first}")
    expect(sorted(first["not_tried"]) == ["rung 4, coil pallet_full is never on", "rung 5, coil fault is never on",
                                          "rung 6, coil fault is never on"], f"what was not on: {first}")
    expect(max(sut.lines().values()) == scans, f"{scans} scans: {sut.lines()}")

    # In another run twelve boxes pass, and one is stuck: both files count together.
    boxes = [({"box_sensor": value}, 5) for _ in range(12) for value in ("true", "false")]
    more = sut.run([({"start": "true"}, 300), *boxes, ({"box_sensor": "true"}, 400)])
    both = sut.covered()
    expect(both["not_tried"] == ["rung 6, coil fault is never on"], f"without an acknowledgement: {both}")
    expect(max(sut.lines().values()) == scans + more, "runs add up")

    damaged = next((sut.work / "counts").iterdir())
    damaged.write_bytes(damaged.read_bytes()[:100])
    said = sut.tool("plc", "coverage", "counts", code=1)
    expect("holds no counters of a PLC program" in said, said)


if __name__ == "__main__":
    main()
