#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Faults of ten kinds done to nodes that run in real time, and what `indurop explain` says of each: never a wrong culprit.
INDUROP_EXPLAIN_LIVE says how many faults, 10 without it. What is judged by time may be hidden by other programs on a busy
machine; the answer then says that it does not know, or what the kernel counted. With 100 and more, on a machine without
other work, 95 of 100 have to be right."""

import argparse
import getpass
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from nodes import new_node  # noqa: E402

PATIENCE = 120
SPIN_MS = 60  # six periods of 10 ms, less than what is taken for a hang


def wait_until(what, condition):
    end = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > end:
            sys.exit(f"waited in vain until {what}")
        time.sleep(0.02)


def module(file, name, period, priority, more=""):
    kind = "process" if file.endswith(".exe") else "thread"
    operation = "periodic" if period else "sporadic"
    time_of = f"<period>{period}</period>" if period else "<deadline>10ms</deadline><position>after-base</position>"
    return (f"<module><filename>{file}</filename><name>{name}</name><moduletype>{kind}</moduletype>"
            f"<operationtype>{operation}</operationtype>{time_of}<priority>{priority}</priority>{more}</module>")


class Live:
    def __init__(self, options):
        self.options = options
        self.work = options.work
        shutil.rmtree(self.work, ignore_errors=True)
        self.work.mkdir(parents=True)
        self.node = new_node(options.indurop, "explain")
        self.environment = dict(os.environ, INDUROP_STATE_DIR=str(self.work / "state"))
        self.user = getpass.getuser()

    def tool(self, *words, check=True):
        done = subprocess.run([self.options.indurop, *map(str, words)], capture_output=True, text=True, env=self.environment,
                              cwd=self.work, check=False)
        if check and done.returncode != 0:
            sys.exit(f"indurop {' '.join(map(str, words))}: {done.returncode}\n{done.stdout}{done.stderr}")
        return done.stdout

    def start(self, *words):
        return subprocess.Popen([self.options.indurop, *map(str, words)], env=self.environment, cwd=self.work,
                                stdout=subprocess.DEVNULL, stderr=open(self.work / "node.log", "a", encoding="utf-8"))

    def get(self, name):
        rows = json.loads(self.tool("get", name, "--node", self.node, "-o", "json"))
        return rows["values"][0]["value"]

    def set(self, name, value):
        self.tool("set", f"{name}={value}", "--node", self.node)

    def status(self):
        return json.loads(self.tool("status", "--node", self.node, "-o", "json"))

    def module(self, name):
        return next(one for one in self.status()["modules"] if one["name"] == name)

    def explain(self, what, *more, number=0):
        answers = json.loads(self.tool("explain", what, *more, "-o", "json"))["answers"]
        return answers[number]

    def ask(self, what, *more, number=0):
        return self.explain(what, "--node", self.node, *more, number=number)

    def let_pass(self, runs=40):
        """Waits for so many more runs, so that the kernel's counters before them have been read."""
        now = self.get("el::ticks")
        wait_until("the node goes on", lambda: self.get("el::ticks") >= now + runs)

    def begin(self):
        modules = self.options.modules
        (self.work / "module.xml").write_text("<root>" + "".join([
            module(f"{modules}/live_first.so", "first", "10ms", 1), module(f"{modules}/live_second.so", "second", "20ms", 2),
            module(f"{modules}/live_event.so", "event", None, 1), module(f"{modules}/live_thrower.so", "thrower", "20ms", 3),
            module(f"{modules}/live_process.exe", "process", "20ms", 4, '<restart delay="300ms" max="1000" window="1s"/>'),
        ]) + "</root>", encoding="utf-8")
        self.program = self.start("run", "module.xml", "--node", self.node, "-q")
        wait_until("the node runs", lambda: self.lives() and self.tool("get", "el::ticks", "--node", self.node, check=False) != ""
                   and self.get("el::ticks") > 50)
        self.set("el::spin_ms", SPIN_MS)

    def lives(self):
        if self.program.poll() is not None:
            sys.exit((self.work / "node.log").read_text(encoding="utf-8"))
        return True

    def end(self):
        self.program.send_signal(signal.SIGINT)
        self.program.wait()

    # The kinds: each gives the answer, and what is right.

    def do(self, wanted, done):
        number = self.get(wanted) + 1
        self.set(wanted, number)
        wait_until(f"{done} is done", lambda: self.get(done) == number)
        tick = self.get("el::tick")
        self.let_pass()
        return tick

    def own_time(self):
        tick = self.do("el::first_wanted", "el::first_done")
        return self.ask("first", "--tick", tick), ("own-time", "first")

    def predecessor(self):
        tick = self.do("el::first_wanted", "el::first_done")
        return self.ask("second", "--tick", tick), ("own-time", "first")

    def event(self):
        tick = self.do("el::event_wanted", "el::event_done")
        return self.ask("second", "--tick", tick), ("own-time", "event")

    def fault(self):
        tick = self.do("el::throw_wanted", "el::throw_done")
        answer = self.ask("thrower", "--tick", tick)
        self.tool("restart", "thrower", "--node", self.node)
        wait_until("thrower runs again", lambda: self.module("thrower")["state"] == "running")
        return answer, ("fault", "thrower")

    def killed(self):
        known = self.module("process")
        os.kill(known["pid"], signal.SIGKILL)
        wait_until("its process is back", lambda: self.module("process")["restarts"] > known["restarts"]
                   and self.module("process")["runs"] > known["runs"] + 5)
        self.let_pass()
        return self.ask("process"), ("fault", "process")

    def stopped(self):
        self.tool("stop", "second", "--node", self.node)
        self.let_pass()
        answer = self.ask("second")
        self.tool("start", "second", "--node", self.node)
        wait_until("second runs again", lambda: self.module("second")["state"] == "running")
        return answer, ("stopped", self.user)

    def forced(self):
        self.tool("force", "el::held=5", "--node", self.node)
        self.let_pass(20)
        answer = self.ask("el::held")
        self.tool("unforce", "el::held", "--node", self.node)
        return answer, ("force", self.user)

    def was_set(self):
        self.set("el::free", self.get("el::free") + 1)
        self.let_pass(5)
        return self.ask("el::free", number=1), ("set", self.user)

    def stood_still(self):
        pid = self.status()["pid"]
        os.kill(pid, signal.SIGSTOP)
        time.sleep(0.3)  # how long it stands
        os.kill(pid, signal.SIGCONT)
        self.let_pass()
        return self.ask("first"), ("machine", None)

    def board_gone(self):
        """Two boards of this machine; one is killed, recordings of both are asked."""
        here, there = (new_node(self.options.indurop, name) for name in ("here", "there"))
        boards = "".join(f'<board name="{name}">{part}</board>' for name, part in (
            (here, module(f"{self.options.modules}/live_second.so", "second", "10ms", 1)),
            (there, module(f"{self.options.modules}/live_first.so", "first", "10ms", 1))))
        plant = self.work / "plant.xml"
        plant.write_text(f'<plant name="el{os.getpid()}"><domain>{os.getpid() % 200}</domain><external>off</external>'
                         f"<lease>300ms</lease>{boards}</plant>", encoding="utf-8")
        files = {name: self.work / f"{name}.mcap" for name in (here, there)}
        nodes = {}
        for name, file in files.items():
            file.unlink(missing_ok=True)
            nodes[name] = self.start("run", plant, "--board", name, "--one-host", "-q")
        runs = lambda name: json.loads(self.tool("status", "--node", name, "-o", "json", check=False) or "{}")  # noqa: E731
        peers = lambda: {one["board"]: one for one in ((runs(here).get("mirror") or {}).get("boards") or [])}  # noqa: E731
        wait_until("the boards hear each other", lambda: peers().get(there, {}).get("state") == "alive")
        recorders = [self.start("record", "-o", file, "--node", name) for name, file in files.items()]
        wait_until("both are recorded", lambda: all(file.exists() and file.stat().st_size > 10_000 for file in files.values()))
        os.kill(runs(there)["pid"], signal.SIGKILL)
        wait_until("it is missed", lambda: peers().get(there, {}).get("state") == "silent")
        for program in recorders:
            if program.poll() is None:
                program.send_signal(signal.SIGINT)
            program.wait()
        nodes[here].send_signal(signal.SIGINT)
        for program in nodes.values():
            program.wait()
        answer = self.explain(there, "--from", files[here], "--from", files[there])
        return answer, ("board", there)


STATES = ("fault", "killed", "stopped", "forced", "was_set", "stood_still", "board_gone")  # not judged by time
TIMES = ("own_time", "predecessor", "event")


def judge(kind, answer, right):
    cause, culprit = answer["cause"], answer.get("culprit") or ""
    if cause == right[0] and (right[1] is None or culprit == right[1]):
        return "right"
    if cause in ("not-known", "all-is-well"):
        return "not known"
    if kind in TIMES and cause == "machine":
        return "not known"  # it reports what the kernel counted, and names no cause
    return "WRONG"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--indurop", type=lambda text: pathlib.Path(text).resolve(), required=True)
    parser.add_argument("--modules", type=lambda text: pathlib.Path(text).resolve(), required=True)
    parser.add_argument("--work", type=lambda text: pathlib.Path(text).resolve(), required=True)
    parser.add_argument("--kinds", nargs="*", default=[*STATES, *TIMES])
    options = parser.parse_args()
    wanted = int(os.environ.get("INDUROP_EXPLAIN_LIVE", "10"))
    live = Live(options)
    live.begin()
    counts = {"right": 0, "not known": 0, "WRONG": 0}
    for number in range(wanted):
        kind = options.kinds[number % len(options.kinds)]
        answer, right = getattr(live, kind)()
        verdict = judge(kind, answer, right)
        counts[verdict] += 1
        if verdict == "not known" and kind in STATES:
            verdict += " (it has to be)"
            counts["WRONG"] += 1
        print(f"{kind}: {verdict}: {answer['cause']} {answer.get('culprit') or ''}: {answer['text']}", flush=True)
        if verdict != "right":
            print("    " + "\n    ".join(answer.get("evidence", [])))
    live.end()
    print(", ".join(f"{count} {name}" for name, count in counts.items()))
    if counts["WRONG"] or (wanted >= 100 and counts["right"] * 100 < 95 * wanted):
        sys.exit(1)


if __name__ == "__main__":
    main()
