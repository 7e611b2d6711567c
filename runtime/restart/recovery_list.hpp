// SPDX-License-Identifier: Apache-2.0
// What a program that begins inside would have given to the machine on its way there: tool, spindle speed, M codes, macro outputs. The machine has got nothing
// of it. Each entry is open until it has been given out by MDI, or until the operator has said that it is right as it is.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "nc/nc.h"

namespace nc::rt {

// The groups of codes, as bits of nc_outputs::strobe.
enum GivenGroup : std::uint8_t { kGivenM = 1, kGivenS = 2, kGivenT = 4, kGivenB = 8 };

// A code that the machine has got.
struct GivenCode {
  std::uint8_t system = 0, group = 0;
  double value = 0;
};

struct RecoveryEntry {
  enum class Kind : std::uint8_t { kTool, kSecond, kSpeed, kM, kOutputs, kInForce } kind = Kind::kM;
  enum class State : std::uint8_t { kOpen, kDone, kConfirmed } state = State::kOpen;
  double value = 0;                          // the code
  bool of_change = false;                    // kTool: the tool that the newest tool change has brought into the spindle
  std::uint32_t word = 0, mask = 0, bits = 0;  // kOutputs: the word, the bits that the program has written, and their values
  std::string in_force = {};                   // kInForce: what the search has begun with or written; only the operator knows whether that is right for the part
};
const char* recovery_state_text(RecoveryEntry::State state);

class RecoveryList {
 public:
  // In the order of the program. Stops and the end of a program are not in it, and of the codes that turn and stop the spindle only the newest. The tool of the
  // newest tool change stands in it beside one that was called ahead, for the next change.
  void begin(const nc_restart_found& found, nc_dialect dialect);
  // The first entry is a sentence that has to be confirmed. Behind begin().
  void begin_with(const std::string& in_force) { entries_.insert(entries_.begin(), {RecoveryEntry::Kind::kInForce, RecoveryEntry::State::kOpen, 0, false, 0, 0, 0, in_force}); }
  // The machine has got a code since. An M code that is given out behind others of the list, and does not stand behind them there, opens those again: a tool
  // change behind the start of the spindle. A code that only turns or stops the spindle opens only that of the spindle. A tool change that is given out while
  // another tool than that of the list is called opens both.
  void given(std::uint8_t group, double value);
  // What the machine has now.
  void look(const nc_outputs& out, const std::uint32_t outputs[NC_WORDS]);
  // The operator says that an entry (from 0) is right as it is. False: there is none.
  bool confirm(std::size_t entry);
  void confirm_all();
  unsigned open() const;
  const std::vector<RecoveryEntry>& entries() const { return entries_; }
  // "M6", "S1500", "#1132 bits 3 = 1" (hexadecimal)
  std::string text(const RecoveryEntry& entry) const;

 private:
  std::string word_name(std::uint32_t word) const;
  void begin_codes(const nc_restart_found& found);
  void given_m(double value);
  void given_t(double value);
  void changed();
  RecoveryEntry* change();
  RecoveryEntry* tool_of_change();
  bool change_is_open();
  void compare(RecoveryEntry* entry, bool has);
  nc_code_role role_of(double code) const;
  bool is_stop(double code) const;
  bool turns_spindle(double code) const;
  nc_dialect dialect_{};
  std::vector<RecoveryEntry> entries_;
  // The tool that is called at the machine, which the next tool change brings into the spindle.
  bool called_known_ = false, called_since_ = false;  // called_since_: a T has been given out behind begin()
  double called_ = 0;
};

}  // namespace nc::rt
