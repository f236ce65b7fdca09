#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Random PLC programs whose code is exchanged in random ticks: what they keep must be the same, tick by tick, as without
an exchange.

exchange.py --build DIR [--count N] [--seed S] [--ticks N]: 0 if all are equal. Programs that keep pointers say so and are
left out."""

import argparse
import os
import re
import subprocess
import sys
import tempfile

from driver import FLAGS, Failed, checked_call
from program import Program


def build_module(build, folder, name, programs):
    """The path of the .so, and the prefixes of the programs that keep what cannot be carried."""
    os.makedirs(folder, exist_ok=True)
    with open(os.path.join(folder, f"{name}.st"), "w", encoding="latin-1") as file:
        for program in programs:
            file.write("\n".join(program.text()) + "\n")
    checked_call([os.path.join(build, "bin/indurop"), "plc", "build", f"{name}.st", "--only-sources", "--quiet"], folder)
    with open(os.path.join(folder, f"{name}.cpp"), encoding="utf-8") as file:
        declared = re.search(r"iec::declare_kept\(items, (.*), to\);", file.read())
    missing = set(re.findall(r"\b(P\d+)\b", declared.group(1))) if declared else set()
    if missing:
        return None, missing
    checked_call([os.path.join(build, "bin/glb2idl"), "--out-dir", ".", f"{name}.glb"], folder)
    compiler = os.environ.get("CXX") or "g++"
    checked_call([compiler, *FLAGS, "-O0", "-fPIC", "-shared", "-fno-gnu-unique", f"-isystem{build}/include", "-isystem.",
                  f"{name}.cpp", "-o", f"{name}.so", f"-L{build}/lib", "-lindurop", f"-Wl,-rpath,{build}/lib"], folder)
    return os.path.join(folder, f"{name}.so"), missing


def run(build, module, ticks, seed):
    environment = dict(os.environ, INDUROP_NODE="plcrandom-none")
    done = subprocess.run([os.path.join(build, "tests/plc_exchanged"), module, str(ticks), str(seed)], capture_output=True,
                          text=True, env=environment, timeout=600)
    if done.returncode != 0:
        raise Failed(f"{module} ended with {done.returncode}: {done.stderr[:2000]}")
    return done.stdout.splitlines(), int(done.stderr.split()[-1])


def difference(build, module, ticks, seed):
    """What differs, in words; and the number of exchanges."""
    expected, _ = run(build, module, ticks, 0)
    found, exchanges = run(build, module, ticks, seed)
    for tick, (a, b) in enumerate(zip(expected, found)):
        if a != b:
            return f"seed {seed}: tick {tick} has {b}, expected {a}", exchanges
    return ("" if len(expected) == len(found) else f"seed {seed}: {len(found)} ticks instead of {len(expected)}"), exchanges


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--build", required=True)
    parser.add_argument("--count", type=int, default=int(os.environ.get("INDUROP_PLC_EXCHANGED", "60")))
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--ticks", type=int, default=300)
    parser.add_argument("--runs", type=int, default=20)
    parser.add_argument("--batch", type=int, default=8)
    options = parser.parse_args()
    build = os.path.abspath(options.build)
    programs = []
    for seed in range(options.seed, options.seed + options.count):
        one = Program(seed, seed)
        if one.ends() and not any(fault for fault, _ in one.scans()):
            programs.append(one)
    bad, exchanges, modules, whole = [], 0, 0, 0
    with tempfile.TemporaryDirectory() as scratch:
        _, missing = build_module(build, os.path.join(scratch, "all"), "all", programs)
        kept = [one for one in programs if one.prefix not in missing]
        for begin in range(0, len(kept), options.batch):
            batch = kept[begin:begin + options.batch]
            module, left = build_module(build, os.path.join(scratch, str(begin)), "batch", batch)
            if module is None:
                print(f"{left} keep pointers, which was not said before")
                return 1
            modules, whole = modules + 1, whole + len(batch)
            for seed in range(1, options.runs + 1):
                text, count = difference(build, module, options.ticks, seed)
                exchanges += count
                bad += [f"{', '.join(str(one.seed) for one in batch)}: {text}"] if text else []
    for text in bad[:10]:
        print(text)
    print(f"{whole} programs of {len(programs)} in {modules} modules, exchanged {exchanges} times, {len(bad)} wrong")
    return 1 if bad or whole == 0 or exchanges == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
