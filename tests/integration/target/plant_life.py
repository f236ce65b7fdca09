#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""One life of a plant of boards b1, b2, ... on one host, from the boot on, in namespaces that power_cuts.py made. Their data is on
an ext4 file system. What is seen is printed, one JSON list in each line:

["wrong", TEXT]; ["recording", NAME, CAN_BE_READ, TEXT]; ["agent", BOARD, TEXT] of an agent and its modules; ["empty"]: nothing was
deployed yet; ["state", ...]: what the boards report while they do not agree; ["boards", {BOARD: DEPLOYMENT}], ["releases",
{BOARD: DEPLOYMENT}]: all boards are back.

Then, with --live, until the power is lost: ["records", NAME]: a recording has begun some seconds ago; ["desk", TEXT]: why a command
had no success."""

import argparse
import ctypes
import itertools
import json
import os
import pathlib
import random
import subprocess
import sys
import threading
import time

CLONE_NEWNS = 0x20000
BEGUN = 5  # seconds until a recording has to be there after a loss of power
LENGTH = "15s"  # of a recording
SIZE = 300_000  # of the data that is deployed
mutex = threading.Lock()


def say(*words):
    with mutex:
        print(json.dumps(words), flush=True)


def run(*words, seconds=300):
    return subprocess.run(["indurop", *words], stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=seconds, check=False)


def read(*words):
    """What a verb prints as JSON; None if it fails."""
    done = run(*words, "-o", "json")
    return json.loads(done.stdout) if done.returncode == 0 else None


def until(right):
    while True:
        found = right()
        if found:
            return found
        time.sleep(0.1)


class Plant:
    def __init__(self, options):
        self.disk = options.work / "disk"
        self.boards = [f"b{number + 1}" for number in range(options.boards)]
        self.manifest = options.manifest
        self.work = options.work
        self.release = options.release
        self.first = options.first
        self.state = None

    def power_on(self, file, may_repair):
        """Mounts the disk, and reads the recordings before the boards start."""
        for words in ("ip link set lo up multicast on", "ip route add 224.0.0.0/4 dev lo", "mount -t tmpfs tmp /dev/shm"):
            subprocess.run(words.split(), check=True)
        self.disk.mkdir()
        mount = ["mount", "-o", "loop", file, self.disk]
        mounted = subprocess.run(mount, capture_output=True, text=True, check=False)
        if mounted.returncode != 0 and may_repair:
            repaired = subprocess.run(["e2fsck", "-y", file], capture_output=True, text=True, check=False)
            say("repaired", repaired.stdout)
            mounted = subprocess.run(mount, capture_output=True, text=True, check=False)
        if mounted.returncode != 0:
            say("wrong", f"the file system cannot be mounted: {mounted.stderr}")
            sys.exit(1)
        os.environ["INDUROP_STATE_DIR"] = str(self.disk / "agent")
        recordings = self.disk / "recordings"
        recordings.mkdir(exist_ok=True)
        for file in sorted(recordings.glob("*.mcap")):
            done = run("recording", "info", str(file))
            say("recording", file.name, done.returncode == 0, f"{file.stat().st_size} bytes {done.stderr.strip()[-200:]}")
            file.unlink()

    def start_agents(self):
        for board in self.boards:
            # pylint: disable-next=consider-using-with
            agent = subprocess.Popen(["indurop-agent", "--board", board, "--one-host"], stdin=subprocess.DEVNULL,
                                     stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
            threading.Thread(target=self._hear, args=(board, agent.stdout), daemon=True).start()

    @staticmethod
    def _hear(board, output):
        for line in output:
            say("agent", board, line.strip())

    def wait_for_boards(self):
        if not any((self.disk / "agent" / board / "committed.json").exists() for board in self.boards):
            say("empty")
            return
        say("boards", until(lambda: self._agree("boards")))
        say("releases", until(lambda: self._agree("platform", "status")))

    def _agree(self, *verb):
        """The deployment of the boards once it is the same on all; boards that missed a commit make up for it first."""
        found = {board["board"]: board for board in (read(*verb, "--one-host") or {}).get("boards", [])}
        deployments = {name: board["deployment"][:12] for name, board in found.items()}
        state = [[board[field] for field in ("board", "state", "phase", "deployment", "message")] for board in found.values()]
        if state != self.state:
            self.state = state
            say("state", verb, state)
        are_steady = all(board["state"] == "running" and board["phase"] == "steady" for board in found.values())
        return deployments if sorted(found) == self.boards and are_steady and len(set(deployments.values())) == 1 else None

    def record(self):
        for number in itertools.count():
            name = f"{self.first}-{number}.mcap"
            # pylint: disable-next=consider-using-with
            recorder = subprocess.Popen(["indurop", "record", "--node", self.boards[0], "-q", "-o", self.disk / "recordings" / name,
                                         "--duration", LENGTH], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL)
            time.sleep(BEGUN)
            if recorder.poll() is None:
                say("records", name)
            recorder.wait()

    def deploy(self):
        """Plants and releases, as fast as they are taken."""
        data = self.work / "data.bin"
        for number in itertools.count():
            if number % 4 == 3:
                version = f"9.{self.first + number}"
                file = self.work / f"{version}.release"
                done = run("platform", "pack", str(self.release), "--release-version", version, "-o", str(file))
                if done.returncode == 0:
                    done = run("platform", "deploy", str(file), "--one-host", "--health", "1s")
                file.unlink(missing_ok=True)
            else:
                data.write_bytes(random.randbytes(SIZE))
                done = run("deploy", str(self.manifest), "--one-host", "--health", "1s")
            if done.returncode != 0:
                say("desk", (done.stdout + done.stderr).strip()[-600:])
            time.sleep(random.random())


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("disk", type=pathlib.Path, help="the file with the file system")
    parser.add_argument("work", type=pathlib.Path, help="a folder with the manifest plant.xml, outside of the disk")
    parser.add_argument("--boards", type=int, required=True)
    parser.add_argument("--live", action="store_true")
    parser.add_argument("--repair", action="store_true", help="repair the file system if it cannot be mounted")
    parser.add_argument("--release", type=pathlib.Path, help="the installation of which releases are made")
    parser.add_argument("--first", type=int, default=0, help="number of the first deployment and recording")
    options = parser.parse_args()
    options.manifest = options.work / "plant.xml"
    plant = Plant(options)
    plant.power_on(options.disk, options.repair)
    plant.start_agents()
    plant.wait_for_boards()
    if options.live:
        threading.Thread(target=plant.record, daemon=True).start()
        plant.deploy()


if __name__ == "__main__":
    main()
