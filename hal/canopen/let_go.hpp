// SPDX-License-Identifier: Apache-2.0
// A signal that asks a spindle to move, as long as it is on. What was on while its drive was off asks for nothing when the drive is on again: whoever acknowledges a
// fault does not start a spindle by that. So the signal must be let go first, or somebody gives a new command.
#pragma once

namespace nc::hal::canopen {

class LetGoFirst {
 public:
  // Once per scan. `may_move`: the drive is on; `anew`: a command that this signal goes by has just been given. Returns whether the signal asks for something.
  bool step(bool on, bool may_move, bool anew = false) noexcept {
    held_ = on && (!may_move || (held_ && !anew));
    return on && !held_;
  }
  // It is on and asks for nothing.
  bool is_held() const noexcept { return held_; }

 private:
  bool held_ = false;
};

}  // namespace nc::hal::canopen
