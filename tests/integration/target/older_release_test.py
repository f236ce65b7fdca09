#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""An older release and this one in one plant: examples/two_boards, whose loop closes through both boards. Boards of both releases
share values, a desk of the older one brings this one to both boards, and a desk of this one takes it back; tools of one release
read a node of the other, or name the versions. INDUROP_OLDER is the package of the older release, an indurop_*.deb; without it,
nothing is tested. As root, for namespaces."""

import argparse
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

SKIPPED = 77
PATIENCE = 120  # seconds
OTHER_VERSION = 8  # exit code of `indurop`
NAMESPACES = ("unshare", "--mount", "--net", "--ipc", "--pid", "--mount-proc", "--fork", "--kill-child")
options = older = None


class OlderRelease(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        for words in ("ip link set lo up multicast on", "ip route add 224.0.0.0/4 dev lo", "mount -t tmpfs tmp /dev/shm"):
            subprocess.run(words.split(), check=True)
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        os.environ["INDUROP_STATE_DIR"] = str(cls.folder / "state")
        cls.agents = {}

    @classmethod
    def start(cls, board, programs):
        """The board's agent; its node goes on if the agent before is there no more."""
        agent = cls.agents.get(board)
        if agent is not None:
            agent.terminate()
            agent.wait()
        with open(cls.folder / f"{board}.log", "ab") as log:
            # pylint: disable-next=consider-using-with
            cls.agents[board] = subprocess.Popen([programs / "indurop-agent", "--board", board, "--one-host"],
                                                 stdin=subprocess.DEVNULL, stdout=log, stderr=log)

    def run_tool(self, programs, *words):
        return subprocess.run([programs / "indurop", *words], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                              timeout=PATIENCE, check=False)

    def until(self, what, right):
        end = time.monotonic() + PATIENCE
        while not right():
            if time.monotonic() > end:
                logs = "".join(f"{path.name}:\n{path.read_text(errors='replace')[-3000:]}" for path in self.folder.glob("*.log"))
                self.fail(f"{what} did not come; the agents said:\n{logs}")
            time.sleep(0.2)

    def succeeds(self, programs, *words):
        done = self.run_tool(programs, *words, "--one-host", "--health", "2s")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertIn("is committed", done.stdout)

    def loop_closes(self, programs):
        """The controller of the other board has seen what the table measured just now; `programs` are those of the board."""

        def echo():
            done = self.run_tool(programs, "get", "--node", "sensor", "echo")
            return float(done.stdout) if done.returncode == 0 else 0

        before = echo()
        self.until("the echo of the other board", lambda: echo() > before + 50)

    def releases_are(self, release):
        def right():
            said = self.run_tool(options.bin, "platform", "status", "--one-host", "-o", "json").stdout
            boards = json.loads(said)["boards"] if said else []
            return len(boards) == 2 and all((board["release"], board["state"]) == (release, "running") for board in boards)

        self.until(f"release {release} on both boards", right)

    def test_1_boards_of_both_share_values(self):
        self.start("sensor", older)
        self.start("control", options.bin)
        self.until("both boards", lambda: len(json.loads(
            self.run_tool(options.bin, "boards", "--one-host", "-o", "json").stdout or '{"boards": []}')["boards"]) == 2)
        self.succeeds(options.bin, "deploy", str(options.plant))
        self.loop_closes(older)

    def test_2_tools_read_a_node_of_the_other_one_or_name_the_versions(self):
        for programs, node in ((older, "control"), (options.bin, "sensor")):
            for words in (("status",), ("vars",), ("get", "echo")):
                done = self.run_tool(programs, *words, "--node", node)
                print(words, node, done.returncode, (done.stdout + done.stderr).strip().split("\n")[0])
                self.assertIn(done.returncode, (0, OTHER_VERSION), done.stderr)
                if done.returncode == OTHER_VERSION:
                    self.assertIn("another version of InduRoP", done.stderr)

    def test_3_a_desk_of_the_older_one_brings_this_one_to_both(self):
        # What the agent of this release has left is taken over by that of the older one.
        self.start("control", older)
        self.loop_closes(older)
        release = str(self.folder / "next.release")
        packed = self.run_tool(options.bin, "platform", "pack", str(options.release), "--release-version", "99.1", "-o", release)
        self.assertEqual(packed.returncode, 0, packed.stderr)
        self.succeeds(older, "platform", "deploy", release)
        self.releases_are("99.1")
        self.loop_closes(options.bin)

    def test_4_a_desk_of_this_one_takes_it_back(self):
        self.succeeds(options.bin, "platform", "back")
        self.releases_are(self.run_tool(older, "--version").stdout.split()[-1])
        self.loop_closes(older)


def main():
    global options, older
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", type=pathlib.Path, required=True)
    parser.add_argument("--release", type=pathlib.Path, required=True, help="the installation of which a release is made")
    parser.add_argument("--plant", type=pathlib.Path, required=True)
    options, rest = parser.parse_known_args()
    package = os.environ.get("INDUROP_OLDER")
    if not package or os.geteuid() != 0:
        print("skipped: needs root" if package else "skipped: INDUROP_OLDER names no package of an older release")
        sys.exit(SKIPPED)
    if os.getpid() != 1:
        sys.exit(subprocess.run([*NAMESPACES, sys.executable, *sys.argv], check=False).returncode)
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(["dpkg-deb", "-x", package, folder], check=True)
        older = pathlib.Path(folder, "usr/bin")
        for libraries in pathlib.Path(folder, "usr/lib").glob("*-linux-gnu"):
            # They are found where the package would install them, in these namespaces only.
            installed = pathlib.Path("/usr/lib", libraries.name)
            subprocess.run(["mount", "-t", "overlay", "overlay", "-o", f"lowerdir={libraries}:{installed}", installed], check=True)
        unittest.main(argv=[sys.argv[0], "-v", *rest], exit=False)


if __name__ == "__main__":
    main()
