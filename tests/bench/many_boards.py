#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Sixteen boards of a hundred variables each, in network namespaces of this machine: how long after the last board was
started every board had all variables of all others, and the memory of each node in addition to the store. Needs root."""

import argparse
import os
import re
import subprocess
import sys
import time
import xml.etree.ElementTree as ElementTree


def memory_kb(pid):
    """Resident and proportional size without shared memory under /dev/shm."""
    resident = proportional = 0
    counted = True
    with open(f"/proc/{pid}/smaps", encoding="utf-8") as file:
        for line in file:
            if re.match(r"[0-9a-f]+-[0-9a-f]+ ", line):
                counted = "/dev/shm/" not in line
            elif counted and line.startswith("Rss:"):
                resident += int(line.split()[1])
            elif counted and line.startswith("Pss:"):
                proportional += int(line.split()[1])
    return resident, proportional


def node_pids(indurop):
    """The nodes by name: `indurop run` starts the node, maybe as a child."""
    out = subprocess.run([indurop, "nodes", "-o", "csv"], capture_output=True, text=True, check=True).stdout
    rows = [row.split(",") for row in out.splitlines()[1:]]
    return {row[0]: int(row[2]) for row in rows if row[2]}  # a dead node has none


def matched_ns(indurop, board):
    out = subprocess.run([indurop, "get", "--node", board, f"bench::many::{board}_matched", "-o", "csv"],
                         capture_output=True, text=True, check=False).stdout
    values = re.findall(r"\d{6,}", out)
    return int(values[-1]) if values else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", required=True)
    parser.add_argument("--plant", required=True)
    parser.add_argument("--lab", required=True)
    parser.add_argument("--timeout", type=int, default=60, help="seconds")
    arguments = parser.parse_args()
    boards = [board.get("name") for board in ElementTree.parse(arguments.plant).getroot().iter("board")]
    indurop = os.path.join(os.path.abspath(arguments.bin), "indurop")
    lab = [arguments.lab, "-l", f"many{os.getpid()}"]
    subprocess.run([*lab, "up", *boards], check=True)
    nodes = []
    try:
        for board in boards:
            nodes.append(subprocess.Popen([*lab, "exec", board, indurop, "run", arguments.plant, "--board", board, "-q"]))
        started = time.time_ns()
        found = {}
        while len(found) < len(boards) and time.time_ns() - started < arguments.timeout * 1e9:
            time.sleep(1)  # looking costs processor time, so rarely
            for board in boards:
                at = 0 if board in found else matched_ns(indurop, board)  # maybe of a run before this one
                if at > started:
                    found[board] = (at - started) / 1e9
        pids = node_pids(indurop)
        sizes = [memory_kb(pids[board]) for board in boards if board in pids]
    finally:
        for node in nodes:  # in an orderly way: the next ones need not keep what a crash left
            node.terminate()
        for node in nodes:
            node.wait()
        subprocess.run([*lab, "down"], check=False)
    missing = [board for board in boards if board not in found]
    if missing:
        print(f"not matched within {arguments.timeout} s: {' '.join(missing)}")
        return 1
    print(f"{len(boards)} boards: the last one had all variables {max(found.values()):.2f} s after all were started, the first "
          f"{min(found.values()):.2f} s (target 2 s)")
    print(f"memory of a node in addition to the store (target 15 MB): {max(s[0] for s in sizes) / 1024:.1f} MB resident; its share "
          f"of them, where pages of libraries are divided among those who use them, {max(s[1] for s in sizes) / 1024:.1f} MB")
    return 0


if __name__ == "__main__":
    sys.exit(main())
