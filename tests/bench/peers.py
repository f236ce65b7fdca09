#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Peers side by side: what is late, and what a message costs, with the same period, core and priority and the same sizes, in
interleaved rounds. Writes peers.json, peers.md and charts. Peers whose packages are not installed are left out and named.

Timers: a module of one line, cyclictest, a thread of LinuxCNC, a timer of roscpp; FIFO 90 on one core, memory locked.
Messages: written and read in one thread, so that waking a thread does not count; between boards see mirror.py."""

import argparse
import contextlib
import json
import os
import shutil
import statistics
import subprocess
import sys
import time

import charts
import growth
import run

SIZES = (64, 256, 4096)


def json_lines(text):
    return [json.loads(line) for line in text.splitlines() if line.startswith("{")]


@contextlib.contextmanager
def in_background(command, **options):
    """A program that has to run meanwhile."""
    process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, **options)
    try:
        time.sleep(3)
        yield
    finally:
        process.terminate()
        process.wait()


class Peers(run.Bench):
    def __init__(self, arguments):
        super().__init__(arguments)
        self.peers = os.path.abspath(arguments.peers)
        self.left_out = []
        self.ros_environment = {**os.environ, "ROS_MASTER_URI": "http://127.0.0.1:11377", "ROS_IP": "127.0.0.1",
                                "ROS_HOME": self.folder}

    def has(self, program, needs=""):
        there = os.path.exists(os.path.join(self.peers, program)) and (not needs or shutil.which(needs))
        if not there and program not in self.left_out:
            self.left_out.append(program)
        return bool(there)

    def ros_master(self):
        master = shutil.which("rosmaster")
        return in_background(["/usr/bin/python3", master, "--core", "-p", "11377"], env=self.ros_environment)

    def peer(self, program, *words, environment=None):
        environment = {**(environment or os.environ), "PEERS_STARTED": str(time.clock_gettime_ns(time.CLOCK_MONOTONIC))}
        done = subprocess.run([os.path.join(self.peers, program), *words], check=True, capture_output=True, text=True,
                              env=environment)
        return json_lines(done.stdout)

    # --- messages ---
    def messages_of(self, name):
        if name == "iceoryx" and self.has("message_iceoryx", "iox-roudi"):
            with in_background(["iox-roudi"]):
                return self.peer("message_iceoryx")
        if name == "roscpp" and self.has("message_ros", "rosmaster"):
            with self.ros_master():
                return self.peer("message_ros", environment=self.ros_environment)
        if name in ("ours", "cyclone", "fastdds") and self.has(f"message_{name}"):
            return self.peer(f"message_{name}")
        return []

    def messages(self):
        """By peer: nanoseconds by bytes, and what it takes until the first message: milliseconds, megabytes."""
        rounds = {}
        for _ in range(self.rounds):
            for name in ("ours", "iceoryx", "cyclone", "fastdds", "roscpp"):
                for row in self.messages_of(name):
                    found = rounds.setdefault(name, {})
                    for key in ("start_ms", "resident_mb"):
                        if key in row:
                            found.setdefault(key, []).append(row[key])
                    if row.get("ns") is not None:
                        found.setdefault(row["bytes"], []).append(row["ns"])
        return {name: {what: statistics.median(values) for what, values in found.items()} for name, found in rounds.items()}

    # --- timers ---
    def timer_of(self, name, period_us, core):
        if name == "cyclictest":
            return self.cyclictest(period_us, core) if shutil.which("cyclictest") else None
        if name == "LinuxCNC":
            script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "peers", "linuxcnc.py")
            done = subprocess.run([sys.executable, script, str(period_us), str(self.seconds), str(core)], check=False,
                                  capture_output=True, text=True)
            if done.returncode and name not in self.left_out:
                self.left_out.append(name)
            return json_lines(done.stdout)[0] if done.returncode == 0 else None
        if name == "roscpp":
            if not self.has("timer_ros", "rosmaster"):
                return None
            with self.ros_master():
                return self.peer("timer_ros", str(period_us), str(self.seconds), str(core), environment=self.ros_environment)[0]
        xml = self.config(os.path.join(self.programs, "tick.so"), f"{period_us}us")
        report = self.run_node(xml, "--duration", f"{self.seconds}s", "--core", str(core), "--spin", name.split()[-1])
        late = report["modules"][0]["latency_ns"]
        return {"p50": late["p50"], "p99": late["p99"], "lost": report["lost_ticks"] / max(report["ticks"], 1)}

    def timers(self, periods):
        core = max(os.sched_getaffinity(0))
        rounds = {}
        for period in periods:
            for _ in range(self.rounds):
                for name in ("ours, spin auto", "ours, spin off", "cyclictest", "LinuxCNC", "roscpp"):
                    if found := self.timer_of(name, period, core):
                        rounds.setdefault((period, name), []).append(found)
        return [{"period_us": period, "peer": name,
                 **{key: statistics.median(r[key] for r in found) for key in ("p50", "p99", "lost")}}
                for (period, name), found in rounds.items()]


def markdown(found):
    lines = ["# Peers side by side", "", "Written by `make bench-peers`; how to read these figures: "
             "[benchmarks](../benchmarks.md#peers-side-by-side).", "",
             f"Medians of {found['rounds']} rounds of {found['seconds']} s; load of the machine at the beginning: {found['load']:.1f}.",
             "", "| one message written and read, ns | " + " | ".join(f"{size} B" for size in SIZES) +
             " | first message after, ms | memory then, MB |", "|---" * 6 + "|"]
    for name, one in found["messages"].items():
        lines.append(f"| {name} | " + " | ".join(f"{one[size]:.0f}" if size in one else "-" for size in SIZES) +
                     f" | {one.get('start_ms', 0):.0f} | {one.get('resident_mb', 0):.1f} |")
    lines += ["", "| period | | late p50, us | p99, us | lost |", "|---" * 5 + "|"]
    for row in found["timers"]:
        lines.append(f"| {row['period_us']} us | {row['peer']} | {row['p50'] / 1000:.2f} | {row['p99'] / 1000:.1f} | "
                     f"{row['lost']:.3%} |")
    for title, rows in found["growth"].items():
        names = list(rows[0])
        lines += ["", f"| {title}: {names[0]} | " + " | ".join(names[1:]) + " |", "|---" * len(names) + "|"]
        lines += ["| " + " | ".join(f"{row[name]:.4g}" for name in names) + " |" for row in rows]
    return "\n".join(lines) + "\n"


def draw(found, folder):
    timers = {}
    for row in found["timers"]:
        timers.setdefault(row["peer"], {})[row["period_us"]] = row["p99"] / 1000
    messages = {name: {size: one[size] for size in SIZES if size in one} for name, one in found["messages"].items()}
    charts.write(os.path.join(folder, "timers.svg"), charts.lines("99 % of the calls are not later than (us)", "period, us", timers))
    charts.write(os.path.join(folder, "messages.svg"), charts.lines("one message written and read (ns)", "bytes", messages))
    for title, rows in found["growth"].items():
        x, *names = rows[0]
        lines = {name: {row[x]: row[name] for row in rows} for name in names}
        charts.write(os.path.join(folder, f"{title}.svg"), charts.lines(title, x, lines, growth.knee(rows)))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", required=True, help="folder of indurop-node")
    parser.add_argument("--programs", required=True, help="folder of tick.so")
    parser.add_argument("--peers", required=True, help="folder of message_ours and the others")
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--seconds", type=int, default=10)
    parser.add_argument("--periods", type=int, nargs="*", default=[100, 250, 1000], help="microseconds")
    parser.add_argument("--out", default=".")
    arguments = parser.parse_args()
    peers = Peers(arguments)
    found = {"load": os.getloadavg()[0], "rounds": arguments.rounds, "seconds": arguments.seconds,
             "messages": peers.messages(), "timers": peers.timers(arguments.periods), "growth": growth.measure(peers),
             "left_out": peers.left_out}
    os.makedirs(arguments.out, exist_ok=True)
    with open(os.path.join(arguments.out, "peers.json"), "w", encoding="utf-8") as file:
        json.dump(found, file, indent=1)
        file.write("\n")
    with open(os.path.join(arguments.out, "peers.md"), "w", encoding="utf-8") as file:
        file.write(markdown(found))
    draw(found, arguments.out)
    print(markdown(found))
    if found["load"] > 0.5:
        print(f"The machine did other things (load {found['load']:.1f}): figures of timers are worth nothing.")
    if peers.left_out:
        print(f"Left out, packages are missing: {', '.join(peers.left_out)}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
