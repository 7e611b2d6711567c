// SPDX-License-Identifier: Apache-2.0
// Minutes of cutting for the table of tool life (nc_tool_life_cut), of a run that no control executes: on a machine the control counts them itself.
#pragma once

#include <cstdint>

#include "nc/nc.h"

namespace nc::tools {

/** A tool of the table as it came into the spindle, and how long it has cut since the table was told. */
class LifeMinutes {
 public:
  /** The tool of NC_CONTROL_TOOL_LIFE is in the spindle from here on. */
  void mount(const nc_action& action) {
    place_ = static_cast<unsigned>(action.value);
    tool_ = action.bits;
    seconds_ = 0.0;
  }
  /** The life of the tool in the spindle is managed. */
  bool managed() const { return place_ != 0; }
  void cut(double seconds) { seconds_ += seconds; }

  unsigned place() const { return place_; }
  uint32_t tool() const { return tool_; }
  /** What has not been told yet; it is told now. */
  double take_minutes() {
    const double minutes = seconds_ / 60.0;
    seconds_ = 0.0;
    return minutes;
  }

 private:
  unsigned place_ = 0;
  uint32_t tool_ = 0;
  double seconds_ = 0.0;
};

}  // namespace nc::tools
