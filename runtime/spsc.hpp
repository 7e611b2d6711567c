// SPDX-License-Identifier: Apache-2.0
// The queue for one producer and one consumer (hal/spsc.hpp) under the name that the runtime has for it.
#pragma once

#include "hal/spsc.hpp"

namespace nc::rt {

using hal::SpscQueue;

}  // namespace nc::rt
