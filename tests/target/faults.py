# SPDX-License-Identifier: Apache-2.0
"""The faults of docs/safety.md, brought about while the axes move: each comes to rest, says what it is, and nothing moves before the operator starts."""
import os
import random
import re
import signal
import socket
import struct
import time

from machine import INTERFACE, Failed, run, until

CAN_ERROR, CAN_BUS_OFF = 0x20000000, 0x40
G54, CORNER = (1.25, -2.5, 0.75), 0.011  # of machine.toml: the offset, and the tolerance of the corners
QUIET_S = 1.0  # for so long nothing may move
ROUNDS = 16  # of long.nc: so far it counts


class Faults:
    def __init__(self, control, gpio, drives, kills):
        self.control, self.gpio, self.drives, self.kills = control, gpio, drives, kills

    # ---- what the faults have in common ----

    def clean(self):
        return not self.control.alarms() and set(self.drives.states()) == {"enabled"} and self.control.state() == "idle"

    def reset(self):
        """Whether the machine is clean behind a reset. One that leaves an alarm says so, and is pressed again."""
        self.control.press("reset", good=False, lifespan_ms=1000)
        return until(self.clean, 4 if not self.control.alarms() else 0)

    def restore(self):
        """Whatever the check before has left behind: the machine is whole again, so that one failure is one failure."""
        if self.drives.alive() and self.gpio.is_whole() and self.clean():
            return
        self.drives.sto(False)
        run("ip", "link", "set", INTERFACE, "up", good=False)
        self.gpio.mend()
        self.drives.begin()

        if not until(self.reset, 30):
            self.drives.begin(anew=True)
            run("systemctl", "reset-failed", "ncrtd", good=False)
            self.control.service("restart")
            if not until(self.reset, 60):
                raise Failed(f"the machine is not to be had: {self.control.says()}, drives {self.drives.states()}")
        print("      (the machine was not ready, and has been brought back)", flush=True)

    def in_motion(self):
        """Starts the long program, and waits until two axes have moved and one moves fast."""
        before = self.drives.places()
        self.control.start("long.nc")
        begun = time.monotonic()

        def moves():
            return abs(self.drives[0].place() - before[0]) > 0.5 and time.monotonic() - begun > 1.0 and max(abs(drive.gauge()[1]) for drive in self.drives) > 5.0
        if not until(moves, 30, every=0.02):
            raise Failed(f"it does not move when it is started: {self.control.says()}")

    def alarmed(self, *codes_and_texts, seconds=20):
        """Waits for these alarms, (code, text)."""
        def there():
            alarms = self.control.alarms()
            return alarms if all(any(each.startswith(code) and text in each for each in alarms) for code, text in codes_and_texts) else None
        found = until(there, seconds)
        if not found:
            raise Failed(f"no {codes_and_texts}: {self.control.says()}")
        return "; ".join(found)

    def rests(self, what, seconds=20):
        if not until(lambda: self.drives.stand(0.5), seconds):
            raise Failed(f"{what}: the axes do not come to rest, {[drive.gauge() for drive in self.drives]}")

    def quiet(self, what):
        """Nothing moves, and no program is in execution."""
        if not self.drives.stand(QUIET_S):
            raise Failed(f"{what}: something moves: {self.control.says()}, {[drive.gauge() for drive in self.drives]}")
        if self.control.state() in ("running", "manual"):
            raise Failed(f"{what}: {self.control.says()}")

    def refuses(self, what):
        """Cycle start does nothing while the cause is there, or has not been acknowledged."""
        said = self.control.press("start", good=False)
        self.quiet(f"{what}, behind a cycle start that is to be refused ({said})")

    def acknowledge(self, what):
        """Behind a reset the drives come on, the alarms are gone, and nothing moves by itself."""
        if not until(self.reset, 45):
            raise Failed(f"{what}: a reset does not bring it back: {self.control.says()}, drives {self.drives.states()}")
        self.quiet(f"{what}, behind a reset")

    def on_path(self):
        """The lines of the program on whose path the axes stand."""
        x, y, _ = (place - offset for place, offset in zip(self.drives.places(), G54))
        sides = [line for line, away in ((6, y), (7, x - 30), (8, y - 20), (9, x)) if abs(away) <= CORNER]
        if not sides:
            raise Failed(f"the axes stand beside the path, at {x:.3f} {y:.3f} of G54")
        return sides

    def is_back(self, what, process):
        """The service has another process than this one, which is gone, and nothing runs in it."""
        if not until(lambda: self.control.process() not in (0, process) and self.control.state() == "idle", 120, every=0.3):
            raise Failed(f"{what}: the service does not come back: {self.control.log(8)}")

    def quick_stop(self, *others):
        """The drives without a fault have stopped, and are off then."""
        if not until(lambda: all(self.drives[n].gauge()[2] not in ("enabled", "stop") for n in others), 15):
            raise Failed(f"the other drives are not off: {self.drives.states()}")

    # ---- the faults ----

    def chain(self):
        """The contact of the emergency stop chain alone opens: R16, category 1 on the path, drives hold."""
        self.in_motion()
        self.gpio.drive("CHAIN", False)
        said = self.alarmed(("R16", "The emergency stop chain is open"))
        self.rests("chain open")
        self.on_path()
        if set(self.drives.states()) != {"enabled"}:
            raise Failed(f"the drives do not hold: {self.drives.states()}")
        self.refuses("chain open")
        self.gpio.drive("CHAIN", True)
        time.sleep(0.5)
        self.refuses("chain closed again, no reset")
        self.acknowledge("chain closed again")
        return said

    def emergency_stop(self):
        """Emergency stop in motion: safe torque off at all drives, their EMCY, and the contact of the chain."""
        self.in_motion()
        self.drives.sto(True)
        self.gpio.drive("CHAIN", False)
        said = self.alarmed(("R16", "The emergency stop chain is open"), ("R12", "EMCY 5400h"))
        self.rests("emergency stop")
        self.refuses("emergency stop")
        self.control.press("reset", good=False, lifespan_ms=1000)
        if not self.control.alarms() or "enabled" in self.drives.states():
            raise Failed(f"a reset with the chain open: {self.control.says()}, drives {self.drives.states()}")
        self.drives.sto(False)
        self.gpio.drive("CHAIN", True)
        self.quiet("the button pulled out")
        self.acknowledge("the button pulled out")
        return said

    def drive_fault(self):
        """One drive trips: its text is in the alarm, the others make a quick stop and are off when they stand."""
        self.in_motion()
        self.drives[1].trip()
        said = self.alarmed(("R12", "EMCY 3210h: DC link over-voltage (error register 05h) (Y)"))
        self.rests("a drive in fault")
        self.quick_stop(0, 2)
        self.refuses("a drive in fault")
        self.acknowledge("a drive that was in fault")
        return said

    def node_killed(self):
        """The process of a node gets SIGKILL: the control names what does not come any more; the node is set up again by itself, and works behind a reset."""
        self.in_motion()
        self.drives[1].kill()
        said = self.alarmed(("R12", "not come (Y)"))  # its heartbeat does, or its positions do not: which comes first is a matter of the instant
        if "R11" in said:
            raise Failed(f"a following error by positions that do not come: {said}")
        self.rests("a node is gone")
        self.quick_stop(0, 2)
        self.refuses("a node is gone")
        self.drives[1].begin()
        self.drives[1].wait()
        self.quiet("a node that comes back")
        self.acknowledge("a node that is back")
        return said

    def interface_down(self):
        """The interface goes down: every drive stops by its own supervision of the heartbeat, the control has R12 of the positions and R14 of the bus."""
        self.in_motion()
        run("ip", "link", "set", INTERFACE, "down")
        said = self.alarmed(("R12", "do"), ("R14", ""))
        self.rests("interface down")
        if not until(lambda: "enabled" not in self.drives.states(), 10):
            raise Failed(f"drives without a control are still on: {self.drives.states()}")
        self.refuses("interface down")
        run("ip", "link", "set", INTERFACE, "up")
        self.quiet("interface up again")
        self.acknowledge("interface up again")
        return said

    def bus_off(self):
        """The controller reports bus-off, and the interface is without a bus until it has restarted: R14."""
        self.in_motion()
        with socket.socket(socket.AF_CAN, socket.SOCK_RAW, socket.CAN_RAW) as controller:
            controller.bind((INTERFACE,))
            controller.send(struct.pack("<IB3x8s", CAN_ERROR | CAN_BUS_OFF, 8, bytes(8)))
        run("ip", "link", "set", INTERFACE, "down")
        said = self.alarmed(("R14", ""))
        self.rests("bus off")
        self.refuses("bus off")
        run("ip", "link", "set", INTERFACE, "up")
        self.quiet("bus back")
        self.acknowledge("bus back")
        return said

    def chip_pulled_out(self):
        """The GPIO chip vanishes: R18 stops the machine, and behind a reset its lines are the control's again."""
        self.in_motion()
        self.gpio.pull_out()
        said = self.alarmed(("R18", ""))
        self.rests("chip pulled out")
        self.refuses("chip pulled out")
        self.gpio.plug()
        self.quiet("chip back")
        if not until(lambda: "the lines of target-board are there" in self.control.log(3), 10):
            raise Failed(f"the lines are not requested again: {self.control.log(5)}")
        self.acknowledge("chip back")
        self.control.mdi("#1100=1")
        if not until(lambda: self.gpio.level("CLAMP"), 5):
            raise Failed("#1100 does not reach the line of the chip that is back")
        self.control.mdi("#1100=0")
        return said

    def supply_fails(self, what):
        """The line of the supply's monitor drops in motion: R24, rest on the path, data on the disk, then drives off, and a line that says so."""
        self.in_motion()
        self.gpio.drive("SUPPLY", False)
        said = self.alarmed(("R24", "came to rest on their paths"), ("R24", "retained data were written"))
        self.rests(what)
        self.on_path()
        self.quick_stop(0, 1, 2)
        if not until(lambda: self.gpio.level("SAVED"), 5):
            raise Failed(f"{what}: nc.power_fail_done does not reach its line: {self.control.says()}")
        self.refuses(what)
        return said

    def power_fail(self):
        """The supply says that it fails. Once it is good again, once the power goes, and the next start knows the place in the program."""
        said = self.supply_fails("the supply fails")
        self.gpio.drive("SUPPLY", True)
        time.sleep(1.0)  # more than settle_s
        self.refuses("the supply is good again, no reset")
        self.acknowledge("the supply is good again")
        self.supply_fails("the supply fails for good")
        process, counted, places, sides = self.control.process(), self.control.variable(501), self.drives.places(), self.on_path()
        os.kill(process, signal.SIGKILL)
        self.gpio.drive("SUPPLY", True)
        self.is_back("the power has gone", process)
        told = self.alarmed(("R25", "The power failed in a program: long.nc, line "))
        found = re.search(r"line (\d+), X([-.\d]+) Y([-.\d]+) Z([-.\d]+)", told)
        if not found or int(found[1]) not in sides or max(abs(float(text) - place) for text, place in zip(found.groups()[1:], places)) > CORNER:
            raise Failed(f"{told!r}, but the axes stand at {places}, on line {sides}")
        if self.control.variable(501) != counted:
            raise Failed(f"#501 was {counted}, and is {self.control.variable(501)}")
        self.refuses("power on behind a failure in a program")
        self.acknowledge("power on behind a failure in a program")
        return f"{said}; {told}"

    def power_cuts(self):
        """ncrtd gets SIGKILL in motion: the drives stop by themselves, what is kept is intact, and the service comes back with nothing running."""
        rounds, counted, most_lost = 0, self.control.variable(501) or 0, 0
        self.control.ctl("variables", "set", "520", "--value", "123.456")
        self.control.ctl("tools", "set", "3", "--length", "81.25")
        time.sleep(1.5)
        for n in range(self.kills):
            self.in_motion()
            time.sleep(random.uniform(0.0, 1.5))
            process = self.control.process()
            seen = self.control.variable(501)
            os.kill(process, signal.SIGKILL)
            self.rests(f"kill {n}")
            self.is_back(f"kill {n}", process)
            if self.control.alarms():
                raise Failed(f"kill {n}: {self.control.says()}")
            self.quiet(f"kill {n}: behind the start of the service")
            kept = self.control.variable(501) or 0
            offset = self.control.ask("offsets.list", **{"from": 2, "count": 1})["offsets"][0]["axes"][0]["value"]
            tool = self.control.ask("tools.list", **{"from": 3, "count": 1})["tools"][0]["length"]
            lost = (seen - kept + 1) % ROUNDS - 1  # -1: it has counted on since it was read
            if not ((kept - counted) % ROUNDS < ROUNDS / 2 and lost <= 1 and (offset - kept + 1) % ROUNDS <= 2 and self.control.variable(520) == 123.456 and tool == 81.25):
                raise Failed(f"kill {n}: #501 was {seen} and is {kept}, X of G55 {offset}, #520 {self.control.variable(520)}, length of tool 3 {tool}")
            rounds, counted, most_lost = rounds + (kept - counted) % ROUNDS, kept, max(most_lost, lost)
            self.control.up(self.drives)
            if (n + 1) % 10 == 0:  # a long run that is ended says how far it has come
                print(f"      {n + 1} cuts: #501 counted {rounds:.0f} rounds and was {most_lost:.0f} behind at most", flush=True)
        return f"{self.kills} cuts; #501 counted {rounds:.0f} rounds and was {most_lost:.0f} behind at most, the rest of what is kept is what it was"

    def all(self):
        return [self.chain, self.emergency_stop, self.drive_fault, self.node_killed, self.interface_down, self.bus_off, self.chip_pulled_out, self.power_fail,
                self.power_cuts]
