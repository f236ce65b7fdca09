#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Sender, receiver, writer, reader and both nodes are killed at random instants, and the nodes are started again in an
orderly way: no byte of any chunk is ever wrong, nothing has to be cleaned up, and chunks come again each time."""

import contextlib
import os
import signal
import time

from harness import LARGE, SMALL, Setting, expect, wait_for

KILLS = int(os.environ.get("POOLS_TEST_KILLS", "60"))


def pid_of(test, name, module):
    users = (test.pool(name, LARGE) or {"users": []})["users"]
    found = [one["pid"] for one in users if one["name"] == module]
    return found[0] if found else None


def kill_one(test, victim):
    if victim in ("send", "receive"):
        test.kill(victim)
        test.start_again(victim)
    elif victim in ("node-a", "node-b"):
        test.kill(victim)
        test.start_again(victim)
        test.wait_for_node(victim[-1])
    else:
        name, module = victim
        if pid := pid_of(test, name, module):
            with contextlib.suppress(ProcessLookupError):  # its node ended in between
                os.kill(pid, signal.SIGKILL)


def chunks_come(test, why):
    for variable in ("large_seen", "small_seen"):
        test.grows("b", variable, 2, f"chunks come after {why}")


def main():
    with Setting() as test:
        test.start_node("a", [("pools_writer.exe", "50ms")])
        test.start_node("b", [("pools_checker.exe", "10ms")])
        test.pools("send", "a", "--send", LARGE, "--send", SMALL)
        test.pools("receive", "b", "--receive", LARGE, "--receive", SMALL)
        chunks_come(test, "the start")
        victims = ["send", "receive", ("a", "pools_writer"), ("b", "pools_checker"), "node-a", "node-b"]
        for number in range(KILLS):
            victim = test.random.choice(victims)
            time.sleep(test.random.uniform(0, 0.3))
            kill_one(test, victim)
            if number % 6 == 5:
                chunks_come(test, f"kill {number} of {victim}")
        for name in ("node-a", "node-b"):
            expect(test.end(name) == 0, "an orderly end of a node")
            test.start_again(name)
            test.wait_for_node(name[-1])
            chunks_come(test, f"an orderly restart of {name}")
        expect(not test.wrong_chunks(), f"wrong chunks: {test.wrong_chunks()}")
        for name, module in (("a", "pools_writer"), ("b", "pools_checker")):
            wait_for(lambda: sorted(one["name"] for one in test.pool(name, LARGE)["users"]) ==
                     ["indurop-pools", module], "the dead have no seats")
            wait_for(lambda: test.pool(name, LARGE)["free"] >= 1, "chunks of the dead are free")
        print(test.counts("receive"), test.counts("send"))


main()
