#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes a path file from an NC program: its moves as `ncsim trace` gives them, with corners rounded within a tolerance.

usage: path_from_program.py [--tolerance MM] [--blend cubic|parabola|none] [--limits V,A,J] PROGRAM OUT.path

Between two rests (rapids, exact stops, dwells, auxiliary functions) the moves are one polyline, with arcs sampled finely. `cubic` rounds each
sharp corner that stands alone by a curve on which the motion in the one direction stops while that in the other starts, both with constant
jerk. The rest of the polyline becomes a uniform cubic B-spline, whose curvature is continuous. Its control points lie on the polyline, as far
apart as the tolerance allows: with control points a distance h apart the curve is |P- - 2P + P+| / 6 away from the point P. The distance h
grows slowly away from a corner, so that a straight stretch stays on its line. The result is measured, and made finer where it is too far away.
Then the control points are moved within the tolerance to where the third derivative is least.
`parabola` rounds every corner by a parabola that takes at most half of the shorter line beside it. Its curvature has steps, so it is for limits
without jerk. A stretch that consists of a single move stays the line or arc that it is.
"""
import argparse
import json
import math
import os
import re
import subprocess
import sys

import numpy as np
from scipy import sparse

import path_file
from quadratic import solve_program

CHORD_MM = 1e-5  # the chords of a sampled arc are at most this far from it
USED = 0.9  # part of the tolerance that the first try aims at
FARTHEST_MM = 8.0  # largest distance of two control points
GROWTH = 0.35  # their distance grows by at most this much per mm of path
TRIES = 40
SHARP = 0.5  # a corner at which the unit direction changes by more than this can be rounded by itself
ROOM = 0.45  # such a corner takes at most this part of each line beside it
STRAIGHT = 1e-9  # a point at which the direction changes by less than this is no corner


def trace(ncsim, program, setup=None):
    command = [ncsim, "trace"] + (["--setup", setup] if setup else []) + [program]
    done = subprocess.run(command, capture_output=True, text=True)
    events = [json.loads(line) for line in done.stdout.splitlines()]
    if done.returncode != 0:
        raise path_file.PathError(f"{program}: ncsim trace ends with {done.returncode}: {done.stderr.strip()[-200:]}")
    return events


def exact_stop_lines(program):
    """Lines (from 1) whose block ends with an exact stop: G61 and G61.1 until G62, G63 or G64, and G09."""
    out, modal = set(), False
    with open(program, encoding="latin-1") as lines:
        for number, text in enumerate(lines, 1):
            codes = [float(c) for c in re.findall(r"G\s*(\d+(?:\.\d+)?)", re.sub(r"\(.*?\)|;.*", "", text))]
            for code in codes:
                if code in (61, 61.1):
                    modal = True
                elif code in (62, 63, 64):
                    modal = False
            if modal or 9 in codes:
                out.add(number)
    return out


class Move:
    """A straight or circular move in machine coordinates; feed in mm/s, 0 = rapid."""

    def __init__(self, feed, start, end, arc=None):
        self.feed, self.start, self.end, self.arc = feed, np.array(start), np.array(end), arc  # arc: a, b, ca, cb, sweep

    def points(self):
        """The points of the move's polyline without its start."""
        if self.arc is None:
            return [self.end]
        a, b, ca, cb, sweep = self.arc
        r0 = math.hypot(self.start[a] - ca, self.start[b] - cb)
        r1 = math.hypot(self.end[a] - ca, self.end[b] - cb)
        count = max(2, math.ceil(abs(sweep) / (2 * math.acos(max(-1.0, 1 - CHORD_MM / max(r0, r1, 1e-3))))))
        angle = math.atan2(self.start[b] - cb, self.start[a] - ca)
        out = []
        for k in range(1, count):
            share = k / count
            point = self.start + share * (self.end - self.start)
            radius = r0 + share * (r1 - r0)
            point[a], point[b] = ca + radius * math.cos(angle + share * sweep), cb + radius * math.sin(angle + share * sweep)
            out.append(point)
        return out + [self.end]


def moves_of(events, axes, exact, start):
    """Two lists: the moves [Move, ...] between two rests, and for the rest behind each of them [seconds, whether it is exact]."""
    groups, rests, at, turns = [[]], [[0.0, False]], np.array(start, dtype=float), 0.0  # turns: spindle speed, rev/min

    def rest(seconds=0.0, exact_there=True):
        if groups[-1]:
            groups.append([])
            rests.append([0.0, False])
        if len(groups) > 1:
            rests[-2][0] += seconds
            rests[-2][1] |= exact_there

    for event in events:
        if event["t"] in ("aux", "sync"):
            rest()
            if event.get("code") == "S":
                turns = event["value"]
        elif event["t"] == "dwell":
            rest(event.get("seconds", 0.0))
        if event["t"] != "move":
            continue
        end = np.array([event["machine"][a] for a in axes], dtype=float)
        rapid = event["kind"] == "rapid"
        if event["kind"] not in ("rapid", "line", "arc", "helix"):
            raise path_file.PathError(f"line {event['line']}: a move of kind {event['kind']} is not known here")
        arc = None
        if event["kind"] in ("arc", "helix"):
            if "plane" not in event:
                raise path_file.PathError(f"line {event['line']}: an arc in no plane of the axes is not known here")
            names = event["plane"]
            a, b = axes.index(names[0]), axes.index(names[1])
            ca, cb = event["machine_center"][names[0]], event["machine_center"][names[1]]
            sweep = math.atan2(end[b] - cb, end[a] - ca) - math.atan2(at[b] - cb, at[a] - ca)
            if event["dir"] == "ccw":
                sweep = sweep if sweep > 1e-9 else sweep + 2 * math.pi
                sweep += 2 * math.pi * event.get("turns", 0) * (1 if sweep < 2 * math.pi - 1e-9 else 0)
            else:
                sweep = sweep if sweep < -1e-9 else sweep - 2 * math.pi
                sweep -= 2 * math.pi * event.get("turns", 0) * (1 if sweep > -2 * math.pi + 1e-9 else 0)
            arc = (a, b, ca, cb, sweep)
        feed = 0.0 if rapid else (event["feed_rev"] * turns if event["feed"] is None else event["feed"]) / 60.0
        if rapid:
            rest(exact_there=False)
        groups[-1].append(Move(feed, at, end, arc))
        if rapid or event["line"] in exact:
            rest(exact_there=not rapid)
        at = end
    if not groups[-1]:
        groups.pop()
        rests.pop()
    return groups, rests


def without_reversals(groups, rests):
    """The same groups and rests, with another rest where a line turns back: the axes must stand there in any case."""
    out, between = [], []
    for moves, rest in zip(groups, rests):
        first = 0
        for k in range(1, len(moves)):
            if moves[k - 1].arc is None and moves[k].arc is None:
                a, b = moves[k - 1].end - moves[k - 1].start, moves[k].end - moves[k].start
                if a @ b < -(1 - 1e-9) * np.linalg.norm(a) * np.linalg.norm(b):
                    out.append(moves[first:k])
                    between.append([0.0, False])
                    first = k
        out.append(moves[first:])
        between.append(rest)
    return out, between


class Polyline:
    """The points of a polyline (no two of them at the same place), the lengths up to them, and the feeds of its lines."""

    def __init__(self, points, feeds):
        self.points, self.feeds = np.array(points), np.array(feeds)
        step = np.diff(self.points, axis=0)
        self.step = np.linalg.norm(step, axis=1)
        self.s = np.concatenate([[0], np.cumsum(self.step)])

    @classmethod
    def of(cls, moves):
        points, feeds = [moves[0].start], []
        for move in moves:
            for p in move.points():
                if np.linalg.norm(p - points[-1]) > 1e-9:
                    points.append(p)
                    feeds.append(move.feed)
        return cls(points, feeds)

    def at(self, s):
        s = np.clip(s, 0, self.s[-1])
        i = np.clip(np.searchsorted(self.s, s, "right") - 1, 0, len(self.step) - 1)
        return self.points[i] + ((s - self.s[i]) / self.step[i])[:, None] * (self.points[i + 1] - self.points[i])

    def feed_at(self, s):
        return self.feeds[np.clip(np.searchsorted(self.s, s, "right") - 1, 0, len(self.step) - 1)]

    def distance(self, points, near, reach):
        """Distance of each point to the stretch of the polyline around the length `near`."""
        low = np.searchsorted(self.s, near - reach, "right") - 1
        high = np.searchsorted(self.s, near + reach, "left")
        best = np.full(len(points), np.inf)
        for k in range(int((high - low).max()) + 1):
            i = np.clip(low + k, 0, len(self.step) - 1)
            d = self.points[i + 1] - self.points[i]
            t = np.clip(np.sum((points - self.points[i]) * d, axis=1) / self.step[i] ** 2, 0, 1)
            best = np.where(low + k <= np.maximum(high, low), np.minimum(best, np.linalg.norm(self.points[i] + t[:, None] * d - points, axis=1)), best)
        return best


def spacing_limit(line, places, tolerance):
    """The largest allowed distance of control points at each place, up to which |P(s-h) - 2 P(s) + P(s+h)| <= 6 tolerance for every h."""
    here = line.at(places)
    out = np.full(len(places), FARTHEST_MM)
    h = FARTHEST_MM
    sizes = []
    while h > 1e-4:
        sizes.append(h)
        h *= 0.87
    for h in sizes:
        # places beyond an end of the line do not count
        left, right = line.at(places - h), line.at(places + h)
        second = np.linalg.norm(left - 2 * here + right, axis=1)
        inside = (places - h >= 0) & (places + h <= line.s[-1])
        out = np.where(inside & (second > 6 * tolerance), np.minimum(out, h * 0.87), out)
    return out


def control_points(line, tolerance, scale):
    """The control points as lengths along the polyline. `scale` = (places, factors) makes their distances smaller where the last try was too far
    away."""
    total = line.s[-1]
    steps = max(2, int(math.ceil(total / 0.05)))
    places = np.unique(np.concatenate([line.s, np.linspace(0, total, min(steps, 400_000))]))
    h = spacing_limit(line, places, USED * tolerance) * np.interp(places, *scale)
    for order in (range(1, len(h)), range(len(h) - 2, -1, -1)):  # limit the change of the distance, forward and backward
        for i in order:
            j = i - 1 if order.step == 1 else i + 1
            h[i] = min(h[i], h[j] + GROWTH * abs(places[i] - places[j]))
    corner = np.searchsorted(places, line.s[1:-1])
    sharp = h[corner] < 0.5 * np.minimum(line.step[:-1], line.step[1:])
    sharp[[0, -1]] = True  # the curve leaves and arrives along the first and the last piece
    anchors = np.concatenate([[0.0], line.s[1:-1][sharp], [total]])
    need = np.concatenate([[0], np.cumsum(np.diff(places) / ((h[:-1] + h[1:]) / 2))])
    at_anchor = np.interp(anchors, places, need)
    out = [0.0]
    for i in range(len(anchors) - 1):
        count = max(2 if len(anchors) > 2 else 4, math.ceil(at_anchor[i + 1] - at_anchor[i]))
        out += list(np.interp(np.linspace(at_anchor[i], at_anchor[i + 1], count + 1)[1:], need, places))
    return np.array(out)


SPLINE = np.array([[1, 4, 1, 0], [-3, 0, 3, 0], [3, -6, 3, 0], [-1, 3, -3, 1]]) / 6  # power basis of four control points


def controls_on(line, s):
    """Control points at the lengths s of the polyline. One more at each end makes the curve begin and end where the polyline does, without
    curvature."""
    p = line.at(s)
    return np.concatenate([[2 * p[0] - p[1]], p, [2 * p[-1] - p[-2]]])


def spline_pieces(p):
    """Coefficients (pieces, power, axes)."""
    return np.stack([np.tensordot(SPLINE, p[i:i + 4], axes=1) for i in range(len(p) - 3)])


INSIDE = (0.0, 0.25, 0.5, 0.75)  # places of a piece at which relax() looks


def relax(line, s, p, tolerance):
    """Moves the control points p to where the third derivative of the curve (by length, sum of squares) is least, within a box around the path.

    Even if the vertices lie on a smooth curve, the polyline between them is not smooth, and neither is a spline with its control points on it.
    """
    free = np.arange(3, len(p) - 3)
    if len(free) == 0:
        return p
    h = np.diff(s)
    weight = np.repeat(h[:, None] ** -2.5, 4, axis=1)
    rows = np.repeat(np.arange(len(h)), 4)
    columns = (np.arange(len(h))[:, None] + np.arange(4)).ravel()
    third = sparse.csc_matrix(((weight * np.array([-1, 3, -3, 1])).ravel(), (rows, columns)), shape=(len(h), len(p)))
    scale = np.abs(third).max()
    third = third / scale
    moved = np.any(np.abs(np.diff(p, 3, axis=0)) > 1e-9, axis=0)
    box = tolerance / math.sqrt(max(1, int(moved.sum())))
    looks = sparse.vstack([sparse.csc_matrix((np.tile(np.array([u ** k for k in range(4)]) @ SPLINE, len(h)), (rows, columns)), shape=third.shape)
                           for u in INSIDE])
    out = p.copy()
    near = np.concatenate([line.at(s[:-1] + u * h) for u in INSIDE])
    own = looks @ p
    for k in np.flatnonzero(moved):
        # The box is around the polyline. Where the curve through p cuts a corner by more than the box, it may stay as far away, but not farther.
        low, high = np.minimum(near[:, k] - box, own[:, k]), np.maximum(near[:, k] + box, own[:, k])
        fixed = np.setdiff1d(np.arange(len(p)), free)
        part = looks[:, free]
        shift = looks[:, fixed] @ p[fixed, k]
        used = np.flatnonzero(np.abs(part).max(axis=1).toarray().ravel() > 0)
        origin = part @ p[free, k]  # the unknowns are movements, as parts of the box
        t = third[:, free] * box
        q = t.T @ (third @ p[:, k])
        bounds = np.concatenate([(high - shift - origin)[used], -(low - shift - origin)[used]]) / box
        matrix = sparse.vstack([part[used], -part[used]])
        out[free, k] += box * solve_program(sparse.triu(t.T @ t).tocsc(), q, matrix, np.maximum(bounds, 0), 0)
    return out


def turn(point, d, e, feed, reach):
    """Rounds a sharp corner: while the motion along d ends as a cube of time, the motion along e begins as one. Both have constant jerk, and the
    curve has no curvature at its ends. It stays within |e - d| reach / 8 of the corner."""
    before, after = -reach * d, reach * e
    return np.array([point + before, -3 * before, 3 * before, after - before]).T, feed


def blend_cubic(line, tolerance):
    """(coefficients, feed) of each piece: turn() rounds the sharp corners that stand alone, a spline all that is between them."""
    d = np.diff(line.points, axis=0) / line.step[:, None]
    sharpness = np.linalg.norm(np.diff(d, axis=0), axis=1)
    reach = 8 * tolerance / np.maximum(sharpness, 1e-12)
    alone = (sharpness > SHARP) & (reach < ROOM * np.minimum(line.step[:-1], line.step[1:]))
    corners = np.flatnonzero(alone) + 1
    out, begin, first = [], line.points[0], 0
    for k in [*corners, len(line.step)]:
        last = k == len(line.step)
        end = line.points[k] if last else line.points[k] - reach[k - 1] * d[k - 1]
        part = Polyline([begin, *line.points[first + 1:k], end], line.feeds[first:k])
        if len(part.step) == 1:
            out.append((np.array([begin, end - begin]).T, part.feeds[0]))
        else:
            out += blend_spline(part, tolerance)
        if not last:
            out.append(turn(line.points[k], d[k - 1], d[k], feed_of_both(line.feeds[k - 1], line.feeds[k]), reach[k - 1]))
            begin, first = line.points[k] + reach[k - 1] * d[k], k
    return out


def feed_of_both(a, b):
    """The lower one of two feeds; 0 means no limit."""
    return min(a, b) if a > 0 and b > 0 else max(a, b)


def distances(line, s, c, tolerance):
    """For each piece its largest distance from the polyline near it."""
    u = np.linspace(0, 1, 9)
    points = np.einsum("up,spa->sua", u[:, None] ** np.arange(4), c).reshape(-1, c.shape[2])
    h = np.diff(s)
    near = (s[:-1, None] + np.outer(h, u)).ravel()
    reach = np.repeat(2 * np.maximum(h, np.maximum(np.append(h[1:], 0), np.append(0, h[:-1]))), len(u)) + 2 * tolerance
    return line.distance(points, near, reach).reshape(-1, len(u)).max(axis=1)


def blend_spline(line, tolerance):
    """A B-spline whose measured distance from the polyline is within the tolerance."""
    scale = (np.array([0.0, line.s[-1]]), np.ones(2))
    for _ in range(TRIES):
        s = control_points(line, tolerance, scale)
        p = controls_on(line, s)
        c = spline_pieces(p)
        off = distances(line, s, c, tolerance)
        if off.max() <= tolerance:
            break
        middle = (s[:-1] + s[1:]) / 2
        factor = np.where(off > tolerance, np.sqrt(0.8 * tolerance / np.maximum(off, 1e-12)), 1.0)
        factor = np.minimum(factor, np.minimum(np.append(factor[1:], 1), np.append(1, factor[:-1])))
        scale = (middle, np.interp(middle, *scale) * factor)
    else:
        raise path_file.PathError(f"the tolerance of {tolerance} is not reached: {off.max():.6f}")
    for share in (0.95, 0.85, 0.7, 0.5):
        try:
            relaxed = spline_pieces(relax(line, s, p, share * tolerance))
        except RuntimeError:  # keep the spline whose control points lie on the polyline
            break
        if distances(line, s, relaxed, tolerance).max() <= tolerance:
            c = relaxed
            break
    feeds = np.minimum(line.feed_at(s[:-1]), line.feed_at(s[1:] - 1e-9))
    feeds = np.minimum(feeds, np.minimum(line.feed_at(np.append(s[2:], s[-1]) - 1e-9), line.feed_at(np.append(0, s[:-2]))))
    return [(c[i].T, feeds[i]) for i in range(len(c))]


def blend_parabola(line, tolerance):
    out = []
    begin = line.points[0]
    for i in range(len(line.step)):
        a, b = line.points[i], line.points[i + 1]
        d = (b - a) / line.step[i]
        if i + 1 == len(line.step):
            out.append((np.array([begin, b - begin]).T, line.feeds[i]))
            break
        e = (line.points[i + 2] - b) / line.step[i + 1]
        turn = np.linalg.norm(e - d)
        cut = 0.5 * min(line.step[i], line.step[i + 1])
        if turn > STRAIGHT:
            cut = min(cut, 4 * tolerance / turn)
        enter, leave = b - cut * d, b + cut * e
        if np.linalg.norm(enter - begin) > 1e-9:
            out.append((np.array([begin, enter - begin]).T, line.feeds[i]))
        out.append((np.array([enter, 2 * (b - enter), enter - 2 * b + leave]).T, min(line.feeds[i], line.feeds[i + 1])))
        begin = leave
    return out


def path_of(program, ncsim, tolerance=0.01, blend="cubic", limits=None, setup=None):
    """The path of a program as a path_file.Path. With blend `none` it consists of the moves themselves."""
    events = trace(ncsim, program, setup)
    end = next(e for e in events if e["t"] == "end")
    axes = list(end["machine"])
    groups, rests = moves_of(events, axes, exact_stop_lines(program), [0.0] * len(axes))
    path = path_file.Path(axes, {a: limits for a in axes} if limits else None, tolerance)
    for moves, (dwell, exact) in zip(*without_reversals(groups, rests)):
        if blend == "none" or len(moves) == 1:
            for move in moves:
                if move.arc is None:
                    path.line(move.feed, move.start, move.end)
                else:
                    path.arc(move.feed, *move.arc, move.start, move.end)
        else:
            line = Polyline.of(moves)
            for coefficients, feed in (blend_cubic if blend == "cubic" else blend_parabola)(line, tolerance):
                path.poly(feed, coefficients.tolist())
        path.stop(dwell, exact)
    return path


def main():
    from reference import parse_limits
    import peer_path
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("out")
    parser.add_argument("--ncsim", default=None)
    parser.add_argument("--setup", default=None)
    parser.add_argument("--tolerance", type=float, default=0.01)
    parser.add_argument("--blend", choices=("cubic", "parabola", "none"), default="cubic")
    parser.add_argument("--limits", type=parse_limits, default=None)
    options = parser.parse_args()
    try:
        path = path_of(options.program, peer_path.ncsim(options.ncsim), options.tolerance, options.blend, options.limits, options.setup)
        path.write(options.out)
    except (OSError, path_file.PathError) as error:
        sys.exit(f"{os.path.basename(sys.argv[0])}: {error}")
    print(f"{len(path.pieces)} pieces, {len(path.stops)} rests")


if __name__ == "__main__":
    main()
