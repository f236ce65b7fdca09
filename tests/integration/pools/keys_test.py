#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A plant with keys: the program uses those of its board, tools get the pools that they may read, programs without
keys get nothing, and without its keys the program does not start."""

import re
import subprocess

from harness import LARGE, SMALL, Setting, expect, wait_for


def make_plant(test):
    def board(name, file, period):
        return (f"<board name=\"{test.node(name)}\"><module><filename>{test.build}/{file}</filename><moduletype>process"
                f"</moduletype><operationtype>periodic</operationtype><period>{period}</period><priority>1</priority>"
                "</module></board>")
    plant = test.folder / "plant.xml"
    plant.write_text(f"<plant name=\"cell\"><security>keys</security><external secure=\"on\">{test.domain}</external>"
                     f"<domain>{test.domain + 1}</domain>{board('a', 'pools_writer.exe', '50ms')}"
                     f"{board('b', 'pools_checker.exe', '10ms')}</plant>")
    for words in (("keys", "init", plant), ("keys", "add", "--dir", test.folder / "keys", "--tool", "eye", "--read", LARGE)):
        done = test.indurop(*words)
        expect(done.returncode == 0, done.stderr)
    for name in ("a", "b"):
        test.start("node-" + name, [test.programs / "indurop-node", plant, "--board", test.node(name), "--one-host"])
    for name in ("a", "b"):
        test.wait_for_node(name)
    return plant


def subscribe(test, configuration, count):
    """The exit code of a subscriber with this Cyclone DDS configuration; None if it got nothing."""
    environment = {**test.environment, "CYCLONEDDS_URI": configuration}
    try:
        return subprocess.run([test.build / "pools_subscriber", str(test.domain), "pooltest/Flow/large", str(count)],
                              capture_output=True, check=False, env=environment, timeout=60).returncode
    except subprocess.TimeoutExpired:
        return None


def with_keys(test):
    example = (test.source / "examples/external/keys_cyclone.xml").read_text()
    file = test.folder / "eye.xml"
    file.write_text(re.sub(r"\$\{KEYS\}", str(test.folder / "keys/tools/eye"), example))
    return f"file://{file}"


def refused(test, code, text, *options):
    done = subprocess.run([test.programs / "indurop-pools", "--node", test.node("b"), "--one-host", "--domain",
                           str(test.domain), "--receive", SMALL, *options], capture_output=True, text=True, check=False,
                          env=test.environment, timeout=60)
    expect(done.returncode == code and text in done.stderr, f"{options}: {done.returncode}: {done.stderr}")


def main():
    with Setting() as test:
        plant = make_plant(test)
        test.pools("send", "a", "--send", LARGE)
        test.pools("receive", "b", "--receive", LARGE)
        test.grows("b", "large_seen", 10, "chunks reach a board with keys")
        expect(test.says("receive", "with keys"), "the program does not say that it uses keys")
        expect(subscribe(test, with_keys(test), 5) == 0, "a tool with the right gets no chunk")
        expect(subscribe(test, test.environment["CYCLONEDDS_URI"], 1) == 2, "a program without keys got a chunk")
        test.grows("b", "large_seen", 5, "chunks still reach the board")
        refused(test, 1, "do not permit to read pooltest/Flow/small", "--keys", str(test.folder / "keys/tools/eye"))
        folder = test.folder / "keys/boards" / test.node("b")
        wait_for(folder.is_dir, "the keys of board b")
        folder.rename(folder.with_name("elsewhere"))
        refused(test, 2, "the plant is secured, but")
        plant.rename(test.folder / "gone.xml")
        refused(test, 2, "cannot find out whether the plant")
        expect(not test.wrong_chunks(), f"wrong chunks: {test.wrong_chunks()}")


main()
