#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The core topics of ncdds (Cyclone DDS) as a subscriber with the DDS of another maker reads them: Fast DDS, in fastdds_peer.cpp.

Exit status 77 = skipped: the programs are not built, or Fast DDS was not there (Debian: libfastrtps-dev).
"""
import os
import signal
import subprocess
import sys
import tempfile
import time

from dds_environment import PATIENCE, SKIPPED, build, machine_text

# Y stands at 7.25, X goes back and forth between 1 and 3, and then the program raises an alarm.
PART = "G90 G54 G17 G0 X1. Y7.25\n#1=0\nWHILE [#1 LT 60] DO1\nG1 X3. F6000.\nX1.\n#1=#1+1\nEND1\n#3000=41(COOLANT)\n"


def fields(line):
    words = line.split()
    return {"machine": words[1], "line": int(words[words.index("line") + 1]), "state": int(words[words.index("state") + 1]),
            "axes": words[words.index("axes") + 1], "x": float(words[words.index("work") + 1]), "y": float(words[words.index("work") + 2]),
            "alarms": int(words[-1]), "scan": int(words[words.index("scan") + 1]), "program": line.split('"')[1]}


class Process:
    def __init__(self, folder, name, *command):
        self.log = os.path.join(folder, name)
        with open(self.log, "wb") as out:
            self.process = subprocess.Popen(command, stdout=out, stderr=subprocess.STDOUT)

    def lines(self):
        with open(self.log, encoding="utf-8") as file:
            return [line for line in file.read().split("\n")[:-1]]

    def end(self):
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGKILL)
        self.process.wait()


def until(condition, what, *processes):
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        found = condition()
        if found:
            return found
        time.sleep(0.05)
    for process in processes:
        print(process.log, *process.lines()[-8:], sep="\n  ")
    raise AssertionError(what)


def main():
    peer = os.path.join(build, "bin", "fastdds_peer")
    for program in (peer, os.path.join(build, "bin", "ncrtd"), os.path.join(build, "bin", "ncdds")):
        if not os.path.exists(program):
            print(f"skipped: {os.path.basename(program)} is not built")
            sys.exit(SKIPPED)
    if "thread" in os.environ.get("NC_SANITIZE", ""):
        print("skipped: Cyclone DDS is not built for the thread sanitizer")
        sys.exit(SKIPPED)
    share, domain = f"other-{os.getpid()}", str(1 + os.getpid() % 100)  # below the ports that the system hands out
    with tempfile.TemporaryDirectory() as folder:
        for name, text in (("machine.toml", machine_text("Other make", "XY")), ("part.nc", PART)):
            with open(os.path.join(folder, name), "w", encoding="ascii") as file:
                file.write(text)
        listener = Process(folder, "peer", peer, domain, "600")
        gateway = Process(folder, "ncdds", os.path.join(build, "bin", "ncdds"), "--share", share, "--domain", domain)
        control = Process(folder, "ncrtd", os.path.join(build, "bin", "ncrtd"), "--config", os.path.join(folder, "machine.toml"), "run",
                          "--no-progress", "--share", share, os.path.join(folder, "part.nc"))
        try:
            def seen():
                return [fields(line) for line in listener.lines() if line.startswith("status ")]

            until(lambda: [s for s in seen() if s["state"] == 1 and s["line"] > 1], "the status of a running program comes", listener, gateway, control)
            moving = until(lambda: len({s["x"] for s in seen() if 1 < s["x"] < 3}) > 10 and seen(), "and the axis moves", listener, gateway)
            for s in moving:
                assert s["machine"] == share and s["axes"] == "XY" and s["program"] == "part.nc", s
                assert -0.001 <= s["x"] <= 3.001 and s["line"] <= 8, s
            assert any(s["y"] == 7.25 for s in moving), moving[-1]
            scans = [s["scan"] for s in moving]
            assert scans == sorted(scans), "in order"
            alarm = until(lambda: [line for line in listener.lines() if line.startswith("alarm ")], "the alarm comes", listener, gateway, control)[-1]
            assert alarm.startswith(f"alarm {share} ") and "COOLANT" in alarm and "line 8" in alarm, alarm
            until(lambda: [line for line in listener.lines() if line == "nc::Status_v1: an instance has ended"], "and the end of the control", listener, gateway)
            assert not [line for line in listener.lines() if line.startswith("error")], listener.lines()[-5:]
            assert gateway.process.poll() is None, "the gateway lives"
            print(f"{len(seen())} samples, {alarm}")
        finally:
            for process in (control, gateway, listener):
                process.end()


main()
