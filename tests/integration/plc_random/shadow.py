#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Random PLC programs run on a node, and each module is compared with itself as a shadow: nothing may differ.

shadow.py --build DIR [--count N] [--seed S] [--time T]: 0 if all are equal."""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import time

from driver import Failed
from exchange import build_module
from program import Program

MODULE = """<module><filename>{file}</filename><name>{name}</name><moduletype>thread</moduletype>
<operationtype>periodic</operationtype><period>{period}ms</period><priority>{priority}</priority></module>
"""


class Node:
    def __init__(self, build, folder, modules):
        self.program = os.path.join(build, "bin/indurop")
        self.name = f"plcshadow-{os.getpid()}"
        self.environment = dict(os.environ, INDUROP_STATE_DIR=os.path.join(folder, "state"))
        self.environment.pop("INDUROP_NODE", None)
        file = os.path.join(folder, "module.xml")
        with open(file, "w", encoding="utf-8") as xml:
            xml.write("<root>\n")
            for i, (name, path) in enumerate(modules):
                xml.write(MODULE.format(file=path, name=name, period=5 * (1 + i % 2), priority=i + 1))
            xml.write("</root>\n")
        self.node = subprocess.Popen([os.path.join(build, "bin/indurop-node"), "--node", self.name, "--quiet", file],
                                     env=self.environment, stdout=subprocess.DEVNULL)

    def indurop(self, *arguments):
        return subprocess.run([self.program, *arguments, "--node", self.name], env=self.environment, capture_output=True,
                              text=True, timeout=300)

    def await_start(self):
        end = time.monotonic() + 60
        while self.indurop("status").returncode != 0:
            if time.monotonic() > end or self.node.poll() is not None:
                raise Failed(f"the node did not start: {self.indurop('status').stderr}")
            time.sleep(0.1)

    def end(self):
        self.node.terminate()
        self.node.wait(timeout=60)
        self.indurop("clean")


def compare(node, name, seconds):
    """The report, and what is wrong in words."""
    done = node.indurop("reload", name, "--shadow", seconds, "-o", "json")
    report = json.loads(done.stdout).get("shadow") if done.stdout else None
    if report is None:
        return {}, f"{name}: exit code {done.returncode}: {done.stderr}"
    wrong = [one for one in report["variables"] if one["differing"] or one["unclear"] or not one["compared"]]
    return report, f"{name}: {done.stderr}{wrong}" if done.returncode != 0 or wrong else ""


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", required=True)
    parser.add_argument("--count", type=int, default=int(os.environ.get("INDUROP_PLC_SHADOWS", "24")))
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--time", default="1500ms")
    parser.add_argument("--batch", type=int, default=6)
    options = parser.parse_args()
    build = os.path.abspath(options.build)
    programs = []
    for seed in range(options.seed, options.seed + options.count):
        one = Program(seed, seed)
        if one.ends() and not any(fault for fault, _ in one.scans()):
            programs.append(one)
    bad, runs, values = [], 0, 0
    with tempfile.TemporaryDirectory() as scratch:
        _, missing = build_module(build, os.path.join(scratch, "all"), "all", programs)
        kept = [one for one in programs if one.prefix not in missing]
        modules = []
        for begin in range(0, len(kept), options.batch):
            name = f"batch{begin}"
            modules.append((name, build_module(build, os.path.join(scratch, name), name, kept[begin:begin + options.batch])[0]))
        node = Node(build, scratch, modules)
        try:
            node.await_start()
            for name, _ in modules:
                report, text = compare(node, name, options.time)
                runs += report.get("runs", 0)
                values += sum(one["compared"] for one in report.get("variables", []))
                bad += [text] if text else []
        finally:
            node.end()
    for text in bad[:10]:
        print(text)
    print(f"{len(kept)} programs in {len(modules)} modules: {runs} runs, {values} values, {len(bad)} modules differ")
    return 1 if bad or runs == 0 or values == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
