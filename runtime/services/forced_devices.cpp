// SPDX-License-Identifier: Apache-2.0
// See forced_devices.hpp.
#include "runtime/services/forced_devices.hpp"

namespace nc::rt::services {

ForcedDevices::ForcedDevices(const Runtime& runtime) {
  const ForceList forces = runtime.snapshot().forces;
  for (unsigned f = 0; f < forces.count; ++f)
    if (const auto held = runtime.ladder()->find_device(runtime.forced_name(forces.device[f].number))) devices_.insert(key_of(*held));
}

}  // namespace nc::rt::services
