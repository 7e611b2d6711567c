#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whole-process time of `ncsim check` against `rs274 -g` of Debian's linuxcnc-uspace on the same file in the same run.

usage: check_vs_rs274.py [--ncsim PATH] [--lines N] [--runs N]

The file is a milled surface: G1 X Y Z lines in zigzag. rs274 writes one canonical call per line, here to /dev/null; one more
run of it, not timed, is counted to make sure that it interpreted every line. The best of the runs counts for both. Both use one thread;
CPU time decides, since other work on the machine does not count in it, and wall time is printed beside it.
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


def run(command, folder):
    """(wall seconds, CPU seconds, standard output) of one process."""
    with tempfile.TemporaryFile() as out:
        start = time.perf_counter()
        process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=out, stderr=subprocess.DEVNULL)
        _, status, usage = os.wait4(process.pid, 0)
        wall = time.perf_counter() - start
        process.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        said = out.read().decode(errors="replace")
    if process.returncode != 0:
        sys.exit(f"{command[0]}: exit {process.returncode}: {said[-300:]}")
    return wall, usage.ru_utime + usage.ru_stime, said


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
        ours, theirs = [], []
        for _ in range(options.runs):  # in turns, so that both see the same load of the machine
            ours.append(run([ncsim, "check", "--setup", setup, program], folder))
            if f" {options.lines + 5} blocks" not in ours[-1][2]:
                sys.exit(f"ncsim did not run every block: {ours[-1][2].strip()}")
            theirs.append(run([rs274, "-g", program, os.devnull], folder))
        size = os.path.getsize(program) / 1e6
    print(f"{options.lines} lines, {size:.1f} MB, best of {options.runs}")
    best = {}
    for name, results in (("ncsim check", ours), ("rs274 -g", theirs)):
        wall, cpu = min(r[0] for r in results), min(r[1] for r in results)
        best[name] = (wall, cpu)
        print(f"{name:12} {wall:8.3f} s wall, {cpu:8.3f} s CPU, {options.lines / cpu / 1e6:6.2f} M lines per CPU second")
    wall_ratio = best["rs274 -g"][0] / best["ncsim check"][0]
    ratio = best["rs274 -g"][1] / best["ncsim check"][1]
    print(f"ratio        {wall_ratio:8.1f} wall, {ratio:8.1f} CPU (wanted: {WANTED:.0f})")
    return 0 if ratio >= WANTED else 1


if __name__ == "__main__":
    sys.exit(main())
