#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The page's PLC view in headless Chromium with the conveyor of examples/plc: power flows, a contact links to its variable,
which is forced from there; a second program of the board is selected."""

import os
import sys
import tempfile

from page_server import PageServer, prepared


LAMP = """VAR_GLOBAL lit : BOOL; END_VAR
PROGRAM lamp
VAR_EXTERNAL lit : BOOL; END_VAR
VAR flashes : INT; END_VAR
  IF lit THEN
    flashes := flashes + 1;
  END_IF;
END_PROGRAM
"""


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
            (conveyor.folder / "lamp.st").write_text(LAMP)
            lamp = conveyor.indurop("plc", "build", "lamp.st", "--watch", check=True).stdout
            other = (options.plc / "module.xml").read_text().replace("./conveyor.so", str(options.plc / "conveyor.so"))
            (conveyor.folder / "module.xml").write_text(other.replace("</root>", lamp + "</root>"))
            conveyor.indurop("run", "module.xml", "--detach", "--node", conveyor.node, check=True)
            conveyor.start_server("--plc", str(options.plc / "conveyor.xml"), "--plc", str(conveyor.folder / "lamp.st"))
            return conveyor.drive("plc.mjs")
        finally:
            conveyor.end()


if __name__ == "__main__":
    sys.exit(main())
