# SPDX-License-Identifier: Apache-2.0
"""Contours as CAM systems write them (for oracle_test.py): other ways in than out, several tools, changes of side.

The way in and the way out of a profile are drawn each for itself: lines at right angles, aslant, along the contour; arcs of any angle with a line that
is radial, tangent, or has a piece under compensation in front of a turn; whole turns of a helix; the depth on a ramp, along the arc, or by a plunge
between them; rapid, with a vector that I J give (12.4.3), of type A or B (12.4.1). The tool comes round a piece beyond its start, or cuts first
with an allowance and another offset number, or has a negative amount and the other code, or changes the side in the middle of its contour, or reads the
machine between its blocks.
"""
import copy
import math
import random

from shapely.geometry import Point

import contours
from contours import SAGITTA, Element, rounded, tangent_at

READS = ["#100=#5041", "#100=#5021+#5022", "#100=#1000", "#100=#3001", "IF[#1001 EQ 5]GOTO9"]
KINDS = ["normal", "aslant", "along", "radial", "tangent", "turned"]


class Lead:
    """A way in or out. In its own axes the contour begins at 0,0, x leads away along it and y to the side of the tool; pieces from there outwards."""

    def __init__(self, rng, radius, corner):
        self.kind = rng.choice([kind for kind in KINDS if corner or kind != "along"])
        self.arc = self.kind in KINDS[3:]
        far = rng.uniform(1.05, 2.5) * radius
        w, angle = rng.uniform(1.05, 2.5) * radius, rng.choice([90.0, rng.uniform(20, 160), rng.uniform(20, 160)]) * math.pi / 180
        short = rng.uniform(1.05, 2) * radius
        self.pieces = []  # (end, centre or None)
        if self.kind == "normal":
            self.pieces = [((0, far), None)]
        elif self.kind == "aslant":
            slope = rng.uniform(-0.9, 0.9)
            self.pieces = [((far * math.sin(slope), far * math.cos(slope)), None)]
        elif self.kind == "along":
            self.pieces = [((short, 0), None), ((short, far), None)]
        else:
            x, y, (c, s) = w * math.sin(angle), w * (1 - math.cos(angle)), (math.cos(angle), math.sin(angle))
            self.pieces = [((x, y), (0, w))]
            if self.kind == "radial":
                self.pieces.append(((x - s * far, y + c * far), None))
            elif self.kind == "tangent":
                self.pieces.append(((x + c * far, y + s * far), None))
            else:
                x, y = x + c * short, y + s * short
                self.pieces += [((x, y), None), ((x - s * far, y + c * far), None)]
        self.turn = self.arc and rng.random() < 0.25  # a whole turn in front of the arc
        self.descent = rng.choice(["line", "arc" if self.arc else "line", "plunge"])
        self.idle = rng.choice([[], [], ["M8"], ["S1000", "M3"]])
        self.rapid, self.vector = rng.random() < 0.15, rng.random() < 0.15

    def world(self, point, u, side, sense):
        """Points of the pieces about the point of the contour; `sense`: -1 in front of it, 1 behind it."""
        def place(p):
            return rounded((point[0] + sense * p[0] * u[0] - side * p[1] * u[1], point[1] + sense * p[0] * u[1] + side * p[1] * u[0]))

        return [(place(end), center and place(center)) for end, center in self.pieces]


class Profile(contours.Contour):
    def __init__(self, seed):
        rng = random.Random(f"profile {seed}")
        self.seed = seed
        elements = self.draw(rng)
        self.kind = "cam " + self.kind
        i, part = self.place(rng, elements)
        corner = self.kind == "cam circle" or elements[i].length() < 0.01 or rng.random() < 0.3
        self.start_at(elements, i, 0 if corner else part)
        self.corners, self.along, self.depth, self.other, self.way = {}, 0.0, 0.0, None, 0.0
        self.level = rng.choice([0.0, 2.5])
        self.cut_corners(rng)
        if rng.random() < 0.5 and not self.corners:
            self.backwards = True
            self.elements = self.programmed = [Element(e.end, e.start, e.center, not e.ccw) for e in reversed(self.elements)]
        self.cross = None  # block from which on the tool is on the other side
        if not self.corners and len(self.programmed) > 2 and rng.random() < 0.25:
            self.cross = rng.randint(1, len(self.programmed) - 1)
        self.beyond = 0.0  # part of the first element that is cut once more
        if self.cross is None and not self.corners and rng.random() < 0.25 and self.programmed[0].length() > 0.1:
            self.beyond = rng.choice([0.2, 0.6])
        self.number = rng.randint(1, 9)
        self.cuts = [(self.number, self.radius)]
        if self.cross is None and rng.random() < 0.25:
            self.cuts.insert(0, (self.number % 9 + 1, round(self.radius * rng.uniform(1, 1.3), 3)))
        self.reads = rng.choice(READS) if rng.random() < 0.2 and not self.corners else ""  # between the blocks of the contour; no movement depends on what it gives
        self.negative, self.type_b = rng.random() < 0.15, rng.random() < 0.3
        self.approach, self.depart = (self.lead_with_room(rng, corner, end) for end in (False, True))

    def left_at(self, block):
        """Is the tool to the left of this block?"""
        inside = self.inside != (self.cross is not None and block >= self.cross)
        return inside != self.backwards

    def end_point(self):
        """Point and tangent of the contour where the tool leaves it."""
        if self.beyond:
            point, u = self.programmed[0].at(self.beyond)
            return rounded(point), u
        return self.programmed[-1].end, tangent_at(self.programmed, True)

    def lead_points(self, lead, end):
        point, u = self.end_point() if end else (self.programmed[0].start, tangent_at(self.programmed, False))
        side = 1 if self.left_at(len(self.programmed) - 1 if end else 0) else -1
        return lead.world(point, u, side, 1 if end else -1)

    def lead_with_room(self, rng, corner, end):
        """The first of some in whose arc and place outside the tool does not touch the part, or the last."""
        for _ in range(12):
            lead = Lead(rng, max(radius for _, radius in self.cuts), corner)
            points = self.lead_points(lead, end)
            centers = [(Point(center), math.dist(center, points[0][0])) for _, center in points if center] + [(Point(points[-1][0]), self.radius)]
            if all(self.part.exterior.distance(center) >= room - 2 * SAGITTA for center, room in centers):
                break
        return lead

    def ends(self):
        """Where the first way in begins and the last way out ends."""
        return self.lead_points(self.approach, False)[-1][0], self.lead_points(self.depart, True)[-1][0]

    def code(self, block):
        return "G41" if self.left_at(block) != self.negative else "G42"

    def blocks(self):
        sign = -1 if self.negative else 1
        lines = [f"!1229/bit2 {int(self.type_b)}"]
        lines += [f"G10 L10 P{number} R{sign * radius:.6f}" for number, radius in self.cuts]
        self.spans = []  # lines from the one with the start of compensation up to that of its cancel, counted from the first of these
        for number, _ in self.cuts:
            out = self.lead_points(self.approach, False)
            lines.append(f"G0 X{out[-1][0][0]:.6f} Y{out[-1][0][1]:.6f} Z0")
            start = len(lines)
            self.come(lines, number, out)
            lines_of = self.go_round(lines)
            self.leave(lines, self.lead_points(self.depart, True))
            self.spans.append((start, len(lines)))
        begin = self.spans[0][0]
        self.lines_of = [line - begin for line in lines_of]  # of the elements, in the last round
        self.spans = [(first - begin, behind - begin) for first, behind in self.spans]
        return lines

    def arc(self, left, begin, end, center, down=""):
        return f"G{3 if left else 2} X{end[0]:.6f} Y{end[1]:.6f} I{center[0] - begin[0]:.6f} J{center[1] - begin[1]:.6f}{down}"

    def come(self, lines, number, out):
        lead, left = self.approach, self.left_at(0)
        path = [end for end, _ in reversed(out)] + [self.programmed[0].start]  # from outside to the contour
        centers = [center for _, center in reversed(out)]
        down = f" Z{-self.level:.3f}" if self.level else ""
        ramp = down if lead.descent == "line" else ""
        u = tangent_at(self.programmed, False) if len(out) == 1 else (path[2][0] - path[1][0], path[2][1] - path[1][1])
        vector = f" I{u[0]:.6f} J{u[1]:.6f}" if lead.vector and (len(out) == 1 or centers[1] is None) and math.hypot(*u) > 0.01 else ""
        lines.append(f"G{0 if lead.rapid else 1} {self.code(0)} D{number} X{path[1][0]:.6f} Y{path[1][1]:.6f}{ramp}{vector} F1000")
        lines.extend(lead.idle)
        if down and lead.descent == "plunge":
            lines.append(f"G1{down}")
        for i in range(1, len(out)):
            begin, end, center = path[i], path[i + 1], centers[i]
            if center is None:
                lines.append(f"G1 X{end[0]:.6f} Y{end[1]:.6f}")
                continue
            deep = down if lead.descent == "arc" else ""
            if lead.turn:
                lines.append(self.arc(left, begin, begin, center, deep and f" Z{-self.level / 2:.3f}"))
            lines.append(self.arc(left, begin, end, center, deep))

    def go_round(self, lines):
        lines_of = []
        for i, e in enumerate(self.programmed):
            change = f"{self.code(i)} " if i == self.cross else ""
            corner = f" {self.corners[i]}" if i in self.corners else ""
            if change and e.center:  # not in the block of an arc: App.1 P151
                lines.append(f"G1 {change.strip()}")
                change = ""
            lines_of.append(len(lines))
            lines.append(change + (self.arc(e.ccw, e.start, e.end, e.center) if e.center else f"G1 X{e.end[0]:.6f} Y{e.end[1]:.6f}") + corner)
            if self.reads:
                lines.append(self.reads)
        if self.beyond:
            e, end = self.programmed[0], self.end_point()[0]
            lines.append(self.arc(e.ccw, e.start, end, e.center) if e.center else f"G1 X{end[0]:.6f} Y{end[1]:.6f}")
        return lines_of

    def leave(self, lines, out):
        lead, left = self.depart, self.left_at(len(self.programmed) - 1)
        begin = self.end_point()[0]
        up = " Z0" if self.level else ""
        for i, (end, center) in enumerate(out):
            if center:
                deep = up if lead.descent == "arc" else ""
                lines.append(self.arc(left, begin, end, center, deep and f" Z{-self.level / 2:.3f}" if lead.turn else deep))
                if lead.turn:
                    lines.append(self.arc(left, end, end, center, deep))
            elif i + 1 < len(out):
                lines.append(f"G1 X{end[0]:.6f} Y{end[1]:.6f}")
            else:
                if up and lead.descent == "plunge":
                    lines.append(f"G1{up}")
                lines.extend(lead.idle)
                lines.append(f"G{0 if lead.rapid else 1} G40 X{end[0]:.6f} Y{end[1]:.6f}{up}")
            begin = end

    def changes_at(self):
        return None if self.cross is None else [self.cross - 1, self.cross]

    def reversible(self):
        return not (self.corners or self.beyond or len(self.cuts) > 1 or self.approach.vector or self.depart.vector)

    def reversed_copy(self):
        back = copy.copy(self)
        back.elements = back.programmed = [Element(e.end, e.start, e.center, not e.ccw) for e in reversed(self.programmed)]
        back.approach, back.depart = self.depart, self.approach
        back.backwards = not self.backwards
        if self.cross is not None:
            back.cross, back.inside = len(self.programmed) - self.cross, not self.inside
        return back
