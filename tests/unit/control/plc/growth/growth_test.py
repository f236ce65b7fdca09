#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""growth_test.py PROGRAM [NAME...]: compiles each text of `PROGRAM --list` with N, 2N and 4N of what it has many of, and
counts instructions with valgrind. The second doubling may take at most twice and a half of what the first one took. Of
BY_INSTANCES it counts N, N + 1 and N + 2."""

import re
import shutil
import subprocess
import sys

SKIPPED = 77
SLACK = 3_000_000  # of a doubling: what starting and printing may differ by
MOST = 2.6         # of n, n log n and what is refused the ratio is at most about 2.3; of n * n it is 4
# Texts with several times as many instances, or copies of actions, for each N: the first N, and how many times.
BY_INSTANCES = {"blocks_of_four": (7, 4), "blocks_of_four_placed": (5, 4), "starts_nested": (8, 3), "actions_doubled": (9, 2)}


def instructions(program, name, n):
    run = subprocess.run(
        ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null", program, name, str(n)],
        capture_output=True, text=True, check=False)
    found = re.search(r"I\s+refs:\s+([\d,]+)", run.stderr)
    if run.returncode != 0 or not found:
        sys.exit(f"{name} {n}: exit code {run.returncode}\n{run.stdout}{run.stderr}")
    return int(found.group(1).replace(",", "")), run.stdout.splitlines()[0]


def main():
    program, wanted = sys.argv[1], sys.argv[2:]
    if shutil.which("valgrind") is None:
        print("skipped: there is no valgrind")
        return SKIPPED
    listed = subprocess.run([program, "--list"], capture_output=True, text=True, check=True).stdout.splitlines()
    failed = 0
    for name, first in (line.split() for line in listed):
        if wanted and name not in wanted:
            continue
        sizes = [int(first) * factor for factor in (1, 2, 4)]
        most = MOST
        if name in BY_INSTANCES:
            from_n, times = BY_INSTANCES[name]
            sizes = [from_n + more for more in (0, 1, 2)]
            most = 1.2 * times  # of the square of their number it would be times * times
        counts, outcomes = zip(*(instructions(program, name, n) for n in sizes))
        # What is refused is not generated: where only the larger one is, the first doubling says nothing.
        kinds = [one.split(",")[0] for one in outcomes]
        same = kinds[0] == kinds[1] == kinds[2]
        before, after = counts[1] - (counts[0] if same else 0), counts[2] - counts[1]
        bad = after > most * before + SLACK
        failed += bad
        print(f"{'FAILED ' if bad else ''}{name}: {', '.join(f'{n}: {c:,} ({o})' for n, c, o in zip(sizes, counts, outcomes))}")
    return 1 if failed else 0


sys.exit(main())
