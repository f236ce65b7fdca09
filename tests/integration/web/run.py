#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The page of `indurop serve` as people use it: a robot cell runs, headless Chromium goes through every view, wide and on a
phone, light and dark; a value is set and forced, the server and the node go and come back; axe-core finds nothing serious.
Pictures of what was seen are left in WORK/pictures."""

import argparse
import os
import pathlib
import shutil
import socket
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "cell"))
from cell_test import copy_configuration  # noqa: E402

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from npm_packages import fetch, skip  # noqa: E402

HERE = pathlib.Path(__file__).parent
NODE = "web_test"
TOKEN = "a-token-that-is-only-for-tests-0123456789"
PATIENCE = 60


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Plant:
    """The cell and the server. The browser's script says on its standard output what it wants done, a word per line."""

    node = NODE

    def __init__(self, options, folder, port):
        self.options, self.folder, self.port = options, folder, port
        self.environment = {**os.environ, "INDUROP_STATE_DIR": str(folder / "state")}
        self.server = None
        (folder / "recordings").mkdir()
        (folder / "tokens").write_text(f"tester {TOKEN}\n")
        (folder / "tokens").chmod(0o600)

    def indurop(self, *words, check=False):
        return subprocess.run([f"{self.options.bin}/indurop", *words], cwd=self.folder, env=self.environment, text=True,
                              capture_output=True, timeout=60, check=check)

    def start_node(self):
        self.indurop("run", "module.xml", "--detach", "--node", NODE, check=True)

    def start_tour(self):
        """The robot moves for twenty seconds."""
        self.indurop("set", "--node", NODE, "CELL::tour", "true", check=True)

    def record(self):
        self.indurop("record", "--node", NODE, "-o", "recordings/run.mcap", "--duration", "3s", check=True)

    def stop_node(self):
        self.indurop("stop", "--node", self.node)

    def start_server(self, *more):
        command = [f"{self.options.bin}/indurop-serve", *more, "--node", self.node, "--port", str(self.port), "--write",
                   "--token-file", str(self.folder / "tokens"), "--web", str(self.options.page), "-q",
                   "--recordings", str(self.folder / "recordings")]
        self.server = subprocess.Popen(command, env=self.environment, stdout=subprocess.DEVNULL)
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            with socket.socket() as probe:
                if probe.connect_ex(("127.0.0.1", self.port)) == 0:
                    return
            time.sleep(0.05)
        raise AssertionError("the server does not listen")

    def stop_server(self):
        self.server.terminate()
        self.server.wait(timeout=PATIENCE)

    def obey(self, word):
        {"start-node": self.start_node, "stop-node": self.stop_node, "start-server": self.start_server,
         "stop-server": self.stop_server, "start-tour": self.start_tour, "record": self.record}[word]()

    def end(self):
        if self.server and self.server.poll() is None:
            self.stop_server()
        self.stop_node()
        self.indurop("clean", "--node", self.node)

    def serve_orders(self, script):
        for line in script.stdout:
            if line.startswith("do "):
                self.obey(line[3:].strip())
                script.stdin.write("done\n")
                script.stdin.flush()
            else:
                print(line, end="", flush=True)


def drive(plant, driver, pictures, browser):
    """Runs the browser's script; its exit code."""
    command = ["node", str(HERE / "page.mjs"), str(driver), f"http://127.0.0.1:{plant.port}", TOKEN, NODE, str(pictures), browser]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as script:
        plant.serve_orders(script)
    return script.returncode


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("--bin", "--cell", "--io-module"):
        parser.add_argument(name, required=True)
    for name in ("--page", "--work"):
        parser.add_argument(name, type=pathlib.Path, required=True)
    options = parser.parse_args()
    options.bin = os.path.abspath(options.bin)
    if not shutil.which("npm") or not shutil.which("node"):
        skip("there is no npm here")
    if not (options.page / "index.html").is_file():
        skip("the page was not built: the registry of npm could not be reached")
    browser = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if not browser:
        skip("there is no Chromium here (package chromium)")
    driver = options.work / "browser"
    fetch(HERE / "browser", driver, patience_s=180)
    pictures = options.work / "pictures"
    shutil.rmtree(pictures, ignore_errors=True)
    pictures.mkdir(parents=True)
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        copy_configuration(os.path.abspath(options.cell), os.path.abspath(options.io_module), name)
        plant = Plant(options, folder, free_port())
        try:
            plant.indurop("clean", "--node", NODE)
            plant.start_node()
            plant.start_server()
            return drive(plant, driver, pictures, browser)
        finally:
            plant.end()


if __name__ == "__main__":
    sys.exit(main())
