#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What cannot be sent or received is refused with a message that says what to do, and the documented exit code."""

import subprocess

from harness import LARGE, Setting, expect, wait_for


def refused(test, code, text, *options):
    done = subprocess.run([test.programs / "indurop-pools", "--one-host", "--domain", str(test.domain), *options],
                          capture_output=True, text=True, check=False, env=test.environment, timeout=60)
    expect(done.returncode == code and text in done.stderr, f"{options}: {done.returncode}: {done.stderr}")


def main():
    with Setting() as test:
        test.start_node("a", [("pools_writer.exe", "50ms")])
        test.start_node("b", [("pools_other_checker.exe", "10ms")])
        node = test.node("a")
        refused(test, 2, "name a pool with --send or --receive", "--node", node)
        refused(test, 2, f"Did you mean '{LARGE}'?", "--node", node, "--send", LARGE[:-1])
        refused(test, 2, f"has no pool 'x'. Its pools: {LARGE}", "--node", node, "--send", "x")
        refused(test, 2, "is named twice", "--node", node, "--send", "large", "--receive", LARGE)
        refused(test, 2, "is not a valid node name", "--node", "no node", "--send", "large")
        refused(test, 2, "--hz", "--node", node, "--send", "large", "--hz", "-1")
        refused(test, 2, "several nodes", "--send", "large")
        test.pools("send", "a", "--send", LARGE)
        test.pools("receive", "b", "--receive", LARGE)
        wait_for(lambda: test.counts("receive").get(LARGE, {}).get("refused", 0) > 0, "parts of another type are refused")
        log = (test.folder / "receive.log").read_text()
        expect(f"chunks of node '{node}' have type" in log and f"those of node '{test.node('b')}' have type" in log and
               log.count("build the modules of both boards from the same .glb") == 1, "the message names both: " + log)
        expect(test.counts("receive")[LARGE]["received"] == 0 and test.pool("b", LARGE)["published"] == 0, "published")


main()
