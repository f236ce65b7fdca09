#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Calibration of tools, frames and cameras. An oracle in numpy, written in another way, gets the same from the same points. Then the
simulated cell touches a tip whose place is known with a tool that is longer than declared: `robot calibrate` and `indurop serve`
find its length, and the next motions use it."""

import argparse
import http.client
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

import numpy

from two_arms import Arm, frame

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from nodes import new_node  # noqa: E402

TOKEN = "the-token-of-these-tests-0123456789"
DEADLINE_S = 120
MODULE = """<root>
  <module><filename>{io}</filename><name>io</name><moduletype>thread</moduletype><operationtype>periodic</operationtype>
    <period>5ms</period><priority>1</priority><budget>10s</budget><property><value name="config">ioconfig.xml</value></property></module>
  <module><filename>{cell}/Robot.so</filename><name>robot</name><moduletype>thread</moduletype><operationtype>periodic</operationtype>
    <period>5ms</period><priority>2</priority><budget>10s</budget><property><value name="urdf">robot.urdf</value>
    <value name="jobs">points.job</value><value name="following_limit">30</value></property></module>
  <module><filename>{cell}/estop.so</filename><name>estop</name><moduletype>thread</moduletype>
    <operationtype>sporadic</operationtype><deadline>1ms</deadline><priority>1</priority><position>after-base</position></module>
</root>
"""
DEVICE = "<device name='a{0}' driver='cia402' speed='540' following='30' in='PLC_ROBOT::AXIS{0}_IN' out='PLC_ROBOT::AXIS{0}_OUT'/>"
TRUE = frame((0.012, -0.02, 0.165), numpy.radians((0, 30, 0)))  # the tool as it is
TIP = numpy.array([0.5, 0.1, 0.35])  # the fixed tip
HANDS = [(180, 0, 180), (150, 0, 180), (180, -30, 180), (210, -10, 180)]  # deg, orientations of the tool


class Cell:
    """A folder with the files of a robot, and what is started for it."""

    def __init__(self, options, folder):
        self.options, self.folder, self.node = options, folder, new_node(options.bin / "indurop", "calibrate-")
        urdf = (options.source / "robot.urdf").read_text()
        (folder / "robot.urdf").write_text(re.sub(r"<collision>.*?</collision>", "", urdf, flags=re.S))
        (folder / "points.job").write_text(
            "TOOL pen = POSE 0 0 120 RPY 0 30 0   # replaced last year\nPOINT HOME = JOINT 0 -20 10 0 100 0\n"
            f"POINT P1 = POSE {' '.join(str(v) for v in 1000 * TIP)} RPY 180 0 180\n")
        (folder / "ioconfig.xml").write_text("<ioconfig>" + "".join(DEVICE.format(i) for i in range(1, 7)) + "</ioconfig>")
        (folder / "module.xml").write_text(MODULE.format(io=options.io_module, cell=options.cell))
        self.arm = Arm(folder / "robot.urdf", numpy.eye(4), numpy.array([0, 0, 0, 0.01, 0.01, 0.01]))
        self.environment = dict(os.environ, INDUROP_STATE_DIR=str(folder / "state"))
        self.environment.pop("INDUROP_NODE", None)
        self.children = []

    def start(self, *command):
        child = subprocess.Popen([str(word) for word in command], env=self.environment, cwd=self.folder,
                                 stdout=subprocess.PIPE, text=True)
        self.children.append(child)
        return child

    def end(self):
        for child in reversed(self.children):
            child.terminate()
            child.wait(DEADLINE_S)

    def indurop(self, *words, code=0):
        done = subprocess.run([self.options.bin / "indurop", *words], env=self.environment, cwd=self.folder, capture_output=True,
                              text=True, timeout=DEADLINE_S, check=False)
        assert done.returncode == code, (words, done.returncode, done.stdout, done.stderr)
        return done

    def get(self, name):
        return self.indurop("get", name, "--node", self.node).stdout.strip()

    def set(self, name, value):
        self.indurop("set", name, value, "--node", self.node)

    def serve(self, request):
        number = int(self.get("PLC_ROBOT::ROBOT_MODULE_STATE.nAcknowledge")) + 1
        self.set("PLC_ROBOT::ROBOT_MODULE_SERVICE", f"{{nRequest: {number}, {request}}}")
        self.wait(lambda: int(self.get("PLC_ROBOT::ROBOT_MODULE_STATE.nDone")) == number, request)
        return self.get("PLC_ROBOT::ROBOT_MODULE_STATE.nError")

    def expect(self, request):
        error = self.serve(request)
        assert error in ("0", "ROBOT_OK"), (request, error, *(self.get(f"PLC_ROBOT::{name}") for name in (
            "ROBOT_MODULE_STATE", "ROBOT_JOB.cMessage", "EMERGENCY_STOP")))

    @staticmethod
    def wait(condition, what):
        end = time.monotonic() + DEADLINE_S
        while not condition():
            assert time.monotonic() < end, f"waited in vain for {what}"
            time.sleep(0.05)

    def joints(self, which="joint"):
        return numpy.array([float(self.get(f"PLC_ROBOT::ROBOT_ARM.{which}[{i}]")) for i in range(6)])

    def flange(self, joints):
        return self.arm.links(numpy.radians([joints]))["tool0"][0]

    def reach(self, flange, joints):
        """The joint angles (deg) at which the end of the arm is there, by Newton's method with differences."""
        joints = numpy.array(joints, dtype=float)

        def off(values):
            now = self.flange(values)
            turn = now[:3, :3].T @ flange[:3, :3]
            return numpy.concatenate([flange[:3, 3] - now[:3, 3],
                                      now[:3, :3] @ [turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]]])
        for _ in range(50):
            rest = off(joints)
            slope = numpy.array([(off(joints + 1e-4 * one) - rest) / 1e-4 for one in numpy.eye(6)]).T
            joints -= numpy.clip(numpy.linalg.lstsq(slope, rest, rcond=None)[0], -20, 20)
        assert numpy.linalg.norm(off(joints)) < 1e-9, off(joints)
        return joints

    def touch(self, hand, at):
        """Moves there with the true tool."""
        tool = frame(at, numpy.radians(hand))
        joints = self.reach(tool @ numpy.linalg.inv(TRUE), [10, -10, 20, 0, 80, 0])
        self.expect("eOpCode: 8, dTarget: [" + ", ".join(f"{v:.6f}" for v in joints) + "]")
        self.wait(lambda: numpy.abs(self.joints() - joints).max() < 0.001, "the arm to arrive")

    def begin(self):
        """In virtual time, so that a busy machine does not make the arm late."""
        self.start(self.options.bin / "indurop", "run", "module.xml", "--sim", "--speed", "1", "--node", self.node, "-q")
        self.wait(lambda: subprocess.run([self.options.bin / "indurop", "get", "PLC_ROBOT::I14", "--node", self.node],
                                         env=self.environment, capture_output=True, check=False).returncode == 0, "the node")
        # A request that is there at the first run may be older than a restart of the robot: it is aborted.
        self.wait(lambda: self.get("PLC_ROBOT::ROBOT_MODULE_STATE.nAXESGROUP") == "6", "the first run of the robot")
        self.set("PLC_ROBOT::I14", "1")
        self.set("PLC_ROBOT::I15", "1")
        self.wait(lambda: self.get("PLC_ROBOT::EMERGENCY_STOP.bActive") in ("0", "false"), "the emergency stop to be released")
        self.expect("eOpCode: 1")

    def tip_at_p1(self):
        """How far the true tip is from P1 (m) once the robot has moved there with its tool."""
        self.indurop("robot", "reload", "--node", self.node)
        self.expect("eOpCode: 14, nTool: 1")
        self.expect("eOpCode: 8, dTarget: [0, -20, 10, 0, 100, 0]")
        self.expect("eOpCode: 5, p_Target: 1")
        self.wait(lambda: numpy.abs(self.joints("command") - self.joints()).max() < 0.001, "the arm to arrive")
        return numpy.linalg.norm((self.flange(self.joints()) @ TRUE)[:3, 3] - TIP)


def words(matrix):
    """As a POSE of a job file."""
    r = matrix[:3, :3]
    rpy = numpy.degrees([numpy.arctan2(r[2, 1], r[2, 2]), -numpy.arcsin(r[2, 0]), numpy.arctan2(r[1, 0], r[0, 0])])
    return "POSE " + " ".join(f"{v:.9f}" for v in 1000 * matrix[:3, 3]) + " RPY " + " ".join(f"{v:.9f}" for v in rpy)


def declared(declaration):
    numbers = [float(word) for word in re.findall(r"-?\d+\.?\d*", declaration.split("=")[1])]
    return frame(numpy.array(numbers[:3]) / 1000, numpy.radians(numbers[3:6]))


def compare_with_numpy(cell, random):
    """Two results are equal up to the digits that are written, a thousandth of a mm and of a degree."""
    def result(kind, lines):
        (cell.folder / "oracle.txt").write_text("".join(line + "\n" for line in lines))
        return json.loads(cell.indurop("robot", "calibrate", kind, "sample", "--points", "oracle.txt", "--config", "module.xml",
                                       "-o", "json").stdout)

    def anything(far):
        return frame(random.uniform(-far, far, 3), random.uniform(-1.2, 1.2, 3))
    for _ in range(5):
        tool, place = anything(0.2), random.uniform(-0.5, 0.5, 3)
        ends = []
        for _ in range(7):
            end = anything(0.4)
            end[:3, 3] = place - end[:3, :3] @ tool[:3, 3] + random.normal(0, 2e-4, 3)
            ends.append(end)
        # R_i t - c = -p_i
        found = numpy.linalg.lstsq(numpy.vstack([numpy.hstack([end[:3, :3], -numpy.eye(3)]) for end in ends]),
                                   numpy.concatenate([-end[:3, 3] for end in ends]), rcond=None)[0]
        now = result("tool", ["TIP " + words(end) for end in ends])
        assert now["wrong"] == "", now
        assert numpy.abs(declared(now["declaration"])[:3, 3] - found[:3]).max() < 1e-6, (now, found)
        rest = [1000 * numpy.linalg.norm(end[:3, :3] @ found[:3] + end[:3, 3] - found[3:]) for end in ends]
        assert numpy.abs(numpy.array([one["off"] for one in now["points"]]) - rest).max() < 1e-5, (now, rest)

        camera = anything(0.5)
        seen = random.uniform(-0.2, 0.2, (6, 3))
        touched = seen @ camera[:3, :3].T + camera[:3, 3] + random.normal(0, 2e-4, (6, 3))
        u, _, v = numpy.linalg.svd((touched - touched.mean(0)).T @ (seen - seen.mean(0)))
        turn = u @ numpy.diag([1, 1, numpy.linalg.det(u @ v)]) @ v
        shift = touched.mean(0) - turn @ seen.mean(0)
        now = result("camera", ["SEEN " + " ".join(f"{v:.9f}" for v in 1000 * s) + " AT " + words(frame(t, (0, 0, 0)))
                                for s, t in zip(seen, touched)])
        assert numpy.abs(declared(now["declaration"])[:3, 3] - shift).max() < 1e-6, (now, shift)
        assert numpy.abs(declared(now["declaration"])[:3, :3] - turn).max() < 3e-5, (now, turn)


def calibrate_by_command(cell):
    words_of = ("robot", "calibrate", "tool", "pen", "--node", cell.node)
    assert cell.tip_at_p1() > 0.02, "the declared tool is right, so nothing is tested"
    for hand in HANDS:
        cell.touch(hand, TIP)
        cell.indurop(*words_of, "--take")
    now = json.loads(cell.indurop(*words_of, "-o", "json").stdout)
    assert now["wrong"] == "" and now["rms"] < 0.05, now
    off = 1000 * numpy.linalg.norm(declared(now["declaration"])[:3, 3] - TRUE[:3, 3])
    print(f"tool by command: {now['declaration']}, {off:.4f} mm off, residuals {now['rms']:.4f} mm rms")
    assert off < 0.1, now
    cell.indurop(*words_of, "--accept")
    text = (cell.folder / "points.job").read_text()
    assert "UTC: TOOL pen = POSE 0 0 120 RPY 0 30 0\n" in text and "# replaced last year" in text, text
    assert cell.tip_at_p1() < 1e-4, cell.tip_at_p1()


def calibrate_by_http(cell):
    (cell.folder / "points.job").write_text(re.sub("(?m)^TOOL pen.*", "TOOL pen = POSE 0 0 120 RPY 0 30 0",
                                                   (cell.folder / "points.job").read_text()))
    (cell.folder / "tokens").write_text(f"ana {TOKEN}\n")
    (cell.folder / "tokens").chmod(0o600)
    child = cell.start(cell.options.bin / "indurop-serve", "--node", cell.node, "--port", "0", "--write", "--token-file", "tokens")
    port = int(re.search(r":(\d+)/", child.stdout.readline())[1])

    def ask(method, path, body=None, token=TOKEN):
        connection = http.client.HTTPConnection("127.0.0.1", port, timeout=DEADLINE_S)
        headers = {"Content-Type": "application/json", **({"Authorization": "Bearer " + token} if token else {})}
        connection.request(method, f"/api/v1/{path}", None if body is None else json.dumps(body), headers)
        answer = connection.getresponse()
        return answer.status, json.loads(answer.read())
    path = f"boards/{cell.node}/robots/robot/calibrations/tool/pen"
    status, now = ask("GET", path)
    assert status == 200 and now["next_mark"] == "TIP" and now["points"] == [], now
    assert ask("POST", path + "/take", {"robot": "PLC_ROBOT"}, token=None)[0] in (401, 403)
    assert ask("POST", path + "/accept", {})[0] == 409
    assert ask("GET", path.replace("/tool/", "/spoon/"))[0] == 404
    for hand in HANDS:
        cell.touch(hand, TIP)
        status, now = ask("POST", path + "/take", {"robot": "PLC_ROBOT", "reason": "a new tip"})
        assert status == 200, now
    status, now = ask("POST", path + "/drop", {"point": 4})
    assert status == 200 and len(now["points"]) == 3 and now["wrong"], now
    status, now = ask("POST", path + "/take", {"robot": "PLC_ROBOT", "mark": "TIP"})
    assert status == 200 and now["wrong"] == "" and now["rms"] < 0.05, now
    status, now = ask("POST", path + "/accept", {"reason": "a new tip"})
    assert status == 200, now
    assert cell.tip_at_p1() < 1e-4, cell.tip_at_p1()
    actions = [one["action"] for one in ask("GET", "audit")[1]["audit"]]
    assert {"take calibration point", "drop calibration point", "accept calibration"} <= set(actions), actions
    print(f"tool by HTTP: {now['declaration']}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for option in ("--bin", "--cell", "--source"):
        parser.add_argument(option, type=lambda text: pathlib.Path(text).resolve(), required=True)
    parser.add_argument("--io-module", required=True)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        cell = Cell(options, pathlib.Path(folder))
        try:
            compare_with_numpy(cell, numpy.random.default_rng(1))
            cell.begin()
            calibrate_by_command(cell)
            calibrate_by_http(cell)
        finally:
            cell.end()


if __name__ == "__main__":
    main()
