#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The time from a scan to a subscriber over DDS on loopback, and what publishing costs the scan.

  bench/dds_latency.py [BUILD_DIR] [SAMPLES]      default build/release, 500 samples (10 s at 50 Hz)

Goals: a median from scan to subscriber of at most 5 ms, and no measurable cost for the scan. They are reported but do not decide the exit
status, since the times depend on the computer. Exit status: 0, 1 when something does not run, 77 (skipped) where the programs are not built.
"""
import os
import re
import subprocess
import sys
import tempfile
import time

root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
build = os.path.abspath(sys.argv[1]) if len(sys.argv) > 1 else os.path.join(root, "build/release")
samples = int(sys.argv[2]) if len(sys.argv) > 2 else 500
PROGRAM = "G90 G54 G17\n#1=0\nWHILE [#1 LT {}] DO1\nG1 X20. Y10. F3000.\nG3 X20. Y30. J10.\nG1 X0. Y0.\n#1=#1+1\nEND1\nM30\n"
SECONDS_PER_ROUND = 1.8
GOAL_MS = 5.0


def program(name):
    return os.path.join(build, "bin", name)


def control(folder, *options):
    return subprocess.Popen([program("ncrtd"), "--config", os.path.join(root, "etc/machine.toml"), "run", "--quiet", "--no-progress",
                             *options, os.path.join(folder, "part.nc")], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)


def figures(text):
    """The execution times of the scan from the summary of ncrtd."""
    return re.search(r"execution time +(.*)", text).group(1)


def main():
    for name in ("ncrtd", "ncdds", "ncmon"):
        if not os.path.exists(program(name)):
            print(f"skipped: {program(name)} is not there: build it first (cyclonedds-dev, cyclonedds-tools)")
            return 77
    share, domain = f"bench-{os.getpid()}", str(1 + os.getpid() % 100)
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "part.nc"), "w", encoding="ascii") as file:
            file.write(PROGRAM.format(int(samples / 50 / SECONDS_PER_ROUND) + 3))
        alone = control(folder).communicate()[0]
        gateway = subprocess.Popen([program("ncdds"), "--share", share, "--domain", domain], stderr=subprocess.DEVNULL)
        shown = control(folder, "--share", share)
        try:
            time.sleep(1)
            shown_by = subprocess.run([program("ncmon"), "--control", share, "--domain", domain, "--latency", str(samples)],
                                      capture_output=True, text=True)
            print(shown_by.stdout + shown_by.stderr, end="")
            with_reader = shown.communicate()[0]
        finally:
            gateway.terminate()
            gateway.wait()
            if shown.poll() is None:
                shown.kill()
    print(f"scan without shared memory  {figures(alone)}")
    print(f"scan, published at 50 Hz    {figures(with_reader)}")
    median = re.search(r"p50 ([0-9.]+) ms", shown_by.stdout)
    if not median:
        return 1
    print(f"median at most {GOAL_MS:.0f} ms: {'yes' if float(median[1]) <= GOAL_MS else 'NO'}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
