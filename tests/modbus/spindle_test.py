# SPDX-License-Identifier: Apache-2.0
# A spindle that turns outside: its speed comes over Modbus from a server made of pymodbus, and feed per revolution goes by that speed alone,
# whatever S was commanded. A second server is the panel on which the test sees what the machine does. Loopback only.
import struct
import subprocess
import time

from pymodbus_rig import LONG, NCRTD, Server, free_port, run, until

CONFIG = """
[machine]
name = "spindle outside"
programs = "."
[scheduling]
overrun = "count"
[[axis]]
name = "X"
max_velocity = 200.0
max_acceleration = 2000.0
[[modbus]]
name = "drive"
host = "127.0.0.1"
port = {drive}
poll_ms = 5
response_timeout_ms = 5000
[[modbus]]
name = "panel"
host = "127.0.0.1"
port = {panel}
poll_ms = 5
response_timeout_ms = 5000
"""

# When the drive is silent its last value stays in the image: no axis may feed with that speed.
POINTS = [
    ("speed", "word", "input", 'link = "drive", table = "holding", address = 0, signed = true, on_loss = "hold"'),
    ("wanted", "word", "output", 'link = "drive", table = "holding", address = 1'),
    ("reset", "bit", "input", 'link = "panel", table = "coil", address = 0'),
    ("measured", "bit", "output", 'link = "panel", table = "coil", address = 10'),
    ("cause", "word", "output", 'link = "panel", table = "holding", address = 0'),
    ("feed", "word", "output", 'link = "panel", table = "holding", address = 1'),
    ("place", "word", "output", 'link = "panel", table = "holding", address = 2, words = "ABCD"'),
    ("line", "word", "output", 'link = "panel", table = "holding", address = 4'),
]
SIGNALS = {"plc.reset": "reset", "nc.spindle_measured": "measured", "nc.stop_cause": "cause", "nc.feed": "feed", "nc.position.X": "place",
           "nc.line": "line", "nc.s_code": "wanted"}
SPINDLE = '[[spindle]]\nfeedback = "speed"\n'
STANDS, NOT_MEASURED = 12, 17  # stop causes
PART = "S3000 M3\nG95 G1 X400. F0.5\nM30\n"


class Machine:
    """ncrtd with that part, and the panel."""

    def __init__(self, python, folder, running, more, speed, part=PART):
        self.python, self.running = python, running
        self.ports = {"drive": free_port(), "panel": free_port()}
        text = CONFIG.format(**self.ports) + more
        for name, kind, direction, modbus in POINTS:
            text += f'[[point]]\nname = "{name}"\ntype = "{kind}"\ndirection = "{direction}"\nmodbus = {{ {modbus} }}\n'
        text += "[signals]\n" + "".join(f'"{signal}" = "{point}"\n' for signal, point in SIGNALS.items())
        (folder / "machine.toml").write_text(text)
        (folder / "part.nc").write_text(part)
        self.panel = self.server("panel", {1: {"coil": [0] * 16, "holding": [0] * 8}})
        self.start_drive(speed)
        self.log = folder / "err"
        with open(folder / "out", "w") as out, open(self.log, "w") as err:
            self.ncrtd = subprocess.Popen([NCRTD, "--config", folder / "machine.toml", "run", "--no-progress", folder / "part.nc"], stdout=out, stderr=err)
        running.append(self.ncrtd)

    def server(self, name, units):
        server = Server(self.python, self.ports[name], units)
        self.running.append(server.process)
        return server

    def start_drive(self, speed):
        self.drive = self.server("drive", {1: {"holding": [speed, 0]}})

    def now(self):
        cause, feed, high, low, line = self.panel.client.registers(0, 5)
        place = struct.unpack(">i", struct.pack(">HH", high, low))[0]  # um
        return {"cause": cause, "feed": feed, "place": place, "line": line, "measured": self.panel.client.coils(10, 1)[0]}

    def shows(self, what, **wanted):
        seen = {}

        def there():
            assert self.ncrtd.poll() is None, "ncrtd has ended"
            seen.update(self.now())
            return wanted.items() <= seen.items()

        try:
            until(what, there)
        except AssertionError as error:
            raise AssertionError(f"{error}: {wanted} is wanted, it shows {seen}") from None
        print("ok:", what, flush=True)

    def turns(self, rpm):
        self.drive.client.set_register(0, rpm & 0xFFFF)

    def stands(self, what):
        """Comes to rest (the measured place runs behind the commanded one), and stays there for some exchanges of the panel."""
        seen = []

        def rests():
            seen.append(self.now()["place"])
            return len(seen) > 20 and len(set(seen[-20:])) == 1

        until(f"rest {what}", rests)
        place = seen[-1]
        for _ in range(20):
            time.sleep(0.02)
            assert self.now()["place"] == place, f"{what}: the axis goes from {place} to {self.now()['place']} um"
        return place

    def reset(self):
        self.panel.client.set_coil(0, 1)
        self.shows("a reset ends what waits", cause=0, feed=0)
        self.panel.client.set_coil(0, 0)
        assert self.ncrtd.wait(LONG) != 0, "it was given up"
        self.panel.kill()
        self.drive.kill()


def bound(python, folder, running):
    machine = Machine(python, folder, running, SPINDLE, 0)
    machine.shows("the drive is told its speed, does not turn, and nothing feeds", cause=STANDS, feed=0, place=0, measured=1, line=2)
    until("the speed that is commanded is at the drive", lambda: machine.drive.client.registers(1, 1) == [3000])
    assert machine.stands("at 0 r/min") == 0
    for rpm, feed in ((600, 300), (1200, 600), (-600, 300)):
        machine.turns(rpm)
        machine.shows(f"{rpm} r/min by 0.5 mm feed {feed} mm/min", cause=0, feed=feed, measured=1)
    assert machine.now()["place"] > 0
    machine.turns(0)
    machine.shows("the spindle stands in the middle of the cut, and so does the feed, which says why", cause=STANDS, feed=0, measured=1)
    place = machine.stands("at 0 r/min in the cut")
    assert 0 < place < 400000, place
    machine.turns(1200)
    machine.shows("it goes on when it turns again", cause=0, feed=600)
    machine.drive.kill()
    machine.shows("a drive that is silent measures nothing", cause=NOT_MEASURED, feed=0, measured=0)
    place = machine.stands("without a drive")
    machine.start_drive(200)
    machine.shows("and counts again when it is back", cause=0, feed=100, measured=1)
    machine.turns(0)
    machine.shows("stands", cause=STANDS, feed=0)
    place = machine.stands("before the reset")
    machine.reset()
    assert 0 < place < 400000, place


def unbound(python, folder, running):
    machine = Machine(python, folder, running, "", 3000)
    machine.shows("no point is bound: it waits, and says for what", cause=NOT_MEASURED, feed=0, place=0, measured=0, line=2)
    assert machine.stands("without a point") == 0
    machine.reset()
    log = machine.log.read_text()
    assert "nothing measures spindle 1 of part system 1: feed per revolution (G95)" in log, log
    print("ok: the log says what to do")
    check = subprocess.run([NCRTD, "--config", folder / "machine.toml", "check"], capture_output=True, text=True)
    assert "nothing measures spindle 1" in check.stdout + check.stderr, check.stdout + check.stderr
    print("ok: so does check")


def exercise(python, folder, running):
    bound(python, folder, running)
    unbound(python, folder, running)


run(exercise)
