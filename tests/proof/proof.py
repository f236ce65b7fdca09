#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Real time, proven: schedules run in a machine with counted time (guest.py), idle and loaded, compared with cyclictest.
Fails if a tick is lost, a module overruns or misses its deadline, a tick is later than cyclictest's latest + 1 us, or
something takes 2 % (an exchange: 12 %) more instructions than instructions.json says (INDUROP_UPDATE_GOLDEN=1 writes that
file again). An EtherCAT bus with 33 drives at a pair of network interfaces is counted, too."""

import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

import guest

MORE_THAN_CYCLICTEST_NS = 1000
# Two boards share the one processor: a tick waits for that of the other one, two switches and its modules.
OTHER_BOARD_NS = 10_000
MORE_INSTRUCTIONS = 1.02
# An exchange includes switches between the node and the slaves. Guests of the same build differ in all of their exchanges: two of
# 55 took 2 % and 9 % more than the others.
MORE_OF_EXCHANGE = 1.12
WALL_PER_SECOND = 30  # of counted time, at most, on a busy host
HOST_IS_BUSY = 1800  # seconds to boot: a limit for a guest that hangs, not for one that is slow
SKIPPED = 77
EXPECTED = pathlib.Path(__file__).with_name("instructions.json")
AXES = 33  # of the example ethercat_33
AXES_SECONDS = 8  # of counted time until all of them have moved for a while; an instruction of theirs takes 1 ns, too
ACCESSES = ("read_scalar", "write_scalar", "read_24", "write_24", "read_256", "write_256")

MODULE = ("<module><name>{name}</name><filename>./{file}</filename><moduletype>thread</moduletype><operationtype>periodic"
          "</operationtype><period>{period}</period><priority>{priority}</priority></module>")

# What runs, by the name of its row: files of the examples and the configuration made of them.
SCHEDULES = {
    "chapter's Figure 1, 100 us": "chapter/module.xml",
    "robot cell, 1 ms": "cell/cell.xml",
    "256 modules, 1 ms": "many.xml",
    "modules with <wcet>, 1 ms": "bounded.xml",
    "two boards, 1 ms": "two/plant.xml",
}
# Name, file, period, offset and longest execution in us: by the instructions of 1000 accesses, and an interrupt on top.
BOUNDED = (("first", "write_256", 1000, 0, 250), ("second", "read_256", 2000, 0, 60),
           ("third", "write_24", 2000, 1000, 220), ("fourth", "write_256", 4000, 0, 250))


def schedule(modules):
    return "<root>" + "".join(MODULE.format(name=name, file=file, period=period, priority=i)
                              for i, (name, file, period) in enumerate(modules)) + "</root>\n"


def bounded():
    return "<root>" + "".join(
        MODULE.format(name=name, file=f"counted_{file}.so", period=f"{period}us", priority=priority).replace(
            "</module>", f"<offset>{offset}us</offset><wcet>{wcet}us</wcet></module>")
        for priority, (name, file, period, offset, wcet) in enumerate(BOUNDED)) + "</root>\n"


def above_bound(program, config, report):
    """Modules whose runs took longer than the plan says they can."""
    plan = json.loads(subprocess.run([program, "plan", config, "-o", "json"], capture_output=True, text=True, check=True).stdout)
    bounds = {times["module"]: times["worst_response_ns"] for times in plan["times"]}
    return [f"{module['name']} took {module['response_ns']['max']} ns, its bound is {bounds[module['name']]} ns"
            for module in report["modules"] if module["response_ns"]["max"] > bounds[module["name"]]]


def exchange_script():
    """The shortest of 500 exchanges with all axes, by the log of the node. Slaves answer whatever else happens."""
    return ["cd /test/axes; insmod /drivers/veth.ko", "ip link add ec33a type veth; ip link set ec33a up; ip link set veth0 up",
            f"chrt -f 40 indurop-ecsim veth0 {'drive ' * AXES}& slaves=$!",
            f"indurop-node module.xml --node axes -q --duration {AXES_SECONDS}s & axes=$!",
            f"sleep {AXES_SECONDS - 1}; indurop get --node axes AXES::state.enabled >/out/enabled",
            "indurop log --node axes -n 500 -o json libiodispat >/out/exchange",
            "wait $axes; kill $slaves"]


def script(seconds):
    """One boot: cyclictest and each schedule, idle and with work in the background."""
    lines = ["set -u", "ip route add 224.0.0.0/4 dev lo 2>/dev/null", "uname -r >/out/kernel"]
    for load in ("idle", "loaded"):
        if load == "loaded":
            lines += exchange_script()
            lines += ["(while :; do dd if=/dev/zero of=/tmp/x bs=64k count=64; done) 2>/dev/null &",
                      "(while :; do ls -R /proc; done) >/dev/null 2>&1 &",
                      "(while :; do :; done) &"]
        lines.append(f"cyclictest -q -m -N -p 90 -i 100 -D {seconds} >/out/cyclictest.{load}")
        for number, (name, file) in enumerate(SCHEDULES.items()):
            folder, _, base = file.rpartition("/")
            lines.append(f"cd /test/{folder}")
            if base == "plant.xml":
                for board in ("sensor", "control"):
                    lines.append(f"indurop-node {base} --board {board} -q --duration {seconds}s "
                                 f"--report /out/{number}.{load}.{board} & pids=\"${{pids:-}} $!\"")
                lines.append('wait $pids; pids=')
            else:
                if folder == "cell":
                    lines.append("(sleep 0.5; indurop set --node proof CELL::tour true) &")
                lines.append(f"indurop-node {base} --node proof -q --duration {seconds}s --report /out/{number}.{load}.proof")
    lines.append("cd /test; indurop-node counted.xml --node counted -q --tape 0 --duration 500ms --report /out/counted")
    return "\n".join(lines) + "\n"


def fill(machine, arguments):
    examples = pathlib.Path(arguments.examples)
    for folder, to in (("chapter", "chapter"), ("robot_cell", "cell"), ("two_boards", "two"), ("ethercat_33", "axes")):
        for file in sorted((examples / folder).iterdir()):
            if file.is_file() and file.suffix in (".so", ".exe", ".xml", ".job", ".urdf"):
                machine.add(file, f"{to}/{file.name}")
    cell = machine.root / "test/cell"
    (cell / "cell.xml").write_text((cell / "module.xml").read_text().replace("<period>10000000<", "<period>1000000<"))
    axes = machine.root / "test/axes/module.xml"
    axes.write_text(axes.read_text().replace("<period>1000000<", "<period>4000000<"))
    machine.add_drivers()
    for module in ("idle", "nothing", *ACCESSES):
        machine.add(pathlib.Path(arguments.modules) / f"counted_{module}.so")
    (machine.root / "test/many.xml").write_text(
        schedule([(f"m{i}", "counted_idle.so", "1ms") for i in range(256)]))
    (machine.root / "test/bounded.xml").write_text(bounded())
    (machine.root / "test/counted.xml").write_text(
        schedule([("nothing", "counted_nothing.so", "1ms")] + [(name, f"counted_{name}.so", "1ms") for name in ACCESSES]))


def cyclictest_max(text):
    found = re.search(r"Max:\s*(\d+)", text)
    return int(found.group(1)) if found else None


def judge(name, load, report, limit):
    """A row of the table, and what is wrong with it."""
    modules = report["modules"]
    sums = {what: sum(module[what] for module in modules) for what in ("overruns", "deadline_misses", "faults")}
    late = report["tick_lateness_ns"]
    row = (name, load, report["ticks"], report["lost_ticks"], sums["overruns"], sums["deadline_misses"], late["p50"],
           late["p99"], late["max"], limit)
    wrong = [f"{count} {what}" for what, count in (("lost ticks", report["lost_ticks"]), *sums.items()) if count]
    if not report["rt"]["fifo"] or not report["rt"]["preempt_rt"]:
        wrong.append(f"no real time: {report['rt']['why']}")
    if late["max"] > limit + MORE_THAN_CYCLICTEST_NS + (OTHER_BOARD_NS if name.startswith("two boards") else 0):
        wrong.append(f"latest tick {late['max']} ns, cyclictest's {limit} ns")
    return row, [f"{name}, {load}: {text}" for text in wrong]


def counts(files):
    """Instructions by what they are spent on. The least is what no interrupt disturbed."""
    modules = {module["name"]: module for module in json.loads(files["counted"])["modules"]}
    nothing = modules["nothing"]["exec_ns"]["min"]
    found = {f"1000 x {name.replace('_', ' ')}": modules[name]["exec_ns"]["min"] - nothing for name in ACCESSES}
    many = json.loads(files[f"{list(SCHEDULES).index('256 modules, 1 ms')}.idle.proof"])["modules"]
    found["256 modules in one tick"] = many[255]["latency_ns"]["min"] - many[0]["latency_ns"]["min"]
    found["tick, up to its first module"] = many[0]["latency_ns"]["min"]
    for number in (0, 1):
        for module in json.loads(files[f"{number}.idle.proof"])["modules"]:
            # What the robot does depends on how long it runs.
            if module["type"] == "thread" and module["operation"] == "periodic" and module["name"] != "Robot":
                found[f"shortest run of {module['name']}"] = module["exec_ns"]["min"]
    found[f"exchange with {AXES} drives, with the system's part"] = min(
        run["exec_ns"] for run in json.loads(files["exchange"])["runs"])
    return found


def compare(found):
    if os.environ.get("INDUROP_UPDATE_GOLDEN"):
        EXPECTED.write_text(json.dumps(found, indent=2) + "\n")
    expected = json.loads(EXPECTED.read_text())
    wrong = []
    for what, count in expected.items():
        limit = count * (MORE_OF_EXCHANGE if what.startswith("exchange") else MORE_INSTRUCTIONS)
        if found.get(what, 1 << 60) > limit:
            wrong.append(f"{what}: {found.get(what)} instructions, {count} before")
    return wrong + [f"{what} is not in {EXPECTED.name}" for what in found if what not in expected]


def table(rows):
    head = ("what", "load", "ticks", "lost", "overruns", "misses", "p50 ns", "p99 ns", "max ns", "cyclictest max ns")
    lines = [head, ("---",) * len(head), *rows]
    return "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines)


def run(arguments):
    programs = [os.path.join(arguments.bin, name) for name in ("indurop-node", "indurop", "indurop-ecsim")]
    with guest.Guest([*programs, shutil.which("cyclictest"), shutil.which("chrt")]) as machine:
        fill(machine, arguments)
        seconds = arguments.time
        files, console = machine.run(script(seconds), HOST_IS_BUSY + WALL_PER_SECOND * 2 * seconds * (1 + len(SCHEDULES)))
        if "counted" not in files:
            print(console[-4000:], files.get("log", ""), sep="\n")
            return ["the guest did not come to the end of its script"]
        if files["enabled"].strip() != str(AXES) or ": 0 came back late, 0 were lost" not in files["log"]:
            print(files["log"])
            return [f"not all of {AXES} drives were exchanged in each tick: the shortest exchange is none"]
        rows, wrong = [], []
        for load in ("idle", "loaded"):
            limit = cyclictest_max(files[f"cyclictest.{load}"])
            for number, name in enumerate(SCHEDULES):
                boards = sorted(key.split(".")[2] for key in files if key.startswith(f"{number}.{load}."))
                if not boards:
                    wrong.append(f"{name}, {load}: did not run")
                for board in boards:
                    report = json.loads(files[f"{number}.{load}.{board}"])
                    row, more = judge(name, load, report, limit)
                    rows.append(row)
                    wrong += more
                    if SCHEDULES[name] == "bounded.xml":
                        wrong += above_bound(programs[1], machine.root / "test/bounded.xml", report)
    found = counts(files)
    text = (f"Kernel {files['kernel'].strip()} in QEMU, 1 ns per instruction, {seconds} s each:\n\n{table(rows)}\n\n"
            + "| instructions | |\n|---|---|\n" + "\n".join(f"| {what} | {count} |" for what, count in found.items()) + "\n")
    print(text)
    if arguments.report:
        pathlib.Path(arguments.report).write_text(text)
    if wrong:
        print(files["log"])
    return wrong + compare(found)


def main():
    line = argparse.ArgumentParser(description=__doc__)
    line.add_argument("--bin", required=True)
    line.add_argument("--modules", required=True)
    line.add_argument("--examples", required=True)
    line.add_argument("--time", type=int, default=int(os.environ.get("INDUROP_PROOF_SECONDS", "10")),
                      help="seconds of counted time for each schedule, idle and loaded")
    line.add_argument("--report", help="also write the tables into this file")
    line.add_argument("--needed", action="store_true", help="fail where there can be no guest")
    arguments = line.parse_args()
    if guest.missing():
        print(f"skipped: {guest.missing()}")
        return 1 if arguments.needed else SKIPPED
    wrong = run(arguments)
    for text in wrong:
        print(f"proof: error: {text}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
