#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""One compensated contour, written in several ways, has to be one path.

Random contours of lines with chamfers and roundings, in all three planes, are compensated by contour_paths.cpp (see there) as they stand, and

  by angles   lines written by one coordinate and ,A (M700 13.8), pairs of lines by their angles alone, and at the end a line that an arc touches (13.9)
  by codes    under G68, G51.1 and G51, against the same contour whose words have been turned, mirrored and scaled here. Scaling leaves the tool as large
              as it is (13.19), a mirror has it on the other side (12.4.8).

Both have to end in the same alarm or to go through the same points, to what the six digits of the words leave.

NC_SEEDS=n   how many (default 400, 60 under a sanitizer); NC_FIRST_SEED=n   the first of them; NC_SHOW=1   prints the programs that differ
"""
import math
import os
import random
import subprocess
import sys

AXES = {"G17": "XY", "G18": "ZX", "G19": "YZ"}
DIGITS = 1e-4  # mm: a last digit of a word, lengthened by the sharpest angle between two lines
LEAST_PATHS = 0.4  # share of the contours that must not end in an alarm


def run_all(programs):
    """Alarm and moves (start and end in X Y Z, and the angle of an arc) of each program."""
    text = "".join("\n".join(["!1229/bit2 0", "!CONTOUR_CHECK 0", "G17 G90 G21 G94 G69 G50 G40 G0 X0 Y0 Z0", *blocks, "M30", "%", ""]) for blocks in programs)
    tool = os.path.join(os.environ.get("NC_BINARY_DIR", "build/release"), "bin", "contour_paths")
    results, alarm, moves = [], None, []
    for line in subprocess.run([tool], input=text, stdout=subprocess.PIPE, check=True, text=True).stdout.splitlines():
        kind, *words = line.split()
        if kind == "a":
            alarm = words[1]
        elif kind == "m":
            numbers = list(map(float, words[1:]))
            moves.append((numbers[:3], numbers[3:6], numbers[8] if len(numbers) > 6 else 0))
        else:
            results.append((alarm, [m for m in moves[:1] if not any(m[0])] + moves[1:]))  # without the way back from where the program before ended
            alarm, moves = None, []
    assert len(results) == len(programs), "an answer for each program"
    return results


def word(value):
    return f"{value:.6f}"


class Contour:
    """Points of lines, and the corner between each line and the next one."""

    def __init__(self, random_):
        heading, self.points = random_.uniform(0, 360), [(0.0, 0.0)]
        for _ in range(random_.randint(3, 9)):
            heading += random_.choice([random_.uniform(-95, 95), 90, -90, 0, 45, -45, random_.uniform(-40, 40)])
            length, (x, y) = random_.choice([random_.uniform(3, 30), random_.uniform(3, 30), 4]), self.points[-1]
            self.points.append((round(x + length * math.cos(math.radians(heading)), 6), round(y + length * math.sin(math.radians(heading)), 6)))
        lines = len(self.points) - 1
        self.corners = [random_.choice([None, ("R", random_.uniform(0.05, 0.5)), ("C", random_.uniform(0.05, 0.5))]) for _ in range(lines - 1)] + [None]
        self.plane, self.side, self.radius = random_.choice(list(AXES)), random_.choice([41, 42]), random_.choice([0.3, 1.0, 1.7])

    def angle(self, line):
        (x0, y0), (x1, y1) = self.points[line:line + 2]
        return math.degrees(math.atan2(y1 - y0, x1 - x0))

    def place(self, point):
        a, b = AXES[self.plane]
        return f"{a}{word(point[0])} {b}{word(point[1])}"

    def corner(self, line):
        return f" ,{self.corners[line][0]}{word(self.corners[line][1])}" if self.corners[line] else ""

    def lines(self):
        return [f"G1 {self.place(self.points[i + 1])}{self.corner(i)}" for i in range(len(self.corners))]

    def lines_by_angle(self, chosen):
        """The chosen lines by the coordinate along which they are longer, and their angle."""
        blocks = self.lines()
        for i in chosen:
            (x0, y0), (x1, y1) = self.points[i:i + 2]
            along = 0 if abs(x1 - x0) > abs(y1 - y0) else 1
            blocks[i] = f"G1 {AXES[self.plane][along]}{word(self.points[i + 1][along])} ,A{self.angle(i):.9f}{self.corner(i)}"
        return blocks

    def lines_by_pairs(self, random_):
        """Pairs of lines whose meeting point is not written. Beside one there is no corner (docs/decisions.md, 13.7)."""
        pairs, i = [], 0
        while i + 1 < len(self.corners):
            is_pair = abs(math.sin(math.radians(self.angle(i + 1) - self.angle(i)))) > 0.1 and random_.random() < 0.7
            if is_pair:
                pairs.append(i)
            i += 2 if is_pair else 1
        for i in pairs:
            self.corners[max(i - 1, 0)] = self.corners[i] = self.corners[i + 1] = None
        blocks = self.lines()
        for i in pairs:
            blocks[i] = f"G1 A{self.angle(i):.9f}"
            blocks[i + 1] = f"G1 {self.place(self.points[i + 2])} A{self.angle(i + 1):.9f}"
        return blocks

    def arc_behind(self, random_):
        """A line and an arc that it touches: its two blocks with and without the point of contact, and the end of the arc."""
        angle, length, radius, sense, sweep = random_.uniform(-180, 180), random_.uniform(3, 20), random_.uniform(3, 20), random_.choice([1, -1]), random_.uniform(10, 85)
        along = (math.cos(math.radians(angle)), math.sin(math.radians(angle)))
        contact = tuple(p + length * u for p, u in zip(self.points[-1], along))
        center = (contact[0] - sense * radius * along[1], contact[1] + sense * radius * along[0])
        end_angle = math.atan2(contact[1] - center[1], contact[0] - center[0]) + sense * math.radians(sweep)
        end = (center[0] + radius * math.cos(end_angle), center[1] + radius * math.sin(end_angle))
        arc = f"G{3 if sense > 0 else 2} {self.place(end)} R{word(radius)}"
        return [f"G1 {self.place(contact)}", arc], [f"G1 A{angle:.9f}", arc], end

    def program(self, lines, end, before=(), after=()):
        """With a way in and out; `before` and `after` put a code around all of it."""
        (x, y), at = self.points[0], self.place
        return [f"{self.plane} G10 L10 P1 R{word(self.radius)}", *before, f"G0 {at((x - 5, y - 7))}", f"G{self.side} D1 G1 {at(self.points[0])} F1000", *lines,
                f"G40 G1 {at((end[0] + 3, end[1] + 8))}", *after]

    def moved(self, way, scale=1, mirrored=False):
        """The same contour with its words moved; also the whole program then, whose ways in and out move with it."""
        other = object.__new__(Contour)
        other.points, other.plane, other.radius = [way(p) for p in self.points], self.plane, self.radius
        other.corners = [c and (c[0], c[1] * scale) for c in self.corners]
        other.side = 83 - self.side if mirrored else self.side
        (x, y), (u, v) = self.points[0], self.points[-1]
        ways = way((x - 5, y - 7)), way((u + 3, v + 8))
        program = other.program(other.lines(), other.points[-1])
        program[1], program[-1] = f"G0 {self.place(ways[0])}", f"G40 G1 {self.place(ways[1])}"
        return program


def pairs_of(seed):
    """Name and two programs each, which have to be the same."""
    random_ = random.Random(seed)
    contour = Contour(random_)
    a, b = AXES[contour.plane]
    turn, scale = random_.choice([30, 90, -45, random_.uniform(-180, 180)]), random_.choice([2, 0.5, 1.25])
    c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    x, y = random_.choice([(0, 0), (7, -3)])
    codes = {"G68": ([f"G68 {a}0 {b}0 R{turn:.9f}"], ["G69"], contour.moved(lambda p: (p[0] * c - p[1] * s, p[0] * s + p[1] * c))),
             "G51.1": ([f"G51.1 {a}0"], [f"G50.1 {a}0"], contour.moved(lambda p: (-p[0], p[1]), mirrored=True)),
             "G51": ([f"G51 {a}{word(x)} {b}{word(y)} P{scale:.3f}"], ["G50"], contour.moved(lambda p: (x + scale * (p[0] - x), y + scale * (p[1] - y)), scale))}
    chosen, end = [i for i in range(len(contour.corners)) if random_.random() < 0.5], contour.points[-1]
    for name, (before, after, moved) in codes.items():
        yield name, contour.program(contour.lines(), end, before, after), moved
    for name, (before, after, _) in {"": ((), (), None), **codes}.items():
        yield f"{name} ,A", contour.program(contour.lines(), end, before, after), contour.program(contour.lines_by_angle(chosen), end, before, after)
    by_pairs = contour.lines_by_pairs(random_)
    written, unwritten, end = contour.arc_behind(random_)
    for name, (before, after, _) in {"": ((), (), None), **codes}.items():
        yield f"{name} 13.9", contour.program(contour.lines() + written, end, before, after), contour.program(by_pairs + unwritten, end, before, after)


def difference(one, other):
    if one[0] or other[0]:
        return None if one[0] == other[0] else f"alarm {one[0]} against {other[0]}"
    if len(one[1]) != len(other[1]):
        return f"{len(one[1])} moves against {len(other[1])}"
    for number, (a, b) in enumerate(zip(one[1], other[1])):
        away = max(abs(p - q) for k in (0, 1) for p, q in zip(a[k], b[k]))
        if away > DIGITS or (a[2] > 0) != (b[2] > 0):
            return f"move {number}: {a} against {b}"
    return None


def main():
    count, first = int(os.environ.get("NC_SEEDS", "60" if os.environ.get("NC_SANITIZE") else "400")), int(os.environ.get("NC_FIRST_SEED", "1"))
    wrong = alarms = compared = 0
    for begin in range(first, first + count, 50):
        cases = [(seed, *pair) for seed in range(begin, min(begin + 50, first + count)) for pair in pairs_of(seed)]
        results = run_all([program for case in cases for program in case[2:]])
        for i, (seed, name, one, other) in enumerate(cases):
            compared += 1
            alarms += results[2 * i][0] is not None
            bad = difference(results[2 * i], results[2 * i + 1])
            if bad:
                wrong += 1
                if wrong <= 10 or os.environ.get("NC_SHOW"):
                    print(f"seed {seed} {name}: {bad}")
                if os.environ.get("NC_SHOW"):
                    print("\n".join([*one, "against", *other]))
    print(f"{compared} pairs, {alarms} end in an alarm, {wrong} differ")
    if alarms > (1 - LEAST_PATHS) * compared:
        print("too many alarms")
        return 1
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
