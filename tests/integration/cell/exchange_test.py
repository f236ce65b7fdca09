#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The ladder program of the robot cell (examples/robot_cell) is exchanged while the robot works. In virtual time, it is exchanged again
and again at arbitrary instants, on one board and on two: all values of the cell are those of a run without exchanges, tick by tick and
bit by bit. In real time, a ladder that behaves in another way is not exchanged, because its
shadow differs, and one that goes wrong is replaced by the previous one. INDUROP_CELL_EXCHANGED says how many simulations."""

import csv
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import time

from cell import read_arguments
from cell_test import RunningCell, copy_configuration
from stops_test import configure

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from nodes import remove_at_exit  # noqa: E402

SIMULATED_S = 90
MOST_TRIES = 4  # of each simulation
VALUES = ("PLC_ROBOT::AXIS?_IN", "PLC_ROBOT::AXIS?_OUT", "PLC_ROBOT::ROBOT_*", "PLC_ROBOT::O*")
DIFFERS, WENT_BACK = 4, 5  # exit codes of reload
NOT_RUNNING = ("does not run", "is just starting", "there is no node", "the node itself ends", "has ended")  # not yet, or no more
PRESSES = "start 1.00 1.30, curtain 21.00 21.80, reset 22.30 22.50, start 22.80 23.00"


class Simulation:
    """A run of the cell in virtual time, with a recording of each board."""

    def __init__(self, arguments, folder, file, boards, name):
        self.arguments, self.folder, self.boards, self.name = arguments, folder, boards, name
        self.nodes = [f"{board}-sim" for board in boards] if len(boards) > 1 else boards
        remove_at_exit(f"{arguments.bin}/indurop", *self.nodes)
        node = [] if len(boards) > 1 else ["--node", boards[0]]
        self.process = subprocess.Popen([f"{arguments.bin}/indurop", "run", file, "--sim", "--until", f"{SIMULATED_S}s", "-q", "--record",
                                         f"{name}.mcap", *node], cwd=folder, stdout=subprocess.DEVNULL)

    def indurop(self, *words):
        return subprocess.run([f"{self.arguments.bin}/indurop", *words], cwd=self.folder, text=True, capture_output=True, timeout=120,
                              check=False)

    def exchange(self, ladder):
        """The tick with which another version of the ladder program began; None: the simulation has ended."""
        while self.process.poll() is None:
            done = self.indurop("reload", "main", ladder, "--node", self.nodes[0], "--health", "0s")
            began = re.search(r"runs since tick (\d+); (\d+) ticks without new values", done.stdout)
            if began:
                assert began[2] == "0", done.stdout
                return int(began[1])
            if self.process.poll() is None and not any(text in done.stderr for text in NOT_RUNNING):
                raise AssertionError(done.stdout + done.stderr)
        return None

    def values(self):
        """Every value of the cell, with its time, after the end of the simulation."""
        assert self.process.wait(timeout=300) == 0, "the simulation failed"
        tables = []
        for board in self.boards:
            recording = f"{self.name}.{board}.mcap" if len(self.boards) > 1 else f"{self.name}.mcap"
            table = os.path.join(self.folder, f"{self.name}.{board}.csv")
            done = self.indurop("recording", "export", recording, *VALUES, "--csv", table)
            assert done.returncode == 0, done.stderr
            with open(table, encoding="utf-8") as file:
                tables.append(list(csv.DictReader(file)))
        return tables


def compare(reference, values, boards):
    """Fails with the first value that differs."""
    for board, wanted, got in zip(boards, reference, values):
        for before, after in zip(wanted, got):
            differs = [f"{name}: {before[name]} and {after.get(name)}" for name in before if before[name] != after.get(name)]
            assert not differs, f"{board}: at {before['time_ns']} ns, without and with exchanges: {differs}"
        assert len(wanted) == len(got), f"{board}: {len(wanted)} values, {len(got)} with exchanges"


def without_a_difference(arguments, configuration, boards, simulations):
    with tempfile.TemporaryDirectory() as folder:
        text = configure(arguments.cell, arguments.io_module, arguments.visitor, folder, configuration).replace("PRESSES", PRESSES)
        for board in boards:
            text = text.replace(f'<board name="{board.split("_")[0]}"', f'<board name="{board}"')
        with open(os.path.join(folder, configuration), "w", encoding="utf-8") as out:
            out.write(text)
        reference = Simulation(arguments, folder, configuration, boards, "reference").values()
        assert all(len(table) > 5000 for table in reference), "the cell does not work"
        ladders = [f"{arguments.cell}/main_remembers.so", f"{arguments.cell}/main.so"]
        done = 0
        for number in range(MOST_TRIES * simulations):
            simulation = Simulation(arguments, folder, configuration, boards, f"exchanged{number}")
            ticks = []
            while len(ticks) == 0 or ticks[-1] is not None:
                time.sleep(random.uniform(0, 0.05))
                ticks.append(simulation.exchange(ladders[len(ticks) % 2]))
            compare(reference, simulation.values(), boards)
            exchanged = [tick for tick in ticks if tick is not None]
            print(f"{configuration}: equal with exchanges in ticks {exchanged}")
            done += 1 if len(exchanged) >= 2 else 0  # on a busy machine it may end before the second command
            if done == simulations:
                return
        raise AssertionError(f"{configuration}: two exchanges in {done} of {MOST_TRIES * simulations} simulations only")


def press_start(cell):
    cell.press("start", lambda: cell.get(cell.robot, "ROBOT_MODULE_STATE.eState") == "ROBOT_GROUP_MOVING")


def wait_for_parts(cell, number):
    placed = cell.get(cell.station, "CELL::world.placed")
    cell.wait("parts on the pallet", lambda: (cell.get(cell.station, "CELL::world.placed") or 0) >= placed + number)


def in_real_time(arguments):
    node = "cell_exchange_test"

    def reload(*words):
        return cell.indurop("reload", "main", *words, "--node", node)

    with tempfile.TemporaryDirectory() as folder:
        copy_configuration(arguments.cell, arguments.io_module, folder)
        recording = os.path.join(folder, "run.mcap")
        with RunningCell(arguments, folder, ["module.xml", "--node", node, "--record", recording], node, node) as cell:
            cell.wait("Modbus station", lambda: cell.get(node, "I14") == 1)
            cell.wait("the emergency stop", lambda: cell.get(node, "EMERGENCY_STOP.bActive") == 0)
            press_start(cell)
            wait_for_parts(cell, 1)
            drops = reload(f"{arguments.cell}/main_drops.so", "--shadow", "10s")
            assert drops.returncode == DIFFERS and "PLC_ROBOT::O1 differs in" in drops.stderr, drops.stdout + drops.stderr
            same = reload(f"{arguments.cell}/main_remembers.so", "--shadow", "3s", "--health", "1s")
            assert same.returncode == 0 and "version 2 runs since tick" in same.stdout, same.stdout + same.stderr
            wait_for_parts(cell, 1)
            wrong = reload(f"{arguments.cell}/main_wrong.so", "--guard", "O4 < 1")
            assert wrong.returncode == WENT_BACK and "the guard did not hold" in wrong.stderr, wrong.stdout + wrong.stderr
            press_start(cell)
            wait_for_parts(cell, 1)
            assert cell.get(node, "CELL::world.lost") == 0, "a part was lost"
        replayed = cell.indurop("replay", recording, "--node", f"{node}_replay")
        assert replayed.returncode == 0 and "values: equal" in replayed.stdout, replayed.stdout + replayed.stderr
        print(drops.stderr.strip(), same.stdout.strip(), wrong.stdout.strip(), wrong.stderr.strip(), replayed.stdout.strip(), sep="\n")


def main():
    arguments = read_arguments(__doc__, bin="folder of the programs", cell="folder with module.xml and plant.xml", io_module="libiodispat.so",
                               visitor="the module of visitor.cpp")
    simulations = int(os.environ.get("INDUROP_CELL_EXCHANGED", "1"))
    without_a_difference(arguments, "module.xml", [f"exchanged_{os.getpid()}"], simulations)
    without_a_difference(arguments, "plant.xml", [f"plc_{os.getpid()}", f"motion_{os.getpid()}"], simulations)
    in_real_time(arguments)
    return 0


if __name__ == "__main__":
    sys.exit(main())
