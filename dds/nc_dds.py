# SPDX-License-Identifier: Apache-2.0
"""The types of nc_dds.idl for the Python binding of Cyclone DDS (PyPI `cyclonedds`), readers with the right QoS, and a client for commands.

The generator of the binding does not work with Debian's IDL compiler, so the classes are written by hand. tests/dds/idl_test.py compares
them with the IDL, because with a difference reader and writer would not match.
"""
import os
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
