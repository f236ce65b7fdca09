# SPDX-License-Identifier: Apache-2.0
"""A node, `indurop serve` before it, indurop-opcua before that, and node-opcua's client, which tests drive."""

import ctypes
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).parent
sys.path.insert(0, str(HERE.parent / "serve"))
sys.path.insert(0, str(HERE.parents[1] / "support"))
import harness  # noqa: E402
from harness import DEADLINE_S, wait_for  # noqa: E402, F401
from npm_packages import skip  # noqa: E402

API = "/api/v1"
MODULE = """<root><module><filename>{file}</filename><moduletype>thread</moduletype>
<operationtype>periodic</operationtype><period>1ms</period><priority>1</priority></module></root>
"""
ROBOT_MODULE = """<module><filename>{file}</filename><moduletype>thread</moduletype><operationtype>{kind}</operationtype>
<{time}>5ms</{time}><priority>{priority}</priority><budget>10s</budget>{more}</module>
"""


CLONE_NEWNET = 0x40000000


def enter_namespace():
    """A loopback without other traffic."""
    if not shutil.which("ip"):
        skip("ip is missing")
    if ctypes.CDLL(None, use_errno=True).unshare(CLONE_NEWNET) != 0:
        skip("no right to network namespaces")
    subprocess.run(["ip", "link", "set", "lo", "up"], check=True)


class Failed(Exception):
    """What the client says of a request that failed."""


def refused(attempt):
    """Why the client's request failed."""
    try:
        attempt()
    except Failed as failure:
        return str(failure)
    raise AssertionError("it was not refused")


class Client:
    def __init__(self, setting, endpoint):
        self.endpoint = endpoint
        self.child = setting.start("node", HERE / "client.mjs", os.environ["OPCUA_PACKAGES"], setting.folder,
                                   stdin=subprocess.PIPE)

    def do(self, what, **words):
        self.child.stdin.write(json.dumps({"do": what, **words}) + "\n")
        self.child.stdin.flush()
        line = self.child.stdout.readline()
        assert line, f"the client ended at '{what}'"
        answer = json.loads(line)
        if "error" in answer:
            raise Failed(answer["error"])
        return answer["done"]

    def connect(self, **words):
        return self.do("connect", url=self.endpoint, **words)

    def read(self, node, **words):
        return self.do("read", nodes=[node], **words)[0]

    def walk(self, node, depth=12):
        """All nodes below, by id."""
        found = {}
        for one in self.do("browse", node=node) if depth else []:
            if one["node"].startswith("ns=2;") and one["node"] not in found:
                found[one["node"]] = one
                found.update(self.walk(one["node"], depth - 1))
        return found

    def becomes(self, node, condition, what):
        """The newest notification of a monitored item, once it is as wanted."""
        return wait_for(lambda: (one := self.do("changes").get(node)) and condition(one) and one, what)


class Setting(harness.Setting):
    def __init__(self, programs, fake_node):
        super().__init__(pathlib.Path(programs).absolute(), fake_node)
        self.log = self.folder / "opcua.log"

    def start_real_node(self, *options):
        """A node that runs the module with a variable of each kind."""
        module = pathlib.Path(os.environ["OPCUA_MODULE"])
        shutil.copy(module, self.folder)
        (self.folder / "module.xml").write_text(MODULE.format(file=module.name))
        child = self.start(self.programs / "indurop", "run", "module.xml", "--node", self.node, "-q", *options, cwd=self.folder,
                           stderr=subprocess.DEVNULL)
        wait_for(lambda: self.get_count() > 10, "the node to count")
        return child

    def start_robot(self, urdf=None, second=None):
        """A node with the robot task of the robot cell and simulated drives. urdf: text of another arm. second: file of the arm of a
        second robot, which has no drives."""
        cell, source = (pathlib.Path(os.environ[name]) for name in ("ROBOT_CELL", "ROBOT_CELL_SOURCE"))
        (self.folder / "robot.urdf").write_text(urdf or (source / "robot.urdf").read_text())
        (self.folder / "wait.job").write_text("WAIT 3600s\n")
        devices = "".join(f"<device name='axis{i}' driver='cia402' speed='540' following='30' in='PLC_ROBOT::AXIS{i}_IN' "
                          f"out='PLC_ROBOT::AXIS{i}_OUT'/>\n" for i in range(1, 7))
        (self.folder / "ioconfig.xml").write_text(f"<ioconfig>{devices}</ioconfig>\n")
        values = lambda **all: "".join(f"<value name='{name}'>{value}</value>" for name, value in all.items())
        properties = lambda **all: f"<property>{values(**all)}</property>"
        periodic = {"kind": "periodic", "time": "period"}
        more = [ROBOT_MODULE.format(file=os.environ["SECOND_ROBOT"], priority=2, more=properties(urdf=second), **periodic)] if second else []
        (self.folder / "robot.xml").write_text("<root>" + "".join((
            ROBOT_MODULE.format(file=os.environ["IO_MODULE"], priority=1, more=properties(config="ioconfig.xml"), **periodic),
            ROBOT_MODULE.format(file=cell / "Robot.so", priority=2, **periodic,
                                more=properties(urdf="robot.urdf", jobs="wait.job", following_limit=30)),
            ROBOT_MODULE.format(file=cell / "estop.so", priority=1, kind="sporadic", time="deadline",
                                more="<position>after-base</position>"), *more)) + "</root>\n")
        with (self.folder / "robot.log").open("w+") as log:
            child = self.start(self.programs / "indurop", "run", "robot.xml", "--node", self.node, "-q", cwd=self.folder, stderr=log)
            wait_for(lambda: child.poll() is not None or self.get("PLC_ROBOT::ROBOT_MODULE_STATE.nAXESGROUP"), "the robot task to run")
            log.seek(0)
            assert child.poll() is None, log.read()
        self.set("PLC_ROBOT::I14", 1)
        self.set("PLC_ROBOT::I15", 1)
        wait_for(lambda: self.get("PLC_ROBOT::EMERGENCY_STOP.bActive") == 0, "no emergency stop")
        return child

    def indurop(self, verb, *words):
        return subprocess.run([self.programs / "indurop", verb, "--node", self.node, *map(str, words)], capture_output=True, text=True,
                              check=False, env=self.environment)

    def get(self, name):
        """The value as `indurop get` has it; None: it has none."""
        done = self.indurop("get", "-o", "json", name)
        return json.loads(done.stdout)["values"][0]["value"] if done.returncode == 0 else None

    def set(self, name, value):
        done = self.indurop("set", name, "--", value)
        assert done.returncode == 0, done.stderr

    def get_count(self):
        return self.get("every::count") or 0

    def start_opcua(self, server, *options):
        """Starts indurop-opcua; returns the endpoint's address."""
        with self.log.open("a") as log:
            child = self.start("node", self.programs / "indurop-opcua", "--serve", f"http://127.0.0.1:{server.port}", "--port", 0,
                               "--state", self.folder / "opcua", *options, stderr=log)
        line = child.stdout.readline()
        found = re.match(r"opc\.tcp://[^/]*:(\d+)", line)
        assert found, f"no address in '{line}': {self.log.read_text()}"
        self.opcua = child
        return f"opc.tcp://127.0.0.1:{found.group(1)}"

    def client(self, endpoint, **words):
        client = Client(self, endpoint)
        client.connect(**words)
        return client

    def clean(self):
        if self.log.exists():
            print("".join(f"    {line}\n" for line in self.log.read_text().splitlines()), end="")
        super().clean()

    def id(self, name):
        return f"ns=2;s={self.node}/{name}"


def main(tests):
    if not shutil.which("node"):
        skip("there is no Node.js here")
    if not (pathlib.Path(sys.argv[1]) / "indurop-opcua").exists():
        skip("indurop-opcua was not built: the registry of npm could not be reached")
    harness.Setting = Setting
    harness.main(tests)
