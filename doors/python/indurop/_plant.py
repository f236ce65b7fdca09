# SPDX-License-Identifier: Apache-2.0
"""Plants in virtual time, for tests."""

from __future__ import annotations

import contextlib
import itertools
import json
import os
import re
import select
import subprocess
import time
from dataclasses import dataclass
from typing import Any, Callable, Sequence

from indurop._command import program, run
from indurop._errors import Error, Gone, Invalid, NotFound, Timeout
from indurop._node import Node, Variable

_STANDS = re.compile(rb"^tick (\d+), .*\n", re.MULTILINE)
_SHOWN = 2000  # characters of what the node printed, in errors
_numbers = itertools.count(1)


@dataclass
class Module:
    """Counters of a module since the start."""

    runs: int
    skipped: int
    overruns: int
    deadline_misses: int
    restarts: int
    state: str  # "running", "faulted", ...
    last_fault: str  # "exception: no sensor"; "": none


class Plant:
    """A configuration in virtual time: the same on every run, to the last bit of every variable, as long as the test
    does the same. It is halted before its first tick, with initial values, and after each call that lets time pass.

        with indurop.Plant("module.xml") as plant:
            plant["I0"] = True
            plant.run(0.2)
            assert plant["O3"]

    Of a plant.xml all boards run, with a simulated network; what several boards have is named with its board:
    plant["torque@control"]. The modules run in a process of their own, so a crash of one is a fault to test for.

    `board`: runs that board of a plant.xml only. `record`: file for a recording of the run; of several boards one each.
    `arguments`: further options of `indurop run --sim`. `patience`: seconds of real time that a call may take."""

    def __init__(self, configuration: str | os.PathLike[str], *, board: str = "",
                 record: str | os.PathLike[str] = "", arguments: Sequence[str] = (), patience: float = 30) -> None:
        self.tick = 0  # ticks that were run
        self._patience = patience
        self._printed = b""
        self._read = 0  # what was printed before was evaluated
        self._name = f"test-{os.getpid()}-{next(_numbers)}"
        self._period_ns = 0
        self.nodes: dict[str, Node] = {}  # by board; of a module.xml one with the name ""
        words = [program("indurop-node"), "--sim", "--step", "--node", self._name, *arguments]
        words += ["--board", board, "--one-host"] if board else []
        words += ["--record", os.fspath(record)] if record else []
        self._process = subprocess.Popen([*words, "--", os.fspath(configuration)], stdin=subprocess.PIPE,
                                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True)
        try:
            self._wait()
            self._open_nodes()
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Ends the plant. A recording is complete afterwards."""
        boards = [node.name for node in self.nodes.values()]
        for node in self.nodes.values():
            node.close()
        self.nodes.clear()
        if self._process.stdout is not None and not self._process.stdout.closed:
            try:
                self._printed += self._process.communicate(timeout=self._patience)[0]  # it ends at the end of its input
            except subprocess.TimeoutExpired:
                self._process.kill()
                self._process.communicate()
            for name in boards:
                with contextlib.suppress(Error):  # what a test has to say is more important
                    run(["clean", "--node", name, "-q"])

    def __enter__(self) -> "Plant":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def step(self, ticks: int = 1) -> None:
        """Runs ticks; everything that belongs to the last one is done afterwards."""
        if ticks < 0:
            raise Invalid("time does not run backwards")
        if ticks != 0:
            self._order(str(ticks))

    def run(self, seconds: float) -> None:
        """Lets virtual time pass, in whole basic periods (rounded up)."""
        if seconds < 0:
            raise Invalid("time does not run backwards")
        if seconds != 0:
            self._order(f"{round(seconds * 1e9)}ns")

    def run_until(self, condition: Callable[[], bool], at_most: float) -> bool:
        """Runs tick by tick until the condition holds; False: it does not within this time."""
        end = self.time + at_most
        while not condition():
            if self.time >= end:
                return False
            self.step()
        return True

    @property
    def basic_period(self) -> float:
        """Seconds."""
        if self._period_ns == 0:
            self._period_ns = min(self._status(board)["basic_period_ns"] for board in self.nodes)
        return self._period_ns / 1e9

    @property
    def time(self) -> float:
        """Virtual time since the start, seconds."""
        return self.tick * self.basic_period

    def variable(self, name: str) -> Variable:
        """The variable, whose write(), force(), release() and numpy() are those of any node."""
        text, _, board = name.partition("@")
        if board:
            return self._node(board).variable(text)
        found = [(where, node) for where, node in self.nodes.items() if text in node]
        if len(found) > 1:
            raise NotFound(f"several boards have {text}: say which is meant, as in {text}@{found[0][0]}")
        return (found[0][1] if found else next(iter(self.nodes.values()))).variable(text)

    def __getitem__(self, name: str) -> Any:
        return self.variable(name).value

    def __setitem__(self, name: str, value: Any) -> None:
        self.variable(name).write(value)

    def module(self, name: str) -> Module:
        """Counters of a module, "table" or "table@sensor"."""
        text, _, board = name.partition("@")
        boards = [board] if board else list(self.nodes)
        found = [one for where in boards for one in self._status(where)["modules"] if one["name"] == text]
        if len(found) != 1:
            raise NotFound(f"several boards have a module {text}: {text}@{boards[0]}" if found
                           else f"there is no module {name}")
        one = found[0]
        return Module(one["runs"], one["skipped"], one["overruns"], one["deadline_misses"], one["restarts"],
                      one["state"], one["last_fault"])

    @property
    def printed(self) -> str:
        """Everything that the nodes and their modules have printed."""
        return self._printed.decode("utf-8", "replace")

    def _node(self, board: str) -> Node:
        if board not in self.nodes:
            raise NotFound(f"there is no board {board}; there is {', '.join(self.nodes)}")
        return self.nodes[board]

    def _status(self, board: str) -> Any:
        return json.loads(run(["status", "--node", self._node(board).name, "-o", "json"]))

    def _open_nodes(self) -> None:
        try:
            self.nodes[""] = Node(self._name, write=True)
            return
        except NotFound:
            pass  # a plant, whose boards have names of their own
        prefix = self._name + "-"
        listed = json.loads(run(["nodes", "-o", "json"]))["nodes"]
        for name in sorted(one["node"] for one in listed if one["node"].startswith(prefix)):
            self.nodes[name[len(prefix):]] = Node(name, write=True)

    def _order(self, text: str) -> None:
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(text.encode() + b"\n")
            self._process.stdin.flush()
        except (OSError, ValueError):
            pass  # it has ended: said when it is waited for
        self._wait()

    def _wait(self) -> None:
        """Waits until it stands after a tick."""
        assert self._process.stdout is not None
        end = time.monotonic() + self._patience
        while not (found := _STANDS.search(self._printed, self._read)):
            left = end - time.monotonic()
            if left <= 0:
                raise self._failure(Timeout, f"no tick after {self.tick} within {self._patience} s")
            if not select.select([self._process.stdout], [], [], left)[0]:
                continue
            more = os.read(self._process.stdout.fileno(), 1 << 16)
            if not more:
                raise self._failure(Gone, "the configuration cannot be run" if self.tick == 0
                                    else f"the node ended after tick {self.tick}")
            self._printed += more
        self.tick = int(found[1])
        self._read = found.end()

    def _failure(self, kind: type[Error], what: str) -> Error:
        said = self.printed[-_SHOWN:].strip()
        return kind(f"{what}; the node said:\n{said}" if said else what)
