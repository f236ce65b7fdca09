#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Unit tests that were cross-compiled for ARM64, and the chapter's example. qemu-user runs what it can. What shares memory
runs in a machine (machine.py), since qemu-user knows no robust mutexes with priority inheritance. Runs in the Debian of
cmake/arm64_root.sh (make arm64-test) and prints what failed.
arm64_test.py BUILD [PATTERN...]: only programs whose names match. $JOBS programs run in parallel."""

import concurrent.futures
import contextlib
import fnmatch
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import xml.etree.ElementTree as xml

import machine

# What qemu-user does not know: robust mutexes, on their own or by our library.
UNKNOWN = (b"pthread_mutexattr_setrobust", b"libindurop.so")
# Rooms that need a whole kernel: how child processes end, network interfaces, real time.
KERNEL = ("base_*", "dds_*", "rt_*", "scheduler_engine_*", "*_posix")
CHAPTER_SECONDS = 5
PATIENCE = 3600  # seconds a program may take: a limit for one that hangs, however busy this machine is
# Nanoseconds per instruction, as powers of two. Tests that spin for a time are cheaper on a slower processor, which has to be
# fast enough for the chapter's 100 us.
SLOW, FAST = 3, 1
BEGIN = "cd /tmp; export HOME=/tmp INDUROP_STATE_DIR=/tmp/state"
# Everything is in the guest's memory before it runs: fetching a page from this machine takes no counted time, but what waits for
# it with a deadline counts.
PROGRAM = """cat {path} >/dev/null
{path} --gtest_output=xml:/mnt/{name}.xml >/mnt/{name}.log 2>&1"""
CHAPTER = """cat {build}/examples/chapter/*.* {build}/bin/indurop-node {build}/lib/*.so >/dev/null 2>&1
cd {build}/examples/chapter
{build}/bin/indurop-node module.xml --node chapter -q --duration {seconds}s --report /mnt/chapter.json >/mnt/chapter.log 2>&1"""


def needs_machine(program):
    content = program.read_bytes()
    return any(fnmatch.fnmatch(program.name, pattern) for pattern in KERNEL) or any(text in content for text in UNKNOWN)


class Result:
    """What a program reported. One without GoogleTest counts as one test, which passes with exit code 0."""

    def __init__(self, name, where, reports, plain_code=None):
        self.name = name
        self.where = where
        self.failed, self.count, self.skipped, self.seconds = [], 0, 0, 0.0
        log = reports / f"{name}.log"
        self.log = log.read_text(errors="replace") if log.exists() else "it was not started\n"
        if plain_code is not None:
            self.count = 1
            self.failed = [f"exit code {plain_code}"] if plain_code else []
            return
        try:
            cases = xml.parse(reports / f"{name}.xml").getroot()
        except (OSError, xml.ParseError):
            begun = re.findall(r"\[ RUN      \] (\S+)", self.log)
            self.failed = [f"no report; it crashed or did not end in {begun[-1] if begun else 'its beginning'}"]
            return
        self.seconds = float(cases.get("time"))
        for case in cases.iter("testcase"):
            self.count += 1
            self.skipped += case.get("result") == "skipped"
            if case.find("failure") is not None:
                self.failed.append(f"{case.get('classname')}.{case.get('name')}")

    def show(self):
        skipped = f", {self.skipped} skipped" if self.skipped else ""
        print(f"{self.where:8}{self.name:30}{self.count:5} tests{skipped}, {self.seconds:.0f} s"
              f"{', FAILED ' + str(len(self.failed)) if self.failed else ''}", flush=True)


def by_user(program, reports):
    """One program in qemu-user."""
    code = -1
    with tempfile.TemporaryDirectory() as folder, open(reports / f"{program.name}.log", "w", encoding="utf-8") as log:
        with contextlib.suppress(subprocess.TimeoutExpired):
            code = subprocess.run(["qemu-aarch64", program, f"--gtest_output=xml:{reports / program.name}.xml"],
                                  cwd=folder, stdout=log, stderr=log, stdin=subprocess.DEVNULL, timeout=PATIENCE, check=False,
                                  env={**os.environ, "INDUROP_STATE_DIR": folder}).returncode
    return Result(program.name, "user", reports, None if b"[ RUN      ] " in program.read_bytes() else code)


def chapter_faults(build, reports):
    """What is wrong with Figure 1 of the chapter, in a machine of its own."""
    own = reports / "chapter"
    own.mkdir()
    machine.run(f"{BEGIN}\n{CHAPTER.format(build=build, seconds=CHAPTER_SECONDS)}\n", own, FAST, PATIENCE)
    try:
        report = json.loads((own / "chapter.json").read_text())
    except (OSError, ValueError):
        log = own / "chapter.log"
        return ["chapter: no report; " + (log.read_text() if log.exists() else "it was not started")]
    late = report["tick_lateness_ns"]
    print(f"machine chapter: {report['ticks']} ticks, {report['lost_ticks']} lost, lateness p50 {late['p50']} ns, "
          f"p99 {late['p99']} ns, max {late['max']} ns", flush=True)
    counted = {"lost ticks": report["lost_ticks"]}
    for what in ("overruns", "deadline_misses", "faults"):
        counted[what] = sum(module[what] for module in report["modules"])
    wrong = [f"chapter: {count} {what}" for what, count in counted.items() if count]
    if not report["rt"]["fifo"]:
        wrong.append(f"chapter: no real time: {report['rt']['why']}")
    return wrong


def in_machine(program, reports):
    """One program in a machine of its own, which ends with it."""
    own = reports / f"{program.name}.machine"
    own.mkdir()
    machine.run(f"{BEGIN}\n{PROGRAM.format(path=program, name=program.name)}\n", own, SLOW, PATIENCE)
    for file in own.glob(f"{program.name}.*"):
        file.rename(reports / file.name)
    return Result(program.name, "machine", reports)


def results_of(programs, reports, pool):
    """As they end. Those in machines begin first: they take longest."""
    tasks = [pool.submit(in_machine, program, reports) for program in programs if needs_machine(program)]
    tasks += [pool.submit(by_user, program, reports) for program in programs if not needs_machine(program)]
    for task in concurrent.futures.as_completed(tasks):
        yield task.result()


def main():
    build = pathlib.Path(sys.argv[1]).resolve()
    patterns = sys.argv[2:]
    reports = build / "reports"
    shutil.rmtree(reports, ignore_errors=True)
    reports.mkdir()
    started = time.monotonic()
    programs = [path for path in sorted((build / "tests").glob("*_test*")) if os.access(path, os.X_OK) and path.is_file()
                and (not patterns or any(fnmatch.fnmatch(path.name, pattern) for pattern in patterns))]
    chapter = not patterns or "chapter" in patterns
    results = []
    with concurrent.futures.ThreadPoolExecutor(int(os.environ.get("JOBS", os.cpu_count()))) as pool:
        example = pool.submit(chapter_faults, build, reports) if chapter else None
        for result in results_of(programs, reports, pool):
            result.show()
            results.append(result)
        wrong = example.result() if example else []
    for result in results:
        wrong += [f"{result.name}: {case}" for case in result.failed]
    print(f"{sum(result.count for result in results)} tests of {len(results)} programs, {len(wrong)} failed, "
          f"{time.monotonic() - started:.0f} s; what they said: {reports}")
    for text in wrong:
        print(f"FAILED {text}")
    return 1 if wrong or not (results or chapter) else 0


if __name__ == "__main__":
    sys.exit(main())
