// SPDX-License-Identifier: Apache-2.0
// See recovery_list.hpp.
#include "runtime/restart/recovery_list.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace nc::rt {
namespace {

using Kind = RecoveryEntry::Kind;
using State = RecoveryEntry::State;

constexpr double kSameSpeed = 0.5;  // r/min

}  // namespace

const char* recovery_state_text(State state) {
  switch (state) {
    case State::kOpen: return "open";
    case State::kDone: return "done";
    case State::kConfirmed: return "confirmed";
  }
  return "?";
}

nc_code_role RecoveryList::role_of(double code) const { return nc_code_role_get(dialect_, 'M', static_cast<std::uint32_t>(code)); }

// Nothing that a machine has to be given again.
bool RecoveryList::is_stop(double code) const {
  const nc_code_role role = role_of(code);
  return role == NC_CODE_PROGRAM_STOP || role == NC_CODE_OPTIONAL_STOP || role == NC_CODE_PROGRAM_END;
}

bool RecoveryList::turns_spindle(double code) const {
  const nc_code_role role = role_of(code);
  return role == NC_CODE_SPINDLE_FORWARD || role == NC_CODE_SPINDLE_REVERSE || role == NC_CODE_SPINDLE_STOP;
}

void RecoveryList::begin(const nc_restart_found& found, nc_dialect dialect) {
  entries_.clear();
  dialect_ = dialect;
  called_known_ = called_since_ = false;
  begin_codes(found);
  for (std::uint32_t w = 0; w < NC_WORDS; ++w)
    if (found.output_written[w] != 0) entries_.push_back({Kind::kOutputs, State::kOpen, 0, false, w, found.output_written[w], found.output[w] & found.output_written[w], {}});
}

void RecoveryList::begin_codes(const nc_restart_found& found) {
  struct Given {
    std::uint32_t order;
    RecoveryEntry entry;
  };
  std::vector<Given> given;
  const auto add = [&](std::uint32_t order, Kind kind, double value, bool of_change = false) { given.push_back({order, {kind, State::kOpen, value, of_change, 0, 0, 0, {}}}); };
  const bool ahead = found.t_given && (!found.change_t_given || found.t_order != found.change_t_order);
  if (found.change_t_given) add(found.change_t_order, Kind::kTool, static_cast<double>(found.change_t), true);
  if (ahead) add(found.t_order, Kind::kTool, found.t);
  if (found.b_given) add(found.b_order, Kind::kSecond, found.b);
  if (found.s_given) add(found.s_order, Kind::kSpeed, found.s);
  const std::uint32_t count = std::min<std::uint32_t>(found.m_count, NC_RESTART_CODES);
  for (std::uint32_t i = 0; i < count; ++i) {
    const bool other_follows = turns_spindle(found.m[i]) && std::any_of(found.m + i + 1, found.m + count, [&](std::uint32_t later) { return turns_spindle(later); });
    if (!is_stop(found.m[i]) && !other_follows) add(found.m_order[i], Kind::kM, found.m[i]);
  }
  std::stable_sort(given.begin(), given.end(), [](const Given& a, const Given& b) { return a.order < b.order; });
  for (const Given& code : given) entries_.push_back(code.entry);
}

void RecoveryList::given(std::uint8_t group, double value) {
  if (group == kGivenM && !is_stop(value)) given_m(value);
  if (group == kGivenM && role_of(value) == NC_CODE_TOOL_CHANGE) changed();
  if (group == kGivenT) given_t(value);
  for (RecoveryEntry& entry : entries_)
    if (group == kGivenB && entry.kind == Kind::kSecond) entry.state = entry.value == value ? State::kDone : State::kOpen;
}

// ---- tools ----

RecoveryEntry* RecoveryList::change() {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [&](const RecoveryEntry& entry) { return entry.kind == Kind::kM && role_of(entry.value) == NC_CODE_TOOL_CHANGE; });
  return found == entries_.end() ? nullptr : &*found;
}

RecoveryEntry* RecoveryList::tool_of_change() {
  const auto found = std::find_if(entries_.begin(), entries_.end(), [](const RecoveryEntry& entry) { return entry.of_change; });
  return found == entries_.end() ? nullptr : &*found;
}

// Until the tool of the change is in the spindle it has to be the one that is called; behind that another one may be.
bool RecoveryList::change_is_open() {
  const RecoveryEntry* const at = change();
  return at != nullptr && at->state == State::kOpen;
}

void RecoveryList::given_t(double value) {
  called_known_ = called_since_ = true;
  called_ = value;
  for (RecoveryEntry& entry : entries_) {
    if (entry.kind != Kind::kTool) continue;
    if (entry.value == value) entry.state = State::kDone;
    else if (!entry.of_change || change_is_open()) entry.state = State::kOpen;
  }
}

// A tool change has been given out, and it has brought the tool that was called. Where none is known to be called the operator's word counts.
void RecoveryList::changed() {
  RecoveryEntry* const tool = tool_of_change();
  RecoveryEntry* const change = this->change();
  if (tool == nullptr || change == nullptr) return;
  const bool right = called_known_ ? called_ == tool->value : tool->state != State::kOpen;
  if (right && called_known_) tool->state = State::kDone;
  if (!right) tool->state = change->state = State::kOpen;
}

// A code that is not in the list may do anything, so every M code of the list is open again.
void RecoveryList::given_m(double value) {
  const auto is_it = [&](const RecoveryEntry& entry) { return entry.kind == Kind::kM && entry.value == value; };
  const auto found = std::find_if(entries_.begin(), entries_.end(), is_it);
  const bool spindle = turns_spindle(value);
  for (auto entry = found == entries_.end() || spindle ? entries_.begin() : found; entry != entries_.end(); ++entry)
    if (entry->kind == Kind::kM && (!spindle || turns_spindle(entry->value))) entry->state = State::kOpen;
  if (found != entries_.end()) found->state = State::kDone;
}

// What can be seen at the machine at any time. What the operator has confirmed stays so until the machine has what the program wants, and then loses it.
void RecoveryList::compare(RecoveryEntry* entry, bool has) {
  if (has) entry->state = State::kDone;
  else if (entry->state == State::kDone) entry->state = State::kOpen;
}

void RecoveryList::look(const nc_outputs& out, const std::uint32_t outputs[NC_WORDS]) {
  if (!called_since_ && out.t != 0) called_known_ = true, called_ = out.t;
  for (RecoveryEntry& entry : entries_) {
    if (entry.kind == Kind::kSpeed) compare(&entry, std::abs(out.s - entry.value) <= kSameSpeed);
    if (entry.kind == Kind::kOutputs) compare(&entry, (outputs[entry.word] & entry.mask) == entry.bits);
    // The number of a tool that is called already. 0 is what a machine shows that has got none since it was switched on.
    if (entry.kind == Kind::kTool && entry.value != 0 && (!entry.of_change || change_is_open())) compare(&entry, out.t == entry.value);
    if (entry.kind == Kind::kSecond && entry.value != 0) compare(&entry, out.b == entry.value);
  }
}

bool RecoveryList::confirm(std::size_t entry) {
  if (entry >= entries_.size()) return false;
  if (entries_[entry].state == State::kOpen) entries_[entry].state = State::kConfirmed;
  return true;
}

void RecoveryList::confirm_all() {
  for (std::size_t i = 0; i < entries_.size(); ++i) (void)confirm(i);
}

unsigned RecoveryList::open() const {
  return static_cast<unsigned>(std::count_if(entries_.begin(), entries_.end(), [](const RecoveryEntry& entry) { return entry.state == State::kOpen; }));
}

std::string RecoveryList::text(const RecoveryEntry& entry) const {
  if (entry.kind == Kind::kInForce) return entry.in_force;
  char text[64];
  constexpr const char* kLetters = "TBSM";  // in the order of Kind; the letter of the second auxiliary function depends on the machine
  if (entry.kind == Kind::kOutputs) std::snprintf(text, sizeof text, " bits %X = %X", entry.mask, entry.bits);
  else std::snprintf(text, sizeof text, "%c%.10g", kLetters[static_cast<unsigned>(entry.kind)], entry.value);
  return entry.kind == Kind::kOutputs ? word_name(entry.word) + text : text;
}

// The variable by which a program of the family writes a word of outputs; a family may write them by other means.
std::string RecoveryList::word_name(std::uint32_t word) const {
  nc_system_variable row = NC_INIT(nc_system_variable);
  for (unsigned i = 0; nc_system_variable_row(dialect_, i, &row) == NC_OK; ++i)
    if (row.role == NC_VARIABLE_OUTPUT_WORD && word >= row.word && word - row.word <= row.last - row.first) return "#" + std::to_string(row.first + word - row.word);
  return "output word " + std::to_string(word);
}

}  // namespace nc::rt
