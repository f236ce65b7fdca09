#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The page's alarms in headless Chromium: alarms are raised, acknowledged, shelved and cleared; the server is killed in
between, and started again with another token, and with users who sign in."""

import os
import pathlib
import subprocess
import sys
import tempfile

from page_server import PATIENCE, PageServer, prepared


class Press(PageServer):
    node = f"web_alarms_{os.getpid()}"

    def start_node(self, *more):
        self.process = subprocess.Popen([self.options.fake_node, self.node, *more], env=self.environment, stdout=subprocess.PIPE, text=True)
        assert self.process.stdout.readline() == "ready\n"

    def obey(self, word):
        if word == "kill-server":
            self.server.kill()
            self.server.wait(timeout=PATIENCE)
        elif word == "deploy":  # other variables, as after a deployment
            self.process.kill()
            self.process.wait(timeout=PATIENCE)
            self.start_node("many", "12")
        elif word == "other-token":
            (pathlib.Path(self.folder) / "tokens").write_text("tester the-next-token-of-this-server-0123456789\n")
        elif word == "users":
            for user, role in (("anna", "operate"), ("eve", "look"), ("ida", "administer")):
                subprocess.run([f"{self.options.bin}/indurop", "users", "add", user, "--role", role], cwd=self.folder,
                               env=self.environment, input="correct horse\n", text=True, check=True)
            self.who = ("--users", "users.xml")
        elif word == "remove-anna":
            self.indurop("users", "remove", "anna", check=True)
        elif word == "start-server":
            self.start_server()
        else:
            name, value = word.split("=")
            self.indurop("set", "--node", self.node, name, value, check=True)

    def end(self):
        super().end()
        self.process.kill()
        self.process.wait(timeout=PATIENCE)
        self.indurop("clean", "--node", self.node)


def main():
    options = prepared(__doc__, "--fake-node")
    with tempfile.TemporaryDirectory() as folder:
        press = Press(options, folder)
        try:
            press.start_node()
            press.start_server()
            return press.drive("alarms.mjs")
        finally:
            press.end()


if __name__ == "__main__":
    sys.exit(main())
