// SPDX-License-Identifier: Apache-2.0
// The place at which an operator wants a program to begin (nc/restart.h), and how far that is.
#pragma once

#include <cstdint>
#include <string>

#include "nc/nc.h"
#include "runtime/restart/recovery_list.hpp"

namespace nc::rt {

// How the operator names the place. The first three are those of nc_restart_by.
enum class RestartBy : std::uint8_t { kBlock = NC_RESTART_BLOCK, kSequence = NC_RESTART_SEQUENCE, kLine = NC_RESTART_LINE, kPowerOff, kLastStop, kCount };

struct RestartWish {
  RestartBy by = RestartBy::kBlock;
  std::uint64_t number = 0;   // blocks, sequence number or line
  std::uint32_t passing = 0;  // of a sequence number or line: for the so-manieth time; 0 and 1 = the first
  std::string file = {};      // name of the program that has the line; "" = the one that is selected
};

enum class RestartPhase : std::uint8_t {
  kNone,       // nothing has been looked for
  kSearching,
  kFound,      // the next cycle start comes to the place
  kStands,     // the program stands at the place: cycle start goes on
  kLost,       // it was not found, or was forgotten: no start, which would begin at the head of the program, until somebody says so. RestartStatus::text says why
  kEnded       // RestartStatus::text says why
};
const char* restart_phase_text(RestartPhase phase);

// What is shown of it, for one part system.
struct RestartStatus {
  RestartPhase phase = RestartPhase::kNone;
  std::string text = {};     // a sentence: what was looked for, or why it has ended
  std::string program = {};  // name of the text in which the place is
  std::uint64_t read = 0;    // blocks that have been read so far, in steps
  nc_restart_found found{};  // from kFound on
  nc_modal modal{};
  bool modal_known = false;
  RecoveryList list = {};
};

}  // namespace nc::rt
