#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The robot cell (examples/robot_cell), deployed to two boards, loses the node of one of them at a random instant of its work: the
black boxes of both boards are repeated from their keyframes, and nothing differs. INDUROP_CELL_FAULTS says how often. Needs root."""

import glob
import json
import os
import random
import signal
import sys
import tempfile
import time

from cell import read_arguments
from deployed_test import DeployedCell, deploy, pids
from middle_test import BETWEEN_BOXES_S, differing, is_closed


def boxes(cell, board):
    done = cell.desk("blackbox", "--board", board, "-o", "json")
    return {box["file"] for box in json.loads(done.stdout)["boxes"]} if done.returncode == 0 else set()


def new_box(cell, board, before):
    """The file of the box that a board has kept since; None: it is not there yet."""
    for name in boxes(cell, board) - before:
        found = glob.glob(os.path.join(cell.folder, "state", "**", name), recursive=True)
        if found and is_closed(found[0]):
            return found[0]
    return None


def lose_a_node(cell, number):
    cell.go_on()
    time.sleep((BETWEEN_BOXES_S if number > 0 else 0) + random.uniform(0, 6))  # somewhere in the work
    board = (cell.station, cell.robot)[number % 2]  # an agent does not restart a node that ends four times in a minute
    before = {name: boxes(cell, name) for name in (cell.station, cell.robot)}
    os.kill(pids(cell)[board], signal.SIGKILL)
    for name, known in before.items():
        cell.wait(f"a black box of {name}", lambda name=name, known=known: new_box(cell, name, known) is not None)
        file = new_box(cell, name, known)
        done = cell.indurop("replay", file, "--node", f"{name}_replay")
        wrong = differing(done)
        assert not wrong, f"fault {number} of {board}, box of {name}: {wrong}"
        print(f"{board} was killed, {name}: {done.stdout.strip().splitlines()[-1]}")
    cell.wait("the node is back", lambda: (cell.board(board) or {}).get("state") == "running")
    cell.wait("Modbus station", lambda: cell.get(cell.station, "I14") == 1)


def main():
    arguments = read_arguments(__doc__, bin="folder of the programs", cell="folder with plant.xml and what was built for it", lab="indurop-lab")
    faults = int(os.environ.get("INDUROP_CELL_FAULTS", "1"))
    with tempfile.TemporaryDirectory() as folder, DeployedCell(arguments, folder) as cell:
        deploy(cell)
        for number in range(faults):
            lose_a_node(cell, number)
    print(f"{faults} faults: the boxes of both boards are equal")
    return 0


if __name__ == "__main__":
    sys.exit(main())
