// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "ladder/code.hpp"
#include "ladder/families.hpp"

namespace nc::ladder {

std::string Error::text() const {
  std::string out = file;
  if (line != 0) out += ":" + std::to_string(line);
  out += ": ";
  if (!instruction.empty()) out += instruction + ": ";
  return out + message;
}

Program::Program() {
  auto code = std::make_shared<Code>();
  code->layout = make_layout(code->table, 0, 0);
  code->units.resize(1);
  code->units[0].head = {static_cast<std::uint16_t>(Op::kEnd), 0, 0};
  code->lines.resize(1);
  code_ = std::move(code);
}
unsigned Program::instruction_count() const {
  return code_->instructions;
}
const std::vector<Error>& Program::warnings() const {
  return code_->warnings;
}

Engine::Engine(const Program& program) : code_(program.code()) {}

DeviceImage Engine::make_image() const {
  const Layout& at = code_->layout;
  DeviceImage image;
  image.bit.assign(at.bits, 0);
  image.word.assign(at.words, 0);
  std::fill_n(image.bit.begin() + at.counter_on, kCounters, kEdgeUnknown);
  std::copy(code_->edge_start.begin(), code_->edge_start.end(), image.bit.begin() + at.edges);
  return image;
}

void Engine::scan(DeviceImage* image, const Hold* holds, unsigned hold_count, std::uint8_t* flow) noexcept {
  if (fault_ != kNoFault) return;
  const Layout& at = code_->layout;
  if (image->bit.size() != at.bits || image->word.size() != at.words) {
    fault_ = kImageSize;
    return;
  }
  const bool watched = hold_count != 0 || flow != nullptr;
  const Outcome outcome = watched ? execute_watched(*code_, image, holds, hold_count, flow) : execute_threaded(*code_, image);
  fault_ = outcome.fault;
  fault_step_ = outcome.step;
}

unsigned Engine::fault_line() const {
  if (fault_ == kNoFault || fault_ == kImageSize || fault_step_ >= code_->lines.size()) return 0;
  return code_->lines[fault_step_];
}

std::string Engine::fault_text() const {
  return fault_text(fault_, fault_line());
}

std::string Engine::fault_text(unsigned fault, unsigned line) const {
  Error error{code_->file, line, "", ""};
  if (error.line != 0 && error.line <= code_->source.size())
    error.instruction = code_->source[error.line - 1];
  switch (fault) {
    case kNoFault:
      return "";
    case kWatchdog:
      error.message = "watchdog: one scan took more than " + std::to_string(code_->step_budget) +
                      " instructions beyond one pass; look for a jump backwards that does not end";
      break;
    case kCallStack:
      error.message = "more than " + std::to_string(kMaxCalls) + " subroutines inside each other";
      break;
    case kReturnNoCall:
      error.message = "reached without a CALL";
      break;
    case kEndInCall:
      error.message = "end of the program inside a subroutine: RET is missing";
      break;
    default:
      error.message = "the device image is not of this program";
      break;
  }
  return error.text();
}

const Device* Engine::find(std::string_view name) const {
  if (const Device* device = code_->table.find(name)) return device;
  if (const auto alias = code_->aliases.find(std::string(name)); alias != code_->aliases.end())
    if (alias->second != name) return find(alias->second);
  if (const auto known = found_.find(name); known != found_.end()) return &known->second;
  std::string message;
  const auto place = internal_device(name, code_->layout, &message);
  if (!place) return nullptr;
  Device device{std::string(name), place->type, place->writable, place->index, {}};
  return &found_.emplace(device.name, device).first->second;
}

std::vector<RetainedRange> Engine::retained() const {
  const Layout& at = code_->layout;
  std::vector<RetainedRange> ranges = {{"L", false, at.l, kL},
                                       {"ST contact", false, at.timer + kTimers, kRetentive},
                                       {"ST value", true, at.timer_value + kTimers, kRetentive},
                                       {"ST rest", true, at.timer_rest + 2 * kTimers, 2 * kRetentive}};
  if (code_->retain_counters) {
    ranges.push_back({"C contact", false, at.counter, kCounters});
    ranges.push_back({"C value", true, at.counter_value, kCounters});
  }
  if (code_->retained_d.count != 0)
    ranges.push_back({"D", true, at.d + code_->retained_d.first, code_->retained_d.count,
                      code_->retained_d.first});
  return ranges;
}

}  // namespace nc::ladder
