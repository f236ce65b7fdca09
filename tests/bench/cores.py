#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How much work a tick does on two cores, compared with one: eight modules of equal work that share nothing, released
every 2 ms, in interleaved rounds. What counts is the median of the time until the last of them is done. Wants a machine
that does nothing else."""

import argparse
import json
import os
import statistics
import subprocess
import sys
import tempfile

MODULE = """  <module><filename>{file}</filename><name>work{number}</name><moduletype>thread</moduletype>
    <operationtype>periodic</operationtype><period>2ms</period><priority>{number}</priority><wcet>100us</wcet><budget>off</budget>
    <property><value name="rounds">{rounds}</value></property></module>
"""
MODULES = 8


def run(arguments, folder, cores, rounds):
    """Milliseconds until the last module of a tick is done."""
    file, report = os.path.join(folder, "module.xml"), os.path.join(folder, "report.json")
    modules = "".join(MODULE.format(file=os.path.abspath(arguments.module), number=n, rounds=rounds)
                      for n in range(1, MODULES + 1))
    with open(file, "w", encoding="utf-8") as out:
        out.write(f"<root><cores>{cores}</cores>\n{modules}</root>\n")
    subprocess.run([os.path.join(arguments.bin, "indurop-node"), file, "--node", f"cores{os.getpid()}", "-q", "--duration",
                    f"{arguments.seconds}s", "--report", report], check=True, stdout=subprocess.DEVNULL)
    with open(report, encoding="utf-8") as read:
        found = json.load(read)
    if found["lost_ticks"]:
        print(f"  {found['lost_ticks']} ticks lost on {cores} core(s): the machine was busy")
    return max(m["response_ns"]["p50"] for m in found["modules"]) / 1e6


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", required=True)
    parser.add_argument("--module", required=True, help="work.so")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--seconds", type=int, default=5)
    arguments = parser.parse_args()
    if len(os.sched_getaffinity(0)) < 2:
        print("skipped: needs two cores")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        once = run(arguments, folder, 1, 10_000)
        rounds = int(10_000 * 0.8 / once)  # eight modules take 0.8 ms on one core
        ratios = []
        for _ in range(arguments.rounds):
            one, two = run(arguments, folder, 1, rounds), run(arguments, folder, 2, rounds)
            ratios.append(one / two)
            print(f"  done after {one:.3f} ms on one core, {two:.3f} ms on two: {one / two:.2f} times the work")
    print(f"two cores do {statistics.median(ratios):.2f} times the work of one in a tick (goal 1.8)")
    return 0


if __name__ == "__main__":
    sys.exit(main())
