# SPDX-License-Identifier: Apache-2.0
"""Edges of lines with the kernel's times: a probe whose place is latched by the time of its edge, and a handwheel of two lines in quadrature."""
import math
import random
import time

from faults import G54
from machine import Failed, until

FEED = 15.0  # mm/s, of probe.nc
TOWARDS = (60.0, 30.0)  # of probe.nc
DEBOUNCE_S = 0.2  # of the line PROBE_SLOW
DIVISION = 0.001  # mm, of a handwheel
EDGE_S = 0.005  # from edge to edge of the wheel's lines


class Edges:
    def __init__(self, control, gpio, drives, faults):
        self.control, self.gpio, self.drives, self.faults = control, gpio, drives, faults
        self.wheel_place = 0  # 0 to 3: 00, 10, 11, 01 of A and B

    # ---- the probe ----

    def switch(self, line, level):
        """Drives a line, and gives the time before and behind: the edge is between them."""
        before = time.time()
        self.gpio.drive(line, level)
        return before, time.time()

    def approach(self):
        """Starts probe.nc, and waits until the axes go at the feed of its skip move."""
        runs = self.control.status()["runs"]
        self.control.start("probe.nc")

        def probes():
            speeds = [drive.gauge()[1] for drive in self.drives[:2]]
            return self.control.variable(530) == 0 and max(abs(speed - FEED * way / math.hypot(*TOWARDS)) for speed, way in zip(speeds, TOWARDS)) < 0.01
        if not until(probes, 30, every=0.02):
            raise Failed(f"no skip move: {self.control.says()}")
        return runs

    def latched(self, runs):
        """Waits for the end of the program; the place that its skip position says, of the machine, and the place where the axes came to rest."""
        if not until(lambda: self.control.status()["runs"] > runs and self.control.state() == "idle", 20):
            raise Failed(f"the skip move does not end: {self.control.says()}")
        if not until(lambda: self.drives.stand(0.3), 5):
            raise Failed("behind the skip move an axis moves")
        if self.control.variable(530) != 1:
            raise Failed(f"the program has not taken the skip position: #530 = {self.control.variable(530)}")
        return [self.control.variable(531 + n) + G54[n] for n in range(2)], self.drives.places()[:2]

    def at_the_edge(self, edge, latched):
        """How far the latched place is from where the plants were between the two times of the edge; and how far it was from the first to the second."""
        away, width = 0.0, 0.0
        for n, place in enumerate(latched):
            ends = sorted(self.drives[n].place_at(when) for when in edge)
            away = max(away, ends[0] - place, place - ends[1])
            width = max(width, ends[1] - ends[0])
        if away > 0.002:
            raise Failed(f"latched {latched}, but at the edge the plants were at {[[drive.place_at(when) for when in edge] for drive in self.drives[:2]]}: "
                         f"{away * 1000:.1f} um")
        return f"{max(0.0, away) * 1000:.2f} um from where the plants were at the edge (known to {width * 1000:.1f} um)"

    def beyond(self, latched, rested):
        """How far the axes went on behind the latched place, along the move."""
        return sum((b - a) * way for a, b, way in zip(latched, rested, TOWARDS)) / math.hypot(*TOWARDS)

    def probe(self):
        """A contact ends a skip move, and its skip position is where the plants were at the time of the edge; a pulse shorter than a poll does, too."""
        said = []
        for held in (None, 0.002):
            runs = self.approach()
            time.sleep(random.uniform(0.3, 0.9))
            edge = self.switch("PROBE", True)
            if held is not None:
                time.sleep(held)
                self.gpio.drive("PROBE", False)
            latched, rested = self.latched(runs)
            self.gpio.drive("PROBE", False)
            if not 0.0 < self.beyond(latched, rested) < FEED * 0.4:
                raise Failed(f"latched {latched}, at rest at {rested}")
            said.append(("contact: " if held is None else "pulse of some ms: ") + self.at_the_edge(edge, latched))
        return "; ".join(said)

    def probe_bounces(self):
        """With debounce_ms a pulse that is shorter is none, and a contact that bounces has the place of its first edge."""
        runs = self.approach()
        self.gpio.drive("PROBE_SLOW", True)
        time.sleep(DEBOUNCE_S / 4)
        self.gpio.drive("PROBE_SLOW", False)
        time.sleep(DEBOUNCE_S * 2.5)
        if self.control.state() != "running" or abs(self.drives[0].gauge()[1]) < 1:
            raise Failed(f"a pulse shorter than debounce_ms has ended the move: {self.control.says()}")
        edge = self.switch("PROBE_SLOW", True)
        for _ in range(3):
            for level in (False, True):
                time.sleep(0.004)
                self.gpio.drive("PROBE_SLOW", level)
        latched, rested = self.latched(runs)
        self.gpio.drive("PROBE_SLOW", False)
        time.sleep(DEBOUNCE_S + 0.1)
        if not FEED * DEBOUNCE_S * 0.9 < self.beyond(latched, rested) < FEED * (DEBOUNCE_S + 0.5):
            raise Failed(f"latched {latched}, at rest at {rested}: {self.beyond(latched, rested):.3f} mm further")
        return f"{self.at_the_edge(edge, latched)}, at rest {self.beyond(latched, rested):.3f} mm behind it"

    # ---- the handwheel ----

    def turn(self, detents):
        """Turns the wheel, each detent a period of its lines."""
        for _ in range(4 * abs(detents)):
            self.wheel_place = (self.wheel_place + (1 if detents > 0 else -1)) & 3
            for line, places in (("WHEEL_A", (1, 2)), ("WHEEL_B", (2, 3))):
                if self.gpio.levels[line] != (self.wheel_place in places):
                    self.gpio.drive(line, self.wheel_place in places)
            time.sleep(EDGE_S)

    def goes(self, axis, detents, way):
        """The wheel is turned, and the axis goes exactly so far, the others nothing."""
        before = self.drives.places()
        self.turn(detents)
        time.sleep(0.3)
        if not until(lambda: self.drives.stand(0.3), 10):
            raise Failed(f"{detents} detents: it does not come to rest")
        gone = [b - a for a, b in zip(before, self.drives.places())]
        wanted = [way if n == axis else 0.0 for n in range(len(gone))]
        if max(abs(a - b) for a, b in zip(gone, wanted)) > 0.0006:  # the drives count in whole increments, and end within one of them
            raise Failed(f"{detents} detents: the axes went {gone}, not {wanted}; {self.control.says()}")

    def choose(self, **lines):
        for line, level in lines.items():
            self.gpio.drive(line, level)
        time.sleep(0.1)

    def handwheel(self):
        """Two lines in quadrature turn the axis that is chosen, by so much as was turned, also where the chip was away meanwhile."""
        self.control.press("mode", mode="manual")
        try:
            self.choose(WHEEL_X=False, WHEEL_Y=False, WHEEL_100=False)
            self.goes(0, 5, 0.0)  # no axis is chosen
            self.choose(WHEEL_X=True)
            self.goes(0, 20, 20 * DIVISION)
            self.choose(WHEEL_100=True)
            self.goes(0, 20, 20 * 100 * DIVISION)
            self.goes(0, -30, -30 * 100 * DIVISION)
            self.choose(WHEEL_X=False, WHEEL_Y=True)
            self.goes(1, -15, -15 * 100 * DIVISION)
            self.gpio.pull_out()
            said = self.faults.alarmed(("R18", ""))
            self.faults.rests("chip pulled out")
            self.gpio.plug()
            self.faults.acknowledge("chip back")
            self.control.press("mode", mode="manual")
            self.goes(1, 15, 15 * 100 * DIVISION)
            self.choose(WHEEL_X=True)
            self.goes(0, 5, 0.0)  # two axes are chosen
        finally:
            self.choose(WHEEL_X=False, WHEEL_Y=False, WHEEL_100=False)
        return f"X and Y went what was turned, to and fro, and so did Y behind {said}"

    def all(self):
        return [self.probe, self.probe_bounces, self.handwheel]
