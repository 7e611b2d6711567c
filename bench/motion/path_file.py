# SPDX-License-Identifier: Apache-2.0
"""Path files (README.md, "Path files"): reads and writes them, and evaluates their curves with derivatives at many places at a time."""
import math

import numpy as np


class PathError(Exception):
    """The message says what is wrong, and in which line."""


class Path:
    """Pieces, which are curves of a parameter u from 0 to 1, and the places at which the path rests."""

    def __init__(self, axes, limits=None, tolerance=None):
        self.axes = list(axes)
        self.limits = dict(limits or {})  # axis -> (velocity, acceleration, jerk)
        self.tolerance = tolerance
        self.pieces = []  # ("poly", feed, coefficients[axis][power]) or ("arc", feed, a, b, ca, cb, sweep, p0, p1)
        self.stops = {}  # number of the piece that follows -> seconds at rest
        self.exact = set()  # those of `stops` at which the axes must reach the place exactly

    # -- making --

    def line(self, feed, start, end):
        self.pieces.append(("poly", feed, [[a, b - a] for a, b in zip(start, end)]))

    def poly(self, feed, coefficients):
        self.pieces.append(("poly", feed, [list(c) for c in coefficients]))

    def arc(self, feed, a, b, center_a, center_b, sweep, start, end):
        self.pieces.append(("arc", feed, a, b, center_a, center_b, sweep, list(start), list(end)))

    def stop(self, seconds=0.0, exact=True):
        if not self.pieces:
            return
        self.stops[len(self.pieces)] = self.stops.get(len(self.pieces), 0.0) + seconds
        if exact:
            self.exact.add(len(self.pieces))

    # -- text --

    def write(self, path):
        def numbers(values):
            return " ".join(repr(float(v)) for v in values)

        with open(path, "w", encoding="ascii") as out:
            out.write("nc-path 1\naxes " + " ".join(self.axes) + "\n")
            for axis, values in self.limits.items():
                out.write(f"limits {axis} {numbers(values)}\n")
            if self.tolerance is not None:
                out.write(f"tolerance {float(self.tolerance)!r}\n")
            for i, piece in enumerate(self.pieces):
                self._write_stop(out, i)
                if piece[0] == "poly":
                    degree = max(len(c) for c in piece[2]) - 1
                    flat = [v for c in piece[2] for v in list(c) + [0.0] * (degree + 1 - len(c))]
                    if degree == 1:
                        start, slope = flat[0::2], flat[1::2]
                        out.write(f"line {float(piece[1])!r} {numbers(start)} {numbers(p + d for p, d in zip(start, slope))}\n")
                    else:
                        out.write(f"poly {float(piece[1])!r} {degree} {numbers(flat)}\n")
                else:
                    _, feed, a, b, ca, cb, sweep, start, end = piece
                    out.write(f"arc {float(feed)!r} {a} {b} {numbers([ca, cb, sweep] + start + end)}\n")
            self._write_stop(out, len(self.pieces))

    def _write_stop(self, out, i):
        if i in self.stops:
            if self.stops[i] > 0:
                out.write(f"dwell {float(self.stops[i])!r}\n")
            else:
                out.write("stop\n" if i in self.exact else "rest\n")

    # -- curves --

    def tables(self):
        return Curves(self)


def read(name):
    """Reads a path file; PathError says what is wrong and where."""
    path = None
    with open(name, encoding="ascii", errors="replace") as lines:
        for number, text in enumerate(lines, 1):
            words = text.split("#", 1)[0].split()
            if not words:
                continue
            try:
                if path is None:
                    if words == ["nc-path", "1"]:
                        path = Path([])
                        continue
                    raise PathError("must begin with: nc-path 1")
                _item(path, words)
            except (ValueError, IndexError) as error:
                raise PathError(f"{name}:{number}: {error}") from None
            except PathError as error:
                raise PathError(f"{name}:{number}: {error}") from None
    if path is None or not path.pieces:
        raise PathError(f"{name}: no path in it")
    return path


def _item(path, words):
    kind, rest = words[0], words[1:]
    n = len(path.axes)
    if kind == "axes":
        path.axes = rest
        return
    if kind == "limits":
        if rest[0] not in path.axes or len(rest) != 4:
            raise PathError("limits need an axis of the path and three numbers")
        path.limits[rest[0]] = tuple(float(v) for v in rest[1:])
        return
    if kind in ("tolerance", "dwell"):
        value = float(rest[0])
        if kind == "dwell":
            path.stop(value)
        else:
            path.tolerance = value
        return
    if kind in ("rest", "stop"):
        path.stop(exact=kind == "stop")
        return
    sizes = {"line": 1 + 2 * n, "arc": 6 + 2 * n}
    values = [float(v) for v in rest]
    if not all(math.isfinite(v) for v in values):
        raise PathError("numbers must be finite")
    if kind == "poly":
        degree = int(rest[1])
        sizes["poly"] = 2 + n * (degree + 1)
    if kind not in sizes:
        raise PathError(f"{kind} is no item of a path")
    if len(values) != sizes[kind]:
        raise PathError(f"{kind} needs {sizes[kind]} numbers for {n} axes, has {len(values)}")
    if kind == "line":
        path.line(values[0], values[1:1 + n], values[1 + n:])
    elif kind == "poly":
        width = degree + 1
        path.poly(values[0], [values[2 + i * width:2 + (i + 1) * width] for i in range(n)])
    else:
        path.arc(values[0], int(rest[1]), int(rest[2]), *values[3:6], values[6:6 + n], values[6 + n:])


GAUSS_X, GAUSS_W = np.polynomial.legendre.leggauss(6)
GAUSS_X, GAUSS_W = (GAUSS_X + 1) / 2, GAUSS_W / 2
TABLE = 16  # pieces of u in the table of lengths


class Curves:
    """The pieces as arrays: points and derivatives by u or by length, for arrays of (piece, place)."""

    def __init__(self, path):
        count, n = len(path.pieces), len(path.axes)
        degree = max([3] + [len(c) - 1 for p in path.pieces if p[0] == "poly" for c in p[2]])
        self.feed = np.array([p[1] for p in path.pieces], dtype=float)
        self.coefficient = np.zeros((count, n, degree + 1))
        self.is_arc = np.zeros(count, dtype=bool)
        self.plane = np.zeros((count, 2), dtype=int)
        self.circle = np.zeros((count, 6))  # centre, start angle, sweep, radius, its change
        for i, p in enumerate(path.pieces):
            if p[0] == "poly":
                for k, c in enumerate(p[2]):
                    self.coefficient[i, k, :len(c)] = c
                continue
            _, _, a, b, ca, cb, sweep, start, end = p
            self.is_arc[i] = True
            self.plane[i] = a, b
            r0, r1 = math.hypot(start[a] - ca, start[b] - cb), math.hypot(end[a] - ca, end[b] - cb)
            self.circle[i] = ca, cb, math.atan2(start[b] - cb, start[a] - ca), sweep, r0, r1 - r0
            for k in range(n):
                self.coefficient[i, k, :2] = start[k], end[k] - start[k]
        edges = np.linspace(0, 1, TABLE + 1)
        who = np.repeat(np.arange(count), TABLE)
        low = np.tile(edges[:-1], count)
        parts = self._length_between(who, low, low + 1 / TABLE).reshape(count, TABLE)
        self.table = np.concatenate([np.zeros((count, 1)), np.cumsum(parts, axis=1)], axis=1)
        self.length = self.table[:, -1]

    def _length_between(self, who, low, high):
        total = np.zeros(len(who))
        for x, w in zip(GAUSS_X, GAUSS_W):
            total += w * np.linalg.norm(self.by_u(who, low + x * (high - low), 1)[1], axis=1)
        return total * (high - low)

    def by_u(self, who, u, order=3):
        """[q, dq/du, ...] at the parameters u of the pieces `who`; each is an array (places, axes)."""
        out = []
        c = self.coefficient[who]
        for d in range(order + 1):
            value = np.zeros(c.shape[:2])
            for power in range(c.shape[2] - 1, d - 1, -1):
                value = value * u[:, None] + c[:, :, power] * math.perm(power, d)
            out.append(value)
        arcs = np.flatnonzero(self.is_arc[who])
        if len(arcs):
            w = who[arcs]
            ca, cb, start, sweep, radius, growth = self.circle[w].T
            angle, r = start + sweep * u[arcs], radius + growth * u[arcs]
            e = np.exp(1j * angle)
            turn = 1j * sweep
            z = [ca + 1j * cb + r * e]
            for d in range(1, order + 1):
                z.append((r * turn ** d + d * growth * turn ** (d - 1)) * e)
            for d in range(order + 1):
                out[d][arcs, self.plane[w, 0]] = z[d].real
                out[d][arcs, self.plane[w, 1]] = z[d].imag
        return out

    def u_of(self, who, s):
        """The parameters that belong to the lengths s of the pieces `who`."""
        table = self.table[who]
        k = np.clip((table <= s[:, None]).sum(axis=1) - 1, 0, TABLE - 1)
        rows = np.arange(len(who))
        span = np.maximum(table[rows, k + 1] - table[rows, k], 1e-300)
        base = k / TABLE
        u = base + (s - table[rows, k]) / span / TABLE
        for _ in range(4):
            error = table[rows, k] + self._length_between(who, base, u) - s
            speed = np.linalg.norm(self.by_u(who, u, 1)[1], axis=1)
            u = np.clip(u - error / np.maximum(speed, 1e-300), 0, 1)
        return u

    def by_length(self, who, s):
        """[q, q', q'', q'''], derivatives by the length, at the lengths s of the pieces `who`."""
        return self.by_length_at(who, self.u_of(who, s))

    def by_length_at(self, who, u):
        q, d1, d2, d3 = self.by_u(who, u)
        speed = np.linalg.norm(d1, axis=1)
        if np.any(speed < 1e-12):
            raise PathError(f"piece {int(who[np.argmin(speed)]) + 1}: the curve stands still in its parameter")
        s2 = np.sum(d1 * d2, axis=1) / speed
        s3 = (np.sum(d2 * d2, axis=1) + np.sum(d1 * d3, axis=1) - s2 ** 2) / speed
        u1, u2, u3 = 1 / speed, -s2 / speed ** 3, -s3 / speed ** 4 + 3 * s2 ** 2 / speed ** 5
        return [q, d1 * u1[:, None], d2 * (u1 ** 2)[:, None] + d1 * u2[:, None],
                d3 * (u1 ** 3)[:, None] + 3 * d2 * (u1 * u2)[:, None] + d1 * u3[:, None]]
