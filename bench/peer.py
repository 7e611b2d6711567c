# SPDX-License-Identifier: Apache-2.0
"""Compares whole processes: ncsim and the rs274 of Debian's linuxcnc-uspace run in turns, so that both meet the same load of the computer."""
import os
import shutil
import subprocess
import sys
import tempfile
import time

SKIPPED = 77


def find_ncsim(named=None):
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    for path in (named, os.environ.get("NCSIM"), os.path.join(os.environ.get("NC_BINARY_DIR", ""), "bin/ncsim"),
                 os.path.join(root, "build/release/bin/ncsim"), shutil.which("ncsim")):
        if path and os.access(path, os.X_OK):
            return os.path.abspath(path)
    sys.exit("ncsim is not built; give --ncsim PATH")


def find_rs274():
    """The path of rs274; where it is not installed the bench ends as skipped."""
    path = shutil.which("rs274")
    if not path:
        print("skipped: rs274 is not here (Debian: apt-get install linuxcnc-uspace)")
        sys.exit(SKIPPED)
    return path


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


def feeds_of_rs274(rs274, program, folder):
    """How many feed moves rs274 makes of a program, which shows whether it interpreted all of it."""
    listing = os.path.join(folder, "canonical.txt")
    subprocess.run([rs274, "-g", program, listing], cwd=folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL, check=True)
    with open(listing, encoding="utf-8", errors="replace") as calls:
        return sum("STRAIGHT_FEED(" in line for line in calls)


def report(units, name, ours, theirs, wanted):
    """Prints both results and returns the exit status. The CPU time of the best run decides: it has no time of other programs in it."""
    best = {}
    for who, results in (("ncsim check", ours), ("rs274 -g", theirs)):
        best[who] = (min(r[0] for r in results), min(r[1] for r in results))
        wall, cpu = best[who]
        print(f"{who:12} {wall:8.3f} s wall, {cpu:8.3f} s CPU, {units / cpu / 1e6:6.2f} M {name} per CPU second")
    wall_ratio = best["rs274 -g"][0] / best["ncsim check"][0]
    ratio = best["rs274 -g"][1] / best["ncsim check"][1]
    print(f"ratio        {wall_ratio:8.1f} wall, {ratio:8.1f} CPU (wanted: {wanted:.0f})")
    return 0 if ratio >= wanted else 1
