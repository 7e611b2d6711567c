// SPDX-License-Identifier: Apache-2.0
// Numbers that a program leaves for later blocks and that are too many for the state, which is copied at every block: modal macro calls
// with their arguments, figure rotation, the interrupt program, centres of mirror,
// scaling and rotation. One flat table like the offsets' (frame/frames.hpp):
// every write is journalled under the block that made it, so a rewind takes it back.
#pragma once

#include "base/arena.hpp"
#include "macro/variables.hpp"

namespace nc {

class Notes {
 public:
  // ---- modal macro calls (M700 13.5.1): numbered slots, 1..kSlots; 0 = none
  static constexpr unsigned kSlots = 8;
  enum Slot : unsigned {
    kFile, kNumber, kOffset, kLine,  ///< the program called
    kRepeats,                        ///< L
    kEveryBlock,                     ///< 1: G66.1, 0: G66
    kBelow,                          ///< slot of the call that was in force before
    kDepth,                          ///< of the program that commanded it
    kByCode,                         ///< 1: commanded by a registered code
    kArgument,                       ///< 33 values, NaN = vacant
    kSlotSize = kArgument + kLocals
  };
  static constexpr unsigned slot_key(unsigned slot, unsigned what) { return (slot - 1) * kSlotSize + what; }

  // ---- figure rotation (M700 13.3.3)
  enum Figure : unsigned { kCenterH, kCenterV, kStartH, kStartV, kStep, kAngle, kFigureSize };
  static constexpr unsigned figure_key(unsigned what) { return kSlots * kSlotSize + what; }

  // ---- macro interrupt (M700 13.12): the program of M96
  enum Interrupt : unsigned { kInterruptFile, kInterruptNumber, kInterruptOffset, kInterruptLine, kInterruptBegin, kInterruptBeginLine, kInterruptSize };
  static constexpr unsigned interrupt_key(unsigned what) { return figure_key(kFigureSize) + what; }

  // ---- mirror image by program (M700 13.6): centre of each axis
  static constexpr unsigned mirror_key(unsigned axis) { return interrupt_key(kInterruptSize) + axis; }

  // ---- scaling (M700 13.19): centre of each axis, then the factor; coordinate rotation (13.20)
  static constexpr unsigned scaling_key(unsigned what) { return mirror_key(kMaxAxes) + what; }
  enum Rotation : unsigned { kRotationH, kRotationV, kRotationAngle, kRotationSize };  ///< centre in workpiece coordinates; deg
  static constexpr unsigned rotation_key(unsigned what) { return scaling_key(kMaxAxes + 1) + what; }

  // ---- mirror image by switch: where each axis stood when the program began, machine coordinates
  static constexpr unsigned switch_mirror_key(unsigned axis) { return rotation_key(kRotationSize) + axis; }

  /// Keys of the three maps of the program, one behind the other from mirror_key(0) on.
  static constexpr unsigned kMapSize = kMaxAxes + kMaxAxes + 1 + kRotationSize;

  // ---- what #100000-#100002 and #100100-#100103, #60000 select (M700 13.5.5)
  enum Select : unsigned { kParameter, kPart, kAxis, kDevice, kDeviceNumber, kBytes, kBit, kToolGroup, kSelectSize };
  static constexpr unsigned select_key(unsigned what) { return switch_mirror_key(kMaxAxes) + what; }

  // ---- rotation by parameter (M700 13.21): as commanded, and the one that the axes have reached
  enum WorkRotation : unsigned { kTurnCommanded, kTurnReached };
  enum Turn : unsigned { kTurnAngle, kTurnH, kTurnV, kTurnAxisH, kTurnAxisV, kTurnSize };  ///< deg; centre in machine coordinates; axes, -1 = none
  static constexpr unsigned work_rotation_key(unsigned which, unsigned what) { return select_key(kSelectSize) + which * kTurnSize + what; }
  static constexpr unsigned kSize = kSlots * kSlotSize + kFigureSize + kInterruptSize + kMapSize + kMaxAxes + kSelectSize + 2u * kTurnSize;

  void create(Arena& arena) { table_ = arena.make<double>(kSize); }
  double get(unsigned key) const { return table_[key]; }
  void set(unsigned key, double value) {
    table_[key] = value;
    ++changes_;
  }
  /// How often anything has been written: what is made of notes holds as long as this stays.
  uint64_t changes() const { return changes_; }
  void clear() {
    ++changes_;
    for (unsigned i = 0; i < kSize; ++i) table_[i] = 0;
  }

 private:
  double* table_ = nullptr;
  uint64_t changes_ = 0;
};

}  // namespace nc
