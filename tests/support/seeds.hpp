// SPDX-License-Identifier: Apache-2.0
// How many random programs a test runs: its usual number, fewer in a build with sanitizers, or the number that is asked for.
#pragma once
#include <cstdint>
#include <cstdlib>

namespace nc::test {

/// The number in the environment variable `name`; `otherwise` if it is not set.
inline uint64_t wish(const char* name, uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

/// True in a build with sanitizers: tests/CMakeLists.txt sets NC_SANITIZE in the environment of its tests.
inline bool sanitized() {
  const char* sanitizers = std::getenv("NC_SANITIZE");
  return sanitizers != nullptr && *sanitizers != 0;
}

/// With NC_SEEDS=10000 in the environment it is 10000. Otherwise it is `usual`, or `sanitized_runs` under a sanitizer: the mistakes that a
/// sanitizer finds show after few programs, and each takes ten times as long.
inline uint64_t seeds(uint64_t usual, uint64_t sanitized_runs) {
  return wish("NC_SEEDS", sanitized() ? sanitized_runs : usual);
}

}  // namespace nc::test
