#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The arm of examples/robot_contact presses on a sheet (press.xml), in virtual time: the simulated sensor measures the forces of
the job along the whole path, and the tool is where springs of that stiffness have them. A sheet out of reach fails the job."""

import argparse
import math
import pathlib
import sys

from contact_test import Cell

ALONG_SHEET, ALONG_LEDGE = 12, 19  # lines of press.job
JOB = "PLC_ROBOT::ROBOT_JOB"
RUNS, FAILED = "1", "4"  # recordings hold numbers


def on_line(rows, line):
    """The rows in which the tool moves along that line, without the first 0.2 s."""
    found = [row for row in rows if int(row[f"{JOB}.nLine"]) == line and row[f"{JOB}.eState"] == RUNS and
             float(row["PLC_ROBOT::ROBOT_ARM.tool_speed"]) > 0]
    return [row for row in found if row["t"] > found[0]["t"] + 0.2] if found else []


def force(rows, axis):
    return [float(row[f"CONTACT::force[{axis}]"]) for row in rows]


def place(row, axis):
    return float(row[f"PLC_ROBOT::ROBOT_ARM.position[{axis}]"])


def mean(values):
    return sum(values) / len(values) if values else math.nan


def worst(values, wanted):
    return max((abs(value - wanted) for value in values), default=math.nan)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--bin", type=pathlib.Path, required=True)
    parser.add_argument("--example", type=pathlib.Path, required=True)
    parser.add_argument("--io-module", required=True)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    cell = Cell(parser.parse_args())
    failed = []

    def expect(what, is_so, seen):
        print(f"{'ok  ' if is_so else 'FAIL'} {what}: {seen}")
        if not is_so:
            failed.append(what)

    rows = cell.run("sheet", 40, config="press.xml")
    sheet, ledge = on_line(rows, ALONG_SHEET), on_line(rows, ALONG_LEDGE)
    down = force(sheet, 2)
    expect("20 N along the sheet", abs(mean(down) - 20) < 0.5 and worst(down, 20) < 6, (mean(down), worst(down, 20)))
    # 30 N/mm; the set points of the drives, which give way a little.
    off = [place(row, 2) - (250 + 2 * math.sin(2 * math.pi * place(row, 1) / 300) - 20 / 30) for row in sheet]
    expect("the tool follows its waves", worst(off, 0) < 0.8, worst(off, 0))
    down, side = force(ledge, 2), force(ledge, 0)
    expect("20 N on the sheet and 8 N against the ledge", abs(mean(down) - 20) < 0.5 and abs(mean(side) + 8) < 0.5 and
           worst(down, 20) < 6 and worst(side, -8) < 6, (mean(down), mean(side), worst(down, 20), worst(side, -8)))
    off = [place(row, 0) - (540 + 8 / 20) for row in ledge]
    expect("the tool is at the ledge", worst(off, 0) < 0.8, worst(off, 0))
    expect("it ends and begins again", int(rows[-1][f"{JOB}.nCycles"]) >= 1, rows[-1][f"{JOB}.nCycles"])
    rows = cell.run("low", 12, (('name="sheet">250', 'name="sheet">235'),), "press.xml")
    lowest = min(place(row, 2) for row in rows if row["t"] > 1)
    lines = {row[f"{JOB}.nLine"] for row in rows if row[f"{JOB}.eState"] == FAILED}
    expect("a sheet out of reach fails the job at its WAIT, and the tool stays within LIMIT",
           lines == {"11"} and 256 - 12 <= lowest < 256 - 11.5, (lowest, lines))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
