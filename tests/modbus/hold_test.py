#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What outputs of a Modbus device do when their control ends: a clamp that holds stays closed over SIGTERM, over SIGKILL and over the
start of the next control; the lamp beside it goes off in order, and stays on behind a crash until the next control has its say."""
import os
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time

NCRTD = os.path.join(os.environ["NC_BINARY_DIR"], "bin", "ncrtd")
PATIENCE = 60.0  # s; only a failure takes so long
MACHINE = """
[machine]
name = "holding"
programs = "."
[scheduling]
policy = "other"
lock_memory = false
overrun = "count"
[[axis]]
name = "X"
max_velocity = 100.0
max_acceleration = 1000.0
[[modbus]]
name = "io"
host = "127.0.0.1"
port = PORT
poll_ms = 5
[[point]]
name = "close"
direction = "input"
modbus = { link = "io", table = "discrete", address = 0 }
[[point]]
name = "open"
direction = "input"
modbus = { link = "io", table = "discrete", address = 1 }
[[point]]
name = "clamp"
direction = "output"
modbus = { link = "io", table = "coil", address = 0, on_stop = "hold" }
[[point]]
name = "lamp"
direction = "output"
modbus = { link = "io", table = "coil", address = 1 }
[[point]]
name = "vent"
direction = "output"
modbus = { link = "io", table = "coil", address = 2, on_stop = 1 }
[ladder]
program = "own.il"
"""
# The clamp stays closed by itself until it is opened; lamp and vent are on while it is closed.
# The same outputs, driven by a program: it copies the state of the clamp that it reads to the lamp, and opens the clamp.
MACRO = MACHINE.replace('[ladder]\nprogram = "own.il"\n', '[macro_interface]\n"#1100" = "clamp"\n"#1101" = "lamp"\n')
BLOCKS = "#1101=#1100 ; G4 X0.3 ; #1100=0 ; G4 X0.3"
LADDER = "LD close\nOR clamp\nANI open\nOUT clamp\nLD clamp\nOUT lamp\nLD SM400\nRST vent\nLD nc.m_strobe\nOUT plc.fin2\nEND\n"


class Device:
    """Coils and discrete inputs over Modbus TCP, written from the protocol; remembers every value that coil 0 was given."""

    def __init__(self):
        self.coils, self.inputs = [0] * 3, [0, 0]
        self.clamp_writes = []
        self.lamp_was_on = False
        self.lock = threading.Lock()
        self.listener = socket.create_server(("127.0.0.1", 0))
        self.port = self.listener.getsockname()[1]
        threading.Thread(target=self.accept, daemon=True).start()

    def accept(self):
        while True:
            connection, _ = self.listener.accept()
            threading.Thread(target=self.serve, args=(connection,), daemon=True).start()

    def serve(self, connection):
        def take(count):
            data = b""
            while len(data) < count:
                more = connection.recv(count - len(data))
                if not more:
                    raise ConnectionError
                data += more
            return data

        try:
            while True:
                head = take(7)
                transaction, _, length, unit = struct.unpack(">HHHB", head)
                answer = self.answer(take(length - 1))
                connection.sendall(struct.pack(">HHHB", transaction, 0, len(answer) + 1, unit) + answer)
        except OSError:
            connection.close()

    def put(self, first, values):
        self.coils[first:first + len(values)] = values
        self.lamp_was_on |= self.coils[1] == 1
        if first == 0:
            self.clamp_writes.append(values[0])

    def answer(self, pdu):
        function, first, count = struct.unpack(">BHH", pdu[:5])
        with self.lock:
            if function in (1, 2):
                bits = (self.coils if function == 1 else self.inputs)[first:first + count]
                return bytes([function, 1, sum(bit << i for i, bit in enumerate(bits))])
            if function == 5:
                self.put(first, [1 if count == 0xFF00 else 0])
                return pdu
            if function == 15:
                self.put(first, [pdu[6] >> i & 1 for i in range(count)])
                return pdu[:5]
        return bytes([function | 0x80, 1])


def until(function, text):
    end = time.monotonic() + PATIENCE
    while not function():
        if time.monotonic() > end:
            raise AssertionError("not within time: " + text)
        time.sleep(0.01)
    print("ok:", text, flush=True)


def main():
    if not os.path.exists(NCRTD):
        print("skipped: ncrtd is not built")
        return 77
    device = Device()
    running = []

    def start(folder):
        running.append(subprocess.Popen([NCRTD, "--machine", os.path.join(folder, "machine.toml"), "serve"], stdout=subprocess.DEVNULL))
        return running[-1]

    with tempfile.TemporaryDirectory() as folder:
        for name, text in (("machine.toml", MACHINE.replace("PORT", str(device.port))), ("own.il", LADDER),
                           ("macro.toml", MACRO.replace("PORT", str(device.port)))):
            with open(os.path.join(folder, name), "w", encoding="ascii") as file:
                file.write(text)
        try:
            control = start(folder)
            device.inputs[0] = 1
            until(lambda: device.coils == [1, 1, 0], "the clamp closes, the lamp is on")
            device.inputs[0] = 0
            device.clamp_writes.clear()
            control.send_signal(signal.SIGTERM)
            assert control.wait(PATIENCE) == 0, "SIGTERM is an orderly end"
            assert device.coils == [1, 0, 1], device.coils
            print("ok: SIGTERM: the clamp holds, the lamp is off, the vent is open")
            control = start(folder)
            until(lambda: device.coils == [1, 1, 0], "the next control finds the clamp closed, and goes on from there")
            control.kill()
            control.wait()
            assert device.coils == [1, 1, 0], device.coils
            print("ok: SIGKILL: the device keeps what it has")
            control = start(folder)
            until(lambda: len(device.clamp_writes) > 3 and device.coils == [1, 1, 0], "and so does the control behind it")
            assert all(device.clamp_writes), "nobody has opened the clamp in between"
            device.inputs[1] = 1
            until(lambda: device.coils == [0, 0, 0], "it opens when it is told to")
            control.send_signal(signal.SIGTERM)
            assert control.wait(PATIENCE) == 0
            assert device.coils == [0, 0, 1], device.coils
            device.coils, device.lamp_was_on = [1, 0, 0], False
            subprocess.run([NCRTD, "--machine", os.path.join(folder, "macro.toml"), "mdi", BLOCKS], stdout=subprocess.DEVNULL, timeout=PATIENCE, check=True)
            assert device.lamp_was_on, "a program reads the clamp as it was found"
            assert device.coils[0] == 0, "and opens it"
            print("ok: #1100 reads the clamp as it was found, and #1100=0 opens it")
        finally:
            for child in running:
                if child.poll() is None:
                    child.kill()
                    child.wait()
    return 0


sys.exit(main())
