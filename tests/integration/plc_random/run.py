#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Random PLC programs, compiled, run and compared with an interpreter that does not know the compiler.

run.py --build DIR [--count N] [--seed S] [--batch N] [--only SEED]: 0 if all are equal. The count is INDUROP_PLC_RANDOM
where that is set. A difference is printed with its program; --only SEED makes that one again."""

import argparse
import concurrent.futures
import contextlib
import os
import random
import re
import sys
import tempfile

import tree
from driver import Failed, compile_batch, counted_lines, observed, results, resumed, shown
from program import Program, TIMES


def differences(program, scans):
    """What differs, in words; the first scan that does."""
    names = observed(program)
    for number, (fault, values) in enumerate(program.scans()):
        if number >= len(scans):
            return [f"scan {number}: it ended before"]
        real_fault, real = scans[number]
        if (fault is None) != (real_fault == ""):
            return [f"scan {number}: fault '{real_fault}', expected '{fault or ''}'"]
        if fault is not None:
            return []  # which part of an expression is computed first is open
        expected = [shown(type_, values[name]) for name, _, type_ in names]
        found = [f"scan {number}: {name} is {b}, expected {a} ({type_.name})"
                 for (name, _, type_), a, b in zip(names, expected, real) if a != b]
        if found:
            return found
    return []


def programs_of(seeds):
    """Those whose loops all end, also the loops of FB_Init, which runs while instances are made."""
    programs = []
    for number, seed in enumerate(seeds):
        with contextlib.suppress(tree.Endless):
            programs.append(Program(seed, number))
    return [one for one in programs if one.ends()]


def check_batch(build, folder, seeds, optimize):
    programs = programs_of(seeds)
    if not programs:
        return []
    try:
        driver = compile_batch(build, folder, programs, optimize)
        found = results(driver, folder)
        scan = random.Random(seeds[0]).randrange(1, len(TIMES))
        continued = resumed(driver, folder, scan)
    except Failed as error:
        if len(seeds) == 1:
            return [(seeds[0], programs[0].text(), [str(error)])]
        half = len(seeds) // 2  # which of them is it?
        return check_batch(build, folder + "a", seeds[:half], optimize) + check_batch(build, folder + "b", seeds[half:], optimize)
    all_found = [(one.seed, one.text(), differences(one, found.get(one.prefix, []))) for one in programs]
    for one, (_, _, what) in zip(programs, all_found):
        if not what and continued.get(one.prefix) != found.get(one.prefix):
            what.append(f"continued in another process before scan {scan}, it differs")
    return [one for one in all_found if one[2]]


def check_counts(build, folder, seeds, optimize):
    """Lines that ran more or less often than they did in the interpreter. What a fault ends is left out."""
    programs = programs_of(seeds)
    results(compile_batch(build, folder, programs, optimize, coverage=True), folder)
    counted = counted_lines(build, folder)
    bad, compared, line = [], 0, 0
    for one in programs:
        before = list(tree.counts)
        faults = [fault for fault, _ in one.scans()]
        found = []
        for text in one.text():
            line += 1
            mark = re.search(r"\(\*#(\d+)\*\)", text)
            if mark is None or any(faults):
                continue
            number = int(mark.group(1))
            expected = tree.counts[number] - before[number]
            compared += 1
            if counted.get(line, 0) != expected:  # a POU without a caller is not in the module
                found.append(f"line {line} ran {counted.get(line)} times, expected {expected}: {text.strip()}")
        if found:
            bad.append((one.seed, one.text(), found))
    if not compared:
        bad.append((0, [], ["nothing was compared"]))
    return bad


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", required=True)
    parser.add_argument("--count", type=int, default=int(os.environ.get("INDUROP_PLC_RANDOM", "200")))
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--batch", type=int, default=100)
    parser.add_argument("--only", type=int)
    parser.add_argument("--optimize", default=os.environ.get("INDUROP_PLC_OPTIMIZE", "-O0"))
    parser.add_argument("--keep", default="")
    parser.add_argument("--coverage", action="store_true", help="compare how often lines run, instead of values")
    options = parser.parse_args()
    seeds = [options.only] if options.only is not None else list(range(options.seed, options.seed + options.count))
    build = os.path.abspath(options.build)
    bad = []
    with tempfile.TemporaryDirectory() as scratch, concurrent.futures.ProcessPoolExecutor(os.cpu_count()) as pool:
        folder = os.path.abspath(options.keep) if options.keep else scratch
        jobs = [pool.submit(check_counts if options.coverage else check_batch, build, os.path.join(folder, str(i)), seeds[i:i + options.batch], options.optimize)
                for i in range(0, len(seeds), options.batch)]
        for job in jobs:
            bad += job.result()
    for seed, text, what in bad:
        print(f"seed {seed}:\n  " + "\n  ".join(what[:8]))
        if len(bad) <= 3:
            print("\n".join(text))
    print(f"{len(seeds)} programs, {len(bad)} of them wrong")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
