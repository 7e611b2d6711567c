// SPDX-License-Identifier: Apache-2.0
// The bytes are the decisions of a session (tests/operator/session.hpp): which machine, which program, what the operator does and when.
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "operator/session.hpp"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  nc::test::Dice dice(data, size);
  nc::test::Session session(dice, {.passages = 3, .cycles = 800});
  const std::string what = session.run();
  if (what.empty()) return 0;
  std::fprintf(stderr, "ERROR: %s\n%s\n", what.c_str(), session.text().c_str());
  std::abort();
}
