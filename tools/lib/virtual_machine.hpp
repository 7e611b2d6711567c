// SPDX-License-Identifier: Apache-2.0
// The online executor on virtual time: nc_feed() and nc_cycle() with a machine whose axes follow at once or with a simulated servo. The machine
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

/** The result of a run. */
struct MachineResult {
  enum class How { kEnded, kAlarmed, kStopped, kEndless, kFailed };
  How how = How::kFailed;
  nc_alarm alarm = {};
  std::string error;         // for kFailed; for kEndless why the run was given up
  double seconds = 0.0;      // time in execution, from cycle start to the end
  double path_length = 0.0;  // mm
  uint64_t blocks = 0, cycles = 0;
  std::vector<std::string> unused;  // parts of the setup that had no effect (VirtualWorld::unused)
  bool one_pass = false;     // with kEnded: the run ended where M99 would begin the main program again
};

/** Called once per servo cycle with the outputs of the control. @return false to stop the run. */
using CycleObserver = std::function<bool(const nc_outputs&)>;

/** The servos: in each cycle an axis moves by the fraction `follow` of its distance from the command, and in-position checks wait for it. And the clamps of
 *  index tables. */
struct ServoModel {
  double follow[NC_MAX_AXES];
  hal::SimClamp clamp[NC_MAX_AXES];
};

/**
 * Runs the selected program of a control that was created with `config`. As in run_offline(), a main
 * program that M99 would begin again ends there unless its passes differ.
 * @param decides has_decision() of the main program
 * @param limit_s virtual seconds after which the run is given up.
 * @param loops passes after which a loop is given up.
 * @param servo null: the axes are always where they are commanded to be.
 */
MachineResult run_machine(nc_control* control, const nc_config& config, const Setup& setup, Decides decides, double limit_s, const LoopLimits& loops,
                          const CycleObserver& observe = {}, const ServoModel* servo = nullptr);

}  // namespace nc::tools
