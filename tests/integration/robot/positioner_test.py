#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The example of a positioner in virtual time. The judge is the arm's table of Denavit and Hartenberg, written again here: from the
recorded set points of seven drives it computes where the torch is on the disc and in the world."""

import argparse
import csv
import pathlib
import subprocess
import sys
import tempfile

import numpy

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from nodes import new_node  # noqa: E402

# a (m), alpha, d (m) of the six axes; the last one ends at the flange, from which the torch is 150 mm long.
ARM = [(0, numpy.pi / 2, 0.1273), (-0.612, 0, 0), (-0.5723, 0, 0), (0, numpy.pi / 2, 0.163941), (0, -numpy.pi / 2, 0.1157),
       (0, 0, 0.0922 + 0.15)]
BASE, DISC = (0, 0, 0), (0.9, 0, 0.15)
RADIUS, HEIGHT, SPEED = 200, 5, 100  # mm, mm/s
PERIOD = 0.004  # s


def turned(axis, angle):
    c, s = numpy.cos(angle), numpy.sin(angle)
    rows = {"z": [[c, -s, 0], [s, c, 0], [0, 0, 1]], "x": [[1, 0, 0], [0, c, -s], [0, s, c]]}
    matrix = numpy.eye(4)
    matrix[:3, :3] = rows[axis]
    return matrix


def shifted(*vector):
    matrix = numpy.eye(4)
    matrix[:3, 3] = vector
    return matrix


def torch_at(angles):
    """In the world, m."""
    at = shifted(*BASE)
    for angle, (a, alpha, d) in zip(angles, ARM):
        at = at @ turned("z", angle) @ shifted(a, 0, d) @ turned("x", alpha)
    return at


def set_points(options, folder):
    """Angles of the seven axes in each period, rad, and whether the torch is on."""
    for file in ("module.xml", "ioconfig.xml", "cell.urdf", "rim.job"):
        text = (options.example / file).read_text().replace("./libiodispat.so", options.io_module)
        (folder / file).write_text(text.replace("<filename>./", f"<filename>{options.example}/"))
    indurop = options.bin / "indurop"
    subprocess.run([indurop, "run", "module.xml", "--sim", "--until", "36s", "--record", "run.mcap", "-q", "--node",
                    new_node(indurop, "positioner-")], check=True, cwd=folder, stdout=subprocess.DEVNULL)
    subprocess.run([indurop, "recording", "export", "run.mcap", "--csv", "run.csv", "-q"], check=True, cwd=folder,
                   stdout=subprocess.DEVNULL)
    with open(folder / "run.csv", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["PLC_ROBOT::ROBOT_ARM.command[0]"]]
    seen = {}
    for row in rows:  # the last ones of each period
        angles = [float(row[f"PLC_ROBOT::ROBOT_ARM.command[{axis}]"]) for axis in range(7)]
        seen[int(row["time_ns"]) // 4_000_000] = (numpy.radians(angles), row["PLC_ROBOT::O8"] not in ("", "0", "false"))
    return [seen[period] for period in sorted(seen)]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", type=pathlib.Path, required=True)
    parser.add_argument("--example", type=pathlib.Path, required=True)
    parser.add_argument("--io-module", required=True)
    options = parser.parse_args()
    options.bin, options.example = options.bin.resolve(), options.example.resolve()
    with tempfile.TemporaryDirectory() as folder:
        points = set_points(options, pathlib.Path(folder))
    first = next(i for i, (_, on) in enumerate(points) if on)
    end = next(i for i in range(first, len(points)) if not points[i][1])
    world = [torch_at(angles)[:3, 3] * 1000 for angles, _ in points[first:end]]
    disc = [(turned("z", -angles[6]) @ numpy.append(at / 1000 - DISC, 1))[:3] * 1000
            for (angles, _), at in zip(points[first:end], world)]
    off = max(abs(numpy.hypot(x, y) - RADIUS) for x, y, _ in disc)
    raised = max(abs(z - HEIGHT) for _, _, z in disc)
    speeds = sorted(numpy.linalg.norm(b - a) / PERIOD for a, b in zip(disc, disc[1:]))
    around = sum(numpy.linalg.norm(b - a) for a, b in zip(disc, disc[1:]))
    stands = max(numpy.linalg.norm(at - world[0]) for at in world)
    turned_by = numpy.degrees(points[end - 1][0][6] - points[first][0][6])
    print(f"{around:.1f} mm on the disc, {off:.4f} mm off the circle, {raised:.4f} mm off its height; median {speeds[len(speeds) // 2]:.2f} "
          f"mm/s, at most {speeds[-1]:.2f}; the table turned by {turned_by:.2f} degrees, the torch by {stands:.4f} mm in the world")
    assert abs(around - 2 * numpy.pi * RADIUS) < 1, around
    assert off < 0.05 and raised < 0.01, (off, raised)
    assert abs(speeds[len(speeds) // 2] - SPEED) < 0.1 and speeds[-1] < 1.001 * SPEED, speeds[-1]
    assert abs(turned_by + 360) < 1, turned_by
    assert stands < 0.2, stands
    after = [angles for angles, _ in points[end:]]
    arm = [numpy.abs(b - a)[:6].max() for a, b in zip(after, after[1:])]
    table = [abs(b[6] - a[6]) for a, b in zip(after, after[1:])]
    alone = sum(turn for moved, turn in zip(arm, table) if moved < 1e-12)
    assert alone > 0.9 * 2 * numpy.pi, "the table returns while the arm stands"


if __name__ == "__main__":
    main()
