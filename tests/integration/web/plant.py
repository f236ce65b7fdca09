#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The page's overview in headless Chromium of a plant of two boards: both report, one is killed, the page says so, and it comes back. Two deployments are compared, and the plant is rolled back."""

import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "serve"))
from page_server import PATIENCE, PageServer, prepared  # noqa: E402
from plant_test import take_domain  # noqa: E402


class Boards(PageServer):
    """Two agents; other nodes of this host do not matter."""

    node = f"web_plant_{os.getpid()}"

    def __init__(self, options, folder):
        super().__init__(options, folder)
        self.domain, self.agents, self.fake = take_domain(options), {}, None

    def deploy(self, period):
        (self.folder / "plant.xml").write_text(f"""<plant name="{self.node}"><domain>{self.domain % 200 + 1}</domain><external>off</external>
""" + "".join(f"""<board name="{self.node}_{name}">
<module><filename>./steady.so</filename><moduletype>thread</moduletype><operationtype>periodic</operationtype>
<period>{period}</period>
<priority>1</priority></module>
</board>
""" for name in ("left", "right")) + "</plant>\n")
        done = self.indurop("deploy", "plant.xml", "--health", "500ms", "--domain", str(self.domain), "--one-host")
        assert done.returncode == 0, done.stderr

    def start_fake(self, many):
        """Starts the node that the server shows, with so many variables in addition to its own, in place of a running one."""
        self.end_fake()
        self.fake = subprocess.Popen([self.options.fake_node, self.node, "many", many], env=self.environment,
                                     stdout=subprocess.PIPE, text=True)
        assert self.fake.stdout.readline() == "ready\n"

    def end_fake(self):
        if self.fake:
            self.fake.kill()
            self.fake.wait(timeout=PATIENCE)

    def start_agent(self, name):
        self.agents[name] = subprocess.Popen(
            [f"{self.options.bin}/indurop-agent", "--board", f"{self.node}_{name}", "--domain", str(self.domain), "--one-host", "-q"],
            env=self.environment)

    def obey(self, word):
        what, name = word.split("=")
        if what == "fake":
            self.start_fake(name)
            return
        if what == "deploy":
            self.deploy(name)
        elif what == "start":
            self.start_agent(name)
        else:
            self.agents[name].send_signal(signal.SIGKILL)
            self.agents.pop(name).wait()

    def end(self):
        self.end_fake()
        for agent in self.agents.values():
            agent.terminate()
            agent.wait(timeout=PATIENCE)
        for name in ("left", "right"):
            self.indurop("stop", "--node", f"{self.node}_{name}")
            self.indurop("clean", "--node", f"{self.node}_{name}")
        super().end()


def main():
    options = prepared(__doc__, "--fake-node", "--module")
    with tempfile.TemporaryDirectory() as folder:
        boards = Boards(options, folder)
        shutil.copy(options.module, boards.folder / "steady.so")
        try:
            boards.start_server("--plant", "--domain", str(boards.domain), "--one-host")
            for name in ("left", "right"):
                boards.start_agent(name)
            return boards.drive("plant.mjs", boards.node)
        finally:
            boards.end()


if __name__ == "__main__":
    sys.exit(main())
