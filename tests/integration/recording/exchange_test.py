#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A module is exchanged at random moments of a recording, by versions that keep the same or other variables, fault, are rejected
or return. The replay of the whole recording and of its end has to equal it. An independent reader of the file checks in addition
that each run has the values of the version that the recording names for it, and that what the replay writes is what was recorded.
INDUROP_EXCHANGE_ROUNDS says how many recordings, 3 without it; INDUROP_EXCHANGE_SEED repeats one."""

import argparse
import hashlib
import json
import os
import pathlib
import random
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from mcap_file import McapFile  # noqa: E402
from nodes import end_at_exit, new_node  # noqa: E402

# What nt::walked is of nt::output.
FACTORS = {"same": 1, "other": -1, "fresh": -1, "less": -1, "grown": -1, "by": -1, "by_other": -2, "gains": -1, "gains_kept": -1,
           "throws": -1, "large": -1}
REJECTED = ["bad_start", "threads", "more_access"]


class Cell:
    """A node with one module, press.so, whose file each version replaces, as a linker does."""

    def __init__(self, options, folder):
        self.bin, self.modules, self.folder = options.bin, options.modules, folder
        self.environment = dict(os.environ, INDUROP_STATE_DIR=str(folder / "state"))
        self.name = new_node(options.bin / "indurop", "exchange-")
        self.configuration = folder / "module.xml"
        module = ("<module><filename>{0}</filename><name>{1}</name><moduletype>thread</moduletype><operationtype>periodic"
                  "</operationtype><period>{2}</period><priority>{3}</priority></module>")
        self.configuration.write_text("<root>" + module.format(f"{self.modules}/counter.so", "other", "1ms", 1) +
                                      module.format("press.so", "press", "2ms", 2) + "</root>")
        self.install("same")

    def install(self, version):
        shutil.copy(self.modules / f"reload_{version}.so", self.folder / "press.new")
        os.replace(self.folder / "press.new", self.folder / "press.so")

    def digest(self, version):
        return self.digest_of(self.modules / f"reload_{version}.so")

    @staticmethod
    def digest_of(file):
        return hashlib.sha256(file.read_bytes()).hexdigest()

    def open(self, *words):
        return subprocess.Popen([self.bin / "indurop", *map(str, words)], env=self.environment, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, text=True, cwd=self.folder)

    def indurop(self, *words):
        return subprocess.run([self.bin / "indurop", *map(str, words)], env=self.environment, timeout=120, capture_output=True,
                              text=True, cwd=self.folder)

    def start(self, *words):
        live = end_at_exit(subprocess.Popen([self.bin / "indurop-node", "-q", "--node", self.name, *map(str, words),
                                             self.configuration], env=self.environment, stdout=subprocess.DEVNULL,
                                            stderr=subprocess.PIPE, text=True))
        self.live = live
        while not self.counted() > 0:
            assert live.poll() is None, live.stderr.read()
        return live

    def counted(self):
        """What the module of the node that runs has counted; 0: it has not run yet."""
        done = self.indurop("get", "nt::output", "-o", "json", "--node", self.name)
        return int(json.loads(done.stdout)["values"][0]["value"]) if done.returncode == 0 else 0

    def reload(self, version, *words):
        self.install(version)
        return self.indurop("reload", "press", "--node", self.name, "--lossy", *words)

    def exchange(self, version):
        done = self.reload(version, "--health", "0s")
        if returned_late(done.returncode, done.stderr):
            raise Late
        assert done.returncode == 0, (version, done.stdout, done.stderr)

    def replay(self, file, *words):
        return self.indurop("replay", file, "--node", f"{self.name}-r", *words)


class Late(Exception):
    """The machine stood still for a period, so the previous version runs again."""


def returned_late(code, errors):
    """The health window saw an overrun and the previous version runs again. A machine that stands still for a period causes it."""
    return code == 5 and "the new one overran its period" in errors


def numbers_of(file, topic, form):
    """(log time, value) of all messages of a topic, by time."""
    found = [(log, struct.unpack_from(form, data, 4)[0]) for chunk in file.chunks
             for log, _, data in file.messages_of(chunk, topic)]
    return sorted(found, key=lambda one: one[0])


def at(values, log):
    return [value for time, value in values if time <= log][-1]


def versions_of(cell, file):
    """(first run, name of the version) as the recording says."""
    by_digest = {cell.digest(name): name for name in [*FACTORS, *REJECTED]}
    named = [words for name, words in file.records if name == "indurop.version" and words["module"] == "press"]
    return sorted((int(words["first_run"]), by_digest[words["sha256"]]) for words in named)


def judge(cell, recording, written):
    """Each run of the module wrote what its version writes, and the replay wrote the same."""
    file, versions = McapFile(recording), None
    versions = versions_of(cell, file)
    output, walked = numbers_of(file, "nt::output", "<i"), numbers_of(file, "nt::walked", "<q")
    output, walked = dict(output), dict(walked)  # the last ones of each time
    count = product = None
    judged = 0
    times = sorted(set(output) | set(walked))
    runs = [run for run in file.runs() if run[1] == "press"]
    where = 0
    for log, _, number, _ in runs:
        while where < len(times) and times[where] <= log:
            count, product = output.get(times[where], count), walked.get(times[where], product)
            where += 1
        version = [name for first, name in versions if first <= number][-1]
        if count is not None and product is not None and count >= 0 and count != 9999:  # else: the start, or a fault
            assert product == count * FACTORS[version], (number, version, count, product, versions)
            judged += 1
    assert judged > len(runs) - 20, (judged, len(runs))
    now = McapFile(written)
    for topic, form in (("nt::output", "<i"), ("nt::walked", "<q")):
        then = dict(numbers_of(file, topic, form))
        last, recorded = None, []
        for log in sorted(then):
            last = then[log]
            recorded.append((log, last))
        compared = numbers_of(now, topic, form)
        by_time = iter(recorded)
        following = next(by_time, None)
        value = None
        for log, found in compared:
            while following is not None and following[0] <= log:
                value = following[1]
                following = next(by_time, None)
            assert found == value, (topic, log, found, value)
        assert compared, topic
    return versions


def exchange_at_random(cell, choice):
    for _ in range(choice.randrange(1, 5)):
        time.sleep(choice.uniform(0.02, 0.6))
        what = choice.choice([*FACTORS, *FACTORS, "back", "back", *REJECTED])
        if what == "back":
            cell.indurop("reload", "press", "--back", "--node", cell.name)
        else:
            done = cell.reload(what, "--health", choice.choice(["0s", "0.2s"]))
            assert done.returncode in ((1, 4) if what in REJECTED else (0, 5)), (what, done.stdout, done.stderr)


def recordings_are_repeated_with_all_versions(cell, seed):
    choice = random.Random(seed)
    recording, written = cell.folder / f"{seed}.mcap", cell.folder / f"{seed}.now.mcap"
    cell.install("same")
    live = cell.start("--record", recording)
    exchange_at_random(cell, choice)
    time.sleep(1.2)  # there are two keyframes a second
    live.send_signal(signal.SIGTERM)
    assert live.wait() in (0, 1), live.stderr.read()  # 1: a module has faulted
    if len(versions_of(cell, McapFile(recording))) == 1:
        cell.install("same")  # a module that was not exchanged is repeated with the file of the configuration
    done = cell.replay(recording, "-o", written)
    assert done.returncode == 0 and re.search(" values: equal$", done.stdout, re.M), (seed, done.stdout, done.stderr)
    assert "not repeated" not in done.stdout + done.stderr, (seed, done.stdout, done.stderr)
    versions = judge(cell, recording, written)
    ticks = sorted(tick for _, module, number, tick in McapFile(recording).runs() if module == "press")
    if versions[-1][1] != "gains":  # it writes the number of its runs, which it does not declare to keep
        late = max(0, ticks[-1] - choice.randrange(1, 300))
        done = cell.replay(recording, "--from", late)
        assert done.returncode == 0 and " values: equal" in done.stdout, (seed, done.stdout, done.stderr)
    print(f"  seed {seed}: {len(ticks)} runs of {[name for _, name in versions]}")
    return recording


def a_version_that_is_missing_is_named(cell):
    """Its file is gone or has other content: said with the module, the path, the SHA-256 and what to do."""
    recording = cell.folder / "missing.mcap"
    recording.unlink(missing_ok=True)
    cell.install("same")
    live = cell.start("--record", recording)
    cell.exchange("other")
    time.sleep(1.2)
    live.terminate()
    live.wait()
    tick = next(int(words["first_tick"]) for name, words in McapFile(recording).records
                if name == "indurop.version" and words["exchanged"] == "yes")
    shutil.rmtree(cell.folder / "state")
    done = cell.replay(recording)
    assert done.returncode == 1 and not done.stdout, done.stdout
    for words in ("module press: the file of its version from tick ", str(cell.folder / "press.so"), cell.digest("same"),
                  f"(the file that is there now has {cell.digest('other')})", "--with press=FILE"):
        assert words in done.stderr, done.stderr
    assert cell.replay(recording, "--from", tick + 300).returncode in (0, 1)
    (cell.folder / "press.so").unlink()
    done = cell.replay(recording)
    assert done.returncode != 0 and "press.so" in done.stderr, done.stderr
    cell.install("other")
    shutil.copy(cell.modules / "reload_same.so", cell.folder / "old.so")  # next to the recording
    done = cell.replay(recording)
    assert done.returncode == 0 and "values: equal" in done.stdout, (done.stdout, done.stderr)
    # One file for all runs, up to the exchange.
    done = cell.replay(recording, "--with", f"press={cell.modules / 'reload_same.so'}")
    assert done.returncode == 0 and "was exchanged while it ran: from tick" in done.stderr, (done.stdout, done.stderr)
    done = cell.replay(recording, "--with", f"press={cell.modules / 'reload_by_other.so'}", "--to", tick - 1)
    assert done.returncode == 4, (done.stdout, done.stderr)
    (cell.folder / "old.so").unlink()


def a_node_that_is_killed_after_an_exchange(cell):
    """Its recording and the black box of the crash are repeated with both versions."""
    recording = cell.folder / "killed.mcap"
    recording.unlink(missing_ok=True)
    cell.install("same")
    live = cell.start()
    recorder = subprocess.Popen([cell.bin / "indurop", "record", "--past", "-o", recording, "--node", cell.name],
                                env=cell.environment, stderr=subprocess.DEVNULL)
    while not recording.exists():
        assert recorder.poll() is None
    cell.exchange("other")
    live.kill()
    live.wait()
    assert recorder.wait() == 1
    versions = [words["sha256"] for name, words in McapFile(recording).records
                if name == "indurop.version" and words["module"] == "press"]
    assert versions == [cell.digest("same"), cell.digest("other")], versions
    done = cell.replay(recording)
    assert done.returncode == 0 and "values: equal" in done.stdout, (done.stdout, done.stderr)
    live = cell.start()
    live.terminate()
    live.wait()
    box = sorted((cell.folder / "state" / cell.name / "boxes").glob("*.mcap"))[-1]
    done = cell.replay(box)
    assert done.returncode == 0 and "values: equal" in done.stdout, (done.stdout, done.stderr)
    assert "version of" in done.stderr, done.stderr


def unless_late(case, cell):
    """Runs the case, and again with another node after an exchange that came too late."""
    while True:
        try:
            return case(cell)
        except Late:
            cell.live.kill()
            cell.live.wait()


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", type=pathlib.Path, required=True)
    parser.add_argument("--modules", type=pathlib.Path, required=True)
    options = parser.parse_args()
    options.bin, options.modules = options.bin.resolve(), options.modules.resolve()
    first = int(os.environ.get("INDUROP_EXCHANGE_SEED", random.randrange(1 << 31)))
    with tempfile.TemporaryDirectory() as folder:
        cell = Cell(options, pathlib.Path(folder).resolve())
        for seed in range(first, first + int(os.environ.get("INDUROP_EXCHANGE_ROUNDS", "3"))):
            recordings_are_repeated_with_all_versions(cell, seed)
        unless_late(a_version_that_is_missing_is_named, cell)
        unless_late(a_node_that_is_killed_after_an_exchange, cell)
    print("recordings are repeated with the versions that they name")


if __name__ == "__main__":
    main()
