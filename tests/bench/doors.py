#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What the doors for other programs cost (doors/), each with its goal. cell: the robot cell with all of them open in every other
window of a few seconds, the doors kept off the core of the tick (the last one). opcua: 10 000 variables of which 1 000 change, five
clients. python: reads, and a stream of 16 variables that change in each tick of 1 ms. Needs an idle machine."""

import argparse
import contextlib
import json
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

from record import Node, print_lateness

SOURCE = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(SOURCE / "tests/support"))
from processes import cpu_seconds, free_port  # noqa: E402

SCRAPER = "import sys, time, urllib.request\nwhile True:\n  urllib.request.urlopen(sys.argv[1]).read()\n  time.sleep(1)\n"
FOLLOWER = "import indurop, sys\nwith indurop.node(sys.argv[1]).stream('ROBOT_ARM') as rows:\n  for some in rows: pass\n"


class Shares:
    """Shares of a core that children take in a while."""

    def __init__(self, children):
        self.children, self.begin = children, time.monotonic()
        self.before = {name: cpu_seconds(child.pid) for name, child in children.items()}

    def now(self):
        took = time.monotonic() - self.begin
        return {name: 100 * (cpu_seconds(child.pid) - self.before[name]) / took for name, child in self.children.items()}


class Doors(Node):
    """A node of the robot cell, or of generated variables, and programs around it that are kept on the other cores."""

    def __init__(self, options, folder):
        self.build_folder = pathlib.Path(options.build).resolve()
        super().__init__(options, folder)
        cores = sorted(os.sched_getaffinity(0))
        self.apart = ["taskset", "-c", ",".join(map(str, cores[:-1]))] if len(cores) > 1 else []
        os.environ["PATH"] = f"{self.build_folder}/bin:{os.environ['PATH']}:/usr/sbin"
        os.environ["PYTHONPATH"] = f"{self.build_folder}/python"

    def door(self, name, *command, **more):
        with open(self.path(f"{name}.log"), "w", encoding="utf-8") as log:
            return subprocess.Popen([*self.apart, *map(str, command)], **{"stdin": subprocess.DEVNULL, "stdout": log,
                                                                          "stderr": subprocess.STDOUT, **more})

    def found_in(self, name, pattern):
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline:
            found = re.search(pattern, pathlib.Path(self.path(f"{name}.log")).read_text(encoding="utf-8"))
            if found:
                return found.group(0)
            time.sleep(0.02)
        raise SystemExit(f"{name} did not print {pattern}")

    def opcua_client(self, name, url, items, interval_ms):
        command = ["node", SOURCE / "tests/bench/doors_client.mjs", self.build_folder / "doors/opcua/work", self.path(name), url, items,
                   interval_ms]
        child = subprocess.Popen([*self.apart, *map(str, command)], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                                 stderr=subprocess.DEVNULL, text=True)
        return child, json.loads(child.stdout.readline())

    def end(self, children):
        for child in children:
            child.terminate()
        for child in children:
            child.wait()


class Cell(Doors):
    def build(self):
        shutil.copytree(self.build_folder / "examples/robot_cell", self.folder, dirs_exist_ok=True)

    def latencies(self, seconds):
        runs = subprocess.run([self.tool("indurop"), "log", "--node", self.name, "-n", str(int(seconds * 1000)), "-o", "json"],
                              capture_output=True, text=True, check=True)
        return [one["latency_ns"] for one in json.loads(runs.stdout)["runs"] if one["module"] == "Robot"]

    def open(self):
        doors = {"serve": self.door("serve", "indurop-serve", "--node", self.name, "--port", 0, "--metrics", "ROBOT_ARM")}
        http = self.found_in("serve", r"http://[^ /]*")
        port, master = free_port(), free_port()
        with open(self.path("broker.conf"), "w", encoding="utf-8") as file:
            file.write(f"listener {port} 127.0.0.1\nallow_anonymous true\npersistence false\n")
        doors["mosquitto"] = self.door("broker", "mosquitto", "-c", self.path("broker.conf"))
        self.found_in("broker", "running")
        doors["indurop-mqtt"] = self.door("mqtt", "indurop-mqtt", "--serve", http, "--broker", f"mqtt://127.0.0.1:{port}", "--sparkplug",
                                          "cell", "--state", self.path("mqtt"))
        doors["mosquitto_sub"] = self.door("sub", "mosquitto_sub", "-p", port, "-t", "#", "-F", "%t %l")
        doors["scraper of /metrics"] = self.door("metrics", "python3", "-c", SCRAPER, f"{http}/metrics")
        doors["indurop-opcua"] = self.door("opcua", "indurop-opcua", "--serve", http, "--port", 0, "--anonymous", "--state",
                                           self.path("opcua"))
        doors["client of OPC UA"], _ = self.opcua_client("client", self.found_in("opcua", "opc.tcp://[^ ]*"), 10000, 100)
        doors["stream in Python"] = self.door("python", "/usr/bin/python3", "-c", FOLLOWER, self.name)
        doors["recorder"] = self.door("record", "indurop", "record", "--node", self.name, "-o", self.path("run.mcap"), "-q")
        environment = {**os.environ, "ROS_MASTER_URI": f"http://127.0.0.1:{master}", "ROS_IP": "127.0.0.1", "ROS_HOME": self.folder}
        doors["rosmaster"] = self.door("master", "/usr/bin/python3", "/usr/bin/rosmaster", "--core", "-p", master, env=environment)
        doors["indurop-ros1"] = self.door("ros1", "indurop-ros1", "--node", self.name, "--urdf", self.path("robot.urdf"), env=environment)
        doors["rostopic echo"] = self.door("echo", "/usr/bin/python3", "/usr/bin/rostopic", "echo", "/joint_states", env=environment)
        doors["indurop-ros2"] = self.door("ros2", "indurop-ros2", "--node", self.name, "--urdf", self.path("robot.urdf"))
        return doors

    @contextlib.contextmanager
    def opened(self):
        doors = self.open()
        time.sleep(self.options.settle)
        ended = [name for name, child in doors.items() if child.poll() is not None]
        if ended:
            raise SystemExit(f"has ended, so nothing was measured: {', '.join(ended)}")
        shares = Shares(doors)
        yield
        self.shares.append(shares.now())
        self.end(doors.values())
        pathlib.Path(self.path("run.mcap")).unlink(missing_ok=True)

    def measure(self):
        self.shares = []
        node = self.start_cell()
        time.sleep(5)
        without, with_it = [], []
        for _ in range(self.options.pairs):
            time.sleep(self.options.window)
            without.append(self.latencies(self.options.window))
            with self.opened():
                time.sleep(self.options.window)
                with_it.append(self.latencies(self.options.window))
        self.end([node])
        print_lateness(without, with_it, "all doors")
        for name in self.shares[0]:
            print(f"{name}: {statistics.median(one[name] for one in self.shares):.1f} % of a core")

    def start_cell(self):
        node = subprocess.Popen([self.tool("indurop"), "run", self.path("module.xml"), "--node", self.name, "-q"], stdout=subprocess.DEVNULL)
        self.until("I14", "1")
        self.until("EMERGENCY_STOP.bActive", "0")
        subprocess.run([self.tool("indurop"), "set", "--node", self.name, "CELL::tour", "true"], check=True)
        return node

    def until(self, name, value):
        for _ in range(300):
            done = subprocess.run([self.tool("indurop"), "get", "--node", self.name, name], capture_output=True, text=True, check=False)
            if done.stdout.strip() == value:
                return
            time.sleep(0.1)
        raise SystemExit(f"{name} did not become {value}")


class Many(Doors):
    """Single numbers, of which some change in each period of 1 ms."""

    count, changing = 0, 0

    def build(self):
        self.write("many.glb", "namespace many;\n" + "".join(f"double v{i};\n" for i in range(self.count)) + "struct Big {\n  double a[32];\n}\nBig big;\n")
        self.write("many.cpp", "#include <indurop/generated.h>\n#include <indurop/indurop.h>\nstatic std::uint64_t number = 0;\nvoid onRun() {\n  ++number;\n"
                   + "".join(f"  many::v{i} = static_cast<double>(number) * 0.37 + {i};\n" for i in range(self.changing))
                   + "  if (number == 0) many::big = many::Big{};\n" + "}\nINDUROP_MODULE(run = &::onRun)\n")
        self.compile()

    @contextlib.contextmanager
    def running(self):
        node = self.start()
        time.sleep(2)  # the node has started and its caches are warm
        yield
        self.end([node])


class Opcua(Many):
    count, changing = 10000, 1000

    def measure(self):
        with self.running():
            for each in (2000, 10000):
                self.round(each)

    def round(self, each):
        serve = self.door("serve", "indurop-serve", "--node", self.name, "--port", 0)
        http = self.found_in("serve", r"http://[^ /]*")
        begin = time.monotonic()
        server = self.door("opcua", "indurop-opcua", "--serve", http, "--port", 0, "--anonymous", "--state", self.path("opcua"))
        url = self.found_in("opcua", "opc.tcp://[^ ]*")
        started = time.monotonic() - begin
        clients, reports = zip(*(self.opcua_client(f"client{i}", url, each, 100) for i in range(5)))
        time.sleep(3)
        before, begin = self.values(clients), time.monotonic()
        shares = Shares({"indurop-opcua": server, "indurop-serve": serve})
        time.sleep(self.options.seconds)
        taken, took = shares.now(), time.monotonic() - begin
        rate = (self.values(clients) - before) / took
        print(f"five clients with {reports[0]['items']} items each: start {started:.1f} s (goal 2), {reports[0]['nodes']} nodes browsed in "
              f"{min(one['browse_s'] for one in reports):.2f} s (goal 2), {rate:.0f} values a second, "
              f"indurop-opcua {taken['indurop-opcua']:.0f} % of a core (goal 100), indurop-serve {taken['indurop-serve']:.0f} %", flush=True)
        self.end([*clients, server, serve])

    @staticmethod
    def values(clients):
        total = 0
        for one in clients:
            one.stdin.write("values\n")
            one.stdin.flush()
            total += json.loads(one.stdout.readline())["values"]
        return total


READS = """import indurop, sys, timeit
node = indurop.node(sys.argv[1])
number, big = node.variable('v0'), node.variable('big')
for name, read in (('number (goal 300)', lambda: number.value), ('256 bytes by numpy (goal 1000)', big.numpy)):
  print(f"{name}: {min(timeit.repeat(read, number=100000, repeat=7)) * 1e4:.0f} ns", flush=True)
"""
STREAM = """import indurop, resource, sys, time
names, seconds = [f'v{i}' for i in range(16)], float(sys.argv[2])
begin, ticks, gaps, last = time.monotonic(), 0, 0, None
with indurop.node(sys.argv[1]).stream(*names) as stream:
  for rows in stream:
    at = rows['@tick']
    if last is not None: gaps += int(at[0]) - last - 1
    gaps += int(at[-1]) - int(at[0]) + 1 - len(at)
    last, ticks = int(at[-1]), ticks + len(at)
    if time.monotonic() - begin > seconds: break
  use = resource.getrusage(resource.RUSAGE_SELF)
  took = time.monotonic() - begin
  print(f"stream of 16 variables: {ticks} ticks in {took:.0f} s, {gaps} gaps, {stream.lost} lost (goal 0), "
        f"{100 * (use.ru_utime + use.ru_stime) / took:.1f} % of a core (goal 10)")
"""


class Python(Many):
    count, changing = 16, 16

    def lost_ticks(self):
        done = subprocess.run([self.tool("indurop"), "status", "--node", self.name, "-o", "json"], capture_output=True, text=True, check=False)
        return json.loads(done.stdout)["lost_ticks"]

    def measure(self):
        with self.running():
            for code in (READS, STREAM):
                before = self.lost_ticks()
                subprocess.run([*self.apart, "/usr/bin/python3", "-c", code, self.name, str(self.options.seconds)], check=True)
            print(f"ticks that the node itself lost meanwhile, which are gaps, too: {self.lost_ticks() - before}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", choices=["cell", "opcua", "python"])
    parser.add_argument("--build", required=True)
    parser.add_argument("--pairs", type=int, default=10, help="of windows without and with all doors")
    parser.add_argument("--window", type=float, default=5, help="seconds")
    parser.add_argument("--settle", type=float, default=4, help="seconds after all doors have been opened")
    parser.add_argument("--seconds", type=float, default=30, help="of a measurement of opcua and python")
    options = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="indurop-bench-", ignore_cleanup_errors=True) as folder:
        print(f"load before: {os.getloadavg()[0]:.1f}", flush=True)
        {"cell": Cell, "opcua": Opcua, "python": Python}[options.what](options, folder).measure()


if __name__ == "__main__":
    sys.exit(main())
