#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The page's overview in headless Chromium before a plant of two boards: both are heard, one is killed and missed in words, and
comes back."""

import os
import pathlib
import signal
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "serve"))
from page_server import PATIENCE, PageServer, prepared  # noqa: E402
from plant_test import take_domain  # noqa: E402


class Boards(PageServer):
    """Two agents; what nodes this host runs otherwise does not matter here."""

    node = f"web_plant_{os.getpid()}"

    def __init__(self, options, folder):
        super().__init__(options, folder)
        self.domain, self.agents = take_domain(options), {}

    def start_agent(self, name):
        self.agents[name] = subprocess.Popen(
            [f"{self.options.bin}/indurop-agent", "--board", f"{self.node}_{name}", "--domain", str(self.domain), "--one-host", "-q"],
            env=self.environment)

    def obey(self, word):
        what, name = word.split("=")
        if what == "start":
            self.start_agent(name)
        else:
            self.agents[name].send_signal(signal.SIGKILL)
            self.agents.pop(name).wait()

    def end(self):
        for agent in self.agents.values():
            agent.terminate()
            agent.wait(timeout=PATIENCE)
        super().end()


def main():
    options = prepared(__doc__, "--fake-node")
    with tempfile.TemporaryDirectory() as folder:
        boards = Boards(options, folder)
        try:
            boards.start_server("--plant", "--domain", str(boards.domain), "--one-host")
            for name in ("left", "right"):
                boards.start_agent(name)
            return boards.drive("plant.mjs", boards.node)
        finally:
            boards.end()


if __name__ == "__main__":
    sys.exit(main())
