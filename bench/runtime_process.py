#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The runtime as a process: the time to the first scan, the resident memory, and the scan figures on the real clock.

  bench/runtime_process.py [BUILD_DIR]      default build/release

Goals: the first scan within 1 s of the start, less than 64 MB resident, an execution time of the scan of at most 50 us at p99.9.
Only the memory decides the exit status (1 when it is too much). Times depend on the computer and are only reported.
"""
import os
import re
import resource
import subprocess
import sys
import tempfile
import time

LIMIT_MB = 64
root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
build = os.path.abspath(sys.argv[1]) if len(sys.argv) > 1 else os.path.join(root, "build/release")
ncrtd = os.path.join(build, "bin/ncrtd")
machine = os.path.join(root, "etc/machine.toml")


def run(*arguments):
    """Output and wall time (s) of one run of ncrtd."""
    begin = time.monotonic()
    child = subprocess.Popen([ncrtd, "--config", machine, *arguments], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
    text, _ = child.communicate()
    if child.returncode != 0:
        sys.exit(f"ncrtd {' '.join(arguments)}: exit {child.returncode}\n{text}")
    return text, time.monotonic() - begin


def main():
    if not os.path.exists(ncrtd):
        sys.exit(f"{ncrtd} is not there: build it first")
    text, wall = run("mdi", "--no-progress", "G4 P1")
    start_up = re.search(r"start-up +([\d.]+) ms", text)
    print(f"start-up: first scan {start_up.group(1)} ms after main(); whole process with one dwell of 1 ms: {wall * 1e3:.0f} ms")
    with tempfile.TemporaryDirectory() as folder:
        program = os.path.join(folder, "long.nc")
        with open(program, "w", encoding="ascii") as file:
            file.write("G90 G54 G17 G0 X0. Y0.\n#1=0\nWHILE [#1 LT 60] DO1\nG1 X20. Y10. F9000.\nG3 X20. Y30. J10.\n"
                       "G1 X0. Y0.\n#1100=1\n#1100=0\n#1=#1+1\nEND1\nM30\n")
        text, _ = run("run", "--no-progress", program)
        print(text, end="")
        size = 300 << 20
        big = os.path.join(folder, "big.nc")
        with open(big, "w", encoding="ascii") as file:
            line = "".join(f"G1 X{i % 50}.{i % 1000:03d} Y{i % 37}.5 F6000.\n" for i in range(10000))
            file.write("G90 G54\n")
            while file.tell() < size:
                file.write(line)
            file.write("M30\n")
        child = subprocess.Popen([ncrtd, "--config", machine, "run", "--no-progress", big], stdout=subprocess.DEVNULL)
        time.sleep(5)
        with open(f"/proc/{child.pid}/status", encoding="ascii") as status:
            fields = dict(line.split(":", 1) for line in status)
        child.terminate()
        child.wait()
        print(f"resident with a program of {size >> 20} MB: {int(fields['VmHWM'].split()[0]) / 1024:.1f} MB"
              f" (locked {int(fields['VmLck'].split()[0]) / 1024:.1f} MB)")
    peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss
    print(f"highest resident memory of all runs: {peak / 1024:.1f} MB")
    if peak >= LIMIT_MB * 1024:
        sys.exit(f"that is not below {LIMIT_MB} MB")


if __name__ == "__main__":
    main()
