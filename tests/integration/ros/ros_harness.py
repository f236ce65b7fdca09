# SPDX-License-Identifier: Apache-2.0
"""The robot task with simulated drives, a master of ROS 1, and a door to ROS, which tests drive."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from processes import free_port  # noqa: E402

DEADLINE_S = 60


def skip(why):
    print(f"skipped: {why}", file=sys.stderr)
    sys.exit(77)


def wait_for(condition, what, limit=DEADLINE_S):
    end = time.monotonic() + limit
    while time.monotonic() < end:
        found = condition()
        if found:
            return found
        time.sleep(0.02)
    raise AssertionError(f"not within {limit} s: {what}")


class Setting:
    def __init__(self, programs, cell, source, io_module):
        self.programs, self.cell, self.source = (pathlib.Path(one).absolute() for one in (programs, cell, source))
        self.io_module = pathlib.Path(io_module).absolute()
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="indurop_ros_"))
        self.node = f"ros{os.getpid()}"
        self.children = []
        self.port = free_port()
        os.environ.update(ROS_MASTER_URI=f"http://127.0.0.1:{self.port}", ROS_IP="127.0.0.1",
                          ROS_HOME=str(self.folder / "ros"), ROS_LOG_DIR=str(self.folder / "ros"))
        os.environ["PATH"] = f"{self.programs}:{os.environ['PATH']}"

    def __enter__(self):
        return self

    def __exit__(self, kind, value, trace):
        if kind is not None:
            for log in sorted(self.folder.glob("*.log")):
                print(f"--- {log.name}\n{log.read_text()[-3000:]}", file=sys.stderr)
        for child in reversed(self.children):
            child.terminate()
        for child in reversed(self.children):
            try:
                child.wait(20)
            except subprocess.TimeoutExpired:
                child.kill()
        self.indurop("clean", check=False)
        shutil.rmtree(self.folder, ignore_errors=True)

    def start(self, name, *words):
        with (self.folder / f"{name}.log").open("a") as log:
            child = subprocess.Popen([str(word) for word in words], stdout=log, stderr=log, cwd=self.folder)
        self.children.append(child)
        return child

    def indurop(self, verb, *words, check=True):
        done = subprocess.run(["indurop", verb, "--node", self.node, *map(str, words)], capture_output=True, text=True)
        assert not check or done.returncode == 0, done.stderr
        return done.stdout.strip()

    def get(self, name):
        return self.indurop("get", name)

    def number(self, name):
        return float(self.get(name))

    def set(self, name, value):
        self.indurop("set", name, value)

    def start_master(self):
        master = self.start("master", "/usr/bin/python3", shutil.which("rosmaster", path="/usr/bin"), "--core", "-p", self.port)
        import rosgraph
        wait_for(rosgraph.is_master_online, "the master")
        return master

    def start_robot(self):
        shutil.copy(self.source / "robot.urdf", self.folder)
        (self.folder / "test.job").write_text("POINT A = JOINT 0 0 0 0 0 0\nMOVJ A\n")
        devices = "".join(f"<device name='axis{i}' driver='cia402' speed='540' following='30' in='PLC_ROBOT::AXIS{i}_IN' "
                          f"out='PLC_ROBOT::AXIS{i}_OUT'/>\n" for i in range(1, 7))
        (self.folder / "ioconfig.xml").write_text(f"<ioconfig>{devices}</ioconfig>\n")

        def module(file, kind, period, priority, **properties):
            values = "".join(f"<value name='{name}'>{value}</value>" for name, value in properties.items())
            more = "<position>after-base</position>" if kind == "sporadic" else ""
            time = "deadline" if kind == "sporadic" else "period"
            return (f"<module><filename>{file}</filename><moduletype>thread</moduletype><operationtype>{kind}"
                    f"</operationtype><{time}>{period}</{time}><priority>{priority}</priority><budget>10s</budget>"
                    f"<property>{values}</property>{more}</module>\n")
        (self.folder / "module.xml").write_text("<root>" + module(self.io_module, "periodic", "5ms", 1, config="ioconfig.xml")
            + module(self.cell / "Robot.so", "periodic", "5ms", 2, urdf="robot.urdf", jobs="test.job", following_limit=30,
                     rated_torque="200 200 200 200 200 200")
            + module(self.cell / "estop.so", "sporadic", "1ms", 1).replace("<property></property>", "") + "</root>\n")
        # What an earlier node has left can be read and set, but is not what this one starts with.
        log = self.folder / "node.log"
        before = log.read_text().count("running 3 modules") if log.exists() else 0
        self.start("node", "indurop", "run", "module.xml", "--node", self.node)
        wait_for(lambda: log.read_text().count("running 3 modules") > before, "the node")
        self.set("PLC_ROBOT::I14", 1)
        self.set("PLC_ROBOT::I15", 1)
        wait_for(lambda: self.number("PLC_ROBOT::EMERGENCY_STOP.bActive") == 0, "no emergency stop")

    def log_of_door(self, name="door"):
        return (self.folder / f"{name}.log").read_text()

    def start_door(self, *options, program="indurop-ros1", name="door"):
        door = self.start(name, program, "--node", self.node, *options)
        wait_for(lambda: f"node {self.node}: " in self.log_of_door(name), "the topics")
        return door
