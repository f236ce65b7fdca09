# SPDX-License-Identifier: Apache-2.0
"""Two nodes of this machine and indurop-pools between them, in a network of their own (or, without the right to that, in
a DDS domain of their own)."""

import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time

PATIENCE_S = 60
LARGE = "pooltest::Flow::large"
SMALL = "pooltest::Flow::small"


def own_network():
    """Runs this script again in a network namespace, with loopback only."""
    if os.environ.get("POOLS_TEST_NETWORK") or os.geteuid() != 0 or not shutil.which("ip"):
        return
    if subprocess.run(["unshare", "-n", "true"], capture_output=True, check=False).returncode == 0:
        os.environ["POOLS_TEST_NETWORK"] = "own"
        command = "ip link set lo up && exec \"$@\""
        os.execvp("unshare", ["unshare", "-n", "sh", "-c", command, "sh", sys.executable, *sys.argv])


def wait_for(condition, what):
    end = time.monotonic() + PATIENCE_S
    while time.monotonic() < end:
        if found := condition():
            return found
        time.sleep(0.05)
    raise AssertionError(f"{what}: not in {PATIENCE_S} s")


class Setting:
    def __init__(self):
        own_network()
        self.programs, self.build = (pathlib.Path(one).resolve() for one in sys.argv[1:3])
        self.source = pathlib.Path(__file__).parents[3]
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="pools-"))
        self.domain = 1 + os.getpid() % 200
        self.children = {}
        self.commands = {}
        self.environment = {**os.environ, "POOLS_TEST_FOLDER": str(self.folder),
                            "INDUROP_STATE_DIR": str(self.folder / "state"),
                            "CYCLONEDDS_URI": "<General><Interfaces><NetworkInterface name=\"lo\" multicast=\"true\"/>"
                                              "</Interfaces></General>"}
        for name in ("FASTRTPS_DEFAULT_PROFILES_FILE", "FASTDDS_DEFAULT_PROFILES_FILE"):  # Fast DDS 2, 3
            self.environment[name] = str(self.source / "examples/external/loopback_fastdds.xml")
        self.environment.pop("INDUROP_NODE", None)
        self.random = random.Random(int(os.environ.get("POOLS_TEST_SEED", "1")))

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        for child in self.children.values():
            child.kill()
            child.wait()
        for name in ("a", "b", "c"):
            subprocess.run([self.programs / "indurop", "clean", "--node", self.node(name)], capture_output=True,
                           check=False, env=self.environment)
        if kind:
            for log in sorted(self.folder.glob("*.log")):
                print(f"--- {log.name}\n{log.read_text()[-3000:]}", file=sys.stderr)
        shutil.rmtree(self.folder, ignore_errors=True)

    def node(self, name):
        return f"pools-{name}-{os.getpid()}"

    def start(self, key, command):
        """Starts or starts again; its output is appended to KEY.log."""
        self.commands[key] = command
        with open(self.folder / f"{key}.log", "a", encoding="utf-8") as log, \
                open(self.folder / f"{key}.out", "a", encoding="utf-8") as out:
            self.children[key] = subprocess.Popen([str(word) for word in command], stdout=out, stderr=log,
                                                  env=self.environment)

    def start_again(self, key):
        self.start(key, self.commands[key])

    def configuration(self, modules):
        text = "".join(f"<module><filename>{self.build / file}</filename><moduletype>process</moduletype>"
                       f"<operationtype>periodic</operationtype><period>{period}</period><priority>{number + 1}</priority>"
                       "<restart delay=\"10ms\" max=\"1000\"/></module>" for number, (file, period) in enumerate(modules))
        file = self.folder / (modules[0][0] + ".xml")
        file.write_text(f"<root>{text}</root>")
        return file

    def start_node(self, name, modules, *more):
        file = self.configuration(modules)
        self.start("node-" + name, [self.programs / "indurop-node", file, "--node", self.node(name), *more])
        self.wait_for_node(name)

    def wait_for_node(self, name):
        pid = self.children["node-" + name].pid
        wait_for(lambda: (status := self.status(name)).get("state") == "running" and status["pid"] == pid,
                 f"node {name} runs")

    def pools(self, key, name, *options):
        self.start(key, [self.programs / "indurop-pools", "--node", self.node(name), "--one-host", "--domain",
                         self.domain, "--report", "200ms", "-o", "json", *options])

    def counts(self, key):
        """The newest counts that indurop-pools has reported, by pool."""
        lines = [line for line in (self.folder / f"{key}.out").read_text().splitlines() if line.endswith("}")]
        return {one["pool"]: one for one in json.loads(lines[-1])["pools"]} if lines else {}

    def says(self, key, text):
        return text in (self.folder / f"{key}.log").read_text()

    def indurop(self, *words):
        return subprocess.run([self.programs / "indurop", *words], capture_output=True, text=True, check=False,
                              env=self.environment, timeout=PATIENCE_S)

    def status(self, name):
        done = self.indurop("status", "--node", self.node(name), "-o", "json")
        return json.loads(done.stdout) if done.returncode == 0 else {}

    def value(self, name, variable):
        done = self.indurop("get", "--node", self.node(name), "pooltest::Flow::" + variable, "-o", "json")
        return json.loads(done.stdout)["values"][0]["value"] if done.returncode == 0 else 0

    def pool(self, name, pool):
        done = self.indurop("get", "--node", self.node(name), pool, "-o", "json")
        return json.loads(done.stdout)["pools"][0] if done.returncode == 0 else None

    def grows(self, name, variable, by, what):
        first = self.value(name, variable)
        wait_for(lambda: self.value(name, variable) >= first + by, what)

    def wrong_chunks(self):
        return sorted(path.name for path in self.folder.glob("wrong-*"))

    def kill(self, key):
        self.children[key].kill()
        self.children[key].wait()

    def end(self, key):
        """Ends it in an orderly way; returns its exit code."""
        self.children[key].send_signal(signal.SIGTERM)
        return self.children[key].wait(timeout=PATIENCE_S)


def expect(condition, what):
    if not condition:
        raise AssertionError(what)
