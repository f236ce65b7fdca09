# SPDX-License-Identifier: Apache-2.0
"""Where the bodies of an arm are, and how far two arms are from each other: the kinematics of a URDF file and distances of points
from boxes and cylinders, written again here without the robot task. All lengths in m."""

import xml.etree.ElementTree

import numpy

GRID = 0.012  # m between the points with which the surface of a body is covered


def numbers(text, count=3):
    return numpy.array([float(word) for word in text.split()] if text else [0.0] * count)


def frame(xyz, rpy):
    """A 4 x 4 matrix; angles in rad."""
    (cr, cp, cy), (sr, sp, sy) = numpy.cos(rpy), numpy.sin(rpy)
    matrix = numpy.eye(4)
    matrix[:3, :3] = [[cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr],
                      [sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr], [-sp, cp * sr, cp * cr]]
    matrix[:3, 3] = xyz
    return matrix


def origin(element):
    place = element.find("origin")
    if place is None:
        return numpy.eye(4)
    return frame(numbers(place.get("xyz")), numbers(place.get("rpy")))


def turns(axis, angles):
    """One matrix for each angle, about a unit vector (Rodrigues)."""
    x, y, z = axis
    cross = numpy.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angles = numpy.asarray(angles)[:, None, None]
    matrices = numpy.tile(numpy.eye(4), (len(angles), 1, 1))
    matrices[:, :3, :3] = numpy.eye(3) + numpy.sin(angles) * cross + (1 - numpy.cos(angles)) * (cross @ cross)
    return matrices


def rings(radius, half):
    """Points on a circle with the same distance on it, at some heights."""
    count = max(int(numpy.ceil(2 * numpy.pi * radius / GRID)), 1)
    heights = numpy.linspace(-half, half, int(numpy.ceil(2 * half / GRID)) + 1) if half else numpy.zeros(1)
    angle = numpy.linspace(0, 2 * numpy.pi, count, endpoint=False)
    turned, height = numpy.meshgrid(angle, heights)
    return numpy.stack([radius * numpy.cos(turned), radius * numpy.sin(turned), height], -1).reshape(-1, 3)


class Box:
    def __init__(self, size):
        self.half = numpy.asarray(size) / 2
        self.radius = numpy.linalg.norm(self.half)
        self.points = self.surface()

    def surface(self):
        lines = [numpy.linspace(-h, h, int(numpy.ceil(2 * h / GRID)) + 1) for h in self.half]
        points = numpy.stack(numpy.meshgrid(*lines), -1).reshape(-1, 3)
        return points[(numpy.abs(numpy.abs(points) - self.half) < 1e-9).any(axis=1)]

    def distance(self, points):
        return numpy.linalg.norm(numpy.maximum(numpy.abs(points) - self.half, 0), axis=-1)


class Cylinder:
    def __init__(self, radius, length):
        self.across, self.half = radius, length / 2
        self.radius = numpy.hypot(radius, self.half)
        self.points = self.surface()

    def surface(self):
        ends = [rings(r, 0) + [0, 0, z] for r in numpy.arange(self.across, -GRID, -GRID).clip(0) for z in (-self.half, self.half)]
        return numpy.concatenate([rings(self.across, self.half)] + ends)

    def distance(self, points):
        outside = numpy.maximum(numpy.hypot(points[..., 0], points[..., 1]) - self.across, 0)
        return numpy.hypot(outside, numpy.maximum(numpy.abs(points[..., 2]) - self.half, 0))


def solid_of(geometry):
    if (box := geometry.find("box")) is not None:
        return Box(numbers(box.get("size")))
    cylinder = geometry.find("cylinder")
    return Cylinder(float(cylinder.get("radius")), float(cylinder.get("length")))


class Arm:
    """`tool`: x y z x y z of the box of its tool (BODY), relative to the end of the arm."""

    def __init__(self, urdf, base, tool):
        root = xml.etree.ElementTree.parse(urdf).getroot()
        self.base = base
        self.joints = list(root.iter("joint"))  # in the order of the chain
        self.bodies = [(link.get("name"), origin(one), solid_of(one.find("geometry")))
                       for link in root.iter("link") for one in link.iter("collision")]
        low, high = numpy.minimum(tool[:3], tool[3:]), numpy.maximum(tool[:3], tool[3:])
        self.bodies.append((self.joints[-1].find("child").get("link"), frame((low + high) / 2, numpy.zeros(3)), Box(high - low)))

    def links(self, angles):
        """`angles`: rad, a row for each period. Returns the frames of the links by name, a matrix for each period."""
        at = numpy.tile(self.base, (len(angles), 1, 1))
        frames = {self.joints[0].find("parent").get("link"): at}
        axis = 0
        for joint in self.joints:
            at = at @ origin(joint)
            if joint.get("type") == "revolute":
                at = at @ turns(numbers(joint.find("axis").get("xyz")), angles[:, axis])
                axis += 1
            frames[joint.find("child").get("link")] = at
        return frames

    def places(self, angles):
        """The frames of the bodies, a matrix for each period."""
        frames = self.links(angles)
        return [frames[link] @ place for link, place, _ in self.bodies]


def nearest(one, other, angles_one, angles_other, within=0.05):
    """The least distance of two arms, `within` if they are never nearer. Points cover the surface of each body, so it may be too
    large by half the diagonal of their grid."""
    least = within
    places_one, places_other = one.places(angles_one), other.places(angles_other)
    for (_, _, a), at_a in zip(one.bodies, places_one):
        for (_, _, b), at_b in zip(other.bodies, places_other):
            apart = numpy.linalg.norm(at_a[:, :3, 3] - at_b[:, :3, 3], axis=1) - a.radius - b.radius
            for i in numpy.flatnonzero(apart < within):
                if apart[i] >= least:
                    continue
                from_a = numpy.linalg.inv(at_b[i]) @ at_a[i]  # to b
                for solid, points, to in ((b, a.points, from_a), (a, b.points, numpy.linalg.inv(from_a))):
                    least = min(least, solid.distance(points @ to[:3, :3].T + to[:3, 3]).min())
    return least
