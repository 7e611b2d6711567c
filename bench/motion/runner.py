#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs programs through `ncsim motion` and prints a table: time, worst ratio to the limits of the axes, distance from the path.

usage: bench/motion/run [--markdown] [--reference] [--ncsim PATH] [--option "TEXT" ...] [PROGRAM ...]

Without PROGRAM it runs those of programs.py, and those of ../shared/bench/motion if that is there. `ncsim` gets the limits and the options.
Everything is measured from the rows that it writes: finite differences with rests added on both sides, the distance of every row to the
programmed lines and arcs, which are followed forward, and the feed. --reference adds the shortest possible time of the same program, with its
corners rounded within the tolerance (path_from_program.py), with and without the jerk limit (reference.py); it is kept in build/motion-bench.
Exit status: 0, 1 when a limit, the tolerance or a feed is not kept or a program does not run.
"""
import argparse
import hashlib
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile
import time

import numpy as np

import motion_check
import path_file
import path_from_program
import peer_path
import programs
import reference

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
SHARED = os.path.join(ROOT, "..", "shared", "bench")


AWAY = 300  # so many rows beside a rest do not count for the least speed


def slowest_of_mean(rows):
    """The least path speed divided by the mean one, away from rests; 0 if no row is far enough from a rest."""
    steps = np.linalg.norm(np.diff(rows, axis=0), axis=1)
    moving = np.concatenate([[0], steps > 0, [0]]).astype(int)
    edges = np.flatnonzero(np.diff(moving))
    inner = [steps[a + AWAY:b - AWAY] for a, b in zip(edges[::2], edges[1::2]) if b - a > 2 * AWAY]
    if not inner:
        return 0.0
    inner = np.concatenate(inner)
    return float(inner.min() / inner.mean())


def measured(program, options, runs=None):
    """Runs one program; returns its row of the table. runs: the file that is run in its place, with the same path."""
    row = {"program": os.path.splitext(os.path.basename(program))[0]}
    with tempfile.TemporaryDirectory() as folder:
        rows_file = os.path.join(folder, "motion.csv")
        command = [options.ncsim, "motion", "--limits", ",".join(f"{v:g}" for v in options.limits), "--cycle-us", str(options.cycle_us),
                   "-o", rows_file] + options.option + [runs or program]
        begin = time.perf_counter()
        done = subprocess.run(command, capture_output=True, text=True)
        row["wall"] = time.perf_counter() - begin
        if done.returncode != 0:
            row["failed"] = f"exit {done.returncode}: {done.stderr.strip()[-200:]}"
            return row
        axes, cycle_s, rows = motion_check.read_motion(rows_file)
    row["axes"] = axes
    still = motion_check.np.flatnonzero(motion_check.np.any(motion_check.np.diff(rows, axis=0) != 0, axis=1))
    row["cycle_time"] = (len(rows) - 1) * cycle_s
    row["time"] = float((still[-1] - still[0] + 1) * cycle_s) if len(still) else 0.0
    limits = [options.limits] * len(axes)
    row["slowest"] = slowest_of_mean(rows)
    row["worst"] = {name: max((ratio, axis, seconds) for axis, (ratio, seconds) in zip(axes, values))
                    for name, values in motion_check.worst_ratios(rows, cycle_s, limits).items()}
    path = path_from_program.path_of(program, options.ncsim, options.tolerance, "none")
    seen = motion_check.Follower(path, cycle_s, options.tolerance).follow(rows)
    row["deviation"], row["feed"] = seen.deviation[0], seen.feed[0]
    row["breaches"] = motion_check.breaches(axes, rows, cycle_s, limits, path, options.tolerance, options.factor)
    return row


def optimum(program, options, jerk):
    """The time of the reference in s; it is read from build/motion-bench if it was solved before."""
    text = hashlib.sha256()
    for name in (program, *(os.path.join(HERE, f) for f in ("reference.py", "path_file.py", "path_from_program.py", "quadratic.py"))):
        with open(name, "rb") as file:
            text.update(file.read())
    text.update(repr((options.limits, options.tolerance, jerk, options.step_ms, options.path)).encode())
    folder = os.path.join(ROOT, "build", "motion-bench")
    kept = os.path.join(folder, text.hexdigest()[:24] + ".json")
    if os.path.exists(kept):
        with open(kept, encoding="ascii") as file:
            return json.load(file)["seconds"]
    given = options.path and os.path.join(options.path, os.path.splitext(os.path.basename(program))[0] + ".path")
    if given and os.path.exists(given):
        path = path_file.read(given)
    else:
        path = path_from_program.path_of(program, options.ncsim, options.tolerance, "cubic" if jerk else "parabola")
    solution = reference.Solution(path, reference.limits_of(path, options.limits), options.step_ms * 1e-3, jerk)
    os.makedirs(folder, exist_ok=True)
    with open(kept, "w", encoding="ascii") as file:
        json.dump({"program": os.path.basename(program), "seconds": solution.seconds}, file)
    return solution.seconds


def peers():
    """The names of the columns and {program: [seconds in each column]} of the table in ../shared/bench/README.md; empty without that file."""
    out, names = {}, []
    try:
        with open(os.path.join(SHARED, "README.md"), encoding="utf-8") as lines:
            for text in lines:
                cells = [c.strip() for c in text.strip().strip("|").split("|")]
                if len(cells) == 4 and cells[0] == "program":
                    names = cells[1:]
                match = re.match(r"motion/(\w+)\.nc", cells[0])
                if match and len(cells) == 4:
                    out[match.group(1)] = [float(re.match(r"[\d.]+", c).group()) for c in cells[1:]]
    except OSError:
        pass
    return names, out


def table(rows, options):
    names, facts = peers()
    head = ["program", "time s"]
    if options.reference:
        head += ["optimum s", "x", "without jerk limit s", "x"]
    if any(r["program"] in facts for r in rows):
        head += [f"{n} s" for n in names if "LinuxCNC" in n]
    head += ["v", "a", "j", "feed", "off um"]
    lines = [head]
    for r in rows:
        if "failed" in r:
            lines.append([r["program"], r["failed"]] + [""] * (len(head) - 2))
            continue
        cells = [r["program"], f"{r['time']:.3f}"]
        if options.reference:
            for key in ("optimum", "free"):
                cells += [f"{r[key]:.3f}", f"{r['time'] / r[key]:.3f}"] if r.get(key) else ["", ""]
        peer = facts.get(r["program"])
        for k, n in enumerate(names):
            if "LinuxCNC" in n and len(head) > len(cells) + 5:
                cells.append(f"{peer[k]:.3f}" if peer else "")
        for name in motion_check.ORDERS:
            ratio, axis, _ = r["worst"][name]
            cells.append(f"{ratio:.3f} {axis}")
        lines.append(cells + [f"{r['feed']:.3f}", f"{r['deviation'] * 1000:.2f}"])
    if options.markdown:
        lines.insert(1, ["---"] * len(head))
        return "\n".join("| " + " | ".join(row) + " |" for row in lines)
    width = [max(len(row[k]) for row in lines if "exit " not in row[1] or k == 0) for k in range(len(head))]
    return "\n".join("  ".join(cell.ljust(w) if k == 0 else cell.rjust(w) for k, (cell, w) in enumerate(zip(row, width))) for row in lines)


def summary(rows, options):
    good = [r for r in rows if "failed" not in r]
    out = []
    for key, what in (("optimum", "the optimum"), ("free", "the optimum without a jerk limit")):
        ratios = [r["time"] / r[key] for r in good if r.get(key)]
        if ratios:
            out.append(f"{len(ratios)} programs: {min(ratios):.3f} to {max(ratios):.3f} times {what}, median {statistics.median(ratios):.3f}")
    for name in motion_check.ORDERS:
        if good:
            out.append(f"worst {name}: {max(r['worst'][name][0] for r in good):.4f} of its limit")
    return "\n".join(out)


def common_arguments(description):
    """A parser with the arguments that every set of programs has."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("programs", nargs="*", metavar="PROGRAM")
    parser.add_argument("--ncsim")
    parser.add_argument("--limits", type=reference.parse_limits, default=(250.0, 2000.0, 50000.0), metavar="V,A,J")
    parser.add_argument("--tolerance", type=float, default=0.01, metavar="MM")
    parser.add_argument("--cycle-us", type=int, default=1000)
    parser.add_argument("--factor", type=float, default=1.001, help="of a limit that is still kept")
    parser.add_argument("--option", action="append", default=[], metavar="TEXT", help="one more argument of ncsim motion; --option=--word")
    parser.add_argument("--markdown", action="store_true")
    parser.add_argument("--breaches", action="store_true", help="list everything that is not kept")
    return parser


def finish(rows, options):
    """Prints how many programs keep everything, and ends with exit status 1 if one does not."""
    bad = [r for r in rows if "failed" in r or r["breaches"]]
    if options.breaches:
        for r in bad:
            for text in [r["failed"]] if "failed" in r else r["breaches"]:
                print(f"{r['program']}: {text}")
    print(f"{len(rows) - len(bad)} of {len(rows)} programs keep everything")
    sys.exit(1 if bad else 0)


def arguments():
    parser = common_arguments(__doc__)
    parser.add_argument("--reference", action="store_true", help="solve for the shortest possible times too (minutes)")
    parser.add_argument("--path", metavar="FOLDER", help="paths for the reference, NAME.path for NAME.nc")
    parser.add_argument("--step-ms", type=float, default=1.0, help="time between the nodes of the reference")
    return parser.parse_args()


def main():
    options = arguments()
    options.ncsim = peer_path.ncsim(options.ncsim)
    chosen = options.programs
    if not chosen:
        chosen = programs.write(os.path.join(ROOT, "build", "motion-bench", "programs"))
        shared = os.path.join(SHARED, "motion")
        if os.path.isdir(shared):
            chosen += sorted(os.path.join(shared, f) for f in os.listdir(shared) if f.endswith(".nc"))
    rows = []
    try:
        for program in chosen:
            if sys.stderr.isatty():
                print(f"\r{os.path.basename(program):40}", end="", file=sys.stderr)
            row = measured(program, options)
            if options.reference and "failed" not in row:
                for key, jerk in (("optimum", True), ("free", False)):
                    try:
                        row[key] = optimum(program, options, jerk)
                    except (path_file.PathError, RuntimeError) as error:
                        row["breaches"].append(f"no reference: {error}")
            rows.append(row)
    except (OSError, path_file.PathError, RuntimeError) as error:
        sys.exit(f"motion benchmark: {program}: {error}")
    print(table(rows, options))
    print()
    print(summary(rows, options))
    finish(rows, options)


if __name__ == "__main__":
    main()
