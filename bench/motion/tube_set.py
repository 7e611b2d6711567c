#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs short pieces of shop programs and prints how much longer they take than the shortest time in the tube (tube_optimum.py).

usage: bench/motion/tube [--markdown] [--say] [--ncsim PATH] [--option TEXT ...] [PROGRAM ...]

PROGRAM: names of the pieces, or files that run for some seconds. Every motion between two rests is optimized by itself. Exit status: 0, 1 when
a program does not run or rests at a place that is not programmed.
"""
import math
import os
import subprocess
import sys
import tempfile

import numpy as np

import motion_check
import path_file
import path_from_program
import peer_path
import programs
import runner
import shop_programs
import tube_optimum
from programs import HEAD, line, polyline


def of_shop(name, moves):
    """The beginning of a program of the measured set up to so many moves; its head and other blocks do not count as moves."""
    out, left = [], moves
    for text in shop_programs.PROGRAMS[name]().splitlines(keepends=True):
        if text.startswith("M30"):
            break
        out.append(text)
        left -= text.startswith(("G1", "G2 ", "G3"))
        if left == 0:
            break
    return "".join(out) + "M30\n"


def surface_rows(noise):
    """Two rows of the surface in lines of 0.05 mm."""
    return of_shop("surface_005" + ("_noise" if noise else ""), 2 * 801 - 1)


def corner(degrees):
    """Two lines of 12 mm, the second one turned by so much."""
    turn = math.radians(degrees)
    return polyline([(0.0, 0.0, 0.0), (12.0, 0.0, 0.0), (12.0 + 12.0 * math.cos(turn), 12.0 * math.sin(turn), 0.0)], 6000)


PROGRAMS = {
    "corner": lambda: corner(90),
    "corner_45": lambda: corner(45),
    "corner_135": lambda: corner(135),
    "corner_165": lambda: corner(165),
    "hatch_rows": lambda: of_shop("hatch", 5),
    "trochoid_loops": lambda: of_shop("trochoid", 360),
    "trochoid_arc_loops": lambda: of_shop("trochoid_arcs", 6),
    "letter": lambda: of_shop("engraving", 13),
    "letter_of_arcs": lambda: HEAD + "G64\nG0 X0. Y0. Z0.\n" + line(1800, X=0.6, Y=0.5) + "G2 X0.6 Y-1.1 I0. J-0.8\nG3 X0.6 Y-2.7 I0. J-0.8\n" +
                      line(X=0.1, Y=-2.2) + line(X=-0.5, Y=-2.4) + "M30\n",
    "surface_rows": lambda: surface_rows(False),
    "surface_rows_noise": lambda: surface_rows(True),
    "arcs": lambda: of_shop("arc_fitted", 24),
    "adaptive_passes": lambda: of_shop("adaptive", 10),
    "random_03_lines": lambda: of_shop("random_03", 200),
    "random_06_lines": lambda: of_shop("random_06", 150),
    "random_18_lines": lambda: of_shop("random_18", 60),
}


def measured(program, options):
    """A row of the table: the time in motion of the recording and the shortest time in the tube, both in s."""
    with tempfile.TemporaryDirectory() as folder:
        name = os.path.join(folder, "motion.csv")
        command = [options.ncsim, "motion", "--limits", ",".join(f"{v:g}" for v in options.limits), "--cycle-us", str(options.cycle_us), "-o", name]
        done = subprocess.run(command + options.option + [program], capture_output=True, text=True)
        if done.returncode != 0:
            raise path_file.PathError(f"exit {done.returncode}: {done.stderr.strip()[-200:]}")
        axes, cycle_s, rows = motion_check.read_motion(name)
    events = path_from_program.trace(options.ncsim, program)
    groups, rests = path_from_program.moves_of(events, axes, path_from_program.exact_stop_lines(program), rows[0])
    groups, _ = path_from_program.without_reversals(groups, rests)
    groups = [g for g in groups if any(np.any(m.end != m.start) or m.arc is not None for m in g)]
    ours = least = 0.0
    for moves, part in zip(groups, tube_optimum.stretches(rows, [moves[-1].end for moves in groups])):
        tube = tube_optimum.Tube(path_from_program.Polyline.of(moves), part, cycle_s, options.limits, options.tolerance)
        ours += tube.seconds()
        least += tube.solve((lambda text: print(text, file=sys.stderr, flush=True)) if options.say else None)
    return ours, least


def arguments():
    parser = runner.common_arguments(__doc__)
    parser.add_argument("--say", action="store_true", help="each step of the optimiser")
    return parser.parse_args()


def main():
    options = arguments()
    options.ncsim = peer_path.ncsim(options.ncsim)
    options.option += ["--motion", "optimal", "--tolerance", f"{options.tolerance:g}"]
    written = programs.write(os.path.join(runner.ROOT, "build", "motion-bench", "tube"), PROGRAMS)
    named = {os.path.splitext(os.path.basename(p))[0]: p for p in written}
    lines, failed = [["program", "time s", "in the tube s", "x"]], False
    if options.markdown:
        lines.append(["---"] * 4)
    for program in [named.get(p, p) for p in options.programs] or written:
        name = os.path.splitext(os.path.basename(program))[0]
        try:
            ours, least = measured(program, options)
            lines.append([name, f"{ours:.3f}", f"{least:.3f}", f"{ours / least:.3f}"])
        except (OSError, ValueError, path_file.PathError) as error:
            lines.append([name, str(error)[:60], "", ""])
            failed = True
        if not options.markdown:
            print("  ".join(f"{cell:>12}" if k else f"{cell:22}" for k, cell in enumerate(lines[-1])), flush=True)
    if options.markdown:
        print("\n".join("| " + " | ".join(row) + " |" for row in lines))
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
