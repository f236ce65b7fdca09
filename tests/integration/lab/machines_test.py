#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Boards of a lab as virtual machines, together with one that is a network namespace: a plant is deployed to them, one loses its cable,
one its power, and boots into what it ran. A machine with counted time loses no tick. Needs root, QEMU and mmdebstrap."""

import argparse
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from lab_in_test import SKIPPED, Lab

options = None


class Machines(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.lab = lab = Lab(options.bin)
        cls.folder = tempfile.TemporaryDirectory()
        lab.folder = cls.folder.name
        cls.addClassCleanup(cls.folder.cleanup)
        cls.addClassCleanup(lab, "down")
        source = options.examples / "two_boards"
        for module in source.glob("*.so"):
            shutil.copy(module, lab.folder)
        plant = (source / "plant.xml").read_text()
        # Translated instructions are slow: the plant runs at a pace that such a machine can keep.
        pathlib.Path(lab.folder, "plant.xml").write_text(plant.replace("1ms", "50ms"))
        lab("up", "laptop")
        lab("--vm", "up", "sensor", "control")

    def test_1_a_command_runs_on_the_machine_as_it_was_typed(self):
        self.assertIn("PREEMPT_RT", self.lab("exec", "sensor", "uname", "-v"))
        self.assertEqual(self.lab("exec", "sensor", "printf", "%s|", "it's", "a  b", "$HOME", ""), "it's|a  b|$HOME||")
        self.assertEqual(self.lab("exec", "sensor", "cat", input="typed\n"), "typed\n")
        self.lab("exec", "control", "sh", "-c", "exit 7", code=7)
        self.assertEqual(self.lab("exec", "control", "hostname").strip(), "control")
        cards = self.lab("exec", "control", "ls", "/sys/class/net").split()
        self.assertEqual(cards, ["eth0", "lo"])

    def test_2_what_is_wrong_is_said(self):
        self.assertIn("there is a board sensor already", self.lab("up", "sensor", code=2))
        self.assertIn("laptop is a network namespace", self.lab("on", "laptop", code=2))
        self.assertIn("add --vm", self.lab("--counted", "up", "x", code=2))
        self.assertIn("no number of processors", self.lab("--vm", "--cores", "many", "up", "x", code=2))
        self.assertNotIn("x ", self.lab("list"))

    def test_3_a_plant_runs_and_survives_cable_and_power(self):
        lab = self.lab
        for board in ("sensor", "control"):
            lab.agent(board)
        lab.until(lambda said: said.count("empty") == 2, "exec", "laptop", "indurop", "boards")
        # A board that is too slow to answer or to start its node in time takes its deployment back: it is given again.
        lab.until(lambda said: "is committed" in said, "exec", "laptop", "indurop", "deploy", "--timeout", "60s", "plant.xml")
        lab("exec", "control", "indurop", "set", "target", "5")
        moved = r"angle: 0*[1-9]|angle: 0\.0*[1-9]"
        lab.until(lambda said: re.search(moved, said), "exec", "sensor", "indurop", "get", "encoder")

        lab("unplug", "sensor")
        lab.until(lambda said: "sensor " not in said and "control" in said, "exec", "laptop", "indurop", "boards")
        self.assertIn("sensor", lab("exec", "sensor", "hostname"))  # commands need no cable
        lab("plug", "sensor")
        lab.until(lambda said: said.count("running") == 2, "exec", "laptop", "indurop", "boards")

        lab("off", "control")
        self.assertRegex(lab("list"), r"control 10\.77\.0\.3 virtual machine, off")
        self.assertIn("indurop-lab on control", lab("exec", "control", "true", code=1))
        lab("on", "control")
        lab.agent("control")
        lab.until(lambda said: said.count("two_boards") == 2, "exec", "laptop", "indurop", "boards")

    def test_4_packets_get_lost(self):
        self.lab("loss", "sensor", "30")
        self.assertIn("DROP", self.lab("exec", "sensor", "iptables", "-L", "INPUT"))
        self.lab("loss", "sensor", "0")
        self.assertNotIn("DROP", self.lab("exec", "sensor", "iptables", "-L", "INPUT"))

    def test_5_counted_time_loses_nothing(self):
        lab = self.lab
        lab("--vm", "--counted", "up", "exact")
        file = options.examples / "chapter" / "module.xml"
        lab("exec", "exact", "indurop", "run", str(file), "--detach", "--node", "exact")
        said = lab.until(lambda said: re.search(r"tick \d{5}", said), "exec", "exact", "indurop", "status", "--node", "exact")
        self.assertIn(" 0 lost ticks", said)

    def test_6_nothing_is_left(self):
        self.lab("down")
        self.assertEqual(self.lab("list"), "")
        self.assertNotIn(self.lab.name, subprocess.run(["ip", "netns"], capture_output=True, text=True, check=True).stdout)
        self.assertFalse(pathlib.Path("/var/tmp/indurop-lab", self.lab.name).exists())


def main():
    global options
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", type=pathlib.Path, required=True)
    parser.add_argument("--examples", type=pathlib.Path, required=True)
    options = parser.parse_args()
    missing = [tool for tool in ("qemu-system-x86_64", "mmdebstrap", "ssh", "ip") if not shutil.which(tool)]
    if missing or os.geteuid() != 0:
        print("skipped: needs root" if not missing else f"skipped: not installed: {', '.join(missing)}")
        sys.exit(SKIPPED)
    unittest.main(argv=[sys.argv[0], "-v"])


if __name__ == "__main__":
    main()
