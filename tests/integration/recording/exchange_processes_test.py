#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A process module is exchanged at random moments of a recording, by processes that keep the same variables and walk with other
steps. They return by command, by kill -9 of the new one, and are restarted with another file. An independent reader of the recording
checks that each run walks as the version does that the recording names for it, from where the run before it was; the replay of the
whole recording and of its end has to equal it. INDUROP_EXCHANGE_ROUNDS and INDUROP_EXCHANGE_SEED: as in exchange_test.py."""

import argparse
import contextlib
import os
import pathlib
import random
import re
import signal
import struct
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from exchange_test import Cell, McapFile, numbers_of, returned_late  # noqa: E402

# In each run, and the number of runs modulo 5 in addition. The last one brings nt::gained, twice as much.
STEPS = {"rambler_process": 3, "rambler_process_other": 8, "rambler_gains_process": 3}


class ProcessCell(Cell):
    """A node with one process module, press.exe."""

    def __init__(self, options, folder):
        self.copies, self.steps, self.gains = 0, {}, set()  # by digest of the file
        super().__init__(options, folder)
        text = self.configuration.read_text().replace("press.so", "press.exe").replace(
            "<name>press</name><moduletype>thread</moduletype>", "<name>press</name><moduletype>process</moduletype>")
        self.configuration.write_text(text.replace("<period>2ms</period>", '<period>2ms</period><restart max="50" delay="10ms"/>'))

    def install(self, version):
        """Each copy is a version of its own: an ELF file may be followed by anything."""
        version = version if version in STEPS else "rambler_process"
        self.copies += 1
        program = self.folder / "press.new"
        program.write_bytes((self.modules / f"{version}.exe").read_bytes() + str(self.copies).encode())
        program.chmod(0o755)
        os.replace(program, self.folder / "press.exe")
        digest = self.digest_of(self.folder / "press.exe")
        self.steps[digest] = STEPS[version]
        if version == "rambler_gains_process":
            self.gains.add(digest)

    def counted(self):
        done = self.indurop("get", "nt::walked", "-o", "json", "--node", self.name)
        found = re.search(r'"value":\s*"?(-?\d+)', done.stdout)
        return int(found.group(1)) if found else 0

    def pid(self):
        done = self.indurop("status", "-o", "json", "--node", self.name)
        found = re.search(r'"name":\s*"press".*?"pid":\s*(\d+)', done.stdout, re.S)
        return int(found.group(1)) if found else 0


def runs_of(file):
    """(log time, number, tick, faulted, restarted, exchanged) of all runs of the module."""
    channel = next(number for number, name in file.topics.items() if name == "indurop/runs")
    found = []
    for chunk in file.chunks:
        for log, _, data in file.messages_of(chunk, "indurop/runs"):
            number, _, tick = struct.unpack_from("<QQQ", data, 4)
            module, *flags = struct.unpack_from("<I???", data, 4 + 48)
            if file.metadata[channel].get(str(module)) == "press":
                found.append((log, number, tick, *flags))
    return sorted(found)


def judge(cell, recording):
    """Returns how many runs continued what the run before them kept, at an exchange and otherwise."""
    file = McapFile(recording)
    versions = sorted((int(words["first_run"]), words["sha256"]) for name, words in file.records
                      if name == "indurop.version" and words["module"] == "press")
    named = [(first, cell.steps[digest]) for first, digest in versions]
    gained = dict(numbers_of(file, "nt::gained", "<q"))
    both = [(log, value) for log, value in numbers_of(file, "nt::walked", "<q") if log in gained]
    assert all(gained[log] == 2 * value for log, value in both), "what it brings is recorded with the run that wrote it"
    assert len(both) > 0 or not cell.gains.intersection(digest for _, digest in versions), "what it brings is not recorded"
    walked = numbers_of(file, "nt::walked", "<q")
    at, now, last, last_rest, carried, continued = 0, None, None, None, 0, 0
    for log, number, _, faulted, restarted, exchanged in runs_of(file):
        while at < len(walked) and walked[at][0] <= log:
            now, at = walked[at][1], at + 1
        step = [step for first, step in named if first <= number][-1]
        if faulted or now is None or last is None or now == last:
            last, last_rest = now, None
            continue
        rest = now - last - step
        if not restarted:
            assert 0 <= rest < 5, (number, now, last, step)
            assert last_rest is None or rest == (last_rest + 1) % 5, (number, rest, last_rest)
            carried, continued = carried + exchanged, continued + 1
        last, last_rest = now, rest if not restarted else None
    return carried, continued


def exchange_at_random(cell, choice):
    for _ in range(choice.randrange(2, 6)):
        time.sleep(choice.uniform(0.02, 0.5))
        what = choice.choice([*STEPS, *STEPS, "back", "killed", "restarted"])
        if what in STEPS:
            done = cell.reload(what, "--health", choice.choice(["0s", "0.3s"]))
            assert done.returncode == 0 or returned_late(done.returncode, done.stderr), (what, done.stdout, done.stderr)
            continue
        before = cell.pid()
        if what == "restarted":
            (cell.folder / f"{cell.copies}.exe").write_bytes((cell.folder / "press.exe").read_bytes())  # next to the recording
            (cell.folder / f"{cell.copies}.exe").chmod(0o755)
            cell.install(choice.choice(list(STEPS)[:2]))  # a start brings no variables
            os.kill(before, signal.SIGKILL)
            while cell.pid() in (0, before):
                time.sleep(0.01)
        else:
            cell.install(choice.choice(list(STEPS)))
            client = cell.open("reload", "press", "--node", cell.name, "--health", "30s")
            while (new := cell.pid()) in (0, before) and client.poll() is None:
                pass
            time.sleep(choice.uniform(0, 0.2))
            done = None
            if what == "back":
                done = cell.indurop("reload", "press", "--back", "--node", cell.name)
            elif new not in (0, before):
                with contextlib.suppress(ProcessLookupError):  # it has returned, and ended
                    os.kill(new, signal.SIGKILL)
            code, errors = client.wait(), client.stderr.read()
            assert code == 5, (what, code, errors)
            assert done is None or done.returncode == 0 or returned_late(code, errors), (done.stdout, done.stderr, errors)
            assert cell.pid() == before, what


def recordings_are_repeated_with_all_processes(cell, seed):
    choice = random.Random(seed)
    recording = cell.folder / f"{seed}.mcap"
    cell.install("rambler_process")
    live = cell.start("--record", recording)
    exchange_at_random(cell, choice)
    time.sleep(1.2)  # there are two keyframes a second
    live.send_signal(signal.SIGTERM)
    assert live.wait() in (0, 1), live.stderr.read()
    carried, continued = judge(cell, recording)
    done = cell.replay(recording)
    assert done.returncode == 0 and re.search(" values: equal$", done.stdout, re.M), (seed, done.stdout, done.stderr)
    assert "not repeated" not in done.stdout + done.stderr, (seed, done.stdout, done.stderr)
    runs = runs_of(McapFile(recording))
    assert continued > len(runs) // 2, (continued, len(runs))
    late = max(0, runs[-1][2] - choice.randrange(1, 300))
    done = cell.replay(recording, "--from", late)
    assert done.returncode == 0 and " values: equal" in done.stdout, (seed, done.stdout, done.stderr)
    print(f"  seed {seed}: {len(runs)} runs, {carried} exchanges with what is kept")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", type=pathlib.Path, required=True)
    parser.add_argument("--modules", type=pathlib.Path, required=True)
    options = parser.parse_args()
    options.bin, options.modules = options.bin.resolve(), options.modules.resolve()
    first = int(os.environ.get("INDUROP_EXCHANGE_SEED", random.randrange(1 << 31)))
    with tempfile.TemporaryDirectory() as folder:
        cell = ProcessCell(options, pathlib.Path(folder).resolve())
        for seed in range(first, first + int(os.environ.get("INDUROP_EXCHANGE_ROUNDS", "3"))):
            recordings_are_repeated_with_all_processes(cell, seed)
    print("recordings are repeated with the processes that they name")


if __name__ == "__main__":
    main()
