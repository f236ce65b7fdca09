#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the chapter's modules and observes the real-time threads from outside: how often they allocated (a preloaded
counter), which system calls they made (strace), and how often a page was missing to them. Allowed are the sleep of the
tick thread, the wake-ups it gives and the waits of the bands. The first two are compared between a short and a long run,
so what threads do when they begin and end cancels out."""

import argparse
import collections
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "support"))
from nodes import new_node  # noqa: E402

# Periods of 1 ms: strace stops a thread at each call, which 100 us would not survive.
XML = """<root>
  <module><filename>{modules}/cntr3.so</filename><moduletype>thread</moduletype><operationtype>periodic</operationtype>
    <period>1ms</period><priority>1</priority></module>
  <module><filename>{modules}/cntr2.so</filename><moduletype>thread</moduletype><operationtype>periodic</operationtype>
    <period>1ms</period><priority>2</priority></module>
  <module><filename>{modules}/cntr1.so</filename><moduletype>thread</moduletype><operationtype>periodic</operationtype>
    <period>5ms</period><priority>3</priority></module>
  <module><filename>{modules}/output.so</filename><moduletype>thread</moduletype><operationtype>periodic</operationtype>
    <period>5ms</period><priority>4</priority></module>
  <module><filename>{modules}/event1.so</filename><moduletype>thread</moduletype><operationtype>sporadic</operationtype>
    <deadline>1ms</deadline><priority>1</priority></module>
  <module><filename>{io}</filename><moduletype>thread</moduletype><operationtype>periodic</operationtype>
    <period>1ms</period><priority>5</priority>
    <property><value name="config">ioconfig.xml</value></property></module>
  <module><filename>{io_user}</filename><moduletype>thread</moduletype><operationtype>periodic</operationtype>
    <period>1ms</period><priority>6</priority></module>
</root>
"""
# No program listens at the address: failures occur in the thread of the device, none in the tick.
IO_CONFIG = """<ioconfig>
  <device name="gone" driver="modbus_tcp" address="127.0.0.1:1" retry="1ms" retry_most="5ms" quality="link_good"
          errors="link_errors">
    <input variable="pressure" at="input:0" bad="7"/><input variable="speeds[1]" at="input:1"/>
    <output variable="O0" at="coil:0"/><output variable="speeds[0]" at="holding:0" type="int32"/>
  </device>
  <device name="axis" driver="cia402" in="AXIS1_IN" out="AXIS1_OUT" noise="2"/>
  <device name="recorded" driver="csv" file="values.csv" end="loop">
    <input variable="I0" quality="I0_quality"/><input variable="level"/>
  </device>
</ioconfig>
"""
VALUES = "time_ms,I0,level\n0,1,0.5\n3,2,\n5,3,1.5\n"
ALLOWED = {"clock_nanosleep", "futex"}
# A thread that begins may or may not extend the heap, depending on which threads began before it: once, not per tick. The
# calls of the allocator itself are counted exactly.
ONCE = {"brk": 2, "mmap": 2, "munmap": 2, "mprotect": 2, "madvise": 1}
SHORT, LONG = 200, 600  # ms = ticks


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(77)


def run(command, environment):
    done = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=60)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)} ended with {done.returncode}:\n{done.stdout}{done.stderr}")


def node_command(arguments, xml, milliseconds):
    return [os.path.join(arguments.bin, "indurop-node"), xml, "--node", arguments.node, "-q", "--duration",
            f"{milliseconds}ms"]


def role(thread):
    """The thread's name without its core: another node may take the core of the previous run."""
    return re.sub(r"^(irp-tick)-\d+$", r"\1", thread)


def allocations(arguments, xml, folder, milliseconds):
    report = os.path.join(folder, f"allocations{milliseconds}")
    run(node_command(arguments, xml, milliseconds),
        dict(os.environ, LD_PRELOAD=arguments.counter, INDUROP_ALLOCATION_REPORT=report, INDUROP_STATE_DIR=folder))
    counts = collections.Counter()
    with open(report, encoding="utf-8") as lines:
        for line in lines:
            name, calls = line.split()
            counts[role(name)] += int(calls)
    if "end" not in counts:
        sys.exit("the allocation counter wrote no complete report")
    del counts["end"]
    return counts


def system_calls(arguments, xml, folder, milliseconds):
    log = os.path.join(folder, f"strace{milliseconds}")
    command = ["strace", "-f", "-Y", "-qq", "-o", log] + node_command(arguments, xml, milliseconds)
    run(command, dict(os.environ, INDUROP_STATE_DIR=folder))
    counts = collections.Counter()
    with open(log, encoding="utf-8", errors="replace") as lines:
        for line in lines:
            # A call that was interrupted by another thread's line is counted where it begins.
            match = re.match(r"\d+<(irp-(?:tick|band|events)[^>]*)> (\w+)\(", line)
            if match:
                counts[role(match[1]), match[2]] += 1
    return counts


def page_faults(arguments, xml, folder, milliseconds):
    """Page faults of each real-time thread after the first tenth of the run; None if memory could not be locked."""
    node = subprocess.Popen(node_command(arguments, xml, milliseconds), stdout=subprocess.DEVNULL,
                            stderr=subprocess.PIPE, text=True, env=dict(os.environ, INDUROP_STATE_DIR=folder))
    seen = collections.defaultdict(list)
    locked = False
    while node.poll() is None:
        try:
            with open(f"/proc/{node.pid}/status", encoding="utf-8") as status:
                locked = locked or re.search(r"VmLck:\s+[1-9]", status.read()) is not None
            for task in os.listdir(f"/proc/{node.pid}/task"):
                with open(f"/proc/{node.pid}/task/{task}/stat", encoding="utf-8") as stat:
                    name, rest = stat.read().split("(", 1)[1].rsplit(")", 1)
                if re.match(r"irp-(tick|band|events)", name):
                    fields = rest.split()
                    seen[role(name)].append(int(fields[7]) + int(fields[9]))  # minor and major
        except (FileNotFoundError, ProcessLookupError):
            pass  # it ends
    if node.returncode != 0:
        sys.exit(f"the node ended with {node.returncode}:\n{node.stderr.read()}")
    if not any(name.startswith("irp-tick") and len(counts) >= 10 for name, counts in seen.items()):
        sys.exit("no tick thread was seen: its page faults could not be counted")
    return {name: counts[-1] - counts[len(counts) // 10] for name, counts in seen.items()} if locked else None


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--bin", required=True)
    parser.add_argument("--modules", required=True)
    parser.add_argument("--counter", required=True)
    parser.add_argument("--io", required=True, help="libiodispat.so")
    parser.add_argument("--io-user", required=True, help="a module that uses the variables of I/O")
    arguments = parser.parse_args()
    arguments.node = new_node(os.path.join(arguments.bin, "indurop"), "tickpath")
    with open(os.path.join(arguments.bin, "indurop-node"), "rb") as program:
        if b"__asan_init" in program.read() or b"__tsan_init" in open(program.name, "rb").read():
            skip("a sanitizer has its own allocator and system calls")
    folder = tempfile.mkdtemp(prefix="indurop-tick-path-")
    failed = False
    try:
        xml = os.path.join(folder, "module.xml")
        with open(xml, "w", encoding="utf-8") as file:
            file.write(XML.format(modules=arguments.modules, io=arguments.io, io_user=arguments.io_user))
        for name, text in ("ioconfig.xml", IO_CONFIG), ("values.csv", VALUES):
            with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                file.write(text)
        short, long = (allocations(arguments, xml, folder, ms) for ms in (SHORT, LONG))
        threads = {name for name in list(short) + list(long) if re.match(r"irp-(tick|band|events)", name)}
        for name in sorted(threads):
            print(f"{name}: {short[name]} allocator calls in {SHORT} ticks, {long[name]} in {LONG}")
            if long[name] > short[name]:
                print(f"  FAILED: {name} allocates while it runs")
                failed = True
        faults = page_faults(arguments, xml, folder, 3 * LONG)
        if faults is None:
            print("memory cannot be locked here: page faults were not counted")
        for name, count in sorted((faults or {}).items()):
            print(f"{name}: {count} page faults in about {3 * LONG} ticks")
            if count > 0:
                print(f"  FAILED: {name} touches memory that is not there")
                failed = True
        if shutil.which("strace") is None or subprocess.run(["strace", "-qq", "-o", "/dev/null", "true"], check=False).returncode != 0:
            if failed:
                sys.exit(1)
            skip("strace may not trace here; allocations were counted and are fine")
        short, long = (system_calls(arguments, xml, folder, ms) for ms in (SHORT, LONG))
        if not any(name.startswith("irp-tick") for name, _ in long):
            sys.exit("strace saw no tick thread: the test would not have noticed anything")
        for (name, call), count in sorted(long.items()):
            grown = count - short[name, call]
            print(f"{name}: {call} {count} ({grown:+d} against the short run)")
            if call not in ALLOWED and grown > ONCE.get(call, 0):
                print(f"  FAILED: {name} calls {call} while it runs")
                failed = True
            # Of the long run alone: ticks that the short one misses on a busy machine are no growth.
            if call == "clock_nanosleep" and count > LONG * 1.05 + 5:
                print(f"  FAILED: {name} sleeps more than once per tick")
                failed = True
    finally:
        shutil.rmtree(folder)
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
