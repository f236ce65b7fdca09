#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""doors_test.py SCRIPT PROGRAMS PYTHON_PACKAGE: all doors of the robot cell are open at once, and each shows the same joint.
In a network of its own, for the ports of the cell."""

import os
import re
import subprocess
import sys

import demo_test

MISSING = "is not installed"


def number_in(line):
    return float(re.search(r"-?[0-9]+(\.[0-9]+)?(e-?[0-9]+)?(?=[^0-9.]*$)", line).group())


def main():
    demo_test.own_network()
    script, programs, package = sys.argv[1:]
    done = subprocess.run([script], capture_output=True, text=True, timeout=demo_test.PATIENCE * 2, check=False,
                          env={**os.environ, "PATH": f"{programs}:{os.environ['PATH']}", "PYTHONPATH": package})
    print(done.stdout, done.stderr)
    assert done.returncode == 0, done.returncode
    doors = dict(re.findall(r"^(\S.{20}\S| *\S.{21}) (\S.*)$", done.stdout, re.MULTILINE))
    doors = {name.strip(): shown for name, shown in doors.items()}
    assert doors["page"].startswith("http://127.0.0.1:")
    for name in ("HTTP", "/metrics"):  # the axis has 170 degrees to both sides
        assert -170 <= number_in(doors[name]) <= 170, doors[name]
    assert MISSING in doors["Python"] or re.fullmatch(r"\[(-?[0-9.]+(, )?){3}\]", doors["Python"]), doors["Python"]
    assert MISSING in doors["MQTT"] or "/ROBOT_ARM.joint" in doors["MQTT"], doors["MQTT"]
    assert MISSING in doors["MQTT"] or re.search(r"DDATA.*, [1-9][0-9]* bytes", doors["Sparkplug B"]), doors
    assert MISSING in doors["OPC UA"] or doors["OPC UA"].startswith("opc.tcp://127.0.0.1:"), doors["OPC UA"]
    assert re.search(r"[1-9][0-9]* messages", doors["recording (MCAP)"]), doors
    assert MISSING in doors["FMI"] or "FMI 2.0" in doors["FMI"], doors["FMI"]
    assert len(re.findall(r"lost tick", done.stdout)) == 2, "what it costs is shown before and after"


main()
