#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compensated contours against an offset that shares no code with the control: GEOS (python3-shapely).

Random closed contours of lines and arcs are compensated inside and outside by ncsim, with CONTOUR_CHECK, from a way in and back on a way out: lines at
right angles, quarter circles with and without a ramp, lines along the first and the last block (a corner is then left on its lengthened sides), lines at
any angle. Some go round twice, the first time down along a helix, whole circles among them. Corners between lines and, as the machine has the option for
it, beside arcs are cut. Offset numbers differ from contour to contour; some contours change theirs on the way. Of each that does not end in an alarm it is asked:

  gouge    no part of the tool's path, the ways in and out included, comes nearer than the radius to any element of the contour
  uncut    every point of the contour that GEOS' offset curve reaches is reached by the path
  open     the path has no gap and ends where it began

to a micrometre and the error of the fine polygons. Then the contour is mirrored, turned, scaled and run backwards, and the path has to follow. How
many may end in an alarm is bounded for each kind of contour.

NC_CONTOURS=n   how many (default 10000, 200 under a sanitizer; a long run takes 1000000); NC_FIRST_SEED=n   the first of them; NC_EVERY=n   which
of them are transformed (default 20: each twentieth); NC_SHOW=1   prints the program of each that fails
Exit 77: no shapely.
"""
import copy
import json
import math
import os
import random
import subprocess
import sys
import tempfile

try:
    from shapely.geometry import LineString, MultiLineString, Point, Polygon
except ImportError:
    # A python3 in front of Debian's in PATH does not see Debian's packages.
    debian = "/usr/bin/python3"
    if os.path.realpath(sys.executable) != os.path.realpath(debian) and os.path.exists(debian) and "NC_TRIED" not in os.environ:
        os.execve(debian, [debian, *sys.argv], dict(os.environ, NC_TRIED="1"))
    print("skipped: no python3-shapely")
    sys.exit(77)

SAGITTA = 0.00025  # mm: how far the fine polygons leave their arcs
TOLERANCE = 0.001 + 3 * SAGITTA
PER_PROCESS = 50
MOST_ALARMS = {"star": 0.5, "slot": 0.65, "plate": 0.6, "round": 0.5, "circle": 0.5}  # shares of each kind

MACHINE = """[machine]
name = "contours"
dialect = "m700"
hal = "sim"
look_ahead = 64
program_entries = 2
""" + "".join(f'[[axis]]\nname = "{name}"\nmax_velocity = 1000\nmax_acceleration = 5000\n' for name in "XYZ")


class Element:
    """A line, or an arc about `center` (None: line)."""

    def __init__(self, start, end, center=None, ccw=False, turns=0):
        self.start, self.end, self.center, self.ccw, self.turns = start, end, center, ccw, turns

    def sweep(self):
        a = math.atan2(self.start[1] - self.center[1], self.start[0] - self.center[0])
        b = math.atan2(self.end[1] - self.center[1], self.end[0] - self.center[0])
        turn = (b - a) % (2 * math.pi) if self.ccw else -((a - b) % (2 * math.pi))
        whole = max(self.turns, 1) if abs(turn) < 1e-12 else self.turns
        return turn + (2 if self.ccw else -2) * math.pi * whole

    def radius(self):
        return math.hypot(self.start[0] - self.center[0], self.start[1] - self.center[1])

    def points(self):
        """Fine polygon, both ends included."""
        if self.center is None:
            return [self.start, self.end]
        r, sweep = self.radius(), self.sweep()
        r_end = math.hypot(self.end[0] - self.center[0], self.end[1] - self.center[1])
        most = max(r, r_end)
        if most < 1e-9:
            return [self.start, self.end]
        step = 2 * math.sqrt(2 * SAGITTA / most) if most > SAGITTA else math.pi / 2
        n = max(2, math.ceil(abs(sweep) / min(step, math.pi / 4)))
        a = math.atan2(self.start[1] - self.center[1], self.start[0] - self.center[0])
        middle = []
        for k in range(1, n):
            radius = r + (r_end - r) * k / n
            middle.append((self.center[0] + radius * math.cos(a + sweep * k / n), self.center[1] + radius * math.sin(a + sweep * k / n)))
        return [self.start, *middle, self.end]

    def at(self, part):
        """Point and unit tangent at a part of its length."""
        if self.center is None:
            dx, dy = self.end[0] - self.start[0], self.end[1] - self.start[1]
            length = math.hypot(dx, dy)
            return (self.start[0] + part * dx, self.start[1] + part * dy), (dx / length, dy / length)
        sweep, r = self.sweep(), self.radius()
        a = math.atan2(self.start[1] - self.center[1], self.start[0] - self.center[0]) + part * sweep
        sense = 1 if sweep > 0 else -1
        return (self.center[0] + r * math.cos(a), self.center[1] + r * math.sin(a)), (-sense * math.sin(a), sense * math.cos(a))

    def length(self):
        if self.center is None:
            return math.hypot(self.end[0] - self.start[0], self.end[1] - self.start[1])
        return abs(self.sweep()) * self.radius()

    def split(self, part):
        point = rounded(self.at(part)[0])
        if self.center is None:
            return Element(self.start, point), Element(point, self.end)
        return Element(self.start, point, self.center, self.ccw), Element(point, self.end, self.center, self.ccw)


def rounded(point):
    return (round(point[0], 6), round(point[1], 6))


def bulged(start, end, bulge):
    """Arc from start to end whose sweep is 4 atan(bulge)."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    k = (1 - bulge * bulge) / (4 * bulge)
    center = ((start[0] + end[0]) / 2 - k * dy, (start[1] + end[1]) / 2 + k * dx)
    return Element(start, end, rounded(center), bulge > 0)


def ring_of(elements):
    points = []
    for element in elements:
        points.extend(element.points()[:-1])
    return points


# ---- contours, counter-clockwise


def star(rng):
    n = rng.randint(3, 9)
    spread = rng.choice([0.0, 0.3, 0.8])
    angles = sorted(rng.uniform(0, 2 * math.pi) for _ in range(n)) if spread else [2 * math.pi * k / n for k in range(n)]
    corners = [rounded((30 * rng.uniform(1 - spread, 1) * math.cos(a), 30 * rng.uniform(1 - spread, 1) * math.sin(a))) for a in angles]
    arcs = rng.choice([0, 0, 0.4, 0.8])
    elements = []
    for i, corner in enumerate(corners):
        end = corners[(i + 1) % n]
        if rng.random() < arcs:
            elements.append(bulged(corner, end, rng.choice([-1, 1]) * rng.uniform(0.05, 0.7)))
        else:
            elements.append(Element(corner, end))
    return elements


def polygon(points):
    return [Element(rounded(p), rounded(points[(i + 1) % len(points)])) for i, p in enumerate(points)]


def slot(rng, r):
    width, depth = r * rng.choice([0.5, 1.5, 1.999, 2.0, 2.001, 2.5, 4]), rng.uniform(2, 20)
    x = rng.uniform(-10, 10)
    taper = rng.choice([0, 0, 0.4])
    return polygon([(-40, -20), (40, -20), (40, 20), (x + width / 2, 20), (x + width / 2 - taper, 20 - depth), (x - width / 2 + taper, 20 - depth), (x - width / 2, 20), (-40, 20)])


def rounded_plate(rng, r):
    """Corner radii about that of the tool, convex or concave corners."""
    radius = r * rng.choice([1, 1, 0.999, 1.001, 0.5, 2])
    a, b = rng.uniform(3, 30) + 2 * radius, rng.uniform(3, 20) + 2 * radius
    elements, concave = [], rng.random() < 0.4
    at = [(a, -b, 0), (a, b, 1), (-a, b, 2), (-a, -b, 3)]
    ways = [(1, 0), (0, 1), (-1, 0), (0, -1)]
    for i, (x, y, k) in enumerate(at):
        d, e = ways[k], ways[(k + 1) % 4]
        before = rounded((x - d[0] * radius, y - d[1] * radius))
        behind = rounded((x + e[0] * radius, y + e[1] * radius))
        center = (x, y) if concave else (x - d[0] * radius + e[0] * radius, y - d[1] * radius + e[1] * radius)
        elements.append(Element(before, behind, rounded(center), not concave))
        nx, ny, nk = at[(i + 1) % 4]
        nd = ways[nk]
        elements.append(Element(behind, rounded((nx - nd[0] * radius, ny - nd[1] * radius))))
    return elements


def nearly_round(rng, r):
    """359.999 degrees and the chord that closes them."""
    radius = r * rng.choice([0.5, 1, 1.5, 4])
    a = rng.uniform(0, 2 * math.pi)
    gap = math.radians(rng.choice([0.001, 0.01, 1]))
    start = rounded((radius * math.cos(a), radius * math.sin(a)))
    end = rounded((radius * math.cos(a - gap), radius * math.sin(a - gap)))
    return [Element(start, end, (0.0, 0.0), True), Element(end, start)]


def circle(rng, r):
    """A whole circle in one block."""
    radius = round(r * rng.choice([0.5, 1, 1.05, 1.5, 4]) * rng.uniform(1, 1.2), 3)
    start = rounded((radius, 0)) if rng.random() < 0.5 else rounded((0, radius))
    return [Element(start, start, (0.0, 0.0), True)]


def cut_at(near, far):
    """Points in which two offset curves meet, each (element, its distance to the left), of two the one nearer to the corner first."""
    def curve(element, left):
        if element.center is None:
            p, u = element.at(0)
            return ("line", (p[0] - left * u[1], p[1] + left * u[0]), u)
        return ("circle", element.center, element.radius() - left * (1 if element.ccw else -1))

    a, b = curve(*near), curve(*far)
    if a[0] == "circle" and b[0] == "line":
        a, b = b, a
    if a[0] == "line" and b[0] == "line":
        return []
    if b[2] <= 1e-3 or (a[0] == "circle" and a[2] <= 1e-3):
        return []
    if a[0] == "line":
        foot = (b[1][0] - a[1][0]) * a[2][0] + (b[1][1] - a[1][1]) * a[2][1]
        beside = (b[1][0] - a[1][0]) * a[2][1] - (b[1][1] - a[1][1]) * a[2][0]
        base, along, half = (a[1][0] + foot * a[2][0], a[1][1] + foot * a[2][1]), a[2], b[2] ** 2 - beside ** 2
    else:
        d = math.dist(a[1], b[1])
        if d < 1e-6:
            return []
        e = ((b[1][0] - a[1][0]) / d, (b[1][1] - a[1][1]) / d)
        x = (a[2] ** 2 - b[2] ** 2 + d * d) / (2 * d)
        base, along, half = (a[1][0] + x * e[0], a[1][1] + x * e[1]), (-e[1], e[0]), a[2] ** 2 - x * x
    if half <= 1e-6:
        return []
    corner, h = near[0].end, math.sqrt(half)
    hits = [(base[0] + t * along[0], base[1] + t * along[1]) for t in (h, -h)]
    return sorted(hits, key=lambda p: math.dist(p, corner))


def foot_on(element, point):
    """Where the element is nearest to a point beside it, and how far along it that is, 0 to 1; None beside its ends."""
    if element.center is None:
        p, u = element.at(0)
        way = (point[0] - p[0]) * u[0] + (point[1] - p[1]) * u[1]
        part = way / element.length()
        return ((p[0] + way * u[0], p[1] + way * u[1]), part) if 0 <= part <= 1 else None
    r, d = element.radius(), math.dist(point, element.center)
    foot = (element.center[0] + (point[0] - element.center[0]) * r / d, element.center[1] + (point[1] - element.center[1]) * r / d)
    if math.dist(foot, element.start) < 1e-9:
        return None
    part = Element(element.start, foot, element.center, element.ccw).sweep() / element.sweep()
    return (foot, part) if 0 <= part <= 1 else None


def divide(rng, elements):
    """Collinear and tangent joints, down to pieces of a nanometre."""
    result = []
    for element in elements:
        length = element.length()
        part = rng.choice([0.5, rng.random(), 1e-6 / length if length > 1 else 0.5, 0.001 / length if length > 1 else 0.5])
        if rng.random() < 0.25 and 0 < part < 1:
            pieces = element.split(part)
            if all(piece.start != piece.end for piece in pieces):
                result.extend(pieces)
                continue
        result.append(element)
    return result


class Contour:
    def __init__(self, seed):
        rng = random.Random(seed)
        self.seed = seed
        self.radius = round(rng.choice([0.5, 1, 2, 3, 5, 8]) * rng.uniform(0.5, 1.2), 3)
        while True:
            kind = rng.choice(["star", "star", "star", "slot", "plate", "round", "star", "circle"])
            elements = {"star": lambda: star(rng), "slot": lambda: slot(rng, self.radius), "plate": lambda: rounded_plate(rng, self.radius), "round": lambda: nearly_round(rng, self.radius), "circle": lambda: circle(rng, self.radius)}[kind]()
            if any(e.start == e.end and e.center is None for e in elements):
                continue
            self.part = Polygon(ring_of(elements))
            if self.part.is_valid and self.part.area > 1e-3 and self.part.exterior.is_ccw:
                break
        self.kind = kind
        self.inside = rng.random() < 0.5
        if kind != "circle" and rng.random() < 0.4:
            elements = divide(rng, elements)
        self.along = 0.0  # length of lines along the first and the last block by which the tool comes and goes
        self.aslant = None  # unit vector of the way in and out, where it is not at right angles
        self.depth = 0.0  # of a first round along a helix
        self.number, self.other = rng.randint(1, 9), None  # offset numbers; `other`: (block, radius) from which on another amount counts
        self.corners = {}
        self.way = 0.0  # radius of the quarter circles in and out, 0: lines at right angles to the contour
        self.ramp = ""  # Z to which the tool goes down on the way in
        self.begin(rng, elements)
        self.cut_corners(rng)
        if rng.random() < 0.5:
            self.reverse()
        if not self.corners and rng.random() < 0.15:  # the size of a chamfer counts along a line in space
            self.depth, self.ramp = rng.choice([0.5, 3.0]), ""
        elif not self.corners and len(self.programmed) > 2 and rng.random() < 0.1:
            self.other = (rng.randint(1, len(self.programmed) - 1), round(self.radius * rng.uniform(0.7, 1.0), 3))

    def begin(self, rng, elements):
        """Starts in the middle of an element, where the tool has room if there is such a place."""
        order = sorted(range(len(elements)), key=lambda i: (-min(elements[i].length(), 5), rng.random()))
        side = 1 if self.inside else -1
        chosen = None
        for i in order[:6]:
            for part in (0.5, 0.3, 0.7):
                point, u = elements[i].at(part)
                center = Point(point[0] - side * u[1] * self.radius, point[1] + side * u[0] * self.radius)
                if chosen is None:
                    chosen = (i, part)
                if self.part.exterior.distance(center) >= self.radius - 2 * SAGITTA:
                    chosen = (i, part)
                    break
            else:
                continue
            break
        i, part = chosen
        kind = rng.random()
        if elements[i].length() < 0.01 or self.kind == "circle" or (0.4 < kind < 0.6 and rng.random() < 0.6):  # from a corner
            part = 0
        if part == 0:
            self.elements = elements[i:] + elements[:i]
        else:
            first, last = elements[i].split(part)
            self.elements = [last, *elements[i + 1:], *elements[:i], first]
        point, u = self.elements[0].at(0)
        for far in (1.5, 1.2, 1.05, 1.0):  # where the tool stands before and behind has room, too
            self.lead = rounded((point[0] - side * u[1] * far * self.radius, point[1] + side * u[0] * far * self.radius))
            if self.part.exterior.distance(Point(self.lead)) >= self.radius - 2 * SAGITTA:
                break
        if 0.4 < kind < 0.6:
            self.along = round(rng.uniform(1.05, 3) * self.radius, 3)
            last, v = self.elements[-1].at(1)
            begin = (point[0] - self.along * u[0], point[1] - self.along * u[1])
            end = (last[0] + self.along * v[0], last[1] + self.along * v[1])
            self.between = (rounded(begin), rounded(end))
            self.lead = rounded((begin[0] - side * u[1] * 1.5 * self.radius, begin[1] + side * u[0] * 1.5 * self.radius))
        elif 0.6 < kind < 0.75:
            angle = rng.uniform(-0.9, 0.9)
            n = (-side * u[1], side * u[0])
            self.aslant = (n[0] * math.cos(angle) - n[1] * math.sin(angle), n[0] * math.sin(angle) + n[1] * math.cos(angle))
            far = rng.uniform(1.2, 2.5) * self.radius
            self.lead = rounded((point[0] + far * self.aslant[0], point[1] + far * self.aslant[1]))
        elif kind < 0.4:  # on quarter circles, as far as there is room
            self.way = round(rng.uniform(1.05, 2) * self.radius, 3)
            self.lead = rounded((point[0] - side * u[1] * self.way, point[1] + side * u[0] * self.way))
            self.ramp = rng.choice(["", " Z-2.5"])

    def cut_corners(self, rng):
        """,C and ,R between lines, with the shape that they make by a calculation of its own."""
        self.programmed = list(self.elements)
        if rng.random() < 0.6:
            return
        shape, i, n = list(self.elements), 0, len(self.elements)
        new = []
        entry = None
        for i in range(n):
            element = shape[i]
            start = entry or element.start
            entry = None
            follows = shape[i + 1] if i + 1 < n else None
            cut = None
            if follows and element.center is None and follows.center is None and rng.random() < 0.4:
                cut = self.cut(rng, start, element.end, follows.end)
            elif follows and (element.center or follows.center) and element.start != element.end and rng.random() < 0.3:
                cut = self.cut_beside_arc(rng, Element(start, element.end, element.center, element.ccw), follows)
            if cut is None:
                new.append(Element(start, element.end, element.center, element.ccw))
                continue
            self.corners[i], before, behind, middle = cut
            new.append(Element(start, before, element.center, element.ccw))
            new.append(middle)
            entry = behind
        candidate = Polygon(ring_of(new))
        if not candidate.is_valid:
            self.corners = {}
            return
        self.elements, self.part = new, candidate

    def cut_beside_arc(self, rng, element, follows):
        """The same beside an arc (corner_ii): the circle that touches both, or the line between the points that are as far from the corner."""
        shortest = min(element.length(), follows.length(), *(e.radius() for e in (element, follows) if e.center))
        (_, u), (corner, w) = element.at(1), follows.at(0)
        turn = math.atan2(u[0] * w[1] - u[1] * w[0], u[0] * w[0] + u[1] * w[1])
        if shortest < 0.5 or not 0.1 < abs(turn) < 3:
            return None
        size = round(rng.uniform(0.05, 0.3) * shortest, 3)
        if size < 0.02:
            return None
        if rng.random() < 0.5:
            ends = []
            for e, sense in ((element, -1), (follows, 1)):
                way = size if e.center is None else 2 * e.radius() * math.asin(size / 2 / e.radius())
                ends.append(e.at(0.5 + sense * (way / e.length() - 0.5))[0])
            return f",C{size:.3f}", ends[0], ends[1], Element(ends[0], ends[1])
        left = size if turn > 0 else -size
        for center in cut_at((element, left), (follows, left)):
            feet = foot_on(element, center), foot_on(follows, center)
            if None in feet or feet[0][1] < 0.5 or feet[1][1] > 0.5:
                return None
            return f",R{size:.3f}", feet[0][0], feet[1][0], Element(feet[0][0], feet[1][0], center, turn > 0)
        return None

    def cut(self, rng, start, corner, end):
        a, b = math.dist(start, corner), math.dist(corner, end)
        if min(a, b) < 0.5:
            return None
        u = ((corner[0] - start[0]) / a, (corner[1] - start[1]) / a)
        w = ((end[0] - corner[0]) / b, (end[1] - corner[1]) / b)
        turn = math.atan2(u[0] * w[1] - u[1] * w[0], u[0] * w[0] + u[1] * w[1])
        if abs(turn) > 3:
            return None
        room = 0.45 * min(a, b)
        if rng.random() < 0.5:
            size = round(rng.uniform(0.1, 0.9) * room, 3)
            taken, word = size, f",C{size:.3f}"
        else:
            if abs(turn) < 0.05:
                return None
            size = round(min(rng.uniform(0.1, 0.9) * room / math.tan(abs(turn) / 2), room), 3)
            taken, word = size * math.tan(abs(turn) / 2), f",R{size:.3f}"
        if size <= 0.01 or taken > room:
            return None
        before = (corner[0] - taken * u[0], corner[1] - taken * u[1])
        behind = (corner[0] + taken * w[0], corner[1] + taken * w[1])
        if word[1] == "C":
            return word, before, behind, Element(before, behind)
        sense = 1 if turn > 0 else -1
        center = (before[0] - sense * size * u[1], before[1] + sense * size * u[0])
        return word, before, behind, Element(before, behind, center, turn > 0)

    def reverse(self):
        if self.corners:
            return
        self.elements = [Element(e.end, e.start, e.center, not e.ccw) for e in reversed(self.elements)]
        self.programmed = list(self.elements)
        self.turn_round()

    def turn_round(self):
        self.backwards = not self.backwards
        if self.along:
            self.between = self.between[::-1]
            point, end = self.programmed[0].start, self.between[0]
            u = ((point[0] - end[0]) / self.along, (point[1] - end[1]) / self.along)
            side = 1 if self.side() == "G41" else -1
            self.lead = rounded((end[0] - side * u[1] * 1.5 * self.radius, end[1] + side * u[0] * 1.5 * self.radius))

    backwards = False

    def side(self):
        return "G41" if self.inside != self.backwards else "G42"

    def wall(self):
        """All of the contour as one line."""
        points = ring_of(self.elements)
        return LineString([*points, points[0]])

    def quarter(self, end):
        """The quarter circle by which the tool comes to the contour, or leaves it (`end`): its other end and its centre."""
        point, u = self.programmed[-1].at(1) if end else self.programmed[0].at(0)
        side = 1 if self.side() == "G41" else -1
        center = rounded((point[0] - side * u[1] * self.way, point[1] + side * u[0] * self.way))
        along = 1 if end else -1
        return rounded((center[0] + along * u[0] * self.way, center[1] + along * u[1] * self.way)), center

    def round(self, lines, depth):
        """The blocks of one round; `depth`: along it the tool goes down evenly."""
        start = 0.0
        whole = sum(e.length() for e in self.programmed)
        for i, e in enumerate(self.programmed):
            word = self.corners.get(i, "")
            if self.other and self.other[0] == i:
                word += f"D{self.number % 9 + 1}"
            start += e.length()
            down = f" Z{-depth * start / whole:.4f}" if depth else ""
            if e.center is None:
                lines.append(f"G1 X{e.end[0]:.6f} Y{e.end[1]:.6f}{down} {word}")
            else:
                lines.append(f"G{3 if e.ccw else 2} X{e.end[0]:.6f} Y{e.end[1]:.6f}{down} I{e.center[0] - e.start[0]:.6f} J{e.center[1] - e.start[1]:.6f} {word}")

    def blocks(self):
        first, lead, code = self.programmed[0].start, self.lead, f"{self.side()} D{self.number}"
        sense = "G3" if self.side() == "G41" else "G2"
        lines = [f"G10 L10 P{self.number} R{self.radius:.6f}", f"G0 X{lead[0]:.6f} Y{lead[1]:.6f}"]
        if self.other:
            lines[0] += f"\nG10 L10 P{self.number % 9 + 1} R{self.other[1]:.6f}"
        if self.way:
            start, center = self.quarter(False)
            lines.append(f"{code} G1 X{start[0]:.6f} Y{start[1]:.6f} F1000")
            lines.append(f"{sense} X{first[0]:.6f} Y{first[1]:.6f} I{center[0] - start[0]:.6f} J{center[1] - start[1]:.6f}{self.ramp}")
        elif self.along:
            lines.append(f"{code} G1 X{self.between[0][0]:.6f} Y{self.between[0][1]:.6f} F1000")
            lines.append(f"X{first[0]:.6f} Y{first[1]:.6f}")
        else:
            lines.append(f"{code} G1 X{first[0]:.6f} Y{first[1]:.6f} F1000")
        if self.depth:
            self.round(lines, self.depth)
        self.round(lines, 0)
        if self.way:
            last = self.programmed[-1].end
            end, center = self.quarter(True)
            lines.append(f"{sense} X{end[0]:.6f} Y{end[1]:.6f} I{center[0] - last[0]:.6f} J{center[1] - last[1]:.6f}{self.ramp and ' Z0'}")
        if self.along:
            lines.append(f"G1 X{self.between[1][0]:.6f} Y{self.between[1][1]:.6f}")
        lines.append(f"G1 G40 X{lead[0]:.6f} Y{lead[1]:.6f}{' Z0' if self.depth else ''}")
        return [block for line in lines for block in line.split("\n")]


# ---- transformed contours


def negated(text):
    return text[1:] if text.startswith("-") else "-" + text


def transformed(blocks, way):
    """The program of the contour mirrored in X, turned by a right angle, or twice as large: exact in its digits."""
    result = []
    for block in blocks:
        words = block.split()
        swap = {"G2": "G3", "G3": "G2", "G41": "G42", "G42": "G41"}
        if way == "mirror":
            words = [swap.get(w, w[0] + negated(w[1:]) if w[0] in "XI" else w) for w in words]
        elif way == "turn":
            words = [{"X": "Y", "I": "J"}[w[0]] + w[1:] if w[0] in "XI" else {"Y": "X", "J": "I"}[w[0]] + negated(w[1:]) if w[0] in "YJ" else w for w in words]
        else:
            words = [w[: 2 if w[0] == "," else 1] + f"{2 * float(w[2 if w[0] == ',' else 1:]):.6f}" if w[0] in "XYIJR," else w for w in words]
        result.append(" ".join(words))
    return result


TRANSFORMS = {"mirror": lambda p: (-p[0], p[1]), "turn": lambda p: (-p[1], p[0]), "scale": lambda p: (2 * p[0], 2 * p[1])}


def line_of(move, scale):
    return LineString([(scale * x, scale * y) for x, y in move.points()])


def run_backwards(contour):
    """The same contour the other way round, on its other side."""
    back = copy.copy(contour)
    back.elements = back.programmed = [Element(e.end, e.start, e.center, not e.ccw) for e in reversed(contour.programmed)]
    back.turn_round()
    return back.blocks()


def follows(result, other, change, way):
    """None, or how the other result differs from what the change makes of this one. What is too short to be a move, how far a path may come near
    a wall, and by how much the radii of an arc may differ that is one (a micrometre: the last digit of these words), does not scale; backwards the
    check meets the blocks in another order."""
    backwards = way == "back"
    if result.alarm or other.alarm:
        same = result.alarm == other.alarm and result.alarm_block == other.alarm_block
        tolerances = way == "scale" and "P153" in (result.alarm, other.alarm)
        return None if backwards or same or tolerances else f"alarm {other.alarm} and not {result.alarm}"
    ends = [change(move.end) for _, move in result.moves[:-1] if move.length() > 1e-5]
    others = [move.end for _, move in other.moves[:-1] if move.length() > (2e-5 if way == "scale" else 1e-5)]
    if backwards:
        others.reverse()
    worst = max((math.dist(a, b) for a, b in zip(ends, others)), default=0)
    if way == "scale" and (len(ends) != len(others) or worst > 3e-5):  # lines without a direction: the ends beside them may lie elsewhere on the same path
        paths = [MultiLineString([line_of(move, by) for _, move in r.moves if move.length() > 1e-9]) for r, by in ((result, 2), (other, 1))]
        apart = paths[0].hausdorff_distance(paths[1])
        return f"apart by {apart:.6f} mm" if apart > 4 * TOLERANCE else None
    if len(ends) != len(others):
        return f"{len(others)} moves and not {len(ends)}"
    return f"off by {worst:.6f} mm" if worst > 3e-5 else None


# ---- the control


class Result:
    def __init__(self):
        self.alarm = None
        self.alarm_block = None
        self.moves = []  # (block, Element): block 0 is the start


def run_all(ncsim, programs, folder):
    """Results of programs (lists of blocks) that run one behind the other; a new process goes on behind an alarm."""
    results = [Result() for _ in programs]
    setup, machine = os.path.join(folder, "setup.json"), os.path.join(folder, "machine.toml")
    if not os.path.exists(machine):
        with open(setup, "w", encoding="ascii") as out:
            json.dump({"params": {"CONTOUR_CHECK": 1, "corner_ii": 1}}, out)
        with open(machine, "w", encoding="ascii") as out:
            out.write(MACHINE)
    next_one = 0
    while next_one < len(programs):
        batch = range(next_one, min(next_one + PER_PROCESS, len(programs)))
        lines, owner = ["G17 G90 G21 G94"], [None]
        for k in batch:
            for block in programs[k]:
                owner.append(k)
                lines.append(block)
        path = os.path.join(folder, "contours.nc")
        with open(path, "w", encoding="ascii") as out:
            out.write("\n".join([*lines, "M30", ""]))
        first_line = {}  # of the start of compensation
        for number, k in enumerate(owner):
            if k is not None and k not in first_line and lines[number].startswith(("G41", "G42")):
                first_line[k] = number + 1
        trace = subprocess.run([ncsim, "trace", "--machine", machine, "--setup", setup, path], stdout=subprocess.PIPE, check=False).stdout
        next_one = batch[-1] + 1
        at = {"X": 0.0, "Y": 0.0}
        for text in trace.splitlines():
            event = json.loads(text)
            if event["t"] == "alarm":
                k = owner[event["line"] - 1]
                results[k].alarm = event["code"]
                results[k].alarm_block = event["line"] - first_line[k]
                next_one = k + 1
            if event["t"] != "move":
                continue
            k = owner[event["line"] - 1]
            to = event["machine"]
            start, end = (at["X"], at["Y"]), (to["X"], to["Y"])
            center = event.get("machine_center")
            block = event["line"] - first_line[k]
            if block >= 0:
                results[k].moves.append((block, Element(start, end, (center["X"], center["Y"]) if center else None, event.get("dir") == "ccw", event.get("turns", 0))))
            at = to
    return results


# ---- the judgement


def judge(contour, result):
    """None, or what is wrong."""
    at = contour.lead
    for _, move in result.moves:
        if not (math.dist(at, move.start) < 1e-6 and all(math.isfinite(x) for x in move.end)):
            return "open: a gap"
        at = move.end
    if math.dist(at, contour.lead) > 1e-6:
        return "open: the path does not come back"
    wall, paths = contour.wall(), [(block, LineString(move.points())) for block, move in result.moves if move.length() > 1e-9]
    path = MultiLineString([line for _, line in paths])
    if contour.depth:  # the way in lies above the walls
        paths = [each for each in paths if each[0] > (1 if contour.way or contour.along else 0)]
        path = MultiLineString([line for _, line in paths])
    depth = (min(contour.radius, contour.other[1]) if contour.other else contour.radius) - path.distance(wall)
    if depth > TOLERANCE:
        block = min(paths, key=lambda each: each[1].distance(wall))[0]
        return f"gouge of {depth:.4f} mm in block {block}"
    return None if contour.other else judge_uncut(contour, path)  # with two amounts there is no one offset curve


def judge_uncut(contour, path):
    """The manual goes round an outer corner by the meeting of the two offset lines (12.4.1), not on an arc: GEOS' mitre does so, too. What only an
    arc could reach in the inner corner behind is not asked for."""
    r = contour.radius
    if contour.inside:
        reach = contour.part.buffer(-r, resolution=64, join_style=2, mitre_limit=10)
        if reach.is_empty:  # as wide as the tool
            reach = contour.part.buffer(-r + TOLERANCE, resolution=64)
        if reach.is_empty:
            return "inside of a contour that the tool does not fit into, without an alarm"
        pieces = list(reach.geoms) if reach.geom_type == "MultiPolygon" else [reach]
        start = contour.elements[0].at(0)
        side = 1 if contour.inside != contour.backwards else -1
        center = Point(start[0][0] - side * start[1][1] * r, start[0][1] + side * start[1][0] * r)
        curve = min(pieces, key=lambda piece: piece.distance(center)).exterior
    else:
        curve = contour.part.buffer(r, resolution=64, join_style=2, mitre_limit=10).exterior
    worst = 0.0
    for element in contour.elements:
        for part in (0.1, 0.5, 0.9):
            point = Point(element.at(part)[0]) if element.length() > 0 else Point(element.start)
            if curve.distance(point) > r + 2 * SAGITTA:
                continue
            worst = max(worst, path.distance(point) - r)
    buffer_error = r * (1 - math.cos(math.pi / 256))
    if worst > TOLERANCE + buffer_error + 2 * SAGITTA:
        return f"uncut by {worst:.4f} mm"
    return None


def main():
    ncsim = os.path.join(os.environ.get("NC_BINARY_DIR", "build/release"), "bin", "ncsim")
    count, first = int(os.environ.get("NC_CONTOURS", "200" if os.environ.get("NC_SANITIZE") else "10000")), int(os.environ.get("NC_FIRST_SEED", "1"))
    show = os.environ.get("NC_SHOW")
    alarms, alarmed, wrong, kinds = {}, {}, {}, {}
    with tempfile.TemporaryDirectory() as folder:
        for from_seed in range(first, first + count, 500):
            contours = [Contour(seed) for seed in range(from_seed, min(from_seed + 500, first + count))]
            for contour, result in zip(contours, run_all(ncsim, [c.blocks() for c in contours], folder)):
                kinds[contour.kind] = kinds.get(contour.kind, 0) + 1
                if result.alarm:
                    alarms[result.alarm] = alarms.get(result.alarm, 0) + 1
                    alarmed[contour.kind] = alarmed.get(contour.kind, 0) + 1
                    continue
                bad = judge(contour, result)
                if bad:
                    what = bad.split(" by ")[0].split(" of ")[0]
                    wrong[what] = wrong.get(what, 0) + 1
                    if show or sum(wrong.values()) <= 10:
                        print(f"seed {contour.seed} ({contour.kind}, {'inside' if contour.inside else 'outside'}, r {contour.radius}): {bad}")
                    if show:
                        print("\n".join(contour.blocks()))
        tried = [Contour(seed) for seed in range(first, first + count, int(os.environ.get("NC_EVERY", "20")))]
        results = run_all(ncsim, [c.blocks() for c in tried], folder)
        for way in [*TRANSFORMS, "back"]:
            programs = [run_backwards(c) if way == "back" else transformed(c.blocks(), way) for c in tried]
            for contour, result, other in zip(tried, results, run_all(ncsim, programs, folder)):
                if way == "back" and (contour.corners or contour.depth or contour.other or contour.along):
                    continue  # their words stand at other blocks then, and along its sides the tool comes from the other end
                bad = follows(result, other, TRANSFORMS.get(way, lambda p: p), way)
                if bad:
                    wrong[way] = wrong.get(way, 0) + 1
                    if sum(wrong.values()) <= 10 or show:
                        print(f"seed {contour.seed} ({contour.kind}, r {contour.radius}), {way}: {bad}")
    shares = {kind: alarmed.get(kind, 0) / of for kind, of in kinds.items()}
    print(f"{count} contours {kinds}: {sum(alarms.values())} end in an alarm {alarms}, of each kind {', '.join(f'{k} {share:.0%}' for k, share in shares.items())}; wrong {wrong}")
    for kind, share in shares.items():
        if kinds[kind] >= 100 and share > MOST_ALARMS[kind]:
            wrong["alarms"] = 1
            print(f"{kind}: more than {MOST_ALARMS[kind]:.0%} end in an alarm")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
