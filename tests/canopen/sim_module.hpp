// SPDX-License-Identifier: Apache-2.0
// The object dictionary of a simulated CiA 401 module: a SimDrive without axes that has these objects instead. 16 digital inputs and outputs, 8 analog inputs,
// 2 analog outputs.
#pragma once

#include "sim_drive.hpp"

namespace nc::test {

inline void module_objects(SimDrive* module) {
  module->set_object(0x1000, 0, 4, 0x000F0191, false);
  for (unsigned n = 0; n < 4; ++n) {
    for (const unsigned communication : {0x1400u, 0x1800u}) {
      module->set_object(communication + n, 1, 4, (communication == 0x1400 ? 0x200u : 0x180u) + 0x100 * n + module->node());
      module->set_object(communication + n, 2, 1, 255);
    }
    for (const unsigned mapping : {0x1600u, 0x1A00u})
      for (unsigned sub = 0; sub <= 8; ++sub) module->set_object(mapping + n, sub, sub == 0 ? 1 : 4, 0);
  }
  for (unsigned n = 1; n <= 2; ++n) {
    module->set_object(0x6000, n, 1, 0, false);
    module->set_object(0x6200, n, 1, 0);
    module->set_object(0x6206, n, 1, 0xFF);
    module->set_object(0x6207, n, 1, 0);
  }
  for (unsigned n = 1; n <= 8; ++n) module->set_object(0x6401, n, 2, 0, false);
  for (unsigned n = 1; n <= 2; ++n) module->set_object(0x6411, n, 2, 0);
  module->set_object(0x6423, 0, 1, 0);
}

}  // namespace nc::test
