#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The robot cell (examples/robot_cell) with its tour: parts are picked and placed, the light curtain and the emergency stop
stop the robot, it goes on after reset and start; and all of it in the same order on one board and on two."""

import argparse
import os
import socket
import subprocess
import sys
import tempfile

from cell import Cell, jobs


def copy_configuration(built, io_module, folder):
    """The cell's files with a Modbus port of their own, so that other cells on this machine do not matter."""
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = probe.getsockname()[1]
    for name in os.listdir(built):
        if name.endswith((".xml", ".job", ".urdf")):
            with open(os.path.join(built, name), encoding="utf-8") as file:
                text = file.read()
            text = text.replace("./libiodispat.so", io_module).replace("<filename>./", f"<filename>{built}/")
            text = text.replace("127.0.0.1:1502", f"127.0.0.1:{port}")
            text = text.replace("<operationtype>non-real</operationtype>", "<operationtype>non-real</operationtype>"
                                f'<property><value name="port">{port}</value></property>')
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)


class RunningCell(Cell):
    """Started with indurop run."""

    def __init__(self, arguments, folder, run, station, robot):
        super().__init__(arguments, folder, station, robot)
        self.run = run

    def __enter__(self):
        for node in {self.station, self.robot}:
            self.indurop("clean", "--node", node)
        self.node = subprocess.Popen([f"{self.arguments.bin}/indurop", "run", *self.run, "-q"], cwd=self.folder,
                                     stdout=subprocess.DEVNULL)
        return self

    def __exit__(self, *_):
        self.node.terminate()
        self.node.wait(timeout=30)
        for node in {self.station, self.robot}:
            self.indurop("clean", "--node", node)

    def tour(self):
        """What happened, as changes() tells it."""
        self.wait("Modbus station", lambda: (self.get(self.station, "I14") or 0) == 1)
        self.wait("robot sees the station", lambda: self.get(self.robot, "EMERGENCY_STOP.bActive") == 0)
        stops = self.get(self.robot, "EMERGENCY_STOP.nCount")  # the inputs were 0 until the station answered

        def work():
            self.indurop("set", "--node", self.station, "CELL::tour", "true")
            self.wait("two stops", lambda: (self.get(self.robot, "EMERGENCY_STOP.nCount") or 0) >= stops + 2)
            self.wait("three parts on the pallet", lambda: (self.get(self.station, "CELL::world.placed") or 0) >= 3)

        changes = self.changes(work)
        assert self.get(self.station, "CELL::world.lost") == 0, "a part was lost"
        return changes


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", required=True)
    parser.add_argument("--cell", required=True, help="folder with module.xml and plant.xml")
    parser.add_argument("--io-module", required=True)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        copy_configuration(os.path.abspath(arguments.cell), os.path.abspath(arguments.io_module), folder)
        with RunningCell(arguments, folder, ["module.xml", "--node", "cell_test"], "cell_test", "cell_test") as cell:
            one = cell.tour()
        with RunningCell(arguments, folder, ["plant.xml", "--local"], "plc", "motion") as cell:
            two = cell.tour()
    states = {int(state) for state, _ in one}
    assert {1, 2, 5} <= states, f"standby, moving and error stop were not all seen: {sorted(states)}"
    assert jobs(one)[:3] == ["home", "pick", "place"], jobs(one)
    common = min(len(jobs(one)), len(jobs(two))) - 1  # the last one is whatever was on when it ended
    assert common >= 6, (jobs(one), jobs(two))
    assert jobs(one)[:common] == jobs(two)[:common], f"one board: {jobs(one)}\ntwo boards: {jobs(two)}"
    print(f"one board and two: {' '.join(jobs(one)[:common])}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
