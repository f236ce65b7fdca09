#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The robot cell (examples/robot_cell) deployed to two boards, network namespaces with agents, from a third one: it works, stops when
a cable is pulled, continues when it is back, gets another ladder program while the robot moves, and is restarted when a board's node
is killed. Needs root."""

import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile

from cell import Cell, jobs, read_arguments

SKIPPED = 77
UNREACHABLE = 6


class DeployedCell(Cell):
    """Boards have names of their own, because shared memory is everybody's on this machine."""

    def __init__(self, arguments, folder):
        super().__init__(arguments, folder, f"plc{os.getpid()}", f"motion{os.getpid()}")
        self.name = f"cell{os.getpid()}"
        self.agents = []

    def lab(self, *words, **options):
        return subprocess.run([self.arguments.lab, "-l", self.name, *words], cwd=self.folder, text=True,
                              capture_output=True, timeout=60, check=False, **options)

    def desk(self, *words):
        return self.lab("exec", "desk", f"{self.arguments.bin}/indurop", *words)

    def copy_built(self):
        for name in os.listdir(self.arguments.cell):
            if name.endswith((".so", ".exe", ".xml", ".job", ".urdf")):
                shutil.copy(os.path.join(self.arguments.cell, name), self.folder)
        plant = os.path.join(self.folder, "plant.xml")
        with open(plant, encoding="utf-8") as file:
            text = file.read()
        with open(plant, "w", encoding="utf-8") as file:
            file.write(text.replace('name="plc"', f'name="{self.station}"').replace('name="motion"', f'name="{self.robot}"'))

    def __enter__(self):
        self.copy_built()
        made = self.lab("up", self.station, self.robot, "desk")
        if made.returncode != 0:
            print(f"skipped: no network namespaces here: {made.stderr.strip()}")
            sys.exit(SKIPPED)
        for board in (self.station, self.robot):
            self.agents.append(subprocess.Popen(
                [self.arguments.lab, "-l", self.name, "exec", board, f"{self.arguments.bin}/indurop-agent", "--board", board,
                 "--quiet"], env={**os.environ, "INDUROP_STATE_DIR": os.path.join(self.folder, "state")}))
        return self

    def __exit__(self, *_):
        for agent in self.agents:
            agent.terminate()  # and its node
        for agent in self.agents:
            agent.wait(timeout=30)
        self.lab("down")
        for node in (self.station, self.robot):
            self.indurop("clean", "--node", node)

    def board(self, name):
        """What status --plant says of a board; None if it is not heard."""
        done = self.desk("status", "--plant", "-o", "json")
        boards = json.loads(done.stdout)["boards"] if done.stdout else []
        return next((board for board in boards if board["board"] == name), None)

    def press(self, button, point):
        """Holds a button down, which is wired to a point, until the PLC sees it."""
        self.indurop("set", "--node", self.station, f"CELL::panel.{button}", "true")
        self.wait(f"{button} is seen", lambda: self.get(self.station, point) == 1)
        self.indurop("set", "--node", self.station, f"CELL::panel.{button}", "false")

    def stopped(self):
        return self.get(self.robot, "EMERGENCY_STOP.bActive") == 1

    def moves(self):
        return self.get(self.robot, "ROBOT_MODULE_STATE.eState") == "ROBOT_GROUP_MOVING"

    def keep_going(self):
        """True if the robot moves; after a stop, once its cause is gone, reset and start are pressed. On a machine that is busy
        the I/O station may answer too late at any time, which is a stop too."""
        if self.moves():
            return True
        if not self.stopped() and self.get(self.station, "I14") == 1:
            self.press("reset", "I2")
            self.press("start", "I0")
        return self.moves()

    def go_on(self):
        self.wait("the robot moves", self.keep_going)


def deploy(cell):
    done = cell.desk("deploy", "plant.xml", "--health", "1s", "-o", "json")
    assert done.returncode == 0, done.stderr
    deployment = json.loads(done.stdout)["deployment"]
    cell.wait("Modbus station", lambda: cell.get(cell.station, "I14") == 1)
    for name, variable in ((cell.station, "ROBOT_ARM"), (cell.robot, "I14")):
        board = cell.board(name)
        assert (board["state"], board["deployment"], board["plant"]) == ("running", deployment, "robot_cell"), board
        assert board["tick"] > 0 and board["overruns"] >= 0, board
        read = {one["name"]: one for one in board["variables"]}[f"PLC_ROBOT::{variable}"]
        assert read["valid"] and read["age_ns"] >= 0 and read["owner"] != name, read


def wait_for_parts(cell, parts):
    def placed():
        cell.keep_going()
        return (cell.get(cell.station, "CELL::world.placed") or 0) >= parts

    cell.wait("parts on the pallet", placed)


def work(cell):
    seen = jobs(cell.changes(lambda: wait_for_parts(cell, 1)))
    rest = iter(seen)
    assert all(job in rest for job in ("home", "pick", "place")), seen  # in this order


def cable(cell):
    cell.go_on()
    cell.lab("unplug", cell.station)
    cell.wait("the robot stops without its PLC", lambda: cell.stopped() and not cell.moves())
    cell.wait("the board is missing", lambda: cell.board(cell.station) is None)
    missing = cell.desk("status", "--plant")
    assert missing.returncode == UNREACHABLE and f"not heard: {cell.station}" in missing.stderr, missing.stderr
    assert not any(one["valid"] for one in cell.board(cell.robot)["variables"]), cell.board(cell.robot)
    cell.lab("plug", cell.station)
    cell.go_on()


def exchange(cell):
    """The ladder program, while the robot moves: both nodes go on, and so does the work."""
    before = pids(cell)
    ladder = os.path.join(cell.folder, "main.so")
    shutil.copy(os.path.join(cell.arguments.cell, "main_remembers.so"), f"{ladder}.new")
    os.replace(f"{ladder}.new", ladder)
    cell.go_on()
    done = cell.desk("deploy", "plant.xml", "--health", "1s")
    output = done.stdout + done.stderr
    assert done.returncode == 0 and f"{cell.station} exchanged its modules in tick" in output, output
    assert pids(cell) == before, "a node was restarted"
    wait_for_parts(cell, cell.get(cell.station, "CELL::world.placed") + 2)
    assert cell.get(cell.station, "CELL::world.lost") == 0, "a part was lost"


def pids(cell):
    listed = json.loads(cell.indurop("nodes", "-o", "json").stdout)["nodes"]
    return {node["node"]: node["pid"] for node in listed if node["node"] in (cell.station, cell.robot)}


def kill(cell):
    os.kill(pids(cell)[cell.station], signal.SIGKILL)
    cell.wait("the robot stops without its PLC", cell.stopped)
    cell.wait("the node is back", lambda: (cell.board(cell.station) or {}).get("state") == "running")
    cell.go_on()
    assert cell.get(cell.station, "CELL::world.lost") == 0, "a part was lost"


def main():
    arguments = read_arguments(__doc__, bin="folder of the programs", cell="folder with plant.xml and what was built for it", lab="indurop-lab")
    with tempfile.TemporaryDirectory() as folder, DeployedCell(arguments, folder) as cell:
        deploy(cell)
        work(cell)
        cable(cell)
        exchange(cell)
        kill(cell)
    return 0


if __name__ == "__main__":
    sys.exit(main())
