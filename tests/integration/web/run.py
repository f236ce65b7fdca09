#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The page of `indurop serve` as users see it: a robot cell runs, headless Chromium goes through every view, wide and on a
phone, light and dark; a value is set and forced, the server and the node end and start again; axe-core finds nothing serious.
Pictures of the views are left in WORK/pictures."""

import pathlib
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent / "cell"))
from cell_test import copy_configuration  # noqa: E402
from page_server import PATIENCE, PageServer, prepared  # noqa: E402


def copy_cell(options, folder):
    """Copies the cell's files. Its I/O station is a normal process, which a browser may keep waiting: more time for it."""
    copy_configuration(str(options.cell), str(options.io_module), folder)
    station = pathlib.Path(folder) / "ioconfig.xml"
    station.write_text(station.read_text().replace('timeout="100ms"', 'timeout="2s"'))
    points = pathlib.Path(folder) / "points.job"
    points.write_text(points.read_text() + "KEEPOUT post = CYLINDER -700 700 0 -700 700 900 RADIUS 60\n")  # far from its motions


class Cell(PageServer):
    node = "web_test"

    def start_server(self):
        cell = self.options.cell
        super().start_server("--plc", f"{cell}/main.xml,{cell}/plc_robot.glb,{cell}/cell.glb")

    def start_node(self):
        self.indurop("run", "module.xml", "--detach", "--node", self.node, check=True)

    def start_tour(self):
        """The robot moves for twenty seconds."""
        self.indurop("set", "--node", self.node, "CELL::tour", "true", check=True)

    def power_on(self):
        """Restarts the cell without pressing its start button: the group is in standby. After a tour the PLC program continues on its own."""
        self.stop_node()
        self.start_node()
        state = lambda: self.indurop("get", "--node", self.node, "PLC_ROBOT::ROBOT_MODULE_STATE.eState").stdout.strip()
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            if state() == "ROBOT_GROUP_STANDBY":
                return
            if state() == "ROBOT_GROUP_DISABLED":
                acknowledged = self.indurop("get", "--node", self.node, "PLC_ROBOT::ROBOT_MODULE_STATE.nAcknowledge", check=True)
                self.indurop("set", "--node", self.node, "PLC_ROBOT::ROBOT_MODULE_SERVICE",
                             f"{{eOpCode: SVC_AD_GROUP_ENABLE, nRequest: {int(acknowledged.stdout) + 1}}}", check=True)
            time.sleep(0.5)
        raise AssertionError("the group is not in standby")

    def automatic(self):
        self.indurop("set", "--node", self.node, "PLC_ROBOT::ROBOT_MODE", "{eMode: ROBOT_MODE_AUTOMATIC}", check=True)

    def kill_server(self):
        self.server.kill()
        self.server.wait(timeout=PATIENCE)

    def record(self):
        self.indurop("record", "--node", self.node, "-o", "recordings/run.mcap", "--duration", "3s", check=True)

    def stop_node(self):
        self.indurop("stop", "--node", self.node)

    def remove_node(self):
        self.stop_node()
        self.indurop("clean", "--node", self.node)

    def obey(self, word):
        {"start-node": self.start_node, "stop-node": self.stop_node, "start-server": self.start_server,
         "stop-server": self.stop_server, "start-tour": self.start_tour, "power-on": self.power_on, "automatic": self.automatic,
         "kill-server": self.kill_server, "record": self.record, "remove-node": self.remove_node}[word]()

    def run(self, script):
        """Runs the cell and its server as long as the script drives a browser; returns its exit code."""
        try:
            self.indurop("clean", "--node", self.node)
            self.start_node()
            self.start_server()
            return self.drive(script, self.node)
        finally:
            self.end()


def main():
    options = prepared(__doc__, "--cell", "--io-module")
    with tempfile.TemporaryDirectory() as folder:
        copy_cell(options, folder)
        cell = Cell(options, folder)
        return cell.run("page.mjs")


if __name__ == "__main__":
    sys.exit(main())
