#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What grows with a node: modules in one tick, variables in its store."""

import json
import os
import statistics
import subprocess

MODULES = (1, 2, 4, 8, 16, 32, 64, 128, 256)
VARIABLES = (1, 10, 100, 1000, 10_000)
KNEE = 1.5  # times the least that one more costs


def modules(bench):
    """How long after its tick the last of so many modules begins, with 1 ms; and what each costs."""
    rows = []
    for count in MODULES:
        reports = [bench.run_node(bench.many(count, lambda i: ""), "--duration", f"{bench.seconds}s") for _ in range(bench.rounds)]
        last = statistics.median(report["modules"][count - 1]["latency_ns"]["p50"] / 1000 for report in reports)
        late = statistics.median(report["modules"][count - 1]["latency_ns"]["p99"] / 1000 for report in reports)
        lost = statistics.median(report["lost_ticks"] / report["ticks"] for report in reports)
        rows.append({"modules": count, "last begins, us": last, "p99, us": late, "lost, %": lost * 100})
    return rows


def variables(bench):
    """What it takes to make and attach a store of so many numbers, and to write each once."""
    if not bench.has("growth_store"):
        return []
    rows = []
    for count in VARIABLES:
        found = [json.loads(subprocess.run([os.path.join(bench.peers, "growth_store"), str(count)], check=True,
                                           capture_output=True, text=True).stdout) for _ in range(bench.rounds)]
        rows.append({"variables": count, **{key: statistics.median(one[key] for one in found) for key in found[0]}})
    return rows


def measure(bench):
    return {title: rows for title, rows in (("modules", modules(bench)), ("variables", variables(bench))) if rows}


def knee(rows):
    """The first size from which one more costs clearly more than before, by the first figure; None: it grows evenly."""
    size, what = list(rows[0])[:2]
    least = None
    for before, after in zip(rows, rows[1:]):
        each = (after[what] - before[what]) / (after[size] - before[size])
        if each > 0:
            if least is not None and each > KNEE * least:
                return before[size]
            least = each if least is None else min(least, each)
    return None
