# SPDX-License-Identifier: Apache-2.0
# ncrtd with three Modbus links while a program runs: two servers made of pymodbus (an independent implementation) and
# one that answers wrongly on purpose. The program copies what it reads (#1000...) to outputs (#1100...) that stand on
# the second server, the panel: there the test sees what the program sees. Loopback only.
import os
import socket
import struct
import subprocess
import threading
import time

from pymodbus_rig import LONG, NCRTD, Server, free_port, run, until


class FaultyServer:
    """Answers reads of one holding register, as `mode` says; wrong answers carry POISON."""
    POISON = 666

    def __init__(self):
        self.mode, self.value = "right", 5
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.port = self.listener.getsockname()[1]
        threading.Thread(target=self.accept, daemon=True).start()

    def accept(self):
        while True:
            connection, _ = self.listener.accept()
            threading.Thread(target=self.serve, args=(connection,), daemon=True).start()

    def serve(self, connection):
        try:
            with connection:
                while True:
                    request = connection.recv(300)
                    if not request or not self.answer(connection, request):
                        return
        except OSError:
            pass  # the link closed it, as it should

    def answer(self, connection, request):
        mode = self.mode
        value = self.value if mode == "right" else self.POISON
        right = request[:4] + struct.pack(">HBBBH", 5, request[6], 3, 2, value)
        if mode == "wrong transaction":
            connection.sendall(bytes([right[0] ^ 0x55]) + right[1:])
        elif mode == "garbage":
            connection.sendall(os.urandom(40))
        elif mode == "half a frame":
            connection.sendall(right[:-1])
            return False
        elif mode == "late":  # far behind the time-out of the link
            time.sleep(0.5)
            connection.sendall(right)
        else:
            connection.sendall(right)
        return True


CONFIG = """
[machine]
name = "Modbus test"
programs = "."
[scheduling]
overrun = "count"
[[axis]]
name = "X"
max_velocity = 500.0
max_acceleration = 5000.0

[[modbus]]
name = "io"
host = "127.0.0.1"
port = {io}
poll_ms = 5
response_timeout_ms = 1000
[[modbus]]
name = "panel"
host = "localhost"
port = {panel}
poll_ms = 5
response_timeout_ms = 5000
[[modbus]]
name = "faulty"
host = "127.0.0.1"
port = {faulty}
poll_ms = 5
response_timeout_ms = 200
lost_after = 2
"""

# name, type, direction, rest, modbus
POINTS = [
    ("present", "bit", "input", "", 'link = "io", table = "coil", address = 0'),
    ("gate", "bit", "input", "", 'link = "io", table = "discrete", address = 3, unit = 2'),
    ("level", "word", "input", "", 'link = "io", table = "holding", address = 10, scale = 0.1, on_loss = 777'),
    ("temperature", "word", "input", "", 'link = "io", table = "input", address = 4, unit = 2, float = true, '
                                         'words = "CDAB", scale = 10, on_loss = "hold"'),
    ("nowhere", "word", "input", "", 'link = "io", table = "holding", address = 500'),
    ("io_lamp", "word", "output", "initial = 3", 'link = "io", table = "holding", address = 5'),
    ("stop", "bit", "input", "", 'link = "panel", table = "coil", address = 0'),
    ("probe", "word", "input", "", 'link = "faulty", table = "holding", address = 0, on_loss = "99"'),
    ("m_present", "bit", "output", "initial = 1", 'link = "panel", table = "coil", address = 10'),
    ("m_io_ok", "bit", "output", "", 'link = "panel", table = "coil", address = 11'),
    ("m_gate", "bit", "output", "", 'link = "panel", table = "coil", address = 12'),
    ("m_faulty_ok", "bit", "output", "", 'link = "panel", table = "coil", address = 13'),
    ("m_level", "word", "output", "", 'link = "panel", table = "holding", address = 20, words = "CDAB"'),
    ("m_temperature", "word", "output", "", 'link = "panel", table = "holding", address = 22, words = "ABCD"'),
    ("m_probe", "word", "output", "", 'link = "panel", table = "holding", address = 24'),
]
MACRO = {"#1000": "present", "#1001": "io.ok", "#1002": "stop", "#1003": "gate", "#1004": "faulty.ok",
         "#1033": "level", "#1034": "temperature", "#1035": "probe",
         "#1100": "m_present", "#1101": "m_io_ok", "#1102": "m_gate", "#1103": "m_faulty_ok",
         "#1133": "m_level", "#1134": "m_temperature", "#1135": "m_probe"}
PROGRAM = """G91 F6000.
WHILE[#1002 EQ 0]DO1
#1100=#1000
#1101=#1001
#1102=#1003
#1103=#1004
#1133=#1033
#1134=#1034
#1135=#1035
G1 X0.1
X-0.1
END1
#1100=0
G4 P50
M30
"""


def write_files(folder, ports):
    text = CONFIG.format(**ports)
    for name, kind, direction, rest, modbus in POINTS:
        text += (f'[[point]]\nname = "{name}"\ntype = "{kind}"\ndirection = "{direction}"\n{rest}\n'
                 f"modbus = {{ {modbus} }}\n")
    text += "[macro_interface]\n" + "".join(f'"{number}" = "{name}"\n' for number, name in MACRO.items())
    (folder / "machine.toml").write_text(text)
    (folder / "copy.nc").write_text(PROGRAM)


def float_cdab(value):
    high, low = struct.unpack(">HH", struct.pack(">f", value))
    return [low, high]


def io_units(present, level, temperature):
    return {1: {"coil": [present], "holding": [0] * 10 + [level]},
            2: {"discrete": [0, 0, 0, 1], "input": [0] * 4 + float_cdab(temperature)}}


class Panel:
    """What the program sees, read at the panel."""

    def __init__(self, client):
        self.client = client

    def bits(self):
        return dict(zip(("present", "io_ok", "gate", "faulty_ok"), self.client.coils(10, 4)))

    def words(self):
        r = self.client.registers(20, 5)
        return {"level": r[1] << 16 | r[0], "temperature": r[2] << 16 | r[3], "probe": r[4]}

    def shows(self, **wanted):
        until(f"the panel shows {wanted}", lambda: wanted.items() <= {**self.bits(), **self.words()}.items())


def faults(panel, faulty):
    """Each kind of wrong answer: the link is lost, no value of it is seen, and it heals."""
    seen, watching = set(), True

    def watch():
        while watching:
            seen.add(panel.words()["probe"])

    watcher = threading.Thread(target=watch)
    watcher.start()
    try:
        for n, mode in enumerate(("wrong transaction", "garbage", "half a frame", "late")):
            faulty.mode = mode
            panel.shows(faulty_ok=0, probe=99, io_ok=1)
            faulty.value = 10 + n
            faulty.mode = "right"
            panel.shows(faulty_ok=1, probe=10 + n, io_ok=1)
    finally:
        watching = False
        watcher.join()
    assert seen <= {0, 5, 99, 10, 11, 12, 13}, f"values that nobody sent, or sent too late: {seen}"


def exercise(python, folder, running):
    ports = {"io": free_port(), "panel": free_port()}
    faulty = FaultyServer()
    write_files(folder, {**ports, "faulty": faulty.port})
    panel_server = Server(python, ports["panel"], {1: {"coil": [0] * 16, "holding": [0] * 32}})
    running.append(panel_server.process)
    io = Server(python, ports["io"], io_units(1, 1230, 20.5))
    running.append(io.process)
    with open(folder / "out", "w") as out, open(folder / "err", "w") as err:
        ncrtd = subprocess.Popen([NCRTD, "--config", folder / "machine.toml", "run", "--no-progress", folder / "copy.nc"],
                                 stdout=out, stderr=err)
    running.append(ncrtd)
    panel = Panel(panel_server.client)

    panel.shows(present=1, io_ok=1, gate=1, level=123, temperature=205, probe=5, faulty_ok=1)
    until("the initial value of an output", lambda: io.client.registers(5, 1) == [3])
    io.client.set_coil(0, 0)
    io.client.set_register(10, 50)
    panel.shows(present=0, level=5)
    io.client.set_coil(0, 1)
    panel.shows(present=1)

    io.kill()
    panel.shows(present=0, io_ok=0, gate=0, level=777, temperature=205, probe=5, faulty_ok=1)
    assert ncrtd.poll() is None, "the program goes on"
    io = Server(python, ports["io"], io_units(1, 990, -3.25))
    running.append(io.process)
    panel.shows(present=1, io_ok=1, gate=1, level=99, temperature=2**32 - 33)
    until("outputs are written again", lambda: io.client.registers(5, 1) == [3])

    faults(panel, faulty)

    panel_server.client.set_coil(0, 1)
    assert ncrtd.wait(LONG) == 0, "exit status"
    assert panel_server.client.coils(10, 1) == [1], "the safe value after the end"
    log = (folder / "err").read_text()
    for line in ("modbus: io: holding 500 unit 1, function 3: Illegal data address", "modbus: io: lost: ",
                 "modbus: faulty: lost: ", "modbus: panel: connected to localhost"):
        assert line in log, f"'{line}' is missing in:\n{log}"
    assert "alarm" not in log, log


run(exercise)
