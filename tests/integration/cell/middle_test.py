#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The robot cell (examples/robot_cell), recorded from random instants of its tour on, with a robot in motion, parts in the
gripper and stops: each recording is repeated from its keyframes, and nothing differs. So are black boxes kept on the way.
INDUROP_CELL_RECORDINGS says how many recordings, INDUROP_CELL_BOXES how many boxes."""

import argparse
import json
import os
import random
import re
import shutil
import sys
import tempfile
import time

from cell_test import RunningCell, copy_configuration


BETWEEN_BOXES_S = 10.5  # a node keeps at most one in 10 s


def differing(done):
    """What is wrong with a replay; empty: all of it is equal."""
    output = done.stdout + done.stderr
    equal = re.search(r"(\d+) ticks, (\d+) runs, (\d+) values: equal", output)
    in_doubt = re.search(r"runs of (Robot|main|estop) before tick", output)
    repeated = equal and int(equal.group(3)) > 1000
    return "" if done.returncode == 0 and repeated and not in_doubt else output


def box_of(cell, node, reason):
    """The file of the black box that was asked for; None: it is not complete yet."""
    boxes = json.loads(cell.indurop("blackbox", "list", "--node", node, "-o", "json").stdout)["boxes"]
    return next((box["file"] for box in boxes if box["reason"] == reason and is_closed(box["file"])), None)


def is_closed(file):
    """An MCAP file ends as it begins."""
    with open(file, "rb") as recording:
        magic = recording.read(8)
        recording.seek(-len(magic), os.SEEK_END)
        return recording.tell() > 0 and recording.read() == magic


def keep_box(cell, node, file):
    reason = f"in the middle of the tour of {os.getpid()} at {time.time():.3f}"
    done = cell.indurop("blackbox", "keep", reason, "--node", node)
    assert done.returncode == 0, done.stderr
    cell.wait("the black box", lambda: box_of(cell, node, reason) is not None)
    shutil.copy(box_of(cell, node, reason), file)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", required=True)
    parser.add_argument("--cell", required=True, help="folder with module.xml")
    parser.add_argument("--io-module", required=True)
    parser.add_argument("--recordings", type=int, default=int(os.environ.get("INDUROP_CELL_RECORDINGS", "6")))
    parser.add_argument("--boxes", type=int, default=int(os.environ.get("INDUROP_CELL_BOXES", "1")))
    arguments = parser.parse_args()
    node = "middle_test"
    with tempfile.TemporaryDirectory() as folder:
        copy_configuration(os.path.abspath(arguments.cell), os.path.abspath(arguments.io_module), folder)
        with RunningCell(arguments, folder, ["module.xml", "--node", node], node, node) as cell:
            cell.wait("Modbus station", lambda: (cell.get(node, "I14") or 0) == 1)
            cell.indurop("set", "--node", node, "CELL::tour", "true")
            cell.wait("a job", lambda: cell.get(node, "ROBOT_MODULE_STATE.eState") == "ROBOT_GROUP_MOVING")
            for i in range(arguments.recordings):
                time.sleep(random.uniform(0, 3))  # somewhere in the tour
                done = cell.indurop("record", "--node", node, "-o", f"{i}.mcap", "--duration", "2s")
                assert done.returncode == 0, done.stderr
            for i in range(arguments.boxes):
                if i > 0:
                    time.sleep(BETWEEN_BOXES_S + random.uniform(0, 3))
                keep_box(cell, node, os.path.join(folder, f"box{i}.mcap"))
        for name in [*(str(i) for i in range(arguments.recordings)), *(f"box{i}" for i in range(arguments.boxes))]:
            done = cell.indurop("replay", f"{name}.mcap", "--node", f"{node}_replay")
            wrong = differing(done)
            assert not wrong, f"{name}: {wrong}"
            print(done.stdout.strip().splitlines()[-1])
    print(f"{arguments.recordings} recordings and {arguments.boxes} black boxes: equal")
    return 0


if __name__ == "__main__":
    sys.exit(main())
