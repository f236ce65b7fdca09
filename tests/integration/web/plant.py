#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The page's overview in headless Chromium before a plant of two boards: both are heard, one is killed and missed in words, and
comes back."""

import argparse
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "serve"))
from plant_test import take_domain  # noqa: E402
from run import HERE, TOKEN, Plant, fetch, free_port, skip  # noqa: E402


class Boards(Plant):
    """Two agents; what nodes this host runs otherwise does not matter here."""

    node = f"web_plant_{os.getpid()}"
    agents = {}

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
            agent.wait(timeout=60)
        self.stop_server()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("--bin", "--fake-node"):
        parser.add_argument(name, required=True)
    for name in ("--page", "--work"):
        parser.add_argument(name, type=pathlib.Path, required=True)
    options = parser.parse_args()
    options.bin, options.fake_node = os.path.abspath(options.bin), os.path.abspath(options.fake_node)
    browser = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if not shutil.which("npm") or not browser or not (options.page / "index.html").is_file():
        skip("there is no npm, no page, or no Chromium here")
    driver = options.work / "browser"
    fetch(HERE / "browser", driver, patience_s=180)
    pictures = options.work / "pictures"
    shutil.rmtree(pictures, ignore_errors=True)
    pictures.mkdir(parents=True)
    with tempfile.TemporaryDirectory() as folder:
        plant = Boards(options, pathlib.Path(folder), free_port())
        plant.domain = take_domain(options)
        try:
            plant.start_server("--plant", "--domain", str(plant.domain), "--one-host")
            for name in ("left", "right"):
                plant.start_agent(name)
            command = ["node", str(HERE / "plant.mjs"), str(driver), f"http://127.0.0.1:{plant.port}", TOKEN, plant.node, str(pictures), browser]
            with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as script:
                plant.serve_orders(script)
            return script.returncode
        finally:
            plant.end()


if __name__ == "__main__":
    sys.exit(main())
