#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What clients of the services cost the scan and the processor, and how many requests ncrtd answers in a second.

  bench/service_cost.py [BUILD_DIR] [PAIRS] [SECONDS] [POLICY]      default build/release, 5 pairs of runs of 6 s, other

A control executes a program of lines and arcs on the real clock, in turn without clients, with ten clients that have a watch list of 16 devices every 20 ms each,
with the same where all these devices are forced, also in the run without clients, so that each update has 16 marks, and with ten clients that ask for the status as fast as they are answered. The figures of the scan are those of ncrtd's own summary; each run with clients is compared
with the run without clients before it, and the medians of the differences are shown. The processor time is that of all threads of ncrtd.

POLICY fifo gives the scan its real-time priority, as on a machine: other work of the computer then does not show in its 99 %. It needs root, or the limits of the unit.

Goals: the watch lists add at most 0.5 us to the median and to the 99 % of a scan and 5 % of a core; 1,000 requests are answered in a second. They are reported
but do not decide the exit status, since the times depend on the computer. Exit status: 0, 1 when something does not run, 77 (skipped) where ncrtd is not built.
"""
import json
import os
import re
import signal
import socket
import statistics
import struct
import subprocess
import sys
import tempfile
import threading
import time

root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
build = os.path.abspath(sys.argv[1]) if len(sys.argv) > 1 else os.path.join(root, "build/release")
pairs = int(sys.argv[2]) if len(sys.argv) > 2 else 5
seconds = float(sys.argv[3]) if len(sys.argv) > 3 else 6
policy = sys.argv[4] if len(sys.argv) > 4 else "other"
ncrtd = os.path.join(build, "bin/ncrtd")
CLIENTS, INTERVAL_MS = 10, 20
DEVICES = [f"D{n}" for n in range(16)]
PROGRAM = "G90 G54 G17\n#1=0\nWHILE [#1 LT 100000] DO1\nG1 X20. Y10. F3000.\nG3 X20. Y30. J10.\nG1 X0. Y0.\n#1=#1+1\nEND1\nM30\n"


class Client:
    """One connection: frames of a length in 4 bytes and a text."""

    def __init__(self, path):
        self.socket = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
        self.socket.settimeout(30)
        self.socket.connect(path)
        self.stream = self.socket.makefile("rb")
        self.number = 0
        self.receive()

    def receive(self):
        length, = struct.unpack(">I", self.stream.read(4))
        return self.stream.read(length)

    def call(self, service, **args):
        self.number += 1
        text = json.dumps({"id": self.number, "service": service, "args": args}).encode()
        self.socket.sendall(struct.pack(">I", len(text)) + text)
        reply = json.loads(self.receive())
        if not reply["ok"]:
            sys.exit(f"{service}: {reply}")
        return reply["reply"]


def watch(path, until, done):
    client = Client(path)
    client.call("watch.begin", devices=DEVICES, interval_ms=INTERVAL_MS)
    updates = 0
    while time.monotonic() < until:
        client.receive()
        updates += 1
    done.append(updates)


def ask(path, until, done):
    client = Client(path)
    answers = 0
    while time.monotonic() < until:
        client.call("status")
        answers += 1
    done.append(answers)


def processor_seconds(pid):
    with open(f"/proc/{pid}/stat", encoding="ascii") as file:
        fields = file.read().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def configuration(folder):
    with open(os.path.join(root, "etc/machine.toml"), encoding="utf-8") as file:
        text = file.read()
    values = {"programs": f'"{folder}/programs"', "socket": f'"{folder}/control.sock"', "changes": f'"{folder}/changes"', "history": f'"{folder}/history"',
              "policy": f'"{policy}"', "lock_memory": "true" if policy == "fifo" else "false"}
    for key, value in values.items():
        text = re.sub(rf"^{key} = (\"[^\"]*\"|\w+)", f"{key} = {value}", text, flags=re.M)
    text = text.replace("[services]\n", "[services]\ncheck = \"off\"\n", 1) if not re.search(r"^check = ", text, re.M) else re.sub(r'^check = "\w+"', 'check = "off"', text, flags=re.M)
    with open(os.path.join(folder, "machine.toml"), "w", encoding="utf-8") as file:
        file.write(text)
    with open(os.path.join(root, "etc/mill.il"), encoding="utf-8") as source, open(os.path.join(folder, "mill.il"), "w", encoding="utf-8") as file:
        file.write(source.read())
    os.mkdir(os.path.join(folder, "programs"))
    with open(os.path.join(folder, "programs/part.nc"), "w", encoding="ascii") as file:
        file.write(PROGRAM)


def microseconds(text, name, share):
    """A figure of one of the histograms of the summary."""
    line = next(line for line in text.splitlines() if line.strip().startswith(name))
    return float(re.search(rf"{share} +([\d.]+)", line).group(1))


def run(number, client, forced):
    """One run: median and 99 % of the scan in us, share of a core, and what the clients have received in a second."""
    with tempfile.TemporaryDirectory() as folder:
        configuration(folder)
        path = os.path.join(folder, "control.sock")
        server = subprocess.Popen([ncrtd, "--machine", os.path.join(folder, "machine.toml"), "serve", "--summary", "--share", f"cost-{os.getpid()}-{number}"],
                                  stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        try:
            operator = None
            while operator is None:
                if server.poll() is not None:
                    sys.exit(server.stdout.read())
                try:
                    operator = Client(path)
                except OSError:  # nobody listens there yet
                    time.sleep(0.02)
            operator.call("control.take")
            operator.call("mode", mode="auto")
            operator.call("select", name="part.nc")
            operator.call("start")
            for device in DEVICES if forced else []:
                operator.call("force", device=device, value=1)
            begin, until, done = processor_seconds(server.pid), time.monotonic() + seconds, []
            threads = [threading.Thread(target=client, args=(path, until, done)) for _ in range(CLIENTS if client else 0)]
            for thread in threads:
                thread.start()
            for thread in threads:
                thread.join()
            time.sleep(max(0.0, until - time.monotonic()))
            used = processor_seconds(server.pid) - begin
            server.send_signal(signal.SIGTERM)
            text = server.communicate(timeout=60)[0]
        finally:
            if server.poll() is None:
                server.kill()
    if client and len(done) != CLIENTS:
        sys.exit(f"{CLIENTS - len(done)} clients have failed")
    return [microseconds(text, "execution time", "p50"), microseconds(text, "execution time", "p99"), 100 * used / seconds, sum(done) / seconds]


def main():
    if not os.path.exists(ncrtd):
        print(f"skipped: {ncrtd} is not there: build it first")
        return 77
    print(f"load of the computer at the beginning: {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores; the scan has the policy {policy}")
    kinds = {"ten watch lists at 50 Hz": (watch, False), "ten watch lists at 50 Hz with 16 forced devices": (watch, True), "ten clients that ask for the status": (ask, False)}
    alone, added = [], {name: [] for name in kinds}
    for number in range(pairs):
        for turn, (name, (client, forced)) in enumerate(kinds.items()):
            without, clients = run(6 * number + 2 * turn, None, forced), run(6 * number + 2 * turn + 1, client, forced)
            if not forced:
                alone.append(without)
            added[name].append([b - a for a, b in zip(without, clients)])
    median = [statistics.median(column) for column in zip(*alone)]
    print(f"without clients: scan {median[0]:.2f} us, 99 % {median[1]:.2f} us; {median[2]:.1f} % of a core")
    for name, rows in added.items():
        value = [statistics.median(column) for column in zip(*rows)]
        print(f"{name} add: scan {value[0]:+.2f} us, 99 % {value[1]:+.2f} us; {value[2]:+.1f} % of a core; {value[3]:.0f} messages in a second reach them")
    return 0


if __name__ == "__main__":
    sys.exit(main())
