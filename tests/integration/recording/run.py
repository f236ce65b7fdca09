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

SKIPPED = 77
HERE = pathlib.Path(__file__).parent
# What npm says where its registry cannot be reached.
NO_NETWORK = ("ENOTFOUND", "EAI_AGAIN", "ECONNREFUSED", "ECONNRESET", "ETIMEDOUT", "ENETUNREACH", "E401", "E403", "E503")


def skip(why):
    print(why)
    sys.exit(SKIPPED)


def judges(folder):
    """Node's packages of package-lock.json, in `folder`; fetched once."""
    lock = (HERE / "judges/package-lock.json").read_text()
    mark = folder / "fetched.json"
    if mark.is_file() and mark.read_text() == lock:
        return
    folder.mkdir(parents=True, exist_ok=True)
    for name in ("package.json", "package-lock.json"):
        shutil.copy(HERE / "judges" / name, folder)
    command = ["npm", "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--fetch-retries=1"]
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=240, check=False)
    except subprocess.TimeoutExpired:
        skip("the registry of npm does not answer")
    if done.returncode != 0:
        if any(word in done.stderr for word in NO_NETWORK):
            skip("the registry of npm cannot be reached")
        sys.exit(done.stderr)
    mark.write_text(lock)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True)
    parser.add_argument("--work", type=pathlib.Path, required=True)
    options = parser.parse_args()
    if not shutil.which("npm") or not shutil.which("node"):
        skip("there is no npm here")
    judges(options.work / "judges")
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
