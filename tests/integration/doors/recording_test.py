#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Recordings in Python: what `indurop record` wrote of a node, compared with what `indurop recording export` makes of the
same file."""

import csv
import io
import math
import random
import shutil
import signal
import subprocess
import unittest
import warnings

import numpy
import pandas

from doors_node import OPTIONS, PATIENCE, NodeTest, indurop, wait_until


def cells_of(frame):
    """The cells of a table as the command line writes them, for comparing: numbers as numbers."""
    return [[int(time.value), *row] for time, row in zip(frame.index, frame.itertuples(index=False))]


def same(is_, said):
    if isinstance(is_, str):
        return is_ == said
    if isinstance(is_, (bool, numpy.bool_)):
        return said == ("true" if is_ else "false")
    return float(said) == float(is_) or (math.isnan(float(said)) and math.isnan(float(is_)))


class Recordings(NodeTest):
    def record(self):
        """Changes variables of every kind while a recorder runs. Returns the file."""
        file = self.work / "run.mcap"
        with subprocess.Popen([OPTIONS.indurop, "record", "--node", self.name, "--past", "-o", file, "-q"],
                              cwd=self.work) as recorder:
            wait_until("it records", file.exists)
            some = random.Random(5)
            for i in range(40):
                self.node["gain"] = some.randrange(11)
                self.node[f"places[{i % 3}]"] = {"x": some.uniform(-10, 10), "valid": bool(i % 2), "name": f"p{i}ö"}
                self.node["mode"] = some.choice(("OFF", "AUTO", "MANUAL"))
                self.node["text"] = some.choice(("", "home", 'a, "quoted"'))
                self.node[f"grid[{i % 2}]"] = [some.randrange(-128, 128) for _ in range(3)]
                before = self.node["count"]
                wait_until("the node has run", lambda: self.node["count"] > before + 2)  # pylint: disable=cell-var-from-loop
            recorder.send_signal(signal.SIGINT)
            self.assertEqual(recorder.wait(PATIENCE), 130)
        return file

    def exported(self, file, *options):
        """The table of the command line from the row on in which all cells are known."""
        out = self.work / "out.csv"
        self.indurop("recording", "export", str(file), "--csv", str(out), "-q", *options)
        head, *rows = csv.reader(io.StringIO(out.read_text()))
        return head, [row for row in rows if all(cell != "" for name, cell in zip(head, row) if not is_text(name))]

    def compare(self, frame, head, rows):
        self.assertEqual(sorted(frame.columns), sorted(head[1:]))
        cells = cells_of(frame[head[1:]])
        self.assertEqual(len(cells), len(rows))
        for mine, theirs in zip(cells, rows):
            for name, is_, said in zip(head, mine, theirs):
                self.assertTrue(same(is_, said), f"{name} at {theirs[0]}: {is_!r}, exported {said!r}")

    def test_the_same_values_as_the_command_line(self):
        file = self.record()
        with indurop.recording(file) as recording:
            self.assertEqual(sorted(recording), sorted(self.node))
            self.assertEqual(recording.damages, [])
            head, rows = self.exported(file)
            frame = recording.frame()
            self.compare(frame, head, rows)
            self.assertGreater(len(rows), 100)
            self.assertEqual(len({row[head.index("doors::text")] for row in rows}), 3)
            self.compare(recording.frame("doors::gain", "doors::count", every=0.01),
                         *self.exported(file, "doors::gain", "doors::count", "--every", "10ms"))
            self.assertEqual(frame.attrs["units"]["doors::twice"], "runs")
            self.assertIsInstance(frame.index, pandas.DatetimeIndex)

    def test_samples_of_each_run(self):
        with indurop.recording(self.record()) as recording:
            time, count = recording["count"]
            self.assertEqual(count.dtype, numpy.uint64)
            self.assertEqual(count.tolist(), list(range(int(count[0]), int(count[0]) + len(count))))
            self.assertTrue((numpy.diff(time) > 0).all())
            self.assertEqual((time[0] >= recording.span[0], time[-1] <= recording.span[1]), (True, True))
            both = recording.samples("count", "twice")
            numpy.testing.assert_array_equal(both["twice"].value, 2.0 * both["count"].value)
            self.assertGreaterEqual(len(recording.samples("count", repeats=True)["count"].time), len(time))
            middle = recording.samples("count", begin=int(time[10]), end=int(time[20]))["count"]
            self.assertEqual(middle.value.tolist(), count[10:21].tolist())
            self.assertEqual(recording["grid"].value.shape[1:], (2, 3))
            self.assertEqual(recording["places[1].name"].value.dtype, numpy.dtype("S12"))
            self.assertEqual(recording.variable("places").layout.fields, self.node.variable("places").layout.fields)

    def test_errors_are_named(self):
        file = self.record()
        with indurop.recording(file) as recording:
            with self.assertRaisesRegex(indurop.NotFound, "did you mean 'doors::gain'"):
                recording["gian"]  # pylint: disable=pointless-statement
            self.assertNotIn("place", recording)
            self.assertIn("places[2].y", recording)
        with self.assertRaises(indurop.NotFound):
            indurop.recording(self.work / "none.mcap")
        with self.assertRaises(indurop.Corrupt):
            indurop.recording(self.work / "module.xml")

    def test_a_file_that_was_cut_off(self):
        file = self.record()
        with indurop.recording(file) as recording:
            whole = recording["count"]
        shutil.copy(file, self.work / "cut.mcap")
        with open(self.work / "cut.mcap", "r+b") as cut:
            cut.truncate(file.stat().st_size * 3 // 4)
        with warnings.catch_warnings(record=True) as warned:
            warnings.simplefilter("always")
            with indurop.recording(self.work / "cut.mcap") as recording:
                part = recording["count"]
                self.assertEqual([str(one.message) for one in warned], recording.damages)
        self.assertNotEqual(warned, [])
        self.assertEqual(part.value.tolist(), whole.value[:len(part.value)].tolist())
        self.assertEqual(part.time.tolist(), whole.time[:len(part.time)].tolist())


def is_text(column):
    return column.endswith((".name", "::text"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
