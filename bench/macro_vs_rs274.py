#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whole-process time of a macro loop: `ncsim check` against `rs274 -g` of Debian's linuxcnc-uspace on its equivalent, in the same run.

usage: macro_vs_rs274.py [--ncsim PATH] [--turns N] [--runs N]

Each turn of the loop has five statements, with SIN and COS, and one move. In one run of rs274, which is not timed, the moves are counted to
make sure that it made all of them. CPU time decides, and wall time is printed beside it.
Exit status: 0, 1 when ncsim is less than 20 times as fast or something does not run, 77 (skipped) where rs274 is absent.
"""
import argparse
import os
import sys
import tempfile

import peer

WANTED = 20.0


def ours_text(turns):
    return (f"G21 G90 G17 G94\nF3000.\n#1=0\nWHILE [#1 LT {turns}] DO1\n#2=#1*0.1\n#3=20*COS[#2]\n#4=20*SIN[#2]\n"
            "#5=#3*#3/100-#4\nG1 X#3 Y#4 Z#5\n#1=#1+1\nEND1\nM2\n")


def theirs_text(turns):
    return (f"G21 G90 G17 G94\nF3000.\n#1=0\no100 while [#1 lt {turns}]\n#2=[#1*0.1]\n#3=[20*cos[#2]]\n#4=[20*sin[#2]]\n"
            "#5=[#3*#3/100-#4]\nG1 X#3 Y#4 Z#5\n#1=[#1+1]\no100 endwhile\nM2\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--ncsim", default=None)
    parser.add_argument("--turns", type=int, default=200_000)
    parser.add_argument("--runs", type=int, default=3)
    options = parser.parse_args()
    rs274, ncsim = peer.find_rs274(), peer.find_ncsim(options.ncsim)
    with tempfile.TemporaryDirectory() as folder:
        mine, other = os.path.join(folder, "loop.nc"), os.path.join(folder, "loop.ngc")
        for path, text in ((mine, ours_text(options.turns)), (other, theirs_text(options.turns))):
            with open(path, "w", encoding="ascii") as out:
                out.write(text)
        feeds = peer.feeds_of_rs274(rs274, other, folder)
        if feeds != options.turns:
            sys.exit(f"rs274 made {feeds} feed moves of {options.turns}: the comparison would not be fair")
        ours, theirs = [], []
        for _ in range(options.runs):
            ours.append(peer.run([ncsim, "check", mine], folder))
            theirs.append(peer.run([rs274, "-g", other, os.devnull], folder))
        said = ours[-1][2]
    print(f"{options.turns} turns, best of {options.runs}; {said.strip().splitlines()[-1]}")
    return peer.report(options.turns, "turns", ours, theirs, WANTED)


if __name__ == "__main__":
    sys.exit(main())
