// SPDX-License-Identifier: Apache-2.0
// Says which part programs a cycle start may begin. It is asked for programs at their head only: what runs or is interrupted goes on.
#pragma once

#include <string>

namespace nc::rt {

class StartGate {
 public:
  virtual ~StartGate() = default;
  // Feeder thread, in each of its steps: what it answers holds for the next start.
  virtual bool may_begin(unsigned system, unsigned file) = 0;
  // Looks now whether what may_begin() goes by is still so, and waits for that, for a bounded time: a start that comes right behind a change must not be begun by what was so before
  // it. kDoubtful: a program may not begin, or not any more, so may_begin() has to be asked once more. Any thread but that of the feeder and the scan.
  enum class Looked { kSame, kDoubtful, kNoAnswer };
  virtual Looked look_again() = 0;
  // It is still being found out whether that program may begin. Any thread.
  virtual bool waits(unsigned system) = 0;
  // Why the program that was asked for last may not begin, or what its operator is to know when it begins; "" = nothing. Any thread.
  virtual std::string remark(unsigned system) = 0;
};

}  // namespace nc::rt
