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
  const auto add = [&](Kind kind, double value) { entries_.push_back({kind, State::kOpen, value, 0, 0, 0}); };
  if (found.t_given) add(Kind::kTool, found.t);
  if (found.b_given) add(Kind::kSecond, found.b);
  if (found.s_given) add(Kind::kSpeed, found.s);
  const std::uint32_t* const end = found.m + std::min<std::uint32_t>(found.m_count, NC_RESTART_CODES);
  for (const std::uint32_t* m = found.m; m != end; ++m) {
    const bool other_follows = turns_spindle(*m) && std::any_of(m + 1, end, [&](std::uint32_t later) { return turns_spindle(later); });
    if (!is_stop(*m) && !other_follows) add(Kind::kM, *m);
  }
  for (std::uint32_t w = 0; w < NC_WORDS; ++w)
    if (found.output_written[w] != 0) entries_.push_back({Kind::kOutputs, State::kOpen, 0, w, found.output_written[w], found.output[w] & found.output_written[w]});
}

void RecoveryList::given(std::uint8_t group, double value) {
  if (group == kGivenM && !is_stop(value)) given_m(value);
  for (RecoveryEntry& entry : entries_) {
    const bool tool = group == kGivenT && entry.kind == Kind::kTool, second = group == kGivenB && entry.kind == Kind::kSecond;
    if (tool || second) entry.state = entry.value == value ? State::kDone : State::kOpen;
  }
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
  for (RecoveryEntry& entry : entries_) {
    if (entry.kind == Kind::kSpeed) compare(&entry, std::abs(out.s - entry.value) <= kSameSpeed);
    if (entry.kind == Kind::kOutputs) compare(&entry, (outputs[entry.word] & entry.mask) == entry.bits);
    // The number of a tool that is there already. 0 is what a machine shows that has got none since it was switched on.
    if (entry.kind == Kind::kTool && entry.value != 0) compare(&entry, out.t == entry.value);
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
