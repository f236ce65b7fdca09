#!/usr/bin/env python3
"""A user's way with a maker's URDF file: `indurop check` warns of its mesh and names a command; the command writes a file
of which check has nothing to say; errors are reported with their places, all at once, and nothing is written."""

import argparse
import json
import math
import pathlib
import shutil
import struct
import subprocess
import tempfile
import xml.etree.ElementTree as xml

CYLINDER = '<cylinder radius="0.055" length="0.18"/>'
MESH = '<mesh filename="package://cell_arm/meshes/forearm.stl" scale="0.001 0.001 0.001"/>'


def write_tube(file, radius, length, corners=48):
    """A cylinder along z as a binary STL file, in mm."""
    ring = [(radius * math.cos(2 * math.pi * i / corners), radius * math.sin(2 * math.pi * i / corners))
            for i in range(corners)]
    triangles = []
    for (ax, ay), (bx, by) in zip(ring, ring[1:] + ring[:1]):
        low_a, low_b, high_a, high_b = (ax, ay, -length / 2), (bx, by, -length / 2), (ax, ay, length / 2), (bx, by, length / 2)
        triangles += [(low_a, low_b, high_a), (low_b, high_b, high_a),
                      (low_b, low_a, (0, 0, -length / 2)), (high_a, high_b, (0, 0, length / 2))]
    with open(file, "wb") as out:
        out.write(b" " * 80 + struct.pack("<I", len(triangles)))
        for triangle in triangles:
            out.write(struct.pack("<12fH", 0, 0, 0, *[value for corner in triangle for value in corner], 0))


def expect(condition, what):
    if not condition:
        raise SystemExit(f"failed: {what}")


class Cell:
    def __init__(self, options, folder):
        self.bin = pathlib.Path(options.bin).resolve()
        self.folder = folder
        shutil.copytree(options.cell, folder, ignore=shutil.ignore_patterns("CMakeFiles", "*.cmake"), dirs_exist_ok=True)
        self.urdf = folder / "robot.urdf"
        text = self.urdf.read_text()
        expect(text.count(CYLINDER) == 1, "the forearm of the cell's arm is another one: change this test")
        self.urdf.write_text(text.replace(CYLINDER, MESH))
        (folder / "cell_arm" / "meshes").mkdir(parents=True)
        write_tube(folder / "cell_arm" / "meshes" / "forearm.stl", 55, 180)

    def run(self, program, *arguments):
        return subprocess.run([self.bin / program, *arguments], cwd=self.folder, capture_output=True, text=True)

    def check(self):
        done = self.run("indurop", "check", "module.xml")
        expect(done.returncode == 0, f"check ends with {done.returncode}:\n{done.stdout}{done.stderr}")
        return done.stdout + done.stderr


def solids_of(urdf, link):
    return [list(geometry)[0] for geometry in xml.parse(urdf).findall(f"./link[@name='{link}']/collision/geometry")]


def mends_what_check_warns_of(cell):
    said = cell.check()
    expect("'indurop-solids robot.urdf NEW.urdf'" in said.replace(str(cell.folder) + "/", ""),
           f"check does not name the command:\n{said}")
    done = cell.run("indurop-solids", "robot.urdf", "new.urdf", "--svg", "new.svg", "-o", "json")
    expect(done.returncode == 0, f"indurop-solids ends with {done.returncode}: {done.stderr}")
    [mesh] = json.loads(done.stdout)["meshes"]
    expect(mesh["link"] == "forearm" and mesh["triangles"] == 192 and mesh["beyond_mm"] < 1, f"it reports {mesh}")
    [solid] = solids_of(cell.folder / "new.urdf", "forearm")
    size = [float(solid.get(name)) for name in ("radius", "length")]
    expect(solid.tag == "cylinder" and 0.055 <= size[0] < 0.0552 and 0.18 <= size[1] < 0.1803,
           f"the forearm became {solid.tag} {solid.attrib}")
    expect(xml.parse(cell.folder / "new.svg").getroot().tag.endswith("svg"), "the picture is none")
    for link in ("base", "shoulder", "flange"):
        before, after = (xml.tostring(solids_of(cell.folder / name, link)[0]) for name in ("robot.urdf", "new.urdf"))
        expect(before == after, f"link {link} changed")
    (cell.folder / "new.urdf").rename(cell.urdf)
    said = cell.check()
    expect("indurop-solids" not in said and "forearm - " in said, f"check still warns, or keeps nothing apart:\n{said}")


def tells_all_mistakes_and_writes_nothing(cell):
    text = cell.urdf.read_text()
    for name in ("base", "wrist"):
        at = text.index("<geometry>", text.index(f'<link name="{name}"'))
        text = text[:at] + f'<geometry><mesh filename="{name}.stl"/></geometry></collision><collision>' + text[at:]
    (cell.folder / "wrong.urdf").write_text(text)
    (cell.folder / "wrist.stl").write_text("solid nothing")
    done = cell.run("indurop-solids", "wrong.urdf", "never.urdf", "--svg", "never.svg")
    expect(done.returncode == 4, f"it ends with {done.returncode}: {done.stderr}")
    lines = done.stderr.splitlines()
    expect(len(lines) == 2, f"two errors are reported in {done.stderr}")
    expect(lines[0].startswith("wrong.urdf:5:21: error: link 'base': mesh 'base.stl' cannot be read: there is no "), lines[0])
    expect(lines[1].startswith("wrong.urdf:") and "link 'wrist': mesh 'wrist.stl' cannot be read: " in lines[1], lines[1])
    expect(not list(cell.folder.glob("never.*")), "a file was written")
    for arguments, code in ((["gone.urdf"], 1), ([], 2), (["robot.urdf", "--most", "0"], 2),
                            (["robot.urdf", "--package", "x"], 2), (["robot.urdf", "no/folder/new.urdf"], 1)):
        done = cell.run("indurop-solids", *arguments)
        expect(done.returncode == code and done.stderr, f"{arguments} ends with {done.returncode}: {done.stderr}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", required=True)
    parser.add_argument("--cell", required=True)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        cell = Cell(options, pathlib.Path(folder))
        mends_what_check_warns_of(cell)
        tells_all_mistakes_and_writes_nothing(cell)


main()
