# SPDX-License-Identifier: Apache-2.0
# What the tests of ncrtd against pymodbus (an independent implementation of Modbus) have in common: the virtual environment that holds it,
# a server made of it in a process of its own, a client that looks at the server, and processes that end with the test. Loopback only.
import fcntl
import json
import os
import pathlib
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import threading
import time

PYMODBUS = "pymodbus[serial]==3.16.1"
SKIPPED = 77
LONG = 60  # seconds: far more than anything here takes
HERE = pathlib.Path(__file__).resolve().parent
BUILD = pathlib.Path(os.environ["NC_BINARY_DIR"])
NCRTD = BUILD / "bin" / "ncrtd"


def skip(why):
    print(why + ": skipped")
    sys.exit(SKIPPED)


def environment():
    """The Python of a virtual environment with the pinned pymodbus, which is made if it does not exist."""
    with open(BUILD / "modbus-venv.lock", "w") as lock:  # of all tests that want it
        fcntl.flock(lock, fcntl.LOCK_EX)
        return made_environment(BUILD / "modbus-venv")


def made_environment(folder):
    python = folder / "bin" / "python"
    stamp = folder / "installed"
    if stamp.exists() and stamp.read_text() == PYMODBUS:
        return python
    made = subprocess.run([sys.executable, "-m", "venv", "--clear", folder], capture_output=True, text=True)
    if made.returncode != 0:
        skip("no virtual environment (Debian: python3-venv): " + (made.stdout + made.stderr).strip()[-300:])
    pip = [python, "-m", "pip", "install", "-q", "--disable-pip-version-check", "--timeout", "15", "--retries", "1"]
    try:
        installed = subprocess.run(pip + [PYMODBUS], capture_output=True, text=True, timeout=300)
    except subprocess.TimeoutExpired:
        skip("pip did not come to an end")
    if installed.returncode != 0:
        skip(f"pip could not install {PYMODBUS}: " + installed.stderr.strip()[-300:])
    stamp.write_text(PYMODBUS)
    return python


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def until(what, condition):
    end = time.monotonic() + LONG
    while time.monotonic() < end:
        if condition():
            return
        time.sleep(0.01)
    raise AssertionError("did not come about: " + what)


class Client:
    """Just enough of a Modbus client."""

    def __init__(self, port):
        self.socket = socket.create_connection(("127.0.0.1", port), timeout=LONG)
        self.lock = threading.Lock()

    def request(self, unit, pdu):
        with self.lock:
            self.socket.sendall(struct.pack(">HHHB", 1, 0, len(pdu) + 1, unit) + pdu)
            head = self.exactly(7)
            return self.exactly(struct.unpack(">H", head[4:6])[0] - 1)

    def exactly(self, size):
        data = b""
        while len(data) < size:
            piece = self.socket.recv(size - len(data))
            assert piece, "closed"
            data += piece
        return data

    def coils(self, first, count):
        data = self.request(1, struct.pack(">BHH", 1, first, count))[2:]
        return [data[i // 8] >> i % 8 & 1 for i in range(count)]

    def registers(self, first, count):
        return list(struct.unpack(f">{count}H", self.request(1, struct.pack(">BHH", 3, first, count))[2:]))

    def set_coil(self, address, value):
        assert self.request(1, struct.pack(">BHH", 5, address, 0xFF00 if value else 0))[0] == 5

    def set_register(self, address, value):
        assert self.request(1, struct.pack(">BHH", 6, address, value))[0] == 6


class Server:
    """pymodbus in a process of its own."""

    def __init__(self, python, port, units):
        self.port = port
        self.process = subprocess.Popen([python, HERE / "pymodbus_server.py", str(port), json.dumps(units)],
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        until("server", self.listens)
        self.client = Client(port)

    def listens(self):
        assert self.process.poll() is None, "the server ended"
        try:
            socket.create_connection(("127.0.0.1", self.port), timeout=1).close()
            return True
        except OSError:
            return False

    def kill(self):
        self.client.socket.close()
        self.process.kill()
        self.process.wait()


def run(exercise):
    """exercise(python, folder, running): processes that it appends to `running` are ended, and what ncrtd has printed is shown, when it fails."""
    if not os.access(NCRTD, os.X_OK):
        skip("ncrtd is not built")
    python = environment()
    running = []
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        try:
            exercise(python, folder, running)
        except BaseException:
            for file in ("out", "err"):
                if (folder / file).exists():
                    print(f"--- {file} of ncrtd\n" + (folder / file).read_text()[-3000:])
            raise
        finally:
            for process in running:
                if process.poll() is None:
                    process.send_signal(signal.SIGKILL)
                    process.wait()
    print("all good")
