// SPDX-License-Identifier: Apache-2.0
// Cuts pieces of path into the cells of a time law: about `period` seconds each at the speed that is to be
// expected, which a pass forward and one backward estimate with the limits along the path alone.
#pragma once

#include "motion/optimal/time_law.hpp"

namespace nc::optimal {

/// A place on the path.
struct PathPlace {
  unsigned piece = 0;
  double x = 0;
};

/// A law that was found before from the same start: where a feed has become lower, no faster than it.
struct WayDown {
  const double* u = nullptr;  ///< from the start on, rising
  const double* b = nullptr;
  unsigned count = 0;
  double at(double place) const;
};

/// The law that is followed, at the start of the new one (place 0) and at ends of its cells behind that, to its rest: there the new one may
/// leave it.
struct Followed {
  static constexpr unsigned kMost = 96;
  struct At {
    double s = 0, seconds = 0, v = 0, a = 0;  ///< way and time from the start
  };
  At at[kMost];
  unsigned count = 0;
  At end;  ///< where it rests
};

/// A cell of it: from s on, u'^2 = b + 2 a x + w x^2.
struct FollowedCell {
  double s = 0, h = 0, b = 0, a = 0, w = 0;
  /// The control value of a part of it.
  double control(double x, double length) const { return b + 2 * a * x + w * x * x + (a + w * x) * length; }
};

inline constexpr unsigned kFirstCells = 12;

struct MeshRequest {
  const Piece* piece = nullptr;  ///< piece k is piece[(base + k) & mask]
  uint32_t base = 0, mask = ~0u;
  unsigned count = 0;
  const Piece& at(unsigned k) const { return piece[(base + k) & mask]; }
  double reach = HUGE_VAL;  ///< of the parameter behind `from`: the path ends there at the latest
  const WayDown* down = nullptr;
  const Followed* followed = nullptr;
  PathPlace from;
  double period = 0.005;      ///< s
  double guess = 0.7;         ///< of the estimated speed, to begin with
  unsigned most = kMaxCells;  ///< cells
  bool from_rest = true;
  double b0 = 0, slope0 = 0;
  /// Lengths of the first cells: those of the law that the start is taken from, which is feasible on them.
  double first_h[kFirstCells] = {};
  unsigned first_cells = 0;
  /// Of a stop: the law that is followed. Cells end where its cells do, and it is what the solver begins with.
  const FollowedCell* chain = nullptr;
  unsigned chain_cells = 0;
  double stop_a = 0, stop_j = 0;  ///< acceleration and jerk along the path with which it may come to rest
};

class Mesher {
 public:
  /// Fills mesh from `from` to the end of the pieces, or as far as it reaches. @return the place where it
  /// ends (at rest).
  Task<PathPlace> build(Work& work, const MeshRequest& request, const Limits& limits, Mesh* mesh);
  /// Of cell k of the mesh built last.
  const PathPlace& place(unsigned k) const { return place_[k]; }
  bool whole() const { return whole_; }  ///< it reaches the end of the pieces
  double least_seconds() const { return least_s_; }  ///< of the mesh built last, at the speeds that were estimated: no law is faster

 private:
  static constexpr unsigned kNodes = 4 * kMaxCells;
  struct Bound {
    double speed, acceleration, jerk;
    double cell;  ///< length: arcs are cut small enough to be nearly cubics
    bool curved;
  };
  struct Node {
    double u, v;
  };
  struct Track {
    Node node[kNodes];
    unsigned count = 0;
  };

  Bound bound_of(const Piece& p, double from) const;
  const Bound& bound(unsigned piece) const { return bound_[piece - in_->from.piece]; }
  Task<bool> forward(Work& work);
  Task<bool> backward(Work& work, unsigned end_piece, double end);
  double speed_at(const Track& track, double u, unsigned* hint) const;
  double estimate(double u);
  double slow_enough(double h, const Bound& bound, bool starts) const;
  /// On the way along the path while cells are laid.
  struct Walk {
    double u = 0, edge = 0;  ///< edge: where the piece ends
    PathPlace at;
    double end = 0, launch = 0, landing = 0;
    unsigned chain = 0;  ///< the cell of what is followed that lies there
    bool alone = false;  ///< a straight line by itself
    bool ended = false;
  };
  Walk begin_cells(double end, bool fine) const;
  double next_joint(double u, double h, Walk* walk) const;
  double stop_guess(double u, double h, const Walk& walk) const;
  void cells(Walk* walk, unsigned count);
  Task<bool> cells(Work& work, double end, bool fine);
  static double step_time(double v, double a, const Bound& bound, double period);
  static double step_way(double v, double a, double t, const Bound& bound);
  double cap_of(const Piece& p, const CurvePoint& q, double u) const;
  void fill_knot(unsigned k, double u, CurvePoint* q);
  Task<bool> fill_knots(Work& work);
  bool can_be_level(unsigned cell) const;
  Task<bool> find_levels(Work& work);
  void level_between(unsigned from, unsigned to);

  const MeshRequest* in_ = nullptr;
  const Limits* limits_ = nullptr;
  Mesh* mesh_ = nullptr;
  Track forward_, backward_;
  double end_u_ = 0;
  Bound bound_[kMaxCells + 1];  ///< of the pieces that forward() has met
  unsigned end_piece_ = 0;
  unsigned hint_f_ = 0, hint_b_ = 0;
  bool whole_ = false;
  double least_s_ = 0;
  PathPlace place_[kMaxCells + 1];
};

}  // namespace nc::optimal
