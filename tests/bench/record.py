#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What recording costs: a module that changes many variables in each run, recorded to a file. Each round runs the node
without a recorder, with one, and without a tape; only figures of one round are compared, what is printed is the median
over the rounds. How late runs begin changes from minute to minute on a shared machine, more than a recorder could do to
it: that is compared on one running node, with a recorder in every other window of a few seconds."""

import argparse
import contextlib
import json
import os
import pathlib
import re
import resource
import signal
import statistics
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "support"))
from nodes import new_node  # noqa: E402

CODE = """#include <indurop/generated.h>
#include <indurop/indurop.h>
static std::uint64_t number = 0;
void onRun() {{
  ++number;
{writes}
}}
INDUROP_MODULE(run = &::onRun)
"""


class Node:
    def __init__(self, options, folder):
        self.options, self.folder = options, folder
        self.name = new_node(self.tool("indurop"), "bench")
        self.config = os.path.join(folder, "module.xml")
        self.build()

    def tool(self, name):
        return os.path.join(os.path.abspath(self.options.build), "bin", name)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def build(self):
        names = [f"v{i}" for i in range(self.options.variables)]
        self.write("many.glb", "namespace many;\nstruct Pair {\n  double a;\n  uint64_t b;\n}\n" + "".join(f"Pair {one};\n" for one in names))
        self.write("many.cpp", CODE.format(writes="".join(
            f"  many::{one} = many::Pair{{static_cast<double>(number) * 0.37 + {i}, number ^ {i}U}};\n" for i, one in enumerate(names))))
        self.compile()

    def compile(self):
        """many.glb and many.cpp as a module of 1 ms."""
        build = os.path.abspath(self.options.build)
        subprocess.run([self.tool("glb2idl"), "--out-dir", self.folder, self.path("many.glb")], check=True)
        subprocess.run(["g++", "-std=c++20", "-O1", "-fPIC", "-shared", "-fno-gnu-unique", f"-isystem{build}/include", f"-isystem{self.folder}",
                        self.path("many.cpp"), "-o", self.path("many.so"), f"-L{build}/lib", "-lindurop", f"-Wl,-rpath,{build}/lib"], check=True)
        self.write("module.xml", f"<root><module><filename>{self.path('many.so')}</filename><moduletype>thread</moduletype>"
                   f"<operationtype>periodic</operationtype><period>1ms</period><priority>1</priority></module></root>")

    def start(self, *words):
        return subprocess.Popen([self.tool("indurop"), "run", self.config, "--node", self.name, "-q", *words], stdout=subprocess.DEVNULL)

    def latencies(self, seconds):
        """From release to start of the runs of the last seconds, in ns."""
        runs = subprocess.run([self.tool("indurop"), "log", "--node", self.name, "-n", str(int(seconds * 1000)), "-o", "json"],
                              capture_output=True, text=True, check=True)
        return [one["latency_ns"] for one in json.loads(runs.stdout)["runs"]]

    @contextlib.contextmanager
    def recorder(self):
        child = subprocess.Popen([self.tool("indurop"), "record", "-o", self.path("run.mcap"), "--node", self.name, "-q"])
        time.sleep(1)  # it has begun
        yield
        child.send_signal(signal.SIGINT)
        child.wait()
        os.remove(self.path("run.mcap"))

    def windows(self, pairs, seconds, load):
        """Latencies without and with what `load` runs, a list of windows each."""
        node = self.start("--tape", str(self.options.tape))
        time.sleep(2)  # the node has started and its caches are warm
        without, with_it = [], []
        try:
            for _ in range(pairs):
                time.sleep(seconds)
                without.append(self.latencies(seconds))
                with load():
                    time.sleep(seconds)
                    with_it.append(self.latencies(seconds))
        finally:
            node.send_signal(signal.SIGTERM)
            node.wait()
        return without, with_it

    def run(self, tape, record):
        """The report of a run, and what the recorder said and took."""
        report, file = self.path("report.json"), self.path("run.mcap")
        seconds = self.options.seconds
        if os.path.exists(file):
            os.remove(file)
        node = self.start("--report", report, "--duration", f"{seconds + 3}s", "--tape", str(tape))
        recorded = None
        if record:
            time.sleep(1)  # the node has started
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            began = time.monotonic()
            done = subprocess.run([self.tool("indurop"), "record", "-o", file, "--node", self.name, "--duration", f"{seconds}s"],
                                  capture_output=True, text=True, check=False)
            took = time.monotonic() - began
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
            lost = re.search(r"(\d+) runs of \S+ are not in the recording", done.stderr)
            runs = re.search(r": (\d+) runs, (\d+) values", done.stderr)
            if runs is None:
                raise SystemExit(done.stderr)
            recorded = {"lost": int(lost.group(1)) if lost else 0, "runs": int(runs.group(1)), "values": int(runs.group(2)),
                        "core": used / took, "bytes": os.path.getsize(file)}
        node.wait()
        with open(report, encoding="utf-8") as said:
            return json.load(said), recorded


def quantile(values, part):
    return sorted(values)[int(part * (len(values) - 1))]


def print_lateness(without, with_it, what):
    """Both evaluations: of all runs, and the median over pairs of neighbouring windows."""
    for name, part in (("median", 0.5), ("p99", 0.99)):
        before, after = (quantile([one for window in windows for one in window], part) for windows in (without, with_it))
        pairs = statistics.median(quantile(b, part) / quantile(a, part) for a, b in zip(without, with_it))
        print(f"{name} of the start after the release: {before / 1e3:.2f} us without, {after / 1e3:.2f} us with {what}, "
              f"x {after / before:.2f}; of {len(without)} pairs of windows x {pairs:.2f} (goal of p99: 1.05)")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", required=True)
    parser.add_argument("--seconds", type=int, default=60)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--variables", type=int, default=1000, help="of 16 bytes each")
    parser.add_argument("--tape", type=int, default=8, help="of the node, in MB")
    parser.add_argument("--pairs", type=int, default=20, help="of windows without and with a recorder")
    parser.add_argument("--window", type=float, default=2, help="seconds")
    options = parser.parse_args()
    rows = []
    with tempfile.TemporaryDirectory(prefix="indurop-bench-") as folder:
        node = Node(options, folder)
        for number in range(options.rounds):
            plain, _ = node.run(options.tape, False)
            with_it, recorded = node.run(options.tape, True)
            without, _ = node.run(0, False)
            row = {**recorded, "load": os.getloadavg()[0],
                   "tape_us": (plain["modules"][0]["exec_ns"]["p50"] - without["modules"][0]["exec_ns"]["p50"]) / 1e3,
                   "lost_ticks": with_it["lost_ticks"]}
            rows.append(row)
            print(f"round {number + 1}: {row['lost']} of {row['runs'] + row['lost']} runs lost, {row['values']} values, "
                  f"{row['bytes'] / 1e6:.0f} MB, recorder {100 * row['core']:.0f} % of a core, tape {row['tape_us']:.1f} us per run, "
                  f"{row['lost_ticks']} ticks lost, load {row['load']:.1f}", flush=True)
        if rows:
            median = {key: statistics.median(row[key] for row in rows) for key in rows[0]}
            print(f"median: {median['lost']:.0f} runs lost (goal 0), recorder {100 * median['core']:.0f} % of a core (goal 30), "
                  f"tape {median['tape_us']:.1f} us per run (goal 12)", flush=True)
        print_lateness(*node.windows(options.pairs, options.window, node.recorder), "a recorder")


if __name__ == "__main__":
    main()
