# SPDX-License-Identifier: Apache-2.0
"""Random closed contours of lines and arcs, each with a way in and a way out, as programs with radius compensation (for oracle_test.py)."""
import math
import random

import numpy
from shapely.geometry import LineString, Point, Polygon
from shapely.validation import make_valid

SAGITTA = 0.00025  # mm: how far the fine polygons leave their arcs
NO_DIRECTION = 0.0005  # mm: a shorter line goes along with the blocks around it


class Element:
    """A line, or an arc about `center` (None: line)."""

    def __init__(self, start, end, center=None, ccw=False, angle=None):
        self.start, self.end, self.center, self.ccw, self.angle = start, end, center, ccw, angle

    def sweep(self):
        """As given, or of an arc of at most a whole turn."""
        if self.angle is not None:
            return self.angle
        a = math.atan2(self.start[1] - self.center[1], self.start[0] - self.center[0])
        b = math.atan2(self.end[1] - self.center[1], self.end[0] - self.center[0])
        turn = (b - a) % (2 * math.pi) if self.ccw else -((a - b) % (2 * math.pi))
        return turn if abs(turn) >= 1e-12 else math.copysign(2 * math.pi, 1 if self.ccw else -1)

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
        part = numpy.arange(n + 1) / n
        angle, radius = math.atan2(self.start[1] - self.center[1], self.start[0] - self.center[0]) + sweep * part, r + (r_end - r) * part
        points = numpy.stack((self.center[0] + radius * numpy.cos(angle), self.center[1] + radius * numpy.sin(angle)), axis=1)
        points[0], points[-1] = self.start, self.end
        return points

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

    def distances(self, points):
        """How far each of the points (an array of two columns) is from the element, whose radius changes evenly with the angle where its ends lie at two."""
        start, end, points = numpy.array(self.start), numpy.array(self.end), numpy.asarray(points)
        if self.center is None:
            along = end - start
            length = float(along @ along)
            part = numpy.clip((points - start) @ along / length, 0, 1) if length > 0 else numpy.zeros(len(points))
            return numpy.hypot(*(points - start - part[:, None] * along).T)
        r, sweep = self.radius(), self.sweep()
        r_end = math.hypot(self.end[0] - self.center[0], self.end[1] - self.center[1])
        beside = points - numpy.array(self.center)
        first = math.atan2(self.start[1] - self.center[1], self.start[0] - self.center[0])
        turned = (math.copysign(1, sweep) * (numpy.arctan2(beside[:, 1], beside[:, 0]) - first)) % (2 * math.pi)
        of_ends = numpy.minimum(numpy.hypot(*(points - start).T), numpy.hypot(*(points - end).T))
        of_arc = numpy.abs(numpy.hypot(*beside.T) - (r + (r_end - r) * turned / abs(sweep)))
        return numpy.where(turned <= abs(sweep), numpy.minimum(of_arc, of_ends), of_ends)

    def split(self, part):
        point = rounded(self.at(part)[0])
        if self.center is None:
            return Element(self.start, point), Element(point, self.end)
        return Element(self.start, point, self.center, self.ccw), Element(point, self.end, self.center, self.ccw)


def tangent_at(elements, end):
    """Unit tangent of the contour where it begins, or ends (`end`): of a line of a nanometre there the last digit decides where it leads, so it is that of the first element
    behind it, or the last in front of it, that has a direction."""
    order = elements[::-1] if end else elements
    element = next((e for e in order if e.center or e.length() >= NO_DIRECTION), order[0])
    return element.at(1 if end else 0)[1]


def rounded(point):
    return (round(point[0], 6), round(point[1], 6))


def bulged(start, end, bulge):
    """Arc from start to end whose sweep is 4 atan(bulge)."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    k = (1 - bulge * bulge) / (4 * bulge)
    center = ((start[0] + end[0]) / 2 - k * dy, (start[1] + end[1]) / 2 + k * dx)
    return Element(start, end, rounded(center), bulge > 0)


def ring_of(elements):
    return numpy.concatenate([element.points()[:-1] for element in elements])


def area_of(ring):
    """Positive where the ring goes round counter-clockwise."""
    x, y = ring[:, 0] - ring[0, 0], ring[:, 1] - ring[0, 1]
    return 0.5 * float(numpy.dot(x, numpy.roll(y, -1)) - numpy.dot(y, numpy.roll(x, -1)))


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
    """Corner radii about that of the tool, convex or concave corners, at any angle."""
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
    return turned(rng, elements) if rng.random() < 0.7 else elements


def turned(rng, elements):
    """By any angle, with each word rounded to three, four or six digits: arcs of the tool's radius have it but for the last digit, and what touches does so but for that, too."""
    angle, digits = rng.uniform(-math.pi, math.pi), rng.choice([3, 4, 6])
    c, s = math.cos(angle), math.sin(angle)
    place = lambda p: (round(c * p[0] - s * p[1], digits), round(s * p[0] + c * p[1], digits))
    return [Element(place(e.start), place(e.end), e.center and place(e.center), e.ccw) for e in elements]


def fillets(rng, r):
    """A plate turned by any angle, its corners rounded by exactly the radius of the tool, or by the last digit less or more: of three digits, and of their centres, at that angle."""
    a, b, angle = rng.uniform(3, 30) + 2 * r, rng.uniform(3, 20) + 2 * r, rng.uniform(0, 2 * math.pi)
    radius = r + rng.choice([0, 0, 0, 0.0005, -0.0005, 0.003])

    def at(x, y):
        return rounded((x * math.cos(angle) - y * math.sin(angle), x * math.sin(angle) + y * math.cos(angle)))
    sides = [((a, radius - b), (a, b - radius)), ((a - radius, b), (radius - a, b)), ((-a, b - radius), (-a, radius - b)), ((radius - a, -b), (a - radius, -b))]
    centers = [(a - radius, b - radius), (radius - a, b - radius), (radius - a, radius - b), (a - radius, radius - b)]
    elements = []
    for i, (start, end) in enumerate(sides):
        elements.append(Element(at(*start), at(*end)))
        elements.append(Element(at(*end), at(*sides[(i + 1) % 4][0]), at(*centers[i]), True))
    return elements


def nearly_round(rng, r):
    """359.999 degrees and the chord that closes them."""
    radius = r * rng.choice([0.5, 1, 1.5, 4])
    a = rng.uniform(0, 2 * math.pi)
    gap = math.radians(rng.choice([0.001, 0.01, 1]))
    start = rounded((radius * math.cos(a), radius * math.sin(a)))
    end = rounded((radius * math.cos(a - gap), radius * math.sin(a - gap)))
    return [Element(start, end, (0.0, 0.0), True), Element(end, start)]


def scallops(rng, r):
    """A plate with half circles side by side on one side: cusps, whose tangents are opposite to the last digit, or to the digits of a CAM system."""
    x, elements = 0.0, []
    for _ in range(rng.randint(2, 5)):
        radius = round(r * rng.uniform(0.5, 6), 3)
        centers = [(x - radius, 20.0), (round(x - radius, 3), round(20 + rng.uniform(-5e-4, 5e-4), 4))]
        elements.append(Element(rounded((x, 20)), rounded((x - 2 * radius, 20)), rounded(rng.choice(centers)), True))
        x = elements[-1].end[0]
    return elements + polygon([(x, 20), (x, 0), (0, 0), (0, 20)])[:3]


def noses(rng, r):
    """A round nose that stands tangentially on a plate, or half circles side by side, turned by any angle and with each word rounded to three or four digits: cusps of a line
    and an arc, or of two arcs, whose two sides overlap or lie apart by what the last digits make."""
    if rng.random() < 0.3:
        exact = [(e.start, e.center, e.ccw) for e in scallops(rng, r)]
    else:
        radius = r * math.exp(rng.uniform(math.log(0.5), math.log(20)))
        wedge = 2 * math.sqrt(radius * r)
        right, left, bottom = wedge * rng.uniform(0.6, 3), r * rng.uniform(3, 8), -r * rng.uniform(2, 8)
        exact = [((right, 0), None, False), ((0, 0), (0, radius), True), ((0, 2 * radius), None, False), ((-left, 2 * radius), None, False), ((-left, bottom), None, False), ((right, bottom), None, False)]
        if rng.random() < 0.5:  # the arc first, then the line
            around = [((-x, y), center, ccw) for (x, y), center, ccw in exact]
            exact = [(around[(i + 1) % len(around)][0], *around[i][1:]) for i in reversed(range(len(around)))]
    angle, digits = rng.uniform(0, 2 * math.pi), rng.choice([3, 3, 4])

    def turned(p):
        return (math.cos(angle) * p[0] - math.sin(angle) * p[1], math.sin(angle) * p[0] + math.cos(angle) * p[1])

    def word(p):
        return (round(p[0], digits), round(p[1], digits))

    elements = []
    for i, (start, center, ccw) in enumerate(exact):
        start, end = turned(start), turned(exact[(i + 1) % len(exact)][0])
        if center is not None:
            to_center = word([b - a for a, b in zip(start, turned(center))])
            center = rounded([a + b for a, b in zip(word(start), to_center)])
        elements.append(Element(word(start), word(end), center, ccw))
    return elements


def flared(rng, r):
    """A slot end about as large as the tool, between two flares: outer corners beside an arc of which the tool's offset leaves next to nothing. In half of them the slot
    is in the part, in the others it is all that is not."""
    radius, half = round(r * rng.choice([1, 1.002, rng.uniform(0.95, 1.3)]), 3), math.radians(rng.choice([90, 90, rng.uniform(40, 90)]))
    corner = (radius * math.sin(half), -radius * math.cos(half))  # the arc lies below its centre 0, 0; the slot is open upwards
    flares = []
    for _ in range(2):
        way = half - math.radians(rng.uniform(1, 110))
        u, length, bend = (math.cos(way), math.sin(way)), r * rng.uniform(0.5, 8), rng.choice([0, 0, -0.3, -0.1, 0.1])
        chord = 2 * math.atan(bend)  # between the tangent at the corner and the chord
        end = rounded((corner[0] + length * math.cos(way + chord), corner[1] + length * math.sin(way + chord)))
        flares.append(bulged(rounded(corner), end, bend) if bend else Element(rounded(corner), end))
    mirrored = Element((-flares[1].end[0], flares[1].end[1]), (-flares[1].start[0], flares[1].start[1]), flares[1].center and (-flares[1].center[0], flares[1].center[1]), flares[1].ccw)
    bottom, far = [mirrored, Element(mirrored.end, flares[0].start, (0.0, 0.0), True), flares[0]], 12 * r + 20
    left, right = mirrored.start, flares[0].end
    if rng.random() < 0.5:
        return bottom + polygon([right, (far, right[1]), (far, far), (-far, far), (-far, left[1]), left])[:5]
    back = [Element(e.end, e.start, e.center, not e.ccw) for e in reversed(bottom)]
    return back + polygon([left, (-far, left[1]), (-far, -far), (far, -far), (far, right[1]), right])[:5]


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


def misses(a, b, of_a, of_b):
    """By how much the path `of_a` to the left of one block misses that `of_b` to the left of the one behind it, both lengthened; negative: they cross. An arc of two radii has at
    the corner that of its end there."""
    if a.center is None and b.center is None:
        return -1.0
    beside = [abs(math.dist(e.center, corner) - (of if e.ccw else -of)) if e.center else None for e, corner, of in ((a, a.end, of_a), (b, b.start, of_b))]
    if None not in beside:
        apart = math.dist(a.center, b.center)
        return max(apart - sum(beside), abs(beside[0] - beside[1]) - apart)
    (line, of_line), arc, left = ((a, of_a), b, beside[1]) if a.center is None else ((b, of_b), a, beside[0])
    ux, uy = line.at(0)[1]
    return abs((arc.center[1] - line.start[1]) * ux - (arc.center[0] - line.start[0]) * uy - of_line) - left


class Contour:
    only = None  # the kind of all contours of a class

    def __init__(self, seed):
        rng = random.Random(seed)
        self.seed = seed
        elements = self.draw(rng)
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

    def draw(self, rng):
        """Radius of the tool, shape of the part, side; gives the elements of the part."""
        self.radius = round(rng.choice([0.5, 1, 2, 3, 5, 8]) * rng.uniform(0.5, 1.2), 3)
        while True:
            kind = self.only or rng.choice(["star", "star", "star", "slot", "plate", "round", "star", "circle", "scallops", "flared", "noses", "fillets"])
            elements = {"star": lambda: star(rng), "slot": lambda: slot(rng, self.radius), "plate": lambda: rounded_plate(rng, self.radius), "round": lambda: nearly_round(rng, self.radius), "circle": lambda: circle(rng, self.radius), "scallops": lambda: scallops(rng, self.radius), "noses": lambda: noses(rng, self.radius), "flared": lambda: flared(rng, self.radius), "fillets": lambda: fillets(rng, self.radius)}[kind]()
            if any(e.start == e.end and e.center is None for e in elements):
                continue
            ring = ring_of(elements)
            if area_of(ring) <= 1e-3:
                continue
            self.part = Polygon(ring)
            if kind == "noses" and not self.part.is_valid:  # it overlaps itself at a cusp by what the last digits make
                pieces = make_valid(self.part)
                self.part = max(getattr(pieces, "geoms", [pieces]), key=lambda piece: piece.area)
                if abs(self.part.area - area_of(ring)) > 1e-3:
                    continue
            if self.part.is_valid:
                break
        self.kind = kind
        self.inside = rng.random() < 0.5
        if kind != "circle" and rng.random() < 0.4:
            elements = divide(rng, elements)
        return elements

    def place(self, rng, elements):
        """Number of an element and a part of its length, where the tool has room if there is such a place."""
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
                    return i, part
        return chosen

    def start_at(self, elements, i, part):
        """The elements from there on."""
        if part == 0:
            self.elements = elements[i:] + elements[:i]
        else:
            first, last = elements[i].split(part)
            self.elements = [last, *elements[i + 1:], *elements[:i], first]

    def begin(self, rng, elements):
        """Start of the contour, ways in and out."""
        side = 1 if self.inside else -1
        i, part = self.place(rng, elements)
        kind = rng.random()
        if elements[i].length() < 0.01 or self.kind == "circle" or (0.4 < kind < 0.6 and rng.random() < 0.6):  # from a corner
            part = 0
        self.start_at(elements, i, part)
        point, u = self.elements[0].start, tangent_at(self.elements, False)
        for far in (1.5, 1.2, 1.05, 1.0):  # where the tool stands before and behind has room, too
            self.lead = rounded((point[0] - side * u[1] * far * self.radius, point[1] + side * u[0] * far * self.radius))
            if self.part.exterior.distance(Point(self.lead)) >= self.radius - 2 * SAGITTA:
                break
        if 0.4 < kind < 0.6:
            self.along = round(rng.uniform(1.05, 3) * self.radius, 3)
            last, v = self.elements[-1].end, tangent_at(self.elements, True)
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
        return LineString(numpy.concatenate((points, points[:1])))

    def quarter(self, end):
        """The quarter circle by which the tool comes to the contour, or leaves it (`end`): its other end and its centre."""
        point, u = self.programmed[-1].end if end else self.programmed[0].start, tangent_at(self.programmed, end)
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
        start = next(number for number, line in enumerate(lines) if line.startswith(code))
        self.lines_of = [number - start for number in range(len(lines), len(lines) + len(self.programmed))]  # of the elements, in the last round, from the start of compensation on
        self.round(lines, 0)
        if self.way:
            last = self.programmed[-1].end
            end, center = self.quarter(True)
            lines.append(f"{sense} X{end[0]:.6f} Y{end[1]:.6f} I{center[0] - last[0]:.6f} J{center[1] - last[1]:.6f}{self.ramp and ' Z0'}")
        if self.along:
            lines.append(f"G1 X{self.between[1][0]:.6f} Y{self.between[1][1]:.6f}")
        lines.append(f"G1 G40 X{lead[0]:.6f} Y{lead[1]:.6f}{' Z0' if self.depth else ''}")
        return [block for line in lines for block in line.split("\n")]

    def changes_at(self):
        """The blocks beside a change of side, or the block in which the amount changes; None: nothing changes."""
        return [self.other[0]] if self.other else None

    def changes_in_a_tiny_line(self):
        """Half a micrometre does not scale: twice as long it may be a block, which has a side, or a corner with the new amount, of its own."""
        return self.changes_at() is not None and min(self.programmed[k].length() for k in self.changes_at()) < NO_DIRECTION

    def becomes_a_block(self):
        """Does a line without a direction, or what several of them in a row lead away, come to be a block when it is twice as long? Its corners then take the place of the one that it is a part of."""
        away = [0.0]
        for element in self.programmed * 2:
            away.append(away[-1] + element.length() if element.length() < NO_DIRECTION else 0.0)
        return any(NO_DIRECTION / 2 <= way + 1e-6 and way > 0 for way in away)

    def changes_from_a_point(self):
        """The amount changes along an arc that has the radius of the tool: its path leads away from its centre. To the last digit it begins there, without a direction, and is
        a line, or it begins beside it, and is a spiral."""
        return self.other is not None and any(e.center and abs(e.radius() - self.radius) < 2 * NO_DIRECTION for e in self.programmed[self.other[0]:self.other[0] + 1])

    def left_at(self, block):
        """Is the tool to the left of this block?"""
        return self.side() == "G41"

    def touches_by_a_digit(self):
        """Whether the paths beside the two blocks of a corner miss each other by no more than half a micrometre: they touch then, and twice as large they do not."""
        amounts = [self.radius if self.left_at(i) else -self.radius for i in range(len(self.programmed))]
        blocks = list(zip(self.programmed, amounts))
        corners = [(a, b) for a, b in zip(blocks, blocks[1:] + blocks[:1]) if a[1] != b[1] or math.dist(a[0].at(1)[1], b[0].at(0)[1]) > 0.01]
        return any(0 < misses(a, b, of_a, of_b) < NO_DIRECTION for (a, of_a), (b, of_b) in corners)

    def reversible(self):
        """Words of corners would stand at other blocks, and along its sides the tool comes from the other end."""
        return not (self.corners or self.depth or self.other or self.along)
