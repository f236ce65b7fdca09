#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The robot cell (examples/robot_cell) in virtual time, while a visitor opens the circuit of the emergency stop or reaches into
the light curtain at random instants, for a moment or for long, resets and starts it again: the arm stands until then, no part is
lost, and the cell goes on with its work. INDUROP_CELL_STOPS says how many such visits, INDUROP_CELL_SEED the first one."""

import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile

from cell import read_arguments

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from nodes import new_node  # noqa: E402

WORK_S = 30  # after the last start; a part takes about six
EXPECTED = 3  # parts within this time


def visit(seed):
    """What a visitor presses, as the module `visitor` reads it, and when the last press ends, in s."""
    chance = random.Random(seed)
    time, presses = chance.uniform(0.5, 2), []

    def press(what, shortest, longest):
        nonlocal time
        begin, time = time, time + chance.uniform(shortest, longest)
        presses.append(f"{what} {begin:.2f} {time:.2f}")

    press("start", 0.1, 0.4)
    for _ in range(chance.randint(1, 4)):
        time += chance.uniform(0.01, 9)
        press(chance.choice(("stop", "curtain")), 0.05, 1.5)
        time += chance.uniform(0.05, 1)
        press("reset", 0.05, 0.4)
        time += chance.uniform(0.02, 1.2)
        press("start", 0.05, 0.4)
    return ", ".join(presses), time


def configure(cell, io_module, visitor, folder, configuration="module.xml"):
    """The cell's files without the I/O station, whose place `visitor` takes; what `configuration` is then."""
    for name in os.listdir(cell):
        if name.endswith((".job", ".urdf")) or name == "io_motion.xml":
            os.symlink(os.path.join(cell, name), os.path.join(folder, name))
    with open(os.path.join(cell, "ioconfig.xml"), encoding="utf-8") as file:
        drives = re.sub(r'<device name="station".*?</device>', "", file.read(), flags=re.DOTALL)
    with open(os.path.join(folder, "ioconfig.xml"), "w", encoding="utf-8") as file:
        file.write(drives)
    with open(os.path.join(cell, configuration), encoding="utf-8") as file:
        modules = file.read()
    modules = re.sub(r"<module>(?:(?!</module>).)*io_plc.xml.*?</module>", "", modules, flags=re.DOTALL)
    modules = re.sub(r"<filename>./world.exe</filename>.*?</module>",
                     f"<filename>{visitor}</filename><moduletype>thread</moduletype><operationtype>periodic</operationtype>"
                     "<period>10000000</period><priority>0</priority><property><value name=\"presses\">PRESSES</value></property></module>",
                     modules, flags=re.DOTALL)
    return modules.replace("./libiodispat.so", io_module).replace("<filename>./", f"<filename>{cell}/")


def wrong(output):
    said = re.search(r"after the last start (\d+), lost (\d+), crept (\S+) mm", output)
    if not said:
        return "it did not run"
    if int(said[1]) < EXPECTED:
        return f"{said[1]} parts in {WORK_S} s after the last start"
    if int(said[2]) > 0:
        return f"{said[2]} parts lost"
    return f"the tool went {said[3]} mm while it had to stand" if float(said[3]) > 0.01 else ""


def main():
    arguments = read_arguments(__doc__, bin="folder of the programs", cell="folder with module.xml", io_module="libiodispat.so",
                               visitor="the module of visitor.cpp")
    first = int(os.environ.get("INDUROP_CELL_SEED", random.randrange(1_000_000)))
    visits = int(os.environ.get("INDUROP_CELL_STOPS", "12"))
    failed = 0
    node = new_node(f"{arguments.bin}/indurop", "stops_")
    with tempfile.TemporaryDirectory() as folder:
        modules = configure(arguments.cell, arguments.io_module, arguments.visitor, folder)
        for seed in range(first, first + visits):
            presses, end = visit(seed)
            file = os.path.join(folder, "module.xml")
            with open(file, "w", encoding="utf-8") as out:
                out.write(modules.replace("PRESSES", presses))
            done = subprocess.run([f"{arguments.bin}/indurop", "run", file, "--sim", "--until", f"{end + WORK_S:.2f}s", "--node",
                                   node], capture_output=True, text=True, timeout=120, check=False)
            finding = wrong(done.stdout) or ("" if done.returncode == 0 else "it ended with an error")
            if finding:
                failed += 1
                print(f"visit {seed} ({presses}): {finding}\n{done.stdout}{done.stderr}")
    print(f"{visits} visits from seed {first} on, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
