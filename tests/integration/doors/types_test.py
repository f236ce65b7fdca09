#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Types that `glb2idl --python` writes: mypy takes a right program and finds each mistake of a wrong one, and the right
program does on a node what its types say."""

import os
import pathlib
import re
import subprocess
import sys
import unittest

from doors_node import OPTIONS, NodeTest, indurop

HERE = pathlib.Path(__file__).parent
RIGHT = """
from typing import Sequence
import indurop
from doors_types import Mode, Variables, places_t

def use(node: indurop.Node | indurop.RemoteNode) -> tuple[int, float, Mode]:
    v = Variables(node)
    count: int = v["doors::count"]
    twice: float = v["twice"]
    place: places_t = v["places"][1]
    name: str = place.name + v["places[1].name"]
    v["gain"] = 2
    v["doors::places[1]"] = {"x": 2.5, "valid": True}
    v["places[1].x"] = place.y + 1
    v["mode"] = Mode.AUTO
    v["mode"] = "MANUAL"
    v["grid"] = [[1, 2, 3], [4, 5, 6]]
    row: Sequence[int] = v["grid[1]"]
    v["text"] = name + "!"
    gain = v.variable("gain")
    gain.write(count + row[2], reason="trial")
    unit: str = gain.unit
    value: float = gain.value
    for twice in v.variable("twice").watch(timeout=60):
        break
    return (len(unit), value, v["mode"])
"""
WRONG = """
import indurop
from doors_types import Mode, Variables
v = Variables(indurop.node())
a: str = v["doors::count"]  # wrong
b = v["coun"]  # wrong
c: int = v["places"][1].x  # wrong
d = v["places"][1].z  # wrong
v["gain"] = "much"  # wrong
v["places[1]"] = {"x": 2.5, "z": 1}  # wrong
v["places[1]"] = {"x": "far"}  # wrong
v["mode"] = "OFFF"  # wrong
v["grid"] = [1, 2, 3]  # wrong
v["text"] = 5  # wrong
e = v.variable("gian")  # wrong
f: str = v.variable("gain").value  # wrong
g: int = v["places[3].x"]  # wrong
h: Mode = v["grid"]  # wrong
"""


class Types(NodeTest):
    def setUp(self):
        super().setUp()
        subprocess.run([OPTIONS.glb2idl, "-o", self.work / "out", "--python", self.work / "doors_types.py",
                        HERE / "doors.glb"], check=True)

    def mypy(self, name, text):
        """Returns the lines with errors, and what mypy says."""
        (self.work / name).write_text(text)
        done = subprocess.run([OPTIONS.mypy, "--strict", "--cache-dir", self.work / "cache", "--config-file",
                               HERE / "mypy.ini", name], cwd=self.work, capture_output=True, text=True, check=False,
                              env={**os.environ, "MYPYPATH": OPTIONS.package})
        found = re.findall(r"^([\w./]+):(\d+): error", done.stdout, re.MULTILINE)
        return [int(line) for file, line in found if file == name], done.stdout + done.stderr

    def test_mypy_and_the_node_agree(self):
        lines, said = self.mypy("right.py", RIGHT)
        self.assertIn("Success", said)
        wrong = [i for i, line in enumerate(WRONG.splitlines(), 1) if line.endswith("# wrong")]
        lines, said = self.mypy("wrong.py", WRONG)
        self.assertEqual(sorted(set(lines)), wrong, said)
        sys.path.insert(0, str(self.work))
        from right import use  # pylint: disable=import-outside-toplevel
        from doors_types import Mode  # pylint: disable=import-outside-toplevel
        count = self.node["count"]
        self.node["gain"] = 0
        self.node["places[1]"] = {"y": 3, "name": "tool"}
        with self.assertRaises(indurop.OutOfRange):
            use(self.node)  # count is beyond the range of gain
        self.assertGreater(count, 0)
        place = self.node["places"][1]
        self.assertEqual((place.x, place.y, place.valid, place.name), (4, 3, True, "tool"))
        self.assertEqual(self.node["text"], "tooltool!")
        self.assertEqual(self.node["mode"], Mode.MANUAL)
        self.assertEqual(self.node["grid"], [[1, 2, 3], [4, 5, 6]])
        self.assertEqual(self.node["gain"], 2)


if __name__ == "__main__":
    unittest.main(verbosity=2)
