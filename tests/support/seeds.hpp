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
/// sanitizer finds show after few programs, and each takes ten times as long. With NC_SHORT=1 it is half of `usual`: CI has the whole in the night, and
/// other stages run the first of the same seeds.
inline uint64_t seeds(uint64_t usual, uint64_t sanitized_runs) {
  const uint64_t some = wish("NC_SHORT", 0) != 0 ? (usual + 1) / 2 : usual;
  return wish("NC_SEEDS", sanitized() ? sanitized_runs : some);
}

}  // namespace nc::test
