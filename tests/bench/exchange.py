#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What exchanging a module costs. One of many modules of a node is exchanged again and again: time from the command to its end,
runs that were left out, how much longer the tick of an exchange is than the ticks just before it, memory before and after; with
--process, one that is a process, of which only the time and the runs are known. Then the boards of a plant on this host are
exchanged by a deployment: time from the command until the last board runs the new versions."""

import argparse
import json
import os
import re
import shutil
import statistics
import subprocess
import tempfile
import time

from record import quantile

CODE = """#include <indurop/generated.h>
#include <indurop/indurop.h>
namespace {{
std::uint64_t number = 0;
double filter[8] = {{}};
}}
void onRun() {{
  number += {step};
  for (double& one : filter) {{
    one += 0.1 * (static_cast<double>(number) - one);
  }}
  bench::exchange::{variable} = number;
}}
INDUROP_STATE(number, filter)
"""
AS_THREAD = "INDUROP_MODULE(run = &::onRun)\n"
AS_PROCESS = """int main() {
  if (irp::initPeriodExe() < 0) {
    return 1;
  }
  while (irp::waitPeriod()) {
    onRun();
  }
}
"""
MODULE = ("<module><filename>{file}</filename><name>{name}</name><moduletype>{type}</moduletype><operationtype>periodic</operationtype>"
          "<period>{period}</period><priority>{priority}</priority></module>")


class Bench:
    def __init__(self, options, folder, modules):
        self.options, self.folder = options, folder
        self.build = os.path.abspath(options.build)
        self.node = f"exchange{os.getpid()}"
        self.write("exchange.glb", "namespace bench.exchange;\n" + "".join(f"uint64_t v{i};\n" for i in range(modules)))
        self.check("glb2idl", "--out-dir", folder, self.path("exchange.glb"))

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, text):
        with open(self.path(name), "w", encoding="utf-8") as file:
            file.write(text)

    def words(self, program, *words):
        return [f"{self.build}/bin/{program}", *words]

    def check(self, program, *words):
        done = subprocess.run(self.words(program, *words), capture_output=True, text=True, cwd=self.folder, check=False)
        if done.returncode != 0:
            raise SystemExit(done.stdout + done.stderr)
        return done.stdout

    def compile(self, name, variable, step, process=False):
        """Returns the file of the module."""
        self.write(f"{name}.cpp", CODE.format(variable=variable, step=step) + (AS_PROCESS if process else AS_THREAD))
        file = self.path(f"{name}.{'exe' if process else 'so'}")
        subprocess.run(["g++", "-std=c++20", "-O1", "-fPIC", *([] if process else ["-shared", "-fno-gnu-unique"]),
                        f"-isystem{self.build}/include", f"-isystem{self.folder}", self.path(f"{name}.cpp"), "-o", file,
                        f"-L{self.build}/lib", "-lindurop", f"-Wl,-rpath,{self.build}/lib"], check=True)
        return file

    def status(self):
        return json.loads(self.check("indurop", "status", "--node", self.node, "-o", "json"))

    def resident_kb(self, pid):
        with open(f"/proc/{pid}/status", encoding="utf-8") as file:
            return int(re.search(r"VmRSS:\s+(\d+)", file.read())[1])

    def response_before(self, module, tick):
        """Median time from release to end of the module's runs before a tick, in ns."""
        runs = json.loads(self.check("indurop", "log", module, "--node", self.node, "-n", "200", "-o", "json"))["runs"]
        return statistics.median(run["response_ns"] for run in runs if run["tick"] < tick)


def exchange_modules(options, folder):
    bench = Bench(options, folder, options.modules)
    middle = options.modules // 2
    exchanged = f"m{middle}"
    configured = [bench.compile(f"m{i}", f"v{i}", 1, options.process and i == middle) for i in range(options.modules)]
    versions = [bench.compile("other", f"v{middle}", 2, options.process), configured[middle]]
    bench.write("module.xml", "<root>" + "".join(
        MODULE.format(file=file, name=f"m{i}", type="process" if file.endswith(".exe") else "thread", period=options.period,
                      priority=i + 1) for i, file in enumerate(configured)) + "</root>")
    node = subprocess.Popen(bench.words("indurop-node", bench.path("module.xml"), "--node", bench.node, "-q"), stdout=subprocess.DEVNULL)
    try:
        while subprocess.run(bench.words("indurop", "status", "--node", bench.node), capture_output=True, check=False).returncode != 0:
            time.sleep(0.1)
        time.sleep(1)  # its caches are warm
        lost, took, longer, left_out = bench.status()["lost_ticks"], [], [], 0
        all_began = time.monotonic()
        for i in range(options.exchanges):
            if i == options.exchanges // 10:
                memory = bench.resident_kb(node.pid)
            began = time.monotonic()
            report = json.loads(bench.check("indurop", "reload", exchanged, versions[i % 2], "--node", bench.node, "--health", "0s",
                                            "-o", "json"))
            took.append(time.monotonic() - began)
            left_out += report["left_out"]
            if not options.process:
                longer.append(report["response_ns"] - bench.response_before(exchanged, report["tick"]))
        print(f"{options.exchanges} exchanges of one of {options.modules} modules at {options.period}: command to end median "
              f"{statistics.median(took) * 1e3:.0f} ms, p99 {quantile(took, 0.99) * 1e3:.0f} ms (goal: 300)")
        between = bench.status()["lost_ticks"]
        time.sleep(time.monotonic() - all_began)
        print(f"  runs of it left out by the exchanges and the machine {left_out}; ticks lost by the node meanwhile {between - lost}, in the "
              f"same time without exchanges {bench.status()['lost_ticks'] - between}")
        if longer:
            print(f"  the tick of the exchange is longer by: median {statistics.median(longer) / 1e3:.1f} us, p99 "
                  f"{quantile(longer, 0.99) / 1e3:.1f} us (goal: 5)")
        print(f"  resident memory after a tenth of them {memory} kB, at the end {bench.resident_kb(node.pid)} kB")
    finally:
        node.terminate()
        node.wait()
        subprocess.run(bench.words("indurop", "clean", "--node", bench.node), capture_output=True, check=False)


def exchange_boards(options, folder):
    bench = Bench(options, folder, options.boards)
    boards = [f"xb{os.getpid()}_{i}" for i in range(options.boards)]
    for i in range(options.boards):
        bench.compile(f"m{i}", f"v{i}", 1)
        bench.compile(f"other{i}", f"v{i}", 2)
        shutil.copy(bench.path(f"m{i}.so"), bench.path(f"first{i}.so"))
    bench.write("plant.xml", f'<plant name="bench{os.getpid()}">' + "".join(
        f'<board name="{board}">' + MODULE.format(file=f"./m{i}.so", name=f"m{i}", type="thread", period=options.board_period, priority=1) + "</board>"
        for i, board in enumerate(boards)) + "</plant>")
    environment = {**os.environ, "INDUROP_STATE_DIR": bench.path("state")}
    agents = [subprocess.Popen(bench.words("indurop-agent", "--board", board, "--one-host", "--quiet", "--domain", "97"), env=environment)
              for board in boards]
    try:
        took = []
        for turn in range(options.deployments + 1):
            for i in range(options.boards):
                shutil.copy(bench.path((f"first{i}.so", f"other{i}.so")[turn % 2]), bench.path("next.so"))
                os.replace(bench.path("next.so"), bench.path(f"m{i}.so"))
            began = time.monotonic()
            deploy = subprocess.Popen(bench.words("indurop", "deploy", "plant.xml", "--one-host", "--domain", "97", "--health", "1s"),
                                      cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment)
            done, output = [], ""
            for line in deploy.stdout:
                output += line
                if line.split()[1:] == ["trial"]:  # it runs the new versions; how is said after the health window
                    done.append(time.monotonic() - began)
            if deploy.wait() != 0 or len(done) != options.boards:
                raise SystemExit(output)
            if turn > 0:
                if output.count("exchanged its modules in tick") != options.boards:
                    raise SystemExit(output)
                took.append(done[-1])
        print(f"{options.deployments} deployments that exchange a module on each of {options.boards} boards of this host: command to "
              f"exchanged median {statistics.median(took):.2f} s, longest {max(took):.2f} s (goal for eight: 1)")
    finally:
        for agent in agents:
            agent.terminate()
        for agent in agents:
            agent.wait()
        for board in boards:
            subprocess.run(bench.words("indurop", "clean", "--node", board), capture_output=True, check=False)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", required=True)
    parser.add_argument("--exchanges", type=int, default=1000)
    parser.add_argument("--modules", type=int, default=50)
    parser.add_argument("--period", default="1ms")
    parser.add_argument("--process", action="store_true")
    parser.add_argument("--boards", type=int, default=8)
    parser.add_argument("--board-period", default="10ms", help="long enough for all boards to run on the cores of this host")
    parser.add_argument("--deployments", type=int, default=10)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        exchange_modules(options, folder)
    if options.boards > 0:
        with tempfile.TemporaryDirectory() as folder:
            exchange_boards(options, folder)


if __name__ == "__main__":
    main()
