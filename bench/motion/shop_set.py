#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the measured set (shop_programs.py) through `ncsim motion` and compares its times with the shortest ones without a jerk limit, by toppra.

usage: bench/motion/shop [--markdown] [--trapezoid] [--accuracy] [--worst N] [--ncsim PATH] [--option TEXT ...] [PROGRAM ...]

PROGRAM: names of the set, or files. The columns are explained in bench/motion/README.md; `slowest` is the least path speed divided by the mean
one, away from rests, which is near 1 where the part is smooth. Optima are kept in build/motion-bench. Exit status: 0, 1 when a limit, the
tolerance or a feed is not kept or a program does not run.
"""
import hashlib
import json
import os
import re
import statistics
import sys

import free_optimum
import path_from_program
import peer_path
import programs
import reference
import runner
import shop_programs


def optimum(program, options):
    text = hashlib.sha256()
    for name in (program, *(os.path.join(runner.HERE, f) for f in ("free_optimum.py", "reference.py", "path_file.py", "path_from_program.py"))):
        with open(name, "rb") as file:
            text.update(file.read())
    text.update(repr((options.limits, options.tolerance)).encode())
    kept = os.path.join(runner.ROOT, "build", "motion-bench", text.hexdigest()[:24] + ".json")
    if os.path.exists(kept):
        with open(kept, encoding="ascii") as file:
            return json.load(file)["seconds"]
    path = path_from_program.path_of(program, options.ncsim, options.tolerance, "parabola")
    seconds = free_optimum.seconds(path, options.limits)
    os.makedirs(os.path.dirname(kept), exist_ok=True)
    with open(kept, "w", encoding="ascii") as file:
        json.dump({"program": os.path.basename(program), "seconds": seconds}, file)
    return seconds


def table(rows, options):
    lines = [["program", "time s", "without jerk limit s", "x", "slowest", "v", "a", "j", "feed", "off um"]]
    if options.markdown:
        lines.append(["---"] * len(lines[0]))
    for r in rows:
        if "failed" in r:
            lines.append([r["program"], r["failed"][:60]] + [""] * 8)
            continue
        worst = [f"{r['worst'][name][0]:.3f} {r['worst'][name][1]}" for name in runner.motion_check.ORDERS]
        lines.append([r["program"], f"{r['time']:.3f}", f"{r['free']:.3f}", f"{r['time'] / r['free']:.3f}", f"{r['slowest']:.2f}", *worst, f"{r['feed']:.3f}",
                      f"{r['deviation'] * 1000:.2f}"])
    if options.markdown:
        return "\n".join("| " + " | ".join(row) + " |" for row in lines)
    width = [max(len(row[k]) for row in lines if row[-1] or k == 0) for k in range(len(lines[0]))]
    return "\n".join("  ".join(cell.ljust(w) if k == 0 else cell.rjust(w) for k, (cell, w) in enumerate(zip(row, width))) for row in lines)


def arguments():
    parser = runner.common_arguments(__doc__)
    parser.add_argument("--worst", type=int, default=0, metavar="N", help="only the N rows that are farthest from the optimum, the worst one first")
    parser.add_argument("--trapezoid", action="store_true", help="the other mode: the law without a limit of jerk")
    parser.add_argument("--accuracy", action="store_true", help="G61.1, high-accuracy control, in the place of G64")
    return parser.parse_args()


def with_accuracy(program):
    """A copy of the program with G61.1 in the place of G64."""
    folder = os.path.join(runner.ROOT, "build", "motion-bench", "accuracy")
    os.makedirs(folder, exist_ok=True)
    copy = os.path.join(folder, os.path.basename(program))
    with open(program, encoding="ascii") as text, open(copy, "w", encoding="ascii") as out:
        out.write(re.sub(r"\bG64\b", "G61.1", text.read()))
    return copy


def main():
    options = arguments()
    options.ncsim = peer_path.ncsim(options.ncsim)
    options.option += ["--motion", "trapezoid" if options.trapezoid else "optimal", "--tolerance", f"{options.tolerance:g}"]
    written = programs.write(os.path.join(runner.ROOT, "build", "motion-bench", "shop"), shop_programs.PROGRAMS)
    named = {os.path.splitext(os.path.basename(p))[0]: p for p in written}
    rows = []
    for program in [named.get(p, p) for p in options.programs] or written:
        if sys.stderr.isatty():
            print(f"\r{os.path.basename(program):40}", end="", file=sys.stderr)
        try:
            row = runner.measured(program, options, with_accuracy(program) if options.accuracy else None)
            row["free"] = optimum(program, options)
        except (OSError, RuntimeError, runner.path_file.PathError) as error:
            row = {"program": os.path.basename(program), "failed": str(error)}
        rows.append(row)
    good = [r for r in rows if "failed" not in r]
    shown = sorted(good, key=lambda r: -r["time"] / r["free"])[:options.worst] if options.worst else rows
    print(table(shown, options))
    ratios = [r["time"] / r["free"] for r in good]
    if ratios:
        print(f"\n{len(ratios)} programs: {min(ratios):.3f} to {max(ratios):.3f} times the optimum without a jerk limit, median {statistics.median(ratios):.3f}")
        worst = max(good, key=lambda r: r["time"] / r["free"])
        print(f"the worst is {worst['program']}")
    runner.finish(rows, options)


if __name__ == "__main__":
    main()
