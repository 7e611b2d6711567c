# SPDX-License-Identifier: Apache-2.0
"""No call of nc_feed() takes more than its budget and 200,000 instructions: counted by callgrind, so that it does not hang on the machine.

A program of each kind (corners, noise of a CAM system, a hatch, arcs, NURBS and splines, rests) is gone with small budgets, while holds and another override
come again and again. Skipped where there is no valgrind, and under sanitizers, which count other instructions. With NC_SHORT=1 four of the nine programs run.
"""
import math
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = os.environ.get("NC_SOURCE_DIR") or os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
BINARY = os.environ.get("NC_BINARY_DIR") or os.path.join(ROOT, "build", "release")
DRIVER = os.path.join(BINARY, "bin", "feed_slices")
UNIT = 20000  # instructions (nc/run.h)
BEYOND = 200000
SHORT = os.environ.get("NC_SHORT", "0") != "0"
GROUP = 8  # calls that are counted together at first
NEARLY = 2000  # instructions by which two runs may differ
HEAD = "G17 G21 G90 G94 G40 G49 G64\nG0 X0. Y0. Z0.\n"

if os.environ.get("NC_SANITIZE"):
    print("skipped: sanitizers count other instructions")
    sys.exit(77)
if shutil.which("valgrind") is None or not os.path.exists(DRIVER):
    print("skipped: this wants valgrind, and the benches to be built")
    sys.exit(77)


def lines(points, feed):
    return HEAD + "".join(f"G1 X{x:.4f} Y{y:.4f} Z{z:.4f}{f' F{feed}' if n == 0 else ''}\n" for n, (x, y, z) in enumerate(points)) + "M30\n"


def corners():
    return lines([((n % 2) * 8 + n * 0.3, (n // 2 % 2) * 6, 0) for n in range(1, 4)], 6000)


def noise():
    draw = random.Random(5)
    return lines([(n * 0.05, 2 * math.sin(n * 0.02), draw.gauss(0, 0.001)) for n in range(1, 150)], 6000)


def hatch():
    points = []
    for row in range(3):
        points += [(6 if row % 2 == 0 else 0, row * 0.1, 0), (6 if row % 2 == 0 else 0, (row + 1) * 0.1, 0)]
    return lines(points, 9000)


def walk():
    draw = random.Random(7)
    x, y, heading, points = 0.0, 0.0, 0.0, []
    for _ in range(7):
        heading += draw.uniform(-2, 2)
        length = 10 ** draw.uniform(-1.5, 0.5)
        x, y = x + length * math.cos(heading), y + length * math.sin(heading)
        points.append((x, y, 0))
    return lines(points, 4000)


def arcs():
    text = HEAD + "G1 F5000\n"
    for n in range(8):
        text += f"G{2 + n % 2} X{4 * (n + 1)} R{2.5 + 0.1 * n}\n" + (f"G1 X{4 * (n + 1)} Y{n % 3}\nY0\n" if n % 4 == 3 else "")
    return text + "M30\n"


def curves():
    """A NURBS of degree 3, and one with weights that is a quarter of a circle."""
    return HEAD + """G5 P10000
G1 X20. F6000
G06.2 P4 K0 X20. Y0.
K0 X25. Y5.
K0 X30. Y-5.
K0 X35. Y0.
K1.
K1.
K1.
K1.
G1 X36. Y0.
G06.2 P3 K0 X36. Y0. R1.
K0 X46. Y0. R0.7071
K0 X46. Y10. R1.
K1.
K1.
K1.
G5 P0
M30
"""


def splines():
    points = "".join(f"X{3 * n}. Y{2 * math.sin(n):.4f} Z{math.cos(0.7 * n):.4f}\n" for n in range(1, 5))
    return HEAD + "G1 F5000\nG5 P10000\nG5.1 Q2 X0 Y0 Z0\n" + points + "G5.1 Q0\nG5 P0\nM30\n"


def rests():
    return HEAD + "".join(f"G0 X{10 * n} Y{n}\nG1 Z-3. F800\nG4 P20\nG0 Z0.\n" for n in range(1, 5)) + "M30\n"


def counted(program, budget, hold_every, group=1, apart=()):
    """Instructions of nc_feed() in each group of calls, and what the driver says; the groups that begin with a call of `apart` are counted call by call."""
    with tempfile.TemporaryDirectory() as folder:
        name, out = os.path.join(folder, "part.nc"), os.path.join(folder, "calls")
        with open(name, "w") as file:
            file.write(program)
        run = subprocess.run(["valgrind", "--tool=callgrind", "--dump-line=no", "--combine-dumps=yes", "--toggle-collect=nc_feed", "--fn-skip=nc::*",
                              "--dump-after=group_ends", f"--callgrind-out-file={out}", DRIVER, str(budget), "40", str(hold_every), name, str(group),
                              *map(str, apart)], capture_output=True, text=True)
        if run.returncode != 0:
            raise AssertionError(run.stderr[-2000:])
        with open(out) as file:
            found = [int(line.split()[1]) for line in file if re.match(r"totals: \d", line)]
        if found[-1] == 0:  # callgrind writes once more as the driver ends
            found.pop()
        return found, int(re.search(r"(\d+) calls", run.stdout)[1])


def longest_call(program, budget, hold_every):
    """Calls, instructions of all, and of the longest call.

    Callgrind takes longer to write a count down than to count, so the calls are counted in groups first. No call is longer than its group: only the
    groups that are above the limit, and above the longest call known, are then counted call by call. Two runs do the same but for what the C library does with memory that lies otherwise: some ten instructions.
    """
    limit = budget * UNIT + BEYOND
    groups, calls = counted(program, budget, hold_every, GROUP)
    by_length = sorted(range(len(groups)), key=lambda n: -groups[n])
    apart = {n * GROUP for n in by_length if groups[n] > limit - NEARLY} | {n * GROUP for n in by_length[:10]}
    single, calls_again = counted(program, budget, hold_every, GROUP, sorted(apart))
    if calls_again != calls or abs(sum(single) - sum(groups)) > NEARLY:
        raise AssertionError(f"{calls} calls took {sum(groups)} instructions, and {calls_again} calls {sum(single)} in the second run")
    longest, at = 0, 0
    for n, length in enumerate(groups):
        if n * GROUP in apart:
            of_group = min(GROUP, calls - n * GROUP)
            if abs(sum(single[at:at + of_group]) - length) > NEARLY:
                raise AssertionError(f"the calls of group {n} do not make up its {length} instructions")
            longest = max(longest, *single[at:at + of_group])
            at += of_group
        else:
            at += 1
    return calls, sum(groups), longest


class FeedSlices(unittest.TestCase):
    def check(self, program, budget=2, hold_every=71):
        calls, instructions, longest = longest_call(program, budget, hold_every)
        self.assertGreater(calls, 100)
        self.assertGreater(instructions, 10 * BEYOND, "next to nothing was planned")
        print(f"{self.id().split('.')[-1]}: {calls} calls, {instructions / 1e6:.0f} million instructions, the longest that was counted alone {longest}")
        self.assertLessEqual(longest, budget * UNIT + BEYOND)

    def test_corners(self):
        self.check(corners())

    @unittest.skipIf(SHORT, "for the night")
    def test_noise(self):
        self.check(noise())

    @unittest.skipIf(SHORT, "for the night")
    def test_hatch(self):
        self.check(hatch())

    def test_walk(self):
        self.check(walk())

    def test_arcs(self):
        self.check(arcs())

    # Curves take millions of instructions, so these have fewer and longer calls.
    def test_curves(self):
        self.check(curves(), budget=10)

    @unittest.skipIf(SHORT, "for the night")
    def test_splines(self):
        self.check(splines(), budget=10)

    @unittest.skipIf(SHORT, "for the night")
    def test_rests(self):
        self.check(rests())

    @unittest.skipIf(SHORT, "for the night")
    def test_larger_budget(self):
        self.check(walk(), budget=20)


if __name__ == "__main__":
    unittest.main()
