#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What every test of the page needs: a server in its own folder, and headless Chromium that a script drives."""

import argparse
import os
import pathlib
import shutil
import socket
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE.parents[1] / "support"))
from npm_packages import fetch, skip  # noqa: E402
from processes import free_port  # noqa: E402

TOKEN = "a-token-that-is-only-for-tests-0123456789"
PATIENCE = 60


def prepared(description, *names):
    """The paths a test is given, --bin, --page, --work and its own; the browser and its driver, or the test is skipped."""
    parser = argparse.ArgumentParser(description=description)
    for name in ("--bin", "--page", "--work", *names):
        parser.add_argument(name, type=lambda path: pathlib.Path(path).absolute(), required=True)
    options = parser.parse_args()
    if not shutil.which("npm") or not shutil.which("node"):
        skip("there is no npm here")
    if not (options.page / "index.html").is_file():
        skip("the page was not built: the registry of npm could not be reached")
    options.browser = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if not options.browser:
        skip("there is no Chromium here (package chromium)")
    options.driver = options.work / "browser"
    fetch(HERE / "browser", options.driver, patience_s=180)
    options.pictures = options.work / "pictures"
    shutil.rmtree(options.pictures, ignore_errors=True)
    options.pictures.mkdir(parents=True)
    return options


class PageServer:
    """`indurop serve` for the node `node`. A derived class executes the script's commands in `obey`."""

    node = ""
    who = ("--token-file", "tokens")  # options that say who may write; paths are those of the folder

    def __init__(self, options, folder):
        self.options, self.folder, self.port = options, pathlib.Path(folder), free_port()
        self.environment = {**os.environ, "INDUROP_STATE_DIR": str(self.folder / "state")}
        self.server = None
        (self.folder / "recordings").mkdir()
        (self.folder / "tokens").write_text(f"tester {TOKEN}\n")
        (self.folder / "tokens").chmod(0o600)

    def indurop(self, *words, check=False):
        return subprocess.run([f"{self.options.bin}/indurop", *words], cwd=self.folder, env=self.environment, text=True,
                              capture_output=True, timeout=60, check=check)

    def start_server(self, *more):
        command = [f"{self.options.bin}/indurop-serve", *more, *self.who, "--node", self.node, "--port", str(self.port), "--write",
                   "--web", str(self.options.page), "-q",
                   "--recordings", str(self.folder / "recordings")]
        self.server = subprocess.Popen(command, cwd=self.folder, env=self.environment, stdout=subprocess.DEVNULL)
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

    def end(self):
        if self.server and self.server.poll() is None:
            self.stop_server()
        self.indurop("stop", "--node", self.node)
        self.indurop("clean", "--node", self.node)

    def drive(self, script, *more):
        """Runs the browser's script and executes its commands, a line "do WORD" each; returns its exit code."""
        command = ["node", HERE / script, self.options.driver, f"http://127.0.0.1:{self.port}", TOKEN, self.options.pictures,
                   self.options.browser, *more]
        with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as browser:
            for line in browser.stdout:
                if line.startswith("do "):
                    self.obey(line[3:].strip())
                    browser.stdin.write("done\n")
                    browser.stdin.flush()
                else:
                    print(line, end="", flush=True)
        return browser.returncode
