#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How long a field of drilled holes takes in the time-optimal mode, and how long it must take.

usage: drill_field.py [--ncsim PATH] [--holes N] [--overlap MM ...] [--markdown]

N holes (500) lie in rows, 12 mm apart, to and fro, each drilled 6 mm deep from 1 mm above the work by G81 with G99. Limits of every axis: 250 mm/s,
2000 mm/s2, 50,000 mm/s3; feed 1500 mm/min. Measured is the time from the first change of a position to the last one, with the positions of every
cycle, which are compared with the limits as well: once in G61, once as programmed, and with [motion] retract_overlap.

The bound is of no plan. Where a tool is below R its X and Y stand. So each hole takes at least
  the least time of the traverse from rest to rest, of the axis that needs more of it, +
  the way from R down to the bottom, entered with the whole feed and left at rest, +
  the way back up to R from rest, left with any speed,
each as fast as velocity, acceleration and jerk of that axis let it be.
Exit status: 0, 1 when a limit is not kept or the tool moves aside below R.
"""
import argparse
import math
import os
import subprocess
import sys
import tempfile

import peer

V, A, J = 250.0, 2000.0, 50000.0
PITCH, R, BOTTOM, FEED = 12.0, 1.0, -6.0, 1500.0 / 60


def places(holes):
    per_row = 25
    for k in range(holes):
        row, column = divmod(k, per_row)
        yield PITCH * (column if row % 2 == 0 else per_row - 1 - column), PITCH * row


def program(holes, head):
    out = [f"G21 G90 G17 G94 {head}\nG0 X0. Y0. Z{R}\n"]
    for k, (x, y) in enumerate(places(holes)):
        out.append((f"G99 G81 Z{BOTTOM} R{R} F{60 * FEED}" if k == 0 else "") + f" X{x} Y{y}\n")
    return "".join(out) + "G80\nM30\n"


def ramp(speed):
    """(time, way) from rest to a speed."""
    if speed <= A * A / J:
        time = 2 * math.sqrt(speed / J)
    else:
        time = speed / A + A / J
    return time, speed * time / 2


def halved(lowest, highest, fits):
    for _ in range(200):
        middle = 0.5 * (lowest + highest)
        lowest, highest = (middle, highest) if fits(middle) else (lowest, middle)
    return lowest


def rest_to_rest(way):
    """Least time of a way in seven phases."""
    if way <= 0:
        return 0.0
    top = halved(0.0, V, lambda speed: 2 * ramp(speed)[1] <= way)
    time, part = ramp(top)
    return 2 * time + (way - 2 * part) / top


def from_rest(way):
    """Least time of a way from rest, whatever the speed and the acceleration at its end are."""
    jerk_time = A / J
    if way <= J * jerk_time ** 3 / 6:
        return (6 * way / J) ** (1 / 3)
    speed, begun = J * jerk_time ** 2 / 2, J * jerk_time ** 3 / 6
    time = (-speed + math.sqrt(speed * speed + 2 * A * (way - begun))) / A
    if speed + A * time > V:
        sys.exit("the way out of the hole is longer than this bound is written for")
    return jerk_time + time


def bound(holes):
    depth = R - BOTTOM
    stop_time, stop_way = ramp(FEED)
    hole = (depth - stop_way) / FEED + stop_time + from_rest(depth)
    at = list(places(holes))
    traverse = sum(rest_to_rest(max(abs(b[0] - a[0]), abs(b[1] - a[1]))) for a, b in zip(at, at[1:]))
    return holes * hole + traverse


def machine(overlap):
    axes = "".join(f'[[axis]]\nname = "{name}"\nrapid = {V}\nmax_velocity = {V}\nmax_acceleration = {A}\nmax_jerk = {J}\n' for name in "XYZ")
    return f'[machine]\ndialect = "m700"\nhal = "sim"\n[motion]\nmode = "optimal"\nretract_overlap = {overlap}\n{axes}'


def measured(ncsim, folder, holes, head, overlap):
    """(seconds, worst ratios to velocity, acceleration and jerk, largest move aside below R in a cycle, mm)."""
    name, config, rows = (os.path.join(folder, part) for part in ("field.nc", "machine.toml", "motion.csv"))
    with open(name, "w", encoding="ascii") as out:
        out.write(program(holes, head))
    with open(config, "w", encoding="ascii") as out:
        out.write(machine(overlap))
    done = subprocess.run([ncsim, "motion", "--machine", config, "--cycle-us", "1000", "-o", rows, name], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"ncsim motion: {done.stderr[-300:]}")
    worst, aside, first, last = [0.0, 0.0, 0.0], 0.0, None, 0
    with open(rows, encoding="ascii") as lines:
        columns = lines.readline().strip().split(",")[1:4]
        at = [[float(x) for x in line.split(",")[1:4]] for line in lines]
    if columns != ["X", "Y", "Z"]:
        sys.exit(f"ncsim motion: unknown columns {columns}")
    at = [at[0]] * 3 + at + [at[-1]] * 3
    for n in range(3, len(at)):
        a, b, c, d = at[n - 3:n + 1]
        for i in range(3):
            for order, value in enumerate((d[i] - c[i], d[i] - 2 * c[i] + b[i], d[i] - 3 * c[i] + 3 * b[i] - a[i]), 1):
                worst[order - 1] = max(worst[order - 1], abs(value) / 0.001 ** order / (V, A, J)[order - 1])
        if d != c:
            first, last = n if first is None else first, n
        if max(c[2], d[2]) < R - 1e-9:
            aside = max(aside, abs(d[0] - c[0]), abs(d[1] - c[1]))
    return (last - first + 1) * 0.001, worst, aside


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--ncsim", default=None)
    parser.add_argument("--holes", type=int, default=500)
    parser.add_argument("--overlap", type=float, nargs="*", default=[0.5, 1.0, 2.0, 3.0])
    parser.add_argument("--markdown", action="store_true")
    options = parser.parse_args()
    ncsim, least = peer.find_ncsim(options.ncsim), bound(options.holes)
    wrong = False
    sign = "| " if options.markdown else ""
    print(f"{options.holes} holes, at least {least:.3f} s")
    if options.markdown:
        print("| | time s | x | v | a | j |\n| --- | --- | --- | --- | --- | --- |")
    with tempfile.TemporaryDirectory() as folder:
        cases = [("exact stops (G61)", "G61", 0.0), ("as programmed (G64)", "G64", 0.0)]
        cases += [(f"retract_overlap = {overlap:g}", "G64", overlap) for overlap in options.overlap]
        for name, head, overlap in cases:
            seconds, worst, aside = measured(ncsim, folder, options.holes, head, overlap)
            text = (" | " if options.markdown else "  ").join([name, f"{seconds:.3f}", f"{seconds / least:.3f}"] + [f"{ratio:.3f}" for ratio in worst])
            print(sign + text + (" |" if options.markdown else ""))
            if max(worst) > 1.001 or aside > 1e-6:
                print(f"  not kept: {worst}, {aside:g} mm aside below R")
                wrong = True
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
