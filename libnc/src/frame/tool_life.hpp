// SPDX-License-Identifier: Apache-2.0
// Tool life management: which tools are registered, and which of a group is to be used (M700 13.5.5, system variables 10.15). The part systems share the
// table (interpret/shared_tables.hpp).
//
// A slot is a tool that is registered; a slot whose group is 0 is free. The tools of a group are used in the order of their slots: one until its life
// has ended, then the next.
#pragma once

#include <cstdint>

namespace nc {

enum class LifeStatus : uint64_t { unused, in_use, ended, error_1, error_2 };

/// What is counted. The life is in minutes, or so many times.
enum class LifeMethod : uint32_t {
  time,
  mounts,
  uses,
  nothing  ///< the manual has no meaning for this value
};

/// M700 10.15, the flags of a tool, 0 to FF: the method is in bits 4 and 5.
struct LifeFlags {
  LifeMethod method = LifeMethod::time;
  uint32_t others = 0;  ///< the other bits, which are only kept
  bool operator==(const LifeFlags&) const = default;
};

/// A tool that is registered. Part systems may write to different members of one tool at the same time, so each member is a word of the journal.
struct ToolLife {
  uint64_t group = 0;  ///< 0 = the slot is free
  uint64_t tool = 0;
  LifeFlags flags;
  LifeStatus status = LifeStatus::unused;
  uint64_t life = 0;   ///< minutes or times, 0 = without end
  double used = 0;     ///< of it
  uint64_t length = 0, radius = 0;  ///< numbers of its offsets
  double auxiliary = 0;             ///< for the machine's own use
  bool is_free() const { return !group; }
  bool is_of(uint64_t a_group) const { return !is_free() && group == a_group; }
  /// It may still be used.
  bool lives() const { return status <= LifeStatus::in_use; }
  bool operator==(const ToolLife&) const = default;
};

/// The members as columns of numbers, in the order of the variables #60501 to #64700.
enum class LifeColumn : uint8_t { group, tool, flags, status, life, used, length, radius, auxiliary };
inline constexpr unsigned kLifeColumns = 9;
static_assert(sizeof(ToolLife) == kLifeColumns * sizeof(uint64_t));

/// Calls visit(member) with the member of a column: a pointer to a uint64_t, LifeFlags, LifeStatus or double of ToolLife.
template <class Visit>
auto visit_column(LifeColumn column, Visit&& visit) {
  switch (column) {
    case LifeColumn::group: return visit(&ToolLife::group);
    case LifeColumn::tool: return visit(&ToolLife::tool);
    case LifeColumn::flags: return visit(&ToolLife::flags);
    case LifeColumn::status: return visit(&ToolLife::status);
    case LifeColumn::life: return visit(&ToolLife::life);
    case LifeColumn::used: return visit(&ToolLife::used);
    case LifeColumn::length: return visit(&ToolLife::length);
    case LifeColumn::radius: return visit(&ToolLife::radius);
    case LifeColumn::auxiliary: break;
  }
  return visit(&ToolLife::auxiliary);
}

/// A member as the number that programs and the host read, and back. The number is in the range of its column.
double life_number(uint64_t value);
double life_number(double value);
double life_number(LifeStatus value);
double life_number(LifeFlags value);
void from_life_number(double number, uint64_t& value);
void from_life_number(double number, double& value);
void from_life_number(double number, LifeStatus& value);
void from_life_number(double number, LifeFlags& value);
double life_number(const ToolLife& tool, LifeColumn column);

inline constexpr unsigned kLifeTools = 200;  ///< tools that can be registered

/// A tool that a part system has selected or mounted: its slot, kLifeTools = none, and the number by which it was registered there then. The table belongs
/// to all part systems: another one may remove this tool, and register a different one in its slot.
struct RegisteredTool {
  uint32_t slot = kLifeTools;
  uint32_t number = 0;
  bool operator==(const RegisteredTool&) const = default;
};

/// The table. Slots count from 0.
struct ToolLives {
  static constexpr unsigned kNone = kLifeTools;  ///< no slot
  ToolLife tool[kLifeTools];

  /// The tool in a slot as it is registered now.
  RegisteredTool registered_in(unsigned slot) const { return slot >= kNone ? RegisteredTool{} : RegisteredTool{slot, static_cast<uint32_t>(tool[slot].tool)}; }
  /// The slot where the tool is registered now: the one from before, else the first one of its number; kNone = it is not registered any more.
  unsigned find(const RegisteredTool& used) const {
    if (used.slot < kNone && !tool[used.slot].is_free() && tool[used.slot].tool == used.number) return used.slot;
    return used.number != 0 ? with_tool(used.number) : kNone;
  }
  /// The group registered first, 0 = none.
  uint64_t first_group() const;
  unsigned registered(uint64_t group) const;              ///< number of its tools
  unsigned nth(uint64_t group, unsigned number) const;    ///< its tool `number`, from 1; kNone = there is none
  unsigned number_in_group(unsigned slot) const;          ///< the other way round
  unsigned free_slot() const;
  unsigned with_tool(uint64_t number) const;              ///< the first slot of a tool number; kNone = none
  /// The tool that a command of its group selects: the first that is in use, else the first unused one, else, all being worn, the last.
  unsigned next_of(uint64_t group) const;
  /// #60003: as next_of(), but the tool in the spindle, a slot or kNone, where it is of the group.
  unsigned current_of(uint64_t group, unsigned in_spindle) const;
  unsigned first_alive(uint64_t group) const;             ///< its first tool that may be used; kNone = none
  bool all_ended(uint64_t group) const { return registered(group) != 0 && first_alive(group) == kNone; }

 private:
  template <class Wanted>
  unsigned first(uint64_t group, Wanted wanted) const {
    for (unsigned slot = 0; slot < kLifeTools; ++slot)
      if (tool[slot].is_of(group) && wanted(tool[slot])) return slot;
    return kNone;
  }
};

}  // namespace nc
