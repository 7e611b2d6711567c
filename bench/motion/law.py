#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Compares the time-optimal law alone with the reference on the same geometry, which is the path that it made of the lines of a program.

usage: "$(bench/motion/setup)" bench/motion/law.py [--law PATH] [--ncsim PATH] [--step-ms S] [--random N] [PROGRAM ...]

PROGRAM may have rapids and straight feeds only. --random N adds N programs of random lines, the same ones each time. `law_of_lines` (one of
the benches, NC_BENCH=ON) smooths each stretch between two rests and finds its law; reference.py gets the smoothed path. Exit status: 0, 1 when
a law takes longer than --most times the reference, or when none was found.
"""
import argparse
import os
import re
import statistics
import subprocess
import sys
import tempfile

import path_file
import path_from_program
import peer_path
import programs
import reference

HERE = os.path.dirname(os.path.abspath(__file__))


def write_polylines(program, ncsim, name):
    events = path_from_program.trace(ncsim, program)
    axes = list(next(e for e in events if e["t"] == "end")["machine"])
    if axes != ["X", "Y", "Z"]:
        raise path_file.PathError(f"{program}: axes X Y Z are needed")
    groups, _ = path_from_program.moves_of(events, axes, path_from_program.exact_stop_lines(program), [0.0] * 3)
    with open(name, "w", encoding="ascii") as out:
        for moves in groups:
            if any(m.arc is not None for m in moves):
                raise path_file.PathError(f"{program}: has arcs")
            line = path_from_program.Polyline.of(moves)
            out.write(f"{len(line.points)}\n")
            for point, feed in zip(line.points.tolist(), [0.0] + line.feeds.tolist()):
                out.write(" ".join(repr(v) for v in point + [feed]) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", nargs="*", metavar="PROGRAM")
    parser.add_argument("--law", default=os.path.join(HERE, "..", "..", "build", "release", "bin", "law_of_lines"))
    parser.add_argument("--ncsim")
    parser.add_argument("--random", type=int, default=0, metavar="N")
    parser.add_argument("--limits", type=reference.parse_limits, default=(250.0, 2000.0, 50000.0), metavar="V,A,J")
    parser.add_argument("--tolerance", type=float, default=0.01)
    parser.add_argument("--step-ms", type=float, default=2.0)
    parser.add_argument("--most", type=float, default=1.03)
    options = parser.parse_args()
    ncsim = peer_path.ncsim(options.ncsim)
    if not options.programs and options.random == 0:
        parser.error("no PROGRAM and no --random")
    drawn = tempfile.TemporaryDirectory()
    options.programs += programs.write_random(drawn.name, options.random)
    ratios, failed = [], False
    print(f"{'program':24} {'law s':>10} {'reference s':>12} {'x':>7} {'lines':>8} {'pieces':>8}")
    for program in options.programs:
        name = os.path.splitext(os.path.basename(program))[0]
        try:
            with tempfile.TemporaryDirectory() as folder:
                lines, path = os.path.join(folder, "lines"), os.path.join(folder, "law.path")
                write_polylines(program, ncsim, lines)
                numbers = [f"{v!r}" for v in (*options.limits, options.tolerance)]
                done = subprocess.run([options.law, lines, path] + numbers, capture_output=True, text=True)
                if done.returncode != 0:
                    raise path_file.PathError(done.stderr.strip())
                geometry = path_file.read(path)
            seconds, count, pieces = (float(v) for v in re.match(r"time ([\d.]+) s, (\d+) lines, (\d+) pieces", done.stdout).groups())
            best = reference.Solution(geometry, reference.limits_of(geometry, options.limits), options.step_ms * 1e-3).seconds
        except (OSError, RuntimeError, path_file.PathError) as error:
            print(f"{name:24} {error}", flush=True)
            failed = True
            continue
        ratios.append(seconds / best)
        print(f"{name:24} {seconds:10.4f} {best:12.4f} {ratios[-1]:7.4f} {count:8.0f} {pieces:8.0f}", flush=True)
    if ratios:
        print(f"{len(ratios)} programs: {min(ratios):.4f} to {max(ratios):.4f} times the reference, median {statistics.median(ratios):.4f}")
    sys.exit(1 if failed or max(ratios, default=0) > options.most else 0)


if __name__ == "__main__":
    main()
