#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whole-process time of `ncsim check` against `rs274 -g` of Debian's linuxcnc-uspace on the same file in the same run.

usage: check_vs_rs274.py [--ncsim PATH] [--lines N] [--runs N] [--board [N]]

The file is a milled surface: G1 X Y Z lines in zigzag. With --board it is a board of N holes (100,000): one plain, pecked or reamed hole for
each line, drilled in rows by fixed cycles. rs274 writes one canonical call per line, here to /dev/null; one more
run of it, not timed, is counted to make sure that it interpreted every line. The best of the runs counts for both. Both use one thread;
CPU time decides, and wall time is printed beside it.
Exit status: 0, 1 when ncsim is less than 10 times as fast or something does not run, 77 (skipped) where rs274 is absent.
"""
import argparse
import math
import os
import sys
import tempfile

import peer

WANTED = 10.0


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


DRILLED, REAMED, PECKED = "G81", "G85", "G83"
CUTS = {DRILLED: 1, REAMED: 2, PECKED: 3}     # feed moves of one hole: R 1, Z -3.5, Q 2


def write_board(path, holes):
    """A board of holes in rows, to and fro, a tool for every 500 of them. Returns how many feed moves it has."""
    per_row, feeds = 250, 0
    with open(path, "w", encoding="ascii") as out:
        out.write("G21 G90 G17 G94\nS20000 M3\nG0 X0.000 Y0.000 Z5.000\nF600\n")
        for i in range(holes):
            row, column = divmod(i, per_row)
            place = f"X{1.27 * (column if row % 2 == 0 else per_row - 1 - column):.4f} Y{1.27 * row:.4f}"
            cycle = (DRILLED, DRILLED, PECKED, REAMED)[i // 500 % 4]
            feeds += CUTS[cycle]
            if i % 500 == 0:
                out.write(f"G80\nG0 Z5.000\nG99 {cycle} {place} Z-3.5 R1.0{' Q2.0' if cycle == PECKED else ''}\n")
            else:
                out.write(f"{place}\n")
        out.write("G80\nG0 Z5.000\nM2\n")
    return feeds


def board(options, rs274, ncsim):
    """Both on the board, and whether both have made every cut of it."""
    with tempfile.TemporaryDirectory() as folder:
        program = os.path.join(folder, "board.ngc")
        wanted = write_board(program, options.board)
        feeds = peer.feeds_of_rs274(rs274, program, folder)
        if feeds != wanted:
            sys.exit(f"rs274 made {feeds} cuts of {wanted}: the comparison would not be fair")
        setup = os.path.join(folder, "setup.json")
        with open(setup, "w", encoding="ascii") as out:
            out.write('{"params": {"1078": 1, "8013": 0.254}}')
        lines = sum(1 for _ in open(program, encoding="ascii"))
        ours, theirs = [], []
        for _ in range(options.runs):
            ours.append(peer.run([ncsim, "check", "--setup", setup, program], folder))
            if f" {lines} blocks" not in ours[-1][2]:
                sys.exit(f"ncsim did not run every block: {ours[-1][2].strip()}")
            theirs.append(peer.run([rs274, "-g", program, os.devnull], folder))
    print(f"board of {options.board} holes, {wanted} cuts, best of {options.runs}")
    return peer.report(options.board, "holes", ours, theirs, WANTED)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--ncsim", default=None)
    parser.add_argument("--lines", type=int, default=500_000)
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--board", type=int, nargs="?", const=100_000, default=None)
    options = parser.parse_args()
    rs274, ncsim = peer.find_rs274(), peer.find_ncsim(options.ncsim)
    if options.board is not None:
        return board(options, rs274, ncsim)
    with tempfile.TemporaryDirectory() as folder:
        program = os.path.join(folder, "surface.ngc")
        write_surface(program, options.lines)
        setup = os.path.join(folder, "setup.json")
        with open(setup, "w", encoding="ascii") as out:
            out.write('{"params": {"1078": 1}}')  # words without a point mean whole units, as in rs274
        feeds = peer.feeds_of_rs274(rs274, program, folder)
        if feeds != options.lines + 1:
            sys.exit(f"rs274 made {feeds} feed moves of {options.lines + 1}: the comparison would not be fair")
        ours, theirs = [], []
        for _ in range(options.runs):
            ours.append(peer.run([ncsim, "check", "--setup", setup, program], folder))
            if f" {options.lines + 5} blocks" not in ours[-1][2]:
                sys.exit(f"ncsim did not run every block: {ours[-1][2].strip()}")
            theirs.append(peer.run([rs274, "-g", program, os.devnull], folder))
        size = os.path.getsize(program) / 1e6
    print(f"{options.lines} lines, {size:.1f} MB, best of {options.runs}")
    return peer.report(options.lines, "lines", ours, theirs, WANTED)


if __name__ == "__main__":
    sys.exit(main())
