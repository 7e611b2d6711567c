// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "command/code_calls.hpp"

namespace nc {

class Parameters;
struct Dialect;

CodeCalls read_code_calls(const Parameters& parameters, const Dialect& dialect);

}  // namespace nc
