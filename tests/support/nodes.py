# SPDX-License-Identifier: Apache-2.0
"""Nodes that tests start: they end, and their shared memory is removed, when the test ends, however it ends."""

import atexit
import os
import subprocess


def remove_at_exit(indurop, *nodes):
    """Of nodes that have ended by then. `indurop`: the program."""
    def remove():
        for node in nodes:
            subprocess.run([indurop, "clean", "--quiet", "--node", node], capture_output=True, check=False)
    atexit.register(remove)


def new_node(indurop, prefix):
    """A name that no other process gives a node."""
    node = f"{prefix}{os.getpid()}"
    remove_at_exit(indurop, node)
    return node


def end_at_exit(child):
    """A program that a failed test would leave, which keeps the output of the test open. Returns it."""
    def end():
        if child.poll() is None:
            child.kill()
            child.wait()
    atexit.register(end)
    return child
