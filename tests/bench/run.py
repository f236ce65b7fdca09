#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs every comparison in interleaved rounds and prints medians, ratios and the target of each.

The machine may be noisy: only figures of one round are compared with each other, and what is printed is the median
over the rounds. No line is a pass or a fail on its own; the last column compares the ratio with its target."""

import argparse
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import tempfile
import time

XML = """<root>
  <module><filename>{module}</filename><moduletype>thread</moduletype><operationtype>periodic</operationtype>
    <period>{period}</period><priority>1</priority></module>
</root>
"""
STRESS = ["stress-ng", "--quiet", "--cpu", "2", "--io", "1", "--vm", "1", "--vm-bytes", "256M"]


class Bench:
    def __init__(self, arguments):
        self.bin = os.path.abspath(arguments.bin)
        self.programs = os.path.abspath(arguments.programs)
        self.rounds = arguments.rounds
        self.seconds = arguments.seconds
        self.rows = []
        self.folder = tempfile.mkdtemp(prefix="indurop-bench-")
        self.node = f"bench{os.getpid()}"
        self.dma = None

    def row(self, what, ours, theirs, ratio, target, unit=""):
        verdict = "" if target is None else ("within" if ratio <= target else "BEYOND")
        self.rows.append((what, ours, theirs, f"{ratio:.3g}", "" if target is None else f"<= {target:g}{unit}", verdict))
        print("  {:<46} {:>14} {:>14} {:>9} {:>12} {}".format(*self.rows[-1]), flush=True)

    def title(self, text):
        print(f"\n{text}\n  {'':<46} {'ours':>14} {'reference':>14} {'ratio':>9} {'target':>12}")

    def tool(self, name):
        return os.path.join(self.bin, name)

    def run_node(self, xml, *options):
        report = os.path.join(self.folder, "report.json")
        subprocess.run([self.tool("indurop-node"), xml, "--node", self.node, "-q", "--report", report, *options],
                       check=True, stdout=subprocess.DEVNULL)
        with open(report, encoding="utf-8") as file:
            return json.load(file)

    def config(self, module, period):
        path = os.path.join(self.folder, f"{os.path.basename(module)}-{period}.xml")
        with open(path, "w", encoding="utf-8") as file:
            file.write(XML.format(module=module, period=period))
        return path

    # --- release lateness against cyclictest on the same core ---
    def cyclictest(self, period_us, core):
        out = subprocess.run(["cyclictest", "-m", "-p", "90", "-a", str(core), "-t", "1", "-i", str(period_us), "-q",
                              "-h", "20000", "-D", str(self.seconds)], check=True, capture_output=True, text=True).stdout
        counts = [(int(a), int(b)) for a, b in re.findall(r"^(\d+) (\d+)$", out, re.M)]
        overflow = int(re.search(r"# Histogram Overflows: *(\d+)", out).group(1))
        total = sum(n for _, n in counts) + overflow
        expected = self.seconds * 1e6 / period_us
        return {"p50": self.quantile(counts, total, 0.5), "p99": self.quantile(counts, total, 0.99),
                "lost": max(0.0, 1 - total / expected)}

    @staticmethod
    def quantile(counts, total, fraction):
        below = 0
        for value, n in counts:
            if below + n >= fraction * total:
                # cyclictest rounds down to whole us: spread the samples of a bin evenly over it
                return (value + (fraction * total - below) / max(n, 1)) * 1000
            below += n
        return counts[-1][0] * 1000

    def lateness(self, period_us, load):
        core = max(os.sched_getaffinity(0))
        xml = self.config(os.path.join(self.programs, "tick.so"), f"{period_us}us")
        stress = subprocess.Popen(STRESS) if load else None
        results = {"off": [], "auto": [], "cyclictest": []}
        try:
            time.sleep(2.5)  # settle: what ran before lingers in the idle states
            for _ in range(self.rounds):
                results["cyclictest"].append(self.cyclictest(period_us, core))
                for spin in ("off", "auto"):
                    report = self.run_node(xml, "--duration", f"{self.seconds}s", "--spin", spin)
                    late = report["modules"][0]["latency_ns"]
                    results[spin].append({"p50": late["p50"], "p99": late["p99"],
                                          "lost": report["lost_ticks"] / report["ticks"]})
        finally:
            if stress:
                stress.terminate()
                stress.wait()
        name = f"{period_us} us {'load' if load else 'idle'}"
        targets = {"off": {"p50": 1.05, "p99": 1.05},
                   "auto": {"p50": 1 / 50, "p99": 1 / 2 if load else 1 / 3}}
        for spin in ("off", "auto"):
            for quantile in ("p50", "p99"):
                pairs = list(zip(results[spin], results["cyclictest"]))
                ratio = statistics.median(a[quantile] / max(b[quantile], 1) for a, b in pairs)
                ours = statistics.median(a[quantile] for a, _ in pairs)
                theirs = statistics.median(b[quantile] for _, b in pairs)
                self.row(f"{name}, spin {spin}, lateness {quantile}", f"{ours / 1000:.3f} us", f"{theirs / 1000:.3f} us",
                         ratio, targets[spin][quantile])
            lost = statistics.median(a["lost"] for a in results[spin])
            reference = statistics.median(b["lost"] for b in results["cyclictest"])
            self.rows.append((f"{name}, spin {spin}, lost periods", f"{lost:.3%}", f"{reference:.3%}", "", "<= cyclictest", ""))
            print("  {:<46} {:>14} {:>14} {:>9} {:>12} {}".format(*self.rows[-1]), flush=True)

    # --- costs inside one process ---
    def google(self, program, *options):
        out = subprocess.run([self.tool(program), "--benchmark_format=json", "--benchmark_repetitions=5",
                              "--benchmark_enable_random_interleaving=true", "--benchmark_min_time=0.2", *options],
                             check=True, capture_output=True, text=True).stdout
        result = {}
        for entry in json.loads(out)["benchmarks"]:
            if entry.get("aggregate_name") == "median":
                result[entry["run_name"]] = entry["cpu_time"]
        return result

    def access(self):
        self.title("Access to a shared variable from a module or a process (ns)")
        t = self.google("access_bench")
        self.row("scalar read / raw global", f"{t['scalar_read']:.2f}", f"{t['raw_scalar_read']:.2f}",
                 t["scalar_read"] / t["raw_scalar_read"], 2)
        self.row("scalar write / raw global", f"{t['scalar_write']:.2f}", f"{t['raw_scalar_write']:.2f}",
                 t["scalar_write"] / t["raw_scalar_write"], 2)
        for name, limit in (("read_24", 1.5), ("write_24", 20), ("read_256", 5), ("write_256", 22)):
            raw = t.get("raw_" + name)
            self.row(name.replace("_", " ") + " bytes, ns", f"{t[name]:.2f}", f"{raw:.2f}" if raw else "-", t[name], limit, " ns")

    def dispatch(self):
        self.title("Dispatch of an inline band, statistics and slot log included (ns per module)")
        t = self.google("dispatch_bench")
        per_module = (t["inline_band/256"] - t["inline_band/16"]) / 240
        self.row("per module of 256", f"{per_module:.1f}", f"{t['clock_read']:.1f} clock", per_module, 60, " ns")

    def tape(self):
        self.title("The tape: what it adds to a run of a module (us)")
        t = {name: ns / 1000 for name, ns in self.google("tape_bench").items()}
        for what, limit in (("all_changed/0", 0.2), ("all_changed/50", None), ("all_changed/1000", 12), ("none_changed/1000", None)):
            name, count = what.split("/")
            self.row(f"{count} values of 16 bytes, {name.replace('_', ' ')}", f"{t[what + '/manual_time']:.2f}", "-",
                     t[what + "/manual_time"], limit, " us")

    def robot(self):
        self.title("Robot task: six axes (us)")
        t = {name: ns / 1000 for name, ns in self.google("robot_bench").items()}
        for name, limit in (("forward", None), ("inverse_all_solutions", None), ("inverse_numeric", None),
                            ("profile_planned", None), ("step_along_a_path", 20)):
            self.row(name.replace("_", " "), f"{t[name]:.2f}", "-", t[name], limit, " us")

    def plc(self):
        self.title("PLC programs (us)")
        t = {name: ns / 1000 for name, ns in self.google("plc_bench").items()}
        self.row("scan of 1000 rungs, 2000 variables", f"{t['thousand_rungs']:.2f}", "-", t["thousand_rungs"], 3, " us")
        self.row("the same with --watch, by the one without", f"{t['thousand_rungs_watched']:.2f}", "-",
                 t["thousand_rungs_watched"] / t["thousand_rungs"], 1.5, "")
        self.row("loops in Structured Text / in C++", f"{t['loop_in_st']:.2f}", f"{t['loop_by_hand']:.2f}",
                 t["loop_in_st"] / t["loop_by_hand"], 1.2)

    def many(self, count, attribute):
        """A configuration of `count` modules of 1 ms in priority order."""
        path = os.path.join(self.folder, f"many{count}.xml")
        module = os.path.join(self.programs, "tick.so")
        with open(path, "w", encoding="utf-8") as file:
            file.write("<root>\n")
            for i in range(count):
                file.write(f"<module><name>m{i}</name><filename>{module}</filename><moduletype>thread</moduletype>"
                           f"<operationtype>periodic</operationtype><period>1ms</period><priority>{i}</priority>"
                           f"{attribute(i)}</module>\n")
            file.write("</root>\n")
        return path

    def bands(self):
        self.title("Further bands, and 256 modules in one tick of 1 ms")
        # Neighbours with different overrun policies do not share a band.
        xml = self.many(17, lambda i: f"<overrun>{'skip' if i % 2 == 0 else 'catch-up'}</overrun>")
        costs = []
        for _ in range(self.rounds):
            modules = self.run_node(xml, "--duration", f"{self.seconds}s")["modules"]
            costs.append((modules[16]["latency_ns"]["p50"] - modules[4]["latency_ns"]["p50"]) / 12 / 1000)
        self.row("every further band, us", f"{statistics.median(costs):.2f}", "-", statistics.median(costs), 4, " us")
        xml = self.many(256, lambda i: "")
        each = {"20": [], "0": []}
        for _ in range(self.rounds):
            for tape, found in each.items():
                modules = self.run_node(xml, "--duration", f"{self.seconds}s", "--tape", tape)["modules"]
                found.append((modules[255]["latency_ns"]["p50"] - modules[0]["latency_ns"]["p50"]) / 255)
        taped, plain = (statistics.median(found) for found in each.values())
        self.row("each of 256 modules, ns; without a tape", f"{taped:.0f}", f"{plain:.0f}", taped, 80, " ns")

    def wake(self):
        self.title("Waking a process module on the same core (ns, to its first instruction)")
        ratios = []
        values = []
        for _ in range(self.rounds):
            done = subprocess.run([self.tool("wake_bench")], capture_output=True, text=True)
            if done.returncode != 0:
                print(f"  not measured: {done.stderr.strip()}")
                return
            futex, _, module, _ = (int(x) for x in done.stdout.split())
            ratios.append(module / futex)
            values.append((module, futex))
        self.row("p50", statistics.median(v[0] for v in values), statistics.median(v[1] for v in values),
                 statistics.median(ratios), 1.3)

    def watch(self):
        self.title("`indurop watch '*'` at 10 Hz on 1000 variables of a 1 ms node (p99 lateness)")
        xml = self.config(os.path.join(self.programs, "thousand.so"), "1ms")
        pairs = []
        for _ in range(self.rounds * 2 - 1):
            alone = self.run_node(xml, "--duration", f"{self.seconds}s")["modules"][0]["latency_ns"]["p99"]
            environment = dict(os.environ, INDUROP_NODE=self.node)
            with open(os.devnull, "w", encoding="utf-8") as null:
                viewer = subprocess.Popen([self.tool("indurop"), "watch", "*", "--hz", "10"], env=environment,
                                          stdout=null, stderr=null)
                watched = self.run_node(xml, "--duration", f"{self.seconds}s")["modules"][0]["latency_ns"]["p99"]
                viewer.terminate()
                viewer.wait()
            pairs.append((watched, alone))
        self.row("watched / alone", f"{statistics.median(a for a, _ in pairs)} ns",
                 f"{statistics.median(b for _, b in pairs)} ns", statistics.median(a / b for a, b in pairs), 1.05)

    def start(self):
        self.title("Start and memory of a node with 10 modules")
        path = self.many(10, lambda i: "")
        times, memory = [], []
        for _ in range(self.rounds):
            begin = time.monotonic()
            node = subprocess.Popen([self.tool("indurop-node"), path, "--node", self.node, "--duration", "1s"],
                                    stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            for line in node.stderr:
                if "running" in line:
                    times.append((time.monotonic() - begin) * 1000)
                    with open(f"/proc/{node.pid}/status", encoding="utf-8") as status:
                        memory.append(int(re.search(r"VmRSS:\s+(\d+)", status.read()).group(1)) / 1024)
                    break
            node.communicate()
        self.row("ready, ms", f"{statistics.median(times):.1f}", "-", statistics.median(times), 100, " ms")
        self.row("resident memory, MB", f"{statistics.median(memory):.1f}", "-", statistics.median(memory), 20, " MB")

    def close(self):
        subprocess.run([self.tool("indurop"), "clean", "--node", self.node], stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL, check=False)
        shutil.rmtree(self.folder)
        if self.dma is not None:
            os.close(self.dma)

    def hold_idle_states(self):
        try:  # for the whole comparison: switching it on and off lingers for seconds and would mix two machines
            self.dma = os.open("/dev/cpu_dma_latency", os.O_WRONLY)
            os.write(self.dma, b"\0\0\0\0")
        except OSError as error:
            print(f"cpu_dma_latency cannot be held ({error.strerror}): wake-up times will be longer for everybody")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", required=True)
    parser.add_argument("--programs", required=True)
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--seconds", type=int, default=5)
    parser.add_argument("--only", default="", help="comma separated: lateness,access,dispatch,tape,robot,plc,bands,wake,watch,start")
    arguments = parser.parse_args()
    bench = Bench(arguments)
    only = set(filter(None, arguments.only.split(",")))
    bench.hold_idle_states()
    try:
        for name in ("access", "dispatch", "tape", "robot", "plc", "bands", "wake", "start", "watch"):
            if not only or name in only:
                getattr(bench, name)()
        if not only or "lateness" in only:
            bench.title("Release lateness against cyclictest on the same core, in turn")
            for load in (False, True):
                for period in (100, 1000):
                    bench.lateness(period, load)
    finally:
        bench.close()
    return 0


if __name__ == "__main__":
    sys.exit(main())
