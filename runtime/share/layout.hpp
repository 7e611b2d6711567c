// SPDX-License-Identifier: Apache-2.0
// The shared-memory segment between ncrtd and its readers (the DDS gateway): plain data with a fixed layout.
//
//   header | machine | point table        fixed after creation, with a check sum
//   status | history | points | signals   each under a sequence lock of its own, written by ncrtd
//   commands | acknowledgements           rings with one producer and one consumer
//
// There are no pointers in it, and every text has a terminating NUL inside its array. A change in the sizes and places of the structs
// changes layout_hash(), so that a reader of another build refuses the segment instead of misreading it.
// Units: mm, degrees, mm/min for feeds, mm/s for velocities, ns since 1970 (CLOCK_REALTIME) for times of day.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/points.hpp"
#include "nc/types.h"
#include "runtime/share/shared_block.hpp"
#include "runtime/share/shared_ring.hpp"

namespace nc::rt::share {

inline constexpr std::uint64_t kMagic = 0x3165'7261'6873'636e;  // "ncshare1" in memory
inline constexpr std::uint32_t kLayoutVersion = 8;
inline constexpr unsigned kHistory = 256;  // alarms and messages that are kept
inline constexpr unsigned kAlarms = 16;
inline constexpr unsigned kMaxSignals = 1536;  // signals between NC and ladder
inline constexpr unsigned kForced = 32;       // forced devices of the ladder
inline constexpr unsigned kCommandRing = 64;
inline constexpr unsigned kAckRing = 256;
inline constexpr std::size_t kMdiText = 1024;  // with its NUL; nc_mdi_load() takes no more

template <std::size_t kSize>
using Text = std::array<char, kSize>;

struct AxisStatus {
  double commanded, actual;  // machine coordinates
  double work;               // commanded position in the workpiece coordinates of the block in execution
  double distance_to_go;
  double velocity;  // mm/s or deg/s
};

struct SystemStatus {
  std::uint32_t run_state;   // nc_run_state
  std::uint32_t stop_cause;  // nc_stop_cause
  Text<64> state_text;       // the state in words, with the reason when nothing moves
  std::uint32_t axis_count;
  std::uint32_t rapid, manual_allowed, strobe;  // strobe: groups that wait for FIN; bit 0 M, 1 S, 2 T, 3 B
  std::uint32_t m, t, b;
  double s_commanded, spindle_rpm;  // spindle_rpm: measured, 0 when it is not
  std::uint32_t spindle_measured;
  std::uint32_t program_ready;  // a program is selected, at its head or running
  double feed_mm_min, feed_command_mm_min;
  double feed_override, rapid_override;                       // the overrides in force
  std::uint32_t feed_override_source, rapid_override_source;  // nc::rt::OverrideSource
  Text<192> modal;     // modal codes after the last finished block: "G01 G17 G90 ..."
  Text<128> program;   // file of the main program, "MDI", or "" when there is none
  Text<128> file;      // file of the block in execution
  Text<128> block;     // text of the block in execution, "" when it has not been found
  std::uint32_t program_number;  // O number of the program in which the block stands
  std::uint32_t line, sequence_number, depth;
  std::uint64_t serial;  // serial number of the item in execution
  std::uint64_t blocks;  // number of blocks finished since cycle start
  double path_length;    // mm since cycle start
  double run_s;          // seconds in execution since cycle start
  std::uint32_t refusals, refusal_cause;  // nc::rt::RefusalCause
  std::uint64_t runs;           // number of programs that came to their end without an alarm
  std::uint32_t main_line;      // line of the main program that is in execution or was finished last
  std::uint32_t program_lines;  // 0 = not known
  std::uint32_t percent;        // part of the main program that is done
  std::uint32_t last_run_ok;    // the last run ended without an alarm
  Text<128> refusal_text;  // why something asked for at the panel did not happen, "" = nothing, or it has happened since
  std::uint64_t message_count;
  Text<128> message;  // last message of this part system
  std::array<AxisStatus, NC_MAX_AXES> axis;
};

// An alarm or a message, in the list of active ones and in the history.
struct Entry {
  std::uint64_t sequence;     // number of this occurrence, from 1
  std::int64_t raised_ns;     // time of day
  std::int64_t cleared_ns;    // 0 = active (a message has no end: cleared_ns = raised_ns)
  std::uint32_t is_message;
  std::uint32_t system;       // index
  std::uint32_t line;         // line of the block that was in execution when it came, 0 = none
  std::uint32_t program_number;
  std::uint32_t is_warning;   // lets a program go on to its end
  std::uint32_t reserved;
  Text<16> code;
  Text<8> axis;  // "X", "" none
  Text<256> text;
};

struct ScanFigures {
  std::uint64_t scans, overruns, missed_slots;
  std::uint64_t execution_p50_ns, execution_p999_ns, execution_max_ns;
  std::uint64_t jitter_p50_ns, jitter_p999_ns, jitter_max_ns;
};

struct ForcedText {
  Text<64> device;
  std::int32_t value;
  std::uint32_t reserved;
};

struct StatusBlock {
  std::uint64_t scan;          // number of the scan that is shown
  std::int64_t scan_time_ns;   // time of day at its start (on virtual time: time of publication)
  std::int64_t published_ns;   // time of day
  std::uint32_t mode;          // nc::rt::Mode
  std::uint32_t system_count;
  std::uint32_t single_block, optional_stop;  // bit per part system
  std::uint32_t interface_input[NC_WORDS], interface_output[NC_WORDS];
  ScanFigures figures;
  std::uint32_t alarm_count, alarms_left_out;
  std::array<Entry, kAlarms> alarm;
  std::uint32_t forced_count, resetting;
  std::array<ForcedText, kForced> forced;
  std::array<SystemStatus, NC_MAX_SYSTEMS> system;  // the first system_count are used
};

// The entry with sequence n is in entry[(n - 1) % kHistory].
struct HistoryBlock {
  std::uint64_t last_sequence;  // 0 = empty
  std::array<Entry, kHistory> entry;
};

struct PointsBlock {
  std::uint64_t scan;
  std::uint32_t count;
  std::array<std::uint32_t, hal::kMaxPoints> value;
  std::array<std::uint8_t, hal::kMaxPoints> good;
};

struct PointRow {
  Text<56> name;
  std::uint32_t is_word, is_input, safe, reserved;
  Text<128> meaning;
};

// A signal between NC and ladder, from its row of the table in runtime/signals/.
struct SignalText {
  Text<56> name;
  std::uint32_t type;  // ladder::DeviceType
  std::uint32_t from_nc;
  std::int32_t safe;
  std::uint32_t reserved;
  Text<256> meaning;
  Text<128> timing;
};

struct SignalsBlock {
  std::uint64_t scan;
  std::uint32_t count, reserved;
  std::array<std::int32_t, kMaxSignals> value;
};

struct AxisRow {
  Text<8> name;
  std::uint32_t rotary;
  std::uint32_t soft_limited;
  double soft_min, soft_max, max_velocity;
};

// What does not change while ncrtd runs.
struct MachineBlock {
  Text<64> machine;  // name of the machine in the configuration
  Text<64> share;    // name of the segment without its prefix; the partition in DDS
  Text<32> version;  // of libnc
  std::uint32_t dialect, system_count, cycle_us, point_count, signal_count, reserved;
  double max_feed_override;
  std::array<std::uint32_t, NC_MAX_SYSTEMS> axis_count;
  std::array<std::array<AxisRow, NC_MAX_AXES>, NC_MAX_SYSTEMS> axis;
  std::array<PointRow, hal::kMaxPoints> point;
  std::array<SignalText, kMaxSignals> signal;
};

// ---- commands ----

enum class RequestKind : std::uint32_t {
  kTakeControl,  // the client becomes the only one whose commands are executed; also renews the lease
  kReleaseControl,
  kCycleStart,
  kFeedHold,
  kReset,
  kSetMode,        // number: nc::rt::Mode
  kFeedOverride,   // value 0..max_feed_override
  kRapidOverride,  // value 0..1
  kSingleBlock,    // number 0, 1
  kOptionalStop,   // number 0, 1
  kJog,            // system, axis, value: velocity in mm/s with its sign; to be repeated, 0 stops
  kMdi,            // system, text: blocks
  kSelectProgram,  // system, text: file name in the folder of programs
  kForce,          // text: device of the ladder, value: value at which it is held
  kReleaseForce,   // text: device, "" = all of them
  kWriteDevice,    // text: device, value: value that it gets once
  kRestartFind,    // system, axis: RestartBy, value: number, number: passing, text: name of a program, "" = the selected one
  kRestartConfirm, // system, number: entry of the recovery list from 0, kEveryEntry = all of them
  kRestartApproach,  // system, axis, value: velocity in mm/s, 0 = the jog feed; to be repeated as a jog
  kRestartCancel,  // system
  // from the gateway itself, without acknowledgement
  kClientGone,    // writer: this participant is dead or has left
  kGatewayBegan,  // a new gateway has started: every client of the previous one is gone
  kCount
};

inline constexpr std::int32_t kAny = -1;
inline constexpr std::uint32_t kEverySystem = ~0u;  // all part systems, in place of an index

// On which way commands come in. Clients of different ways are different ones, even with the same name and writer.
enum class Way : std::uint32_t {
  kGateway = 0,  // through the segment
  kLocal = 1     // through the socket of the services (runtime/services/)
};

// One command. Everything in it comes from the network, so nothing is trusted before Intake has checked it.
struct Request {
  Text<32> client;  // printable ASCII
  std::uint64_t sequence;  // strictly increasing for one client, from 1
  std::uint64_t writer;    // participant that wrote it; set by the gateway
  std::int64_t issued_ns;  // time of day at the client
  std::uint32_t kind;      // RequestKind
  std::uint32_t lifespan_ms, lease_ms;
  std::int32_t expected_mode;       // nc::rt::Mode, or kAny
  std::int32_t expected_run_state;  // nc_run_state of `system`, or kAny
  std::uint32_t system, axis;       // indices; system may be kEverySystem
  std::uint32_t number;
  double value;
  Text<128> expected_program;  // file name without folder, "" = any
  Text<kMdiText> text;
};

enum class AckState : std::uint32_t { kAccepted, kDone, kRejected, kFailed, kCount };

enum class AckReason : std::uint32_t {
  kNone,
  kMalformed,      // a field is out of its range, is not a number or is not a text
  kUnknownKind,
  kLate,           // older than its lifespan
  kOutOfOrder,     // sequence number not above the last one of this client
  kNoControl,      // another client has control, or nobody has: take it first
  kExpectedState,  // mode, run state or program is not what the client expected
  kOverflow,       // too many commands at once
  kTooManyClients,
  kRefused,        // by the runtime; the text says why
  kNotReached,     // accepted, but the state was not reached in time
  kClientInUse,    // this client id belongs to another participant
  kCount
};

struct Ack {
  Text<32> client;
  std::uint64_t sequence;
  std::uint64_t writer;
  std::uint32_t kind;    // RequestKind of the command
  std::uint32_t state;   // AckState
  std::uint32_t reason;  // AckReason
  std::uint32_t repeated;  // 1 = answer to a duplicate: nothing was executed
  std::int64_t time_ns;
  std::uint32_t refusal;  // nc::rt::RefusalCause: with kRefused the cause for which the runtime refuses
  std::uint32_t way;      // nc::rt::share::Way of the command
  Text<128> text;
};

// ---- the segment ----

// How long the points are published after one request for them.
inline constexpr std::int64_t kPointsWantedNs = 2'000'000'000;

// Fixed part of the header, covered by the check sum.
struct Identity {
  std::uint64_t magic;
  std::uint32_t layout_version, layout_hash;
  std::uint64_t size;       // of the segment
  std::int32_t owner_pid;
  std::uint32_t commands;   // 1: ncrtd takes commands
  std::uint64_t owner_start;  // start time of that process in clock ticks since boot, because the system uses a pid again
  std::int64_t created_ns;
};

enum class Life : std::uint32_t { kMaking = 0, kAlive = 1, kEnded = 2 };

struct Segment {
  Identity identity;
  std::uint64_t check;  // check sum of identity and machine
  std::atomic<std::uint32_t> life;         // Life
  std::atomic<std::uint32_t> wake_reader;  // futex word: counts publications and acknowledgements
  std::atomic<std::uint32_t> wake_intake;  // futex word: counts commands
  std::atomic<std::int32_t> command_pid;   // process that may write commands, 0 = none
  std::atomic<std::uint64_t> heartbeat;    // counted up by the publisher
  std::atomic<std::int64_t> points_until;  // CLOCK_MONOTONIC, ns: until then a reader wants the points
  std::atomic<std::uint64_t> reserved[7];
  MachineBlock machine;
  SharedBlock<StatusBlock> status;
  SharedBlock<HistoryBlock> history;
  SharedBlock<PointsBlock> points;
  SharedBlock<SignalsBlock> signals;  // published when the points are
  SharedRing<Request, kCommandRing> commands;
  SharedRing<Ack, kAckRing> acks;
};

// A hash of the places and sizes of the parts of the segment.
constexpr std::uint32_t layout_hash() {
  const std::size_t figures[] = {sizeof(Segment), offsetof(Segment, machine), offsetof(Segment, status),
                                 offsetof(Segment, history), offsetof(Segment, points), offsetof(Segment, signals), sizeof(SignalText), offsetof(Segment, commands),
                                 offsetof(Segment, acks), sizeof(SystemStatus), sizeof(AxisStatus), sizeof(Entry),
                                 sizeof(ScanFigures), sizeof(PointRow), sizeof(AxisRow), sizeof(Request), sizeof(Ack),
                                 static_cast<std::size_t>(RequestKind::kCount), static_cast<std::size_t>(AckReason::kCount),
                                 kLayoutVersion};
  std::uint32_t hash = 2166136261u;  // FNV-1a
  for (const std::size_t figure : figures)
    for (unsigned byte = 0; byte < 4; ++byte) hash = (hash ^ (figure >> 8 * byte & 0xff)) * 16777619u;
  return hash;
}

}  // namespace nc::rt::share
