#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A plant of two architectures: the sensor board of examples/two_boards is this machine, its control board an ARM64 machine in
QEMU (machine.py), and between them is a cable. The plant is deployed with a file for each; the loop closes through both; the
ARM64 machine loses power, and a new one with an empty disk takes its place; a release of the platform is deployed to both, and
taken back. As root, for a network of its own.
plant_test.py BUILD BUILD-ARM64"""

import contextlib
import ctypes
import fcntl
import json
import os
import pathlib
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent / "cmake/arm64_root.sh"
CLONE_NEWNET = 0x40000000
TUNSETIFF, IFF_TAP, IFF_NO_PI = 0x400454CA, 0x0002, 0x1000
PATIENCE = 900  # seconds; the other machine is translated
PLANT = """<plant name="mixed"><types>${{arch}}/libstation_types.so</types>{boards}</plant>"""
BOARD = """<board name="{name}" arch="{arch}"><module><filename>{folder}/{module}.so</filename><moduletype>thread</moduletype>
<operationtype>periodic</operationtype><period>10ms</period><priority>1</priority></module></board>
"""
MACHINE = """export HOME=/tmp PATH={build}/bin:$PATH INDUROP_STATE_DIR=/tmp/state
ip addr add 10.77.1.2/24 dev eth0; ip link set eth0 up
date -s @{now}
{build}/bin/indurop-agent --board arm --interface eth0 >/mnt/agent.log 2>&1
"""
build = arm64 = None


def cable():
    """A network card of this machine; what it sends and receives is read and written at the file descriptor."""
    if ctypes.CDLL(None, use_errno=True).unshare(CLONE_NEWNET) != 0:
        raise OSError(ctypes.get_errno(), "unshare")
    wire = os.open("/dev/net/tun", os.O_RDWR)
    fcntl.ioctl(wire, TUNSETIFF, struct.pack("16sH", b"wire", IFF_TAP | IFF_NO_PI))
    for words in ("link set lo up", "addr add 10.77.1.1/24 dev wire", "link set wire up"):
        subprocess.run(["ip", *words.split()], check=True)
    return wire


class TwoArchitectures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        os.environ["INDUROP_STATE_DIR"] = str(cls.folder / "state")
        cls.reports = arm64 / "plant"  # the Debian of the machine sees this tree, not /tmp
        cls.reports.mkdir(exist_ok=True)
        cls.wire = cable()
        cls.machine = cls.power_on()
        cls.addClassCleanup(lambda: cls.power_off())
        cls.addClassCleanup(lambda: subprocess.run([build / "bin/indurop", "clean", "--node", "x86"], check=False))
        with open(cls.folder / "agent.log", "wb") as log:
            agent = subprocess.Popen([build / "bin/indurop-agent", "--board", "x86", "--interface", "wire"],
                                     stdout=subprocess.DEVNULL, stderr=log)
        cls.addClassCleanup(lambda: (agent.terminate(), agent.wait()))

    @classmethod
    def power_on(cls):
        (cls.reports / "test.sh").write_text(MACHINE.format(build=arm64, now=int(time.time())))
        with open(cls.reports / "console.log", "wb") as log:
            return subprocess.Popen([ROOT, "python3", HERE / "machine.py", cls.reports, str(cls.wire)], stdin=subprocess.DEVNULL,
                                    stdout=log, stderr=log, pass_fds=[cls.wire], start_new_session=True)

    @classmethod
    def power_off(cls):
        with contextlib.suppress(ProcessLookupError):
            os.killpg(cls.machine.pid, 9)
        cls.machine.wait()

    def manifest(self, folder_of_arm):
        """A plant whose ARM64 board gets the file of that folder."""
        for folder, tree in (("amd64", build), ("arm64", arm64)):
            (self.folder / folder).mkdir(exist_ok=True)
            for module in ("table", "controller"):
                shutil.copy(tree / f"examples/two_boards/{module}.so", self.folder / folder)
            shutil.copy(next((tree / "examples/external").rglob("libstation_types.so")), self.folder / folder)
        boards = BOARD.format(name="x86", arch="amd64", module="table", folder="amd64")
        boards += BOARD.format(name="arm", arch="arm64", module="controller", folder=folder_of_arm)
        (self.folder / "plant.xml").write_text(PLANT.format(boards=boards))
        return str(self.folder / "plant.xml")

    def run_tool(self, *words):
        return subprocess.run([build / "bin/indurop", *words], capture_output=True, text=True, timeout=PATIENCE, check=False)

    def value(self, name):
        done = self.run_tool("get", "--node", "x86", name)
        return float(done.stdout) if done.returncode == 0 else None

    def until(self, what, right):
        end = time.monotonic() + PATIENCE
        while not right():
            if time.monotonic() > end:
                logs = "".join(path.read_text(errors="replace")[-3000:] for path in (self.folder / "agent.log", self.reports / "agent.log",
                                                                                      self.reports / "console.log") if path.exists())
                self.fail(f"{what} did not come; the agents and the machine said:\n{logs}")
            time.sleep(0.5)

    def loop_closes(self):
        """The controller of the other board has seen what the table measured just now, and moves it."""
        before = self.value("echo") or 0
        self.until("the echo of the other board", lambda: (self.value("echo") or 0) > before + 50)

    def test_1_wrong_files_are_refused(self):
        done = self.run_tool("deploy", self.manifest("amd64"), "--interface", "wire")
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertIn("'amd64/controller.so' is built for x86-64, the board is arm64", done.stderr)

    def test_2_each_board_gets_its_file(self):
        self.until("the ARM64 machine", lambda: "arm " in self.run_tool("boards", "--interface", "wire").stdout)
        manifest = self.manifest("arm64")

        def deployed():
            return "is committed" in self.run_tool("deploy", manifest, "--interface", "wire", "--timeout", "2min").stdout

        # A machine that is too slow to be healthy in time takes its deployment back: it is given again.
        self.until("the deployment", deployed)
        self.loop_closes()
        # It has no type of these variables, which the node says, but it is loaded.
        self.assertNotIn("cannot load the types library", (self.reports / "agent.log").read_text(errors="replace"))

    def test_3_a_machine_with_an_empty_disk_takes_the_place_of_one_that_lost_power(self):
        self.power_off()
        seen = self.value("echo")
        self.until("the fallback of the torque", lambda: self.value("torque") == 0)
        type(self).machine = self.power_on()
        self.until("the controller", lambda: (self.value("echo") or 0) > seen + 50)
        self.loop_closes()

    def releases(self):
        said = self.run_tool("platform", "status", "--interface", "wire", "-o", "json").stdout
        return {board["board"]: (board["release"], board["state"]) for board in json.loads(said)["boards"]} if said else {}

    def installations(self):
        """What boards need of both builds, without debug information: the machine keeps its state in memory."""
        for tree, strip in ((build, ["strip"]), (arm64, [ROOT, "aarch64-linux-gnu-strip"])):
            to = self.reports / "release" / tree.name
            shutil.rmtree(to, ignore_errors=True)
            for name in ("bin/indurop", "bin/indurop-agent", "bin/indurop-node", "lib/libindurop.so.0.2"):
                (to / name).parent.mkdir(parents=True, exist_ok=True)
                subprocess.run([*strip, "-o", to / name, tree / name], check=True)
            yield str(to)

    def test_4_one_release_updates_both_boards_and_they_go_back(self):
        self.until("both boards", lambda: set(self.releases()) == {"x86", "arm"})
        before = self.releases()
        release = str(self.folder / "next.release")
        packed = self.run_tool("platform", "pack", *self.installations(), "--release-version", "99.1", "-o", release)
        self.assertIn("release 99.1 for amd64 and arm64", packed.stdout + packed.stderr)
        patience = ("--interface", "wire", "--health", "20s", "--timeout", "10min")
        # As with the plant: a machine that is too slow goes back, and gets it again.
        self.until("the release", lambda: "is committed" in self.run_tool("platform", "deploy", release, *patience).stdout)
        self.until("the new release", lambda: self.releases() == {"x86": ("99.1", "running"), "arm": ("99.1", "running")})
        self.loop_closes()
        self.until("the way back", lambda: "is committed" in self.run_tool("platform", "back", *patience).stdout)
        self.until("the old release", lambda: self.releases() == before)
        self.loop_closes()


if __name__ == "__main__":
    if os.geteuid() != 0:
        sys.exit("needs root, for a network of its own")
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # the machine ends with this program
    build, arm64 = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
    unittest.main(argv=[sys.argv[0], "-v", *sys.argv[3:]])
