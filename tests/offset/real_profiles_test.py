#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The closed profiles of real programs, compensated with leads of every kind, against the offset of GEOS as in oracle_test.py.

The programs beside the source tree (shared/programs) carry no radius compensation: their systems have offset the tool's path themselves. What they machine
are rings of lines and arcs as such systems write them, with three digits, so the two radii of their arcs differ and their joints are tangent to some
micrometres only. Each ring becomes the contour of a program with G41 or G42, inside and outside, with tools of several radii, ways in and out of all kinds
that cam_profiles.py has, CONTOUR_CHECK on; every path that does not end in an alarm is judged for gouges, for what it leaves uncut and for gaps. The files are read
where they lie, and nothing of them is kept.

NC_TRIES=n   programs for each ring (default 6, 1 under a sanitizer); NC_SHOW=1   prints the program of each that fails
Exit 77: no shapely, or no such programs.
"""
import copy
import math
import os
import re
import sys

import oracle_test as oracle
from cam_profiles import Profile
from contours import Element, area_of, ring_of
from shapely.geometry import Polygon

MOST_ALARMS = 0.5  # inside of a ring smaller than the tool, and at corners that it does not fit into
LEAST_RINGS = 100


def numbers(block):
    """Words of a block; of a letter that comes more than once, G and M apart, the last one."""
    return [(letter, float(value)) for letter, value in re.findall(r"([A-Z])\s*([-+]?(?:\d+\.?\d*|\.\d+))", block)]


def cuts_of(path):
    """Rows of elements in the XY plane that are cut one behind the other at one depth."""
    row, at, z, code, unit, absolute, plane = [], (0.0, 0.0), 0.0, 0, 1.0, True, True
    with open(path, encoding="latin-1") as file:
        for text in file:
            block = re.sub(r"\([^)]*\)|;.*", "", text).upper()
            if "#" in block or "[" in block:  # computed
                continue
            words = numbers(block)
            to = dict(words)
            for letter, value in words:
                if letter == "G":
                    code = int(value) if value in (0, 1, 2, 3) else code
                    unit = {20: 25.4, 21: 1.0}.get(value, unit)
                    absolute = {90: True, 91: False}.get(value, absolute)
                    plane = {17: True, 18: False, 19: False}.get(value, plane)
            if any(letter == "G" and value in (4, 10, 28, 30, 53, 92) for letter, value in words):
                continue
            end = tuple(unit * to[axis] + (0 if absolute else at[i]) if axis in to else at[i] for i, axis in enumerate("XY"))
            down = unit * to["Z"] + (0 if absolute else z) if "Z" in to else z
            if "X" not in to and "Y" not in to and "Z" not in to and not (code in (2, 3) and ("I" in to or "J" in to)):
                continue
            end, center = (round(end[0], 6), round(end[1], 6)), None
            if code in (2, 3):
                center = (round(at[0] + unit * to.get("I", 0), 6), round(at[1] + unit * to.get("J", 0), 6))
            if code == 0 or abs(down - z) > 1e-9 or not plane or (center and "R" in to):
                if row:
                    yield row
                row = []
            elif end != at or center:
                row.append(Element(at, end, center, code == 3))
            at, z = end, down
    if row:
        yield row


def rings_of(path):
    """Closed pieces of these rows that do not cross themselves, counter-clockwise."""
    for row in cuts_of(path):
        first = 0
        while first < len(row):
            last = next((i for i in range(first, len(row)) if row[i].end == row[first].start), None)
            if last is None:
                first += 1
                continue
            ring, first = row[first: last + 1], last + 1
            if len(ring) < 2 and ring[0].center is None:
                continue
            area = area_of(ring_of(ring))
            if area < 0:
                ring = [Element(e.end, e.start, e.center, not e.ccw) for e in reversed(ring)]
            if abs(area) > 1 and Polygon(ring_of(ring)).is_valid:
                yield ring


class RealProfile(Profile):
    def __init__(self, seed, name, ring):
        self.name, self.ring = name, ring
        super().__init__(seed)

    def draw(self, rng):
        self.radius = round(rng.choice([0.1, 0.3, 1, 3]) * rng.uniform(0.5, 1.2), 3)
        self.part = Polygon(ring_of(self.ring))
        self.inside, self.kind = rng.random() < 0.5, "real"
        return [copy.copy(e) for e in self.ring]


def main():
    folder = os.path.join(os.environ.get("NC_SHARED_DIR", ""), "programs")
    files = sorted(name for name in os.listdir(folder) if name.endswith((".nc", ".ngc"))) if os.path.isdir(folder) else []
    if not files:
        print("skipped: no programs beside the source tree")
        return 77
    tries = int(os.environ.get("NC_TRIES", "1" if os.environ.get("NC_SANITIZE") else "6"))
    rings = [(name, ring) for name in files for ring in rings_of(os.path.join(folder, name))]
    profiles = [RealProfile(1000 * i + k, name, ring) for i, (name, ring) in enumerate(rings) for k in range(tries)]
    alarms, wrong = {}, 0
    for begin in range(0, len(profiles), 500):
        part = profiles[begin: begin + 500]
        for profile, result in zip(part, oracle.run_all([p.blocks() for p in part])):
            if result.alarm:
                alarms[result.alarm] = alarms.get(result.alarm, 0) + 1
            bad = None if result.alarm in ("P153", "P152") else f"alarm {result.alarm}" if result.alarm else oracle.judge(profile, result)
            if bad:
                wrong += 1
                if wrong <= 10 or os.environ.get("NC_SHOW"):
                    print(f"{profile.name}, ring {profile.seed // 1000} of {len(profile.ring)} blocks, seed {profile.seed}, {'inside' if profile.inside else 'outside'}, r {profile.radius}: {bad}")
                if os.environ.get("NC_SHOW"):
                    print("\n".join(profile.blocks()))
    print(f"{len(rings)} rings of {len({name for name, _ in rings})} programs, {sum(len(ring) for _, ring in rings)} blocks; "
          f"{len(profiles)} programs, {sum(alarms.values())} end in an alarm {alarms}; wrong {wrong}")
    few = len(rings) < LEAST_RINGS
    many = sum(alarms.values()) > MOST_ALARMS * len(profiles)
    return 1 if wrong or few or many else 0


if __name__ == "__main__":
    sys.exit(main())
