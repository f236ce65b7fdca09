#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The robot cell (examples/robot_cell) with its tour: parts are picked and placed, the light curtain and the emergency stop
stop the robot, it goes on after reset and start; and all of it in the same order on one board and on two."""

import argparse
import csv
import json
import os
import socket
import subprocess
import sys
import tempfile
import time

PATIENCE = 90  # seconds until the tour is over and three parts were placed


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


class Cell:
    """A running cell. `station` has the PLC's points and the surroundings, `robot` the robot task."""

    def __init__(self, arguments, folder, run, station, robot):
        self.arguments = arguments
        self.folder = folder
        self.run = run
        self.station = station
        self.robot = robot

    def indurop(self, *words, **options):
        return subprocess.run([f"{self.arguments.bin}/indurop", *words], cwd=self.folder, text=True,
                              capture_output=True, timeout=30, check=False, **options)

    def get(self, node, name):
        done = self.indurop("get", "--node", node, name, "-o", "json")
        return json.loads(done.stdout)["values"][0]["value"] if done.returncode == 0 else None

    def wait(self, what, condition):
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            if condition():
                return
            time.sleep(0.1)
        raise AssertionError(f"{what}: not within {PATIENCE} s; {self.get(self.station, 'CELL::world')} "
                             f"{self.get(self.robot, 'ROBOT_JOB')} {self.get(self.robot, 'ROBOT_MODULE_STATE.nError')}")

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
        """What happened, in order: every change of the robot's state and of its job."""
        self.wait("Modbus station", lambda: (self.get(self.station, "I14") or 0) == 1)
        self.wait("robot sees the station", lambda: self.get(self.robot, "EMERGENCY_STOP.bActive") == 0)
        stops = self.get(self.robot, "EMERGENCY_STOP.nCount")  # the inputs were 0 until the station answered
        recording = subprocess.Popen([f"{self.arguments.bin}/indurop", "watch", "--node", self.robot, "ROBOT_MODULE_STATE.eState",
                                      "ROBOT_JOB.name", "--hz", "100", "-o", "csv"], stdout=subprocess.PIPE, text=True)
        self.indurop("set", "--node", self.station, "CELL::tour", "true")
        self.wait("two stops", lambda: (self.get(self.robot, "EMERGENCY_STOP.nCount") or 0) >= stops + 2)
        self.wait("three parts on the pallet", lambda: (self.get(self.station, "CELL::world.placed") or 0) >= 3)
        recording.terminate()
        rows = list(csv.reader(recording.communicate(timeout=30)[0].splitlines()))[1:]
        changes = []
        for row in rows:
            now = tuple(row[1:])
            if len(now) == 2 and (not changes or changes[-1] != now):
                changes.append(now)
        assert self.get(self.station, "CELL::world.lost") == 0, "a part was lost"
        return changes


def jobs(changes):
    """Names of the jobs one after the other; one that runs again after another begins anew."""
    names = [name for _, name in changes if name]
    return [name for i, name in enumerate(names) if i == 0 or names[i - 1] != name]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", required=True)
    parser.add_argument("--cell", required=True, help="folder with module.xml and plant.xml")
    parser.add_argument("--io-module", required=True)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        copy_configuration(os.path.abspath(arguments.cell), os.path.abspath(arguments.io_module), folder)
        with Cell(arguments, folder, ["module.xml", "--node", "cell_test"], "cell_test", "cell_test") as cell:
            one = cell.tour()
        with Cell(arguments, folder, ["plant.xml", "--local"], "plc", "motion") as cell:
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
