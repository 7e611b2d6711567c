// SPDX-License-Identifier: Apache-2.0
// The plan of the optimal mode as the scan follows it: a chain of cells in a ring. Each knows its start on the path, its motion and how
// long it takes; the last one of a chain lands at rest. Positions, velocities and accelerations are continuous from cell to cell.
#pragma once

#include "motion/optimal/piece.hpp"
#include "motion/optimal/profile.hpp"

namespace nc::optimal {

/// Cells are counted and never begin again: with a thousand a second for as long as there are suns (docs/counters.md). The ring takes its
/// lower bits.
using CellIndex = uint64_t;
inline constexpr CellIndex kNoCell = ~CellIndex{0};

/// PlanCell::before_rest. Both are more than the scan takes for the rounding of a place (nearly() in interpolator_planned.cpp), on a path of any length.
constexpr double kBeforeRest = 2e-7;          ///< mm ...
constexpr double kBeforeRestShare = 1e-12;    ///< ... plus this share of the path length

struct PlanCell {
  /// level: u'' is linear in u. ramp: constant u''', as in the cells from rest and to rest.
  enum class Kind : uint8_t { level, launch, land, ramp };
  double u = 0;  ///< of the whole path, where the cell begins
  double x = 0;  ///< the same within its piece
  double h = 0, seconds = 0;
  double v = 0;       ///< at the start; of a launch at its end
  double a = 0;       ///< u'' at the start
  double w = 0;       ///< b''/2; of a ramp u'''
  float turns = 0;    ///< rev/s of the spindle for which it was planned; kInDryRun: for none
  uint32_t piece = 0;
  Kind kind = Kind::level;
  bool path_ends = false;  ///< the path rests at its end, not the plan alone
  bool before_rest = false;  ///< the plan ends with it, right in front of a place where the path rests
  int8_t turning_axis = -1;  ///< Scales::turning_axis for which it was planned
  static constexpr float kInDryRun = -1;
};

inline float turns_of(const Scales& scale) { return scale.dry.on() ? PlanCell::kInDryRun : static_cast<float>(scale.turns); }

/// Motion `t` seconds after the cell was entered; x from its start.
inline CellState state_in(const PlanCell& c, double t) NC_RT {
  CellState q;
  if (c.kind == PlanCell::Kind::launch) {
    const double j = 2 * c.v / (c.seconds * c.seconds);
    return {j * t * t * t / 6, j * t * t / 2, j * t};
  }
  if (c.kind == PlanCell::Kind::land) {
    const double j = 2 * c.v / (c.seconds * c.seconds), left = std::fmax(0, c.seconds - t);
    return {c.h - j * left * left * left / 6, j * left * left / 2, -j * left};
  }
  if (c.kind == PlanCell::Kind::ramp) return {t * (c.v + t * (c.a / 2 + t * c.w / 6)), c.v + t * (c.a + t * c.w / 2), c.a + t * c.w};
  double s, ds, cc;
  law_functions(c.w, t, &s, &ds, &cc);
  q.x = c.v * s + c.a * cc;
  q.v = c.v * ds + c.a * s;
  q.a = c.a * ds + c.w * c.v * s;
  return q;
}

/// The motion of a cell is known at any time in it, so it may end sooner. Those beside rest are what they are as a whole.
inline bool can_be_cut(const PlanCell& c) { return c.kind == PlanCell::Kind::level || c.kind == PlanCell::Kind::ramp; }

/// Cell k of a law.
inline PlanCell plan_cell(const Law& law, const Mesh& mesh, unsigned k) {
  PlanCell c;
  c.h = mesh.h[k];
  c.seconds = cell_seconds(law, mesh, k);
  c.w = law.half2[k];
  if (k == 0 && mesh.from_rest) {
    c.kind = PlanCell::Kind::launch;
    c.v = std::sqrt(law.b[1]);
  } else {
    c.v = std::sqrt(law.b[k]);
    c.a = 0.5 * law.slope[k];
    if (k + 1 == law.cells) {
      c.kind = PlanCell::Kind::land;
      c.a = -2 * c.v / c.seconds;
    }
  }
  return c;
}

/// Cells and pieces, written by the planner, read by the scan once a proposal has shown them.
struct PlanStore {
  PlanCell* cell = nullptr;
  CellIndex* next = nullptr;  ///< per cell: where the chain goes on; written with the cells, and by the scan where it takes an offer
  Piece* piece = nullptr;
  double* passed = nullptr;  ///< per record: u at its end
  uint32_t cell_mask = 0, piece_mask = 0, record_mask = 0;
  const PlanCell& at(CellIndex k) const { return cell[k & cell_mask]; }
  const Piece& piece_at(uint32_t k) const { return piece[k & piece_mask]; }
};

/// What the planner offers: cells [first, last] behind cell `after`, or for an axis at rest and without a plan (fresh).
struct Proposal {
  uint32_t number = 0;      ///< counts offers
  uint32_t generation = 0;  ///< for a scan that has given up so often
  CellIndex after = kNoCell, first = kNoCell, last = kNoCell;
  CellIndex cuts = kNoCell;  ///< cell `first` is the beginning of this one, behind `after` or in execution: it can be entered until it ends
  bool fresh = false;
  bool failed = false;      ///< no law was found for what follows
  bool stops = false;       ///< the way to rest that was asked for
  CellIndex rests = kNoCell; ///< of the chain that is followed: no way to the rest that was asked for is shorter than up to the end of this cell
  uint32_t end = 0;         ///< ring index behind the last record that is committed
  uint32_t taken = 0;       ///< and behind the last one of which it is known where on the path it ends
};

/// What the scan says of it.
struct Following {
  uint32_t answered = 0;   ///< newest offer that has been looked at
  bool taken = false;      ///< it was
  uint32_t generation = 0;
  CellIndex cell = kNoCell;  ///< in execution, or the last one
  double t = 0;             ///< s in it
  bool at_end = true;       ///< it has been gone to its end
  bool waits = false;       ///< at the start of its first cell, for the spindle
  bool brake = false;       ///< to rest as soon as the limits allow
  Scales scale;
  bool block_rests = false;  ///< at the ends of blocks
  bool halted = false;       ///< it rests on the path, at x of `piece`, and not at the end of a plan
  uint32_t piece = 0;
  double x = 0;
  uint32_t tail = 0;
  double s = 0;             ///< of the record at the tail
  AxisVec machine;
  uint32_t epoch = 0;
};

}  // namespace nc::optimal
