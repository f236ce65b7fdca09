#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Lines in a square with two logarithmic axes, as SVG text."""

import math

WIDTH, HEIGHT, LEFT, TOP = 560, 320, 70, 40
COLOURS = ("#1b6ca8", "#d1495b", "#66a182", "#edae49", "#8d5a97", "#444444")


def scale(values, begin, end):
    """From a positive value to a place; whole decades."""
    low = math.floor(math.log10(min(values)))
    high = max(low + 1, math.ceil(math.log10(max(values))))
    return lambda value: begin + (math.log10(value) - low) / (high - low) * (end - begin), range(low, high + 1)


def number(power):
    return f"{10 ** power:g}"


def lines(title, x_name, data, knee=None):
    """data: by name of a line its values by x, all above 0. knee: an x that is marked."""
    data = {name: {x: y for x, y in points.items() if y > 0} for name, points in data.items()}
    x_at, x_powers = scale([x for points in data.values() for x in points], LEFT, WIDTH - 150)
    y_at, y_powers = scale([y for points in data.values() for y in points.values()], HEIGHT - 45, TOP)
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" font-family="sans-serif" font-size="12">',
             f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>', f'<text x="{LEFT}" y="22" font-size="14">{title}</text>']
    for power in x_powers:
        at = x_at(10 ** power)
        parts.append(f'<path d="M{at:.0f} {TOP}V{HEIGHT - 45}" stroke="#ddd"/>'
                     f'<text x="{at:.0f}" y="{HEIGHT - 28}" text-anchor="middle">{number(power)}</text>')
    for power in y_powers:
        at = y_at(10 ** power)
        parts.append(f'<path d="M{LEFT} {at:.0f}H{WIDTH - 150}" stroke="#ddd"/>'
                     f'<text x="{LEFT - 6}" y="{at + 4:.0f}" text-anchor="end">{number(power)}</text>')
    parts.append(f'<text x="{(LEFT + WIDTH - 150) / 2:.0f}" y="{HEIGHT - 10}" text-anchor="middle">{x_name}</text>')
    if knee:
        parts.append(f'<path d="M{x_at(knee):.0f} {TOP}V{HEIGHT - 45}" stroke="#888" stroke-dasharray="4 3"/>'
                     f'<text x="{x_at(knee):.0f}" y="{TOP - 4}" text-anchor="middle" fill="#666">knee: {knee}</text>')
    for index, (name, points) in enumerate(data.items()):
        colour = COLOURS[index % len(COLOURS)]
        way = " ".join(f"{x_at(x):.1f},{y_at(points[x]):.1f}" for x in sorted(points))
        parts.append(f'<polyline points="{way}" fill="none" stroke="{colour}" stroke-width="2"/>')
        parts += [f'<circle cx="{x_at(x):.1f}" cy="{y_at(y):.1f}" r="3" fill="{colour}"/>' for x, y in points.items()]
        parts.append(f'<text x="{WIDTH - 140}" y="{TOP + 12 + 18 * index}" fill="{colour}">{name}</text>')
    return "\n".join(parts) + "\n</svg>\n"


def write(path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
