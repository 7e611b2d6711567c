#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whole-process time of `ncsim check` against `rs274 -g` of Debian's linuxcnc-uspace on the same file in the same run.

usage: check_vs_rs274.py [--ncsim PATH] [--lines N] [--runs N]

The file is a milled surface: G1 X Y Z lines in zigzag. rs274 writes one canonical call per line, here to /dev/null; one more
run of it, not timed, is counted to make sure that it interpreted every line. The best of the runs counts for both.
Exit status: 0, 1 when ncsim is less than 10 times as fast or something does not run, 77 (skipped) where rs274 is absent.
"""
import argparse
import math
import os
import shutil
import subprocess
import sys
import tempfile
import time

WANTED = 10.0


def find_ncsim():
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    for path in (os.environ.get("NCSIM"), os.path.join(os.environ.get("NC_BINARY_DIR", ""), "bin/ncsim"),
                 os.path.join(root, "build/release/bin/ncsim"), shutil.which("ncsim")):
        if path and os.access(path, os.X_OK):
            return path
    sys.exit("ncsim is not built; give --ncsim PATH")


def write_surface(path, lines):
    """A zigzag over a wavy surface; `lines` feed lines between a head and an end."""
    per_row = 1000
    with open(path, "w", encoding="ascii") as out:
        out.write("G21 G90 G17 G94\nG0 X0.000 Y0.000 Z5.000\nG1 Z0.000 F3000\n")
        for i in range(lines):
            row, column = divmod(i, per_row)
            x = 0.1 * (column if row % 2 == 0 else per_row - 1 - column)
            y = 0.1 * row + 0.05
            z = -2.0 + math.sin(0.07 * x) * math.cos(0.05 * y)
            out.write(f"G1 X{x:.4f} Y{y:.4f} Z{z:.4f}\n")
        out.write("G0 Z5.000\nM2\n")


def best_time(command, runs, folder):
    times = []
    for _ in range(runs):
        start = time.perf_counter()
        done = subprocess.run(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, check=False)
        times.append(time.perf_counter() - start)
        if done.returncode != 0:
            sys.exit(f"{command[0]}: exit {done.returncode}: {done.stdout[-300:]!r} {done.stderr[-300:]!r}")
    return min(times), done.stdout.decode(errors="replace")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--ncsim", default=None)
    parser.add_argument("--lines", type=int, default=500_000)
    parser.add_argument("--runs", type=int, default=3)
    options = parser.parse_args()
    rs274 = shutil.which("rs274")
    if not rs274:
        print("skipped: rs274 is not here (Debian: apt-get install linuxcnc-uspace)")
        return 77
    ncsim = os.path.abspath(options.ncsim or find_ncsim())
    with tempfile.TemporaryDirectory() as folder:
        program = os.path.join(folder, "surface.ngc")
        write_surface(program, options.lines)
        setup = os.path.join(folder, "setup.json")
        with open(setup, "w", encoding="ascii") as out:
            out.write('{"params": {"1078": 1}}')  # words without a point mean whole units, as in rs274
        listing = os.path.join(folder, "canonical.txt")
        subprocess.run([rs274, "-g", program, listing], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                       stderr=subprocess.DEVNULL, check=True)
        with open(listing, encoding="utf-8", errors="replace") as calls:
            feeds = sum("STRAIGHT_FEED(" in line for line in calls)
        if feeds != options.lines + 1:
            sys.exit(f"rs274 made {feeds} feed moves of {options.lines + 1}: the comparison would not be fair")
        ours, said = best_time([ncsim, "check", "--setup", setup, program], options.runs, folder)
        if f" {options.lines + 5} blocks" not in said:
            sys.exit(f"ncsim did not run every block: {said.strip()}")
        theirs, _ = best_time([rs274, "-g", program, os.devnull], options.runs, folder)
        size = os.path.getsize(program) / 1e6
    ratio = theirs / ours
    print(f"{options.lines} lines, {size:.1f} MB, best of {options.runs}")
    print(f"ncsim check  {ours:8.3f} s  {options.lines / ours / 1e6:6.2f} M lines/s")
    print(f"rs274 -g     {theirs:8.3f} s  {options.lines / theirs / 1e6:6.2f} M lines/s")
    print(f"ratio        {ratio:8.1f}    (wanted: {WANTED:.0f})")
    return 0 if ratio >= WANTED else 1


if __name__ == "__main__":
    sys.exit(main())
