// SPDX-License-Identifier: Apache-2.0
// Records become path: lines that may be passed at speed are gathered and smoothed as far as what follows cannot change them any more;
// arcs and all other curves stay what they are but for a transition where one meets a line or another curve. Pieces that lie in the ring
// are final.
#pragma once

#include "base/arena.hpp"
#include "motion/optimal/plan_cell.hpp"
#include "motion/optimal/relax.hpp"
#include "motion/optimal/transition.hpp"
#include "ring/record.hpp"

namespace nc::optimal {

class PathBuilder {
 public:
  static constexpr unsigned kPieces = 4096;    ///< in the ring
  static constexpr unsigned kVertices = 8192;  ///< that wait to be smoothed

  void create(const Limits& limits, double tolerance, double period, const Record* records, PlanStore* store, Arena& arena);

  /// Takes records from the ring up to `head`, as far as there is room. `wanted`: as much of them becomes path as can, else what is cheaper to be made together
  /// with records that come later waits for these. @return true when there is more path than before.
  Task<bool> take(Work& work, uint32_t head, bool wanted = true);
  /// Nothing more comes for the time being: what waits ends here, at rest.
  Task<bool> finish(Work& work);
  /// From here on anew: nothing is left of the path but the room that records [from, …) take. The first of them is a move that has been gone
  /// to `s`, and the axes stand at `machine`. Records of an epoch before `epoch` are void and no path: the scan, which has not seen all of them
  /// yet, will throw them away.
  void restart(uint32_t from, double s, const AxisVec& machine, double u, uint32_t epoch);
  /// finish() was given up in its midst: the path is as it was before.
  void give_up();

  uint32_t taken() const { return read_; }
  uint32_t head() const { return holds_ ? held_head_ : head_; }  ///< behind the last piece
  /// For tests: records and pieces are counted from here.
  void count_from(uint32_t first) {
    read_ = head_ = tail_ = first;
    oldest_ = first >> 1;
  }
  void free_pieces(uint32_t tail) { tail_ = tail; }
  double start_of(uint32_t piece) const { return start_u_[piece & store_->piece_mask]; }
  double end_u() const { return holds_ ? held_u_ : head_u_; }  ///< of all pieces
  bool uses_turns() const { return uses_turns_; }  ///< a feed per revolution has been met

 private:
  bool joins(const Record& r) const;
  /// Epochs have 31 bits (interpolate/run_word.hpp).
  bool is_void(const Record& r) const { return static_cast<int32_t>((r.epoch - oldest_) << 1) < 0; }
  Task<bool> part(Work& work, const Record& r, bool moves);
  /// What is to be done before more records can be gathered. `curve`: the next one is a curve or lies behind one, which takes longer.
  enum class Next : uint8_t { go_on, line_full, settle, close, no_room, nothing, curve };
  Next gather(Work& work, uint32_t head);
  void hold();
  Task<Next> take_beside_curve(Work& work, bool* more);
  Task<Next> part_and_add(Work& work, const Record& r, bool* more);
  Task<Next> add(Work& work, const Record& r, bool* more);
  Next room_for_line() const;
  Next gather_line(const Record& r);
  void add_line(const Record& r);
  double tap_share(const Segment& s) const;
  void rest_unless_it_flows(const Record& r, bool moves);
  Task<bool> add_curve(Work& work, const Record& r);
  Task<bool> add_arc(Work& work, const Record& r);
  Task<bool> end_arc(Work& work);
  Task<bool> leave_arc(Work& work, const JointSide& after, double most, double feed);
  Task<bool> push_arc(Work& work, double to);
  Task<bool> push_curve(Work& work, const Piece& whole, const Segment& s);
  double feed_between(const Segment& s, double from, double to) const;
  double own_speed(const Curve& curve, double from, double to) const;
  bool turns_far(const Curve& curve, double from, double to) const;
  void push_straight(const Curve& curve, double from, double to, const Piece& like);
  bool uneven(const Curve& curve, double from, double to, double feed) const;
  void meet_arc(const Segment& s);
  void part_at_joint();
  bool resumes(const Segment& s) const;
  void go_there(const AxisVec& to, const Piece& curve);
  unsigned straight();
  Task<unsigned> smoothed(Work& work, bool whole, unsigned count, SmoothRequest* request);
  Task<bool> relaxed(Work& work, const SmoothRequest& request, unsigned cells, unsigned to);
  Task<bool> give_settled(Work& work);
  bool meets_arc_badly(unsigned cells);
  Task<bool> close_line(Work& work, unsigned cells);
  void forget_line();
  Task<bool> smooth_line(Work& work, bool whole);
  Task<bool> close_smooth_line(Work& work);
  Task<bool> exact_line(Work& work, bool whole);
  bool one_edge();
  bool turns_at(unsigned vertex) const;
  void drop(unsigned vertices);
  bool worthwhile() const;
  bool gathered() const;
  Task<bool> give_out(Work& work, unsigned count, bool rest);
  void go_on(const Border& border);
  void begin_line(const AxisVec& at, double u);
  void push_piece(const Piece& piece);
  void join_piece(const Piece& piece);
  void push_transition(double feed);
  bool room(unsigned pieces) const { return head_ - tail_ + pieces < kPieces; }
  static bool passes(const Segment& s) { return !s.rapid && !s.skip && !(s.begun > 0) && s.tap_rev_per_mm == 0; }
  static bool straight_line(const Segment& s) { return !s.curve.circular && s.curve.shape == nullptr; }

  static constexpr unsigned kPiecesOfCurve = 100, kOfArc = kPiecesOfCurve + 20;  ///< the second: and of its transition
  static constexpr double kNothing = 1e-12;  ///< mm, of a curve between two transitions

  Limits limits_;
  double tolerance_ = 0.01, period_ = 0.005;
  const Record* records_ = nullptr;
  PlanStore* store_ = nullptr;
  double* start_u_ = nullptr;

  uint32_t read_ = 0;        ///< next record to be taken
  uint32_t head_ = 0, tail_ = 0;
  double head_u_ = 0;        ///< where the pieces end
  double line_u_ = 0;        ///< where the gathered line ends

  // the line that is gathered
  AxisVec* vertex_ = nullptr;
  double *length_ = nullptr, *feed_ = nullptr;
  unsigned count_ = 0;       ///< vertices; 0: none is open
  unsigned tried_ = 0;       ///< vertices when it was smoothed last
  FeedBy by_ = FeedBy::override;
  DigitFeed digit_;
  uint32_t epoch_ = 0;
  uint32_t oldest_ = 0;      ///< epoch of records that are not void
  bool uses_turns_ = false;
  bool flows_ = false;       ///< the last piece is of a rapid traverse behind which the path may go on at speed
  bool closing_ = false;     ///< it ends at its last vertex, whatever comes
  double line_start_u_ = 0;  ///< of vertex 0
  bool goes_on_ = false;
  bool beside_ = false;      ///< its first edge leads from where the axes stand, which is within the tolerance of the line
  CurvePoint at_;            ///< where the pieces of this line end, when it goes on
  Border border_;
  double hidden_ = 0;        ///< of the first edge, in front of it
  bool resumed_ = false;     ///< the next record has been gone in part
  double resumed_s_ = 0;
  AxisVec resumed_at_;

  // where curves meet
  struct Arc {
    const Curve* curve = nullptr;  ///< the end of this arc is not given out yet
    const Segment* segment = nullptr;
    double from = 0;               ///< but for what lies in front of this
    double zone = 0;               ///< from here on it has a feed of its own
    double feed = 0, slow_feed = 0;
  };
  Arc arc_;
  // Pieces that are given out in slices show when all of them are there, and it is known where their record ends.
  bool holds_ = false;
  uint32_t held_head_ = 0;
  double held_u_ = 0;
  Arc held_arc_;
  double begins_ = 0;          ///< so much of the next record, an arc, lies in a transition
  double cut_ = 0;             ///< the same of the first edge of the gathered line
  bool joined_start_ = false;  ///< the gathered line begins at speed behind an arc
  Joint joint_;                ///< the gathered line ends where the transition begins
  JointSide joint_line_, joint_arc_;
  Transition* made_ = nullptr;  ///< room for one
  double joint_feed_ = 0;

  SmoothRoom room_;
  Relaxation* relaxation_ = nullptr;
  Piece* out_ = nullptr;
  static constexpr unsigned kKnots = 2048;
};

}  // namespace nc::optimal
