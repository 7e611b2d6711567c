// SPDX-License-Identifier: Apache-2.0
// The gateway's conversions without a network: any bytes as the contents of the segment's blocks become a sample, and any bytes as a command from
// the network become a request. Texts end and are valid UTF-8, enumerators exist, sequences are as long as they say; a kind that only the
// gateway may use is not accepted from outside.
#include <memory>

#include "dds/convert.hpp"
#include "fuzz/input.hpp"
#include "runtime/programs/encoding.hpp"
#include "runtime/share/text.hpp"

namespace {

using namespace nc::dds;
using nc::fuzz::Bytes;
using nc::fuzz::require;

constexpr unsigned kSystems = 2, kAxes = 3, kPoints = 5, kSignals = 4;
constexpr const char* kPartition = "fuzz-mill";

template <std::size_t kSize>
void require_text(const char (&text)[kSize], int line = __builtin_LINE()) {
  const std::size_t length = strnlen(text, kSize);
  require(length < kSize && nc::rt::valid_utf8({text, length}) == std::string(text, length), __FILE__, line);
}

template <class Enum>
void require_enum(Enum value, Enum last, int line = __builtin_LINE()) {
  require(static_cast<std::uint32_t>(value) <= static_cast<std::uint32_t>(last), __FILE__, line);
}

/// Overwrites some bytes of `block`.
template <class T>
void damage(T* block, Bytes* in) {
  auto* bytes = reinterpret_cast<unsigned char*>(block);
  for (unsigned patches = in->byte() % 8; patches > 0 && !in->empty(); --patches) {
    const std::size_t at = in->value<std::uint32_t>() % sizeof(T);
    const unsigned repeat = 1 + in->byte() % 64;
    const std::string pattern = in->text(1 + in->byte() % 16);
    for (std::size_t i = 0; i < pattern.size() * repeat && at + i < sizeof(T); ++i)
      bytes[at + i] = static_cast<unsigned char>(pattern[i % pattern.size()]);
  }
}

/// A machine block whose counts are as the reader of the segment gives them (share_fuzz.cpp tests that); everything else is from the input.
std::unique_ptr<share::MachineBlock> machine_from(Bytes* in) {
  auto machine = std::make_unique<share::MachineBlock>();
  share::set_text(&machine->axis[0][0].name, "X");
  share::set_text(&machine->axis[0][1].name, "Y");
  damage(machine.get(), in);
  machine->system_count = kSystems;
  machine->axis_count = {kAxes, 2, 0, 0};
  machine->point_count = kPoints;
  machine->signal_count = kSignals;
  return machine;
}

void describe(const share::MachineBlock& machine) {
  auto sample = std::make_unique<MachineSample>();
  sample->fill(machine, kPartition, true);
  require_text(sample->info.machine);
  require_text(sample->info.name);
  require_text(sample->info.version);
  require(sample->info.axes._length == kAxes + 2 && sample->info.axes._length <= sample->info.axes._maximum);
  for (unsigned a = 0; a < sample->info.axes._length; ++a) require_text(sample->axes[a].name);
  auto table = std::make_unique<SignalTableSample>();
  table->fill(machine, kPartition);
  require(table->table.signals._length == kSignals + kPoints);
  for (unsigned i = 0; i < table->table.signals._length; ++i) {
    require_text(table->rows[i].name);
    require_text(table->rows[i].meaning);
    require_text(table->rows[i].timing);
    require_enum(table->rows[i].type, nc_SIGNAL_WORD32);
  }
}

void require_alarm(const share::Entry& entry, unsigned slot) {
  const nc_Alarm full = alarm(entry, slot, kPartition);
  require(full.slot == slot && full.id == entry.sequence);
  require_text(full.code);
  require_text(full.text);
  require_text(full.axis);
  const nc_Alarm_v1 core = core_alarm(entry, slot, kPartition);
  require_text(core.code);
  require_text(core.text);
  require_text(core.axis);
  const nc_AlarmHistory kept = history(entry, kPartition);
  require(kept.slot < share::kHistory);
  require_text(kept.code);
  require_text(kept.text);
  require_text(kept.axis);
}

void report(const share::MachineBlock& machine, Bytes* in) {
  auto block = std::make_unique<share::StatusBlock>();
  damage(block.get(), in);
  block->system_count = kSystems;
  block->alarm_count %= share::kAlarms + 1;
  block->forced_count %= share::kForced + 1;
  for (auto& system : block->system) system.axis_count %= NC_MAX_AXES + 1;
  auto sample = std::make_unique<StatusSample>();
  for (unsigned s = 0; s < kSystems; ++s) {
    sample->fill(machine, *block, s, kPartition);
    const nc_Status& status = sample->status;
    require(status.part_system == s + 1);
    require_enum(status.mode, nc_MODE_MANUAL);
    require_enum(status.run_state, nc_RUN_MANUAL);
    require_enum(status.stop_cause, nc_CAUSE_OTHER);
    require_enum(status.refusal_cause, nc_REFUSED_NO_ANSWER);
    require_enum(status.feed_override_source, nc_OVERRIDE_PROGRAM);
    require_enum(status.rapid_override_source, nc_OVERRIDE_PROGRAM);
    require_text(status.machine);
    require_text(status.state_text);
    require_text(status.program);
    require_text(status.file);
    require_text(status.block);
    require_text(status.modal);
    require_text(status.message);
    require_text(status.refusal_text);
    require(status.axes._length <= status.axes._maximum && status.forced._length <= share::kForced);
    for (unsigned a = 0; a < status.axes._length; ++a) require_text(sample->axes[a].name);
    for (unsigned i = 0; i < status.forced._length; ++i) require_text(sample->forced[i].device);
    const nc_Status_v1 core = core_status(machine, *block, s, kPartition);
    require_text(core.machine);
    require_text(core.program);
    require_text(core.axis_names);
    require(core.alarm_count <= block->alarm_count && status.alarm == (core.alarm_count != 0));
    require(status.warning == (core.alarm_count != block->alarm_count));
  }
  for (unsigned i = 0; i < block->alarm_count; ++i) require_alarm(block->alarm[i], i);
}

void show_signals(const share::MachineBlock& machine, Bytes* in) {
  auto points = std::make_unique<share::PointsBlock>();
  auto signals = std::make_unique<share::SignalsBlock>();
  damage(points.get(), in);
  damage(signals.get(), in);
  points->count = in->byte();  // another number than the table has, too
  signals->count = in->byte();
  auto sample = std::make_unique<SignalSample>();
  sample->fill(machine, *points, *signals, kPartition);
  require(sample->image.signals._length == std::min(points->count, kPoints));
  require(sample->image.control._length == std::min(signals->count, kSignals));
  for (unsigned i = 0; i < sample->image.signals._length; ++i) require_text(sample->signals[i].name);
  for (unsigned i = 0; i < sample->image.control._length; ++i) {
    require_text(sample->control[i].name);
    require_enum(sample->control[i].type, nc_SIGNAL_WORD32);
  }
}

template <std::size_t kSize>
bool hides(const char (&text)[kSize]) {
  const std::string all(text, kSize);
  return all.find('\0') != std::string::npos && all.find_first_not_of('\0', all.find('\0')) != std::string::npos;
}

void take_command(const share::MachineBlock& machine, Bytes* in) {
  auto command = std::make_unique<nc_Command>();
  std::memset(static_cast<void*>(command.get()), 0, sizeof *command);
  std::strcpy(command->client, "panel");
  command->part_system = 1;
  std::strcpy(command->axis, "X");
  damage(command.get(), in);
  require(has_hidden_text(*command) ==
          (hides(command->client) || hides(command->expected_program) || hides(command->axis) || hides(command->text)));
  // The middleware gives only texts that end with a NUL, existing enumerators and valid truth values.
  command->client[sizeof command->client - 1] = command->axis[sizeof command->axis - 1] = '\0';
  command->expected_program[sizeof command->expected_program - 1] = command->text[sizeof command->text - 1] = '\0';
  const std::uint64_t writer = in->byte();
  const auto request = std::make_unique<share::Request>(nc::dds::request(*command, machine, writer, 5));
  require(request->writer == writer && request->issued_ns == 5 && request->sequence == command->seq);
  require(request->kind <= static_cast<std::uint32_t>(share::RequestKind::kWriteDevice) ||
          request->kind == static_cast<std::uint32_t>(share::RequestKind::kCount));
  for (const auto text : {share::text_of(request->client), share::text_of(request->expected_program), share::text_of(request->text)})
    require(nc::rt::valid_utf8(text) == text);
  require(share::is_ended(request->client) && share::is_ended(request->expected_program) && share::is_ended(request->text));
  require(request->axis == NC_MAX_AXES || (request->system < kSystems && request->axis < machine.axis_count[request->system]));
}

void answer(const share::MachineBlock&, Bytes* in) {
  share::Ack from{};
  damage(&from, in);
  const nc_CommandAck to = ack(from);
  require_enum(to.refusal, nc_REFUSED_NO_ANSWER);
  require_text(to.client);
  require_text(to.text);
  require_enum(to.kind, nc_CMD_WRITE_DEVICE);
  require_enum(to.state, nc_ACK_FAILED);
  require_enum(to.reason, nc_REASON_CLIENT_IN_USE);
  if (from.state > nc_ACK_FAILED) require(to.state == nc_ACK_REJECTED);  // an unknown state must not look as if it was done
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes in(data, size);
  constexpr void (*kWays[])(const share::MachineBlock&, Bytes*) = {report, show_signals, take_command, answer};
  const std::uint8_t way = in.byte();
  const auto machine = machine_from(&in);
  if ((way & 0x80) != 0) describe(*machine);
  kWays[way % std::size(kWays)](*machine, &in);
  return 0;
}
