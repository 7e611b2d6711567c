#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Does radius compensation cost time? Contours with G41/G42 and ,R ,C against the same path of the tool, written without compensation.

  bench/compensated_contour.py [--contours N] [--seed N] [--feed F]

The contours are those of tests/offset/oracle_test.py: lines and arcs, inside and outside, a third of them chamfered and rounded. Each is run in the
time-optimal mode; then the path of its tool, as `ncsim trace` shows it, is run as a program of its own. Exit status 1 where the compensated one takes
0.1 % longer. Needs python3-shapely.
"""
import argparse
import json
import math
import os
import subprocess
import sys
import tempfile

root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
sys.path.insert(0, os.path.join(root, "tests", "offset"))
import oracle_test  # noqa: E402

NCSIM = os.path.join(os.environ.get("NC_BINARY_DIR", os.path.join(root, "build", "release")), "bin", "ncsim")
MOST = 0.001
SPIRAL = 0.001  # mm


def seconds(folder, blocks):
    path = os.path.join(folder, "timed.nc")
    with open(path, "w", encoding="ascii") as out:
        out.write("\n".join(["G17 G90 G21 G94", *blocks, "M30", ""]))
    said = subprocess.run([NCSIM, "time", "--motion", "optimal", "--cycle-us", "100", path], stdout=subprocess.PIPE, check=True, text=True).stdout
    return float(said.split("cycle time")[1].split()[0])


def path_of(folder, blocks):
    """The blocks of the tool's path without compensation; None where the contour ends in an alarm, or has an amount that changes along an arc: the tool goes
    on a spiral there, which G2 and G3 cannot say."""
    program = os.path.join(folder, "compensated.nc")
    with open(program, "w", encoding="ascii") as out:
        out.write("\n".join(["G17 G90 G21 G94", *blocks, "M30", ""]))
    at, path = {"X": 0.0, "Y": 0.0}, []
    trace = subprocess.run([NCSIM, "trace", program], stdout=subprocess.PIPE, check=False, text=True).stdout
    for event in map(json.loads, trace.splitlines()):
        if event["t"] == "alarm":
            return None
        if event["t"] != "move":
            continue
        to, center = event["machine"], event.get("machine_center")
        words = f"X{to['X']:.9f} Y{to['Y']:.9f} Z{to['Z']:.9f}"
        feed = "" if event["feed"] is None else f" F{event['feed']}"
        if event["kind"] == "rapid":
            path.append(f"G0 {words}")
        elif center:
            radii = [math.hypot(point[0] - center["X"], point[1] - center["Y"]) for point in ((at["X"], at["Y"]), (to["X"], to["Y"]))]
            if abs(radii[0] - radii[1]) > SPIRAL:
                return None
            path.append(f"G{3 if event['dir'] == 'ccw' else 2} {words} I{center['X'] - at['X']:.9f} J{center['Y'] - at['Y']:.9f}{feed}")
        else:
            path.append(f"G1 {words}{feed}")
        at = to
    return path


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("--contours", type=int, default=100)
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--feed", type=float, default=3000, help="mm/min")
    given = options.parse_args()
    slower, sum_of_both, compared, seed = [], [0.0, 0.0], 0, given.seed
    with tempfile.TemporaryDirectory() as folder:
        while compared < given.contours:
            contour = oracle_test.Contour(seed)
            seed += 1
            blocks = [block.replace("F1000", f"F{given.feed:g}") for block in contour.blocks()]
            path = path_of(folder, blocks)
            if path is None:
                continue
            compared += 1
            both = seconds(folder, blocks), seconds(folder, path)
            for i in range(2):
                sum_of_both[i] += both[i]
            if both[0] > both[1] * (1 + MOST):
                slower.append((both[0] / both[1] - 1, seed - 1))
                print(f"seed {seed - 1}: {both[0]:.4f} s compensated, {both[1]:.4f} s without: {100 * slower[-1][0]:+.2f} %")
    print(f"{compared} contours at F{given.feed:g}: {sum_of_both[0]:.3f} s compensated, {sum_of_both[1]:.3f} s without "
          f"({100 * (sum_of_both[0] / sum_of_both[1] - 1):+.3f} %); {len(slower)} slower by more than {100 * MOST:g} %")
    return 1 if slower else 0


if __name__ == "__main__":
    sys.exit(main())
