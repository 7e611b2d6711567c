// SPDX-License-Identifier: Apache-2.0
// Coordinate systems and offset tables of one part system.
//
// How positions are composed (M700 13.6, 14.2, 14.5, 14.10, 14.11, 14.13; DGSHAPE G54-G59, G92), from the programmed word to the machine position:
//
//     word      = as programmed; G91: + the previous programmed position          interpret/read_command.cpp, motion.cpp
//     turned    = an angle of G90 as a way on an axis that turns                  frame/rotary.hpp
//     work      = M turned                  M affine: figure, scaling, rotation, mirror, and the rotation about a point of the machine
//                                           where #8627 or G10 K says so; in front of compensation     interpret/program_map.hpp
//     path      = work + radius vector                                            offset/
//     machine   = path + zero(k) + T        T tool length compensation *as applied* to each axis   frame/affine.hpp
//     zero(k)   = E + O(k) + S + L(k)       E external offset, O offset of work system k, S common shift made by G92,
//                                           L local system (G52) held by system k
//     shown     = machine, and work, within one turn where the axis type says so  interpret/position_shown.cpp
//
// G53 and the way to a reference position command `machine` directly: no map, no zero and no compensation acts.
//
// T is applied to an axis when that axis is next commanded (M700 12.2), so it belongs to the state of the position and not to the tables.
//
// All offsets are in one flat table, so that the journal can name any of them by one key.
#pragma once

#include "base/arena.hpp"
#include "stream/stream.hpp"

namespace nc {

/// Columns of the tool table, as in nc_tool_column.
inline constexpr unsigned kToolColumns = 4;

struct FramesConfig {
  unsigned extended_systems = 96;   ///< G54.1 P1..
  unsigned tool_offsets = 200;
};

class Frames {
 public:
  void create(const FramesConfig& config, Arena& arena);

  unsigned extended_systems() const { return config_.extended_systems; }
  unsigned tool_offsets() const { return config_.tool_offsets; }

  /// Number of coordinate systems that are not extended ones.
  static constexpr unsigned kStandardSystems = 6;

  // Keys of the flat table. System numbers: 0..5 = G54..G59, 6.. = G54.1 P1...
  static constexpr unsigned external_key(unsigned axis) { return axis; }
  static constexpr unsigned shift_key(unsigned axis) { return kMaxAxes + axis; }
  static constexpr unsigned local_key(unsigned system, unsigned axis) { return 2 * kMaxAxes + system * kMaxAxes + axis; }
  static constexpr unsigned work_key(unsigned system, unsigned axis) { return local_key(kStandardSystems + system, axis); }
  unsigned tool_key(unsigned number, unsigned column) const { return work_key(kStandardSystems + config_.extended_systems, 0) + (number - 1) * kToolColumns + column; }
  bool is_tool_key(unsigned key) const { return key >= tool_key(1, 0); }
  unsigned size() const { return tool_key(config_.tool_offsets + 1, 0); }

  double get(unsigned key) const { return table_[key]; }
  void set(unsigned key, double value) {
    table_[key] = value;
    cached_system_ = kNoSystem;
  }

  /// zero(k). It is asked for several times in every block and changes rarely, so the last answer is kept.
  const AxisVec& zero(unsigned system) const {
    if (system != cached_system_) compute_zero(system);
    return cached_;
  }
  double zero(unsigned system, unsigned axis) const { return zero(system)[axis]; }

 private:
  static constexpr unsigned kNoSystem = ~0u;
  void compute_zero(unsigned system) const;

  FramesConfig config_;
  double* table_ = nullptr;
  mutable AxisVec cached_;
  mutable unsigned cached_system_ = kNoSystem;
};

}  // namespace nc
