#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A Python program as a non-real-time module: the node starts it, starts it again after a fault, and ends it with itself."""

import json
import os
import pathlib
import sys
import unittest

from doors_node import OPTIONS, NodeTest, wait_until

PROGRAM = """#!{python}
import os
import pathlib
import sys

import indurop

node = indurop.node(write=True)
pathlib.Path("{work}/pid").write_text(str(os.getpid()))
first = node["gain"] == 1.5
node["gain"] = 7 if first else 8
if first:
    sys.exit("a fault of the test")
for count in node.variable("count").watch():
    node["grid[0][0]"] = count % 100
"""
MODULE = """<module><filename>./soft.py</filename><moduletype>process</moduletype><operationtype>non-real</operationtype>
<access><read>doors::count</read><write>doors::gain</write><write>doors::grid</write></access></module></root>"""


class Soft(NodeTest):
    def configuration(self):
        os.environ["PYTHONPATH"] = OPTIONS.package
        program = self.work / "soft.py"
        program.write_text(PROGRAM.format(python=sys.executable, work=self.work))
        program.chmod(0o755)
        return super().configuration().replace("</root>", MODULE)

    def module(self):
        found = json.loads(self.indurop("status", "--node", self.name, "-o", "json"))["modules"]
        return next(one for one in found if one["name"] == "soft")

    def test_starts_again_and_ends_with_the_node(self):
        wait_until("it was started again", lambda: self.node["gain"] == 8)
        wait_until("it follows the count", lambda: self.node["grid[0][0]"] != 0)
        self.assertEqual((self.module()["state"], self.module()["restarts"]), ("running", 1))
        pid = int((self.work / "pid").read_text())
        self.assertTrue(pathlib.Path(f"/proc/{pid}").exists())
        self.stop()
        wait_until("it has ended", lambda: not pathlib.Path(f"/proc/{pid}").exists())
        uses = self.indurop("check", "module.xml", "-o", "json")
        self.assertIn("soft", uses)


if __name__ == "__main__":
    unittest.main(verbosity=2)
