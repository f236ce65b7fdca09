#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The example of two robots over one table in virtual time. The judge (two_arms.py) computes from the recorded set points of all
drives where the bodies of both arms are: they keep a distance, wait for each other, and lift the tray together. Without the
property other_robots they touch, so the judge can tell."""

import argparse
import csv
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy

from two_arms import Arm, GRID, frame, nearest, numbers

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from nodes import new_node  # noqa: E402

PERIOD = 4_000_000  # ns
ROBOTS = ("PLC_ROBOT", "PLC_ROBOT2")
FILES = ("module.xml", "ioconfig.xml", "robot.urdf", "table.job", "put.job", "take.job")
TOOL = 0.1  # m, length of the gripper
TRAY, LIFTED = (0.42, 0, 0.08), (0.42, 0, 0.26)  # m, each in the frame of its robot


class Run:
    """What was recorded of `seconds`: for each period the set points of both arms (rad), whom they wait for, and their cycles."""

    def __init__(self, options, folder, shares, seconds):
        for file in FILES:
            text = (options.example / file).read_text().replace("./libiodispat.so", options.io_module)
            text = text.replace("<filename>./", f"<filename>{options.example}/")
            if not shares:
                text = re.sub(r" SYNC \w+", "", text)
                text = re.sub(r'.*<value name="(other_robots|cell_box|base_in_cell)">.*\n', "", text)
            (folder / file).write_text(text)
        text = (options.example / "module.xml").read_text()
        bases = [numbers(base, 6) for base in re.findall(r'"base_in_cell">(.*)<', text)]
        tool = numbers(re.search(r"BODY gripper = BOX (.*)", (folder / "table.job").read_text())[1]) / 1000
        self.arms = [Arm(folder / "robot.urdf", frame(base[:3] / 1000, numpy.radians(base[3:])), tool) for base in bases]
        indurop = options.bin / "indurop"
        quiet = {"check": True, "cwd": folder, "stdout": subprocess.DEVNULL}
        subprocess.run([indurop, "run", "module.xml", "--sim", "--until", f"{seconds}s", "--record", "run.mcap", "-q", "--node",
                        new_node(indurop, "two-")], **quiet)
        names = [f"{robot}::{name}" for robot in ROBOTS for name in ("ROBOT_ARM", "ROBOT_SPACE", "ROBOT_JOB")]
        subprocess.run([indurop, "recording", "export", "run.mcap", *names, "--csv", "run.csv", "-q"], **quiet)
        with open(folder / "run.csv", encoding="utf-8") as file:
            rows = {int(row["time_ns"]) // PERIOD: row for row in csv.DictReader(file)}  # the last ones of each period
        # Before the first period of both robots, set points are 0.
        rows = [row for _, row in sorted(rows.items()) if all(float(row[f"{robot}::ROBOT_ARM.command[0]"] or 0) for robot in ROBOTS)]
        self.angles = [numpy.radians([[float(row[f"{robot}::ROBOT_ARM.command[{axis}]"]) for axis in range(6)] for row in rows])
                       for robot in ROBOTS]
        self.waits = [[row[f"{robot}::ROBOT_SPACE.cWaitsFor"] for row in rows] for robot in ROBOTS]
        self.cycles = [int(rows[-1][f"{robot}::ROBOT_JOB.nCycles"]) for robot in ROBOTS]

    def tips(self, robot):
        """In the frame of the robot's own base."""
        at = self.arms[robot].links(self.angles[robot])["tool0"]
        at = numpy.linalg.inv(self.arms[robot].base) @ at
        return at[:, :3, 3] + TOOL * at[:, :3, 2]

    def motions(self, robot, begin, end):
        """The periods of the first set points of all motions from one place to another, and of the last ones."""
        tips = self.tips(robot)
        moves = numpy.append(numpy.any(numpy.diff(self.angles[robot], axis=0) != 0, axis=1), False)
        first = numpy.flatnonzero(moves & ~numpy.insert(moves[:-1], 0, False))
        last = numpy.flatnonzero(~moves & numpy.insert(moves[:-1], 0, False))
        return [(a, b) for a, b in zip(first, last)
                if numpy.linalg.norm(tips[a] - begin) < 1e-5 and numpy.linalg.norm(tips[b] - end) < 1e-5]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", type=pathlib.Path, required=True)
    parser.add_argument("--example", type=pathlib.Path, required=True)
    parser.add_argument("--io-module", required=True)
    options = parser.parse_args()
    options.bin, options.example = options.bin.resolve(), options.example.resolve()
    with tempfile.TemporaryDirectory() as one, tempfile.TemporaryDirectory() as other:
        run = Run(options, pathlib.Path(one), True, 120)
        alone = Run(options, pathlib.Path(other), False, 30)
    apart = nearest(*run.arms, *run.angles, 0.2) - GRID / 2 ** 0.5
    touch = nearest(*alone.arms, *alone.angles)
    waited = [sum(a != b == other for a, b in zip(waits, waits[1:])) for waits, other in zip(run.waits, reversed(ROBOTS))]
    lifts = [run.motions(robot, TRAY, LIFTED) for robot in (0, 1)]
    lowers = [run.motions(robot, LIFTED, TRAY) for robot in (0, 1)]
    tips = [run.tips(robot) for robot in (0, 1)]
    slant = max((abs(tips[0][a:b + 1, 2] - tips[1][a:b + 1, 2]).max() for a, b in lifts[0] + lowers[0]), default=1)
    print(f"{len(run.waits[0])} periods: at least {1000 * apart:.1f} mm apart; cycles {run.cycles}, waits {waited}; the tray was lifted "
          f"{len(lifts[0])} times, within {1000 * slant:.6f} mm; without other_robots {1000 * touch:.1f} mm apart, cycles {alone.cycles}")
    assert apart > 0.01, apart
    assert min(run.cycles) >= 4, run.cycles
    assert min(waited) >= 1, waited
    assert len(lifts[0]) >= 4 and lifts[0] == lifts[1], lifts
    assert len(lowers[0]) >= 4 and lowers[0] == lowers[1], lowers
    assert slant < 1e-6, slant
    assert touch <= 0, "the robots do not need each other's space, so nothing was tested"


if __name__ == "__main__":
    main()
