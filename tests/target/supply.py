# SPDX-License-Identifier: Apache-2.0
"""The emulated computer's own supply is cut (scripts/prove-target --cuts): what is kept is on a disk with a journal that stays, and every start looks what
has become of it. The cut itself is the host's, which ends the emulation; it goes by the lines "seen ..." and gives the last one to the next start."""
import pathlib
import time

from faults import Faults
from machine import HERE, Failed, run

STATE = pathlib.Path("/var/lib/nc")
BEHIND_S = 1.5  # retain_every_s of machine.toml, the writing, and a processor that is slow


def attach():
    """The disk that stays, in place of the service's folder."""
    run("mount", "-t", "ext4", "/dev/vdb", STATE)
    run("chown", "ncrtd:ncrtd", STATE)


class Supply:
    def __init__(self, control, gpio, drives):
        self.control, self.drives = control, drives
        self.faults = Faults(control, gpio, drives, 0)
        words = dict(word.partition("=")[::2] for word in pathlib.Path("/proc/cmdline").read_text().split())
        self.seen, self.last = words.get("nc.seen"), "nc.last" in words

    def begin(self):
        """The service begins without an alarm, so its files are whole, nothing moves, and what is kept is what it was."""
        self.control.service("start")
        self.control.up(self.drives)
        self.faults.quiet("behind the start of the computer")
        if not self.seen:
            self.control.ctl("variables", "set", "520", "--value", "123.456")
            self.control.ctl("tools", "set", "3", "--length", "81.25")
            self.control.ctl("programs", "put", HERE / "parts" / "long.nc")
            time.sleep(BEHIND_S)
            return "begins"
        low, high, low_rounds, high_rounds = map(float, self.seen.split(","))
        count, rounds = self.control.variable(521) or 0, self.control.variable(501) or 0
        offset = self.control.ask("offsets.list", **{"from": 2, "count": 1})["offsets"][0]["axes"][0]["value"]
        tool = self.control.ask("tools.list", **{"from": 3, "count": 1})["tools"][0]["length"]
        if not (low <= count <= high and low_rounds <= rounds <= high_rounds and abs(offset - rounds) <= 1):
            raise Failed(f"#521 is {count}, was {low} to {high}; #501 is {rounds}, was {low_rounds} to {high_rounds}; X of G55 is {offset}")
        if self.control.variable(520) != 123.456 or tool != 81.25:
            raise Failed(f"#520 is {self.control.variable(520)}, the length of tool 3 {tool}")
        return f"whole behind the cut: #521 is {count:.0f} of {low:.0f} to {high:.0f}, #501 {rounds:.0f}"

    def write(self):
        """Changes what is kept as fast as it can be, in motion, until there is no supply any more."""
        self.faults.in_motion()
        count, told = int(self.control.variable(521) or 0), []
        print("in motion", flush=True)
        while True:
            count += 1
            said = self.control.answer("variables.set", number=521, value=count)
            if not said.get("ok"):
                raise Failed(f"#521 cannot be set to {count}: {said}")
            now, rounds = time.monotonic(), self.control.variable(501)
            told.append((now, count, rounds))
            while len(told) > 1 and now - told[1][0] > BEHIND_S:
                told.pop(0)
            print(f"seen {told[0][1]},{count + 1},{told[0][2]:.0f},{rounds + 1:.0f} .", flush=True)
            time.sleep(0.02)
