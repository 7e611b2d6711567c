// SPDX-License-Identifier: Apache-2.0
// Any bytes as the texts and numbers that a monitor gets from the network. It draws valid UTF-8 without control characters, in whole lines; what it
// prints as JSON is one line that can be parsed.
#include <nlohmann/json.hpp>

#include "dds/monitor_view.hpp"
#include "fuzz/input.hpp"
#include "runtime/programs/encoding.hpp"

namespace {

using namespace nc::dds;
using nc::fuzz::Bytes;
using nc::fuzz::require;

/// A text of at most the length that the IDL allows, without NUL; it may end in the middle of a character.
std::string text(Bytes* in, std::size_t bound) {
  const std::string bytes = in->text(std::min<std::size_t>(in->byte(), bound));
  return bytes.substr(0, bytes.find('\0'));
}

AxisView axis(Bytes* in) {
  AxisView a;
  a.name = text(in, 7);
  a.rotary = (in->byte() & 1) != 0;
  for (double* number : {&a.commanded, &a.actual, &a.work, &a.distance_to_go, &a.velocity}) *number = in->value<double>();
  return a;
}

StatusView status(Bytes* in) {
  StatusView s;
  s.part_system = in->byte();
  s.machine = text(in, 63);
  s.mode = "auto";
  s.run_state = "running";
  s.stop_cause = "none";
  s.state_text = text(in, 63);
  s.refusal_text = text(in, 127);
  s.program = text(in, 127);
  s.file = text(in, 127);
  s.block = text(in, 127);
  s.modal = text(in, 191);
  s.message_count = in->byte() & 1;
  s.message = text(in, 127);
  s.line = in->value<std::uint32_t>();
  s.depth = in->byte() & 3;
  s.program_number = in->value<std::uint32_t>();
  for (double* number : {&s.feed, &s.feed_command, &s.feed_override, &s.rapid_override, &s.spindle, &s.spindle_command, &s.path_length,
                         &s.run_s, &s.execution_max_us})
    *number = in->value<double>();
  for (unsigned count = in->byte() % 17; count > 0 && !in->empty(); --count) s.axes.push_back(axis(in));
  for (unsigned count = in->byte() % 33; count > 0 && !in->empty(); --count) {
    std::string device = text(in, 63);
    s.forced.emplace_back(std::move(device), in->value<std::int32_t>());
  }
  return s;
}

AlarmView alarm(Bytes* in) {
  AlarmView a;
  a.id = in->value<std::uint64_t>();
  a.code = text(in, 15);
  a.text = text(in, 255);
  a.axis = text(in, 7);
  a.line = in->value<std::uint32_t>();
  a.raised_ns = in->value<std::int64_t>();
  a.warning = (in->byte() & 1) != 0;
  return a;
}

SignalView signal(Bytes* in) {
  SignalView s;
  s.name = text(in, 55);
  s.direction = "from the NC";
  s.type = "bit";
  s.value = in->value<std::int64_t>();
  s.good = (in->byte() & 1) != 0;
  s.meaning = text(in, 255);
  s.timing = text(in, 127);
  return s;
}

/// ECMA-48: a terminal obeys C0 (here without the end of a line), DEL and C1; a terminal of 8 bits takes a byte that is not UTF-8 for C1.
void require_harmless(const std::string& drawn, bool lines) {
  for (std::size_t at = 0; at < drawn.size();) {
    const std::size_t length = nc::rt::utf8_length(std::string_view(drawn).substr(at));
    require(length != 0);
    const auto first = static_cast<unsigned char>(drawn[at]);
    require(first >= ' ' || (lines && first == '\n'));
    require(first != 0x7f && !(first == 0xc2 && static_cast<unsigned char>(drawn[at + 1]) < 0xa0));
    at += length;
  }
  require(!lines || drawn.empty() || drawn.back() == '\n');
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes in(data, size);
  MonitorView view;
  const std::uint8_t shape = in.byte();
  view.alive = (shape & 1) != 0;
  view.ended = (shape & 2) != 0;
  const unsigned columns = (shape & 4) != 0 ? 0 : in.byte();
  for (unsigned s = 0; s <= (shape >> 3 & 1u); ++s) view.systems[s + 1] = status(&in);
  for (unsigned slot = 0; slot < (shape >> 4 & 3u) && !in.empty(); ++slot) view.alarms[slot] = alarm(&in);
  for (unsigned count = (shape >> 6) * 3u; count > 0 && !in.empty(); --count) view.signals.push_back(signal(&in));

  require_harmless(page(view), true);
  const std::string table = signal_page(view, columns);
  require_harmless(table, true);
  if (columns == 0 && !view.signals.empty())
    require(static_cast<std::size_t>(std::count(table.begin(), table.end(), '\n')) == view.signals.size());
  for (const auto& [number, system] : view.systems) require_harmless(progress_line(system, view.alarms), false);
  for (const auto& [slot, one] : view.alarms) require_harmless(alarm_line(one), false);
  const std::string json = json_line(view);
  require(json.find('\n') == std::string::npos);
  const nlohmann::json back = nlohmann::json::parse(json, nullptr, false);
  require(!back.is_discarded() && back["systems"].size() == view.systems.size() && back["alarms"].size() == view.alarms.size());
  require(view.signals.empty() || back["signals"]["values"].size() == view.signals.size());
  return 0;
}
