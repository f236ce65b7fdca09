#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A plant of three boards for minutes or hours: agents, nodes and tools may not grow. Each board sends 500 frames a second
to the two others. Takes a sample of every process each 10 s: memory of its own (RssAnon), open files and threads, and how long a tool, the
agents and the starts of modules take. Memory after the first fifth is judged by its slope (Theil and Sen: the median of
the slopes between all pairs, which single steps do not move). Needs root, for the boards are network namespaces."""

import argparse
import csv
import json
import os
import re
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time

BOARDS = ["soak-left", "soak-middle", "soak-right"]
EVERY_S = 10
MOST_KB_PER_MINUTE = 5.0
MOST_TIMES_SLOWER = 3.0  # of the last third against the first; builds in the background may double it
QUANTITIES = ["rss_anon_kb", "files", "threads"]


def seconds(text):
    match = re.fullmatch(r"(\d+(?:\.\d+)?)(s|m|h)", text)
    if not match:
        raise argparse.ArgumentTypeError(f"'{text}' is no time, write 20m or 2h")
    return float(match[1]) * {"s": 1, "m": 60, "h": 3600}[match[2]]


def sample(pid):
    """Of a process: RssAnon in kB, open files, threads; None if it has ended."""
    try:
        with open(f"/proc/{pid}/status", encoding="utf-8") as file:
            status = dict(line.split(":", 1) for line in file)
        return {"rss_anon_kb": int(status["RssAnon"].split()[0]), "files": len(os.listdir(f"/proc/{pid}/fd")),
                "threads": int(status["Threads"])}
    except (OSError, KeyError):
        return None


def slope(points):
    """Median of the slopes between all pairs of (minute, value), per minute."""
    slopes = [(b[1] - a[1]) / (b[0] - a[0]) for i, a in enumerate(points) for b in points[i + 1:]]
    return statistics.median(slopes) if slopes else 0.0


class Plant:
    def __init__(self, arguments):
        self.indurop = os.path.join(arguments.bin, "indurop")
        self.agent = os.path.join(arguments.bin, "indurop-agent")
        self.manifest = arguments.plant
        self.lab = [arguments.lab, "-l", f"soak{os.getpid()}"]
        self.folder = tempfile.mkdtemp(prefix="indurop-soak-")
        self.processes = {}  # our children by name
        self.up = False

    def start(self, name, board, words):
        environment = dict(os.environ, INDUROP_STATE_DIR=os.path.join(self.folder, board))
        self.processes[name] = subprocess.Popen([*self.lab, "exec", board, *words], stdout=subprocess.DEVNULL,
                                                stdin=subprocess.DEVNULL, env=environment)

    def ask(self, board, *words):
        environment = dict(os.environ, INDUROP_STATE_DIR=os.path.join(self.folder, board))
        return subprocess.run([*self.lab, "exec", board, self.indurop, *words], capture_output=True, text=True,
                              env=environment, check=False, timeout=60)

    def begin(self):
        subprocess.run([*self.lab, "up", *BOARDS], check=True)
        self.up = True
        for board in BOARDS:
            self.start(f"agent of {board}", board, [self.agent, "--quiet", "--board", board])
        done = self.ask(BOARDS[0], "deploy", self.manifest, "--timeout", "30s")
        if done.returncode != 0:
            raise RuntimeError(f"the plant was not deployed: {done.stdout}{done.stderr}")
        self.start("watch here", BOARDS[0], [self.indurop, "watch", "--node", BOARDS[0], "middle", "-o", "csv"])
        self.start("watch of a remote board", BOARDS[0],
                   [self.indurop, "watch", "--remote", "target", "-o", "csv"])

    def nodes(self):
        rows = self.ask(BOARDS[0], "nodes", "-o", "csv").stdout.splitlines()[1:]
        found = {row.split(",")[0]: row.split(",")[2] for row in rows}
        return {f"node of {board}": int(found[board]) for board in BOARDS if found.get(board)}

    def jitter(self, board):
        """Runs of its module so far, and the sum of their jitter in us."""
        jitter = json.loads(self.ask(board, "jitter", "--node", board, "-o", "json").stdout)["modules"][0]["jitter_ns"]
        return jitter["count"], jitter["count"] * jitter["mean"] / 1000

    def answer_ms(self, *words):
        began = time.monotonic()
        done = self.ask(BOARDS[0], *words)
        if done.returncode != 0:
            raise RuntimeError(f"{' '.join(words)}: {done.stdout}{done.stderr}")
        return 1000 * (time.monotonic() - began)

    def counts(self, what):
        out = {}
        for board in BOARDS:
            name = f"{board.removeprefix('soak-')}_{what}"
            value = self.ask(board, "get", "--node", board, name, "-o", "csv").stdout
            out[board] = int(re.findall(r"\d+", value.splitlines()[-1])[-1]) if value else -1
        return out

    def end(self):
        if self.up:
            subprocess.run([*self.lab, "down"], check=False)
        for process in self.processes.values():
            process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)


class Latencies:
    """How long each operation takes, in each round again."""

    def __init__(self, plant):
        self.plant = plant
        self.jitter = {board: plant.jitter(board) for board in BOARDS}

    def round(self, number):
        found = {"set of a tool that comes and goes (ms)":
                     self.plant.answer_ms("set", "--node", BOARDS[0], "target", str(number % 7)),
                 "answer of all agents (ms)": self.plant.answer_ms("boards")}
        for board in BOARDS:
            count, total = self.plant.jitter(board)
            before, self.jitter[board] = self.jitter[board], (count, total)
            found[f"mean jitter of {board} (us)"] = (total - before[1]) / max(1, count - before[0])
        return found


def watch(plant, duration, writer):
    """Rows of (minute, process, quantities), of (minute, latencies), and the processes that ended."""
    rows, times, ended = [], [], set()
    latencies = Latencies(plant)
    first = time.monotonic()
    following = first
    while time.monotonic() - first < duration:
        pids = {name: process.pid for name, process in plant.processes.items()} | plant.nodes()
        minute = (time.monotonic() - first) / 60
        for name in pids.keys() | {row[1] for row in rows}:
            found = sample(pids[name]) if name in pids else None
            if found is None:
                ended.add(name)
            else:
                rows.append((minute, name, found))
                writer.writerows([f"{minute:.2f}", name, quantity, found[quantity]] for quantity in QUANTITIES)
        following += EVERY_S
        time.sleep(max(0.0, following - time.monotonic()))
        found = latencies.round(len(times))
        times.append((minute, found))
        writer.writerows([f"{minute:.2f}", "plant", name, f"{value:.3f}"] for name, value in found.items())
    return rows, times, ended


def judge(rows, duration):
    """The lines of the table, and what is wrong."""
    lines = ["| process | RssAnon first, last (kB) | slope (kB/min) | files | threads |", "|---|---|---|---|---|"]
    wrong = []
    after = duration / 60 / 5
    for name in sorted({row[1] for row in rows}):
        mine = [(minute, found) for minute, other, found in rows if other == name and minute >= after]
        if len(mine) < 3:
            wrong.append(f"{name}: too few samples")
            continue
        series = {quantity: [found[quantity] for _, found in mine] for quantity in QUANTITIES}
        growth = slope([(minute, found["rss_anon_kb"]) for minute, found in mine])
        memory = series["rss_anon_kb"]
        lines.append(f"| {name} | {memory[0]}, {memory[-1]} | {growth:+.2f} | {min(series['files'])} to "
                     f"{max(series['files'])} | {min(series['threads'])} to {max(series['threads'])} |")
        if growth > MOST_KB_PER_MINUTE:
            wrong.append(f"{name}: its memory grows by {growth:.1f} kB a minute; at most {MOST_KB_PER_MINUTE}")
        for quantity in ("files", "threads"):
            third = max(1, len(mine) // 3)
            if min(series[quantity][-third:]) > max(series[quantity][:third]):
                wrong.append(f"{name}: more and more {quantity}: {series[quantity][0]}, then {series[quantity][-1]}")
    return lines, wrong


def judge_latencies(times):
    """As judge(): medians of the first and of the last third."""
    lines, wrong = ["", "| latency | first third | last third |", "|---|---|---|"], []
    third = max(1, len(times) // 3)
    for name in times[0][1]:
        begin = statistics.median(found[name] for _, found in times[:third])
        end = statistics.median(found[name] for _, found in times[-third:])
        lines.append(f"| {name} | {begin:.2f} | {end:.2f} |")
        if end > MOST_TIMES_SLOWER * begin:
            wrong.append(f"{name}: {begin:.2f} became {end:.2f}")
    return lines, wrong


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", required=True, type=os.path.abspath)
    parser.add_argument("--plant", required=True, type=os.path.abspath)
    parser.add_argument("--lab", required=True, type=os.path.abspath)
    parser.add_argument("--time", default=os.environ.get("INDUROP_SOAK_TIME", "20m"), type=seconds,
                        help="how long: 20m, 2h (default $INDUROP_SOAK_TIME, else 20m)")
    parser.add_argument("--csv", default="soak.csv", help="where the samples go")
    arguments = parser.parse_args()
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("ended before its time"))
    plant = Plant(arguments)
    try:
        plant.begin()
        with open(arguments.csv, "w", encoding="utf-8", buffering=1) as file:
            writer = csv.writer(file)
            writer.writerow(["minute", "process", "quantity", "value"])
            rows, times, ended = watch(plant, arguments.time, writer)
        heard, torn = plant.counts("heard"), plant.counts("torn")
    finally:
        plant.end()
    lines, wrong = judge(rows, arguments.time)
    more_lines, more_wrong = judge_latencies(times)
    lines += [*more_lines, ""]
    wrong += more_wrong
    wrong += [f"{name}: ended" for name in sorted(ended)]
    print("\n".join(lines))
    for board in BOARDS:
        print(f"{board}: {heard[board]} frames heard, {torn[board]} torn")
        if torn[board] != 0 or heard[board] < 2 * 250 * arguments.time:
            wrong.append(f"{board}: {heard[board]} frames heard, {torn[board]} torn")
    for line in wrong:
        print(f"error: {line}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
