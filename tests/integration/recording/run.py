#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Recordings of random types and values: do independent readers (npm: @mcap/core, @foxglove/omgidl-*) read what was put in,
and does our reader read what an independent writer wrote? INDUROP_RECORDING_SEEDS says how many recordings, 4 without it."""

import argparse
import os
import pathlib
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from nodes import new_node  # noqa: E402
from npm_packages import fetch, skip  # noqa: E402

HERE = pathlib.Path(__file__).parent


def judge_parts(options):
    """What indurop makes of a node's recording."""
    folder = options.work / "parts"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    modules = "".join(
        f"<module><filename>{options.modules}/{name}.so</filename><name>{name}</name><moduletype>thread</moduletype>"
        f"<operationtype>periodic</operationtype><period>{period}</period><priority>{priority}</priority></module>"
        for name, period, priority in (("counter", "1ms", 1), ("walker", "2ms", 2)))
    (folder / "module.xml").write_text(f"<root>{modules}</root>")

    def indurop(*words):
        subprocess.run([options.indurop, *map(str, words)], check=True, cwd=folder, stdout=subprocess.DEVNULL)

    run = folder / "run.mcap"
    indurop("run", "module.xml", "--sim", "--until", "1s", "--record", run, "-q", "--node", new_node(options.indurop, "judged-"))
    indurop("recording", "cut", run, "-o", folder / "cut.mcap", "-q")
    indurop("recording", "cut", run, "--from", "400.5ms", "--to", "600.5ms", "-o", folder / "part.mcap", "-q")
    indurop("recording", "join", run, "-o", folder / "joined.mcap", "-q")
    subprocess.run(["node", HERE / "judge_parts.mjs", options.work / "judges", folder], check=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True)
    parser.add_argument("--indurop", type=pathlib.Path, required=True)
    parser.add_argument("--modules", type=pathlib.Path, required=True)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    options = parser.parse_args()
    if not shutil.which("npm") or not shutil.which("node"):
        skip("there is no npm here")
    fetch(HERE / "judges", options.work / "judges")
    judge_parts(options)
    runs = options.work / "runs"
    shutil.rmtree(runs, ignore_errors=True)
    for seed in range(1, 1 + int(os.environ.get("INDUROP_RECORDING_SEEDS", "4"))):
        folder = runs / str(seed)
        folder.mkdir(parents=True)
        subprocess.run([options.program, "write", folder, str(seed)], check=True)
        subprocess.run(["node", HERE / "judge.mjs", options.work / "judges", folder], check=True)
        for foreign in sorted(folder.glob("foreign_*.mcap")):
            read = subprocess.run([options.program, "read", foreign], check=True, capture_output=True, text=True).stdout
            if read != foreign.with_suffix(".txt").read_text():
                sys.exit(f"{foreign}: we read something else than was written:\n{read}")


if __name__ == "__main__":
    main()
