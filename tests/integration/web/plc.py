#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The page's PLC view in headless Chromium beside the conveyor of examples/plc: power flows, a contact leads to its variable,
which is forced from there."""

import os
import sys
import tempfile

from page_server import PageServer, prepared


class Conveyor(PageServer):
    node = f"web_plc_{os.getpid()}"

    def obey(self, word):
        name, value = word.split("=")
        self.indurop("set", "--node", self.node, name, value, check=True)


def main():
    options = prepared(__doc__, "--plc")
    with tempfile.TemporaryDirectory() as folder:
        conveyor = Conveyor(options, folder)
        try:
            conveyor.indurop("run", str(options.plc / "module.xml"), "--detach", "--node", conveyor.node, check=True)
            conveyor.start_server("--plc", str(options.plc / "conveyor.xml"))
            return conveyor.drive("plc.mjs")
        finally:
            conveyor.end()


if __name__ == "__main__":
    sys.exit(main())
