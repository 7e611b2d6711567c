// SPDX-License-Identifier: Apache-2.0
// Checks a program without a machine: runs it in a control of its own, with the offsets, parameters and common variables that the machine has now.
#pragma once

#include <array>
#include <atomic>
#include <string>

#include "runtime/retain/tables.hpp"
#include "runtime/runtime.hpp"
#include "runtime/services/program_checks.hpp"

namespace nc::tools {

/** What a program finds at the machine when it begins, as the executed blocks have left it. */
struct MachineTables {
  bool known = false;
  rt::TableRows tables;
  std::string variables;
  std::array<nc_axes, NC_MAX_SYSTEMS> position{};
};

/** A copy; it is made in the feeder thread, as the one that is kept over power off. */
MachineTables machine_tables(rt::Runtime* runtime);

/**
 * Runs the program to its end, an alarm, or its limit of processor time. What asks the machine gets an answer as from a machine at which every input is
 * off: behind such a block an alarm is reported, but does not refuse the program.
 */
rt::services::CheckReport check_program(const rt::Config& config, const MachineTables& machine, const rt::services::CheckOrder& order, const std::atomic<bool>& given_up);

}  // namespace nc::tools
