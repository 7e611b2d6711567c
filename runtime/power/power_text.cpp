// SPDX-License-Identifier: Apache-2.0
// See power_text.hpp.
#include "runtime/power/power_text.hpp"

#include "runtime/power/power_watch.hpp"

namespace nc::rt {

std::string power_text(std::uint32_t detail, std::uint32_t times) {
  if ((detail & kPowerDone) == 0) return "the axes come to rest, retained data are written";
  const std::string rest = std::to_string(times & 0xffffu) + " ms", saved = std::to_string(times >> 16) + " ms";
  std::string text = (detail & kPowerLate) != 0 ? "the axes were not at rest within " + rest + ", and the drives went off"
                                                : "the axes came to rest on their paths within " + rest;
  if ((detail & kPowerBrakes) != 0) text += ", brakes have closed";
  if ((detail & kPowerNotSaved) != 0) return text + ", retained data could not all be written";
  if ((detail & kPowerNothingKept) != 0) return text + ", no retained data are configured";
  return text + ", retained data were written within " + saved;
}

}  // namespace nc::rt
