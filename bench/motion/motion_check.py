#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Checks a recording of `ncsim motion`: the limits by finite differences, the distance to the programmed path, the feeds, the exact stops.

usage: motion_check.py [--limits V,A,J] [--path PROGRAMMED.path] [--tolerance MM] [--factor F] MOTION.csv

PROGRAMMED.path is the path as it is programmed (path_from_program.py --blend none). Every limit that is not kept is printed with axis, time
and amount. Exit status: 0 when everything is kept, 1 when not.
"""
import argparse
import math
import sys

import numpy as np

import path_file

ORDERS = ("velocity", "acceleration", "jerk")
AT_REST = 3  # rows that are added on both sides, because the axes stand before and after
STOP_MM = 1e-6  # an exact stop may be missed by this
SLACK_MM = 1e-6
ROUNDING = 2e-12  # mm, error of a position that is written with 12 decimals


def read_motion(name):
    """Returns the names of the axes, the cycle in s, and the rows of positions."""
    with open(name, encoding="ascii") as lines:
        head = lines.readline().strip().split(",")
        table = np.loadtxt(lines, delimiter=",", ndmin=2)
    if head[0] != "t" or table.shape[1] != len(head):
        raise path_file.PathError(f"{name}: is no recording of ncsim motion")
    if len(table) < 2:
        raise path_file.PathError(f"{name}: has no motion")
    return head[1:], (table[-1, 0] - table[0, 0]) / (len(table) - 1), table[:, 1:]


def differences(rows, cycle_s, order):
    """The finite difference of this order of every axis, with rests added; row k belongs to the time (k + order - AT_REST) * cycle_s."""
    padded = np.concatenate([rows[:1]] * AT_REST + [rows] + [rows[-1:]] * AT_REST)
    return np.diff(padded, order, axis=0) / cycle_s ** order


def worst_ratios(rows, cycle_s, limits):
    """{order: [(worst ratio to the limit, its time in s) of each axis]}. `limits` are (velocity, acceleration, jerk) of each axis; a jerk of 0
    or inf is no limit."""
    out = {}
    for order, name in enumerate(ORDERS, 1):
        values = np.abs(differences(rows, cycle_s, order))
        # less the part that the rounding of the recorded positions can cause
        values = np.maximum(values - 2 ** order * ROUNDING / 2 / cycle_s ** order, 0)
        where = values.argmax(axis=0)
        row = []
        for axis, k in enumerate(where):
            limit = limits[axis][order - 1]
            ratio = values[k, axis] / limit if limit > 0 else 0.0
            row.append((float(ratio), max(0.0, (int(k) + order - AT_REST) * cycle_s)))
        out[name] = row
    return out


class Line:
    """A straight piece of the programmed path."""

    def __init__(self, feed, start, slope):
        self.feed, self.start, self.slope = feed, start, slope
        self.length = math.sqrt(sum(d * d for d in slope))

    def nearest(self, p, least):
        """(distance, share) of the place nearest to p; places before the share `least` of the piece do not count."""
        if self.length == 0:
            return math.dist(p, self.start), 1.0
        t = sum((x - a) * d for x, a, d in zip(p, self.start, self.slope)) / self.length ** 2
        t = min(1.0, max(least, t))
        return math.sqrt(sum((a + t * d - x) ** 2 for x, a, d in zip(p, self.start, self.slope))), t

    def at(self, share):
        return [a + share * d for a, d in zip(self.start, self.slope)]

    def end(self):
        return self.at(1.0)


class Arc:
    """A circular piece; the place at the angle of a point is taken as the nearest one."""

    def __init__(self, feed, a, b, ca, cb, sweep, start, finish):
        self.feed, self.a, self.b, self.ca, self.cb, self.sweep = feed, a, b, ca, cb, sweep
        self.start, self.finish = start, finish
        self.r0, self.r1 = math.hypot(start[a] - ca, start[b] - cb), math.hypot(finish[a] - ca, finish[b] - cb)
        self.angle = math.atan2(start[b] - cb, start[a] - ca)
        rest = sum((y - x) ** 2 for k, (x, y) in enumerate(zip(start, finish)) if k not in (a, b))
        self.length = math.sqrt((abs(sweep) * (self.r0 + self.r1) / 2) ** 2 + rest)

    def nearest(self, p, least):
        turned = (math.atan2(p[self.b] - self.cb, p[self.a] - self.ca) - self.angle) / self.sweep
        turn = 2 * math.pi / abs(self.sweep)
        # of all turns take the one that is closest to the last place
        turned += turn * round((least - turned) / turn)
        if turned < least - 0.25 * turn:
            turned += turn
        t = min(1.0, max(least, turned))
        return math.dist(self.at(t), p), t

    def at(self, share):
        radius, angle = self.r0 + share * (self.r1 - self.r0), self.angle + share * self.sweep
        point = [x + share * (y - x) for x, y in zip(self.start, self.finish)]
        point[self.a], point[self.b] = self.ca + radius * math.cos(angle), self.cb + radius * math.sin(angle)
        return point

    def end(self):
        return self.finish


def pieces_of(path):
    out = []
    for piece in path.pieces:
        if piece[0] == "arc":
            out.append(Arc(piece[1], *piece[2:]))
        elif all(len(c) <= 2 for c in piece[2]):
            out.append(Line(piece[1], [c[0] for c in piece[2]], [c[1] if len(c) > 1 else 0.0 for c in piece[2]]))
        else:
            raise path_file.PathError("the programmed path must be of lines and arcs (path_from_program.py --blend none)")
    return out


def first_within(piece, p, least, distance):
    """The first share of the piece, from `least` on, that is no farther from p than this, or None."""
    if math.dist(piece.at(least), p) <= distance:
        return least
    off, near = piece.nearest(p, least)
    if off > distance:
        return None
    far = least
    for _ in range(40):
        middle = 0.5 * (far + near)
        far, near = (far, middle) if math.dist(piece.at(middle), p) <= distance else (middle, near)
    return near


def goes_along(pieces, points, distance):
    """Whether each row has a place of the path no farther away than this, none of them in front of that of the row before. Of the places that a row
    may have the first one leaves the most to the others, so there is nothing to choose."""
    number, share, last = 0, 0.0, points[0]
    for p in points:
        ahead, reach = 0.0, math.dist(p, last) + 8 * distance + SLACK_MM
        k, at = number, share
        while True:
            found = first_within(pieces[k], p, at, distance)
            if found is not None:
                number, share = k, found
                break
            ahead += (1 - at) * pieces[k].length
            k, at = k + 1, 0.0
            if k == len(pieces) or ahead > reach:
                return False
        last = p
    return True


class Follower:
    """Follows a recording along the programmed path, always forward, and keeps the worst deviation, feed and missed stops."""

    def __init__(self, path, cycle_s, tolerance):
        self.pieces, self.stops, self.cycle_s, self.tolerance = pieces_of(path), path.exact, cycle_s, tolerance
        self.deviation = (0.0, 0.0)  # mm, seconds
        self.feed = (0.0, 0.0)  # ratio, seconds
        self.missed = {}  # number of the piece behind a stop -> the smallest distance to the stop, mm
        self.piece, self.share = 0, 0.0

    def follow(self, rows):
        points = rows.tolist()
        ends = {k: self.pieces[k - 1].end() for k in self.stops}
        missed = {k: math.inf for k in self.stops}
        last = points[0]
        for number, p in enumerate(points):
            step = math.dist(p, last)
            before = self.piece
            off = self._advance(p, step)
            if off > self.deviation[0]:
                self.deviation = (off, number * self.cycle_s)
            feeds = [self.pieces[k].feed for k in range(before, self.piece + 1)]
            if 0.0 not in feeds and step > 0:
                ratio = (step - SLACK_MM * self.cycle_s) / self.cycle_s / max(feeds)
                if ratio > self.feed[0]:
                    self.feed = (ratio, number * self.cycle_s)
            for k in (self.piece, self.piece + 1):
                if k in missed:
                    missed[k] = min(missed[k], math.dist(p, ends[k]))
            last = p
        for k in range(self.piece + 1, len(self.pieces) + 1):
            if k in missed:
                missed[k] = min(missed[k], math.dist(last, ends[k]))
        if self.deviation[0] > self.tolerance + SLACK_MM and goes_along(self.pieces, points, self.tolerance + SLACK_MM):
            # Where the lines are shorter than the tolerance and turn back, the nearest place may have been too far ahead.
            self.deviation = (self.tolerance, self.deviation[1])
        self.missed = {k: d for k, d in missed.items() if d > STOP_MM}
        self.left = math.dist(last, self.pieces[-1].end())
        return self

    def _advance(self, p, step):
        reach = step + 4 * self.tolerance + SLACK_MM
        piece = self.pieces[self.piece]
        back = (2 * self.tolerance + SLACK_MM) / max(piece.length, 1e-9)
        best, share = piece.nearest(p, max(0.0, self.share - back))
        found = self.piece
        ahead = (1 - self.share) * piece.length
        k = self.piece + 1
        while k < len(self.pieces) and ahead <= reach:
            off, at = self.pieces[k].nearest(p, 0.0)
            if off < best - 1e-9:
                best, share, found = off, at, k
            ahead += self.pieces[k].length
            k += 1
        if found != self.piece or share > self.share:
            self.piece, self.share = found, share
        return best


def breaches(axes, rows, cycle_s, limits, path=None, tolerance=0.01, factor=1.001):
    """One sentence for each limit, stop or end that is not kept."""
    out = []
    for name, row in worst_ratios(rows, cycle_s, limits).items():
        for axis, (ratio, seconds) in zip(axes, row):
            if ratio > factor:
                out.append(f"axis {axis}: {name} {ratio:.4f} times its limit at t = {seconds:.6f} s")
    if path is not None:
        seen = Follower(path, cycle_s, tolerance).follow(rows)
        if seen.deviation[0] > tolerance + SLACK_MM:
            out.append(f"path: {seen.deviation[0]:.6f} mm away at t = {seen.deviation[1]:.6f} s, tolerance {tolerance:g} mm")
        if seen.feed[0] > factor:
            out.append(f"feed: {seen.feed[0]:.4f} times what is programmed at t = {seen.feed[1]:.6f} s")
        for k, off in sorted(seen.missed.items()):
            out.append(f"stop behind piece {k}: missed by {off:.6f} mm")
        if seen.left > STOP_MM:
            out.append(f"end: missed by {seen.left:.6f} mm")
    return out


def main():
    from reference import parse_limits
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("motion")
    parser.add_argument("--limits", type=parse_limits, default=(250.0, 2000.0, 50000.0))
    parser.add_argument("--path")
    parser.add_argument("--tolerance", type=float, default=0.01)
    parser.add_argument("--factor", type=float, default=1.001)
    options = parser.parse_args()
    try:
        axes, cycle_s, rows = read_motion(options.motion)
        path = path_file.read(options.path) if options.path else None
        found = breaches(axes, rows, cycle_s, [options.limits] * len(axes), path, options.tolerance, options.factor)
    except (OSError, ValueError, path_file.PathError) as error:
        sys.exit(f"motion_check.py: {error}")
    for text in found:
        print(text)
    print(f"{len(rows)} rows, {(len(rows) - 1) * cycle_s:.3f} s: " + ("all kept" if not found else f"{len(found)} breaches"))
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
