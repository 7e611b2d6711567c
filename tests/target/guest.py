# SPDX-License-Identifier: Apache-2.0
"""Runs in the emulated computer that scripts/prove-target boots: lines of a chip, a part on CAN drives under a real-time kernel, and the faults that
docs/safety.md promises something for. One line for each check; the last line is the verdict.

usage: guest.py KILLS [CHECK...]     KILLS: so often ncrtd is killed in motion
"""
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import time
import traceback

from edges import Edges
from faults import Faults
from machine import HERE, INTERFACE, MACHINE, PROGRAMS, Control, Drives, Failed, Gpio, busy, run, until
from path import Recorder, compare


def find(tree, key):
    """The value of a key, wherever it is in a tree of JSON."""
    if isinstance(tree, dict) and key in tree:
        return tree[key]
    branches = tree.values() if isinstance(tree, dict) else tree if isinstance(tree, list) else []
    return next((found for branch in branches if (found := find(branch, key)) is not None), None)


def percentiles(histogram):
    """As the control gives its own, of {value: how often}."""
    values = [value for value, times in sorted(histogram.items()) for _ in range(times)]
    return {"p50": values[math.ceil(0.5 * len(values)) - 1], "p99.9": values[math.ceil(0.999 * len(values)) - 1], "max": values[-1]}


def prepare():
    """The kernel's devices, the configuration, and what a machine builder adds to the service."""
    for module in ("can-raw", "can-bcm", "vcan"):
        run("modprobe", module)
    run("ip", "link", "add", "dev", INTERFACE, "type", "vcan")
    run("ip", "link", "set", INTERFACE, "txqueuelen", "100", "up")
    gpio = Gpio()
    shutil.copy(HERE / "machine.toml", MACHINE)
    shutil.copy(HERE / "target.il", MACHINE.parent)
    PROGRAMS.mkdir(parents=True, exist_ok=True)
    for place in (PROGRAMS.parent, PROGRAMS):
        shutil.chown(place, "ncrtd", "ncrtd")
    drop_in = pathlib.Path("/etc/systemd/system/ncrtd.service.d/target.conf")
    drop_in.parent.mkdir(parents=True)
    drop_in.write_text(f"[Unit]\nStartLimitIntervalSec=0\n[Service]\nEnvironment=NC_CONFIG={MACHINE}\nDeviceAllow=char-gpiochip rw\n"  # many cuts in a minute
                       "TimeoutStartSec=180\nWatchdogSec=20\n")  # an emulated processor is slow
    drop_in = pathlib.Path("/etc/systemd/system/ncdds.service.d/target.conf")
    drop_in.parent.mkdir(parents=True)
    drop_in.write_text(f"[Service]\nEnvironment=NC_CONFIG={MACHINE}\n")
    run("systemctl", "daemon-reload")
    return gpio, Drives()


class Checks:
    def __init__(self, kills):
        self.control = Control()
        self.gpio, self.drives = prepare()
        self.faults = Faults(self.control, self.gpio, self.drives, kills)
        self.edges = Edges(self.control, self.gpio, self.drives, self.faults)

    def taken_line(self):
        """A line that has another owner: ncrtd does not start, and names chip, line and owner."""
        owner = subprocess.Popen(["gpioset", "--mode=signal", self.gpio.chip, "4=0"])
        time.sleep(1.0)
        self.control.service("start", good=False)
        owner.terminate()
        owner.wait()
        said = [line for line in self.control.log(30).splitlines() if "CLAMP" in line and "gpioset" in line]
        self.control.service("stop", good=False)
        run("systemctl", "reset-failed", "ncrtd", good=False)
        if not said or "target-board" not in said[0]:
            raise Failed(f"no line of the log names chip, line and owner: {self.control.log(12)}")
        return said[0]

    def kernel(self):
        """The kernel is one with PREEMPT_RT, and the scan and the bus of the package's service are real-time threads of it."""
        if pathlib.Path("/sys/kernel/realtime").read_text().strip() != "1":
            raise Failed("/sys/kernel/realtime is not 1")
        self.recorder = Recorder()
        time.sleep(0.5)
        self.control.service("start")
        threads = [line.split() for line in run("ps", "-L", "-o", "cls=,rtprio=", "-p", self.control.process()).splitlines()]
        real_time = sorted(int(words[1]) for words in threads if words[0] == "FF")
        if not {80, 85} <= set(real_time):
            raise Failed(f"no scan at 80 or no bus at 85: {threads}")
        self.control.up(self.drives)
        self.faults.quiet("behind the start of the service")
        for file in sorted((HERE / "parts").iterdir()):
            self.control.ctl("programs", "put", file)
        return f"{os.uname().release}, user {run('ps', '-o', 'user=', '-p', self.control.process())}, SCHED_FIFO {real_time}"

    def part(self):
        """The plants' axes go where the motion and the trace of the program are."""
        start = self.drives.places()
        runs = self.control.status()["runs"]
        self.control.start("part.nc")
        if not until(lambda: self.gpio.level("LAMP"), 5, every=0.02):
            raise Failed("nc.cycle_lamp does not light the lamp's line")
        if not until(lambda: self.control.status()["runs"] > runs and self.control.state() == "idle", 90):
            raise Failed(f"the part does not come to its end: {self.control.says()}")
        if not until(lambda: self.drives.stand(0.3), 10) or not until(lambda: not self.gpio.level("LAMP"), 5):
            raise Failed("the end of the part: an axis moves, or the lamp is on")
        return compare(self.recorder.end(), self.drives, "part.nc", start)

    def lines(self):
        """#1000 is a line of the chip, live, and #1100 is one; the watchdog's line toggles."""
        runs = self.control.status()["runs"]
        self.control.start("io.nc")
        for level, text in ((True, 1), (False, 2)):
            time.sleep(0.5)
            if self.gpio.level("CLAMP") == level:
                raise Failed(f"CLAMP is {level} before PART is")
            self.gpio.drive("PART", level)
            if not until(lambda: self.gpio.level("CLAMP") == level, 10):
                raise Failed(f"CLAMP does not follow PART to {level}: {self.control.says()}")
            if not until(lambda: f"510 {text}" in " ".join(self.control.ctl("variables", "list", "--from", "510", "--count", "1").replace("=", " ").split()), 5):
                raise Failed(f"ncctl shows {self.control.ctl('variables', 'list', '--from', '510', '--count', '1')!r}, not #510 = {text}")
        if not until(lambda: self.control.status()["runs"] > runs, 10):
            raise Failed(f"the program does not end: {self.control.says()}")
        seen = {self.gpio.level("WATCHDOG") for _ in range(100) if time.sleep(0.01) is None}
        if seen != {True, False}:
            raise Failed(f"the watchdog's line stands at {seen}")
        return "a program waits for #1000 at PART and sets CLAMP by #1100; ncctl shows #510; the watchdog's line toggles"

    def latency(self):
        """No check: how late cyclictest and the scan wake up on this kernel, which is emulated, while a part is cut."""
        run("systemctl", "start", "ncdds")
        self.control.start("part.nc")
        wakes = {}
        for line in run("cyclictest", "-q", "-m", "-p", "90", "-i", "20000", "-l", "200", "-t", "1", "-h", "10000").splitlines():
            words = line.split()
            if len(words) == 2 and words[0].isdigit() and int(words[1]) > 0:
                wakes[int(words[0])] = int(words[1])
        scan = find(json.loads(run("ncmon", "--once", "--json", "--wait", "40")), "jitter_us")
        run("systemctl", "stop", "ncdds")
        self.control.press("reset")
        self.faults.rests("a part that a reset has ended")
        for name, figures in (("cyclictest", percentiles(wakes)), ("scan", scan)):
            print(f"      wake-up of {name:10s} p50 {figures['p50']:7.1f} us   p99.9 {figures['p99.9']:7.1f} us   max {figures['max']:7.1f} us", flush=True)
        print("      cyclictest's histogram, us: " + " ".join(f"{late}:{times}" for late, times in sorted(wakes.items())), flush=True)
        return "reported, not asserted: the processor is emulated"

    def ends(self):
        """The service is stopped in motion: rest on the path, quick stop, drives off, outputs at their safe values."""
        self.faults.acknowledge("before the end")
        self.faults.in_motion()
        self.control.service("stop")
        self.faults.rests("the service has ended")
        if self.control.shown("Result") != "success" or "end: at rest" not in self.control.log(6):
            raise Failed(f"{self.control.shown('Result')}: {self.control.log(6)}")
        if not until(lambda: "enabled" not in self.drives.states(), 5) or self.gpio.level("LAMP"):
            raise Failed(f"drives {self.drives.states()}, lamp {self.gpio.level('LAMP')}")
        if any(self.gpio.level("WATCHDOG") for _ in range(50) if time.sleep(0.01) is None):
            raise Failed("the watchdog's line is on, and no control is there")
        return "end: at rest, drives " + ", ".join(self.drives.states())

    def all(self):
        return [self.taken_line, self.kernel, self.part, self.lines, *self.edges.all(), *self.faults.all(), self.latency, self.ends]


def main():
    begin, failed, done = time.monotonic(), 0, 0
    print(f"booted in {begin:.0f} s (processor {busy():.1f} s)", flush=True)
    checks = Checks(kills=int(sys.argv[1]))
    print(f"prepared in {time.monotonic() - begin:.0f} s (processor {busy():.1f} s since the boot)", flush=True)
    restored = {check.__name__ for check in checks.all()} - {"taken_line", "kernel"}  # with these two the control begins
    for check in checks.all():
        name, before, worked = check.__name__, time.monotonic(), busy()
        if sys.argv[2:] and name not in (*sys.argv[2:], "kernel"):
            continue
        done += 1
        try:
            if name in restored:
                checks.faults.restore()
            print(f"ok    {name:16s} {check()} ({time.monotonic() - before:.1f} s, processor {busy() - worked:.1f} s)", flush=True)
        except Exception as error:  # whatever it is, the other checks are to be seen, too
            failed += 1
            print(f"FAIL  {name:16s} {error} ({time.monotonic() - before:.1f} s)", flush=True)
            if not isinstance(error, Failed):
                traceback.print_exc(file=sys.stdout)
    print(f"{done - failed} of {done} checks in {time.monotonic() - begin:.0f} s (processor {busy():.0f} s since the boot)", flush=True)
    verdict = "these checks hold" if sys.argv[2:] else "proven on a real-time kernel"
    print(verdict if failed == 0 else "NOT proven", flush=True)


main()
