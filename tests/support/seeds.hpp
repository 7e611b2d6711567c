// SPDX-License-Identifier: Apache-2.0
// How many random programs a test runs: its usual number, fewer in a build with sanitizers, or what the person who starts it wishes.
#pragma once
#include <cstdint>
#include <cstdlib>

namespace nc::test {

/// The number in the environment variable `name`, `otherwise` where there is none.
inline uint64_t wish(const char* name, uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 10) : otherwise;
}

/// True where the tests are run in a build with sanitizers, which is told by their environment (tests/CMakeLists.txt).
inline bool sanitized() {
  const char* sanitizers = std::getenv("NC_SANITIZE");
  return sanitizers != nullptr && *sanitizers != 0;
}

/// NC_SEEDS=10000 runs so many. Otherwise `usual`, and `sanitized_runs` under a sanitizer: what it looks for is in the code and shows in few of
/// them, and each takes ten times as long.
inline uint64_t seeds(uint64_t usual, uint64_t sanitized_runs) {
  return wish("NC_SEEDS", sanitized() ? sanitized_runs : usual);
}

}  // namespace nc::test
