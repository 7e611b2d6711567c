#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the measured set into a folder: one program of each kind that a shop runs, and random polylines; the same bytes on every run.

usage: shop_programs.py FOLDER

The set was fixed before anything was measured with it. Some programs are pairs that differ in one thing and so show what that costs: a surface
with and without noise, in lines of 0.05 and of 0.2 mm.
"""
import math
import random
import sys

import programs
from programs import HEAD, line, number, polyline

NOISE_MM = 0.001  # standard deviation of the height of a noisy surface
DIGITS = 4  # decimals of a coordinate, as most post-processors write them


def rounded(points):
    return [tuple(round(v, DIGITS) for v in p) for p in points]


def in_lines(curve, count, feed):
    """A curve (x, y, z) of a parameter from 0 to 1 as lines with equal steps of the parameter."""
    return polyline(rounded(curve(k / count) for k in range(count + 1)), feed)


def corner_square():
    return polyline([(20.0 * x, 20.0 * y, 0.0) for _ in range(3) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))] + [(0.0, 0.0, 0.0)], 6000)


def zigzag():
    return polyline([(2.0 * k, 5.0 * (k % 2), 0.0) for k in range(61)], 6000)


def hatch():
    points = []
    for row in range(60):
        ends = (0.0, 25.0) if row % 2 == 0 else (25.0, 0.0)
        points += [(x, 0.4 * row, 0.0) for x in ends]
    return polyline(points, 9000)


def engraving():
    """Strokes like those of letters, of short lines and arcs, between lifts of the tool."""
    chance = random.Random("engraving")
    out = [HEAD, "G64\nG0 X0. Y0. Z1.\n"]
    for letter in range(24):
        x, y = 4.0 * (letter % 8), 6.0 * (letter // 8)
        out.append(f"G0 X{number(x)} Y{number(y)}\nG1 Z-0.1 F600.\n")
        for stroke in range(4):
            if chance.random() < 0.4:
                r = round(chance.uniform(0.4, 1.2), 3)
                side = chance.choice((1, -1))
                out.append(f"G{chance.choice((2, 3))} X{number(x)} Y{number(y + side * 2 * r)} I0. J{number(side * r)} F1800.\n")
                y = round(y + side * 2 * r, 4)
            else:
                for _ in range(3):
                    x = round(x + chance.uniform(-0.8, 1.0), 3)
                    y = round(y + chance.uniform(-0.8, 0.8), 3)
                    out.append(line(1800 if stroke == 0 else None, X=x, Y=y))
        out.append("G0 Z1.\n")
    return "".join(out) + "M30\n"


def trochoid():
    def curve(share):
        angle = 2 * math.pi * 20 * share
        return 16 * share + 3 * math.cos(angle) - 3, 3 * math.sin(angle), 0.0
    return in_lines(curve, 2400, 6000)


def trochoid_arcs():
    """Full circles, each a step farther than the one before."""
    out = [HEAD, "G64\nG0 X0. Y0. Z0.\n"]
    for k in range(20):
        out.append(f"G3 X{number(0.8 * k)} Y0. I-3. J0." + (" F6000." if k == 0 else "") + "\n" + line(X=round(0.8 * (k + 1), 4), Y=0))
    return "".join(out) + "M30\n"


def adaptive():
    """Arcs that cut, and fast return moves that join them tangentially."""
    out = [HEAD, "G64\nG0 X0. Y0. Z0.\n"]
    for k in range(24):
        x = 1.2 * k
        out.append(f"G3 X{number(x)} Y20. I0. J10. F4800.\n" + f"G3 X{number(x - 1)} Y19. I0. J-1. F9000.\n")
        out.append(line(X=x - 1, Y=1) + f"G3 X{number(x)} Y0. I1. J0.\n" + line(X=x + 1.2, Y=0))
    return "".join(out) + "M30\n"


def helix_bore():
    out = [HEAD, "G64\n"]
    for hole in range(3):
        x = 25.0 * hole
        out.append(f"G0 X{number(x + 4)} Y0.\nG0 Z0.5\n")
        for turn in range(8):
            out.append(f"G3 X{number(x + 4)} Y0. Z{number(0.5 - 0.7 * (turn + 1))} I-4. J0. F3000.\n")
        out.append(f"G3 X{number(x + 4)} Y0. I-4. J0.\n" + line(X=x, Y=0) + "G0 Z5.\n")
    return "".join(out) + "M30\n"


def surface(step, noise):
    """Rows over soft waves, F8000."""
    chance = random.Random(f"surface {step}")
    points = []
    for row in range(6):
        count = round(40 / step)
        for k in range(count + 1):
            x, y = step * (k if row % 2 == 0 else count - k), 0.4 * row
            z = 1.5 * math.sin(0.35 * x + 0.2 * y) + 0.4 * math.sin(0.9 * x - 0.3 * y)
            points.append((x, y, z + chance.gauss(0, NOISE_MM) * noise))
    return polyline(rounded(points), 8000)


def arc_fitted():
    """An outline as a chain of arcs that touch, as a fitter makes it of a smooth curve; their ends are rounded."""
    def at(share):
        angle = 2 * math.pi * share
        r = 25 + 4 * math.cos(3 * angle) + 1.5 * math.sin(5 * angle)
        return complex(r * math.cos(angle), r * math.sin(angle))

    count = 72
    ends = [at(k / count) for k in range(count + 1)]
    out = [HEAD, f"G64\nG0 X{number(round(ends[0].real, DIGITS))} Y{number(round(ends[0].imag, DIGITS))} Z0.\n"]
    for k in range(count):
        a, b, middle = ends[k], ends[k + 1], at((k + 0.5) / count)
        a, b = (complex(round(p.real, DIGITS), round(p.imag, DIGITS)) for p in (a, b))
        u, v = b - a, middle - a
        cross = u.real * v.imag - u.imag * v.real
        if abs(cross) < 1e-4 * abs(u):
            out.append(line(5000, X=b.real, Y=b.imag))
            continue
        centre = (abs(u) ** 2 * v - abs(v) ** 2 * u) * 1j / (2 * cross) * -1
        radius = abs(centre)
        out.append(f"G{3 if cross < 0 else 2} X{number(b.real)} Y{number(b.imag)} R{number(round(radius, DIGITS))} F5000.\n")
    return "".join(out) + "M30\n"


def slivers():
    """Lines of some um between long ones."""
    chance = random.Random("slivers")
    points, x, y, heading = [(0.0, 0.0, 0.0)], 0.0, 0.0, 0.0
    for k in range(300):
        heading += chance.uniform(-0.15, 0.15)
        size = chance.uniform(1, 3) if k % 3 == 0 else chance.uniform(0.001, 0.01)
        x, y = x + size * math.cos(heading), y + size * math.sin(heading)
        points.append((x, y, 0.0))
    return polyline(rounded(points), 6000)


def drilling():
    return programs.drill(60, 1200)


def feed_per_line():
    chance = random.Random("feed per line")
    out = [HEAD, "G64\nG0 X0. Y0. Z0.\n"]
    for k in range(1, 601):
        angle = 0.02 * k
        out.append(line(round(chance.uniform(4000, 6000)), X=round(15 * math.cos(angle) - 15, DIGITS), Y=round(15 * math.sin(angle), DIGITS)))
    return "".join(out) + "M30\n"


def per_revolution():
    """G95: a facing cut and a contour in lines."""
    out = [HEAD, "G64\nG97 S3000 M3\nG0 X0. Y0. Z0.\nG95\n"]
    for k in range(1, 121):
        out.append(line(1.2 if k == 1 else None, X=round(0.5 * k, DIGITS), Y=round(4 * math.sin(0.12 * k), DIGITS)))
    return "".join(out) + "G94\nM5\nM30\n"


def compensated():
    """G41 round a plate with corners and arcs."""
    out = [HEAD, "G64\nG10 L10 P1 R3.\nG0 X-20. Y-20. Z0.\nG41 D1\n" + line(6000, X=0, Y=-10)]
    for _ in range(3):
        out.append(line(X=0, Y=30) + "G2 X10. Y40. I10. J0.\n" + line(X=50, Y=40) + line(X=60, Y=25) + line(X=60, Y=5) + "G2 X50. Y-5. I-10. J0.\n" +
                   line(X=30, Y=-5) + line(X=20, Y=2) + line(X=0, Y=0))
    return "".join(out) + line(X=0, Y=10) + "G40\n" + line(X=-20, Y=10) + "M30\n"


def reversals():
    """Back and forth along one line, in several steps and in one."""
    points, x = [(0.0, 0.0, 0.0)], 0.0
    for k in range(30):
        size = (25.0, 4.0, 0.5)[k % 3]
        for way in (size, -0.6 * size):
            x += way
            points.append((x, 0.0, 0.0))
    return polyline(rounded(points), 6000)


def circles():
    return programs.circles([30, 12, 5, 2, 1, 0.4], 6000)


PROGRAMS = {
    "corner_square": corner_square,
    "zigzag": zigzag,
    "hatch": hatch,
    "engraving": engraving,
    "trochoid": trochoid,
    "trochoid_arcs": trochoid_arcs,
    "adaptive": adaptive,
    "helix_bore": helix_bore,
    "surface_005": lambda: surface(0.05, 0),
    "surface_005_noise": lambda: surface(0.05, 1),
    "surface_02": lambda: surface(0.2, 0),
    "surface_02_noise": lambda: surface(0.2, 1),
    "arc_fitted": arc_fitted,
    "circles": circles,
    "slivers": slivers,
    "drilling": drilling,
    "feed_per_line": feed_per_line,
    "per_revolution": per_revolution,
    "compensated": compensated,
    "reversals": reversals,
}


def random_polyline(seed):
    """200 to 1,000 lines of 0.01 to 5 mm: headings by a random walk, gentle or wild."""
    draw = random.Random(f"polyline {seed}")
    shortest = 10 ** draw.uniform(-2, 0)
    longest = min(5.0, shortest * 10 ** draw.uniform(0, 1))
    count = max(200, min(1000, round(400 / (shortest + longest))))
    return programs.random_walk(7000 + seed, count, shortest, longest, draw.choice((1500, 4000, 9000)), sharpest=draw.choice((0.05, 0.2, 0.6, 2.0)))


for _seed in range(20):
    PROGRAMS[f"random_{_seed:02}"] = lambda seed=_seed: random_polyline(seed)


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__.split("\n\n")[1])
    print("\n".join(programs.write(sys.argv[1], PROGRAMS)))
