#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How much later than the shortest stop along the path the axes stand after a hold.

usage: best_stop.py HOLD ...      (files that `holds --write DIR` has made; in the environment that ./setup makes)

The path is known from what the machine does without the hold: q(tau), its positions at tau cycles behind the hold, joined by cubic splines. A stop is a
series s_1 <= s_2 <= ... <= s_N of such taus, one for each cycle, and it rests at the last one. The positions in front of the hold are given. Of the
positions q(s_k) of every axis the first, second and third differences from cycle to cycle keep the limits of velocity, acceleration and jerk: this
is what bench/motion measures of the machine, and no number of its planner is in it.

Whether there is a stop of N cycles is asked by a series of linear programs (HiGHS): q is replaced by its tangents at the last s_k, all s_k stay
within a reach of that, which is made smaller where the tangent says too little, and the largest excess over a limit is made as small as can be. There is
one when the excess is below 0.1 %. From the shortest stop that is found the next shorter ones are tried. The excess is not convex, so a shorter stop may
exist than is found: what is given here has been found, and so can be reached, and the machine is no earlier than it but by the 0.1 %.
"""
import argparse
import sys

import numpy as np
from scipy import interpolate, optimize, sparse

EXCESS = 1e-3        # of a limit: a stop that keeps them by this
MOST_STEPS = 30      # linear programs for one number of cycles
LEAST_REACH = 1e-3   # cycles
SHRINKS = (0.9, 0.95, 0.98)  # a stop of fewer cycles begins with the last one, gone through so much faster


class Hold:
    def __init__(self, name):
        with open(name, encoding="ascii") as lines:
            self.velocity, self.acceleration, self.jerk, self.cycle_s = (float(v) for v in next(lines).split())
            self.took_ms, self.ideal_ms = (float(v) for v in next(lines).split())
            rest = list(lines)
        split = rest.index("held\n")
        place, held = (np.array([[float(v) for v in line.split()] for line in part]) for part in (rest[:split], rest[split + 1:]))
        self.name = name.rsplit("/", 1)[-1].rsplit("_", 1)[0]
        self.last = len(place) - 3  # the tau of the last known position; 0 is the cycle of the hold
        self.path = interpolate.CubicSpline(np.arange(-2, self.last + 1), place)
        self.tangent = self.path.derivative()
        self.took = round(self.took_ms * 1e-3 / self.cycle_s)
        self.held = self.taus_of(held[1:])  # of the machine's own stop, without the cycle of the hold

    def taus_of(self, place):
        """Where on the path these places lie, one behind the other: the nearest of many taus, and some steps of Newton's method from there."""
        tau, found = 0.0, []
        for q in place:
            many = tau + np.linspace(0, 2, 401)
            tau = many[np.argmin(np.sum((self.path(np.minimum(many, self.last)) - q) ** 2, axis=1))]
            for _ in range(3):
                slope = self.tangent(tau)
                size = slope @ slope
                if size > 0:
                    tau += np.clip((q - self.path(tau)) @ slope / size, -0.01, 0.01)
            tau = float(np.clip(tau, found[-1] if found else 0, self.last))
            found.append(tau)
        return np.array(found)

    def limits(self):
        return [most * self.cycle_s ** order for order, most in ((1, self.velocity), (2, self.acceleration), (3, self.jerk))]


def differences(count, order):
    """The matrix of the differences of that order of the places of two cycles before the hold, of the hold, and `count` ones behind it."""
    rows = sparse.identity(count + 3, format="csr")
    for _ in range(order):
        rows = rows[1:] - rows[:-1]
    return rows


class Stop:
    """The linear programs for stops of `count` cycles. Three more cycles at rest follow, so that the jerk that ends the stop is seen."""

    def __init__(self, hold, count):
        self.hold, self.count = hold, count
        self.rows = [differences(count + 3, order) for order in (1, 2, 3)]
        # s of the cycles behind the hold, from the `count` unknowns: the last one stays
        self.spread = sparse.csr_matrix((np.ones(count + 3), (np.arange(count + 3), np.minimum(np.arange(count + 3), count - 1))))

    def excess(self, s):
        place = self.hold.path(np.concatenate([[-2, -1, 0], s, np.repeat(s[-1:], 3)]))
        return max(np.abs(rows @ place).max() / most for rows, most in zip(self.rows, self.hold.limits())) - 1

    def better(self, s, reach):
        """The s within reach of `s` whose excess by the tangents is the least."""
        full = np.concatenate([s, np.repeat(s[-1:], 3)])
        known = self.hold.path([-2, -1, 0])
        place, slope = self.hold.path(full), self.hold.tangent(full)
        rows, upper = [], []
        for matrix, most in zip(self.rows, self.hold.limits()):
            by_s = matrix[:, 3:]
            for axis in range(place.shape[1]):
                change = by_s @ sparse.diags(slope[:, axis]) @ self.spread / most
                at = matrix @ np.concatenate([known[:, axis], place[:, axis]]) / most - change @ s
                for sign in (1, -1):
                    rows.append(sparse.hstack([sign * change, -np.ones((change.shape[0], 1))]))
                    upper.append(1 - sign * at)
        order = differences(self.count, 1)[3:, 3:]  # s_k - s_(k+1) <= 0
        rows.append(sparse.hstack([-order, np.zeros((order.shape[0], 1))]))
        upper.append(np.zeros(order.shape[0]))
        bounds = np.column_stack([np.maximum(s - reach, 0), np.minimum(s + reach, self.hold.last)])
        answer = optimize.linprog(np.append(np.zeros(self.count), 1.0), sparse.vstack(rows).tocsr(), np.concatenate(upper),
                                  bounds=[*map(tuple, bounds), (-1, None)], method="highs")
        return answer.x[:-1] if answer.x is not None else None

    def find(self, s):
        """A stop within the limits, from the guess s; None where none is found."""
        reach, now = 2.0, self.excess(s)
        for _ in range(MOST_STEPS):
            if now <= EXCESS:
                return s
            if reach < LEAST_REACH:
                break
            new = self.better(s, reach)
            then = self.excess(new) if new is not None else np.inf
            if then < now - 1e-4 * abs(now):
                reach *= 1.5 if then < 0.5 * now else 1
                s, now = new, then
            else:
                reach *= 0.35
        return s if now <= EXCESS else None


def guesses(hold, count, last):
    """Ways to rest in `count` cycles: that of the last stop gone through faster, or its second part, and speeds that go down evenly and with a smooth end."""
    at = np.arange(1, count + 1) / count
    if last is not None:
        same = count // 2
        rest = np.interp(np.arange(1, count - same + 1) / (count - same) * (len(last) - same), np.arange(len(last) - same + 1), last[same - 1:])
        yield np.append(last[:same], last[same - 1] + SHRINKS[1] * (rest - last[same - 1]))
        for shrink in SHRINKS:
            yield np.interp(at * len(last), np.arange(len(last) + 1), np.append(0, last)) * shrink
    for speed in (lambda x: x - x ** 3 + x ** 4 / 2, lambda x: x - x ** 2 / 2):
        yield np.minimum(count * speed(at), hold.last)


def shortest(hold):
    """The number of cycles of the shortest stop that is found, beginning with that of the machine. None where none is found."""
    step, count, last, best = max(1, hold.took // 8), len(hold.held), hold.held, None
    while count > 1:
        found = next((s for s in (Stop(hold, count).find(g) for g in guesses(hold, count, last)) if s is not None), None)
        if found is not None:
            best, last = count, found
        elif best is None:
            return None
        if found is None:
            if step == 1:
                break
            count = best
            step = max(1, step // 3)
        count -= step
    return best


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("hold", nargs="+")
    options = parser.parse_args()
    for name in options.hold:
        try:
            hold = Hold(name)
        except (OSError, ValueError, StopIteration) as error:
            sys.exit(f"best_stop.py: {name}: {error}")
        cycles = shortest(hold)
        best = hold.took_ms if cycles is None else 1e3 * hold.cycle_s * cycles
        print(f"{hold.name} {name.rsplit('_', 1)[-1].split('.')[0]}: {hold.took_ms:.0f} ms, on a line {hold.ideal_ms:.1f}, along the path {best:.0f}{'' if cycles else ' (none found)'}: "
              f"later by {hold.took_ms - hold.ideal_ms:.1f} and {hold.took_ms - best:.0f}", flush=True)


if __name__ == "__main__":
    main()
