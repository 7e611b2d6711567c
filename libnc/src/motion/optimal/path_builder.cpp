// SPDX-License-Identifier: Apache-2.0
#include "motion/optimal/path_builder.hpp"
#include "base/same_place.hpp"
#include "base/units.hpp"

#include <algorithm>
#include <cmath>

#include "path/shape.hpp"

namespace nc::optimal {
namespace {

constexpr double kLeastLength = 1e-6;  ///< mm: what is left of a record is taken to be at least so long
constexpr unsigned kOfRing = 32;  ///< the ring of records holds the lines for at least so many knots
constexpr unsigned kWorthwhile = 16;  ///< a line is smoothed again when at least so many vertices more have come ...
constexpr unsigned kOfWaiting = 5;  ///< ... and one for so many of those that wait already
// The same while more records lie in the ring, or nobody waits for the path: what has been smoothed and is not settled is smoothed once more, so twice as many
// vertices come together first, and so many at least and at most.
constexpr unsigned kOfUnsettled = 2, kGathered = 64, kMostGathered = 1024;
constexpr unsigned kFewest = 3;  ///< where more vertices would need too many knots, fewer are smoothed at once, but at least so many
constexpr unsigned kAhead = 128;       ///< vertices that are gathered while there is no room for their pieces
constexpr unsigned kMostAtOnce = 512;  ///< one smoothing makes at most so many pieces
constexpr double kBeside = 1e-6;  ///< a curve keeps away from its cusp by this much, in mm, or by this part of its length where it is longer than 1 mm
constexpr double kLongestReach = 10;  ///< mm: a transition reaches no farther
constexpr double kPeriodsApart = 1.5;  ///< periods of the feed from knot to knot, where the tolerance lets them be so far apart
constexpr double kTurns = 50;          ///< rev/s, for such a spacing: the spindle may have another speed when the path is gone
constexpr double kMostSpeed = 1e4;  ///< mm/s: at a higher speed knots lie no farther apart
constexpr double kCollinear = 1e-9;  ///< where |t2 - t1| is no larger than this there is no corner, and lines are followed exactly
constexpr double kSameSlope = 1e-6;  ///< q' may differ by this much, and q'' by this part of itself, where pieces meet
constexpr double kRounding = 1e-14;  ///< a place is rounded by this part of itself, which q'' shows divided by the square of the length of a piece
constexpr double kLeastBend = 1;  ///< 1/mm: the difference of q'' is compared with at least so much
constexpr unsigned kRecords = 64;  ///< records that are taken before others may have their turn
// Instructions: of so many records, of a line that is gathered, of a curve and its transition, and of a piece that is given out.
constexpr int64_t kRecordsCost = 2000, kLineCost = 150, kCurveCost = 40000, kPieceCost = 400;

bool demands_rest(const Record& r) {
  if (r.kind == ItemKind::action) return r.action.kind == NC_ACTION_MESSAGE;
  return r.kind == ItemKind::gate || r.kind == ItemKind::sync || r.kind == ItemKind::alarm || r.kind == ItemKind::end;
}

bool is_move(const Record& r) { return r.kind == ItemKind::move && r.segment.curve.length > 0; }

/// Feed of a line under no override, and what it goes with.
double feed_of_segment(const Segment& s, FeedBy* by) {
  *by = s.thread                       ? FeedBy::spindle
        : s.skip_speeds != nullptr     ? FeedBy::signals
        : s.skip || s.fixed_override   ? (s.feed_mm_rev > 0 ? FeedBy::fixed_turns : FeedBy::constant)
        : s.feed_mm_rev > 0            ? FeedBy::turns
        : s.digit_step_mm_s > 0        ? FeedBy::digit
                                       : FeedBy::override;
  if (s.skip_speeds != nullptr) return s.start_feed_mm_s;
  return s.feed_mm_rev > 0 ? s.feed_mm_rev : s.feed_mm_s;
}

/// F1 to F5: what the handle does to the feed of a segment.
DigitFeed digit_of(const Segment& s) {
  if (!(s.digit_step_mm_s > 0)) return {};
  return {static_cast<uint8_t>(s.feed_digit - 2), s.digit_step_mm_s, s.digit_most_mm_s};
}

/// The lowest feed of a segment, which may have another one at its end (M700 6.11, 7.10).
double least_feed(const Segment& s) {
  FeedBy by;
  const double feed = s.feed_end_mm_s > 0 ? std::min(s.feed_mm_s, s.feed_end_mm_s) : feed_of_segment(s, &by);
  return s.slow_zone > 0 ? std::min(feed, feed * static_cast<double>(s.slow_factor)) : feed;
}

}  // namespace

void PathBuilder::create(const Limits& limits, double tolerance, double period, const Record* records, PlanStore* store, Arena& arena) {
  limits_ = limits;
  tolerance_ = tolerance;
  period_ = period;
  records_ = records;
  store_ = store;
  store->piece = arena.make<Piece>(kPieces);
  store->piece_mask = kPieces - 1;
  start_u_ = arena.make<double>(kPieces);
  vertex_ = arena.make<AxisVec>(kVertices);
  length_ = arena.make<double>(kVertices);
  feed_ = arena.make<double>(kVertices);
  room_.u = arena.make<double>(kVertices);
  room_.vertices = kVertices;
  room_.knot = arena.make<double>(kKnots);
  room_.control = arena.make<AxisVec>(kKnots + 3);
  room_.corner = arena.make<unsigned>(kKnots);
  room_.cell = arena.make<SmoothCell>(kKnots);
  room_.knots = kKnots;
  relaxation_ = Relaxation::create(kKnots, arena);
  out_ = arena.make<Piece>(kKnots);
  made_ = arena.make<Transition>();
}

void PathBuilder::restart(uint32_t from, double s, const AxisVec& machine, double u, uint32_t epoch) {
  oldest_ = epoch;
  read_ = from;
  tail_ = head_;
  head_u_ = line_u_ = u;
  forget_line();
  closing_ = flows_ = false;
  arc_.curve = nullptr;
  holds_ = false;
  joint_ = {};
  begins_ = 0;
  resumed_ = true;
  resumed_s_ = s;
  resumed_at_ = machine;
}

/// Pieces that do not go on in one another have a rest between them. The last piece may be known to the planner already; but what it has
/// planned ends at rest there, because nothing lay behind.
void PathBuilder::join_piece(const Piece& piece) {
  Piece& last = store_->piece[(head_ - 1) & store_->piece_mask];
  if (last.rest_behind) return;
  const CurvePoint a = evaluate(last, last.length, limits_.axis_count), b = evaluate(piece, 0, limits_.axis_count);
  const double shorter = std::min(last.length, piece.length);
  for (unsigned i = 0; i < limits_.axis_count; ++i) {
    const double bend = std::max(std::fabs(a.d2[i]) + std::fabs(b.d2[i]), kLeastBend);
    const double most = kSameSlope * bend + kRounding * (1 + std::fabs(a.position[i])) / (shorter * shorter);
    if (std::fabs(a.position[i] - b.position[i]) > kJoined || std::fabs(a.d1[i] - b.d1[i]) > kSameSlope || std::fabs(a.d2[i] - b.d2[i]) > most) {
      last.rest_behind = true;
      return;
    }
  }
}

void PathBuilder::push_piece(const Piece& piece) {
  if (head_ != tail_) join_piece(piece);
  Piece& pushed = store_->piece[head_ & store_->piece_mask];
  pushed = piece;
  if (!piece.rapid) pushed.dry = may_be_dry(piece.by);
  start_u_[head_ & store_->piece_mask] = head_u_;
  head_u_ += piece.length;
  ++head_;
}

void PathBuilder::begin_line(const AxisVec& at, double u) {
  vertex_[0] = at;
  hidden_ = 0;
  count_ = 1;
  tried_ = 0;
  line_start_u_ = line_u_ = u;
  goes_on_ = false;
}

/// The record goes on where the gathered line or the open arc ends, at speed.
bool PathBuilder::joins(const Record& r) const {
  const Segment& s = r.segment;
  if ((count_ < 2 && arc_.curve == nullptr) || !passes(s) || s.rest_before || r.epoch != epoch_) return false;
  FeedBy by;
  feed_of_segment(s, &by);
  if (by != by_ || !(digit_of(s) == digit_)) return false;
  const AxisVec& end = arc_.curve != nullptr ? arc_.curve->end : vertex_[count_ - 1];
  for (unsigned i = 0; i < limits_.axis_count; ++i)
    if (std::fabs(s.curve.start[i] - end[i]) > kJoined) return false;
  return true;
}

/// What waits is smoothed again each time, so more of it has to come before that pays.
bool PathBuilder::worthwhile() const {
  return count_ >= tried_ + std::max(tried_ / kOfWaiting, kWorthwhile);
}

bool PathBuilder::gathered() const {
  return count_ >= tried_ + std::min(std::max(kOfUnsettled * tried_, kGathered), kMostGathered);
}

void PathBuilder::add_line(const Record& r) {
  const Segment& s = r.segment;
  double length = s.curve.length;
  if (count_ == 0 && cut_ > 0) {
    const JointSide line = line_through(s.curve.start, s.curve.start, s.curve.end, length, limits_.axis_count);
    begin_line(line.at(cut_, limits_.axis_count).position, head_u_);
    length -= cut_;
  } else if (count_ == 0) {
    const bool from_machine = resumes(s);
    begin_line(from_machine ? resumed_at_ : s.curve.start, head_u_);
    epoch_ = r.epoch;
    beside_ = from_machine;
    if (from_machine) length = std::max(length - resumed_s_, kLeastLength);
    resumed_ = false;
  }
  const double feed = feed_of_segment(s, &by_);
  digit_ = digit_of(s);
  uses_turns_ |= goes_by_spindle(by_);
  const double zone = s.slow_zone > 0 ? std::min(static_cast<double>(s.slow_zone), length) : 0;
  const auto add = [&](const AxisVec& to, double l, double f) {
    vertex_[count_] = to;
    length_[count_ - 1] = l;
    feed_[count_ - 1] = f;
    ++count_;
    line_u_ += l;
  };
  if (zone > 0 && zone < length) {  // M700 7.10: the end of the line has a feed of its own
    AxisVec middle;
    for (unsigned i = 0; i < limits_.axis_count; ++i)
      middle[i] = s.curve.end[i] - (s.curve.end[i] - vertex_[count_ - 1][i]) * (zone / length);
    add(middle, length - zone, feed);
    add(s.curve.end, zone, feed * static_cast<double>(s.slow_factor));
  } else {
    add(s.curve.end, length, zone > 0 ? feed * static_cast<double>(s.slow_factor) : feed);
  }
}

/// The axes stand within the tolerance of where the record goes on.
bool PathBuilder::resumes(const Segment& s) const {
  if (!resumed_) return false;
  const AxisVec at = resumed_s_ > 0 ? curve_position(s.curve, resumed_s_, limits_.axis_count) : s.curve.start;
  for (unsigned i = 0; i < limits_.axis_count; ++i)
    if (std::fabs(at[i] - resumed_at_[i]) > kJoined + 2 * tolerance_) return false;
  return true;
}

/// From where the axes stand to where a curve goes on, which is never farther than the tolerance.
void PathBuilder::go_there(const AxisVec& to, const Piece& curve) {
  double length2 = 0;
  for (unsigned i = 0; i < limits_.axis_count; ++i) length2 += (to[i] - resumed_at_[i]) * (to[i] - resumed_at_[i]);
  if (!(length2 > kJoined * kJoined)) return;
  Piece p;
  p.feed = curve.feed;
  p.by = curve.by;
  p.digit = curve.digit;
  p.length = std::sqrt(length2);
  p.rest_behind = true;
  for (unsigned i = 0; i < limits_.axis_count; ++i) {
    p.c[0][i] = resumed_at_[i];
    p.c[1][i] = (to[i] - resumed_at_[i]) / p.length;
  }
  push_piece(p);
}

/// What is pushed from now on does not show until holds_ is false again.
void PathBuilder::hold() {
  held_head_ = head_;
  held_u_ = head_u_;
  held_arc_ = arc_;
  holds_ = true;
}

void PathBuilder::give_up() {
  if (!holds_) return;
  head_ = held_head_;
  head_u_ = held_u_;
  arc_ = held_arc_;
  holds_ = false;
}

/// Gives out the open arc up to `to`.
Task<bool> PathBuilder::push_arc(Work& work, double to) {
  Piece p;
  p.curve = arc_.curve;
  p.by = by_;
  p.digit = digit_;
  for (const double end : {std::min(to, arc_.zone), to}) {
    p.length = end - arc_.from;
    if (!(p.length > kNothing)) continue;
    p.feed = arc_.from < arc_.zone ? arc_.feed : arc_.slow_feed;
    p.curve_from = arc_.from;
    co_await push_curve(work, p, *arc_.segment);
    arc_.from = end;
  }
  co_return true;
}

/// An arc, or another curve, that may be passed at speed at both ends. Its last part waits for what comes behind it.
Task<bool> PathBuilder::add_arc(Work& work, const Record& r) {
  const Segment& s = r.segment;
  const double length = s.curve.length;
  const bool from_machine = begins_ == 0 && resumes(s);
  arc_.curve = &s.curve;
  arc_.segment = &s;
  arc_.from = std::min(from_machine ? resumed_s_ : begins_, length - kLeastLength);
  arc_.feed = feed_of_segment(s, &by_);
  digit_ = digit_of(s);
  arc_.slow_feed = s.slow_zone > 0 ? arc_.feed * static_cast<double>(s.slow_factor) : arc_.feed;
  arc_.zone = s.slow_zone > 0 ? std::max(length - static_cast<double>(s.slow_zone), 0.0) : length;
  uses_turns_ |= goes_by_spindle(by_);
  epoch_ = r.epoch;
  if (from_machine) {
    Piece p;
    p.feed = arc_.feed;
    p.by = by_;
    p.digit = digit_;
    go_there(curve_position(s.curve, arc_.from, limits_.axis_count), p);
  }
  resumed_ = false;
  begins_ = 0;
  line_u_ = head_u_ + length - arc_.from;
  double settled = length - std::min(0.5 * length, kLongestReach);
  const double beside = kBeside * std::max(length, 1.0);
  if (s.curve.shape != nullptr && turns_far(s.curve, settled - beside, settled + beside)) settled -= 4 * beside;  // not on a cusp
  co_await push_arc(work, std::max(arc_.from, settled));
  if (s.exact_stop) co_await end_arc(work);
  co_return true;
}

/// The open arc to its end, at rest.
Task<bool> PathBuilder::end_arc(Work& work) {
  co_await push_arc(work, arc_.curve->length);
  store_->piece[(head_ - 1) & store_->piece_mask].rest_behind = true;
  arc_.curve = nullptr;
  head_u_ = line_u_;
  co_return true;
}

/// The transition round the end of the newest record.
void PathBuilder::push_transition(double feed) {
  for (unsigned k = 0; k < made_->count; ++k) {
    Piece& p = made_->piece[k];
    p.feed = feed;
    p.by = by_;
    p.digit = digit_;
    push_piece(p);
  }
  head_u_ = line_u_ + joint_.reach;
}

/// The open arc and the transition into what comes behind it, of which it may take `most`. False when there is none: the path rests.
Task<bool> PathBuilder::leave_arc(Work& work, const JointSide& after, double most, double feed) {
  const JointSide before = arc_end(*arc_.curve);
  const double left = arc_.curve->length - arc_.from;
  joint_ = find_joint(before, after, std::min(most, left), tolerance_, limits_.axis_count, made_);
  co_await work.pause(kCurveCost);
  if (!joint_.found) {
    co_await end_arc(work);
    co_return false;
  }
  co_await push_arc(work, arc_.curve->length - joint_.reach);
  head_u_ = line_u_ - joint_.reach;
  if (joint_.reach > 0) {
    make_transition(joint_, before.at(-joint_.reach, limits_.axis_count), after, limits_.axis_count, made_);
    push_transition(std::min({arc_.feed, arc_.slow_feed, feed}));
  }
  arc_.curve = nullptr;
  co_return true;
}

/// The gathered line ends where the transition into the arc begins.
void PathBuilder::meet_arc(const Segment& s) {
  const double length = length_[count_ - 2];
  AxisVec& end = vertex_[count_ - 1];
  joint_line_ = line_through(end, vertex_[count_ - 2], end, length, limits_.axis_count);
  joint_arc_ = arc_start(s.curve);
  joint_feed_ = std::min(feed_[count_ - 2], least_feed(s));
  // Half of the edge; what is final of the smoothed line stays.
  const double most = std::min({0.5 * (count_ == 2 ? length + cut_ : length), 0.5 * s.curve.length, kLongestReach, length});
  joint_ = find_joint(joint_line_, joint_arc_, most, tolerance_, limits_.axis_count, made_);
  length_[count_ - 2] -= joint_.reach;
  end = joint_line_.at(-joint_.reach, limits_.axis_count).position;
}

/// The line rests where it meets the arc.
void PathBuilder::part_at_joint() {
  length_[count_ - 2] += joint_.reach;
  vertex_[count_ - 1] = joint_line_.place;
  joint_ = {};
}

/// A synchronous tap accelerates no faster than its spindle can: on the axes that it moves, that is a part of what they could.
double PathBuilder::tap_share(const Segment& s) const {
  double share = 1;
  for (unsigned i = 0; s.tap_acceleration > 0 && i < limits_.axis_count; ++i) {
    const double along = std::fabs(s.curve.delta[i]) / s.curve.length;
    if (along > 0 && limits_.acceleration[i] > 0) share = std::min(share, s.tap_acceleration * along / limits_.acceleration[i]);
  }
  return share;
}

/// What is not passed at speed: from rest to rest (two pieces with a slow zone).
Task<bool> PathBuilder::add_curve(Work& work, const Record& r) {
  const Segment& s = r.segment;
  const bool from_machine = resumes(s);
  const double from = from_machine && resumed_s_ > 0 ? resumed_s_ : s.begun;
  const bool line = straight_line(s);
  Piece p;
  p.feed = s.rapid ? HUGE_VAL : feed_of_segment(s, &p.by);
  p.digit = digit_of(s);
  p.share = tap_share(s);
  p.turning = kDegreesOfTurn * std::fabs(s.tap_rev_per_mm);
  p.rapid = s.rapid;
  p.dry = s.dry;
  uses_turns_ |= goes_by_spindle(p.by);
  const double rest = std::max(s.curve.length - from, kLeastLength);
  if (line) {
    const AxisVec start = from_machine ? resumed_at_ : curve_position(s.curve, from, limits_.axis_count);
    for (unsigned i = 0; i < limits_.axis_count; ++i) {
      p.c[0][i] = start[i];
      p.c[1][i] = (s.curve.end[i] - start[i]) / rest;
    }
  } else {
    p.curve = &s.curve;
    p.curve_from = s.curve.length - rest;
    if (from_machine) go_there(curve_position(s.curve, p.curve_from, limits_.axis_count), p);
  }
  resumed_ = false;
  const double zone = s.slow_zone > 0 ? std::min(static_cast<double>(s.slow_zone), rest) : 0;
  if (rest - zone > 1e-9) {
    p.length = rest - zone;
    p.rest_behind = !(zone > 0) && !s.flows;
    if (line) {
      push_piece(p);
    } else {
      co_await push_curve(work, p, s);
    }
    flows_ = s.flows;
    if (flows_) epoch_ = r.epoch;
    if (!(zone > 0)) co_return true;
    p.curve_from += p.length;
    for (unsigned i = 0; i < limits_.axis_count; ++i) p.c[0][i] += p.length * p.c[1][i];
  }
  p.length = zone;
  p.feed *= static_cast<double>(s.slow_factor);
  p.rest_behind = true;
  if (line) {
    push_piece(p);
  } else {
    co_await push_curve(work, p, s);
  }
  co_return true;
}

/// Copies the first pieces of the smoothed line into the ring.
Task<bool> PathBuilder::give_out(Work& work, unsigned count, bool rest) {
  for (unsigned k = 0; k < count; ++k) {
    out_[k].by = by_;
    out_[k].digit = digit_;
    out_[k].rest_behind = rest && k + 1 == count;
    push_piece(out_[k]);
    co_await work.pause(kPieceCost);
  }
  co_return true;
}

void PathBuilder::drop(unsigned vertices) {
  std::copy(vertex_ + vertices, vertex_ + count_, vertex_);
  std::copy(length_ + vertices, length_ + count_, length_);
  std::copy(feed_ + vertices, feed_ + count_, feed_);
  count_ -= vertices;
}

/// The path goes round a corner at a vertex of the line.
bool PathBuilder::turns_at(unsigned k) const {
  double sum = 0;
  for (unsigned i = 0; i < limits_.axis_count; ++i) {
    const double d = (vertex_[k + 1][i] - vertex_[k][i]) / length_[k] - (vertex_[k][i] - vertex_[k - 1][i]) / length_[k - 1];
    sum += d * d;
  }
  return !(std::sqrt(sum) <= kCollinear);
}

/// Without a tolerance a line is what it is, with a rest at each of its corners. An edge is final when it is known what follows.
Task<bool> PathBuilder::exact_line(Work& work, bool whole) {
  unsigned k = 0;
  hold();
  for (; k + (whole ? 1 : 2) < count_ && room(1); ++k) {
    Piece p;
    p.length = length_[k];
    p.feed = feed_[k];
    p.by = by_;
    p.digit = digit_;
    p.rest_behind = k + 2 == count_ ? !joint_.found : turns_at(k + 1);
    for (unsigned i = 0; i < limits_.axis_count; ++i) {
      p.c[0][i] = vertex_[k][i];
      p.c[1][i] = (vertex_[k + 1][i] - vertex_[k][i]) / length_[k];
    }
    push_piece(p);
    co_await work.pause(kPieceCost);
  }
  drop(k);
  line_start_u_ = head_u_;
  holds_ = false;
  if (!whole) co_return k > 0;
  if (count_ > 1) co_return false;
  begins_ = 0;
  joint_ = {};
  forget_line();
  co_return true;
}

/// Where the rest of a line is not smoothed after all: straight to its next vertex, from rest to rest.
bool PathBuilder::one_edge() {
  if (!room(1)) return false;
  Piece p;
  p.length = std::max(length_[0], kLeastLength);
  p.feed = feed_[0];
  p.by = by_;
  p.digit = digit_;
  p.rest_behind = true;
  const AxisVec& from = goes_on_ ? at_.position : vertex_[0];
  for (unsigned i = 0; i < limits_.axis_count; ++i) {
    p.c[0][i] = from[i];
    p.c[1][i] = (vertex_[1][i] - from[i]) / p.length;
  }
  if (goes_on_) store_->piece[(head_ - 1) & store_->piece_mask].rest_behind = true;
  push_piece(p);
  line_start_u_ += length_[0];
  drop(1);
  goes_on_ = joined_start_ = false;
  hidden_ = cut_ = 0;
  if (count_ == 1) forget_line();
  return true;
}

/// The line behind the border, from the place on it that the border lies beside.
void PathBuilder::go_on(const Border& border) {
  const Piece& last = out_[border.cells - 1];
  at_ = evaluate(last, last.length, limits_.axis_count);
  const double u = border.u;
  unsigned gone = 0;
  while (gone + 2 < count_ && room_.u[gone + 1] <= u) ++gone;
  const double cut = u - room_.u[gone], share = cut / length_[gone];
  hidden_ = cut + (gone == 0 ? hidden_ : 0);
  for (unsigned i = 0; i < limits_.axis_count; ++i) vertex_[gone][i] += share * (vertex_[gone + 1][i] - vertex_[gone][i]);
  length_[gone] -= cut;
  drop(gone);
  beside_ = beside_ && gone == 0;
  line_start_u_ += u;
  border_ = border;
  goes_on_ = true;
  cut_ = 0;
}

/// A line of one edge is its own smooth path. @return pieces in out_: none where transitions have taken all of it.
unsigned PathBuilder::straight() {
  if (!(length_[0] > kNothing)) return 0;
  Piece p;
  p.length = length_[0];
  p.feed = feed_[0];
  for (unsigned i = 0; i < limits_.axis_count; ++i) {
    p.c[0][i] = vertex_[0][i];
    p.c[1][i] = joint_.found ? joint_line_.along[i] : (vertex_[1][i] - vertex_[0][i]) / length_[0];
  }
  out_[0] = p;
  return 1;
}

/// The first `count` vertices of the line smoothed in out_, 0 = none. `whole`: to its end, where it is straight when a transition follows.
Task<unsigned> PathBuilder::smoothed(Work& work, bool whole, unsigned count, SmoothRequest* request) {
  request->line = {vertex_, length_, feed_, count};
  request->tolerance = tolerance_;
  request->axis_count = limits_.axis_count;
  request->straight_start = joined_start_ && !goes_on_;
  request->open = !whole;
  request->straight_end = whole && joint_.found;
  request->spacing = period_ * kMostSpeed;
  request->seconds = kPeriodsApart * period_ * (goes_by_spindle(by_) ? kTurns : 1);
  // What is not settled yet is some knots long: no more than a part of what the ring of records holds (every other one is a mark).
  request->edges = std::max<unsigned>((store_->record_mask + 1) / 2 / kOfRing, 2);
  if (goes_on_) {
    request->from = &at_;
    request->hidden = hidden_;
    std::copy(border_.kept, border_.kept + kKept, request->kept);
    request->kept_count = border_.kept_count;
  }
  const unsigned cells = co_await optimal::smooth(work, *request, room_, out_, kKnots);
  co_return cells;
}

/// The first `to` of the smoothed cells as they are gone fastest. A thread keeps the shape that it had; and where the axes stand beside the line, the way
/// back to it is not to lie beside that by the tolerance once more.
Task<bool> PathBuilder::relaxed(Work& work, const SmoothRequest& request, unsigned cells, unsigned to) {
  if (cells == 0 || beside_ || by_ == FeedBy::spindle) co_return false;
  const Relaxing how{&limits_, goes_by_spindle(by_) ? kTurns : 1};
  const bool changed = co_await optimal::relax(work, request, room_, relaxation_, how, out_, cells, to);
  co_return changed;
}

/// The transition from the smoothed line into the arc behind it leaves the path by more than the tolerance.
bool PathBuilder::meets_arc_badly(unsigned cells) {
  if (!(joint_.reach > 0)) return false;
  const Piece& end = out_[cells > 0 ? cells - 1 : 0];
  const unsigned axes = limits_.axis_count;
  make_transition(joint_, cells > 0 ? evaluate(end, end.length, axes) : joint_line_.at(-joint_.reach, axes), joint_arc_, axes, made_);
  return transition_distance(*made_, joint_line_, joint_arc_, joint_.reach, axes) > tolerance_;
}

/// Gives out the last pieces of a line, and the transition into the arc behind it.
Task<bool> PathBuilder::close_line(Work& work, unsigned cells) {
  hold();
  co_await give_out(work, cells, !joint_.found);
  head_u_ = line_u_ - joint_.reach;
  if (joint_.reach > 0) push_transition(joint_feed_);
  begins_ = joint_.reach;
  joint_ = {};
  forget_line();
  holds_ = false;
  co_return true;
}

void PathBuilder::forget_line() {
  count_ = 0;
  cut_ = hidden_ = 0;
  goes_on_ = joined_start_ = beside_ = false;
}

/// `whole`: to its end. False when there is no room yet, and without that when nothing of it is settled.
Task<bool> PathBuilder::smooth_line(Work& work, bool whole) {
  if (count_ < 2) co_return false;
  bool done = false;
  if (tolerance_ == 0) {
    done = co_await exact_line(work, whole);
    co_return done;
  }
  if (!room(whole ? 1 : kMostAtOnce)) co_return false;
  tried_ = count_;
  if (whole) {
    done = co_await close_smooth_line(work);
  } else {
    done = co_await give_settled(work);
  }
  co_return done;
}

Task<bool> PathBuilder::close_smooth_line(Work& work) {
  for (;;) {
    const bool lone = count_ == 2 && !goes_on_;
    SmoothRequest request;
    unsigned cells = 0;
    if (lone) {
      cells = straight();
    } else {
      cells = co_await smoothed(work, true, count_, &request);
      co_await relaxed(work, request, cells, cells);
    }
    if (lone || cells != 0) {
      if (!room(cells + kOfArc)) co_return false;
      const bool badly = meets_arc_badly(cells);
      co_await work.pause(joint_.reach > 0 ? kCurveCost : kPieceCost);
      if (!badly) {
        co_await close_line(work, cells);
        co_return true;
      }
      part_at_joint();
      if (!room(1)) co_return false;
      tried_ = count_;
      continue;
    }
    if (!room(kMostAtOnce)) co_return false;
    const bool given = co_await give_settled(work);
    if (given) continue;
    if (joint_.found) {
      part_at_joint();
    } else if (!one_edge()) {
      co_return false;
    } else if (count_ == 0) {
      co_return true;
    }
  }
}

/// What is settled of the gathered line. Where it would take more knots than there is room for, only the first part of it is looked at.
Task<bool> PathBuilder::give_settled(Work& work) {
  const unsigned count = count_;
  for (unsigned n = count; n >= kFewest; n /= 2) {
    SmoothRequest request;
    const unsigned cells = co_await smoothed(work, false, n, &request);
    if (cells == 0) continue;
    const unsigned most = kPieces - kOfArc - (head_ - tail_);
    const Border border = find_border(request, room_, out_, cells, most);
    if (border.cells == 0) co_return false;
    const bool amid = border.u < room_.knot[border.cells];  // of a straight cell, which stays as it is
    co_await relaxed(work, request, cells, amid ? border.cells - 1 : border.cells);
    Piece& last = out_[border.cells - 1];
    last.length = border.u - room_.knot[border.cells - 1];
    hold();
    co_await give_out(work, border.cells, false);
    go_on(border);
    holds_ = false;
    tried_ = n < count || cells > most ? 0 : count_;  // where there was more to be had, nothing need come before it is tried again
    co_return true;
  }
  co_return false;
}

Task<bool> PathBuilder::finish(Work& work) {
  if (arc_.curve != nullptr) {
    if (!room(kOfArc)) co_return false;
    hold();
    co_await end_arc(work);
    holds_ = false;
    co_return true;
  }
  const bool done = co_await smooth_line(work, true);
  if (!done) co_return false;
  closing_ = false;
  co_return true;
}

/// Closes what the record in front does not go on at speed, as far as there is room.
Task<bool> PathBuilder::part(Work& work, const Record& r, bool moves) {
  const bool on = moves && joins(r);
  if (count_ > 0 && !(on && straight_line(r.segment))) {
    if (on) meet_arc(r.segment);
    closing_ = true;
  } else if (arc_.curve != nullptr && !on) {
    if (!room(kOfArc)) co_return false;
    co_await end_arc(work);
  }
  co_return true;
}

/// Whether one more line can be gathered.
PathBuilder::Next PathBuilder::room_for_line() const {
  if (count_ + 2 >= kVertices) return Next::line_full;
  return room(count_ < kAhead ? kOfArc : kMostAtOnce) ? Next::go_on : Next::no_room;
}

/// One line that is passed at speed.
PathBuilder::Next PathBuilder::gather_line(const Record& r) {
  add_line(r);
  closing_ = r.segment.exact_stop;
  store_->passed[read_ & store_->record_mask] = line_u_;
  return !closing_ && gathered() ? Next::settle : Next::go_on;
}

/// Rapid traverse goes on at speed only into rapid traverse or a cut that is passed at speed, and of these only where the path does not bend
/// (join_piece()). The planner may know the piece already; but what it has planned ends at rest there, because nothing lay behind.
void PathBuilder::rest_unless_it_flows(const Record& r, bool moves) {
  const Segment& s = r.segment;
  const bool on = moves && (passes(s) || (s.rapid && !(s.begun > 0))) && !s.rest_before && r.epoch == epoch_;
  if (flows_ && !on && head_ != tail_) store_->piece[(head_ - 1) & store_->piece_mask].rest_behind = true;
  flows_ = false;
}

/// One move behind what is open. @param more  there are more pieces than before
Task<PathBuilder::Next> PathBuilder::add(Work& work, const Record& r, bool* more) {
  const Segment& s = r.segment;
  if (!passes(s)) {
    if (!room(2 * kOfArc)) co_return Next::no_room;
    co_await add_curve(work, r);
    line_u_ = head_u_;
    work.spend(straight_line(s) ? kPieceCost : kCurveCost);
    *more = true;
  } else if (!straight_line(s)) {
    if (!room(2 * kOfArc)) co_return Next::no_room;
    if (arc_.curve != nullptr) {
      const JointSide start = arc_start(s.curve);
      const bool left = co_await leave_arc(work, start, 0.5 * s.curve.length, least_feed(s));
      begins_ = left ? joint_.reach : 0;
    }
    joint_ = {};
    co_await add_arc(work, r);
    work.spend(kCurveCost);
    *more = true;
  } else {
    const Next may = room_for_line();
    if (may != Next::go_on) co_return may;
    if (arc_.curve != nullptr) {
      const JointSide line = line_through(s.curve.start, s.curve.start, s.curve.end, s.curve.length, limits_.axis_count);
      joined_start_ = co_await leave_arc(work, line, 0.5 * s.curve.length, least_feed(s));
      cut_ = joint_.reach;
      joint_ = {};
      *more = true;
    }
    const Next next = gather_line(r);
    co_return next;
  }
  store_->passed[read_ & store_->record_mask] = line_u_;
  co_return Next::go_on;
}

/// Moves the path on over the next record.
Task<PathBuilder::Next> PathBuilder::part_and_add(Work& work, const Record& r, bool* more) {
  const bool moves = is_move(r);
  if (moves || demands_rest(r)) {
    const bool parted = co_await part(work, r, moves);
    if (!parted) co_return Next::no_room;
    if (closing_) co_return Next::close;
    rest_unless_it_flows(r, moves);
  }
  if (!moves) co_return Next::go_on;
  const Next next = co_await add(work, r, more);
  co_return next;
}

/// Takes the next record, which is a curve or lies behind one.
Task<PathBuilder::Next> PathBuilder::take_beside_curve(Work& work, bool* more) {
  hold();
  const Next next = co_await part_and_add(work, records_[read_ & store_->record_mask], more);
  if (next != Next::no_room && next != Next::line_full && next != Next::close) ++read_;
  holds_ = false;
  co_return next;
}

/// Takes records until something else is to be done, or others may have their turn.
PathBuilder::Next PathBuilder::gather(Work& work, uint32_t head) {
  for (unsigned n = 0; n < kRecords; ++n) {
    if (closing_) return Next::close;
    if (read_ == head) return Next::nothing;
    const Record& r = records_[read_ & store_->record_mask];
    if (is_void(r)) {
      ++read_;
      continue;
    }
    const bool moves = is_move(r);
    if (arc_.curve != nullptr || (moves && !(passes(r.segment) && straight_line(r.segment)))) return Next::curve;
    if (count_ > 0 && (moves ? !joins(r) : demands_rest(r))) {
      closing_ = true;
      continue;
    }
    if (moves || demands_rest(r)) rest_unless_it_flows(r, moves);
    Next next = moves ? room_for_line() : Next::go_on;
    if (next != Next::go_on) return next;
    if (moves) {
      next = gather_line(r);
      work.spend(kLineCost);
    }
    ++read_;
    if (next == Next::settle || work.spent()) return next;
  }
  return Next::go_on;
}

Task<bool> PathBuilder::take(Work& work, uint32_t head, bool wanted) {
  bool more = false, done = false;
  for (;;) {
    Next next = gather(work, head);
    if (next == Next::curve) next = co_await take_beside_curve(work, &more);
    if (next == Next::nothing) break;
    if (next == Next::no_room) co_return more;
    co_await work.pause(kRecordsCost);
    if (next == Next::go_on) continue;
    done = co_await smooth_line(work, next == Next::close);
    more = more || done;
    if (next == Next::close) {
      if (!done) co_return more;
      closing_ = false;
    }
    if (next == Next::line_full && count_ + 2 >= kVertices) co_return more;
  }
  if (wanted && count_ > 1 && worthwhile()) {
    done = co_await smooth_line(work, false);
    more = more || done;
  }
  co_return more;
}

}  // namespace nc::optimal
