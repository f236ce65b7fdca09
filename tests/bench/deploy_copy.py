#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Deploys a plant with a large file and one with a tiny file from one network namespace to a board in another, in turn
with a plain TCP copy of the large file that ends with fsync. What the large file costs more than the tiny one is
compared with the copy. --rate limits what both boards send, as a cable does. Needs root."""

import argparse
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

PLANT = """<plant name="copy">
  <board name="a"><module><filename>{module}</filename><moduletype>thread</moduletype>
    <operationtype>periodic</operationtype><period>10ms</period><priority>1</priority>
    <property><value name="data">./data.bin</value></property></module></board>
</plant>
"""
RECEIVE = """
import os, socket, sys
server = socket.create_server(("", 7777))
print("ready", flush=True)
peer = server.accept()[0]
buffer = memoryview(bytearray(1 << 20))
with open(sys.argv[1], "wb", buffering=0) as file:
    while got := peer.recv_into(buffer):
        file.write(buffer[:got])
    os.fsync(file.fileno())
peer.sendall(b"!")
"""
SEND = """
import socket, sys
peer = socket.create_connection((sys.argv[1], 7777))
with open(sys.argv[2], "rb") as file:
    peer.sendfile(file)
peer.shutdown(socket.SHUT_WR)
peer.recv(1)
"""


class Boards:
    def __init__(self, arguments, folder):
        self.lab = [arguments.lab, "-l", f"copy{os.getpid()}"]
        self.bin = os.path.abspath(arguments.bin)
        self.folder = folder
        self.rate = arguments.rate

    def __enter__(self):
        subprocess.run([*self.lab, "up", "a", "b"], check=True)
        for board in ("a", "b") if self.rate else ():
            subprocess.run([*self.lab, "exec", board, "tc", "qdisc", "add", "dev", "eth0", "root", "tbf", "rate", self.rate,
                            "burst", "256k", "latency", "50ms"], check=True)
        self.agent = subprocess.Popen(
            [*self.lab, "exec", "a", f"{self.bin}/indurop-agent", "--board", "a", "-q"],
            env={**os.environ, "INDUROP_STATE_DIR": os.path.join(self.folder, "state")})
        return self

    def __exit__(self, *_):
        self.agent.terminate()
        self.agent.wait()
        subprocess.run([*self.lab, "down"], check=False)

    def write(self, size):
        """Data that no board has, so that all of it is sent."""
        with open(os.path.join(self.folder, "data.bin"), "wb") as file:
            while size > 0:
                size -= file.write(os.urandom(min(size, 1 << 24)))
            os.fsync(file.fileno())

    def deploy(self):
        began = time.monotonic()
        done = subprocess.run([*self.lab, "exec", "b", f"{self.bin}/indurop", "deploy",
                               os.path.join(self.folder, "plant.xml"), "--health", "100ms"],
                              capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"deploy ended with {done.returncode}:\n{done.stdout}{done.stderr}")
        return time.monotonic() - began

    def copy(self):
        target = os.path.join(self.folder, "state", "copied")
        receiver = subprocess.Popen([*self.lab, "exec", "a", sys.executable, "-c", RECEIVE, target],
                                    stdout=subprocess.PIPE, text=True)
        receiver.stdout.readline()
        code = f"import time\nbegan = time.monotonic()\n{SEND}\nprint(time.monotonic() - began)"
        out = subprocess.run([*self.lab, "exec", "b", sys.executable, "-c", code, "10.77.0.1",
                              os.path.join(self.folder, "data.bin")], capture_output=True, text=True, check=True).stdout
        receiver.wait()
        os.remove(target)
        return float(out)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", required=True)
    parser.add_argument("--module", required=True, help="any module file")
    parser.add_argument("--lab", required=True)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--megabytes", type=int, default=100)
    parser.add_argument("--rate", help="of a cable, as tc writes it: 1gbit (default: as quick as this machine copies)")
    parser.add_argument("--folder", help="on the disk to be measured (default: a temporary one)")
    arguments = parser.parse_args()
    folder = tempfile.mkdtemp(prefix="indurop-copy-", dir=arguments.folder)
    try:
        shutil.copy(arguments.module, os.path.join(folder, "module.so"))
        with open(os.path.join(folder, "plant.xml"), "w", encoding="utf-8") as file:
            file.write(PLANT.format(module="./module.so"))
        rounds = []
        with Boards(arguments, folder) as boards:
            for number in range(arguments.rounds + 1):
                boards.write(1000)
                small = boards.deploy()
                boards.write(arguments.megabytes * 1_000_000)
                large = boards.deploy()
                copied = boards.copy()
                if number > 0:  # the first one finds cold files
                    rounds.append((large - small, copied, small))
                    print(f"round {number}: {large - small:.3f} s more than a tiny file ({small:.3f} s), TCP copy {copied:.3f} s, "
                          f"ratio {(large - small) / copied:.2f}", flush=True)
        median = statistics.median(row[0] / row[1] for row in rounds)
        print(f"{arguments.megabytes} MB of files: {statistics.median(row[0] for row in rounds):.3f} s, a TCP copy with fsync "
              f"{statistics.median(row[1] for row in rounds):.3f} s, ratio {median:.2f} (target over a cable: 1.5)")
    finally:
        shutil.rmtree(folder)


if __name__ == "__main__":
    main()
