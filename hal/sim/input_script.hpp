// SPDX-License-Identifier: Apache-2.0
// Input script of the simulated machine: statements that change input points at a scan, at a line of the program or at an M
// code.
//
//   at scan 250: part_present = 1
//   when line 12: door_closed = 0          the first time line 12 comes into execution
//   when line 12 #3: door_closed = 1       the third time
//   when M 50 #2: part_present = 0         the second strobe of M50
//
// One statement per entry. Lines are those of the main program (depth 0).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "hal/points.hpp"
#include "nc/types.h"

namespace nc::hal {

struct InputChange {
  enum class When : std::uint8_t { kScan, kLine, kM };
  When when = When::kScan;
  std::uint64_t at = 0;     // scan number, line or M number
  std::uint32_t count = 1;  // the change is made when the line or M code comes for this time
  unsigned point = 0;       // index in the table
  std::uint32_t value = 0;
};

// False with a sentence in *error when the statement cannot be read or the point is not an input.
bool parse_input_change(std::string_view text, const PointTable& table, InputChange* change,
                        std::string* error);

// Executes the changes. All memory is allocated in the constructor; step() is NC_RT.
class InputScript {
 public:
  explicit InputScript(std::vector<InputChange> changes);
  void restart() noexcept;
  // `source` = block in execution (line 0 = none), `m_strobe` = the M strobe is on, with the code `m`.
  void step(std::uint64_t scan, const nc_source& source, bool m_strobe, std::uint32_t m,
            PointImage* image) noexcept;

 private:
  std::vector<InputChange> changes_;
  std::vector<std::uint32_t> seen_;  // for each change the number of times that its line or M code has come
  std::vector<bool> done_;
  std::uint32_t last_line_ = 0;
  bool last_strobe_ = false;
};

}  // namespace nc::hal
