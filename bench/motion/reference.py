#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The shortest time for a path within the feeds and the limits of velocity, acceleration and jerk of every axis.

usage: reference.py [--no-jerk] [--limits V,A,J] [--step-ms S] [--csv FILE] PATH.path      (in the environment that ./setup makes)

Between two rests the path is a curve q(s) of its length. With b = v^2 and a = b'/2 (primes: by s) each axis has

    velocity^2 = q'^2 b,    acceleration = q'' b + q' a,    jerk = sqrt(b) (q''' b + 3 q'' a + q' a')

and the time is the integral of b^(-1/2), a convex function. Without jerk everything is linear in b. With it the jerk limit reads
|q''' b + 3 q'' a + q' a'| <= J b^(-1/2); its right side is convex, so its tangent at the last solution is a limit that is never too wide:
every step of the iteration keeps the true limits and is no slower than the one before (the convex-concave procedure; Debrouwere et al.,
Time-optimal path following for robots with convex-concave constraints, IEEE T-RO 29, 2013). A step is a sparse quadratic program
(Clarabel). In each cell of the grid a is linear and b quadratic; where the path starts and ends at rest b ~ s^(4/3), and the first and the
last cell are of constant jerk exactly. Cells take about --step-ms each, and no cell lies across a joint of two pieces.
"""
import argparse
import sys
from dataclasses import dataclass

import numpy as np
from scipy import sparse

import path_file
from quadratic import solve_program

REST_POWER = 6 ** (4 / 3) / 4  # b = REST_POWER J^(2/3) s^(4/3) behind a rest, jerk J


@dataclass
class Limits:
    velocity: np.ndarray
    acceleration: np.ndarray
    jerk: np.ndarray  # inf: none


def limits_of(path, every_axis=None):
    rows = [every_axis or path.limits.get(axis) for axis in path.axes]
    if any(row is None for row in rows):
        raise path_file.PathError("no limits for axis " + path.axes[rows.index(None)] + ": in the path file, or --limits V,A,J")
    v, a, j = np.array(rows, dtype=float).T
    return Limits(v, a, np.where(j > 0, j, np.inf))


class Grid:
    """Cells of one section, and the curve at their ends and middles."""

    def __init__(self, curves, first, last, places):
        """`places`: lengths of the inner nodes along the section; the joints of pieces are added."""
        length = curves.length[first:last]
        joints = np.concatenate([[0], np.cumsum(length)])
        total = joints[-1]
        inner = np.unique(np.clip(places, 0, total))
        # Every piece gets some nodes: the curve may turn in it in less than the time of a cell.
        count = int(np.clip(LEAST_INSIDE_ALL // len(length), 1, LEAST_INSIDE)) if len(length) > 1 else 1
        fixed = np.append((joints[:-1, None] + length[:, None] * np.arange(count) / count).ravel(), total)
        # Nodes that are too close to these are left out, so that no cell becomes much smaller than intended.
        which = np.clip(np.searchsorted(fixed, inner, "right") - 1, 0, len(fixed) - 2)
        room = fixed[which + 1] - fixed[which]
        gap = np.minimum(inner - fixed[which], fixed[which + 1] - inner)
        around = np.gradient(inner) if len(inner) > 1 else np.ones(len(inner))
        s = np.unique(np.concatenate([fixed, inner[gap > 0.3 * np.minimum(around, room)]]))
        s = s[np.concatenate([[True], np.diff(s) > 1e-12 * total])]
        s[-1] = total
        self.s, self.step = s, np.diff(s)
        middle = (s[:-1] + s[1:]) / 2
        self.piece = np.clip(np.searchsorted(joints, middle, "right") - 1, 0, len(length) - 1)
        base, who = joints[self.piece], self.piece + first
        most = curves.length[who]
        self.left = curves.by_length(who, np.clip(s[:-1] - base, 0, most))
        self.right = curves.by_length(who, np.clip(s[1:] - base, 0, most))
        self.inside = [curves.by_length(who, s[:-1] + share * self.step - base) for share in JERK_AT]
        self.feed = np.where(curves.feed[who] > 0, curves.feed[who], np.inf)
        self.who = who

    def speed_limit(self, limits):
        """Largest b at each node from velocities, feeds and the acceleration across the path."""
        cell = self.feed ** 2
        out = np.full(len(self.s), np.inf)
        for end, nodes in ((self.left, slice(0, -1)), (self.right, slice(1, None))):
            with np.errstate(divide="ignore", invalid="ignore"):
                by_velocity = np.min((limits.velocity / np.abs(end[1])) ** 2, axis=1)
                # across: an upper bound of b from |q'' b + q' a| <= A, of axes that do not move along the path (q' = 0); a bound is enough here
                across = np.min(np.where(np.abs(end[1]) < 1e-9, limits.acceleration / np.abs(end[2]), np.inf), axis=1)
            out[nodes] = np.minimum(out[nodes], np.minimum(np.minimum(cell, by_velocity), across))
        return out

    def check_smooth(self, curvature):
        step = np.abs(self.right[1][:-1] - self.left[1][1:]).max(axis=1)
        bend = np.abs(self.right[2][:-1] - self.left[2][1:]).max(axis=1) / np.maximum(1, np.abs(self.left[2][1:]).max(axis=1))
        for value, most, what in ((step, 1e-6, "direction"), (bend, 1e-4 if curvature else np.inf, "curvature")):
            bad = np.flatnonzero(value > most)
            if len(bad):
                raise path_file.PathError(f"pieces {self.who[bad[0]] + 1} and {self.who[bad[0] + 1] + 1} join with a step of the {what}: "
                                          "no speed but rest passes it (a stop is missing?)")


def triplets(rows, columns, values, shape):
    return sparse.csc_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=shape)


def solve_without_jerk(grid, limits):
    """b at the nodes. The optimal b is at every place larger than every other possible b, so a linear program that maximizes the sum finds it."""
    n, h = len(grid.s), grid.step
    most = grid.speed_limit(limits)
    scale = np.where(np.isfinite(most), most, 2 * limits.acceleration.max() * grid.s[-1] * len(limits.velocity))
    scale = np.maximum(scale, 1e-9)
    cells = np.arange(n - 1)
    blocks = []
    for end, node in ((grid.left, cells), (grid.right, cells + 1)):
        for k, strongest in enumerate(limits.acceleration):
            d1, d2 = end[1][:, k] / strongest, end[2][:, k] / strongest
            matrix = triplets([cells, cells, cells], [node, cells + 1, cells],
                              [d2 * scale[node], d1 / (2 * h) * scale[cells + 1], -d1 / (2 * h) * scale[cells]], (n - 1, n))
            norm = sparse.diags(1 / np.maximum(1, np.abs(matrix).max(axis=1).toarray().ravel()))
            blocks += [(norm @ matrix, norm.diagonal()), (-norm @ matrix, norm.diagonal())]
    ends = sparse.csc_matrix(([1.0, 1.0], ([0, 1], [0, n - 1])), shape=(2, n))
    rows = sparse.vstack([ends] + [m for m, _ in blocks] + [sparse.eye(n), -sparse.eye(n)])
    upper = np.concatenate([np.zeros(2)] + [u for _, u in blocks] + [np.where(np.isfinite(most), most / scale, 1), np.zeros(n)])
    x = solve_program(sparse.csc_matrix((n, n)), -np.ones(n), rows, upper, 2)
    b = np.maximum(x, 0) * scale
    b[0] = b[-1] = 0
    return b


def time_without_jerk(grid, b):
    v = np.sqrt(b)
    return 2 * grid.step / np.maximum(v[:-1] + v[1:], 1e-12)


class JerkStep:
    """The quadratic program of one step. Its unknowns are b and a at the inner nodes, scaled by the last b and by `scale`."""

    def __init__(self, grid, limits):
        self.grid, self.limits = grid, limits
        self.most = grid.speed_limit(limits)
        n = len(grid.s)
        self.count = n - 2
        h = grid.step
        with np.errstate(divide="ignore"):
            first = np.min(limits.jerk / np.maximum(np.abs(grid.left[1][0]), 1e-12))
            last = np.min(limits.jerk / np.maximum(np.abs(grid.right[1][-1]), 1e-12))
        self.rest = (REST_POWER * first ** (2 / 3) * h[0] ** (4 / 3), REST_POWER * last ** (2 / 3) * h[-1] ** (4 / 3))
        self.a_scale = limits.acceleration.max()
        self.strongest = limits.jerk[np.isfinite(limits.jerk)].max()

    def inside(self, b, a):
        """b at the places JERK_AT of the cells that do not touch a rest, one array per place; b and a are those of the inner nodes."""
        h = self.grid.step[1:-1]
        return [np.maximum(b[:-1] + h * z * ((2 - z) * a[:-1] + z * a[1:]), 1e-3 * np.minimum(b[:-1], b[1:])) for z in JERK_AT]

    def solve(self, b0, inside):
        """The next b and a at the inner nodes, from the last b there (b0) and at the places JERK_AT (inside)."""
        g, n = self.grid, self.count
        h = g.step[1:-1]
        i, node = np.arange(n - 1), np.arange(n)
        scale = np.minimum(self.a_scale, 2 * np.sqrt(self.strongest * np.sqrt(b0)))
        weight = (g.step[:-1] + g.step[1:]) / 2 / np.sqrt(b0)
        weight = weight / weight.mean()
        p = sparse.diags(np.concatenate([0.75 * weight, np.zeros(n)]))
        q = np.concatenate([-1.25 * weight, np.zeros(n)])
        blocks, uppers = [], []

        def add(rows, columns, values, upper, count):
            matrix = triplets(rows, columns, values, (count, 2 * n))
            norm = 1 / np.maximum(np.abs(matrix).max(axis=1).toarray().ravel(), np.where(upper > 0, 0.1, 1e-300))
            blocks.append(sparse.diags(norm) @ matrix)
            uppers.append(upper * norm)

        # b[i+1] - b[i] = h (a[i] + a[i+1]); beside a rest a = +-2/3 b / h.
        add([i] * 4, [i + 1, i, n + i, n + i + 1], [b0[1:], -b0[:-1], -h * scale[:-1], -h * scale[1:]], np.zeros(n - 1), n - 1)
        two = np.arange(2)
        side = np.array([2 / 3 / g.step[0], -2 / 3 / g.step[-1]])
        add([two, two], [np.array([0, n - 1]), np.array([n, 2 * n - 1])], [-side * b0[[0, -1]], scale[[0, -1]]], np.zeros(2), 2)
        equal = n + 1
        for end in (g.left, g.right):
            here = slice(1, None) if end is g.left else slice(0, -1)
            for k, strongest in enumerate(self.limits.acceleration):
                d1, d2 = end[1][here, k] / strongest, end[2][here, k] / strongest
                if end is g.right and np.allclose(d1, g.left[1][1:, k] / strongest) and np.allclose(d2, g.left[2][1:, k] / strongest):
                    continue
                if not (d1.any() or d2.any()):
                    continue
                for sign in (1, -1):
                    add([node, node], [node, n + node], [sign * d2 * b0, sign * d1 * scale], np.ones(n), n)
        bent = np.any(np.abs(g.inside[1][2][1:-1]) > 1e-9, axis=1)
        for number, share in enumerate(JERK_AT):
            cells = i[bent == (share != 0.5)]
            if len(cells):
                self._limit_jerk(add, share, [d[1:-1][cells] for d in g.inside[number][1:]], inside[number][cells], cells, b0, scale)
        most = self.most[1:-1].copy()
        most[0], most[-1] = min(most[0], self.rest[0]), min(most[-1], self.rest[1])
        bounded = node
        ones = np.ones(len(bounded))
        rows = np.arange(len(bounded))
        blocks.append(triplets([rows], [bounded], [ones], (len(bounded), 2 * n)))
        uppers.append(np.minimum(most[bounded] / b0[bounded], MOST_GROWTH))
        blocks.append(triplets([node], [node], [-np.ones(n)], (n, 2 * n)))
        uppers.append(np.full(n, -1e-3))
        x = solve_program(p, q, sparse.vstack(blocks), np.concatenate(uppers), equal)
        return x[:n] * b0, x[n:] * scale


    def _limit_jerk(self, add, share, curve, last, cells, b0, scale):
        """Adds the rows that limit the jerk at `share` of the way through each of `cells`. There the derivatives of the path are `curve`, and b
        of the last step is `last`."""
        n, h = self.count, self.grid.step[1:-1][cells]
        i = np.arange(len(cells))
        root = np.sqrt(last)
        for k, strongest in enumerate(self.limits.jerk):
            d1, d2, d3 = (d[:, k] * root / strongest for d in curve)
            if not np.isfinite(strongest) or not (d1.any() or d2.any() or d3.any()):
                continue
            for sign in (1, -1):
                # |q''' b + 3 q'' a + q' p| root / J + b / (2 last) <= 1.5
                on_b = sign * d3 + 1 / (2 * last)
                on_a, on_p = sign * 3 * d2, sign * d1 / h
                add([i] * 3, [cells, n + cells, n + cells + 1],
                    [on_b * b0[cells], (on_b * h * share * (2 - share) + on_a * (1 - share) - on_p) * scale[cells],
                     (on_b * h * share ** 2 + on_a * share + on_p) * scale[cells + 1]], np.full(len(cells), 1.5), len(cells))


def times_with_jerk(grid, b, a):
    """The time of each cell in s; b and a are those of the inner nodes."""
    v = np.sqrt(b)
    first, last = 3 * grid.step[0] / v[0], 3 * grid.step[-1] / v[-1]
    h = grid.step[1:-1]
    p = np.diff(a) / h
    inner = np.zeros(len(h))
    for x, w in zip(path_file.GAUSS_X, path_file.GAUSS_W):
        z = x * h
        inner += w * h / np.sqrt(np.maximum(b[:-1] + 2 * a[:-1] * z + p * z * z, 1e-3 * np.minimum(b[:-1], b[1:])))
    return np.concatenate([[first], inner, [last]])


@dataclass
class Section:
    """The solution between two rests."""
    grid: Grid
    b: np.ndarray  # at all nodes
    a: np.ndarray
    times: np.ndarray  # of the cells
    jerk: bool
    steps: int

    @property
    def seconds(self):
        return float(self.times.sum())


def iterate(grid, limits, b, inside, most_steps, tolerance):
    """Iterates from b at the inner nodes and at the places JERK_AT (inside). Returns b, a, the times of the cells in s, and the number of steps."""
    step = JerkStep(grid, limits)
    b, inside, a = np.maximum(b, 1e-8), [np.maximum(x, 1e-8) for x in inside], None
    best, count = None, 0
    for count in range(1, most_steps + 1):
        nb, na = step.solve(b, inside)
        nb = np.maximum(nb, 1e-10)
        times = times_with_jerk(grid, nb, na)
        share = 1.0
        while best is not None and times.sum() > best.sum() and share > 0.1:  # the model of the time does not hold so far away: go back half of the way
            share /= 2
            nb, na = b + share * (nb - b), a + share * (na - a)
            times = times_with_jerk(grid, nb, na)
        gain = 1.0 if best is None else 1 - times.sum() / best.sum()
        if best is not None and gain < 0:
            break
        b, a, best = nb, na, times
        inside = step.inside(b, a)
        if gain < tolerance:
            break
    return b, a, best, count


# Shares of a cell at which the jerk is limited: on a straight line the middle; on a curve, where the jerk changes more, the other two.
JERK_AT = (0.5 - 0.5 / 3 ** 0.5, 0.5, 0.5 + 0.5 / 3 ** 0.5)
MOST_GROWTH = 30.0  # b grows in one step of the iteration by this factor at most
REST_CELLS = 8  # the cell beside a rest takes as long as so many others, since with shorter ones the values at its ends differ too much
LEAST_CELLS, MOST_CELLS = 200, 10_000  # cells of a section that are even in time
LEAST_INSIDE, LEAST_INSIDE_ALL = 80, 10_000  # parts into which a piece is divided, and all pieces of a section together


def moments(seconds, step_s):
    """The times at which the inner nodes of a section are passed that takes `seconds`."""
    count = min(MOST_CELLS, max(LEAST_CELLS, int(np.ceil(seconds / step_s))))
    return np.linspace(0, seconds, count + 1)[REST_CELLS:-REST_CELLS]


def even_in_time(s, times, step_s):
    """Places along the path that are passed at intervals of step_s."""
    t = np.concatenate([[0], np.cumsum(times)])
    return np.interp(moments(t[-1], step_s), t, s)


def solve_section(curves, first, last, limits, step_s=0.001, jerk=True, tolerance=1e-4):
    length = curves.length[first:last]
    total = length.sum()
    fastest = np.where(curves.feed[first:last] > 0, curves.feed[first:last], np.linalg.norm(limits.velocity)).max()
    coarse = 4 * step_s
    joints = np.concatenate([[0], np.cumsum(length)])
    parts = np.maximum(4, np.ceil(length / (fastest * coarse))).astype(int)
    start = np.concatenate([np.linspace(joints[i], joints[i + 1], parts[i] + 1)[:-1] for i in range(len(length))] + [
        total * 0.5 ** np.arange(2, 16), total * (1 - 0.5 ** np.arange(2, 16))])
    grid = Grid(curves, first, last, start)
    jerk = jerk and np.any(np.isfinite(limits.jerk))
    grid.check_smooth(jerk)
    b = solve_without_jerk(grid, limits)
    times = time_without_jerk(grid, b)
    grid_2 = Grid(curves, first, last, even_in_time(grid.s, times, step_s if not jerk else coarse))
    if not jerk:
        b = solve_without_jerk(grid_2, limits)
        return Section(grid_2, b, np.gradient(b, grid_2.s) / 2, time_without_jerk(grid_2, b), False, 1)
    places = even_in_time(grid.s, times, coarse)
    steps = 0
    old = None
    for most_steps in (12, 8):
        new = Grid(curves, first, last, places)
        guess = [np.interp(at, grid.s, b) if old is None else squared_speed_at(grid, *old, at)
                 for at in [new.s[1:-1]] + [new.s[1:-2] + z * new.step[1:-1] for z in JERK_AT]]
        grid = new
        nb, na, times, count = iterate(grid, limits, guess[0], guess[1:], most_steps, tolerance)
        old = nb, na
        steps += count
        places = place_at(grid, nb, na, times, moments(times.sum(), step_s))
    return Section(grid, np.concatenate([[0], nb, [0]]), np.concatenate([[0], na, [0]]), times, True, steps)


def squared_speed_at(grid, b, a, s):
    """b of a solution with limited jerk at the lengths s; b and a are those of the inner nodes."""
    cell = np.clip(np.searchsorted(grid.s, s, "right") - 1, 0, len(grid.step) - 1)
    out = np.where(cell == 0, b[0] * (np.maximum(s, 0) / grid.step[0]) ** (4 / 3),
                   b[-1] * (np.maximum(grid.s[-1] - s, 0) / grid.step[-1]) ** (4 / 3))
    inner = (cell > 0) & (cell < len(grid.step) - 1)
    i = cell[inner] - 1
    x = s[inner] - grid.s[cell[inner]]
    out[inner] = b[i] + 2 * a[i] * x + (a[i + 1] - a[i]) / grid.step[cell[inner]] * x * x
    return out


def place_at(grid, b, a, times, when):
    """The lengths that a solution with limited jerk has reached at the times `when`; b and a are those of the inner nodes."""
    t = np.concatenate([[0], np.cumsum(times)])
    cell = np.clip(np.searchsorted(t, when, "right") - 1, 0, len(times) - 1)
    dt = when - t[cell]
    out = np.empty(len(when))
    first, last = cell == 0, cell == len(times) - 1
    h = grid.step
    out[first] = h[0] * (dt[first] / times[0]) ** 3
    out[last] = grid.s[-1] - h[-1] * (np.maximum(times[-1] - dt[last], 0) / times[-1]) ** 3
    inner = ~(first | last)
    i = cell[inner] - 1
    p = (a[i + 1] - a[i]) / h[i + 1]
    x = dt[inner]
    # The solution of s'' = a + p s (by time) from speed v has sinh and cosh; where p < 0, sin and cos.
    r = np.sqrt(np.abs(p))
    z = r * x
    small = z < 0.05
    w = p * x * x
    c1 = 1 + w / 6 + w * w / 120
    c2 = 0.5 + w / 24 + w * w / 720
    safe = np.where(small, 1, z)
    c1 = np.where(small, c1, np.where(p > 0, np.sinh(safe), np.sin(safe)) / safe)
    c2 = np.where(small, c2, np.where(p > 0, np.cosh(safe) - 1, 1 - np.cos(safe)) / safe ** 2)
    out[inner] = grid.s[cell[inner]] + np.sqrt(b[i]) * x * c1 + a[i] * x * x * c2
    return out


class Solution:
    """All sections of a path."""

    def __init__(self, path, limits, step_s=0.001, jerk=True, report=None):
        self.path, self.curves = path, path.tables()
        self.sections, self.dwells = [], []
        edges = sorted(set([0, len(path.pieces)] + [k for k in path.stops if k < len(path.pieces)]))
        for first, last in zip(edges[:-1], edges[1:]):
            self.sections.append((first, last, solve_section(self.curves, first, last, limits, step_s, jerk)))
            self.dwells.append(path.stops.get(last, 0.0))
            if report:
                report(first, last, self.sections[-1][2])

    @property
    def seconds(self):
        return sum(s.seconds for _, _, s in self.sections) + sum(self.dwells)

    def positions(self, cycle_s):
        """The positions of the axes in each cycle, from the rest at the beginning to the rest at the end."""
        out, begin = [], 0.0
        for (first, last, section), dwell in zip(self.sections, self.dwells):
            count = int(np.floor((begin + section.seconds) / cycle_s + 1e-9))
            when = cycle_s * np.arange(int(np.ceil(begin / cycle_s - 1e-9)), count + 1) - begin
            if section.jerk:
                s = place_at(section.grid, section.b[1:-1], section.a[1:-1], section.times, np.clip(when, 0, section.seconds))
            else:
                t = np.concatenate([[0], np.cumsum(section.times)])
                s = place_without_jerk(section, t, np.clip(when, 0, section.seconds))
            joints = np.concatenate([[0], np.cumsum(self.curves.length[first:last])])
            who = np.clip(np.searchsorted(joints, s, "right") - 1, 0, last - first - 1)
            out.append(self.curves.by_length(who + first, np.clip(s - joints[who], 0, self.curves.length[who + first]))[0])
            begin += section.seconds
            if dwell > 0:
                rest = int(np.floor((begin + dwell) / cycle_s + 1e-9)) - count
                out.append(np.repeat(self._end(last)[None], rest, axis=0))
                begin += dwell
        out.append(self._end(len(self.path.pieces))[None])
        return np.concatenate(out)

    def _end(self, last):
        return self.curves.by_u(np.array([last - 1]), np.array([1.0]), 0)[0][0]


def place_without_jerk(section, t, when):
    cell = np.clip(np.searchsorted(t, when, "right") - 1, 0, len(section.times) - 1)
    x = when - t[cell]
    v = np.sqrt(section.b[cell])
    a = (section.b[cell + 1] - section.b[cell]) / (2 * section.grid.step[cell])
    return section.grid.s[cell] + v * x + a * x * x / 2


def parse_limits(text):
    try:
        values = tuple(float(v) for v in text.split(","))
    except ValueError:
        values = ()
    if len(values) != 3 or min(values[:2]) <= 0 or values[2] < 0:
        raise argparse.ArgumentTypeError("must be velocity,acceleration,jerk, as 250,2000,50000; jerk 0: none")
    return values


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("path")
    parser.add_argument("--limits", type=parse_limits, help="of every axis, instead of those of the file")
    parser.add_argument("--no-jerk", action="store_true")
    parser.add_argument("--step-ms", type=float, default=1.0, help="time between the nodes of the grid")
    parser.add_argument("--csv", help="write the solution as ncsim motion does")
    parser.add_argument("--cycle-us", type=int, default=1000)
    options = parser.parse_args()
    try:
        path = path_file.read(options.path)

        def report(first, last, section):
            print(f"pieces {first + 1} to {last}: {section.seconds:.4f} s, {len(section.grid.s)} nodes, {section.steps} steps", flush=True)

        solution = Solution(path, limits_of(path, options.limits), options.step_ms * 1e-3, not options.no_jerk, report)
        print(f"time {solution.seconds:.4f} s")
        if options.csv:
            rows = solution.positions(options.cycle_us * 1e-6)
            with open(options.csv, "w", encoding="ascii") as out:
                out.write("t," + ",".join(path.axes) + "\n")
                for i, row in enumerate(rows):
                    out.write(f"{i * options.cycle_us * 1e-6:.6f}," + ",".join(f"{v:.12f}" for v in row) + "\n")
    except (OSError, path_file.PathError, RuntimeError) as error:
        sys.exit(f"reference.py: {error}")


if __name__ == "__main__":
    main()
