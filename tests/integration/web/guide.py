#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Guiding by hand on the page: the simulated arm with masses (examples/robot_contact) and the hand that pushes it; headless Chromium
starts guiding, marks a point and writes a job. Then what is around an arm: frames, a belt that moves, and a part that the tool
tracks, and a pallet. Pictures of the views are left in WORK/pictures."""

import pathlib
import sys
import tempfile
import time

from page_server import PATIENCE, PageServer, prepared

PALLETS = "P1 x 3 60 y 2 60 z 2 50 CONTACT::seen.nStops"
BELT_JOB = """POINT BEGIN  = POSE 480 -350 180 RPY 180 0 0
POINT END    = POSE 480 350 180 RPY 180 0 0
POINT SIDE   = POSE 380 -350 180 RPY 180 0 0
FRAME conveyor = POINTS BEGIN END SIDE
FRAME pallet = POSE -300 400 60 RPY 0 0 30
POINT P1     = POSE 0 0 40 RPY 180 0 0 IN pallet
POINT P2     = POSE 0 -90 40 RPY 180 0 0 IN pallet
FRAME part   = POSE 480 -150 180 RPY 0 0 90
POINT ABOVE  = POSE 0 0 90 RPY 180 0 90 IN part
KEEPOUT feet = BOX 430 -350 0 530 350 100
TOOL hand
part = conveyor : POSE 150, 0, 0 RPY 0, 0, 0
TRACK part ON BELT 1 ALONG conveyor
MOVL ABOVE SPEED 200 mm/s
WAIT 12s
TRACK OFF
"""


class GuidedArm(PageServer):
    node = "web_guide"

    def start_node(self):
        self.indurop("run", "module.xml", "--sim", "--speed", "0.5", "--detach", "--node", self.node, check=True)

    def set(self, name, value):
        self.indurop("set", "--node", self.node, "--", name, value, check=True)

    def get(self, name):
        return self.indurop("get", "--node", self.node, name, check=True).stdout.strip()

    def wait_for(self, name, value):
        end = time.monotonic() + PATIENCE
        while self.get(name) != value:
            assert time.monotonic() < end, (name, value, self.get(name), self.get("PLC_ROBOT::ROBOT_JOB.cMessage"))
            time.sleep(0.1)

    def request(self, request):
        number = int(self.get("PLC_ROBOT::ROBOT_MODULE_STATE.nAcknowledge")) + 1
        self.set("PLC_ROBOT::ROBOT_MODULE_SERVICE", f"{{nRequest: {number}, {request}}}")
        return number

    def serve(self, request):
        self.wait_for("PLC_ROBOT::ROBOT_MODULE_STATE.nDone", str(self.request(request)))

    def mode(self, mode):
        self.set("PLC_ROBOT::ROBOT_MODE", f"{{eMode: {mode}, bEnable: 1}}")
        self.wait_for("PLC_ROBOT::ROBOT_ARM.eMode", mode)

    def obey(self, word):
        if word == "manual":
            self.mode("ROBOT_MODE_MANUAL")
            self.wait_for("PLC_ROBOT::ROBOT_MODULE_STATE.eState", "ROBOT_GROUP_STANDBY")
            self.serve("eOpCode: SVC_AD_TOOL, nTool: 1")
        elif word == "lean":  # not as hard as in a collision
            self.set("CONTACT::hand", "[0, 25, 0, 0, 0, 0]")
        elif word == "push":
            self.set("CONTACT::hand", "[0, 40, 0, 0, 0, 0]")
        elif word == "let-go":
            self.set("CONTACT::hand", "[0, 0, 0, 0, 0, 0]")
        elif word == "fill":
            self.set("CONTACT::seen", "{nStops: 5}")
        elif word == "track":
            self.request("eOpCode: SVC_JB_START, nJob: 2")  # which is done when the job ends
            self.wait_for("PLC_ROBOT::ROBOT_JOB.name", '"belt"')
        else:
            raise AssertionError(word)


def copy_arm(options, folder):
    """In the order of the module.xml; a program moves a belt."""
    for file in ("module.xml", "ioconfig.xml", "arm.urdf", "swing.job"):
        text = (options.example / file).read_text()
        text = text.replace("./libiodispat.so", str(options.io_module)).replace("<filename>./", f"<filename>{options.example}/")
        text = text.replace("5 5.4 2 -60   10 10.4 1 60   15 15.4 4 18", "").replace(">swing.job<", ">swing.job belt.job<")
        text = text.replace("<root>", f"""<root>
  <module><filename>{options.belt}</filename><moduletype>thread</moduletype><operationtype>periodic</operationtype>
    <period>4000000</period><priority>5</priority></module>""")
        text = text.replace('<value name="urdf">arm.urdf</value>\n      <value name="jobs">', f'<value name="pallets">{PALLETS}</value>'
                            '<value name="urdf">arm.urdf</value>\n      <value name="jobs">')
        (folder / file).write_text(text)
    (folder / "belt.job").write_text(BELT_JOB)


def main():
    options = prepared(__doc__, "--example", "--io-module", "--belt")
    with tempfile.TemporaryDirectory() as folder:
        copy_arm(options, pathlib.Path(folder))
        arm = GuidedArm(options, folder)
        try:
            arm.start_node()
            arm.start_server()
            return arm.drive("guide.mjs", arm.node)
        finally:
            arm.end()


if __name__ == "__main__":
    sys.exit(main())
