# SPDX-License-Identifier: Apache-2.0
"""A robot cell (examples/robot_cell) that runs somewhere, as its tests see it."""

import argparse
import csv
import json
import os
import subprocess
import tempfile
import time

PATIENCE = 90  # seconds until whatever is waited for has happened


def read_arguments(description, **paths):
    """What was built, from the command line: for each of `paths` an option, whose value says what it is. They are absolute, because
    programs run in other folders."""
    parser = argparse.ArgumentParser(description=description)
    for name, what in paths.items():
        parser.add_argument("--" + name.replace("_", "-"), required=True, type=os.path.abspath, help=what)
    return parser.parse_args()


class Cell:
    """A running cell. `station` has the PLC's points and the surroundings, `robot` the robot task."""

    def __init__(self, arguments, folder, station, robot):
        self.arguments = arguments
        self.folder = folder
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

    def changes(self, work):
        """What happened during work(), in order: every change of the robot's state and of its job."""
        with tempfile.TemporaryFile("w+") as output:  # a pipe would fill up while it is not read
            recording = subprocess.Popen([f"{self.arguments.bin}/indurop", "watch", "--node", self.robot, "ROBOT_MODULE_STATE.eState",
                                          "ROBOT_JOB.name", "--hz", "100", "-o", "csv"], stdout=output, text=True)
            try:
                work()
            finally:
                recording.terminate()
                recording.wait(timeout=30)
            output.seek(0)
            rows = list(csv.reader(output))[1:]
        changes = []
        for row in rows:
            now = tuple(row[1:])
            if len(now) == 2 and (not changes or changes[-1] != now):
                changes.append(now)
        return changes


def jobs(changes):
    """Names of the jobs one after the other; one that runs again after another counts again."""
    names = [name for _, name in changes if name]
    return [name for i, name in enumerate(names) if i == 0 or names[i - 1] != name]
