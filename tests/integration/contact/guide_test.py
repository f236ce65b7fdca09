#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Guiding by hand as a user does it, on the simulated arm with masses (examples/robot_contact): `robot guide` says why it does not
begin, the arm follows the hand, Enter and ROBOT_GUIDE mark points, the path becomes a job, and the robot that runs this job stays on
the path. Recordings say where the tip was."""

import argparse
import csv
import os
import pathlib
import pty
import re
import shutil
import signal
import subprocess
import sys
import time

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from nodes import new_node  # noqa: E402

PATIENCE_S = 120
SPEED = "0.25"  # of virtual time, so that a busy machine does not miss the beat of the command
MANUAL = "{eMode: ROBOT_MODE_MANUAL, bEnable: 1}"
HAND = "CONTACT::hand"


class Cell:
    def __init__(self, options):
        self.options, self.node = options, new_node(options.bin / "indurop", "guide-")
        self.folder = options.work
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        for file in ("module.xml", "ioconfig.xml", "arm.urdf", "swing.job"):
            text = (options.example / file).read_text()
            text = text.replace("./libiodispat.so", options.io_module)
            text = text.replace("<filename>./", f"<filename>{options.example}/")
            text = text.replace("5 5.4 2 -60   10 10.4 1 60   15 15.4 4 18", "")  # no visitor
            (self.folder / file).write_text(text)
        self.environment = dict(os.environ, INDUROP_STATE_DIR=str(self.folder / "state"))
        self.environment.pop("INDUROP_NODE", None)

    def indurop(self, *words, code=0):
        done = subprocess.run([self.options.bin / "indurop", *words], env=self.environment, cwd=self.folder, capture_output=True,
                              text=True, timeout=PATIENCE_S, check=False)
        assert done.returncode == code, (words, done.returncode, done.stdout, done.stderr)
        return done

    def get(self, name):
        return self.indurop("get", "--node", self.node, name).stdout.strip()

    def set(self, name, value):
        self.indurop("set", "--node", self.node, "--", name, value)

    @staticmethod
    def wait(condition, what):
        end = time.monotonic() + PATIENCE_S
        while not condition():
            assert time.monotonic() < end, f"waited in vain for {what() if callable(what) else what}"
            time.sleep(0.05)

    def begin(self, record):
        """In manual mode, with power, at rest."""
        self.indurop("run", "module.xml", "--sim", "--speed", SPEED, "--record", record, "--node", self.node, "--detach")
        self.set("PLC_ROBOT::ROBOT_MODE", "{eMode: ROBOT_MODE_MANUAL, bEnable: 0}")
        self.wait(lambda: self.get("PLC_ROBOT::ROBOT_ARM.eMode") == "ROBOT_MODE_MANUAL", "manual mode")
        self.set("PLC_ROBOT::ROBOT_MODE", MANUAL)  # a device that is pressed at the first run would not count
        self.wait(lambda: self.get("PLC_ROBOT::ROBOT_MODULE_STATE.eState") == "ROBOT_GROUP_STANDBY", "standby in manual mode")

    def end(self):
        self.indurop("stop", "--node", self.node)

    def serve(self, request):
        number = int(self.get("PLC_ROBOT::ROBOT_MODULE_STATE.nAcknowledge")) + 1
        self.set("PLC_ROBOT::ROBOT_MODULE_SERVICE", f"{{nRequest: {number}, {request}}}")
        self.wait(lambda: int(self.get("PLC_ROBOT::ROBOT_MODULE_STATE.nDone")) == number, request)
        error = self.get("PLC_ROBOT::ROBOT_MODULE_STATE.nError")
        assert error in ("0", "ROBOT_OK"), (request, error, self.get("PLC_ROBOT::ROBOT_JOB.cMessage"))

    def rows(self, record):
        """What the recording has, as numbers."""
        table = self.folder / (record + ".csv")
        self.indurop("recording", "export", record, "--csv", table.name, "-q")
        with open(table, encoding="utf-8") as file:
            return list(csv.DictReader(file))


class Guide:
    """`indurop robot guide` in a terminal."""

    def __init__(self, cell, *words):
        self.own, other = pty.openpty()
        self.lines = ""
        command = [cell.options.bin / "indurop", "robot", "guide", *words, "--node", cell.node]
        self.child = subprocess.Popen(command, env=cell.environment, cwd=cell.folder, stdin=other, stdout=subprocess.PIPE,
                                      stderr=subprocess.STDOUT, text=True)
        os.set_blocking(self.child.stdout.fileno(), False)
        os.close(other)

    def said(self, what):
        try:
            self.lines += self.child.stdout.read() or ""
        except TypeError:  # nothing new
            pass
        assert self.child.poll() is None or what in self.lines, self.lines
        return what in self.lines

    def press_enter(self):
        os.write(self.own, b"\n")

    def end(self):
        """The exit code and all that was said."""
        self.child.send_signal(signal.SIGINT)
        self.child.wait(PATIENCE_S)
        self.lines += self.child.stdout.read() or ""
        os.close(self.own)
        return self.child.returncode, self.lines


def tips(rows, measured=False):
    """The place of the tip in each row, in mm, as commanded or as measured."""
    name = "MC_TOOL.dMachine" if measured else "ROBOT_ARM.position"
    return numpy.array([[float(row[f"PLC_ROBOT::{name}[{i}]"]) for i in range(3)] for row in rows])


def between(rows, name):
    return [row for row in rows if row[name] not in ("0", "false", "")]


def distances(places, path):
    """How far each place is from the path, a chain of places."""
    begins, ends = path[:-1], path[1:]
    ways = ends - begins
    squares = numpy.maximum((ways ** 2).sum(1), 1e-12)
    out = []
    for place in places:
        share = numpy.clip(((place - begins) * ways).sum(1) / squares, 0, 1)
        out.append(numpy.linalg.norm(begins + share[:, None] * ways - place, axis=1).min())
    return numpy.array(out)


def refusals(cell):
    """It says at once why it cannot begin, and what to do."""
    cell.set("PLC_ROBOT::ROBOT_MODE", "{eMode: ROBOT_MODE_NONE, bEnable: 0}")
    cell.wait(lambda: cell.get("PLC_ROBOT::ROBOT_ARM.eMode") == "ROBOT_MODE_NONE", "another mode")
    done = cell.indurop("robot", "guide", "seam", "--node", cell.node, code=1)
    assert "manual mode" in done.stderr and "ROBOT_MODE_MANUAL" in done.stderr, done.stderr
    cell.set("PLC_ROBOT::ROBOT_MODE", MANUAL)
    cell.wait(lambda: cell.get("PLC_ROBOT::ROBOT_ARM.eMode") == "ROBOT_MODE_MANUAL" and
              cell.get("PLC_ROBOT::ROBOT_MODULE_STATE.eState") == "ROBOT_GROUP_STANDBY", "manual mode")
    cell.serve("eOpCode: SVC_AD_TOOL, nTool: 1")
    cell.set(f"{HAND}[1]", "25")  # not as hard as in a collision
    guide = Guide(cell, "seam")
    cell.wait(lambda: guide.said("before guiding begins: release it first"), "why the arm cannot be guided")
    code, said = guide.end()
    assert code == 1 and "the robot was not guided" in said, said
    cell.set(f"{HAND}[1]", "0")


def push(cell, forces, way, axis):
    """A hand pushes with these forces (N) until the tip is `way` mm from where it was, along this axis. Then it is taken away."""
    place = lambda: float(cell.get(f"PLC_ROBOT::ROBOT_ARM.position[{axis}]"))
    began = place()
    for i, force in enumerate(forces):
        cell.set(f"{HAND}[{i}]", str(force))
    cell.wait(lambda: abs(place() - began) > way, "the arm to follow the hand")
    for i in range(3):
        cell.set(f"{HAND}[{i}]", "0")
    cell.wait(lambda: float(cell.get("PLC_ROBOT::ROBOT_ARM.tool_speed")) < 0.01, "the arm to stand")
    assert numpy.sign(place() - began) == numpy.sign(forces[axis]), "it moves against the hand"


def guide_along(cell):
    """Returns what the command said."""
    guide = Guide(cell, "seam", "--within", "0.5")
    cell.wait(lambda: guide.said("push the arm"), "the begin")
    push(cell, (0, 40, 0), 80, 1)
    guide.press_enter()
    cell.wait(lambda: guide.said("point 1 is marked"), lambda: f"a mark by Enter: {guide.lines}")
    push(cell, (-30, 25, 30), 60, 2)
    cell.set("PLC_ROBOT::ROBOT_GUIDE", "{nMark: 7}")
    cell.wait(lambda: guide.said("point 2 is marked"), lambda: f"a mark by the variable: {guide.lines}")
    push(cell, (0, -40, 0), 50, 1)
    code, said = guide.end()
    assert code == 0, said
    cell.wait(lambda: cell.get("PLC_ROBOT::ROBOT_ARM.bGuided") == "0", "the end")
    return said


def main():
    parser = argparse.ArgumentParser()
    for name in ("--bin", "--example", "--work"):
        parser.add_argument(name, type=lambda path: pathlib.Path(path).absolute(), required=True)
    parser.add_argument("--io-module", required=True)
    cell = Cell(parser.parse_args())
    try:
        cell.begin("guided.mcap")
        refusals(cell)
        said = guide_along(cell)
        found = re.search(r"seam\.job: (\d+) mm in (\d+) points, within ([\d.]+) mm", said)
        assert found and 190 < int(found[1]) < 600 and float(found[3]) <= 0.5, said
        assert "name it in the property jobs" in said, said
        cell.end()
        guided = tips(between(cell.rows("guided.mcap"), "PLC_ROBOT::ROBOT_ARM.bGuided"), measured=True)
        job = (cell.folder / "seam.job").read_text()
        assert "TOOL hand\n" in job and len(re.findall("^POINT", job, re.M)) == int(found[2]), job
        module = cell.folder / "module.xml"
        module.write_text(module.read_text().replace("swing.job</value>", "swing.job seam.job</value>"))
        cell.begin("played.mcap")
        cell.serve("eOpCode: SVC_JB_START, nJob: 2")
        cell.wait(lambda: cell.get("PLC_ROBOT::ROBOT_JOB.eState") == "ROBOT_JOB_ENDED", "the end of the job")
        cell.end()
        rows = [row for row in cell.rows("played.mcap") if row["PLC_ROBOT::ROBOT_JOB.name"] == "seam"]
        begin = next(i for i, at in enumerate(tips(rows)) if numpy.linalg.norm(at - guided[0]) < 0.1)
        off = distances(tips(rows)[begin::5], guided)
        print(f"{found[1]} mm in {found[2]} points; played within {off.max():.2f} mm of {len(guided)} guided places")
        assert off.max() < 0.5, off.max()
        assert distances(guided[::20], tips(rows)[begin:]).max() < 0.5, "a part of the path was left out"
        assert numpy.linalg.norm(tips(rows)[-1] - guided[-1]) < 0.1, "it ends elsewhere"
    finally:
        subprocess.run([cell.options.bin / "indurop", "stop", "--node", cell.node], env=cell.environment, capture_output=True,
                       check=False)
    return 0


if __name__ == "__main__":
    sys.exit(main())
