#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Losses of power: the boards of a plant count in retained variables, are deployed to as fast as they take it, plants and
releases of the platform, and record. Their data is on an ext4 file system on a disk that logs what it is given. Each of many
instants of that log is a loss of power: the disk has what was flushed, and of the rest any sectors. From each the boards have to
come back without help: all with the deployment that was committed, or all with the one that was under way, with retained values
that are whole and not older than promised, and with recordings that can be read. The disk of the last cut of a life is that of
the next one. As root, for namespaces and loop devices. INDUROP_CUTS is the number of cuts, INDUROP_SEED where the dice begin."""

import argparse
import collections
import concurrent.futures
import itertools
import json
import os
import pathlib
import random
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time

from logged_disk import LoggedDisk, Past

HERE = pathlib.Path(__file__).resolve().parent
SKIPPED = 77
CUTS_OF_A_LIFE = 40
BACK_WITHIN = 120  # seconds; the host may be busy
DISK = 384 << 20
BLOCK = 64 << 10
OLDEST = 3  # seconds: retained values are saved each second
# ext4 writes its superblock in two sectors when it is mounted. Of a disk that keeps one of them, only e2fsck can make a file system
# again, as at a boot with fsck.repair=yes.
SUPERBLOCK = {2, 3}
UNSEEN = 100  # runs of which nothing was heard yet
BOARD = """<board name="{name}"><module><name>main</name><filename>{modules}/target_{name}.so</filename>
<moduletype>thread</moduletype><operationtype>periodic</operationtype><period>20ms</period><budget>60s</budget><priority>1</priority>
<property><value name="data">data.bin</value></property></module></board>
"""
WITH_US = ("setpriv", "--pdeathsig", "KILL")  # a program ends with the thread that started it
RESTORED = re.compile(r"restored ([\d ]+)$")
STEP = re.compile(r"(deployment|release) (?:\S+ \()?([0-9a-f]{12})\)?(?: of \S+)?: (\w+)")


class Machine:
    """The programs of one life (plant_life.py), in namespaces that end with them. `lines`: when they were heard, and what they say."""

    def __init__(self, options, disk, work, *words):
        work.mkdir()
        boards = "".join(BOARD.format(name=f"b{number + 1}", modules=options.modules) for number in range(options.boards))
        (work / "plant.xml").write_text(f'<plant name="cuts">{boards}</plant>')
        environment = {**os.environ, "PATH": f"{options.release}/bin:{os.environ['PATH']}", "HOME": str(work)}
        # pylint: disable-next=consider-using-with
        self.process = subprocess.Popen(
            [*WITH_US, "unshare", "--mount", "--net", "--ipc", "--pid", "--mount-proc", "--fork", "--kill-child", "python3",
             HERE / "plant_life.py", disk, work, "--boards", str(options.boards), *words],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment)
        self.lines = []
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()

    def _read(self):
        for line in self.process.stdout:
            words = json.loads(line) if line.startswith("[") else ["wrong", line.strip()]
            self.lines.append((time.monotonic(), words))

    def has_said(self, *kinds):
        return any(words[0] in kinds for _, words in self.lines)

    def end(self):
        self.process.kill()
        self.process.wait()
        self.reader.join()


class Knowledge:
    """What is known of the plant at an instant."""

    def __init__(self):
        self.committed = {"deployment": None, "release": "installed"}
        self.under_way = {"deployment": None, "release": None}
        self.saved = collections.Counter()  # board -> runs that must be there after a cut
        self.newest = collections.Counter()  # board -> runs that were seen
        self.recordings = set()  # that must be readable after a cut

    def after(self, lines, instant):
        """What is known when these lines were heard up to `instant`."""
        known = Knowledge()
        known.committed, known.under_way = dict(self.committed), dict(self.under_way)
        known.saved, known.newest = self.saved.copy(), self.newest.copy()
        for heard, words in lines:
            if heard <= instant:
                known._hear(words, heard <= instant - OLDEST)
        return known

    def _hear(self, words, is_old):
        if words[0] == "records":
            self.recordings.add(words[1])
        elif words[0] in ("boards", "releases"):
            kind = "deployment" if words[0] == "boards" else "release"
            self.committed[kind], self.under_way[kind] = next(iter(words[1].values())), None
        elif words[0] == "agent":
            step = STEP.search(words[2])
            run = re.search(r"run (\d+)$", words[2])
            if step:
                self._step(*step.groups())
            if run:
                self.newest[words[1]] = int(run.group(1))
                if is_old:
                    self.saved[words[1]] = max(self.saved[words[1]], int(run.group(1)))

    def _step(self, kind, number, step):
        if step == "fetching":
            self.under_way[kind] = number
        elif step == "committed":
            self.committed[kind], self.under_way[kind] = number, None
        elif step in ("rolling", "abandoned") and number == self.under_way[kind]:
            self.under_way[kind] = None


class Judge:
    """Compares what is there after a cut with what was known before it."""

    def __init__(self):
        self.count = collections.Counter()
        self.findings = []

    def compare(self, cut, known, lines, is_back):
        found = [words for _, words in lines]
        wrong = [words[1] for words in found if words[0] == "wrong"]
        if not is_back:
            said = [words[1:] for words in found if words[0] != "recording" and "run " not in str(words[-1])]
            wrong.append("the plant did not come back:" + "".join(f"\n      {words}" for words in said))
        readable = {words[1] for words in found if words[0] == "recording" and words[2]}
        self.count["recordings read"] += len(readable)
        for name in known.recordings - readable:
            said = [words[3] for words in found if words[0] == "recording" and words[1] == name]
            wrong.append(f"recording {name} cannot be read: {said or 'it is not there'}")
        first = set()  # boards that have started their node once; a trial that goes back starts it again
        for words in found:
            restored = RESTORED.search(words[2]) if words[0] == "agent" else None
            if restored and words[1] not in first:
                first.add(words[1])
                wrong += self._restored(known, words[1], [int(number) for number in restored.group(1).split()])
            elif words[0] == "boards":
                wrong += self._resumed(known, "deployment", words[1])
            elif words[0] == "releases":
                wrong += self._resumed(known, "release", words[1])
            elif words[0] == "repaired":
                self.count["superblocks repaired"] += 1
            elif words[0] == "empty" and known.committed["deployment"]:
                wrong.append(f"nothing is deployed, {known.committed['deployment']} was committed")
        self.findings += [f"{cut}: {text}" for text in wrong]
        return wrong

    def _restored(self, known, board, numbers):
        runs, last = numbers[0], numbers[-1]
        wrong = []
        if len(set(numbers[:-1])) != 1 or last != runs:
            wrong.append(f"retained values of {board} are torn: {numbers}")
        if runs < known.saved[board]:
            wrong.append(f"retained values of {board} went back to {runs}, {known.saved[board]} was saved")
        if runs > known.newest[board] + UNSEEN:
            wrong.append(f"retained values of {board} are {runs}, the newest seen was {known.newest[board]}")
        self.count["retained values restored"] += 1
        return wrong

    def _resumed(self, known, kind, of_boards):
        number = next(iter(of_boards.values()))
        may = [known.committed[kind], known.under_way[kind]]
        self.count[f"{kind}: {'committed' if number == may[0] else 'under way'}"] += 1
        return [] if number in may else [f"{kind} {number} runs, {may[0]} was committed, {may[1]} was under way"]


def repair_if(torn):
    return ["--repair"] if torn else []


def write_sparse(file, content):
    with file.open("wb") as out:
        out.truncate(len(content))
        for offset in range(0, len(content), BLOCK):
            block = content[offset:offset + BLOCK]
            if block.count(0) < len(block):
                out.seek(offset)
                out.write(block)


class Story:
    """Lives of one plant, each from the disk that a cut has left of the one before."""

    def __init__(self, options, folder):
        self.options = options
        self.folder = folder
        self.dice = random.Random(options.seed)
        self.judge = Judge()
        self.known = Knowledge()
        self.image = self._empty_disk()
        self.torn = False  # the superblock of this image
        self.cuts = 0

    def _empty_disk(self):
        file = self.folder / "empty"
        with file.open("wb") as disk:
            disk.truncate(DISK)
        subprocess.run(["mke2fs", "-q", "-F", "-t", "ext4", file], check=True)
        image = file.read_bytes()
        file.unlink()
        return image

    def live(self, number):
        """Returns the log of the disk, and what was heard, until the power is lost."""
        folder = self.folder / f"life{number}"
        (folder / "fuse").mkdir(parents=True)
        disk = LoggedDisk(str(folder / "socket"), self.image)
        with subprocess.Popen([*WITH_US, "nbdfuse", folder / "fuse", f"nbd+unix:///?socket={folder}/socket"],
                              stderr=subprocess.DEVNULL) as fuse:
            while not (folder / "fuse/nbd").exists():
                if fuse.poll() is not None:
                    raise RuntimeError("nbdfuse has ended")
                time.sleep(0.05)
            machine = Machine(self.options, folder / "fuse/nbd", folder / "work", "--live", "--release", str(self.options.release),
                              "--first", str(number * 1000), *repair_if(self.torn))
            end = time.monotonic() + BACK_WITHIN
            while not machine.has_said("releases", "empty") and machine.process.poll() is None and time.monotonic() < end:
                time.sleep(0.1)
            if not machine.has_said("releases", "empty"):
                self.judge.findings.append(f"life {number}: the plant did not come back")
            time.sleep(self.options.seconds)
            log = list(disk.log)
            machine.end()
            while subprocess.run(["losetup", "-j", folder / "fuse/nbd"], capture_output=True, check=False).stdout:
                time.sleep(0.1)
            fuse.terminate()  # which unmounts it
        disk.close()
        shutil.rmtree(folder)
        for words in (words for _, words in machine.lines if words[0] == "wrong"):
            self.judge.findings.append(f"life {number}: {words[1]}")
        refused = collections.Counter(words[1] for _, words in machine.lines if words[0] == "desk")
        for text, times in refused.items():
            print(f"    {times} times, the desk said: {text}")
        return log, machine.lines

    def cut(self, log, lines, cuts):
        """Loses the power at so many instants of a life, and checks what is left."""
        past = Past(self.image, log)
        with concurrent.futures.ThreadPoolExecutor(self.options.jobs) as pool:
            waiting = []
            for place in sorted(self.dice.randrange(len(log)) for _ in range(cuts)):
                past.go_to(place)
                left, cached, kept = past.cut(self.dice)
                torn = len(SUPERBLOCK.intersection(kept)) == 1
                known = self.known.after(lines, log[place][0])
                self.cuts += 1
                self.judge.count["sectors lost"] += cached - len(kept)
                name = f"cut {self.cuts}, {len(kept)} of {cached} sectors kept"
                write_sparse(self.folder / f"{self.cuts}.disk", left)
                waiting.append(pool.submit(self._check, self.cuts, name, known, torn))
            for one in waiting:
                one.result()
        self.image, self.known, self.torn = left, known, torn

    def _check(self, number, name, known, torn):
        file = self.folder / f"{number}.disk"
        if self.options.keep:
            subprocess.run(["cp", "--sparse=always", file, self.options.keep], check=True)
        work = self.folder / f"work{number}"
        machine = Machine(self.options, file, work, *repair_if(torn))
        try:
            is_back = machine.process.wait(BACK_WITHIN) == 0
        except subprocess.TimeoutExpired:
            is_back = False
        machine.end()
        wrong = self.judge.compare(name, known, machine.lines, is_back)
        judged = subprocess.run(["e2fsck", "-fn", file], capture_output=True, text=True, check=False)
        if judged.returncode != 0:
            self.judge.findings.append(f"{name}: e2fsck: {judged.stdout[-300:]} {judged.stderr[-300:]}")
        for text in wrong:
            print(f"    WRONG {name}: {text}", flush=True)
        if self.options.keep and not wrong:
            (self.options.keep / file.name).unlink()
        file.unlink()
        shutil.rmtree(work)


def lacking():
    """What a machine lacks for this test; empty: nothing."""
    tools = [tool for tool in ("nbdfuse", "mke2fs", "losetup", "unshare", "setpriv") if not shutil.which(tool)]
    if tools:
        return f"{', '.join(tools)} not found; make target-proof installs what is missing"
    if os.geteuid() != 0:
        return "needs root"
    with tempfile.TemporaryDirectory() as folder:
        disk = pathlib.Path(folder, "disk")
        disk.write_bytes(bytes(1 << 20))
        subprocess.run(["mke2fs", "-q", "-F", disk], check=True)
        mount = ["unshare", "--mount", "--net", "--ipc", "--pid", "--fork", "mount", "-o", "loop", disk, folder]
        tried = subprocess.run(mount, stderr=subprocess.DEVNULL, check=False).returncode == 0
    return "" if tried and os.access("/dev/fuse", os.R_OK | os.W_OK) else "needs loop devices, FUSE and namespaces"


def prove(options, folder):
    story = Story(options, folder)
    began = time.monotonic()
    for number in itertools.count():
        log, lines = story.live(number)
        story.cut(log, lines, min(CUTS_OF_A_LIFE, options.cuts - story.cuts))
        commits = {STEP.search(words[2]).groups()[1] for _, words in lines if words[0] == "agent" and ": committed" in words[2]}
        story.judge.count["commits"] += len(commits)
        if not commits:
            story.judge.findings.append(f"life {number}: nothing was committed")
        print(f"life {number}: {len(log)} writes and flushes, {len(commits)} commits; {story.cuts} cuts, "
              f"{(time.monotonic() - began) / story.cuts:.1f} s each", flush=True)
        if story.cuts >= options.cuts:
            break
    print(f"{story.cuts} cuts of {options.boards} boards from seed {options.seed}: {dict(story.judge.count)}")
    print("\n".join(story.judge.findings) or "nothing wrong")
    return not story.judge.findings


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--release", type=pathlib.Path, required=True, help="folder of the programs, which are also deployed")
    parser.add_argument("--modules", type=pathlib.Path, required=True)
    parser.add_argument("--boards", type=int, default=2)
    parser.add_argument("--cuts", type=int, default=int(os.environ.get("INDUROP_CUTS", "20")))
    parser.add_argument("--seconds", type=float, default=40, help="of a life, after its boards are back")
    parser.add_argument("--seed", type=int, default=int(os.environ.get("INDUROP_SEED", "1")))
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--keep", type=pathlib.Path, help="a folder for disks after which something was wrong")
    options = parser.parse_args()
    why = lacking()
    if why:
        print(f"skipped: {why}")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory(prefix="indurop-cuts-") as folder:
        sys.exit(0 if prove(options, pathlib.Path(folder)) else 1)


if __name__ == "__main__":
    main()
