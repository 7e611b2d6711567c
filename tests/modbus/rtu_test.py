# SPDX-License-Identifier: Apache-2.0
# ncrtd on a serial line with Modbus RTU devices made of pymodbus (an independent implementation), over two pseudo-terminals. The program
# waits for what a device has, writes to another, reads that back, and ends only when all of it has come about.
import json
import os
import pty
import subprocess
import threading
import tty

from pymodbus_rig import HERE, LONG, NCRTD, run, until

CONFIG = """
[machine]
name = "Modbus RTU test"
programs = "."
[scheduling]
overrun = "count"
[[axis]]
name = "X"
max_velocity = 500.0
max_acceleration = 5000.0
[[modbus]]
name = "line"
device = "LINE"
baud = 38400
parity = "none"
poll_ms = 5
response_timeout_ms = 1000
"""
# name, type, direction, modbus
POINTS = [
    ("present", "bit", "input", 'table = "coil", address = 0, unit = 1'),
    ("level", "word", "input", 'table = "holding", address = 10, unit = 1'),
    ("lamp", "bit", "output", 'table = "coil", address = 3, unit = 2'),
    ("lamp_back", "bit", "input", 'table = "coil", address = 3, unit = 2'),
    ("speed", "word", "output", 'table = "holding", address = 20, words = "CDAB", unit = 2'),
    ("speed_back", "word", "input", 'table = "holding", address = 20, words = "CDAB", unit = 2'),
]
MACRO = {"#1000": "present", "#1001": "line.ok", "#1002": "lamp_back", "#1033": "level", "#1034": "speed_back", "#1100": "lamp", "#1133": "speed"}
PROGRAM = """G91 F6000.
WHILE[#1000 NE 1]DO1
G4 P10
END1
WHILE[#1033 NE 1230]DO1
G4 P10
END1
WHILE[#1001 NE 1]DO1
G4 P10
END1
#1100=1
#1133=70000
WHILE[#1002 NE 1]DO1
G4 P10
END1
WHILE[#1034 NE 70000]DO1
G4 P10
END1
G1 X1.
M30
"""
UNITS = {1: {"coil": [1], "holding": [0] * 10 + [1230]}, 2: {"coil": [0] * 4, "holding": [0] * 22}}


class Cable:
    """Two pseudo-terminals; what goes into one comes out of the other."""

    def __init__(self):
        self.ends = [pty.openpty() for _ in range(2)]
        for _, slave in self.ends:
            tty.setraw(slave)
        for here, there in ((0, 1), (1, 0)):
            threading.Thread(target=self.pump, args=(self.ends[here][0], self.ends[there][0]), daemon=True).start()

    def name(self, end):
        return os.ttyname(self.ends[end][1])

    @staticmethod
    def pump(source, target):
        while True:
            try:
                data = os.read(source, 4096)
            except OSError:
                return
            while data:
                data = data[os.write(target, data):]


def exercise(python, folder, running):
    cable = Cable()
    text = CONFIG.replace("LINE", cable.name(0))
    for name, kind, direction, modbus in POINTS:
        text += f'[[point]]\nname = "{name}"\ntype = "{kind}"\ndirection = "{direction}"\nmodbus = {{ link = "line", {modbus} }}\n'
    text += "[macro_interface]\n" + "".join(f'"{number}" = "{name}"\n' for number, name in MACRO.items())
    (folder / "machine.toml").write_text(text)
    (folder / "copy.nc").write_text(PROGRAM)
    devices = subprocess.Popen([python, HERE / "pymodbus_serial.py", cable.name(1), "38400", "N", json.dumps(UNITS)], stdout=subprocess.PIPE, text=True)
    running.append(devices)
    assert devices.stdout.readline() == "ready\n"
    with open(folder / "out", "w") as out, open(folder / "err", "w") as err:
        ncrtd = subprocess.Popen([NCRTD, "--config", folder / "machine.toml", "run", "--no-progress", folder / "copy.nc"], stdout=out, stderr=err)
    running.append(ncrtd)
    assert ncrtd.wait(LONG) == 0, "exit status"
    log = (folder / "err").read_text()
    assert f"modbus: line: connected to {cable.name(0)}" in log, log

    # A second control cannot have the line meanwhile.
    with open(folder / "out", "w") as out, open(folder / "err", "w") as err:
        first = subprocess.Popen([NCRTD, "--config", folder / "machine.toml", "serve"], stdout=out, stderr=err)
    running.append(first)
    other = folder / "other"
    other.mkdir()
    (other / "machine.toml").write_text(text.replace("Modbus RTU test", "Another"))
    (other / "copy.nc").write_text(PROGRAM)
    until("the first has the line", lambda: "connected to" in (folder / "err").read_text() or first.poll() is not None)
    second = subprocess.run([NCRTD, "--config", other / "machine.toml", "run", "--no-progress", other / "copy.nc"], capture_output=True, text=True, timeout=LONG)
    assert second.returncode == 3 and "serial line" in second.stderr, (second.returncode, second.stderr)

    # All devices lose their power.
    devices.kill()
    devices.wait()
    first.terminate()
    assert first.wait(LONG) == 0, f"it ends though nobody answers, and in order: {first.returncode}"


run(exercise)
