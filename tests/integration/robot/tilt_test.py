#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A table that tilts and turns, in a node with virtual time. The judge is a product of rotations and shifts, written again here
from the drawing of arm and table: from the recorded set points of eight drives it computes where the torch is on the part."""

import argparse
import csv
import pathlib
import subprocess
import sys
import tempfile

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from nodes import new_node  # noqa: E402

PERIOD = 0.004  # s
CORNERS = [(-80, -60, 5), (80, -60, 5), (80, 60, 5), (-80, -60, 5)]  # mm
ENDS = [(0, 0), (15, 40), (-10, -30), (-10, 20)]  # deg of tilt and turn in the corners
SPEED = 60  # mm/s
START = [0, 25, -20, 0, 60, 0, 0, 0]  # deg
MODULE = """<root>
  {modules}
</root>
"""
ONE = """<module><filename>{file}</filename><moduletype>thread</moduletype><operationtype>periodic</operationtype>
  <period>4000000</period><priority>{priority}</priority><property>{properties}</property></module>
"""


def turned(axis, degrees):
    c, s = numpy.cos(numpy.radians(degrees)), numpy.sin(numpy.radians(degrees))
    rows = {"x": [[1, 0, 0], [0, c, -s], [0, s, c]], "y": [[c, 0, s], [0, 1, 0], [-s, 0, c]],
            "z": [[c, -s, 0], [s, c, 0], [0, 0, 1]]}
    matrix = numpy.eye(4)
    matrix[:3, :3] = rows[axis]
    return matrix


def shifted(x, y, z):
    matrix = numpy.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def torch_on_part(q):
    """mm, in the frame of the part."""
    arm = (shifted(0, 0, 400) @ turned("z", q[0]) @ shifted(100, 0, 50) @ turned("y", q[1]) @ shifted(0, 0, 600)
           @ turned("y", q[2]) @ shifted(200, 0, 100) @ turned("x", q[3]) @ shifted(400, 0, 0) @ turned("y", q[4])
           @ shifted(100, 0, 0) @ turned("x", q[5]) @ turned("y", 90) @ shifted(0, 0, 60))
    part = shifted(900, 0, 500) @ turned("y", q[6]) @ shifted(0, 0, 100) @ turned("z", q[7])
    return (numpy.linalg.inv(part) @ arm)[:3, 3]


def write_cell(options, folder):
    def module(file, priority, **properties):
        lines = "".join(f'<value name="{name}">{value}</value>' for name, value in properties.items())
        return ONE.format(file=file, priority=priority, properties=lines)

    modules = (module(options.modules / "tilt_welder.so", 3) + module(options.modules / "tilt_robot.so", 2, urdf=options.urdf,
                                                                      jobs=options.job)
               + module(options.io_module, 1, config="ioconfig.xml"))
    (folder / "module.xml").write_text(MODULE.format(modules=modules))
    drives = "".join(f'<device name="axis{axis}" driver="cia402" in="PLC_ROBOT::AXIS{axis}_IN" out="PLC_ROBOT::AXIS{axis}_OUT" '
                     f'inertia="1" torque="400" speed="500" start="{start}"/>' for axis, start in enumerate(START, 1))
    (folder / "ioconfig.xml").write_text(f"<ioconfig>{drives}</ioconfig>")


def set_points(options, folder):
    """Angles of the eight axes in each period, deg, and whether the torch is on."""
    write_cell(options, folder)
    indurop = options.bin / "indurop"
    subprocess.run([indurop, "run", "module.xml", "--sim", "--until", "30s", "--record", "run.mcap", "-q", "--node",
                    new_node(indurop, "tilt-")], check=True, cwd=folder, stdout=subprocess.DEVNULL)
    subprocess.run([indurop, "recording", "export", "run.mcap", "--csv", "run.csv", "-q"], check=True, cwd=folder,
                   stdout=subprocess.DEVNULL)
    seen = {}
    with open(folder / "run.csv", encoding="utf-8") as file:
        for row in csv.DictReader(file):  # the last row of each period counts
            if row["PLC_ROBOT::ROBOT_ARM.command[0]"]:
                angles = [float(row[f"PLC_ROBOT::ROBOT_ARM.command[{axis}]"]) for axis in range(8)]
                seen[int(row["time_ns"]) // 4_000_000] = (numpy.array(angles), row["PLC_ROBOT::O8"] not in ("", "0", "false"))
    return [seen[period] for period in sorted(seen)]


def away_from(side, angles, at):
    """How far the torch is from a side of the triangle, mm, and the table from where it has to be there, deg."""
    start, end = (numpy.array(CORNERS[side + i], float) for i in (0, 1))
    part = numpy.clip(numpy.dot(at - start, end - start) / numpy.dot(end - start, end - start), 0, 1)
    table = numpy.array(ENDS[side]) + part * (numpy.array(ENDS[side + 1]) - ENDS[side])
    return numpy.linalg.norm(at - start - part * (end - start)), max(abs(angles[6:] - table))


def check_sides(points, first, end):
    """Returns the greatest of both along all sides, one after the other, and the greatest speed, mm/s."""
    places = [torch_on_part(angles) for angles, _ in points[first:end]]
    side, off, table = 0, 0, 0
    for (angles, _), at in zip(points[first:end], places):
        present = away_from(side, angles, at)
        following = away_from(side + 1, angles, at) if side < 2 else present
        side, present = (side + 1, following) if sum(following) < sum(present) else (side, present)
        off, table = max(off, present[0]), max(table, present[1])
    assert side == 2, side
    return off, table, max(numpy.linalg.norm(b - a) / PERIOD for a, b in zip(places, places[1:]))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    for name in ("bin", "modules", "urdf", "job"):
        parser.add_argument("--" + name, type=pathlib.Path, required=True)
    parser.add_argument("--io-module", required=True)
    options = parser.parse_args()
    for name in ("bin", "modules", "urdf", "job"):
        setattr(options, name, getattr(options, name).resolve())
    with tempfile.TemporaryDirectory() as folder:
        points = set_points(options, pathlib.Path(folder))
    first = next(i for i, (_, on) in enumerate(points) if on)
    end = next(i for i in range(first, len(points)) if not points[i][1])
    off, table, fastest = check_sides(points, first, end)
    print(f"{end - first} periods; {off:.6f} mm off the sides, table within {table:.6f} degrees, at most {fastest:.3f} mm/s")
    assert off < 1e-5 and table < 1e-5, (off, table)
    assert 0.98 * SPEED < fastest < 1.001 * SPEED, fastest
    last = points[-1][0]
    assert abs(last[6]) < 1e-6 and abs(last[7] + 360) < 1e-6, last
    alone = [b[0] - a[0] for a, b in zip(points[end:], points[end + 1:]) if abs(b[0] - a[0])[6:].max() > 0]
    assert abs(sum(turn[7] for turn in alone) + 380) < 1e-6 and max(abs(turn[:6]).max() for turn in alone) < 1e-12


if __name__ == "__main__":
    main()
