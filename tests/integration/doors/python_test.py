#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The Python package on a node that runs: values of every kind, changes, forces, snapshots, watching, and a node that
comes back with other variables. What it reads is compared with what the command line says."""

import asyncio
import unittest

from doors_node import PATIENCE, NodeTest, indurop, wait_until


class Python(NodeTest):
    def test_values_of_every_kind(self):
        node = self.node
        self.assertEqual(node["text"], "home")
        self.assertEqual(node["mode"].name, "MANUAL")
        self.assertEqual(node["mode"], 2)
        self.assertAlmostEqual(node["gain"], 1.5)
        self.assertEqual(node["grid"], [[0, 0, 0], [0, 0, 0]])
        self.assertEqual(node["places[1]"], indurop.Record(x=0, y=0, valid=False, name=""))
        node["places[1]"] = {"x": 2.5, "name": "tool"}
        node["places[1].valid"] = True
        node["grid"] = [[1, 2, 3], [-4, 5, -128]]
        node["mode"] = "AUTO"
        node["text"] = "away"
        self.assertEqual(self.shown_value("places[1]"), {"x": 2.5, "y": 0, "valid": True, "name": "tool"})
        self.assertEqual(self.shown_value("grid"), [[1, 2, 3], [-4, 5, -128]])
        self.assertEqual(self.shown_value("mode"), "AUTO")
        self.assertEqual(self.shown_value("text"), "away")
        self.assertEqual(node["doors::places[1]"].name, "tool")
        self.assertIn("places", node)
        self.assertNotIn("place", node)
        self.assertEqual(sorted(node), ["doors::count", "doors::gain", "doors::grid", "doors::mode", "doors::places",
                                        "doors::text", "doors::twice"])

    def test_what_is_declared(self):
        x = self.node.variable("places[2].x")
        self.assertEqual((x.name, x.type, x.unit, x.range), ("doors::places[2].x", "double", "mm", (-10, 10)))
        self.assertTrue(self.node.variable("text").retain)
        self.assertTrue(self.node.variable("gain").parameter)
        self.assertTrue(self.node.variable("gain").source.startswith("doors.glb:"))

    def test_refuses_and_changes_nothing(self):
        node = self.node
        for name, value, error in (("gain", 11, indurop.OutOfRange), ("gain", "much", indurop.OutOfRange),
                                   ("grid", [[1, 2, 3], [4, 5, 128]], indurop.OutOfRange),
                                   ("grid", [[1, 2, 3]], indurop.OutOfRange), ("mode", 3, indurop.OutOfRange),
                                   ("text", "x" * 16, indurop.OutOfRange), ("text", "a\0b", indurop.OutOfRange),
                                   ("text", b"abc", indurop.OutOfRange), ("text", "\ud800", indurop.OutOfRange),
                                   ("places[0].valid", "false", indurop.OutOfRange),
                                   ("places[0].valid", 2, indurop.OutOfRange), ("places[0].x", 11, indurop.OutOfRange),
                                   ("places[0]", {"z": 1}, indurop.OutOfRange), ("gian", 1, indurop.NotFound)):
            with self.assertRaises(error, msg=f"{name} = {value}"):
                node[name] = value
        with self.assertRaisesRegex(indurop.NotFound, "did you mean 'doors::gain'"):
            node.variable("gian")
        self.assertEqual(self.shown_value("grid"), [[0, 0, 0], [0, 0, 0]])
        with indurop.node(self.name) as reader, self.assertRaises(indurop.Denied):
            reader["gain"] = 1

    def test_forces(self):
        gain = self.node.variable("gain")
        gain.force(3, reason="test stand")
        self.assertTrue(gain.quality.forced)
        self.assertFalse(gain.quality.good)
        with self.assertRaises(indurop.Forced):
            gain.write(1)
        self.assertEqual(self.node["gain"], 3)
        gain.release()
        gain.write(1)
        self.assertTrue(gain.quality.good)
        with self.assertRaises(indurop.NotFound):
            gain.release()
        for seconds in (1e-12, 0.05):  # 0 ns would mean until it is released
            gain.force(3, seconds=seconds)
            wait_until("the force times out", lambda: not gain.quality.forced)
        for seconds in (-1, float("nan"), float("inf"), 1e300):
            with self.assertRaises(indurop.Invalid):
                gain.force(3, seconds=seconds)
        self.assertFalse(gain.quality.forced)

    def test_values_of_one_moment(self):
        together = 0
        for _ in range(2000):
            both = self.node.snapshot("count", "twice")
            self.assertIn(both["twice"] - 2 * both["count"], (0, -2))  # between the two writes of a run
            together += 1
        self.assertEqual(together, 2000)

    def test_numpy(self):
        places = self.node.variable("places")
        array = places.numpy()
        self.assertEqual(array.shape, (3,))
        self.node["places[2]"] = {"y": 4.25, "name": "arm"}
        self.assertEqual(array["y"][2], 0)
        self.assertIs(places.numpy(), array)
        self.assertEqual(array["y"][2], 4.25, "the array shares the bytes of the last read")
        self.assertEqual(array["name"][2], b"arm")
        self.assertEqual(self.node.variable("grid").numpy().dtype.name, "int8")
        self.assertEqual(self.node.variable("places[2]").numpy()["y"], 4.25)

    def test_watching(self):
        seen = []
        for value in self.node.variable("count").watch(timeout=PATIENCE):
            seen.append(value)
            if len(seen) == 20:
                break
        self.assertEqual(seen, sorted(set(seen)))
        with self.assertRaises(indurop.Timeout):
            list(self.node.variable("gain").watch(timeout=0.05))

        async def some():
            found = []
            async for value in self.node.variable("count").watch_async():
                found.append(value)
                if len(found) == 5:
                    return found
            return found

        self.assertEqual(len(asyncio.run(some())), 5)

    # Every run, in order, with the values after it; the command line's tape reader counts the same.
    def test_every_run(self):
        rows = []
        with self.node.stream("count", "doors::twice", past=True) as stream:
            while len(rows) < 2000:
                rows.extend(stream.read().tolist())
            self.assertEqual(stream.lost, 0)
        ticks = [row[0] for row in rows]
        counts = [row[2] for row in rows]
        self.assertEqual(counts, list(range(counts[0], counts[0] + len(counts))))
        self.assertEqual(counts[0], 1, "from the first run on")
        self.assertEqual(ticks, sorted(set(ticks)))
        self.assertEqual([row[3] for row in rows], [2 * count for count in counts])
        self.assertEqual([row[1] for row in rows], sorted(row[1] for row in rows))

    def test_runs_from_now_on(self):
        before = self.node["count"]
        with self.node.stream("count") as stream:
            first = stream.read()["count"].tolist()[0]
            self.assertGreater(first, before)
            self.stop()
            rest = [count for rows in stream for count in rows["count"].tolist()]
        self.assertEqual(rest, list(range(rest[0], rest[0] + len(rest))) if rest else [])
        self.assertEqual(self.node["count"], rest[-1] if rest else first)

    def test_changes_of_what_no_module_uses(self):
        with self.node.stream("gain") as stream:
            self.node["gain"] = 2.5
            wait_until("the change comes", lambda: 2.5 in stream.read(timeout=PATIENCE)["gain"])

    def test_the_end_of_a_node(self):
        watched = self.node.variable("count").watch()
        next(watched)
        self.stop()
        rest = list(watched)  # ends when the node ends
        self.assertFalse(self.node.running)
        last = self.node["count"]
        self.assertEqual(last, rest[-1] if rest else last)

    # The handle of a node that comes back reads the new one; a variable of another type is not read by the old handle.
    def test_a_node_that_comes_back(self):
        count = self.node.variable("count")
        before = count.value
        self.stop()
        self.start()
        wait_until("it counts from the beginning", lambda: 0 < count.value)
        self.assertTrue(self.node.running)
        self.assertGreater(before, 0)


if __name__ == "__main__":
    unittest.main(verbosity=2)
