#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The robot cell (examples/robot_cell) with its tour: parts are picked and placed, the light curtain and the emergency stop
stop the robot, its job goes on after reset and start; and all of it in the same order on one board, on two, and on one with the
PLC program on a core of its own. Without devices and in virtual time its values are the same on one core and on two."""

import argparse
import json
import os
import re
import socket
import subprocess
import sys
import tempfile
import time

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
        self.expected_stops = 0  # emergency stops after the tour

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

    def lost(self):
        """Periods in which the machine stood still, most of the boards."""
        shown = [self.indurop("status", "--node", node, "-o", "json").stdout for node in {self.station, self.robot}]
        return max(int(number) for text in shown for number in re.findall(r'"lost_ticks":\s*(\d+)', text) + ["0"])

    def was_disturbed(self):
        """The machine stood still, so that data of the other board are old, or the surroundings, which have no priority, so that
        the Modbus station does not answer in time. That is an emergency stop that no tour expects."""
        many_lost = 5
        return self.lost() >= many_lost or (self.get(self.robot, "EMERGENCY_STOP.nCount") or 0) > self.expected_stops

    def tour(self):
        """What happened, as changes() tells it."""
        self.wait("Modbus station", lambda: (self.get(self.station, "I14") or 0) == 1)
        self.wait("robot sees the station", lambda: self.get(self.robot, "EMERGENCY_STOP.bActive") == 0)
        stops = self.get(self.robot, "EMERGENCY_STOP.nCount")  # the inputs were 0 until the station answered
        self.expected_stops = stops + 2

        def work():
            self.indurop("set", "--node", self.station, "CELL::tour", "true")
            self.wait("both stops", lambda: (self.get(self.robot, "EMERGENCY_STOP.nCount") or 0) >= self.expected_stops)
            self.wait("three parts on the pallet", lambda: (self.get(self.station, "CELL::world.placed") or 0) >= 3)

        changes = self.changes(work)
        assert self.get(self.station, "CELL::world.lost") == 0, "a part was lost"
        assert self.get(self.station, "CELL::world.spilled") == 0, "glue was spilled"
        assert self.get(self.station, "CELL::world.dots") >= 3, "there is no glue on the pallet"
        return changes

    def press(self, what, until):
        self.indurop("set", "--node", self.station, f"CELL::panel.{what}", "true")
        self.wait(what, until)
        self.indurop("set", "--node", self.station, f"CELL::panel.{what}", "false")

    def stop_on_the_way(self):
        """An emergency stop while the robot carries a part to the pallet. True if the job can go on."""
        self.wait("a motion of the job", lambda: self.get(self.robot, "ROBOT_JOB.name") == "place" and
                  (self.get(self.robot, "ROBOT_ARM.tool_speed") or 0) > 50)
        self.expected_stops += 1
        self.indurop("set", "--node", self.station, "CELL::panel.emergency_stop", "true")
        self.wait("emergency stop", lambda: self.get(self.robot, "ROBOT_MODULE_STATE.eState") == "ROBOT_GROUP_ERRORSTOP")
        return self.get(self.robot, "ROBOT_JOB.bResume") == 1

    def go_on(self):
        self.indurop("set", "--node", self.station, "CELL::panel.emergency_stop", "false")
        self.wait("all is well", lambda: self.get(self.robot, "EMERGENCY_STOP.bActive") == 0)
        self.press("reset", lambda: self.get(self.robot, "ROBOT_MODULE_STATE.eState") != "ROBOT_GROUP_ERRORSTOP")
        self.press("start", lambda: self.get(self.robot, "ROBOT_MODULE_STATE.eState") == "ROBOT_GROUP_MOVING")

    def resume(self):
        """Stopped on its way and asked to go on, the job does, and the part comes to its place."""
        while not self.stop_on_the_way():
            self.go_on()
        placed = self.get(self.station, "CELL::world.placed")

        def work():
            self.go_on()
            self.wait("the part on the pallet", lambda: (self.get(self.station, "CELL::world.placed") or 0) > placed)

        changes = self.changes(work)
        assert "home" not in jobs(changes), f"the job began again: {changes}"
        assert self.get(self.station, "CELL::world.lost") == 0, "a part was lost"
        assert self.get(self.station, "CELL::world.spilled") == 0, "glue was spilled"


def tour_of(arguments, folder, run, station, robot, then=None):
    """What happened on the tour of a cell, which begins again if it was disturbed."""
    for last in (False, False, True):
        with RunningCell(arguments, folder, run, station, robot) as cell:
            try:
                changes = cell.tour()
                if then:
                    then(cell)
                return changes
            except AssertionError as why:
                if last or not cell.was_disturbed():
                    raise
                print(f"the tour was disturbed and begins again: {why}")
    return None


def on_two_cores(folder, cores):
    """The board's file with the PLC program, which gets its data from the others, on another core."""
    with open(os.path.join(folder, "module.xml"), encoding="utf-8") as file:
        text = file.read()
    text = text.replace("<root>", f"<root><core>{cores[-1]}</core>")
    with open(os.path.join(folder, "cores.xml"), "w", encoding="utf-8") as file:
        file.write(text.replace("<priority>3</priority>", f"<priority>3</priority><core>{cores[0]}</core>"))


def without_devices(folder, name, arguments):
    """All values of the cell after five seconds of virtual time, of which its modules take some."""
    with open(os.path.join(folder, name), encoding="utf-8") as file:
        modules = file.read().split("<module>")
    modules = [m for m in modules if "iodispat" not in m and "world" not in m]
    modules = [m.replace("<priority>", f"<wcet>{i}00us</wcet><priority>", 1) for i, m in enumerate(modules)]
    with open(os.path.join(folder, f"sim_{name}"), "w", encoding="utf-8") as file:
        file.write("<module>".join(modules) + ("" if "</root>" in modules[-1] else "</root>"))
    node = f"sim_{name[:4]}"
    tools = Cell(arguments, folder, node, node)
    done = tools.indurop("run", f"sim_{name}", "--sim", "--until", "5s", "--node", node, "-q")
    assert done.returncode == 0, done.stderr
    values = tools.indurop("vars", "--node", node, "-o", "json").stdout
    tools.indurop("clean", "--node", node)
    shown = {v["name"]: v["value"] for v in json.loads(values)["variables"]}
    shown["PLC_ROBOT::EMERGENCY_STOP"].pop("tReaction")  # a time, and shorter where others run elsewhere
    return shown


def starts_clean(folder, arguments):
    """The cell is what people see first: it starts without a warning, and nothing sounds as if it were wrong."""
    tools = Cell(arguments, folder, "clean_test", "clean_test")
    for file in ("module.xml", "plant.xml"):
        found = json.loads(tools.indurop("check", file, "-o", "json").stdout)["diagnostics"]
        assert not [one for one in found if one["severity"] != "note"], found
    done = tools.indurop("run", "module.xml", "--duration", "1s", "--node", "clean_test")
    begin = (done.stdout + done.stderr).split("stopped: end of the duration")[0].split("the tick has stopped")[0]
    tools.indurop("clean", "--node", "clean_test")
    assert done.returncode == 0 and not [word for word in ("warning", "note:", "cannot", "--tape") if word in begin], begin


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", required=True)
    parser.add_argument("--cell", required=True, help="folder with module.xml and plant.xml")
    parser.add_argument("--io-module", required=True)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        copy_configuration(os.path.abspath(arguments.cell), os.path.abspath(arguments.io_module), folder)
        starts_clean(folder, arguments)
        board = ["module.xml", "--node", "cell_test"], "cell_test", "cell_test"
        one = tour_of(arguments, folder, *board, lambda cell: cell.resume())
        two = tour_of(arguments, folder, ["plant.xml", "--local"], "plc", "motion")
        cores = sorted(os.sched_getaffinity(0))
        on_two_cores(folder, cores)
        two_core_tour = one
        if len(cores) > 1:
            two_core_tour = tour_of(arguments, folder, ["cores.xml", *board[0][1:]], *board[1:])
        values = without_devices(folder, "module.xml", arguments)
        assert values == without_devices(folder, "cores.xml", arguments), "not the values of one core"
    states = {state for state, _ in one}
    assert {f"ROBOT_GROUP_{state}" for state in ("STANDBY", "MOVING", "ERRORSTOP")} <= states, f"standby, moving and error stop were not all seen: {sorted(states)}"
    assert jobs(one)[:3] == ["home", "pick", "place"], jobs(one)
    common = min(len(jobs(one)), len(jobs(two))) - 1  # the last one is whatever was on when it ended
    assert common >= 6, (jobs(one), jobs(two))
    assert jobs(one)[:common] == jobs(two)[:common], f"one board: {jobs(one)}\ntwo boards: {jobs(two)}"
    common = min(common, len(jobs(two_core_tour)) - 1)
    assert common >= 6 and jobs(one)[:common] == jobs(two_core_tour)[:common], f"one core: {jobs(one)}\ntwo cores: {jobs(two_core_tour)}"
    print(f"one board and two: {' '.join(jobs(one)[:common])}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
