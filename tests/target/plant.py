# SPDX-License-Identifier: Apache-2.0
"""CiA 402 drives on python canopen with their axes behind them, on a CAN interface of the kernel, each a process of its own. The object dictionary and the
states are those of tests/canopen/peer_drives.py; here are the plant, the reaction to a control that is silent, and the faults that a test brings about.

usage: plant.py INTERFACE FOLDER

Each line of standard input is a node whose drive begins; "process PID" is the answer, and "ready NODE" follows when it hears the bus.
The place of the axis is kept in FOLDER/NODE, as a dial gauge that needs no bus sees it, and outlives this process as an absolute encoder does.
SIGUSR1: the drive trips. While FOLDER/sto exists the safe torque off input of the drive is open.
"""
import math
import os
import pathlib
import signal
import struct
import sys
import time

sys.path.insert(0, "/opt/peers")
import can  # noqa: E402
import canopen  # noqa: E402

from machine import LAG_S  # noqa: E402
from peer_drives import Drive  # noqa: E402

BRAKING = 400.0 * 131072 / 10  # increments/s^2: of quick stop, fault and brake
NO_SYNC_S = 1.0  # behind so long without a SYNC it goes by the clock: there is no control any more, and not only a computer that is busy
PLACE = struct.Struct("<dddB")  # increments, increments/s, time of CLOCK_MONOTONIC, state
PASSED, KEPT = struct.Struct("<dd"), 128  # behind it, of so many SYNCs: the kernel's time of the frame (wall clock), increments
STATES = ["disabled", "ready", "on", "enabled", "stop", "reaction", "fault"]
OVER_VOLTAGE, POWER_SECTION, NO_HEARTBEAT = 0x3210, 0x5400, 0x8130


class Plant(Drive):
    STATUS = dict(Drive.STATUS, reaction=0x020F)

    def __init__(self, network, number, folder):
        super().__init__(network, number)
        self.gauge = os.open(folder / str(number), os.O_RDWR | os.O_CREAT)
        kept = os.read(self.gauge, PLACE.size)
        self.place = PLACE.unpack(kept)[0] if len(kept) == PLACE.size else 0.0
        self.speed, self.target, self.period, self.sto_file = 0.0, self.place, 0.02, folder / "sto"
        self.synced = self.heard = time.monotonic()
        self.silence = 0.0  # s: 1016h
        self.said_silent = False
        self.syncs = 0
        self.note()

    def note(self):
        os.pwrite(self.gauge, PLACE.pack(self.place, self.speed, time.monotonic(), STATES.index(self.state)), 0)

    # ---- states ----

    def trip(self, emergency=OVER_VOLTAGE, register=0x05):
        if self.state in ("fault", "reaction"):
            return
        self.state = "reaction" if abs(self.speed) > 0 else "fault"
        self.node.emcy.send(emergency, register)

    def command(self, control):
        if self.state == "reaction" or (self.state == "fault" and self.sto_file.exists()):
            self.before = control
            return
        super().command(control)
        if self.state not in ("fault", "reaction"):
            self.said_silent = False

    def started(self):
        super().started()
        if self.running:
            words = [(item.index, item.length) for item in (*self.node.rpdo[1], *self.node.tpdo[1])]
            assert words == [(0x6040, 16), (0x607A, 32), (0x6041, 16), (0x6064, 32)], words
            mantissa, exponent = self.node.get_data(0x60C2, 1)[0], struct.unpack("b", self.node.get_data(0x60C2, 2))[0]
            self.period = mantissa * 10.0 ** exponent
            producer = int.from_bytes(self.node.get_data(0x1016, 1), "little")
            self.silence = (producer & 0xFFFF) / 1000.0
            self.heard = time.monotonic()

    def take(self, pdo):
        self.received = struct.unpack("<Hi", pdo.data)

    # ---- the axis ----

    def move(self, seconds):
        """Moves the axis on: behind its set-point in "operation enabled", else to rest with the braking that it has."""
        if self.state == "enabled":
            rest = (self.place - self.target) * math.exp(-seconds / LAG_S)
            self.speed = (self.target + rest - self.place) / seconds
            self.place = self.target + rest
            if abs(self.speed) < 1:
                self.speed = 0.0
            return
        least = min(abs(self.speed) / BRAKING, seconds)  # s in which it still moves
        self.place += math.copysign(abs(self.speed) * least - BRAKING * least * least / 2, self.speed)
        self.speed = math.copysign(max(0.0, abs(self.speed) - BRAKING * seconds), self.speed)
        if self.speed == 0.0 and self.state in ("stop", "reaction"):
            self.state = "disabled" if self.state == "stop" else "fault"

    def sync(self, at):
        self.synced = time.monotonic()
        self.move(self.period)
        os.pwrite(self.gauge, PASSED.pack(at, self.place), PLACE.size + PASSED.size * (self.syncs % KEPT))
        self.syncs += 1
        if not self.running:
            return self.note()
        if self.received is not None:
            control, target = self.received
            self.command(control)
            self.target = target if self.state == "enabled" else self.place
        pdo = self.node.tpdo[1]
        pdo.data[:] = struct.pack("<Hi", self.STATUS[self.state], round(self.place))
        pdo.transmit()
        self.note()

    def watch(self):
        """What the drive sees between the frames: that nobody gives a SYNC, or a heartbeat, any more, and its safe torque off input."""
        now = time.monotonic()
        if now - self.synced > NO_SYNC_S:
            self.move(now - self.synced)
            self.synced = now
            self.note()
        if self.sto_file.exists():
            self.trip(POWER_SECTION, 0x81)
        if self.running and self.silence > 0 and now - self.heard > self.silence and not self.said_silent:
            self.said_silent = True
            if int.from_bytes(self.node.get_data(0x6007, 0), "little") == 3 and self.state == "enabled":
                self.state = "stop"
            self.node.emcy.send(NO_HEARTBEAT, 0x11)  # last: on a bus that is down it is an error


def say(line):
    """In one piece, since all the drives say theirs into one pipe."""
    os.write(sys.stdout.fileno(), line.encode())


def be_drive(interface, number, folder):
    filters = [{"can_id": each, "can_mask": 0x7FF} for each in (0, 0x80, 0x200 + number, 0x600 + number, 0x77F)]
    network = canopen.Network(can.Bus(interface="socketcan", channel=interface, can_filters=filters))
    drive = Plant(network, number, folder)
    tripped = []
    signal.signal(signal.SIGUSR1, lambda _signal, _frame: tripped.append(True))

    def on_nmt(_id, data, _time):
        if data[1] in (0, number):
            drive.started()

    def on_heartbeat(_id, _data, _time):
        drive.heard = time.monotonic()

    network.subscribe(0x80, lambda _id, _data, at: drive.sync(at))
    network.subscribe(0, on_nmt)
    network.subscribe(0x77F, on_heartbeat)
    say(f"ready {number}\n")
    last = 0.0
    while True:
        try:
            frame = network.bus.recv(timeout=0.05)
        except can.CanError:  # the interface is down
            frame = None
            time.sleep(0.05)
        try:
            if frame is not None and not frame.is_error_frame:
                network.notify(frame.arbitration_id, frame.data, frame.timestamp)
            if tripped:
                tripped.clear()
                drive.trip()
            if time.monotonic() - last > 0.05:
                last = time.monotonic()
                drive.watch()
        except can.CanError:  # what it sends is lost with the bus
            pass


def main():
    interface, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # who is killed is gone at once
    for line in sys.stdin:
        process = os.fork()
        if process == 0:
            return be_drive(interface, int(line), folder)
        say(f"process {process}\n")
    return None


if __name__ == "__main__":
    main()
