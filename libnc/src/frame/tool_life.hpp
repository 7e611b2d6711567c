// SPDX-License-Identifier: Apache-2.0
// Tool life management: which tools are registered, and which of a group is to be used (M700 13.5.5, system variables 10.15). The data stand in the flat
// table of frame/frames.hpp behind the tool offsets, so that they are shared by the part systems, journalled and kept like these.
//
// A slot is a tool that is registered; a slot whose group is 0 is free. The tools of a group are used in the order of their slots: one until its life
// has ended, then the next.
#pragma once

#include "frame/frames.hpp"

namespace nc {

/// Columns of a slot, in the order of the variables #60501 to #64700.
enum class LifeColumn : uint8_t { group, tool, flags, status, life, used, length, radius, auxiliary };

/// LifeColumn::status.
enum class LifeStatus : uint8_t { unused, in_use, ended, error_1, error_2 };

/// LifeColumn::flags, bits 4 and 5: what is counted. The life is in minutes, or so many times.
enum class LifeMethod : uint8_t { time, mounts, uses };

/// Frames::tool_in_use_key(): the slot, from 1, of the tool in the spindle and of the one that T has selected, 0 = one whose life is not managed;
/// and whether the tool in the spindle has cut in the move before.
enum class ToolInUse : uint8_t { spindle, selected, cutting };

/// A tool's life as it is in a table; the table must outlive it.
class ToolLife {
 public:
  static constexpr unsigned kNone = kLifeTools;

  explicit ToolLife(const Frames& frames) : frames_(frames) {}

  double get(unsigned slot, LifeColumn column) const { return frames_.get(key(slot, column)); }
  unsigned key(unsigned slot, LifeColumn column) const { return frames_.life_key(slot, static_cast<unsigned>(column)); }
  uint32_t group(unsigned slot) const { return static_cast<uint32_t>(get(slot, LifeColumn::group)); }
  LifeMethod method(unsigned slot) const { return static_cast<LifeMethod>(static_cast<unsigned>(get(slot, LifeColumn::flags)) >> 4 & 3); }
  LifeStatus status(unsigned slot) const { return static_cast<LifeStatus>(get(slot, LifeColumn::status)); }
  /// It may still be used.
  bool lives(unsigned slot) const { return status(slot) <= LifeStatus::in_use; }

  /// The slot of the tool in the spindle; kNone = its life is not managed.
  unsigned in_spindle() const { return slot_of(ToolInUse::spindle); }
  unsigned selected() const { return slot_of(ToolInUse::selected); }

  /// The group registered first, 0 = none.
  uint32_t first_group() const;
  unsigned registered(uint32_t of_group) const;              ///< number of its tools
  unsigned nth(uint32_t of_group, unsigned number) const;    ///< its tool `number`, from 1; kNone = there is none
  unsigned number_in_group(unsigned slot) const;             ///< the other way round
  unsigned free_slot() const;
  unsigned with_tool(uint32_t tool) const;                   ///< the first slot of a tool number; kNone = none
  /// The tool that a command of its group selects: the first that is in use, else the first unused one, else, all being worn, the last.
  unsigned next_of(uint32_t of_group) const;
  /// #60003: as next_of(), but the tool in the spindle where it is of the group.
  unsigned current_of(uint32_t of_group) const;
  bool all_ended(uint32_t of_group) const;

 private:
  unsigned slot_of(ToolInUse which) const {
    const double slot = frames_.get(frames_.tool_in_use_key(static_cast<unsigned>(which)));
    return slot >= 1 ? static_cast<unsigned>(slot) - 1 : kNone;
  }
  template <class Wanted>
  unsigned first(uint32_t of_group, Wanted wanted) const {
    for (unsigned slot = 0; slot < kLifeTools; ++slot)
      if (of_group && group(slot) == of_group && wanted(slot)) return slot;
    return kNone;
  }

  const Frames& frames_;
};

}  // namespace nc
