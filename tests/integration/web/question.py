#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Questions of a job on the page: the robot cell gets one more job, which asks for one of three answers and for a number;
headless Chromium answers them. Pictures of the views are left in WORK/pictures."""

import pathlib
import sys
import tempfile

from page_server import prepared
from run import Cell, copy_cell

JOB = """ASK tray = "Which tray has the parts?" CHOICE "left", "right", "none"
ASK count = "How many parts are in tray ", tray, "?" 1 TO 40 TIMEOUT 600s
SET O15 = tray * 100 + count
"""


class AskingCell(Cell):
    def obey(self, word):
        if word != "ask":
            super().obey(word)
            return
        self.power_on()
        acknowledged = self.indurop("get", "--node", self.node, "PLC_ROBOT::ROBOT_MODULE_STATE.nAcknowledge", check=True)
        self.indurop("set", "--node", self.node, "PLC_ROBOT::ROBOT_MODULE_SERVICE",
                     f"{{eOpCode: SVC_JB_START, nJob: 6, nLine: 0, nRequest: {int(acknowledged.stdout) + 1}}}", check=True)


def add_job(folder):
    module = folder / "module.xml"
    text = module.read_text().replace("glue.job", "glue.job ask.job")
    text = text.replace("<write>PLC_ROBOT::O10</write>", "<write>PLC_ROBOT::O10</write><write>PLC_ROBOT::O15</write>")
    module.write_text(text)
    (folder / "ask.job").write_text(JOB)


def main():
    options = prepared(__doc__, "--cell", "--io-module")
    with tempfile.TemporaryDirectory() as folder:
        copy_cell(options, folder)
        add_job(pathlib.Path(folder))
        cell = AskingCell(options, folder)
        cell.node = "web_question"
        return cell.run("question.mjs")


if __name__ == "__main__":
    sys.exit(main())
