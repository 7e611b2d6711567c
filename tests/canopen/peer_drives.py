# SPDX-License-Identifier: Apache-2.0
"""Three CiA 402 drives on python canopen (an independent implementation of CANopen) behind an slcan adapter. Object dictionary, SDO, NMT, heartbeat, EMCY and
PDO mapping are the library's; the states of the drive, its touch probe and the plant are here.

usage: peer_drives.py TTY [fault NODE POSITION | wall NODE POSITION | module]     prints "node N position P" for each drive when standard input ends
fault: that drive trips behind POSITION. wall: its touch probe input is on from POSITION on, to the increment. module: a CiA 401 module under number 10, each of
whose inputs is wired to its output of the same number, digital and analog.
"""
import sys
import threading
import time

import canopen
from canopen.objectdictionary import ODArray, ODRecord, ODVariable, datatypes as types

U8, U16, U32, I8, I16, I32 = (types.UNSIGNED8, types.UNSIGNED16, types.UNSIGNED32, types.INTEGER8, types.INTEGER16, types.INTEGER32)


def variable(index, sub, kind, value, access="rw"):
    made = ODVariable(f"o{index:04X}_{sub}", index, sub)
    made.data_type, made.default, made.access_type, made.pdo_mappable = kind, value, access, True
    return made


def record(index, members):
    made = ODRecord(f"o{index:04X}", index)
    for sub, (kind, value) in members.items():
        made.add_member(variable(index, sub, kind, value))
    return made


def dictionary(node):
    od = canopen.ObjectDictionary()
    for index, kind, value, access in [
            (0x1000, U32, 0x00020192, "ro"), (0x1001, U8, 0, "ro"), (0x1006, U32, 0, "rw"), (0x1017, U16, 0, "rw"),
            (0x6007, U16, 1, "rw"), (0x6040, U16, 0, "rw"), (0x6041, U16, 0x40, "ro"), (0x605A, U16, 2, "rw"), (0x6060, I8, 0, "rw"),
            (0x6061, I8, 0, "ro"), (0x6064, I32, 0, "ro"), (0x607A, I32, 0, "rw"),
            (0x60B8, U16, 0, "rw"), (0x60B9, U16, 0, "ro"), (0x60BA, I32, 0, "ro")]:
        od.add_object(variable(index, 0, kind, value, access))
    od.add_object(record(0x1018, {0: (U8, 2), 1: (U32, 0x77), 2: (U32, 0x88)}))
    od.add_object(record(0x1016, {0: (U8, 1), 1: (U32, 0)}))
    od.add_object(record(0x60C2, {0: (U8, 2), 1: (U8, 0), 2: (I8, 0)}))
    for communication, mapping, base in ((0x1400, 0x1600, 0x200), (0x1800, 0x1A00, 0x180), (0x1801, 0x1A01, 0x280)):
        od.add_object(record(communication, {0: (U8, 2), 1: (U32, base + node), 2: (U8, 255)}))
        od.add_object(record(mapping, {0: (U8, 0), **{sub: (U32, 0) for sub in range(1, 9)}}))
    return od


class Drive:
    def __init__(self, network, number):
        self.node = canopen.LocalNode(number, dictionary(number))
        network.add_node(self.node)
        self.state, self.before, self.position, self.received, self.running = "disabled", 0, 0, None, False
        self.wall, self.probe, self.latched, self.stored = None, 0, 0, False
        self.node.add_write_callback(self.written)
        self.node.nmt.state = "PRE-OPERATIONAL"

    def written(self, index, subindex, od, data):
        if index == 0x6060:
            self.node.set_data(0x6061, 0, data)

    def started(self):
        self.running = self.node.nmt.state == "OPERATIONAL"
        if not self.running:
            return
        self.node.rpdo.read()
        self.node.tpdo.read()
        self.node.rpdo[1].add_callback(self.take)

    def take(self, pdo):
        self.received = (pdo[0].raw, pdo[1].raw, pdo[2].raw if len(pdo) > 2 else 0)

    STATUS = {"disabled": 0x0240, "ready": 0x0221, "on": 0x0223, "enabled": 0x1227, "stop": 0x0207, "fault": 0x0208}

    def command(self, control):
        if self.state == "fault":
            if control & 0x80 and not self.before & 0x80:
                self.state = "disabled"
        elif not control & 2:
            self.state = "disabled"
        elif not control & 4:
            self.state = "stop" if self.state == "enabled" else "disabled"
        elif control & 0xF == 0xF and self.state in ("on", "enabled"):
            self.state = "enabled"
        elif control & 7 == 7 and self.state in ("ready", "on", "enabled"):
            self.state = "on"
        elif control & 7 == 6:
            self.state = "ready"
        self.before = control

    def move(self, target):
        """The motor turns to its set-point, and on its way over the edge of the probe: CiA 402, 60B8h bit 0 (on) and bit 4 (rising edge)."""
        edge = self.wall is not None and self.position < self.wall <= target
        if edge and self.probe & 0x11 == 0x11 and not self.stored:
            self.stored, self.latched = True, self.wall
        self.position = target

    def sync(self):
        if not self.running:
            return
        if self.received is not None:
            control, target, self.probe = self.received
            self.stored = self.stored and self.probe & 1 != 0
            self.command(control)
            if self.state == "enabled" and self.node.get_data(0x6061, 0) == b"\x08":
                self.move(target)
        pdo = self.node.tpdo[1]
        pdo[0].raw, pdo[1].raw = self.STATUS[self.state], self.position
        pdo.transmit()
        if len(self.node.tpdo[2]):
            pdo = self.node.tpdo[2]
            pdo[0].raw, pdo[1].raw = 1 | 2 * self.stored, self.latched
            pdo.transmit()

    def trip(self):
        self.state = "fault"
        self.node.emcy.send(0x3210, 0x05)


def module_dictionary(node):
    od = canopen.ObjectDictionary()
    for index, kind, value, access in [(0x1000, U32, 0x000F0191, "ro"), (0x1001, U8, 0, "ro"), (0x1017, U16, 0, "rw"), (0x6423, U8, 0, "rw")]:
        od.add_object(variable(index, 0, kind, value, access))
    od.add_object(record(0x1016, {0: (U8, 1), 1: (U32, 0)}))
    for index, kind in ((0x6000, U8), (0x6200, U8), (0x6206, U8), (0x6207, U8), (0x6401, I16), (0x6411, I16)):
        od.add_object(record(index, {0: (U8, 2), 1: (kind, 0), 2: (kind, 0)}))
    for n in range(2):
        for communication, mapping, base in ((0x1400, 0x1600, 0x200), (0x1800, 0x1A00, 0x180)):
            od.add_object(record(communication + n, {0: (U8, 2), 1: (U32, base + 0x100 * n + node), 2: (U8, 255)}))
            od.add_object(record(mapping + n, {0: (U8, 0), **{sub: (U32, 0) for sub in range(1, 9)}}))
    return od


class Module:
    def __init__(self, network, number):
        self.node = canopen.LocalNode(number, module_dictionary(number))
        network.add_node(self.node)
        self.running, self.syncs = False, 0
        self.node.nmt.state = "PRE-OPERATIONAL"

    def started(self):
        self.running = self.node.nmt.state == "OPERATIONAL"
        if not self.running:
            return
        self.node.rpdo.read()
        self.node.tpdo.read()
        for pdo in self.node.rpdo.values():
            if len(pdo):
                pdo.add_callback(self.take)

    def take(self, pdo):
        for value in pdo:
            self.node.set_data(value.index, value.subindex, value.data)

    def sync(self):
        if not self.running:
            return
        self.syncs += 1
        for inputs, outputs in ((0x6000, 0x6200), (0x6401, 0x6411)):
            for sub in (1, 2):
                self.node.set_data(inputs, sub, self.node.get_data(outputs, sub))
        for pdo in self.node.tpdo.values():
            if len(pdo) and self.syncs % pdo.trans_type == 0:
                for value in pdo:
                    value.data = self.node.get_data(value.index, value.subindex)
                pdo.transmit()


def main():
    network = canopen.Network()
    network.connect(interface="slcan", channel=sys.argv[1])
    drives = [Drive(network, number) for number in (1, 2, 3)]
    what, place = (sys.argv[2], (int(sys.argv[3]), int(sys.argv[4]))) if len(sys.argv) > 3 else (sys.argv[-1], None)
    fault = place if what == "fault" else None
    if what == "wall":
        drives[place[0] - 1].wall = place[1]
    module = Module(network, 10) if what == "module" else None
    nodes = drives + [module] * (module is not None)
    lock, tripped = threading.Lock(), []

    heard = [time.monotonic()]

    def on_sync(_id, _data, _time):
        heard[0] = time.monotonic()
        with lock:
            for node in nodes:
                node.sync()
            if fault and not tripped and drives[fault[0] - 1].position > fault[1]:
                tripped.append(True)
                drives[fault[0] - 1].trip()

    def on_nmt(_id, data, _time):
        with lock:
            for node in nodes:
                if data[1] in (0, node.node.id):
                    node.started()

    network.subscribe(0x80, on_sync)
    network.subscribe(0, on_nmt)
    print("ready", flush=True)
    sys.stdin.read()
    while time.monotonic() - heard[0] < 1.0:  # what the control has sent at its end is taken first
        time.sleep(0.1)
    with lock:
        for drive in drives:
            print(f"node {drive.node.id} position {drive.position} state {drive.state} interpolation "
                  f"{int.from_bytes(drive.node.get_data(0x60C2, 1), 'little')}", flush=True)
        if module is not None:
            outputs = [int.from_bytes(module.node.get_data(index, sub), "little", signed=index > 0x6400) for index in (0x6200, 0x6411) for sub in (1, 2)]
            print("module", *outputs, flush=True)
    network.disconnect()


if __name__ == "__main__":
    main()
