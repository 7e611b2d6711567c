# SPDX-License-Identifier: Apache-2.0
"""What surrounds the control in the emulated computer: a GPIO chip and a CAN interface of the kernel, the drives, and the control as an operator and a
monitor see it."""
import glob
import json
import os
import pathlib
import signal
import socket
import struct
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
MACHINE = pathlib.Path("/etc/nc/target.toml")
PROGRAMS = pathlib.Path("/var/lib/nc/programs")
INTERFACE = "vcan0"
GAUGES = pathlib.Path("/run/gauges")
LAG_S = 0.020  # time constant of the drives' position loops


class Failed(Exception):
    """A check has seen something else than what is promised."""


def run(*command, good=True, seconds=120, text=""):
    """The output of a command; that it fails is an error unless `good` is false."""
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, timeout=seconds, input=text)
    if good and done.returncode != 0:
        raise Failed(f"{' '.join(map(str, command))}: exit status {done.returncode}: {done.stdout}{done.stderr}".strip())
    return (done.stdout + done.stderr).strip()


def until(what, seconds, every=0.1):
    """Waits until what() is true and gives its value, the last one when it never is."""
    end = time.monotonic() + seconds
    while not (value := what()) and time.monotonic() < end:
        time.sleep(every)
    return value


def busy():
    """The time for which the processor has worked since the boot: what a check costs the computer that emulates it, which skips over the rest."""
    idle, waits = [int(word) for word in pathlib.Path("/proc/stat").read_text().split()[4:6]]
    return time.clock_gettime(time.CLOCK_BOOTTIME) - (idle + waits) / os.sysconf("SC_CLK_TCK")


class Gpio:
    """A chip of gpio-sim (configfs) with named lines."""
    FOLDER = pathlib.Path("/sys/kernel/config/gpio-sim/nc")
    LINES = {0: "PART", 1: "CHAIN", 2: "SUPPLY", 4: "CLAMP", 5: "LAMP", 6: "WATCHDOG", 7: "SAVED", 8: "PROBE", 9: "PROBE_SLOW",
             10: "WHEEL_A", 11: "WHEEL_B", 12: "WHEEL_X", 13: "WHEEL_Y", 14: "WHEEL_100"}
    INPUTS = {"CHAIN", "SUPPLY", "PART", "PROBE", "PROBE_SLOW", "WHEEL_A", "WHEEL_B", "WHEEL_X", "WHEEL_Y", "WHEEL_100"}

    def __init__(self):
        run("modprobe", "gpio-sim")
        if not os.path.ismount("/sys/kernel/config"):
            run("mount", "-t", "configfs", "none", "/sys/kernel/config")
        bank = self.FOLDER / "bank"
        bank.mkdir(parents=True)
        (bank / "num_lines").write_text("16")
        (bank / "label").write_text("target-board")
        for offset, name in self.LINES.items():
            (bank / f"line{offset}").mkdir()
            (bank / f"line{offset}" / "name").write_text(name)
        self.levels = {line: line in ("CHAIN", "SUPPLY") for line in self.INPUTS}
        self.plug()

    def plug(self):
        (self.FOLDER / "live").write_text("1")
        self.chip = (self.FOLDER / "bank" / "chip_name").read_text().strip()
        self.place = pathlib.Path(glob.glob(f"/sys/devices/platform/gpio-sim.*/{self.chip}")[0])
        for line, level in self.levels.items():
            self.drive(line, level)
        run("chgrp", "ncrtd", f"/dev/{self.chip}")  # what a rule of udev does on a machine
        run("chmod", "660", f"/dev/{self.chip}")

    def pull_out(self):
        (self.FOLDER / "live").write_text("0")

    def is_whole(self):
        return (self.FOLDER / "live").read_text().strip() == "1" and self.levels["CHAIN"] and self.levels["SUPPLY"]

    def mend(self):
        """The chip is there, and its inputs are those of a machine that is ready."""
        self.levels.update(PART=False, CHAIN=True, SUPPLY=True, PROBE=False, PROBE_SLOW=False)
        if (self.FOLDER / "live").read_text().strip() != "1":
            return self.plug()
        for line, level in self.levels.items():
            self.drive(line, level)

    def file(self, line, name):
        offset = next(offset for offset, known in self.LINES.items() if known == line)
        return self.place / f"sim_gpio{offset}" / name

    def drive(self, line, level):
        self.levels[line] = bool(level)
        self.file(line, "pull").write_text("pull-up" if level else "pull-down")

    def level(self, line):
        return self.file(line, "value").read_text().strip() == "1"


class Spawner:
    """The process of plant.py from which those of the drives come: to load python canopen costs an emulated processor half a second, once."""
    LOG = pathlib.Path("/run/plants.log")

    def __init__(self):
        self.process = subprocess.Popen([sys.executable, HERE / "plant.py", INTERFACE, GAUGES], stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=self.LOG.open("a"), text=True)
        self.ready = set()

    def line(self):
        """What comes next: the process of a new drive, or "ready NODE"."""
        words = self.process.stdout.readline().split()
        if not words:
            raise Failed(f"the drives do not begin: {self.LOG.read_text()}")
        if words[0] == "ready":
            self.ready.add(int(words[1]))
        return words

    def begin(self, node):
        self.ready.discard(node)
        print(node, file=self.process.stdin, flush=True)
        while (words := self.line())[0] == "ready":
            pass
        return int(words[1])

    def wait(self, node):
        while node not in self.ready:
            self.line()


class Drive:
    """A node of the bus, a process of its own (plant.py), and the gauge at its axis."""
    PLACE = struct.Struct("<dddB")
    PASSED = struct.Struct("<dd")  # behind it, of the last SYNCs: the kernel's time of the frame, place
    STATES = ["disabled", "ready", "on", "enabled", "stop", "reaction", "fault"]

    def __init__(self, spawner, axis, node, per_mm, zero):
        self.spawner, self.axis, self.node, self.per_mm, self.zero = spawner, axis, node, per_mm, zero
        self.begin()

    def begin(self):
        self.process = self.spawner.begin(self.node)

    def wait(self):
        self.spawner.wait(self.node)

    def kill(self):
        os.kill(self.process, signal.SIGKILL)
        if not until(lambda: not self.alive(), 5, every=0.002):
            raise Failed(f"drive {self.node} outlives SIGKILL")

    def alive(self):
        return os.path.exists(f"/proc/{self.process}")

    def trip(self):
        os.kill(self.process, signal.SIGUSR1)

    def gauge(self):
        place, speed, _, state = self.PLACE.unpack((GAUGES / str(self.node)).read_bytes()[:self.PLACE.size])
        return place / self.per_mm + self.zero, speed / self.per_mm, self.STATES[state]

    def place(self):
        return self.gauge()[0]

    def place_at(self, when):
        """The place at a time of the wall clock, on the straight line between those at the SYNCs before and behind it."""
        passed = sorted(self.PASSED.iter_unpack((GAUGES / str(self.node)).read_bytes()[self.PLACE.size:]))
        behind = next((n for n, (at, _) in enumerate(passed) if at >= when), 0)
        if behind == 0:
            raise Failed(f"drive {self.node} had no SYNC before and behind {when}: {len(passed)} from {passed[0][0]} to {passed[-1][0]}")
        (begin, from_), (end, to) = passed[behind - 1:behind + 1]
        return (from_ + (to - from_) * (when - begin) / (end - begin)) / self.per_mm + self.zero


class Drives(list):
    def __init__(self):
        GAUGES.mkdir()
        # The scales of machine.toml: Y is turned round, Z has a gear and begins 12.5 mm above 0.
        spawner = Spawner()
        super().__init__([Drive(spawner, "X", 1, 131072 / 10, 0.0), Drive(spawner, "Y", 2, -131072 / 10, 0.0), Drive(spawner, "Z", 3, 131072 * 2 / 5, 12.5)])
        for drive in self:
            drive.wait()

    def alive(self):
        return all(drive.alive() for drive in self)

    def begin(self, anew=False):
        """The drives that are gone begin again; all of them with `anew`."""
        for drive in self:
            if anew and drive.alive():
                drive.kill()
            if not drive.alive():
                drive.begin()
                drive.wait()

    def places(self):
        return [drive.place() for drive in self]

    def states(self):
        return [drive.gauge()[2] for drive in self]

    def stand(self, seconds):
        """Whether no axis moves for so long, by the gauges."""
        before, end = self.places(), time.monotonic() + seconds
        while time.monotonic() < end:
            time.sleep(0.05)
            if max(abs(a - b) for a, b in zip(before, self.places())) > 1e-4:
                return False
        return all(drive.gauge()[1] == 0 for drive in self)  # one that waits for its SYNC has a speed

    @staticmethod
    def sto(open_):
        if open_:
            (GAUGES / "sto").touch()
        else:
            (GAUGES / "sto").unlink(missing_ok=True)


class Control:
    """ncrtd as the service of its package. An operator's screen is at its socket (docs/services.md), which has control; ncctl is used for the rest."""
    SOCKET = "/run/ncrtd/target.sock"

    def __init__(self):
        self.socket, self.number = None, 0

    # ---- the service ----

    @staticmethod
    def service(word, good=True):
        try:
            return run("systemctl", word, "ncrtd", good=good, seconds=180)
        except Failed as error:
            raise Failed(f"{error}\n{Control.log(12)}") from error

    @staticmethod
    def shown(name):
        return run("systemctl", "show", "-p", name, "--value", "ncrtd")

    @staticmethod
    def process():
        """The process of the service, 0 without one. From its cgroup: systemctl costs the emulated processor a quarter of a second."""
        try:
            return int(pathlib.Path("/sys/fs/cgroup/system.slice/ncrtd.service/cgroup.procs").read_text().split()[0])
        except (OSError, IndexError):
            return 0

    @staticmethod
    def log(lines=1000):
        run("journalctl", "--sync", good=False)
        return run("journalctl", "-u", "ncrtd", "-o", "cat", "-n", lines, "--no-pager", good=False)

    # ---- the monitor ----

    def receive(self):
        data = b""
        while len(data) < 4 or len(data) < 4 + int.from_bytes(data[:4], "big"):
            piece = self.socket.recv(65536)
            if not piece:
                raise OSError("the control has closed the connection")
            data += piece
        return json.loads(data[4:])

    def exchange(self, service, **args):
        self.number += 1
        text = json.dumps({"id": self.number, "service": service, "args": args}).encode()
        self.socket.sendall(len(text).to_bytes(4, "big") + text)
        return self.receive()

    def answer(self, service, **args):
        """What a service answers; {} when no control does."""
        for _ in range(2):
            try:
                if self.socket is None:
                    self.socket = socket.socket(socket.AF_UNIX)
                    self.socket.settimeout(30)
                    self.socket.connect(self.SOCKET)
                    self.receive()
                return self.exchange(service, **args)
            except OSError:
                self.socket.close()
                self.socket = None
        return {}

    def ask(self, service, **args):
        return self.answer(service, **args).get("reply", {})

    def status(self):
        return self.ask("status").get("systems", [{}])[0]

    def state(self):
        return self.status().get("state", "none")

    def alarms(self):
        return [f"{each['code']} {each['text']}" + (f" ({each['axis']})" if each["axis"] else "") for each in self.ask("alarms").get("alarms", [])]

    def variable(self, number):
        rows = self.ask("variables.list", **{"from": number, "count": 1}).get("variables", [])
        return rows[0]["value"] if rows and rows[0]["number"] == number else None

    def says(self):
        return f"{self.status().get('state_text', 'no control answers')}; alarms {self.alarms()}"

    # ---- the operator ----

    @staticmethod
    def ctl(*words, good=True):
        return run("ncctl", *words, good=good)

    def press(self, service, good=True, lifespan_ms=10000, **args):
        """Does what an operator's screen does; gives the text of the answer. That it is refused is an error unless `good` is false."""
        self.answer("control.take", lease_ms=60000)
        said = self.answer(service, lifespan_ms=lifespan_ms, **args)
        if good and not said.get("ok"):
            raise Failed(f"{service} {args}: {said}; {self.says()}")
        return said.get("text", "")

    def mdi(self, text, seconds=60):
        """Executes blocks and waits for their end."""
        self.press("mode", mode="mdi")
        runs = self.status().get("runs", 0)
        self.press("mdi", blocks=text)
        self.press("start")
        if not until(lambda: self.status().get("runs", 0) > runs and self.state() == "idle", seconds):
            raise Failed(f"MDI {text} does not end: {self.says()}")

    def start(self, program):
        self.press("mode", mode="auto")
        self.press("select", name=program)
        self.press("start")

    def up(self, drives):
        """Waits until the control answers and the drives are on; no alarm may be there."""
        def follows():
            return self.state() == "idle" and set(drives.states()) == {"enabled"}
        if not until(follows, 60) or self.alarms():
            raise Failed(f"it does not come up: {self.says()}, drives {drives.states()}\n{self.log(8)}")
