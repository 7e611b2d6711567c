// SPDX-License-Identifier: Apache-2.0
// See ladder.hpp.
#include "runtime/services/ladder.hpp"

#include <memory>
#include <thread>
#include <utility>

#include "runtime/services/forced_devices.hpp"
#include "runtime/services/named_device.hpp"
#include "runtime/services/sha256.hpp"

namespace nc::rt::services {
namespace {

// At 1 ms one scan in two hundred at most notes its power flow, so the 99th percentile of the scan does not feel it.
constexpr auto kFlowPause = std::chrono::milliseconds(200);

constexpr std::size_t kMostReasons = 20, kShownDigits = 16;

// A program in the list of changes: its name without the path, and its length.
std::string described(const ladder::Program& program) {
  return program.file().substr(program.file().rfind('/') + 1) + ", " + std::to_string(program.instruction_count()) + " instructions";
}

Outcome no_ladder() { return Outcome::refused(Refused::kNotFound, "the machine has no ladder program"); }
Outcome no_scan() { return Outcome::refused(Refused::kNotReached, "the scan does not run"); }

}  // namespace

Outcome LadderDesk::list_rungs(const Call& call) {
  LadderTask* const task = runtime_.ladder();
  if (task == nullptr) return no_ladder();
  const ladder::Program& program = task->program();
  const auto now = std::chrono::steady_clock::now();
  const bool anew = flow_.size() != program.flow_bytes() || now - flow_time_ >= kFlowPause;
  const auto from = static_cast<unsigned>(call.value_or(Field::kFrom, 0)), count = static_cast<unsigned>(call.value_or(Field::kCount, kWholePage));
  if (from > program.line_count()) return Outcome::refused(Refused::kNotFound, "the program has " + std::to_string(program.line_count()) + " lines");

  const std::vector<ladder::ListedLine> plain = program.listing(from, count, nullptr);
  std::vector<LadderLook::Source> sources;
  std::vector<NamedDevice> named;  // of all operands, in their order
  for (const ladder::ListedLine& line : plain)
    for (const std::string& operand : line.operands)
      if (named.push_back(find_named(*task, operand)); named.back().device) sources.push_back({named.back().device->type, named.back().device->index});
  LadderLook& look = task->look();
  if (!look.take(std::move(sources), anew ? program.flow_bytes() : 0, kScanPatience)) return no_scan();
  if (anew) {
    flow_ = look.flow();
    flow_scan_ = look.scan();
    flow_time_ = now;
  }

  const ForcedDevices forced(runtime_);
  Json lines = Json::array();
  auto next_named = named.cbegin();
  auto next_value = look.values().cbegin();
  unsigned next = 0;
  for (const ladder::ListedLine& line : program.listing(from, count, flow_.data(), &next)) {
    Json operands = Json::array();
    for (const std::string& operand : line.operands) {
      Json shown = {{"name", operand}};
      const NamedDevice& of = *next_named++;
      if (of.device) {
        shown["value"] = of.part_of(*next_value++);
        shown["forced"] = forced.has(of);
      }
      operands.push_back(std::move(shown));
    }
    Json& shown = lines.emplace_back(Json{{"line", line.line}, {"rung", line.rung}, {"instruction", line.instruction}, {"operands", std::move(operands)}});
    if (line.power != ladder::ListedLine::Power::kNone) shown["power"] = line.power == ladder::ListedLine::Power::kOn;
  }
  return Outcome::with({{"file", program.file()}, {"swaps", task->swaps()}, {"flow_scan", flow_scan_}, {"scan", look.scan()}, {"lines", std::move(lines)}, {"next", next}});
}

Outcome LadderDesk::list_devices(const Call& call) {
  LadderTask* const task = runtime_.ladder();
  if (task == nullptr) return no_ladder();
  const std::vector<std::string>& names = call.list(Field::kDevices);
  std::vector<LadderLook::Source> sources;
  std::vector<NamedDevice> named;
  for (const std::string& name : names) {
    named.push_back(find_named(*task, name));
    if (!named.back().device) return Outcome::refused(Refused::kNotFound, "there is no device \"" + name + "\"");
    sources.push_back({named.back().device->type, named.back().device->index});
  }
  LadderLook& look = task->look();
  if (!look.take(std::move(sources), 0, kScanPatience)) return no_scan();
  const ForcedDevices forced(runtime_);
  Json list = Json::array();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const ladder::Device& device = *named[i].device;
    list.push_back({{"name", names[i]},
                    {"type", named[i].type()},
                    {"value", named[i].part_of(look.values()[i])},
                    {"forced", forced.has(named[i])},
                    {"meaning", device.comment}});
  }
  return Outcome::with({{"scan", look.scan()}, {"devices", std::move(list)}});
}

Outcome LadderDesk::swap(const Call& call, Change* change) {
  LadderTask* const task = runtime_.ladder();
  if (task == nullptr) return no_ladder();
  const std::string name = call.has(Field::kLadderName) ? call.words(Field::kLadderName) : "swapped", &text = call.words(Field::kLadderText);
  std::vector<ladder::Error> errors;
  std::unique_ptr<LadderSwap> next = task->prepare_swap(text, name, &errors);
  if (next == nullptr) {
    std::string reasons;
    for (std::size_t i = 0; i < errors.size() && i < kMostReasons; ++i) reasons += (i == 0 ? "" : "\n") + errors[i].text();
    if (errors.size() > kMostReasons) reasons += "\nand " + std::to_string(errors.size() - kMostReasons) + " more";
    return Outcome::refused(Refused::kState, reasons);
  }
  Json warnings = Json::array(), set_back = Json::array();
  for (const ladder::Error& warning : next->program().warnings()) warnings.push_back(warning.text());
  for (const std::string& device : next->set_back()) set_back.push_back(device);
  change->what = "ladder program";
  change->before = described(task->program());
  Sha256 sum;
  sum.add(text);
  change->after = described(next->program()) + ", SHA-256 " + sum.finish().substr(0, kShownDigits);
  if (!task->swap(std::move(next), kScanPatience, [] { std::this_thread::sleep_for(std::chrono::microseconds(200)); })) return no_scan();
  flow_.clear();  // it was that of the program before
  return Outcome::with({{"text", "until ncrtd ends: its next start takes " + runtime_.config().ladder_file()}, {"swaps", task->swaps()}, {"warnings", std::move(warnings)}, {"set_back", std::move(set_back)}});
}

}  // namespace nc::rt::services
