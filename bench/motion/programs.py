#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the programs of the motion benchmark into a folder: the same bytes on every run.

usage: programs.py FOLDER

They are plain G code in mm; every number has a decimal point. The axes stand at X0 Y0 Z0 before the first block.
"""
import math
import os
import random
import sys

HEAD = "G17 G21 G90 G94 G40 G49\n"


def number(value):
    text = f"{value:.5f}".rstrip("0")
    return "0." if text in ("-0.", "0.") else text


def line(feed=None, **words):
    return "G1 " + " ".join(axis + number(value) for axis, value in words.items()) + (f" F{number(feed)}" if feed else "") + "\n"


def polyline(points, feed, mode="G64"):
    """G0 to the first point (x, y, z), then G1 through the others."""
    out = [HEAD, mode + "\n", "G0 X{} Y{} Z{}\n".format(*(number(v) for v in points[0]))]
    for k, (x, y, z) in enumerate(points[1:]):
        out.append(line(feed if k == 0 else None, X=x, Y=y, Z=z))
    return "".join(out) + "M30\n"


def flat(points):
    return [(x, y, 0.0) for x, y in points]


def square(side, feed, mode):
    return polyline(flat([(0, 0), (side, 0), (side, side), (0, side), (0, 0)]), feed, mode)


def regular(corners, radius, feed, skip=1):
    return polyline(flat([(radius * math.cos(2 * math.pi * k * skip / corners), radius * math.sin(2 * math.pi * k * skip / corners))
                          for k in range(corners + 1)]), feed)


def teeth(pitch, height, count, feed):
    return polyline(flat([(k * pitch / 2, height * (k % 2)) for k in range(2 * count + 1)]), feed)


def staircase(step, count, feed):
    return polyline(flat([((k + 1) // 2 * step, k // 2 * step) for k in range(2 * count + 1)]), feed)


def spiral(points, turns, radius, feed, three_d=0.0):
    out = []
    for k in range(points + 1):
        share = k / points
        r, angle = 2.0 + share * (radius - 2.0), 2 * math.pi * turns * share
        out.append((r * math.cos(angle), r * math.sin(angle), -three_d * share))
    return polyline(out, feed)


def dense(curve, length, step, feed):
    """A curve (x, y, z) of a parameter from 0 to 1 in straight pieces of `step` mm."""
    count = round(length / step)
    return polyline([curve(k / count) for k in range(count + 1)], feed)


def surface(rows, columns, pitch, feed, height):
    """Rows back and forth over a wavy surface."""
    out = []
    for row in range(rows):
        y = row * 0.5
        xs = [k * pitch for k in range(columns + 1)]
        for x in xs if row % 2 == 0 else reversed(xs):
            out.append((x, y, height * math.sin(0.55 * x) * math.cos(0.9 * y) + 0.12 * height * math.sin(2.3 * x + y)))
    return polyline(out, feed)


def random_walk(seed, count, shortest, longest, feed, three_d=True, sharpest=math.pi):
    chance = random.Random(seed)
    at, heading, out = [0.0, 0.0, 0.0], 0.0, [(0.0, 0.0, 0.0)]
    for _ in range(count):
        heading += chance.uniform(-sharpest, sharpest)
        size = math.exp(chance.uniform(math.log(shortest), math.log(longest)))
        rise = chance.uniform(-0.4, 0.4) if three_d else 0.0
        at = [at[0] + size * math.cos(heading), at[1] + size * math.sin(heading), at[2] + size * rise]
        out.append(tuple(round(v, 4) for v in at))
    return polyline(out, feed)


def slot(length, radius, laps, feed):
    """Straight lines and half circles that touch them."""
    out = [HEAD, "G64\n", "G0 X0. Y0. Z0.\n"]
    for lap in range(laps):
        out.append(line(feed if lap == 0 else None, X=length, Y=0))
        out.append(f"G3 X{number(length)} Y{number(2 * radius)} I0. J{number(radius)}\n")
        out.append(line(X=0, Y=2 * radius))
        out.append(f"G3 X0. Y0. I0. J{number(-radius)}\n")
    return "".join(out) + "M30\n"


def rounded(width, height, radius, feed):
    """A rectangle with quarter circles."""
    r = number(radius)
    return (HEAD + f"G64\nG0 X{r} Y0. Z0.\n" + line(feed, X=width - radius, Y=0) +
            f"G3 X{number(width)} Y{r} I0. J{r}\n" + line(Y=height - radius) + f"G3 X{number(width - radius)} Y{number(height)} I-{r} J0.\n" +
            line(X=radius) + f"G3 X0. Y{number(height - radius)} I0. J-{r}\n" + line(Y=radius) + f"G3 X{r} Y0. I{r} J0.\nM30\n")


def waves_of_arcs(radius, count, feed):
    """Half circles left and right, joined without a line: the curvature changes its sign at speed."""
    out = [HEAD, "G64\nG0 X0. Y0. Z0.\n"]
    for k in range(count):
        out.append(f"G{2 + k % 2} X{number(2 * radius * (k + 1))} Y0. I{number(radius)} J0." + (f" F{number(feed)}" if k == 0 else "") + "\n")
    return "".join(out) + "M30\n"


def corner_arcs(feed):
    """Lines and arcs that meet at an angle."""
    return (HEAD + "G64\nG0 X0. Y0. Z0.\n" + line(feed, X=20, Y=0) + "G2 X40. Y0. I10. J0.\n" + line(X=45, Y=15) +
            "G3 X25. Y35. I-20. J0.\n" + line(X=0, Y=35) + "G2 X0. Y0. I-5. J-17.5\nM30\n")


def circles(radii, feed):
    out = [HEAD, "G64\n", "G0 X0. Y0. Z0.\n"]
    for k, radius in enumerate(radii):
        out.append(f"G0 X{number(radius)} Y0.\nG{2 + k % 2} X{number(radius)} Y0. I{number(-radius)} J0. F{number(feed)}\n")
    return "".join(out) + "M30\n"


def helix(radius, pitch, turns, feed):
    out = [HEAD, "G64\n", f"G0 X{number(radius)} Y0. Z0.\n"]
    for k in range(turns):
        out.append(f"G3 X{number(radius)} Y0. Z{number(-pitch * (k + 1))} I{number(-radius)} J0." + (f" F{number(feed)}" if k == 0 else "") + "\n")
    return "".join(out) + "M30\n"


def vertical_arcs(feed):
    """Arcs in ZX and YZ."""
    return (HEAD + "G64\nG0 X0. Y0. Z0.\n" + line(feed, X=10, Y=0, Z=0) + "G18\nG2 X20. Z-10. I0. K-10.\n" + line(X=20, Y=0, Z=-20) + line(Y=5) +
            "G19\nG2 Y15. Z-10. J10. K0.\n" + line(X=20, Y=30, Z=-10) + "G17\nM30\n")


def drill(holes, feed):
    out = [HEAD, "G64\n"]
    for k in range(holes):
        out.append(f"G0 X{number(12.5 * (k % 4))} Y{number(9.0 * (k // 4))}\nG0 Z-2.\nG1 Z-5. F{number(feed)}\nG0 Z0.\n")
    return "".join(out) + "M30\n"


def mixed_stops(feed):
    """Exact stops among corners that are passed, and a dwell."""
    return (HEAD + "G64\nG0 X0. Y0. Z0.\n" + line(feed, X=30, Y=0) + line(X=30, Y=10) + "G9 " + line(X=0, Y=10) + line(X=0, Y=20) + "G61\n" +
            line(X=30, Y=20) + line(X=30, Y=30) + "G64\n" + line(X=10, Y=30) + "G4 X0.2\n" + line(X=10, Y=40) + line(X=30, Y=40) + "M30\n")


def flower(share):
    angle = 2 * math.pi * share
    r = 12 + 3 * math.cos(5 * angle)
    return r * math.cos(angle), r * math.sin(angle), 0.8 * math.sin(3 * angle)


def circle_5(share):
    return 5 * math.cos(2 * math.pi * share), 5 * math.sin(2 * math.pi * share), 0.0


PROGRAMS = {
    "square_50": lambda: square(50, 3000, "G64"),
    "square_50_stop": lambda: square(50, 3000, "G61"),
    "square_4_fast": lambda: square(4, 12000, "G64"),
    "hexagon_20": lambda: regular(6, 20, 6000),
    "star_25": lambda: regular(5, 25, 6000, 2),
    "polygon_72": lambda: regular(72, 20, 6000),
    "teeth_10": lambda: teeth(10, 8, 10, 6000),
    "teeth_1": lambda: teeth(1, 0.7, 60, 4000),
    "staircase_05": lambda: staircase(0.5, 60, 4000),
    "spiral_1500": lambda: spiral(1500, 12, 40, 5000),
    "cone_800": lambda: spiral(800, 8, 25, 6000, 15),
    "surface_02": lambda: surface(12, 150, 0.2, 6000, 1.8),
    "surface_1": lambda: surface(10, 40, 1.0, 9000, 2.5),
    "flower_10um": lambda: dense(flower, 100, 0.01, 6000),
    "flower_1um": lambda: dense(flower, 100, 0.001, 6000),
    "circle_1um": lambda: dense(circle_5, 10 * math.pi, 0.001, 6000),
    "slot_30_6": lambda: slot(30, 6, 3, 6000),
    "rounded_60_3": lambda: rounded(60, 40, 3, 8000),
    "waves_of_arcs": lambda: waves_of_arcs(6, 10, 6000),
    "corner_arcs": lambda: corner_arcs(6000),
    "circles": lambda: circles([30, 8, 1.5, 0.4], 6000),
    "helix": lambda: helix(12, 3, 5, 6000),
    "vertical_arcs": lambda: vertical_arcs(5000),
    "drill": lambda: drill(12, 1500),
    "mixed_stops": lambda: mixed_stops(6000),
    "random_long": lambda: random_walk(11, 60, 2, 40, 9000),
    "random_short": lambda: random_walk(12, 400, 0.05, 3, 6000),
    "random_smooth": lambda: random_walk(13, 800, 0.1, 0.6, 8000, sharpest=0.25),
}


def write(folder, chosen=None):
    """Writes all programs, or those of the other set `chosen`; returns their paths in the order of the table."""
    os.makedirs(folder, exist_ok=True)
    out = []
    for name, text in (PROGRAMS if chosen is None else chosen).items():
        path = os.path.join(folder, name + ".nc")
        with open(path, "w", encoding="ascii") as file:
            file.write(text())
        out.append(path)
    return out


def write_random(folder, count):
    """Writes short random walks of lines, from a few um to some mm long, with smooth and sharp turns, slow and fast; returns their paths."""
    os.makedirs(folder, exist_ok=True)
    out = []
    for seed in range(count):
        draw = random.Random(f"lines {seed}")
        shortest = 10 ** draw.uniform(-2.5, 0.5)
        walk = random_walk(1000 + seed, draw.randrange(6, 60), shortest, shortest * 10 ** draw.uniform(0, 1), draw.choice((2000, 6000, 12000)),
                           sharpest=draw.choice((0.05, 0.3, 1.0, 3.0)))
        path = os.path.join(folder, f"lines_{seed}.nc")
        with open(path, "w", encoding="ascii") as file:
            file.write(walk)
        out.append(path)
    return out


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__.split("\n\n")[1])
    print("\n".join(write(sys.argv[1])))
