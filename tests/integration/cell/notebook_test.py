#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The notebook of examples/notebook: each of its cells runs, one after the other, on a robot cell that runs, without Jupyter.
What it drew and computed is compared with what the cell is."""

import argparse
import os
import pathlib
import sys
import tempfile

import matplotlib
import nbformat

from cell_test import RunningCell, copy_configuration


def run(notebook):
    """Runs the code cells; returns the names that they left."""
    names = {}
    for number, one in enumerate(notebook.cells):
        if one.cell_type == "code":
            exec(compile(one.source, f"cell {number} of the notebook", "exec"), names)  # pylint: disable=exec-used
    return names


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for option in ("bin", "cell", "io-module", "package", "notebook"):
        parser.add_argument("--" + option, required=True)
    arguments = parser.parse_args()
    sys.path.insert(0, arguments.package)
    matplotlib.use("Agg")
    notebook = nbformat.read(arguments.notebook, as_version=4)
    nbformat.validate(notebook)
    assert all(not one.get("outputs") for one in notebook.cells), "a notebook is kept without outputs"
    name = f"notebook-{os.getpid()}"
    with tempfile.TemporaryDirectory(prefix="notebook_") as folder:
        os.environ.update(INDUROP_NODE=name, INDUROP_STATE_DIR=f"{folder}/state",
                          PATH=f"{arguments.bin}:{os.environ['PATH']}")
        copy_configuration(arguments.cell, arguments.io_module, folder)
        with RunningCell(arguments, folder, ["module.xml", "--node", name], name, name) as cell:
            cell.wait("the cell runs", lambda: cell.get(name, "EMERGENCY_STOP.bActive") is not None)
            os.chdir(folder)
            names = run(notebook)
            assert names["lost"] == 0 and len(names["rows"]) >= 500
            assert set(names["rows"].dtype.names) == {"@tick", "@time", "ROBOT_ARM.joint", "ROBOT_ARM.tool_speed"}
            assert "PLC_ROBOT::ROBOT_ARM" in names["variables"]["name"].values
            ticks = names["rows"]["@tick"].tolist()
            assert ticks == sorted(set(ticks)) and (names["seconds"][1:] > names["seconds"][:-1]).all()
            assert len(names["figure"].axes[0].lines) == 6 and len(names["axes"].lines) == 6
            assert names["moved"].max() > 0, "the arm moved"
            assert 0 < names["fastest"].max() < 1000
            assert pathlib.Path("cell.mcap").stat().st_size > 0
            os.chdir("/")


if __name__ == "__main__":
    main()
