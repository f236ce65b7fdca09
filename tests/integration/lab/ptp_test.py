#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Two boards as virtual machines with a clock each: what the boards of a plant report of their clocks without a source, when linuxptp
keeps one by the other, and when that source is lost. Needs root, QEMU, mmdebstrap and Debian's linuxptp, which is downloaded."""

import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

from lab_in_test import SKIPPED, Lab

APART = 3  # seconds, at first
PERIOD_MS = 50  # of the plant
SHARE = 4  # part of the period by which clocks may differ
GROWS_TO_NS = 20_000_000  # the kernel adds 0.5 ms per second to the error of a clock that is not corrected
PTP = "ptp4l -i eth0 -S -m --step_threshold=0.001 --tx_timestamp_timeout=1000"
options = None


class Ptp(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.lab = lab = Lab(options.bin)
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        lab.folder = folder.name
        cls.addClassCleanup(lab, "down")
        source = options.examples / "two_boards"
        for module in source.glob("*.so"):
            shutil.copy(module, lab.folder)
        plant = (source / "plant.xml").read_text()
        pathlib.Path(lab.folder, "plant.xml").write_text(plant.replace("1ms", f"{PERIOD_MS}ms"))
        lab("up", "laptop")
        lab("--vm", "up", "sensor", "control")
        for board in ("sensor", "control"):
            with open(options.ptp4l, "rb") as program:
                lab("exec", board, "sh", "-c", "cat >/usr/sbin/ptp4l && chmod 755 /usr/sbin/ptp4l", stdin=program)

    def step(self, board, seconds):
        """Changes the clock of a board; it stays unsynchronized or synchronized, as it says."""
        self.lab("exec", board, "sh", "-c", f"date -s \"@$(date +%s.%N | awk '{{printf \"%.6f\", $1 + {seconds}}}')\" >/dev/null")

    def ptp(self, board, *more):
        self.lab("exec", board, "systemd-run", "-q", "--unit", "ptp", *PTP.split(), *more)

    def locked(self, board):
        self.lab.until(lambda said: re.findall(r"master offset +-?\d+ s(\d)", said)[-3:] == ["2"] * 3,
                       "exec", board, "journalctl", "-q", "--no-pager", "-u", "ptp", "-n", "50")

    def status(self, board):
        return json.loads(self.lab("exec", board, "indurop", "status", "--node", board, "-o", "json"))["mirror"]

    @staticmethod
    def known(mirror):
        return mirror["boards"][0]["clock_offset_ns"] is not None

    def until(self, board, right):
        """What the mirror of a board reports, as soon as it is right."""
        self.lab.until(lambda said: right(json.loads(said)["mirror"]), "exec", board, "indurop", "status", "--node", board, "-o", "json")
        return self.status(board)

    def test_1_clocks_without_a_source_are_not_synchronized(self):
        lab = self.lab
        self.step("control", APART)
        for board in ("sensor", "control"):
            lab.agent(board)
        lab.until(lambda said: said.count("empty") == 2, "exec", "laptop", "indurop", "boards")
        lab.until(lambda said: "is committed" in said, "exec", "laptop", "indurop", "deploy", "--timeout", "60s", "plant.xml")
        said = lab.until(lambda said: re.search(r"clocks [\d.]+ s apart", said), "exec", "sensor", "indurop", "status", "--node", "sensor")
        self.assertIn("not synchronized", said)
        self.assertNotIn("check PTP or NTP", said)
        apart = abs(self.status("sensor")["boards"][0]["clock_offset_ns"])
        self.assertAlmostEqual(apart / 1e9, APART, delta=1)

    def test_2_clocks_that_linuxptp_keeps_agree(self):
        self.ptp("sensor")
        self.ptp("control", "--slaveOnly=1")
        self.locked("control")
        self.until("control", lambda mirror: mirror["clock_synchronised"])
        for _ in range(5):
            here = self.until("control", lambda mirror: mirror["clock_synchronised"] and self.known(mirror))
            peer = here["boards"][0]
            self.assertLess(abs(peer["clock_offset_ns"]), peer["clock_bound_ns"] + PERIOD_MS * 1e6 / SHARE)
        print(f"apart by {peer['clock_offset_ns'] / 1e6:.3f} ms, +-{peer['clock_bound_ns'] / 1e6:.3f} ms")
        # Ticks are at multiples of the period by the clock, so the schedules have the same phase, within the clocks' difference.
        period = PERIOD_MS * 1_000_000
        phase = (here["epoch_wall_ns"] - peer["epoch_wall_ns"] + period // 2) % period - period // 2
        self.assertLess(abs(phase), period / SHARE)
        print(f"phases apart by {phase / 1e6:.3f} ms")
        # The clock of the board that keeps the other one has no source of its own, and its kernel says so.
        self.assertFalse(self.status("sensor")["clock_synchronised"])

    def test_3_a_lost_source_is_seen_by_the_error_that_grows(self):
        self.until("control", lambda mirror: mirror["clock_error_ns"] < GROWS_TO_NS / 2)
        self.lab("exec", "sensor", "systemctl", "stop", "ptp")
        self.until("control", lambda mirror: mirror["clock_error_ns"] > GROWS_TO_NS)
        self.ptp("sensor")
        self.until("control", lambda mirror: mirror["clock_error_ns"] < GROWS_TO_NS / 2)


def main():
    global options
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", type=pathlib.Path, required=True)
    parser.add_argument("--examples", type=pathlib.Path, required=True)
    options, rest = parser.parse_known_args()
    missing = [tool for tool in ("qemu-system-x86_64", "mmdebstrap", "ssh", "ip", "apt-get") if not shutil.which(tool)]
    if missing or os.geteuid() != 0:
        print("skipped: needs root" if not missing else f"skipped: not installed: {', '.join(missing)}")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["apt-get", "-qq", "download", "linuxptp"], cwd=folder, check=True)
        subprocess.run(["dpkg-deb", "-x", next(pathlib.Path(folder).glob("*.deb")), folder + "/x"], check=True)
        options.ptp4l = pathlib.Path(folder, "x/usr/sbin/ptp4l")
        unittest.main(argv=[sys.argv[0], "-v", *rest])


if __name__ == "__main__":
    main()
