# SPDX-License-Identifier: Apache-2.0
"""The shortest time in the tube: path and time law are chosen together, anywhere within the tolerance of the programmed path, under limits of
velocity, acceleration, jerk and feed (README.md, "The tube").

The motion between two rests is N rows, one per cycle of h seconds, from the place where the recording begins to the place where it ends. The
first three differences of the rows, divided by h, h^2 and h^3, are limited, as in motion_check.py. The least h is wanted. When it is known to
which part of the path each row belongs, this is a cone program except for h^2 and h^3, which are replaced by their tangents; these lie below
them. It is solved again and again, each time for rows that have moved along the path, until no small change of path and law makes the motion
shorter. It begins with a recording, so the result is never longer than that.
"""
import clarabel
import numpy as np
from scipy import sparse

STEPS = 40
AHEAD = 6.0  # in the first steps a row may move along a bend by so many distances of neighbouring rows
SLOWER = 0.8  # from the third step on this way becomes smaller by this factor in each step
LEAST_AHEAD = 0.02
SETTLED = 2e-5  # the end is reached when three steps in succession have changed h by less than this part of it
BENT = 0.02  # a row may move freely along the tangent where the path leaves it by less than this part of the tolerance
WITHIN = 1.002  # the rows of the result are within this multiple of the tolerance
NEAR_REST_MM = 1e-3


class Foot:
    """The place on the polyline that belongs to each row: the nearest one that is not before the place of the preceding row."""

    def __init__(self, line, rows, tolerance):
        self.line = line
        self.place, self.off = np.zeros(len(rows)), np.zeros(len(rows))
        s, last = 0.0, rows[0]
        for k, row in enumerate(rows):
            reach = np.linalg.norm(row - last) + 4 * tolerance
            first = max(np.searchsorted(line.s, s, "right") - 1, 0)
            behind = np.searchsorted(line.s, s + reach, "left")
            first = min(first, len(line.step) - 1)
            edges = np.arange(first, min(max(behind, first + 1), len(line.step)))
            d = line.points[edges + 1] - line.points[edges]
            share = np.clip(np.sum((row - line.points[edges]) * d, axis=1) / line.step[edges] ** 2, 0, 1)
            places = np.maximum(line.s[edges] + share * line.step[edges], s)
            share = np.clip((places - line.s[edges]) / line.step[edges], 0, 1)
            off = np.linalg.norm(line.points[edges] + share[:, None] * d - row, axis=1)
            best = int(off.argmin())
            s, last = places[best], row
            self.place[k], self.off[k] = s, off[best]

    def feeds(self):
        """For each two neighbouring rows the highest feed of the lines between them; infinite for a rapid."""
        edge = np.clip(np.searchsorted(self.line.s, self.place, "right") - 1, 0, len(self.line.step) - 1)
        feed = np.where(self.line.feeds > 0, self.line.feeds, np.inf)
        return np.array([feed[a:b + 1].max() for a, b in zip(edge[:-1], np.maximum(edge[1:], edge[:-1]))])

    def tangents(self, ahead, tolerance):
        """Place, direction, and how far each row may move back and ahead along this direction: as long as the path is nearly straight, and at least
        along the line on which its place is."""
        line, out = self.line, []
        for s, off, way in zip(self.place, self.off, ahead):
            e = int(np.clip(np.searchsorted(line.s, s, "right") - 1, 0, len(line.step) - 1))
            foot = line.points[e] + (s - line.s[e]) / line.step[e] * (line.points[e + 1] - line.points[e])
            low, high = max(s - way, 0.0), min(s + way, line.s[-1])
            chord = line.at(np.array([low, high]))
            direction, bent = chord[1] - chord[0], np.inf
            if np.linalg.norm(direction) > 0.9 * (high - low) > 0:
                direction = direction / np.linalg.norm(direction)
                inner = line.points[np.searchsorted(line.s, low):np.searchsorted(line.s, high, "right")]
                ends = np.concatenate([chord, inner]) - foot
                bent = np.linalg.norm(ends - np.outer(ends @ direction, direction), axis=1).max()
            if bent > max(BENT * tolerance, 0.5 * (tolerance - off)):  # at a corner it may move along its own line only
                direction = (line.points[e + 1] - line.points[e]) / line.step[e]
                low, high = line.s[e], line.s[e + 1]
            elif bent <= BENT * tolerance:
                low, high = min(low, line.s[e]), max(high, line.s[e + 1])
            out.append((foot, direction, low - s, high - s))
        return [np.array(column) for column in zip(*out)]


def differences(count, order):
    """The matrix of the differences of this order, with rows added before the first and behind the last one, at which the axes rest."""
    padded = sparse.diags([np.ones(count)], [0], shape=(count, count)).tolil()
    before = sparse.csr_matrix((np.ones(order), (np.arange(order), np.zeros(order, int))), shape=(order, count))
    behind = sparse.csr_matrix((np.ones(order), (np.arange(order), np.full(order, count - 1))), shape=(order, count))
    matrix = sparse.vstack([before, padded.tocsr(), behind]).tocsr()
    for _ in range(order):
        matrix = matrix[1:] - matrix[:-1]
    return matrix


class Tube:
    """The rows of one stretch between two rests, of which the first and the last are at rest, and the cone programs that make it faster."""

    def __init__(self, line, rows, cycle_s, limits, tolerance):
        self.line, self.rows, self.limits, self.tolerance = line, np.array(rows, dtype=float), limits, tolerance
        self.h = self.begun = cycle_s
        self.matrices = [differences(len(rows), order) for order in (1, 2, 3)]
        self.axes = [i for i in range(rows.shape[1]) if np.ptp(self.line.points[:, i]) > 0]

    def seconds(self):
        return (len(self.rows) - 1) * self.h

    def program(self, foot, ahead):
        """Solves one cone program; returns the rows that it finds, and h. Its unknowns are the distances of the rows from their places, their ways
        along the path, and x, the new h divided by the present one."""
        n, axes, tolerance = len(self.rows), self.axes, self.tolerance
        place, direction, low, high = foot.tangents(ahead, tolerance)
        unknown = n * len(axes) + n + 1
        cones, left, right = [], [], []

        def add(matrix, bound, cone):
            left.append(matrix)
            right.append(bound)
            cones.append(cone)

        def wide(matrix, axis, last):
            """Extends a matrix for the rows of one axis to all unknowns; `last` is its column for x."""
            blocks = [sparse.csr_matrix((matrix.shape[0], n))] * len(axes)
            blocks[axis] = matrix
            return sparse.hstack([*blocks, sparse.csr_matrix((matrix.shape[0], n)), sparse.csr_matrix(np.reshape(last, (-1, 1)))]).tocsr()

        ends = sparse.csr_matrix((np.ones(2), ([0, 1], [0, n - 1])), shape=(2, n))
        for k, i in enumerate(axes):
            add(wide(ends, k, np.zeros(2)), self.rows[[0, -1], i] - place[[0, -1], i], clarabel.ZeroConeT(2))
        for order, matrix in enumerate(self.matrices, 1):  # |difference| <= limit (h x)^order, with x^order replaced by its tangent 1 + order (x - 1)
            most = self.limits[order - 1] * self.h ** order
            for k, i in enumerate(axes):
                known = matrix @ place[:, i] / most
                for sign in (1, -1):
                    add(wide(sign * matrix / most, k, np.full(matrix.shape[0], -float(order))), 1 - order - sign * known,
                        clarabel.NonnegativeConeT(matrix.shape[0]))
        ways = sparse.hstack([sparse.csr_matrix((n, n * len(axes))), sparse.identity(n), sparse.csr_matrix((n, 1))]).tocsr()
        add(ways, high, clarabel.NonnegativeConeT(n))
        add(-ways, -low, clarabel.NonnegativeConeT(n))
        # Cones over all axes: |distance - way * direction| <= tolerance for each row, and |difference| <= feed h x for each two rows.
        near = [sparse.hstack([*[-sparse.identity(n) if j == k else sparse.csr_matrix((n, n)) for j in range(len(axes))],
                               sparse.diags([direction[:, i]], [0]), sparse.csr_matrix((n, 1))]).tocsr() for k, i in enumerate(axes)]
        size, cells = len(axes) + 1, sparse.vstack([sparse.csr_matrix((n, unknown)), *near]).tocsr()
        order = np.arange(size * n).reshape(size, n).T.ravel()
        left.append(cells[order])
        right.append(np.concatenate([np.full(n, tolerance), np.zeros(n * len(axes))])[order])
        cones += [clarabel.SecondOrderConeT(size)] * n
        feeds = foot.feeds()
        inner = np.flatnonzero(np.isfinite(feeds))
        if len(inner):
            step = self.matrices[0][1:-1][inner]
            speed = [-wide(step, k, np.zeros(len(inner))) for k in range(len(axes))]
            most = feeds[inner] * self.h
            last = sparse.csr_matrix((-most, (np.arange(len(inner)), np.full(len(inner), unknown - 1))), shape=(len(inner), unknown))
            order = np.arange(size * len(inner)).reshape(size, len(inner)).T.ravel()
            left.append(sparse.vstack([last, *speed]).tocsr()[order])
            right.append(np.concatenate([np.zeros(len(inner)), *[step @ place[:, i] for i in axes]])[order])
            cones += [clarabel.SecondOrderConeT(size)] * len(inner)
        goal = np.zeros(unknown)
        goal[-1] = 1
        settings = clarabel.DefaultSettings()
        settings.verbose = False
        answer = clarabel.DefaultSolver(sparse.csc_matrix((unknown, unknown)), goal, sparse.vstack(left).tocsc(), np.concatenate(right), cones,
                                        settings).solve()
        if str(answer.status) not in ("Solved", "AlmostSolved", "InsufficientProgress"):
            return None, None
        found = np.array(answer.x)
        rows = place.copy()
        for k, i in enumerate(axes):
            rows[:, i] += found[k * n:(k + 1) * n]
        rows[:, [i for i in range(rows.shape[1]) if i not in axes]] = self.rows[0, [i for i in range(rows.shape[1]) if i not in axes]]
        return rows, found[-1] * self.h

    def solve(self, say=None):
        """Finds the least time and returns it in s; the rows of the motion are then in `rows`."""
        best, best_rows, settled, share = self.h, self.rows, 0, AHEAD
        for step in range(STEPS):
            foot = Foot(self.line, self.rows, self.tolerance)
            if step > 0 and foot.off.max() <= WITHIN * self.tolerance and self.h < best:
                best, best_rows = self.h, self.rows
            way = np.linalg.norm(np.diff(self.rows, axis=0), axis=1)
            ahead = share * np.maximum(np.concatenate([[0], way]), np.concatenate([way, [0]])) + 1e-6
            rows, h = self.program(foot, ahead)
            if rows is None:
                share *= 0.5
                continue
            if say:
                say(f"step {step}: {h / self.begun:.5f} of the time, {foot.off.max() / self.tolerance:.3f} of the tolerance before it")
            settled = settled + 1 if abs(h - self.h) < SETTLED * h else 0
            self.rows, self.h = rows, h
            if step >= 2:
                share = max(share * SLOWER, LEAST_AHEAD)
            if settled >= 3:
                break
        foot = Foot(self.line, self.rows, self.tolerance)
        if foot.off.max() <= WITHIN * self.tolerance and self.h < best:
            best, best_rows = self.h, self.rows
        self.h, self.rows = best, best_rows
        return self.seconds()


def stretches(rows, ends):
    """The rows of each motion between two rests, with the places of the rests as the first and the last row. `ends` are the places of all rests but
    the first one. A rest may lie between two rows; the nearest row is then replaced by it."""
    out, first, start = [], 0, rows[0]
    for end in ends:
        off = np.linalg.norm(rows[first + 1:] - end, axis=1)
        near = np.flatnonzero(off < NEAR_REST_MM)
        if len(near) == 0:
            raise ValueError(f"row {first}: the motion does not come to the next rest")
        run = near[:np.append(np.flatnonzero(np.diff(near) > 1), len(near) - 1)[0] + 1]
        last = first + 1 + int(run[off[run].argmin()])
        part = np.array(rows[first:last + 1], dtype=float)
        while len(part) > 4 and np.array_equal(part[1], part[0]):
            part = part[1:]
        part[0], part[-1] = start, end
        out.append(part)
        first, start = last, end
    return out
