# SPDX-License-Identifier: Apache-2.0
"""The types of nc_dds.idl for the Python binding of Cyclone DDS (PyPI `cyclonedds`), readers with the right QoS, a client for commands, and one for the services.

The generator of the binding does not work with Debian's IDL compiler, so the classes are written by hand. tests/dds/idl_test.py compares
them with the IDL, because with a difference reader and writer would not match. What lies between the marks of the services is made by scripts/service-tables.
"""
import base64
import hashlib
import json
import os
import time
from dataclasses import dataclass, field

# The configuration that ncdds uses unless CYCLONEDDS_URI is set: only this computer, no multicast. It must be set before the first import of
# cyclonedds. Programs that are started from here inherit the variable. ncdds and ncmon recognize this text, which must be identical to the one in
# dds/participant.cpp, and do not take it for a configuration of the user.
LOOPBACK = (
    '<CycloneDDS><Domain id="any"><General><Interfaces><NetworkInterface name="lo" multicast="false"/></Interfaces>'
    "<AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto</ParticipantIndex>"
    "<MaxAutoParticipantIndex>32</MaxAutoParticipantIndex>"
    '<Peers><Peer address="127.0.0.1"/></Peers></Discovery></Domain></CycloneDDS>'
)
os.environ.setdefault("CYCLONEDDS_URI", LOOPBACK)

from cyclonedds.core import Policy, Qos  # noqa: E402
from cyclonedds.domain import DomainParticipant  # noqa: E402
from cyclonedds.idl import IdlEnum, IdlStruct  # noqa: E402
from cyclonedds.idl import annotations as annotate  # noqa: E402
from cyclonedds.idl import types  # noqa: E402
from cyclonedds.pub import DataWriter, Publisher  # noqa: E402
from cyclonedds.sub import DataReader, Subscriber  # noqa: E402
from cyclonedds.topic import Topic  # noqa: E402
from cyclonedds.util import duration  # noqa: E402


@annotate.appendable
class Mode(IdlEnum, typename="nc.Mode", default="MODE_AUTO"):
    MODE_AUTO = 0
    MODE_MDI = 1
    MODE_MANUAL = 2


@annotate.appendable
class RunState(IdlEnum, typename="nc.RunState", default="RUN_IDLE"):
    RUN_IDLE = 0
    RUN_RUNNING = 1
    RUN_HOLD = 2
    RUN_STOPPED = 3
    RUN_ALARM = 4
    RUN_MANUAL = 5


@annotate.appendable
class StopCause(IdlEnum, typename="nc.StopCause", default="CAUSE_NONE"):
    CAUSE_NONE = 0
    CAUSE_FIN = 1
    CAUSE_DWELL = 2
    CAUSE_IN_POSITION = 3
    CAUSE_PROGRAM_STOP = 4
    CAUSE_SINGLE_BLOCK = 5
    CAUSE_FEED_HOLD = 6
    CAUSE_INTERLOCK = 7
    CAUSE_OVERRIDE_ZERO = 8
    CAUSE_STARVED = 9
    CAUSE_ALARM = 10
    CAUSE_OTHER = 11
    CAUSE_FEED_ZERO = 12
    CAUSE_SPINDLE_STOPPED = 13
    CAUSE_SPINDLE_ANGLE = 14
    CAUSE_SPINDLE_FAST = 15
    CAUSE_SERVO_OFF = 16
    CAUSE_TAP_SPINDLE = 17
    CAUSE_SPINDLE_UNMEASURED = 18
    CAUSE_NO_LAW = 19
    CAUSE_RESET = 20
    CAUSE_SPINDLE_REVERSED = 21
    CAUSE_TAP_IN_HOLE = 22
    CAUSE_MDI_ENDED = 23
    CAUSE_MANUAL_FEED_ZERO = 24
    CAUSE_RESTART = 25


@annotate.appendable
class RefusalCause(IdlEnum, typename="nc.RefusalCause", default="REFUSED_NOT"):
    REFUSED_NOT = 0
    REFUSED_MODE = 1
    REFUSED_RUNNING = 2
    REFUSED_MIDDLE_OF_BLOCK = 3
    REFUSED_NO_PROGRAM = 4
    REFUSED_ALARM = 5
    REFUSED_RESETTING = 6
    REFUSED_ENDING = 7
    REFUSED_SPINDLE = 8
    REFUSED_SOFT_LIMIT = 9
    REFUSED_NOT_REPEATED = 10
    REFUSED_NO_FEED = 11
    REFUSED_OTHER = 12
    REFUSED_FEED_HOLD = 13
    REFUSED_INTERLOCK = 14
    REFUSED_RESET_HELD = 15
    REFUSED_WARNING = 16
    REFUSED_MACHINE_SWITCH = 17
    REFUSED_RANGE = 18
    REFUSED_AXIS = 19
    REFUSED_CONTROL = 20
    REFUSED_NOT_LOADED = 21
    REFUSED_NO_DEVICE = 22
    REFUSED_TOO_MANY = 23
    REFUSED_NO_LADDER = 24
    REFUSED_NO_ANSWER = 25
    REFUSED_LET_GO = 26
    REFUSED_TOO_FAR = 27
    REFUSED_DRIVES = 28
    REFUSED_NOT_HOMED = 29
    REFUSED_HOMING = 30
    REFUSED_LIMIT_SWITCH = 31
    REFUSED_TAP_IN_HOLE = 32
    REFUSED_MACHINE_LOCK = 33
    REFUSED_RESTART = 34


@annotate.appendable
class OverrideSource(IdlEnum, typename="nc.OverrideSource", default="OVERRIDE_NOT_KNOWN"):
    OVERRIDE_NOT_KNOWN = 0
    OVERRIDE_OPERATOR = 1
    OVERRIDE_MACHINE = 2
    OVERRIDE_PROGRAM = 3


@annotate.appendable
class CommandKind(IdlEnum, typename="nc.CommandKind", default="CMD_TAKE_CONTROL"):
    CMD_TAKE_CONTROL = 0
    CMD_RELEASE_CONTROL = 1
    CMD_CYCLE_START = 2
    CMD_FEED_HOLD = 3
    CMD_RESET = 4
    CMD_SET_MODE = 5
    CMD_FEED_OVERRIDE = 6
    CMD_RAPID_OVERRIDE = 7
    CMD_SINGLE_BLOCK = 8
    CMD_OPTIONAL_STOP = 9
    CMD_JOG = 10
    CMD_MDI = 11
    CMD_SELECT_PROGRAM = 12
    CMD_FORCE = 13
    CMD_RELEASE_FORCE = 14
    CMD_WRITE_DEVICE = 15


@annotate.appendable
class AckState(IdlEnum, typename="nc.AckState", default="ACK_ACCEPTED"):
    ACK_ACCEPTED = 0
    ACK_DONE = 1
    ACK_REJECTED = 2
    ACK_FAILED = 3


@annotate.appendable
class AckReason(IdlEnum, typename="nc.AckReason", default="REASON_NONE"):
    REASON_NONE = 0
    REASON_MALFORMED = 1
    REASON_UNKNOWN_KIND = 2
    REASON_LATE = 3
    REASON_OUT_OF_ORDER = 4
    REASON_NO_CONTROL = 5
    REASON_EXPECTED_STATE = 6
    REASON_OVERFLOW = 7
    REASON_TOO_MANY_CLIENTS = 8
    REASON_REFUSED = 9
    REASON_NOT_REACHED = 10
    REASON_CLIENT_IN_USE = 11


@annotate.appendable
class SignalDirection(IdlEnum, typename="nc.SignalDirection", default="SIGNAL_FROM_NC"):
    SIGNAL_FROM_NC = 0
    SIGNAL_TO_NC = 1
    SIGNAL_FROM_MACHINE = 2
    SIGNAL_TO_MACHINE = 3


@annotate.appendable
class SignalType(IdlEnum, typename="nc.SignalType", default="SIGNAL_BIT"):
    SIGNAL_BIT = 0
    SIGNAL_WORD16 = 1
    SIGNAL_WORD32 = 2


@dataclass
@annotate.appendable
class AxisInfo(IdlStruct, typename="nc.AxisInfo"):
    part_system: types.uint32
    name: types.bounded_str[7]
    rotary: bool
    soft_limited: bool
    soft_min: types.float64
    soft_max: types.float64
    max_velocity: types.float64


@dataclass
@annotate.appendable
class MachineInfo(IdlStruct, typename="nc.MachineInfo"):
    machine: types.bounded_str[63]
    annotate.key("machine")
    name: types.bounded_str[63]
    version: types.bounded_str[31]
    dialect: types.bounded_str[15]
    part_systems: types.uint32
    cycle_us: types.uint32
    max_feed_override: types.float64
    commands: bool
    axes: types.sequence[AxisInfo, 32]


@dataclass
@annotate.appendable
class Axis(IdlStruct, typename="nc.Axis"):
    name: types.bounded_str[7]
    rotary: bool
    commanded: types.float64
    actual: types.float64
    work: types.float64
    distance_to_go: types.float64
    velocity: types.float64


@dataclass
@annotate.appendable
class ScanFigures(IdlStruct, typename="nc.ScanFigures"):
    scans: types.uint64
    overruns: types.uint64
    missed_slots: types.uint64
    execution_p50_us: types.float64
    execution_p999_us: types.float64
    execution_max_us: types.float64
    jitter_p50_us: types.float64
    jitter_p999_us: types.float64
    jitter_max_us: types.float64


@dataclass
@annotate.appendable
class ForcedDevice(IdlStruct, typename="nc.ForcedDevice"):
    device: types.bounded_str[63]
    value: types.int32


@dataclass
@annotate.appendable
class Status(IdlStruct, typename="nc.Status"):
    part_system: types.uint32
    annotate.key("part_system")
    machine: types.bounded_str[63]
    annotate.key("machine")
    scan: types.uint64
    time_ns: types.int64
    mode: Mode
    run_state: RunState
    stop_cause: StopCause
    state_text: types.bounded_str[63]
    resetting: bool
    single_block: bool
    optional_stop: bool
    program_ready: bool
    rapid: bool
    alarm: bool
    feed_override: types.float64
    rapid_override: types.float64
    program: types.bounded_str[127]
    file: types.bounded_str[127]
    program_number: types.uint32
    sequence_number: types.uint32
    line: types.uint32
    depth: types.uint32
    block: types.bounded_str[127]
    modal: types.bounded_str[191]
    main_line: types.uint32
    program_lines: types.uint32
    percent: types.uint32
    feed: types.float64
    feed_command: types.float64
    spindle: types.float64
    spindle_command: types.float64
    m: types.uint32
    t: types.uint32
    b: types.uint32
    strobe: types.uint32
    blocks: types.uint64
    path_length: types.float64
    run_s: types.float64
    runs: types.uint64
    last_run_ok: bool
    axes: types.sequence[Axis, 8]
    interface_input: types.sequence[types.uint32, 4]
    interface_output: types.sequence[types.uint32, 4]
    figures: ScanFigures
    message_count: types.uint64
    message: types.bounded_str[127]
    forced: types.sequence[ForcedDevice, 32]
    warning: bool
    refusals: types.uint32
    refusal_cause: RefusalCause
    refusal_text: types.bounded_str[127]
    feed_override_source: OverrideSource
    rapid_override_source: OverrideSource
    spindle_measured: bool


@dataclass
@annotate.appendable
class Alarm(IdlStruct, typename="nc.Alarm"):
    slot: types.uint32
    annotate.key("slot")
    id: types.uint64
    machine: types.bounded_str[63]
    annotate.key("machine")
    part_system: types.uint32
    code: types.bounded_str[15]
    text: types.bounded_str[255]
    axis: types.bounded_str[7]
    program_number: types.uint32
    line: types.uint32
    raised_ns: types.int64
    warning: bool


@dataclass
@annotate.appendable
class AlarmHistory(IdlStruct, typename="nc.AlarmHistory"):
    slot: types.uint32
    annotate.key("slot")
    id: types.uint64
    machine: types.bounded_str[63]
    annotate.key("machine")
    part_system: types.uint32
    message: bool
    code: types.bounded_str[15]
    text: types.bounded_str[255]
    axis: types.bounded_str[7]
    program_number: types.uint32
    line: types.uint32
    raised_ns: types.int64
    cleared_ns: types.int64
    warning: bool


@dataclass
@annotate.appendable
class SignalInfo(IdlStruct, typename="nc.SignalInfo"):
    name: types.bounded_str[55]
    direction: SignalDirection
    type: SignalType
    safe: types.int64
    meaning: types.bounded_str[255]
    timing: types.bounded_str[127]


@dataclass
@annotate.appendable
class SignalTable(IdlStruct, typename="nc.SignalTable"):
    machine: types.bounded_str[63]
    annotate.key("machine")
    signals: types.sequence[SignalInfo, 2560]


@dataclass
@annotate.appendable
class Signal(IdlStruct, typename="nc.Signal"):
    name: types.bounded_str[55]
    is_input: bool
    is_word: bool
    value: types.uint32
    good: bool


@dataclass
@annotate.appendable
class ControlSignal(IdlStruct, typename="nc.ControlSignal"):
    name: types.bounded_str[55]
    direction: SignalDirection
    type: SignalType
    value: types.int32


@dataclass
@annotate.appendable
class SignalImage(IdlStruct, typename="nc.SignalImage"):
    machine: types.bounded_str[63]
    annotate.key("machine")
    scan: types.uint64
    signals: types.sequence[Signal, 1024]
    control_scan: types.uint64
    control: types.sequence[ControlSignal, 1536]


@dataclass
@annotate.appendable
class Command(IdlStruct, typename="nc.Command"):
    client: types.bounded_str[31]
    annotate.key("client")
    seq: types.uint64
    kind: CommandKind
    lifespan_ms: types.uint32 = 1000
    lease_ms: types.uint32 = 0
    expected_mode: types.int32 = -1
    expected_run_state: types.int32 = -1
    expected_program: types.bounded_str[127] = ""
    part_system: types.uint32 = 1
    axis: types.bounded_str[7] = ""
    number: types.uint32 = 0
    value: types.float64 = 0.0
    text: types.bounded_str[1023] = ""


@dataclass
@annotate.appendable
class CommandAck(IdlStruct, typename="nc.CommandAck"):
    client: types.bounded_str[31]
    annotate.key("client")
    seq: types.uint64
    kind: CommandKind
    state: AckState
    reason: AckReason
    repeated: bool
    time_ns: types.int64
    text: types.bounded_str[127]
    refusal: RefusalCause


# services: begin, made by scripts/service-tables
@annotate.appendable
class ServiceStatus(IdlEnum, typename="nc.ServiceStatus", default="SERVICE_DONE"):
    SERVICE_DONE = 0
    SERVICE_REFUSED = 1
    SERVICE_UPDATE = 2


@dataclass
@annotate.appendable
class ServiceRequest(IdlStruct, typename="nc.ServiceRequest"):
    client: types.bounded_str[27]
    annotate.key("client")
    number: types.uint64
    service: types.bounded_str[31]
    args: types.bounded_str[524032]


@dataclass
@annotate.appendable
class ServiceReply(IdlStruct, typename="nc.ServiceReply"):
    client: types.bounded_str[27]
    annotate.key("client")
    number: types.uint64
    status: ServiceStatus
    refusal: types.bounded_str[31]
    session: types.uint64
    part: types.uint32
    last: bool
    body: types.bounded_str[60000]


# The topic of the requests for each service, by the right that it needs.
SERVICE_TOPICS = {
    "rights": "nc_ServiceView",
    "rights.limit": "nc_ServiceView",
    "services": "nc_ServiceView",
    "machine": "nc_ServiceView",
    "status": "nc_ServiceView",
    "alarms": "nc_ServiceView",
    "history.list": "nc_ServiceView",
    "history.counters": "nc_ServiceView",
    "history.programs": "nc_ServiceView",
    "changes": "nc_ServiceView",
    "tools.list": "nc_ServiceView",
    "life.list": "nc_ServiceView",
    "offsets.list": "nc_ServiceView",
    "variables.list": "nc_ServiceView",
    "parameters.list": "nc_ServiceView",
    "parameters.export": "nc_ServiceView",
    "tables.export": "nc_ServiceView",
    "programs.list": "nc_ServiceView",
    "programs.read": "nc_ServiceView",
    "programs.check": "nc_ServiceView",
    "trace.signals": "nc_ServiceView",
    "trace.status": "nc_ServiceView",
    "trace.read": "nc_ServiceView",
    "ladder.rungs": "nc_ServiceView",
    "ladder.devices": "nc_ServiceView",
    "watch.begin": "nc_ServiceView",
    "watch.end": "nc_ServiceView",
    "restart.status": "nc_ServiceView",
    "control.take": "nc_ServiceOperate",
    "control.release": "nc_ServiceOperate",
    "start": "nc_ServiceOperate",
    "hold": "nc_ServiceOperate",
    "reset": "nc_ServiceOperate",
    "mode": "nc_ServiceOperate",
    "override.feed": "nc_ServiceOperate",
    "override.rapid": "nc_ServiceOperate",
    "single": "nc_ServiceOperate",
    "optional": "nc_ServiceOperate",
    "jog": "nc_ServiceOperate",
    "mdi": "nc_ServiceOperate",
    "select": "nc_ServiceOperate",
    "programs.recheck": "nc_ServiceOperate",
    "restart.find": "nc_ServiceOperate",
    "restart.confirm": "nc_ServiceOperate",
    "restart.approach": "nc_ServiceOperate",
    "restart.cancel": "nc_ServiceOperate",
    "tools.set": "nc_ServiceSetUp",
    "life.set": "nc_ServiceSetUp",
    "offsets.set": "nc_ServiceSetUp",
    "variables.set": "nc_ServiceSetUp",
    "tables.import": "nc_ServiceSetUp",
    "undo": "nc_ServiceSetUp",
    "programs.begin": "nc_ServiceSetUp",
    "programs.data": "nc_ServiceSetUp",
    "programs.finish": "nc_ServiceSetUp",
    "programs.abandon": "nc_ServiceSetUp",
    "programs.rename": "nc_ServiceSetUp",
    "programs.delete": "nc_ServiceSetUp",
    "force": "nc_ServiceMaintain",
    "release": "nc_ServiceMaintain",
    "ladder.write": "nc_ServiceMaintain",
    "parameters.set": "nc_ServiceMaintain",
    "parameters.import": "nc_ServiceMaintain",
    "parameters.undo": "nc_ServiceMaintain",
    "programs.protect": "nc_ServiceMaintain",
    "trace.arm": "nc_ServiceMaintain",
    "trace.stop": "nc_ServiceMaintain",
    "ladder.swap": "nc_ServiceMaintain",
}
CHUNK_BYTES = 262144  # of a program, in one request or reply, at most
# services: end


@dataclass
@annotate.final
class Status_v1(IdlStruct, typename="nc.Status_v1"):
    part_system: types.uint32
    annotate.key("part_system")
    machine: types.bounded_str[63]
    annotate.key("machine")
    scan: types.uint64
    time_ns: types.int64
    mode: types.uint32
    run_state: types.uint32
    stop_cause: types.uint32
    program: types.bounded_str[127]
    program_number: types.uint32
    line: types.uint32
    percent: types.uint32
    feed_override: types.float64
    rapid_override: types.float64
    feed: types.float64
    spindle: types.float64
    tool: types.uint32
    axis_count: types.uint32
    axis_names: types.bounded_str[15]
    commanded: types.array[types.float64, 8]
    actual: types.array[types.float64, 8]
    work: types.array[types.float64, 8]
    distance_to_go: types.array[types.float64, 8]
    alarm_count: types.uint32


@dataclass
@annotate.final
class Alarm_v1(IdlStruct, typename="nc.Alarm_v1"):
    slot: types.uint32
    annotate.key("slot")
    id: types.uint64
    machine: types.bounded_str[63]
    annotate.key("machine")
    part_system: types.uint32
    code: types.bounded_str[15]
    text: types.bounded_str[255]
    axis: types.bounded_str[7]
    line: types.uint32
    raised_ns: types.int64


TOPICS = {
    MachineInfo: "nc_MachineInfo",
    Status: "nc_Status",
    Alarm: "nc_Alarm",
    AlarmHistory: "nc_AlarmHistory",
    SignalTable: "nc_SignalTable",
    SignalImage: "nc_SignalImage",
    Command: "nc_Command",
    CommandAck: "nc_CommandAck",
    Status_v1: "nc_Status_v1",
    Alarm_v1: "nc_Alarm_v1",
}
_DURABLE = (MachineInfo, Status, Alarm, AlarmHistory, SignalTable, Status_v1, Alarm_v1)


def reader(participant, kind, machine="*"):
    """A reader of one of the types above with the QoS of its topic, in the partition of a machine ("*" = all)."""
    policies = [Policy.Reliability.Reliable(duration(milliseconds=100))]
    policies.append(Policy.Durability.TransientLocal if kind in _DURABLE else Policy.Durability.Volatile)
    policies.append(Policy.History.KeepAll if kind is CommandAck else Policy.History.KeepLast(1))
    if kind is Status:
        policies.append(Policy.Liveliness.ManualByTopic(duration(seconds=1)))
    topic = Topic(participant, TOPICS[kind], kind)
    return DataReader(Subscriber(participant, qos=Qos(Policy.Partition([machine]))), topic, qos=Qos(*policies))


class Client:
    """Gives commands to one machine and counts their numbers. Each running client must have a different `name`."""

    def __init__(self, participant, machine, name, liveliness=None):
        policies = [
            Policy.Reliability.Reliable(duration(seconds=1)),
            Policy.Durability.Volatile,
            Policy.History.KeepAll,
            Policy.Lifespan(duration(seconds=1)),
        ]
        if liveliness is not None:
            policies.append(Policy.Liveliness.Automatic(duration(seconds=liveliness)))
        self.name = name
        self.seq = 0
        self.acks = reader(participant, CommandAck, machine)
        self._publisher = Publisher(participant, qos=Qos(Policy.Partition([machine])))
        self.writer = DataWriter(self._publisher, Topic(participant, TOPICS[Command], Command), qos=Qos(*policies))

    def send(self, kind, seq=None, **fields):
        """Sends one command and returns its number."""
        if seq is None:
            self.seq += 1
            seq = self.seq
        self.writer.write(Command(client=self.name, seq=seq, kind=kind, **fields))
        return seq


class ServiceRefused(Exception):
    """A service was refused: `error` is the name of the refusal, such as "busy", and the text is for people."""

    def __init__(self, service, error, text):
        super().__init__(f"{service}: {error}: {text}")
        self.error = error
        self.text = text


class Services:
    """The services of one machine (docs/services.md) over DDS. Each running client must have a different `name`: letters, digits, '.', '-', '_', '@'.

    One thread uses it. `patience`: seconds for an answer. `updates` holds the updates of watch lists that have come; look() fetches more.
    """

    def __init__(self, participant, machine, name, patience=30.0):
        self.name = name
        self.patience = patience
        self.updates = []
        self.session = 0  # of the newest reply: with another one everything that this client had begun has ended
        self._participant = participant
        self._answers = {}
        self._parts = {}
        self._number = 0
        self._writers = {}
        self._publisher = Publisher(participant, qos=Qos(Policy.Partition([machine])))
        replies = Qos(Policy.Reliability.Reliable(duration(milliseconds=100)), Policy.Durability.Volatile, Policy.History.KeepAll)
        where = Subscriber(participant, qos=Qos(Policy.Partition([f"{machine}/{name}"])))
        self._reader = DataReader(where, Topic(participant, "nc_ServiceReply", ServiceReply), qos=replies)

    def _writer(self, topic):
        if topic not in self._writers:
            policies = [Policy.Reliability.Reliable(duration(seconds=5)), Policy.Durability.Volatile, Policy.History.KeepAll, Policy.Liveliness.Automatic(duration(seconds=2))]
            if topic != "nc_ServiceView":  # what is late is not to happen any more; nor is a gateway that comes later to have it
                policies.append(Policy.Lifespan(duration(seconds=5)))
            self._writers[topic] = DataWriter(self._publisher, Topic(self._participant, topic, ServiceRequest), qos=Qos(*policies))
        writer = self._writers[topic]
        end = time.monotonic() + self.patience
        while not writer.get_matched_subscriptions():
            if time.monotonic() > end:
                raise ServiceRefused(topic, "no connection", "no gateway takes requests")
            time.sleep(0.01)
        return writer

    def send(self, service, topic=None, args="", **arguments):
        """Sends a request and returns its number. `args`: the arguments as a text, in place of `arguments`."""
        writer = self._writer(topic or SERVICE_TOPICS.get(service, "nc_ServiceView"))
        self._number += 1
        writer.write(ServiceRequest(client=self.name, number=self._number, service=service, args=args or json.dumps(arguments)))
        return self._number

    def look(self):
        """Fetches the replies and updates that have come."""
        for sample in self._reader.take(N=64):
            if not sample.sample_info.valid_data or sample.client != self.name:
                continue
            self.session = sample.session
            # A gateway that takes over from another one begins a reply again that the other one has not written to its end, with a writer of its own.
            writer, parts = self._parts.get(sample.number, (0, []))
            if sample.part == 1 or writer != sample.sample_info.publication_handle:
                if sample.part != 1:
                    continue  # the rest of what has begun again
                parts = []
                self._parts[sample.number] = (sample.sample_info.publication_handle, parts)
            parts.append(sample.body)
            if not sample.last:
                continue
            whole = len(parts) == sample.part
            del self._parts[sample.number]
            body = json.loads("".join(parts)) if whole else {"text": "a part of the reply was lost"}
            if sample.status == ServiceStatus.SERVICE_UPDATE:
                if whole:
                    self.updates.append(body)
            else:
                self._answers[sample.number] = (sample.refusal if whole else "failed", body)

    def answer(self, number, service="request"):
        """Waits for the reply to a request."""
        end = time.monotonic() + self.patience
        while number not in self._answers:
            if time.monotonic() > end:
                raise ServiceRefused(service, "no connection", f"no answer within {self.patience:g} s")
            self.look()
            if number not in self._answers:
                time.sleep(0.002)
        refusal, body = self._answers.pop(number)
        if refusal:
            raise ServiceRefused(service, refusal, body.get("text", ""))
        return body

    def call(self, service, **arguments):
        """Uses a service and returns its reply: call("tools.set", number=3, length=81.25)."""
        return self.answer(self.send(service, **arguments), service)

    def pages(self, service, member, **arguments):
        """The elements of a list that has several pages: pages("programs.list", "programs")."""
        start = 0
        while True:
            reply = self.call(service, **{**arguments, "from": start})
            yield from reply[member]
            start = reply["next"]
            if start == 0:
                return

    def watch_update(self, watch):
        """Waits for the next update of a watch list, which watch.begin has begun: {"watch", "scan", "values", "left_out"}."""
        end = time.monotonic() + self.patience
        while True:
            for i, update in enumerate(self.updates):
                if update["watch"] == watch:
                    return self.updates.pop(i)
            if time.monotonic() > end:
                raise ServiceRefused("watch", "no connection", f"no update within {self.patience:g} s")
            time.sleep(0.002)
            self.look()

    def upload(self, name, data, replace=False):
        """Writes a program; `data`: its bytes."""
        begun = self.call("programs.begin", name=name, size=len(data), sha256=hashlib.sha256(data).hexdigest(), replace=replace)
        for at in range(0, len(data), CHUNK_BYTES):
            piece = base64.b64encode(data[at : at + CHUNK_BYTES]).decode("ascii")
            self.call("programs.data", upload=begun["upload"], begin=at, data=piece)
        return self.call("programs.finish", upload=begun["upload"])

    def download(self, name):
        """The bytes of a program."""
        data, changed = b"", None
        while True:
            reply = self.call("programs.read", name=name, begin=len(data), bytes=CHUNK_BYTES)
            if changed not in (None, reply["modified_ns"]):
                raise ServiceRefused("programs.read", "failed", f"{name} was changed meanwhile")
            changed = reply["modified_ns"]
            data += base64.b64decode(reply["data"])
            if len(data) >= reply["size"]:
                return data
