#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How many blocks per second become set-points in the time-optimal mode, measured on circles of radius 10 mm in short lines.

usage: blocks_to_setpoint.py [--ncsim PATH] [--lines N]

Each program is run by `ncsim time` on virtual time: interpreter, smoothing, time law and the scan of each cycle, in one thread. For each length
of the lines and feed it prints the blocks that the machine executes per second of its own time, the share of the feed that it reaches, and the
blocks that one core processes per second of processor time. Where the last figure is above the first, the computer supplies the machine fast
enough. Exit status: 0, 1 when it is not fast enough for one of the programs.
"""
import argparse
import math
import os
import re
import resource
import subprocess
import sys
import tempfile

import peer

RADIUS = 10.0
MACHINE = """[machine]
look_ahead = {look_ahead}
cycle_us = 1000
[motion]
mode = "optimal"
tolerance = 0.01
"""
AXIS = """[[axis]]
name = "{name}"
max_velocity = 250.0
rapid = 250.0
max_acceleration = 2000.0
max_jerk = 50000.0
"""
# length of a line in mm, feed in mm/min, records in the ring
CASES = [(0.001, 6000, 16384), (0.001, 15000, 65536), (0.001, 6000, 1024), (0.01, 6000, 16384), (0.01, 6000, 1024), (0.05, 6000, 1024), (0.2, 6000, 1024)]


def write_program(path, step, feed, lines):
    with open(path, "w", encoding="ascii") as out:
        out.write(f"G21 G17 G90 G94\nG1 F{feed}.\n")
        for n in range(1, lines + 1):
            angle = n * step / RADIUS
            out.write(f"X{RADIUS * (math.cos(angle) - 1):.4f} Y{RADIUS * math.sin(angle):.4f}\n")
        out.write("M30\n")


def run(ncsim, machine, program):
    """Machine time in s, path in mm, processor time in s."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([ncsim, "time", "--machine", machine, program], capture_output=True, text=True, check=False)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if done.returncode != 0:
        sys.exit(done.stderr or done.stdout)
    seconds = float(re.search(r"cycle time\s+([\d.]+) s", done.stdout).group(1))
    path = float(re.search(r"path length\s+([\d.]+) mm", done.stdout).group(1))
    return seconds, path, (after.ru_utime + after.ru_stime) - (before.ru_utime + before.ru_stime)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--ncsim", default=None)
    parser.add_argument("--lines", type=int, default=400_000)
    options = parser.parse_args()
    ncsim = peer.find_ncsim(options.ncsim)
    starved = False
    print(f"{'line um':>8} {'feed mm/s':>10} {'ring':>6} {'blocks/s of the machine':>24} {'of the feed':>12} {'blocks/s of one core':>21}")
    with tempfile.TemporaryDirectory() as folder:
        for step, feed, look_ahead in CASES:
            machine, program = os.path.join(folder, "machine.toml"), os.path.join(folder, "circle.nc")
            with open(machine, "w", encoding="ascii") as out:
                out.write(MACHINE.format(look_ahead=look_ahead) + "".join(AXIS.format(name=name) for name in "XYZ"))
            write_program(program, step, feed, options.lines)
            seconds, path, cpu = run(ncsim, machine, program)
            starved = starved or cpu > seconds
            print(f"{step * 1000:8.0f} {feed / 60:10.0f} {look_ahead:6} {options.lines / seconds:24,.0f} {path / seconds / (feed / 60):12.3f} "
                  f"{options.lines / cpu:21,.0f}")
    return 1 if starved else 0


if __name__ == "__main__":
    sys.exit(main())
