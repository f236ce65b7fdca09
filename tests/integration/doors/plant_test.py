#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Plants in virtual time from Python: ticks, values, several boards, faults, and that a run is the same when it is
repeated. Then a deployment of a plant to an agent."""

import os
import pathlib
import random
import shutil
import subprocess
import tempfile
import unittest

from doors_node import OPTIONS, PATIENCE, XML, indurop, wait_until

BROKEN = """<module><filename>./broken.py</filename><moduletype>process</moduletype>
<operationtype>non-real</operationtype><restart max="0" escalate="stop-node"/></module>"""
DOMAIN = 100 + os.getpid() % 100


class InWorkFolder(unittest.TestCase):
    def setUp(self):
        self.work = pathlib.Path(tempfile.mkdtemp(prefix="plant_test_"))
        os.environ["INDUROP_STATE_DIR"] = str(self.work / "state")
        shutil.copy(OPTIONS.module, self.work)
        self.file = self.work / "module.xml"
        self.file.write_text(XML.format(file=pathlib.Path(OPTIONS.module).name))

    def tearDown(self):
        shutil.rmtree(self.work)


class VirtualTime(InWorkFolder):
    def test_ticks_and_values(self):
        with indurop.Plant(self.file) as plant:
            self.assertEqual((plant.tick, plant["count"], plant.time, plant.basic_period), (0, 0, 0, 0.001))
            plant.step()
            self.assertEqual((plant.tick, plant["count"]), (1, 1))
            plant.step(9)
            plant.run(0.01)
            self.assertEqual((plant.tick, plant["count"], plant["doors::twice"]), (20, 20, 40))
            plant.run(0.0005)
            self.assertEqual(plant.tick, 21, "whole periods, rounded up")
            plant["places[1]"] = {"x": 2.5, "name": "tool"}
            self.assertEqual(plant["places"][1].name, "tool")
            count = plant.variable("count")
            count.force(7)
            plant.step(3)
            self.assertEqual((plant["count"], plant["twice"]), (7, 14))
            count.release()
            self.assertTrue(plant.run_until(lambda: plant["count"] == 10, at_most=1))
            self.assertEqual(plant.tick, 27)
            self.assertFalse(plant.run_until(lambda: plant["count"] == 10_000, at_most=0.01))
            self.assertAlmostEqual(plant.time, 0.037)
            self.assertEqual((plant.module("doors_counting").runs, plant.module("doors_counting").overruns), (plant.tick, 0))
            with self.assertRaises(indurop.NotFound):
                plant.module("contuing")
            with self.assertRaisesRegex(indurop.NotFound, "did you mean 'doors::gain'"):
                plant["gian"] = 1
            with self.assertRaises(indurop.Invalid):
                plant.run(-1)

    def trial(self, file):
        """Drives a plant by chance that is the same each time; returns all it saw."""
        some = random.Random(3)
        seen = []
        with indurop.Plant(self.file, record=file) as plant:
            for _ in range(30):
                plant["gain"] = some.uniform(0, 10)
                plant["count"] = some.randrange(1 << 60)
                plant.step(some.randrange(1, 20))
                seen.append((plant.tick, plant["count"], plant["twice"], plant["gain"]))
        return seen

    def test_twice_the_same(self):
        first, second = self.work / "first.mcap", self.work / "second.mcap"
        self.assertEqual(self.trial(first), self.trial(second))
        with indurop.recording(first) as one, indurop.recording(second) as other:
            self.assertEqual(one.damages, [])
            self.assertGreater(len(one["count"].time), 100)
            again = other.samples(repeats=True)
            for name, samples in one.samples(repeats=True).items():
                self.assertEqual(samples.time.tobytes(), again[name].time.tobytes(), name)
                self.assertEqual(samples.value.tobytes(), again[name].value.tobytes(), name)

    def test_a_plant_of_several_boards(self):
        plant_xml = pathlib.Path(OPTIONS.two_boards) / "plant.xml"
        with indurop.Plant(plant_xml, arguments=["--network", "delay=2500us"]) as plant:
            self.assertEqual(sorted(plant.nodes), ["control", "sensor"])
            plant.run(0.05)
            with self.assertRaisesRegex(indurop.NotFound, "encoder@control"):
                plant["encoder"]  # pylint: disable=pointless-statement
            measured = []
            for _ in range(10):
                plant.step()
                measured.append(plant["encoder@sensor"])
            self.assertEqual(measured[-1].count, plant.tick)
            self.assertIn(plant["encoder@control"], measured[-4:-1], "the other board has it after the delay")
            self.assertEqual(plant.module("table").runs, plant.tick)
            self.assertEqual(plant.module("controller@control").runs, plant.tick)
            with self.assertRaisesRegex(indurop.NotFound, "control, sensor"):
                plant["encoder@press"]  # pylint: disable=pointless-statement
        with indurop.Plant(plant_xml, board="sensor") as plant:
            plant.step(3)
            self.assertEqual(plant.module("table").runs, 3)

    def test_what_cannot_be_run(self):
        self.file.write_text("<root><module>")
        with self.assertRaisesRegex(indurop.Gone, "module.xml:1"):
            indurop.Plant(self.file)
        self.file.write_text(XML.format(file="none.so"))
        with self.assertRaisesRegex(indurop.Gone, "none.so"):
            indurop.Plant(self.file)

    def test_nothing_is_left_behind(self):
        with indurop.Plant(self.file) as plant:
            name = plant.nodes[""].name
            plant["gain"] = 2
            self.assertNotEqual(list(pathlib.Path("/dev/shm").glob(f"*{name}*")), [])
        self.assertEqual(list(pathlib.Path("/dev/shm").glob(f"*{name}*")), [])


class Deployment(InWorkFolder):
    ARGUMENTS = ["--one-host", "--domain", str(DOMAIN)]

    def setUp(self):
        super().setUp()
        self.board = f"drive{os.getpid()}"
        self.agent = subprocess.Popen([pathlib.Path(OPTIONS.indurop).parent / "indurop-agent", "--board", self.board,
                                       "-q", *self.ARGUMENTS], cwd=self.work, stdout=subprocess.DEVNULL,
                                      stderr=subprocess.DEVNULL)

    def tearDown(self):
        self.agent.terminate()
        self.agent.wait(PATIENCE)
        subprocess.run([OPTIONS.indurop, "stop", "--node", self.board], capture_output=True, check=False)
        subprocess.run([OPTIONS.indurop, "clean", "--node", self.board], capture_output=True, check=False)
        super().tearDown()

    def manifest(self, module, more=""):
        file = self.work / "plant.xml"
        file.write_text(f'<plant name="doors"><board name="{self.board}">'
                        + XML.format(file=module).replace("<root>", "").replace("</root>", "") + more + "</board></plant>")
        return file

    def deploy(self, file, **options):
        return indurop.deploy(file, timeout=30, arguments=self.ARGUMENTS, **options)

    def test_a_plant_is_deployed(self):
        module = pathlib.Path(OPTIONS.module).name
        report = self.deploy(self.manifest(module), comment="from Python", health=0.5)
        self.assertEqual([one["board"] for one in report["boards"]], [self.board])
        with indurop.node(self.board) as node:
            wait_until("its module runs", lambda: node["count"] > 0)
        broken = self.work / "broken.py"
        broken.write_text("#!/bin/sh\nexit 3\n")
        broken.chmod(0o755)
        with self.assertRaises(indurop.RolledBack):
            self.deploy(self.manifest(module, BROKEN))
        with indurop.node(self.board) as node:
            wait_until("what ran before runs again", lambda: node.running and node["count"] > 0)
        with self.assertRaisesRegex(indurop.Invalid, "none.so"):
            self.deploy(self.manifest("none.so"))
        file = self.manifest(module)
        file.write_text(file.read_text().replace(self.board, "press"))
        with self.assertRaisesRegex(indurop.Unreachable, "press"):
            indurop.deploy(file, timeout=0.5, arguments=self.ARGUMENTS)


if __name__ == "__main__":
    unittest.main(verbosity=2)
