// SPDX-License-Identifier: Apache-2.0
// The online executor on virtual time: nc_feed() and nc_cycle() with a machine whose axes follow at once or as a simulated servo, which
// answers FIN in the next cycle and continues every stop at once.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "hal/sim/sim_clamp.hpp"
#include "nc/nc.h"
#include "tools/lib/offline_run.hpp"
#include "tools/lib/virtual_world.hpp"

namespace nc::tools {

/** What a run took. */
struct MachineResult {
  enum class How { kEnded, kAlarmed, kStopped, kEndless, kFailed };
  How how = How::kFailed;
  nc_alarm alarm = {};
  std::string error;         // kFailed; kEndless: what was given up
  double seconds = 0.0;      // running, from cycle start to the end
  double path_length = 0.0;  // mm
  uint64_t blocks = 0, cycles = 0;
  std::vector<std::string> unused;  // of the setup (VirtualWorld::unused)
  bool one_pass = false;     // kEnded, because M99 would begin the main program again
};

/** Called once per servo cycle with what the control gave out. @return false when nothing more is wanted. */
using CycleObserver = std::function<bool(const nc_outputs&)>;

/** How far the axes come in a cycle: this share of the way to the command. The checks of the position wait for them. And the clamps of
 *  index tables. */
struct ServoModel {
  double follow[NC_MAX_AXES];
  hal::SimClamp clamp[NC_MAX_AXES];
};

/**
 * Run the selected program of a control made with `config`, as run_offline(): a main
 * program that M99 would begin again ends there unless its passes differ.
 * @param decides has_decision() of the main program
 * @param limit_s virtual seconds after which the run is given up.
 * @param loops passes after which a loop is given up.
 * @param servo null: the axes are always where they are commanded to be.
 */
MachineResult run_machine(nc_control* control, const nc_config& config, const Setup& setup, bool decides, double limit_s, const LoopLimits& loops,
                          const CycleObserver& observe = {}, const ServoModel* servo = nullptr);

}  // namespace nc::tools
