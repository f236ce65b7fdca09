#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The page's PLC view in headless Chromium beside the conveyor of examples/plc: power flows, a contact leads to its variable,
which is forced from there."""

import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

from run import HERE, TOKEN, Plant, fetch, free_port, skip

NODE = f"web_plc_{os.getpid()}"


class Conveyor(Plant):
    node = NODE

    def start_node(self):
        self.indurop("run", str(self.options.plc / "module.xml"), "--detach", "--node", NODE, check=True)

    def obey(self, word):
        name, value = word.split("=")
        self.indurop("set", "--node", NODE, name, value, check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", required=True)
    for name in ("--plc", "--page", "--work"):
        parser.add_argument(name, type=pathlib.Path, required=True)
    options = parser.parse_args()
    options.bin, options.plc = os.path.abspath(options.bin), options.plc.absolute()
    browser = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if not shutil.which("npm") or not browser or not (options.page / "index.html").is_file():
        skip("there is no npm, no page, or no Chromium here")
    driver = options.work / "browser"
    fetch(HERE / "browser", driver, patience_s=180)
    pictures = options.work / "pictures"
    shutil.rmtree(pictures, ignore_errors=True)
    pictures.mkdir(parents=True)
    with tempfile.TemporaryDirectory() as folder:
        plant = Conveyor(options, pathlib.Path(folder), free_port())
        try:
            plant.start_node()
            plant.start_server("--plc", str(options.plc / "conveyor.xml"))
            command = ["node", str(HERE / "plc.mjs"), str(driver), f"http://127.0.0.1:{plant.port}", TOKEN, str(pictures), browser]
            with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as script:
                plant.serve_orders(script)
            return script.returncode
        finally:
            plant.end()


if __name__ == "__main__":
    sys.exit(main())
