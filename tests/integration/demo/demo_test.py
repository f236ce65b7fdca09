#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""demo_test.py INDUROP: a stranger types `indurop demo`. The arm moves and its page answers, in the time of a cup of tea and
with or without rights; Ctrl-C leaves nothing behind. In a network of its own, for the ports of the cell."""

import os
import pathlib
import re
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest
import urllib.request

PATIENCE = 120  # seconds; two are enough on an idle machine
program = pathlib.Path()


def own_network():
    """Starts this test again in a network namespace; skips where there is none."""
    if os.environ.get("INDUROP_DEMO_NETWORK") != "yes":
        way = ["unshare", "-n"] if os.geteuid() == 0 else ["unshare", "-r", "-n"]
        if subprocess.run([*way, "true"], stderr=subprocess.DEVNULL, check=False).returncode != 0:
            print("skipped: no network namespaces")
            sys.exit(77)
        os.environ["INDUROP_DEMO_NETWORK"] = "yes"
        os.execvp("unshare", [*way, sys.executable, *sys.argv])
    subprocess.run(["ip", "link", "set", "lo", "up"], check=True)


class Demo:
    """`indurop demo` in the background; what it prints is in a file."""

    def __init__(self, folder, *words, before=(), environment=()):
        self.folder = folder
        self.temporary = folder / "tmp"
        self.temporary.mkdir(mode=0o777)
        self.temporary.chmod(0o777)
        folder.chmod(0o755)
        self.log = folder / "log"
        self.environment = {**os.environ, "TMPDIR": str(self.temporary), "HOME": str(self.temporary), **dict(environment)}
        with self.log.open("wb") as log:
            self.process = subprocess.Popen([*before, program, "demo", *words], env=self.environment, cwd=folder,
                                            stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT)

    def said(self):
        return self.log.read_text(errors="replace")

    def until(self, right, what):
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            found = right()
            if found:
                return found
            if self.process.poll() is not None:
                raise AssertionError(f"ended with {self.process.returncode} before {what}:\n{self.said()}")
            time.sleep(0.05)
        raise AssertionError(f"never: {what}\n{self.said()}")

    def address(self):
        return self.until(lambda: re.search(r"http://\S+", self.said()), "an address is printed").group()

    def node(self):
        return self.until(self.nodes, "its node runs")[0]

    def nodes(self):
        listed = subprocess.run([program, "nodes", "--all", "-o", "csv"], env=self.environment, text=True, capture_output=True,
                                check=False).stdout
        return re.findall(r"^(demo\d+),running,", listed, re.MULTILINE)

    def get(self, node, variable):
        return subprocess.run([program, "get", "--node", node, variable], env=self.environment, text=True,
                              capture_output=True, check=False).stdout

    def end(self, number):
        self.process.send_signal(number)
        return self.process.wait(PATIENCE)


class DemoTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def start(self, *words, **more):
        demo = Demo(self.folder, *words, **more)
        self.addCleanup(lambda: demo.process.poll() is None and demo.end(signal.SIGKILL))
        return demo

    def moves(self, demo):
        node = demo.node()
        first = demo.get(node, "ROBOT_ARM.joint")
        demo.until(lambda: demo.get(node, "ROBOT_ARM.joint") not in ("", first), "the arm moves")

    def test_1_the_arm_moves_and_the_page_answers(self):
        sut = self.start()
        address = sut.address()
        self.moves(sut)
        with urllib.request.urlopen(address, timeout=PATIENCE) as page:
            self.assertIn("<html", page.read().decode().lower())
        self.assertEqual(sut.end(signal.SIGTERM), 143, sut.said())
        self.assertEqual(sut.nodes(), [])
        self.assertEqual(list(sut.temporary.iterdir()), [], "the copy of the example is removed")

    def test_2_a_user_without_rights_gets_a_message_about_what_is_missing(self):
        if os.geteuid() != 0 or not shutil.which("setpriv"):
            self.skipTest("only root can become a user without rights")
        sut = self.start(before=("setpriv", "--reuid=65534", "--regid=65534", "--clear-groups", "--bounding-set=-all",
                                 "prlimit", "--rtprio=0", "--memlock=65536"))
        sut.address()  # on a busy machine its arm may wait for its field devices
        sut.node()
        self.assertIn("no right to real time", sut.said())
        self.assertEqual(sut.end(signal.SIGTERM), 143, sut.said())

    def test_3_a_folder_is_kept(self):
        sut = self.start("--folder", "kept")
        sut.address()
        self.assertEqual(sut.end(signal.SIGTERM), 143, sut.said())
        self.assertTrue((self.folder / "kept/module.xml").exists())

    def test_4_without_built_examples_it_says_where_they_are(self):
        alone = self.folder / "bin"
        alone.mkdir()
        shutil.copy(program, alone)
        done = subprocess.run([alone / "indurop", "demo"], text=True, capture_output=True, check=False,
                              env={**os.environ, "LD_LIBRARY_PATH": str(program.parent.parent / "lib")})
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("indurop-examples", done.stderr)

    def test_5_a_folder_that_cannot_be_written_is_an_error(self):
        done = subprocess.run([program, "demo", "--folder", "/proc/none"], text=True, capture_output=True, check=False)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("/proc/none", done.stderr)

    def test_6_a_second_cell_says_what_is_in_its_way(self):
        first = socket.create_server(("127.0.0.1", 1502))
        self.addCleanup(first.close)
        done = subprocess.run([program, "demo"], text=True, capture_output=True, check=False)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("TCP port 1502", done.stderr)
        self.assertEqual(done.stdout, "", "nothing was started")


if __name__ == "__main__":
    own_network()
    program = pathlib.Path(sys.argv.pop(1)).resolve()
    unittest.main(verbosity=2)
