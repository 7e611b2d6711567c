// SPDX-License-Identifier: Apache-2.0
// The work of smooth() and of relax(): knots, control points and cells of one polyline.
#pragma once

#include <algorithm>
#include <cmath>

#include "motion/optimal/relax.hpp"
#include "motion/optimal/smooth.hpp"

namespace nc::optimal {

inline constexpr double kUseMost = 0.98;   ///< of the tolerance, that any of the places may use
inline constexpr double kUseTurn = 0.975;  ///< the same of a sharp corner, which is cut by a depth that is known
inline constexpr double kLeastTurn = 0.6;  ///< of the reach that a corner of long edges would have: with less its curve is no better than other corners
inline constexpr double kLongEdge = 8;     ///< in spacings
inline constexpr unsigned kLooks = 4;      ///< places in a cell, beside the vertices, where the distance is measured
inline constexpr double kOtherFeed = 1.5;   ///< times the lowest feed of the cells that a control point bends: it is fitted up to there
inline constexpr double kUseStart = 0.998; ///< of the tolerance, that the cells behind a border may use: they have to come back to the line
inline constexpr unsigned kStartCells = 3;
inline constexpr unsigned kAtOnce = 32;    ///< vertices or cells, then others may have their turn
/// Added at a knot at a corner that is kept, whose control points lie on the line, too; and the times alone.
inline constexpr unsigned char kCorner = 0x80, kTimes = 0x7f;

/// Of the knots about an edge: it goes by the lines there and by nothing that lies farther away.
double spacing_of(const SmoothRequest& in, const SmoothRoom& room, unsigned edge);

class Smoother {
 public:
  Smoother(const SmoothRequest& request, const SmoothRoom& room, Piece* out, unsigned capacity)
      : in_(request), room_(room), out_(out), capacity_(capacity) {}
  /// All of it, from the first knots on. @return cells, 0 = no room
  Task<unsigned> run(Work& work);
  /// Goes on with the `cells` that run() has made: the first `to` of them are relaxed (relax.cpp).
  Task<bool> relax(Work& work, Relaxation* room, const Relaxing& how, unsigned cells, unsigned to);

 private:
  void set(double u, double apart);
  void fresh(unsigned k);
  void find_feeds(SmoothCell* cell) const;
  void set_corner(double u, double apart);
  void sum_up(unsigned k, unsigned* edge);
  void controls(unsigned from, unsigned to, unsigned* edge);
  bool fits(unsigned j) const;
  struct TurnSides {
    AxisVec before, behind;  ///< q' in front of the corner and behind it
  };
  void set_turn(unsigned vertex, double reach);
  bool of_lines(unsigned vertex, double reach) const;
  TurnSides turn_sides(unsigned vertex, double reach) const;
  double turn_depth(unsigned vertex, double reach) const;
  bool one_feed_beside(unsigned vertex, double way) const;
  bool on_line_before(unsigned vertex, double reach, unsigned last) const;
  bool set_turn_of_lines(unsigned vertex, double most, double of_edges, double* keep);
  void turn_controls(unsigned first);
  void turn_rest(unsigned k, AxisVec* out) const;
  double corner(unsigned k) const;
  Task<bool> first_knots(Work& work);
  void begin_knots();
  void measure(unsigned from, unsigned to);
  void knots(unsigned from, unsigned to);
  void end_knots();
  double spacing(unsigned edge) const;
  void start_controls();
  Task<bool> controls(Work& work);
  void pieces(unsigned from, unsigned to, unsigned* edge);
  Task<bool> pieces(Work& work);
  bool far(unsigned cell, double most, unsigned* vertex, unsigned* edge) const;
  /// A look at the distances of all cells.
  struct Look {
    double kept = 0;  ///< up to here cells are halved only where they must be
    unsigned cell = 0, vertex = 1, edge = 0;
    bool good = true;
  };
  int64_t look_on(Look* look);
  Task<bool> near_enough(Work& work);
  bool in_turn(unsigned k) const { return room_.corner[k] != 0 && room_.corner[k] == room_.corner[k + 1]; }
  bool halved(unsigned k) const { return room_.cell[k].split && !in_turn(k); }  // cells of a sharp corner have their shape
  Task<bool> split(Work& work);
  AxisVec on_line(double u, unsigned* edge) const;
  double distance2(unsigned cell, double u, const AxisVec& p) const;
  double t(int k) const {
    return room_.knot[k < 0 ? 0 : k > static_cast<int>(last_) ? last_ : static_cast<unsigned>(k)];
  }

  bool moves(unsigned j) const;
  void third(unsigned cell, double* out) const;
  void basis(unsigned cell, double x, double* out) const;
  double bend_weight(const Relaxation& room, unsigned cell) const;
  double bending(const Relaxation& room, unsigned from, unsigned count) const;
  bool below_feed(const Relaxation& room, double turns, unsigned from, unsigned to) const;
  Task<bool> fit_steps(Work& work, Relaxation* room, unsigned steps, bool look, unsigned from, unsigned count);
  bool add_cell(unsigned cell, Relaxation* room) const;
  Task<unsigned> begin_fit(Work& work, Relaxation* room, unsigned from, unsigned to) const;
  Task<unsigned> relax_run(Work& work, Relaxation* room, const Relaxing& how, bool first, unsigned from, unsigned to);
  Task<bool> pieces_again(Work& work, unsigned from, unsigned to);
  Task<bool> tightened(Work& work, Relaxation* room, unsigned from, unsigned to);
  Task<bool> relax_once(Work& work, Relaxation* room, const Relaxing& how, bool first, unsigned to);

  const SmoothRequest& in_;
  const SmoothRoom& room_;
  Piece* out_;
  unsigned capacity_;
  unsigned last_ = 0;  ///< index of the last knot
  double grown_ = HUGE_VAL, grown_at_ = 0;  ///< the longest of the last cells that are known, and where they end
  bool full_ = false;
  bool one_feed_ = true;
  // while the first knots are set
  unsigned corners_looked_at_ = 0;  ///< times that the lines beside one were
  double keep_ = 0;     ///< the knots behind a corner stay clear of what follows up to here
  double apart_ = 0;
  unsigned first_ = 1;  ///< vertex that may want one
  unsigned valid_ = 0;  ///< up to this vertex the spacing is as good as the same
};

}  // namespace nc::optimal
