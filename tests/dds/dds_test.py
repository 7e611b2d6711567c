#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""ncrtd, ncdds, ncmon and a subscriber of another make (PyPI cyclonedds) together.

The first half makes a virtual environment in build/ and starts the second half in it. Exit status 77 = skipped: no Python
packages can be had here, or the programs are not built.
"""
import inspect
import json
import mmap
import os
import random
import signal
import socket
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
from dds_environment import PATIENCE, build, check, machine_text, root, start, until  # noqa: E402

start(__file__, ("ncrtd", "ncdds", "ncmon"))

# ---- inside the environment ----

sys.path.insert(0, os.path.join(root, "dds"))
import nc_dds  # noqa: E402
from nc_dds import AckReason, AckState, CommandKind, Mode, RunState, SignalDirection, SignalType  # noqa: E402
from cyclonedds.core import InstanceState  # noqa: E402
from cyclonedds.domain import DomainParticipant  # noqa: E402
from cyclonedds.idl import IdlStruct, annotations as annotate, types  # noqa: E402
from cyclonedds.pub import DataWriter, Publisher  # noqa: E402
from cyclonedds.sub import DataReader, Subscriber  # noqa: E402
from cyclonedds.core import Policy, Qos  # noqa: E402
from cyclonedds.topic import Topic  # noqa: E402
from cyclonedds.util import duration  # noqa: E402
from dataclasses import dataclass  # noqa: E402

MORE = """
[[point]]
name = "clamp"
direction = "output"
[[point]]
name = "pallet"
type = "word"
direction = "input"
initial = 7
meaning = "number on the pallet"
[macro_interface]
"#1100" = "clamp"
"#1032" = "pallet"
[work_offsets]
G54 = { X = 0.0, Y = 0.0 }
[ladder]
program = "own.il"
"""
# Programs are not checked: bad.nc is to come to its alarm.
MACHINE = machine_text("Test", "XY", machine='variables = "kept"\n', services='check = "off"\n', more=MORE)
OTHER = machine_text("Test", "XY", services='check = "off"\n', more=MORE + '[[spindle]]\nfeedback = "none"\n')
LADDER = "LD nc.m_strobe\nOUT plc.fin2\nLD SM400\nDMOV pallet D0\nLD M100\nOUT plc.alarm.1\nEND\n"
PART = "G90 G54 G17\n#1=0\n#1100=1\nWHILE [#1 LT 5] DO1\nN20 G1 X20. Y10. F3000.\nG3 X20. Y30. J10.\nG1 X0. Y0.\n#1=#1+1\nEND1\nM30\n"
BAD = "G90 G54\nG1 X10. F1000 G150\nM30\n"


class Plant:
    """The processes under test."""

    def __init__(self, folder):
        self.folder = folder
        self.share = f"test-{os.getpid()}"
        self.domain = 1 + os.getpid() % 100  # below the ports that the system hands out
        self.all = []

    def start(self, *command):
        child = subprocess.Popen([os.path.join(build, "bin", command[0]), *command[1:]], stdout=subprocess.PIPE,
                                 stderr=subprocess.STDOUT, text=True)
        self.all.append(child)
        return child

    def control(self, *options):
        return self.start("ncrtd", "--config", os.path.join(self.folder, "machine.toml"), "serve", "--share", self.share, *options)

    def gateway(self, *options):
        return self.start("ncdds", "--share", self.share, "--domain", str(self.domain), *options)

    def monitor(self, *options):
        return subprocess.run([os.path.join(build, "bin/ncmon"), "--domain", str(self.domain), *options], capture_output=True, text=True)

    def end(self):
        """Ends the processes in order if possible: a control that is killed leaves its shared memory."""
        for child in self.all:
            if child.poll() is None:
                child.send_signal(signal.SIGCONT)
                child.terminate()
        for child in self.all:
            try:
                child.communicate(timeout=20)
            except subprocess.TimeoutExpired:
                child.kill()
                child.communicate()


class Watch:
    """The newest status, and every alarm that came or went."""

    def __init__(self, participant, machine):
        self.reader = nc_dds.reader(participant, nc_dds.Status, machine)
        self.alarms = nc_dds.reader(participant, nc_dds.Alarm, machine)
        self.history = nc_dds.reader(participant, nc_dds.AlarmHistory, machine)
        self.status, self.samples, self.gone, self.ended = None, 0, False, False
        self.active, self.past, self.x = {}, {}, set()

    def look(self):
        for sample in self.reader.take(N=20):
            if sample.sample_info.valid_data:
                self.status, self.samples = sample, self.samples + 1
                self.x.add(round(sample.axes[0].commanded, 3))
            self.gone = sample.sample_info.instance_state != InstanceState.Alive
            self.ended = sample.sample_info.instance_state == InstanceState.NotAliveDisposed
        for sample in self.alarms.take(N=20):
            if sample.sample_info.valid_data and sample.sample_info.instance_state == InstanceState.Alive:
                self.active[sample.slot] = sample
            elif sample.sample_info.valid_data:
                self.active.pop(sample.slot, None)
            else:
                self.active.clear()  # the writer is gone
        for sample in self.history.take(N=50):
            if sample.sample_info.valid_data:
                self.past[sample.id] = sample
        return self

    def fresh(self):
        """Waits for a status that comes after this call."""
        before = self.samples
        until(lambda: self.look().samples > before, "status comes")
        return self.status


class Operator(nc_dds.Client):
    def ask(self, kind, patience=PATIENCE, **fields):
        """Sends a command and waits for the answer; after `accepted` for the final one."""
        seq = self.send(kind, **fields)
        return self.answer(seq, patience)

    def answer(self, seq, patience=PATIENCE):
        end = time.monotonic() + patience
        while time.monotonic() < end:
            for ack in self.acks.take(N=20):
                if ack.sample_info.valid_data and ack.client == self.name and ack.seq == seq and ack.state != AckState.ACK_ACCEPTED:
                    return ack
            time.sleep(0.005)
        raise AssertionError(f"no answer to command {seq}")


def commands(plant, watch, operator):
    def refused(reason, kind, what, **fields):
        ack = operator.ask(kind, **fields)
        check(ack.state == AckState.ACK_REJECTED and ack.reason == reason, f"{what}: {ack.reason.name} ({ack.text})")

    refused(AckReason.REASON_NO_CONTROL, CommandKind.CMD_CYCLE_START, "start without control")
    check(operator.ask(CommandKind.CMD_TAKE_CONTROL, lease_ms=60000).state == AckState.ACK_DONE, "takes control")
    refused(AckReason.REASON_REFUSED, CommandKind.CMD_CYCLE_START, "start without a program")
    check(operator.ask(CommandKind.CMD_CYCLE_START).refusal == nc_dds.RefusalCause.REFUSED_NO_PROGRAM, "and for which reason of the control")
    refused(AckReason.REASON_REFUSED, CommandKind.CMD_SELECT_PROGRAM, "program that is not there", text="none.nc")
    ack = operator.ask(CommandKind.CMD_SELECT_PROGRAM, text="none.nc")
    check(ack.text == "none.nc: No such file or directory", f"and why: {ack.text}")
    ack = operator.ask(CommandKind.CMD_SELECT_PROGRAM, text="folder")
    check(ack.text == "folder: is a folder, not a program", f"a folder: {ack.text}")
    with open(os.path.join(plant.folder, "held.nc"), "w", encoding="ascii"):  # somebody writes it
        ack = operator.ask(CommandKind.CMD_SELECT_PROGRAM, text="held.nc")
    check(ack.state == AckState.ACK_REJECTED and "held.nc: is being written" in ack.text, f"a file that is being written: {ack.text}")
    refused(AckReason.REASON_MALFORMED, CommandKind.CMD_MDI, "a text with a NUL in its middle", text="G0 X5.\0G0 Y5.")
    refused(AckReason.REASON_MALFORMED, CommandKind.CMD_SELECT_PROGRAM, "a name with a NUL in its middle", text="part.nc\0x")
    refused(AckReason.REASON_MALFORMED, CommandKind.CMD_JOG, "an axis with a NUL in its middle", axis="X\0Y", value=1.0)
    refused(AckReason.REASON_MALFORMED, CommandKind.CMD_SELECT_PROGRAM, "way out of the folder", text="../part.nc")
    refused(AckReason.REASON_MALFORMED, CommandKind.CMD_FEED_OVERRIDE, "override out of range", value=7.0)
    refused(AckReason.REASON_MALFORMED, CommandKind.CMD_FEED_OVERRIDE, "not a number", value=float("nan"))
    refused(AckReason.REASON_MALFORMED, CommandKind.CMD_JOG, "axis that is not there", axis="Q", value=1.0)
    refused(AckReason.REASON_MALFORMED, CommandKind.CMD_RESET, "part system that is not there", part_system=3)
    refused(AckReason.REASON_MALFORMED, CommandKind.CMD_SET_MODE, "mode that is not there", number=9)
    check(operator.ask(CommandKind.CMD_FEED_OVERRIDE, value=0.5).state == AckState.ACK_DONE, "feed override 50 %")
    until(lambda: watch.look().status.feed_override == 0.5, "the status shows it")
    check(watch.status.feed_override_source == nc_dds.OverrideSource.OVERRIDE_OPERATOR and watch.status.spindle_measured, "as the operator's")
    operator.ask(CommandKind.CMD_FEED_OVERRIDE, value=1.0)
    check(operator.ask(CommandKind.CMD_SELECT_PROGRAM, text="part.nc").state == AckState.ACK_DONE, "selects a program")
    refused(AckReason.REASON_EXPECTED_STATE, CommandKind.CMD_CYCLE_START, "start of another program", expected_program="old.nc")
    refused(AckReason.REASON_EXPECTED_STATE, CommandKind.CMD_CYCLE_START, "start in another mode", expected_mode=Mode.MODE_MDI.value)
    operator.seq += 1
    old = nc_dds.Command(client=operator.name, seq=operator.seq, kind=CommandKind.CMD_CYCLE_START, lifespan_ms=100)
    operator.writer.write(old, timestamp=time.time_ns() - 500_000_000)
    ack = operator.answer(operator.seq)
    check(ack.reason == AckReason.REASON_LATE, f"late: {ack.text}")
    operator.seq += 10
    check(operator.ask(CommandKind.CMD_TAKE_CONTROL, lease_ms=60000).state == AckState.ACK_DONE, "numbers may be left out")
    operator.send(CommandKind.CMD_CYCLE_START, seq=operator.seq - 5)
    check(operator.answer(operator.seq - 5).reason == AckReason.REASON_OUT_OF_ORDER, "out of order")
    check(watch.fresh().run_state == RunState.RUN_IDLE and watch.status.runs == 0, "nothing of all this has moved anything")


def burst(operator):
    """A thousand commands are sent as fast as possible, and nobody reads the answers meanwhile: in the end each has its own answer."""
    check(operator.ask(CommandKind.CMD_TAKE_CONTROL, lease_ms=60000).state == AckState.ACK_DONE, "has control")
    seqs = {operator.send(CommandKind.CMD_FEED_OVERRIDE, value=1.0) for _ in range(1000)}
    time.sleep(1.0)
    answered = []
    end = time.monotonic() + PATIENCE
    while len(answered) < len(seqs) and time.monotonic() < end:
        answered += [ack for ack in operator.acks.take(N=100) if ack.sample_info.valid_data and ack.seq in seqs]
        time.sleep(0.01)
    check({ack.seq for ack in answered} == seqs and len(answered) == len(seqs), f"{len(answered)} answers to 1000 commands")
    done = sum(ack.state == AckState.ACK_DONE for ack in answered)
    check(all(ack.state == AckState.ACK_DONE or ack.reason == AckReason.REASON_OVERFLOW for ack in answered) and done > 0,
          f"{done} of them executed, the others refused because there were too many at once")


def holds_find_room(operator, control):
    """The control takes nothing for a moment, and the room for commands is full: a hold waits for room, and any other command is refused at once. The moment is shorter than a hold
    waits, so where the computer is slow it is tried again."""
    for _ in range(20):
        operator.acks.take(N=2000)
        control.send_signal(signal.SIGSTOP)
        try:
            refused, end = False, time.monotonic() + PATIENCE
            while not refused and time.monotonic() < end:
                for _ in range(50):
                    operator.send(CommandKind.CMD_FEED_OVERRIDE, value=1.0)
                refused = any(ack.sample_info.valid_data and ack.reason == AckReason.REASON_OVERFLOW for ack in operator.acks.take(N=500))
            check(refused, "the room for commands is full")
            operator.send(CommandKind.CMD_FEED_HOLD)
            hold = operator.seq
            time.sleep(0.02)
        finally:
            control.send_signal(signal.SIGCONT)
        if operator.answer(hold).state == AckState.ACK_DONE:
            return check(True, "a hold waits for room")
    raise AssertionError("no hold has waited for room")


def answers_not_taken(plant, operator):
    """A process that reads the answers to commands and stands still, and a client that is refused thousands of times: everybody else commands as before."""
    reader = subprocess.Popen([sys.executable, os.path.abspath(__file__), "reader", str(plant.domain), plant.share], stdout=subprocess.PIPE, text=True)
    plant.all.append(reader)
    check(reader.stdout.readline().strip() == "there", "another process reads the answers")
    reader.send_signal(signal.SIGSTOP)
    flood = nc_dds.Client(DomainParticipant(plant.domain), plant.share, f"flood-{os.getpid()}")
    for n in range(4000):
        flood.send(CommandKind.CMD_MDI, text="G0\0" + "X" * 200)  # raises where the gateway does not take it within a second
        if n % 100 == 0:
            flood.acks.take(N=500)
        if n % 1000 == 0:
            check(operator.ask(CommandKind.CMD_FEED_HOLD).state == AckState.ACK_DONE, f"a hold beside it, behind {n} refusals")
    check(operator.ask(CommandKind.CMD_TAKE_CONTROL, lease_ms=60000).state == AckState.ACK_DONE, "and control is taken")
    reader.kill()
    reader.wait()


def program(plant, watch, operator, gateway):
    """A program with the gateway killed in its middle. Returns the new gateway."""
    ack = operator.ask(CommandKind.CMD_CYCLE_START, expected_program="part.nc", expected_mode=Mode.MODE_AUTO.value,
                       expected_run_state=RunState.RUN_IDLE.value)
    check(ack.state == AckState.ACK_DONE, f"cycle start: {ack.state.name} {ack.text}")
    start = operator.seq
    watch.x.clear()
    until(lambda: len(watch.look().x) > 5 and watch.status.run_state == RunState.RUN_RUNNING, "positions move")
    status = watch.status
    with open(os.path.join(plant.folder, "part.nc"), encoding="ascii") as file:
        check(status.program == "part.nc" and status.block == file.read().split("\n")[status.line - 1], f"line {status.line}: {status.block!r}")
    check("G90" in status.modal.split(), f"modal: {status.modal}")
    operator.send(CommandKind.CMD_CYCLE_START, seq=start)
    again = operator.answer(start)
    check(again.repeated and again.state == AckState.ACK_DONE, "the duplicate gets the same answer")
    before = watch.fresh()
    gateway.send_signal(signal.SIGKILL)
    gateway.wait()
    until(lambda: watch.look().gone, "subscribers see that the gateway is gone")
    check(not watch.ended, "and that this is not the end of the control")
    gateway = plant.gateway("--commands")
    until(lambda: not watch.look().gone and watch.status.scan > before.scan, "it comes back, the scan has gone on")
    after = watch.status
    slots = after.scan + after.figures.missed_slots - before.scan - before.figures.missed_slots
    elapsed = (after.time_ns - before.time_ns) / 1e6  # cycles of 1 ms
    check(abs(slots - elapsed) < 300, f"without a gap: {slots} slots of 1 ms in {elapsed:.0f} ms")
    check(after.runs == 0, "the program is still in execution")
    until(lambda: watch.look().status.runs == 1, "the program ends")
    check(watch.status.last_run_ok and watch.status.percent == 100, "as it should")
    reference = subprocess.run([os.path.join(build, "bin/ncrtd"), "--config", os.path.join(plant.folder, "machine.toml"), "run", "--fast",
                                "--no-progress", os.path.join(plant.folder, "part.nc")], capture_output=True, text=True).stdout
    length = float(reference.split("path length")[1].split()[0])
    check(abs(watch.status.path_length - length) < 0.01, f"path length {watch.status.path_length:.3f} as without a gateway ({length})")
    check(watch.status.interface_output[0] & 1 == 1, "macro interface output #1100")
    return gateway


def release(kind, name, drop=0, add=(), **others):
    """The class as another release may have it: without its last members, or with further ones; `others` replaces nested types."""
    lines = inspect.getsource(kind).rstrip().split("\n")
    lines = lines[: len(lines) - drop] + ["    " + member for member in add]
    source = "\n".join(lines).replace(f"class {kind.__name__}(", f"class {name}(")
    space = {**vars(nc_dds), **others}
    exec(source, space)  # the members stand in nc_dds.py alone
    return space[name]


EXTRA = ("remedy: types.bounded_str[31]", "more: types.uint32")


def other_release(plant, kind, other, same):
    """A reader with the type of another release gets the samples of this one."""
    durable = kind in (nc_dds.Alarm, nc_dds.Status, nc_dds.SignalTable)
    qos = Qos(Policy.Reliability.Reliable(duration(milliseconds=100)), Policy.History.KeepLast(1),
              Policy.Durability.TransientLocal if durable else Policy.Durability.Volatile)
    participant = DomainParticipant(plant.domain)
    reader = DataReader(Subscriber(participant, qos=Qos(Policy.Partition([plant.share]))), Topic(participant, nc_dds.TOPICS[kind], other), qos=qos)
    got = until(lambda: [s for s in reader.take(N=5) if s.sample_info.valid_data], f"{other.__name__} talks to this release")[0]
    check((getattr(got, "remedy", ""), getattr(got, "more", 0)) == ("", 0), "what this release does not have is empty")
    check(same(got), "what both have is there")


def other_releases(plant, alarm):
    def same(got):
        return (got.id, got.code, got.text) == (alarm.id, alarm.code, alarm.text)

    other_release(plant, nc_dds.Alarm, release(nc_dds.Alarm, "OlderAlarm", drop=4), same)
    other_release(plant, nc_dds.Alarm, release(nc_dds.Alarm, "NewerAlarm", add=EXTRA), same)


def other_releases_of_status(plant):
    def same(got):
        return got.machine == plant.share and got.scan > 0 and "G90" in got.modal.split() and [a.name for a in got.axes] == ["X", "Y"]

    def same_signals(got):
        return {s.name: s.value for s in got.signals}["pallet"] == 7

    newer_axis = release(nc_dds.Axis, "NewerAxis", add=EXTRA)
    older_axis = release(nc_dds.Axis, "OlderAxis", drop=2)
    other_release(plant, nc_dds.Status, release(nc_dds.Status, "OlderStatus", drop=3), same)
    other_release(plant, nc_dds.Status, release(nc_dds.Status, "NewerStatus", add=EXTRA), same)
    other_release(plant, nc_dds.Status, release(nc_dds.Status, "StatusOfNewerAxes", Axis=newer_axis), same)
    other_release(plant, nc_dds.Status, release(nc_dds.Status, "StatusOfOlderAxes", Axis=older_axis), same)
    # Without the signals between NC and ladder, as it was before there were any.
    other_release(plant, nc_dds.SignalImage, release(nc_dds.SignalImage, "OlderSignalImage", drop=2), same_signals)
    other_release(plant, nc_dds.SignalImage, release(nc_dds.SignalImage, "NewerSignalImage", add=EXTRA), same_signals)


def other_clients(plant):
    """A client of another release gives commands and reads the answers."""
    reliable = Qos(Policy.Reliability.Reliable(duration(seconds=1)), Policy.History.KeepAll, Policy.Durability.Volatile)
    where = Qos(Policy.Partition([plant.share]))
    for age, command, ack in (("older", release(nc_dds.Command, "OlderCommand", drop=2), release(nc_dds.CommandAck, "OlderAck", drop=2)),
                              ("newer", release(nc_dds.Command, "NewerCommand", add=('remedy: types.bounded_str[31] = "none"', "more: types.uint32 = 7")), release(nc_dds.CommandAck, "NewerAck", add=EXTRA))):
        participant = DomainParticipant(plant.domain)
        writer = DataWriter(Publisher(participant, qos=where), Topic(participant, "nc_Command", command), qos=reliable)
        reader = DataReader(Subscriber(participant, qos=where), Topic(participant, "nc_CommandAck", ack), qos=reliable)
        name, seq, got = f"{age}-{os.getpid()}", [0], {}

        def ask(kind, program=""):
            seq[0] += 1
            writer.write(command(client=name, seq=seq[0], kind=kind, lease_ms=60000, expected_program=program))
            end = time.monotonic() + (PATIENCE if got else 0.5)  # before the first answer perhaps nobody has heard it
            while time.monotonic() < end and seq[0] not in got:
                got.update({a.seq: a for a in reader.take(N=20) if a.sample_info.valid_data and a.client == name and a.state != AckState.ACK_ACCEPTED})
                time.sleep(0.005)
            return got.get(seq[0])

        answer = until(lambda: ask(CommandKind.CMD_CYCLE_START), f"a client of an {age} release is answered")
        check(answer.kind == CommandKind.CMD_CYCLE_START and answer.state == AckState.ACK_REJECTED and answer.reason == AckReason.REASON_NO_CONTROL,
              f"and its command is understood: {answer.reason.name}")
        check(ask(CommandKind.CMD_TAKE_CONTROL).state == AckState.ACK_DONE, "it takes control")
        check(ask(CommandKind.CMD_CYCLE_START, "other.nc").reason == AckReason.REASON_EXPECTED_STATE, "what it expects counts")
        check(ask(CommandKind.CMD_RELEASE_CONTROL).state == AckState.ACK_DONE, "and gives it back")


def alarms(plant, watch, operator):
    operator.ask(CommandKind.CMD_TAKE_CONTROL, lease_ms=60000)
    check(operator.ask(CommandKind.CMD_SELECT_PROGRAM, text="bad.nc").state == AckState.ACK_DONE, "selects the bad program")
    operator.ask(CommandKind.CMD_CYCLE_START)
    until(lambda: watch.look().active, "an alarm comes")
    alarm = next(iter(watch.active.values()))
    until(lambda: watch.look().status.alarm and not watch.status.warning, "the status has it")
    check(alarm.code == "P34" and alarm.line == 2 and not alarm.warning, f"{alarm.code} {alarm.text} (line {alarm.line})")
    other_releases(plant, alarm)
    check(operator.ask(CommandKind.CMD_RESET).state == AckState.ACK_DONE, "reset")
    until(lambda: not watch.look().active, "the alarm is disposed")
    until(lambda: alarm.id in watch.look().past and watch.past[alarm.id].cleared_ns >= alarm.raised_ns, "the history has its end")


def warnings(plant, watch, operator):
    """What lets a program end is a warning and no alarm."""
    blocked = os.path.join(plant.folder, "kept.new")
    os.mkdir(blocked)  # beside the file of the common variables: it cannot be written any more
    check(operator.ask(CommandKind.CMD_SET_MODE, number=Mode.MODE_MDI.value).state == AckState.ACK_DONE, "mode MDI")
    check(operator.ask(CommandKind.CMD_MDI, text="#500=3").state == AckState.ACK_DONE, "a variable that is kept")
    operator.ask(CommandKind.CMD_CYCLE_START)
    until(lambda: watch.look().status.warning and watch.active, "a warning comes")
    warning = next(iter(watch.active.values()))
    check(warning.code == "R20" and warning.warning and not watch.status.alarm, f"and no alarm: {warning.code} {warning.text}")
    os.rmdir(blocked)
    check(operator.ask(CommandKind.CMD_RESET).state == AckState.ACK_DONE, "reset")
    until(lambda: not watch.look().active and not watch.status.warning, "it is gone")
    check(operator.ask(CommandKind.CMD_SET_MODE, number=Mode.MODE_AUTO.value).state == AckState.ACK_DONE, "mode auto")


def manual(watch, operator):
    check(operator.ask(CommandKind.CMD_SET_MODE, number=Mode.MODE_MDI.value).state == AckState.ACK_DONE, "mode MDI")
    check(operator.ask(CommandKind.CMD_MDI, text="G0 X5.").state == AckState.ACK_DONE, "MDI block")
    operator.ask(CommandKind.CMD_CYCLE_START)
    until(lambda: abs(watch.look().status.axes[0].commanded - 5) < 1e-6, "it has been executed")
    until(lambda: watch.look().status.run_state == RunState.RUN_IDLE, "idle")
    check(operator.ask(CommandKind.CMD_SET_MODE, number=Mode.MODE_MANUAL.value).state == AckState.ACK_DONE, "mode manual")
    for _ in range(5):
        operator.ask(CommandKind.CMD_JOG, axis="X", value=10.0)
    until(lambda: watch.look().status.axes[0].commanded > 5.01, "the axis jogs")
    until(lambda: watch.look().status.axes[0].velocity == 0, "and stops when nobody asks for it any more")
    until(lambda: watch.look().status.refusal_cause == nc_dds.RefusalCause.REFUSED_NOT_REPEATED, f"and says so: {watch.status.refusal_text}")
    check(operator.ask(CommandKind.CMD_SET_MODE, number=Mode.MODE_AUTO.value).state == AckState.ACK_DONE, "mode auto")


def dead_client(plant, operator):
    check(operator.ask(CommandKind.CMD_RELEASE_CONTROL).state == AckState.ACK_DONE, "gives control away")
    other = subprocess.Popen([sys.executable, os.path.abspath(__file__), "client", str(plant.domain), plant.share],
                             stdout=subprocess.PIPE, text=True)
    plant.all.append(other)
    check(other.stdout.readline().strip() == "ACK_DONE", "another process takes it for a minute")
    ack = operator.ask(CommandKind.CMD_TAKE_CONTROL)
    check(ack.reason == AckReason.REASON_NO_CONTROL, f"then this one does not get it: {ack.text}")
    other.kill()
    other.wait()
    until(lambda: operator.ask(CommandKind.CMD_TAKE_CONTROL).state == AckState.ACK_DONE, "it dies, and control is free long before the minute is over", 20)


@dataclass
class Odd(IdlStruct, typename="nc.Status"):
    part_system: types.uint8
    something: types.int8
    text: str


@dataclass
class OddBytes(IdlStruct, typename="nc.Command"):
    client: str
    annotate.key("client")
    seq: types.uint8
    junk: types.sequence[types.uint8]


def forces(plant, watch, operator, participant):
    """Devices of the ladder held at a value."""
    image = nc_dds.reader(participant, nc_dds.SignalImage, plant.share)

    def ask(kind, **fields):
        ack = operator.ask(kind, **fields)
        return ack.state, ack.reason, ack.text

    operator.ask(CommandKind.CMD_TAKE_CONTROL, lease_ms=60000)
    refused = (AckState.ACK_REJECTED, AckReason.REASON_REFUSED)
    malformed = (AckState.ACK_REJECTED, AckReason.REASON_MALFORMED)
    check(ask(CommandKind.CMD_FORCE, text="nowhere", value=1.0) == (*refused, "no such device 'nowhere'"), "force of no device")
    check(ask(CommandKind.CMD_FORCE, text="clamp", value=2.0)[:2] == refused, "a bit is not 2")
    check(ask(CommandKind.CMD_FORCE, text="pallet", value=1.5)[:2] == malformed, "nor a word one and a half")
    check(ask(CommandKind.CMD_FORCE, text="pallet", value=1e300)[:2] == malformed, "nor beyond 32 bits")
    check(ask(CommandKind.CMD_FORCE, text="", value=1.0)[:2] == malformed, "no name")
    check(watch.fresh().forced == [], "nothing is forced")
    check(ask(CommandKind.CMD_FORCE, text="pallet", value=99.0)[0] == AckState.ACK_DONE, "force of an input")
    check(ask(CommandKind.CMD_FORCE, text="clamp", value=1.0)[0] == AckState.ACK_DONE, "force of an output")
    until(lambda: [(f.device, f.value) for f in watch.look().status.forced] == [("pallet", 99), ("clamp", 1)], "the status shows them")
    until(lambda: any({s.name: s.value for s in i.signals}["clamp"] == 1 for i in taken(image)), "the machine gets it")
    shown = plant.monitor("--once", "--control", plant.share, "--wait", "20")
    check("FORCED   pallet = 99 clamp = 1" in shown.stdout, "ncmon shows them")
    check(ask(CommandKind.CMD_RELEASE_FORCE, text="pallet")[0] == AckState.ACK_DONE, "release of one")
    until(lambda: [f.device for f in watch.look().status.forced] == ["clamp"], "the other stays")
    check(ask(CommandKind.CMD_FORCE, text="plc.feed_override", value=3000.0)[0] == AckState.ACK_DONE, "a switch of the machine gives an override")
    until(lambda: (watch.look().status.feed_override, watch.status.feed_override_source) == (0.3, nc_dds.OverrideSource.OVERRIDE_MACHINE),
          "the status shows whose it is")
    check(watch.status.rapid_override_source == nc_dds.OverrideSource.OVERRIDE_OPERATOR, "the other one is the operator's as before")
    shown = plant.monitor("--once", "--control", plant.share, "--wait", "20")
    check("x 30 % (machine)   rapid 100 %   S 0 of" in shown.stdout, "ncmon shows it")
    check(ask(CommandKind.CMD_RELEASE_FORCE, text="")[0] == AckState.ACK_DONE, "release of all")
    until(lambda: watch.look().status.forced == [], "nothing is forced any more")
    check(ask(CommandKind.CMD_WRITE_DEVICE, text="pallet", value=1.0) == (*refused, "'pallet' gets its value from the machine or from the NC in each scan: force it"), "an input is not written")
    check(ask(CommandKind.CMD_WRITE_DEVICE, text="D700", value=12.0)[0] == AckState.ACK_DONE, "a register is written once")
    check(ask(CommandKind.CMD_FORCE, text="pallet", value=5.0)[0] == AckState.ACK_DONE, "a force that the end of the control ends")


def two_controls(plant, participant, operator):
    """Another control is in the same domain: a reader of all of them (partition "*") can tell them apart."""
    other = plant.share + "b"
    control = plant.start("ncrtd", "--config", os.path.join(plant.folder, "other.toml"), "serve", "--share", other, "--commands")
    gateway = plant.start("ncdds", "--share", other, "--domain", str(plant.domain), "--commands")
    all_alarms, all_status = nc_dds.reader(participant, nc_dds.Alarm, "*"), nc_dds.reader(participant, nc_dds.Status, "*")
    operators = {plant.share: operator, other: Operator(participant, other, f"two-{os.getpid()}")}
    active, ended = {}, set()

    def look():
        for sample in filter(lambda each: each.sample_info.valid_data, all_alarms.take(N=50)):
            if sample.sample_info.instance_state == InstanceState.Alive:
                active[sample.machine, sample.slot] = sample.text
            else:
                active.pop((sample.machine, sample.slot), None)
        for sample in all_status.take(N=50):
            if sample.sample_info.valid_data and sample.sample_info.instance_state == InstanceState.NotAliveDisposed:
                ended.add(sample.machine)
        return {machine for machine, _ in active}

    until(lambda: answers(operators[other]), "the second control answers")
    for machine, giver in operators.items():
        check(giver.ask(CommandKind.CMD_TAKE_CONTROL, lease_ms=60000).state == AckState.ACK_DONE, f"control of {machine}")
        check(giver.ask(CommandKind.CMD_FORCE, text="M100", value=1.0).state == AckState.ACK_DONE, "an alarm in its ladder")
    until(lambda: look() == set(operators), "the alarms of both are there, in the same slot")
    shown = json.loads(plant.monitor("--once", "--json", "--wait", "20").stdout)
    check([a["code"] for a in shown["alarms"]] == ["R16"] and len(shown["systems"]) == 1, "ncmon without a name shows one of them")
    shown = plant.monitor("--once", "--json", "--control", other, "--wait", "20")
    system = json.loads(shown.stdout)["systems"][0]
    check(not system["spindle_measured"] and system["spindle"] == 0 and system["feed_override_source"] == "operator", "its spindle is not measured")
    check("S not measured of" in plant.monitor("--once", "--control", other, "--wait", "20").stdout, "ncmon says so")
    for kind, fields in ((CommandKind.CMD_RELEASE_FORCE, {}), (CommandKind.CMD_RESET, {})):
        check(operators[other].ask(kind, **fields).state == AckState.ACK_DONE, kind.name)
    until(lambda: look() == {plant.share}, "one is cleared, the other one stays")
    control.send_signal(signal.SIGTERM)
    check(control.wait(timeout=60) == 0, "the second control ends")
    until(lambda: look() and ended == {other}, "and nobody takes it for the first one's end")
    gateway.terminate()
    gateway.wait()
    operator.ask(CommandKind.CMD_RELEASE_FORCE)
    check(operator.ask(CommandKind.CMD_RESET).state == AckState.ACK_DONE, "reset")


def two_gateways(plant, operator, gateway):
    """A second gateway of the same control keeps quiet about the commands, and takes over. Returns it."""
    second = plant.gateway("--commands")
    until(lambda: "no commands: process" in second.stdout.readline(), "the second gateway leaves the commands to the first")
    time.sleep(1.0)  # its reader of commands is found
    seqs = [operator.send(CommandKind.CMD_FEED_OVERRIDE, value=1.0) for _ in range(5)]
    states = []
    end = time.monotonic() + 2.0
    while time.monotonic() < end:
        states += [ack.state for ack in taken(operator.acks) if ack.seq in seqs]
        time.sleep(0.01)
    check(states == [AckState.ACK_DONE] * 5, "each command gets one answer")
    gateway.send_signal(signal.SIGKILL)
    gateway.wait()
    until(lambda: answers(operator), "the first one is killed: the second takes the commands")
    check(operator.ask(CommandKind.CMD_TAKE_CONTROL, lease_ms=60000).state == AckState.ACK_DONE, "control through it")
    return second


def stranger(plant, watch, operator, gateway):
    """A participant that has other types under our names, one of them known to have crashed publishers."""
    participant = DomainParticipant(plant.domain)
    publisher = Publisher(participant, qos=Qos(Policy.Partition([plant.share])))
    writers = [DataWriter(publisher, Topic(participant, name, Odd)) for name in ("nc_Status", "nc_Command", "nc_CommandAck", "nc_MachineInfo")]
    for _ in range(20):
        for writer in writers:
            writer.write(Odd(1, 2, "x" * 1000))
        time.sleep(0.02)
    check(gateway.poll() is None, "a participant with other types does not end the gateway")
    subscriber = Subscriber(participant, qos=Qos(Policy.Partition([plant.share])))
    readers = [DataReader(subscriber, Topic(participant, name, OddBytes)) for name in ("nc_Status", "nc_Alarm")]
    command = DataWriter(publisher, Topic(participant, "nc_Command", OddBytes))
    for _ in range(20):
        command.write(OddBytes("odd", 1, [2, 3]))
        time.sleep(0.1)
    check(gateway.poll() is None, "nor does one whose types have ended a gateway with type information")
    del readers, command
    noise, chance = socket.socket(socket.AF_INET, socket.SOCK_DGRAM), random.Random(1)
    for port in range(7410 + 250 * plant.domain, 7410 + 250 * plant.domain + 24):  # RTPS: participants 0 to 11
        for length in (0, 3, 20, 64, 300, 1400):
            noise.sendto(b"RTPS\x02\x01" + chance.randbytes(length), ("127.0.0.1", port))
            noise.sendto(chance.randbytes(length), ("127.0.0.1", port))
    noise.close()
    check(gateway.poll() is None, "nor does garbage on its ports")
    watch.fresh()
    check(operator.ask(CommandKind.CMD_TAKE_CONTROL).state == AckState.ACK_DONE, "commands go on")


def hang(watch, operator, control):
    """A control does not read its commands for a while: those that have waited too long are not executed, and too many are refused."""
    check(operator.ask(CommandKind.CMD_TAKE_CONTROL, lease_ms=60000).state == AckState.ACK_DONE, "has control")

    def stopped():
        with open(f"/proc/{control.pid}/stat", encoding="ascii") as file:
            return file.read().rsplit(")", 1)[1].split()[0] == "T"

    reasons = {}

    def answered(reason):
        for ack in operator.acks.take(N=100):
            if ack.sample_info.valid_data:
                reasons[ack.seq] = ack.reason
        return reason in reasons.values()

    control.send_signal(signal.SIGSTOP)
    until(stopped, "the control hangs")
    for _ in range(100):
        operator.send(CommandKind.CMD_SINGLE_BLOCK, number=1, lifespan_ms=100)
    until(lambda: answered(AckReason.REASON_OVERFLOW), "too many commands: REASON_OVERFLOW")
    time.sleep(0.5)
    control.send_signal(signal.SIGCONT)
    until(lambda: answered(AckReason.REASON_LATE), "the others are too late: REASON_LATE")
    check(operator.ask(CommandKind.CMD_TAKE_CONTROL, lease_ms=60000).state == AckState.ACK_DONE, "it is back")
    check(not watch.fresh().single_block, "none of them was executed")


def signals(plant, participant):
    reader = nc_dds.reader(participant, nc_dds.SignalImage, plant.share)
    image = []

    def complete():
        image.extend(s for s in reader.take(N=5) if s.sample_info.valid_data)
        return image

    until(complete, "the signal image comes when someone asks for it")
    values = {signal.name: signal for signal in image[-1].signals}
    check(values["pallet"].value == 7 and values["pallet"].is_word and values["pallet"].good, "with names and values")
    control = {signal.name: signal for signal in image[-1].control}
    check(control["nc.mode_auto"].value == 1 and control["plc.interlock_n"].value == 1 and control["plc.feed_override"].value == -1,
          "and the signals between NC and ladder")
    check(control["plc.fin1"].direction == SignalDirection.SIGNAL_TO_NC and control["nc.position.Y"].type == SignalType.SIGNAL_WORD32,
          "with direction and type")
    table = nc_dds.reader(participant, nc_dds.SignalTable, plant.share)
    rows = until(lambda: taken(table), "the table of signals comes to who asks late")[-1].signals
    rows = {row.name: row for row in rows}
    check(set(rows) == set(values) | set(control), "it has a row for each of them")
    check(rows["plc.feed_hold_n"].safe == 1 and "decelerate" in rows["plc.feed_hold_n"].meaning and rows["plc.feed_hold_n"].timing == "level",
          "safe value, meaning and timing among it")
    check(rows["pallet"].meaning == "number on the pallet" and rows["pallet"].safe == 7, "also of points")
    other_releases_of_status(plant)


def attack_on_memory(watch, control, gateway):
    """Another process of this user takes the shared memory away, or writes what it likes into it."""
    folder = f"/proc/{control.pid}/fd"
    places = [place for place in (os.path.join(folder, fd) for fd in os.listdir(folder)) if "memfd:nc-" in os.readlink(place)]
    check(len(places) == 1, "the control has its shared memory without a name in a file system")
    for length in (0, 4096, 1 << 30):
        try:
            os.truncate(places[0], length)
            raise AssertionError(f"the memory has become {length} bytes")
        except PermissionError:
            print("ok: nobody makes it", length, "bytes", flush=True)
    chance = random.Random(2)
    with open(places[0], "r+b") as file, mmap.mmap(file.fileno(), 0) as memory:
        before = memory[:]
        for _ in range(5):
            memory[:] = chance.randbytes(len(memory))
            time.sleep(0.05)
        memory[:] = before
    check(control.poll() is None and gateway.poll() is None, "garbage in it ends neither the control nor the gateway")
    watch.fresh()


def monitor(plant):
    shown = plant.monitor("--once", "--json", "--control", plant.share, "--wait", "20")
    check(shown.returncode == 0 and json.loads(shown.stdout)["systems"][0]["machine"] == plant.share, "ncmon --once --json")
    shown = plant.monitor("--once", "--json", "--view", "signals", "--control", plant.share, "--wait", "20")
    signals = json.loads(shown.stdout)["signals"]["values"] if shown.returncode == 0 else []
    signals = {signal["name"]: signal for signal in signals}
    check(signals["plc.interlock_n"]["value"] == 1 and signals["plc.interlock_n"]["direction"] == "to NC" and
          "decelerate" in signals["plc.interlock_n"]["meaning"] and signals["pallet"]["value"] == 7, "ncmon --view signals --json")
    shown = plant.monitor("--once", "--view", "signals", "--control", plant.share, "--wait", "20")
    check(shown.returncode == 0 and any(line.split()[:1] == ["nc.position.X"] for line in shown.stdout.split("\n")), "ncmon --view signals")
    stream = plant.start("ncmon", "--domain", str(plant.domain), "--control", plant.share, "--json", "--view", "signals")
    until(lambda: "signals" in json.loads(stream.stdout.readline()), "ncmon --json --view signals")
    stream.terminate()
    stream.communicate()
    nobody = plant.monitor("--once", "--control", "nobody", "--wait", "0.5")
    check(nobody.returncode == 2 and "nobody publishes" in nobody.stderr, "ncmon without a publisher")
    check("QoS" not in nobody.stderr and "warning" not in nobody.stderr, "another partition is no other QoS")


def restart(plant, watch, operator, info, control):
    """Another control under the same name, this one without commands."""
    second = plant.control()
    text = second.communicate(timeout=60)[0]
    check(second.returncode == 3 and f"process {control.pid} (ncrtd) runs this machine" in text, "a second control of the same machine is refused")
    second = plant.start("ncrtd", "--config", os.path.join(plant.folder, "other.toml"), "serve", "--share", plant.share)
    text = second.communicate(timeout=60)[0]
    check(second.returncode == 1 and "belongs to a control that is running" in text, "a second control of the same name is refused")
    check(taken(info)[-1].commands, "the machine's description says that commands are taken")
    control.send_signal(signal.SIGKILL)
    control.wait()
    until(lambda: watch.look().ended, "subscribers see that the control is gone")
    control = plant.control()
    until(lambda: not watch.look().gone and watch.status.runs == 0, "a new one takes over the name, and they see it")
    check(watch.fresh().forced == [], "nothing is forced in it")
    ack = operator.ask(CommandKind.CMD_TAKE_CONTROL)
    check(ack.state == AckState.ACK_REJECTED and ack.reason == AckReason.REASON_REFUSED and ack.refusal == nc_dds.RefusalCause.REFUSED_NO_ANSWER, f"without --commands: {ack.text}")
    until(lambda: any(not i.commands for i in taken(info)), "and the description says so")
    return control


def end(plant, watch, gateway, control):
    gateway.send_signal(signal.SIGTERM)
    check(gateway.wait(timeout=60) == 0, "the gateway ends in order")
    until(lambda: watch.look().gone, "subscribers see it")
    check(not watch.ended and control.poll() is None, "the control does not care")
    gateway = plant.gateway()
    progress = plant.start("ncmon", "--domain", str(plant.domain), "--control", plant.share, "--progress", "--wait", "30")
    check("idle" in progress.stdout.readline(), "ncmon --progress begins")
    control.send_signal(signal.SIGTERM)
    check(control.wait(timeout=60) == 0, "the control ends in order")
    text = progress.communicate(timeout=60)[0]
    check(progress.returncode == 0 and "the control has ended" in text, "ncmon says that it has ended")
    shown = plant.monitor("--once", "--control", plant.share, "--wait", "1")
    check(shown.returncode == 2 and "its control is not" in shown.stderr, f"also who comes later: {shown.stderr.strip()}")
    gateway.send_signal(signal.SIGTERM)
    check(gateway.wait(timeout=60) == 0, "the gateway ends in order without a control")


def client(domain, share):
    """A client that takes control and then hangs."""
    me = Operator(DomainParticipant(domain), share, f"other-{os.getpid()}", liveliness=1.0)
    time.sleep(1.0)
    while True:
        try:
            ack = me.ask(CommandKind.CMD_TAKE_CONTROL, patience=2.0, lease_ms=60000)
            break
        except AssertionError:
            continue
    print(ack.state.name, flush=True)
    time.sleep(120)


def reading(domain, share):
    """Somebody who reads the answers to commands; its process is given up an hour after it stands still."""
    os.environ["CYCLONEDDS_URI"] = os.environ["CYCLONEDDS_URI"].replace("<Discovery>", "<Discovery><LeaseDuration>3600 s</LeaseDuration>")
    participant = DomainParticipant(domain)
    acks = nc_dds.reader(participant, nc_dds.CommandAck, share)
    while not acks.get_matched_publications():
        time.sleep(0.02)
    print("there", flush=True)
    time.sleep(1000)


def main():
    if len(sys.argv) > 3 and sys.argv[1] == "reader":
        reading(int(sys.argv[2]), sys.argv[3])
        return
    if len(sys.argv) > 3 and sys.argv[1] == "client":
        client(int(sys.argv[2]), sys.argv[3])
        return
    with tempfile.TemporaryDirectory() as folder:
        os.mkdir(os.path.join(folder, "folder"))
        for name, text in (("machine.toml", MACHINE), ("other.toml", OTHER), ("part.nc", PART), ("bad.nc", BAD), ("own.il", LADDER)):
            with open(os.path.join(folder, name), "w", encoding="ascii") as file:
                file.write(text)
        plant = Plant(folder)
        try:
            gateway, control = plant.gateway("--commands"), plant.control("--commands")
            participant = DomainParticipant(plant.domain)
            watch = Watch(participant, plant.share)
            operator = Operator(participant, plant.share, f"test-{os.getpid()}")
            info = nc_dds.reader(participant, nc_dds.MachineInfo, plant.share)
            core = nc_dds.reader(participant, nc_dds.Status_v1, plant.share)
            until(lambda: watch.look().status, "the status comes")
            until(lambda: [s for s in core.take(N=5) if s.sample_info.valid_data and s.axis_names == "XY"], "the core status comes")
            until(lambda: answers(operator), "the gateway answers")
            other_clients(plant)
            commands(plant, watch, operator)
            burst(operator)
            holds_find_room(operator, control)
            answers_not_taken(plant, operator)
            gateway = program(plant, watch, operator, gateway)
            until(lambda: answers(operator), "the new gateway answers")
            alarms(plant, watch, operator)
            warnings(plant, watch, operator)
            manual(watch, operator)
            signals(plant, participant)
            monitor(plant)
            forces(plant, watch, operator, participant)
            attack_on_memory(watch, control, gateway)
            until(lambda: operator.ask(CommandKind.CMD_TAKE_CONTROL, lease_ms=60000).state == AckState.ACK_DONE, "commands come through as before")
            two_controls(plant, participant, operator)
            gateway = two_gateways(plant, operator, gateway)
            dead_client(plant, operator)
            stranger(plant, watch, operator, gateway)
            hang(watch, operator, control)
            control = restart(plant, watch, operator, info, control)
            end(plant, watch, gateway, control)
        finally:
            plant.end()


def taken(reader):
    return [sample for sample in reader.take(N=10) if sample.sample_info.valid_data]


def answers(operator):
    """Asked until the control answers: reader and writer find each other at different times, and a gateway that waits for its control refuses by itself."""
    try:
        ack = operator.ask(CommandKind.CMD_RELEASE_CONTROL, patience=0.5)
    except AssertionError:
        return None
    return ack if ack.refusal != nc_dds.RefusalCause.REFUSED_NO_ANSWER else None


main()
