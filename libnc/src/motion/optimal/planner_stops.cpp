// SPDX-License-Identifier: Apache-2.0
// Ways to rest of the plan: the shortest one that is found, from the first place from which there is one.
#include <algorithm>
#include <cmath>
#include <iterator>

#include "motion/optimal/optimal_planner.hpp"

namespace nc::optimal {
namespace {

constexpr double kPeriod = 0.005;  ///< s that a cell lasts
/// A stop is looked for at these many times the distance that a stop on a line takes.
constexpr double kFarther[] = {1.004, 1.05, 1.15, 1.35, 1.8, 2.7, 4, 8};
constexpr double kFartherFollowed[] = {1.35, 2.7, 4, 8};  ///< the same on the cells of what is followed
constexpr double kFartherPhases[] = {1.02, 1.2, 1.6, 2.5, 4, 8};  ///< the same for laws in phases
constexpr double kAtOnce = 1e-4;  ///< s: a stop that takes no longer is as good as done
/// Where the end of what is planned is nearer than this many times the time of a stop on a line, there is no room for another stop.
constexpr double kHardlyLonger = 3;
constexpr double kFarthestAmid = 4;    ///< of that distance, from amid a cell: where none so short is found, one from its end may be shorter
constexpr unsigned kStopStarts = 24;   ///< cells behind which such a law is looked for, one after the other
constexpr unsigned kSolvedStops[] = {1, 4};  ///< of these, where the solver looks for one, too
constexpr unsigned kNearerFollowed = 5;  ///< so often the distance between such a stop that is too short and one that is not is halved
constexpr unsigned kNearer = 4;  ///< so often the distance between a stop that is too short and one that is not is halved
constexpr unsigned kStopSteps = 18;  ///< the solver makes so many steps, after which there is no stop that is so short
constexpr unsigned kStopStepsFollowed = 30;  ///< the same on the cells of what is followed, where most of what is none ends sooner
constexpr double kStopPeriod = 0.5;    ///< of the cells of other laws: in a bend that takes all there is, a stop begins between them
constexpr double kCloseStops = 1.02;  ///< the halving ends when the two distances differ by no more than this factor
constexpr double kShorter = 1.1;  ///< ... or the looking for a shorter stop than the one that is gone, by no more than this one
constexpr double kFarEnd = 1.5;       ///< times the way to the end of a block: farther is the next one, so that a law to this one is worth all its time
constexpr double kLongestStopLead = 0.2;  ///< s: no stop is looked for farther ahead
constexpr double kStopCost = 20e6;  ///< instructions, as Work counts them, in which a stop amid curves is found behind one or two that are none
// Instructions: of a stop on a straight line, of a record that is looked at, and of a cell of what is followed.
constexpr int64_t kLineCost = 15000, kRecordCost = 20, kBehindCost = 150;

}  // namespace

/// What the axes allow along the path at a place.
OptimalPlanner::Along OptimalPlanner::along(const Start& start) const {
  const Piece& p = store_.piece_at(start.piece);
  const CurvePoint q = evaluate(p, std::min(start.x, p.length), limits_.axis_count);
  Along most{HUGE_VAL, HUGE_VAL};
  for (unsigned i = 0; i < limits_.axis_count; ++i) {
    const double d = std::fabs(q.d1[i]);
    if (most.acceleration * d > limits_.acceleration[i]) most.acceleration = limits_.acceleration[i] / d;
    if (most.jerk * d > limits_.jerk[i]) most.jerk = limits_.jerk[i] / d;
  }
  return most;
}

/// Length and time of a stop on the straight line ahead.
double OptimalPlanner::stopping_distance(const Start& start, double* seconds) const {
  const auto [a, j] = along(start);
  if (!(a < HUGE_VAL) || !(j < HUGE_VAL)) return 0;
  // As if the acceleration had been 0 for once: |start.a| / j ago, or as long ahead.
  const double t = std::fabs(start.a) / j, v = start.v + 0.5 * start.a * start.a / j;
  const double time = v >= a * a / j ? v / a + a / j : 2 * std::sqrt(v / j);
  const double whole = 0.5 * v * time;
  if (start.a > 0) {
    *seconds = time + t;
    return whole + t * (start.v + t * (start.a / 2 - t * j / 6));
  }
  *seconds = std::max(time - t, 0.2 * time);
  return std::max(whole - t * (v - t * t * j / 6), 0.05 * whole);
}

/// The cells of the chain behind `start`, up to its next rest, no farther than `most`.
Task<bool> OptimalPlanner::find_cells_behind(Work& work, const Start& start, double most) {
  cells_behind_ = 0;
  if (start.fresh || start.from_rest) co_return false;
  double s = 0, v = start.v, a = start.a;
  CellIndex k = start.cut > 0 ? start.after : chain_next_[start.after & store_.cell_mask];
  while (cells_behind_ < kMaxCells && s < most) {
    const PlanCell& c = store_.at(k);
    if (c.kind == PlanCell::Kind::launch) break;
    const CellState end = state_in(c, c.seconds);
    const double h = c.u + c.h - start.u - s;
    if (!(h > 0)) break;
    cell_behind_[cells_behind_++] = {s, h, v * v, a, (end.v * end.v - v * v - 2 * a * h) / (h * h)};
    if (k == chain_.last || c.kind == PlanCell::Kind::land) break;
    s += h;
    k = chain_next_[k & store_.cell_mask];
    v = store_.at(k).v;
    a = store_.at(k).a;
    co_await work.pause(kBehindCost);
  }
  co_return cells_behind_ > 0;
}

/// The law of the solver that rests after `reach`: on the cells that find_cells_behind() has found, or where there are none on cells like any other law.
Task<bool> OptimalPlanner::one_stop(Work& work, const Start& start, double reach, double period) {
  MeshRequest request = request_from(start, reach, nullptr);
  if (request.count == 0) co_return false;
  Windows::Goal goal;
  goal.once = true;
  goal.period = period;
  goal.steps = kStopSteps;
  if (cells_behind_ > 0) {
    const Along most = along(start);
    request.chain = cell_behind_;
    request.chain_cells = cells_behind_;
    request.stop_a = most.acceleration;
    request.stop_j = most.jerk;
    goal.steps = kStopStepsFollowed;
  }
  const bool found = co_await windows_->law_to(work, request, limits_, goal);
  co_return found;
}

/// Seconds in which the scan comes to a place of the chain.
double OptimalPlanner::left_to(const Start& start) const {
  if (start.fresh) return HUGE_VAL;
  return ahead(now_, start.after) - (start.cut > 0 ? store_.at(start.after).seconds - start.cut : 0);
}

/// A stop is looked for so far ahead of the scan that there is the time to find it.
double OptimalPlanner::stop_lead() const { return std::min(std::max(lead_, pace_.seconds(kStopCost)), kLongestStopLead); }

/// The scan has come to the place from which a stop is looked for, so what is found would be refused.
bool OptimalPlanner::search_is_late() const { return search_.under_way && law_work_->open() && !(left_to(search_.from) > 0); }

/// The same, in the time that the scan needs to the place where the law begins. Behind that it would be refused, so nothing more is looked for from there, and the next
/// search begins as far ahead as this one would have needed.
Task<bool> OptimalPlanner::timely_stop(Work& work, const Start& start, double reach, double period) {
  const double before = left_to(start);
  search_.under_way = now_.brake;
  search_.from = start;
  const bool found = co_await one_stop(work, start, reach, period);
  search_.under_way = false;
  const double left = left_to(start), took = start.fresh ? 0 : before - left;
  search_.passed_s += took;
  search_.longest_s = std::max(search_.longest_s, took);
  if (found) search_.found_s += took, ++search_.times_found;
  search_.late = !(left > 0);
  if (search_.late) begin_later(search_.passed_s + search_.longest_s);
  co_return found && !search_.late;
}

/// Two more laws can be looked for that take as long as those that were found, longer than those that are none: the next one, and where it is none the last one again.
bool OptimalPlanner::time_for_two(const Start& start) const { return left_to(start) * search_.times_found > 2 * search_.found_s; }

/// The way to rest of the solver that ends the soonest: ever longer ones until there is one, and then those between the last two.
Task<bool> OptimalPlanner::shortest_stop(Work& work, const Start& start, double distance, double most, double seconds, Stops which) {
  const double period = kStopPeriod * std::min(kPeriod, seconds / 14);
  double none = distance, some = 0;
  cells_behind_ = 0;
  if (which != Stops::gentle) co_await find_cells_behind(work, start, std::min(most, distance * *std::rbegin(kFarther)));
  const bool behind = cells_behind_ > 0;
  search_.passed_s = search_.longest_s = search_.found_s = 0;
  search_.times_found = 0;
  if (chain_.hurried && which != Stops::gentle) {
    const bool shorter = co_await shorter_stop(work, start, std::max(distance, search_.none_u - start.u), most, period);
    co_return shorter;
  }
  const double* const farther = behind ? kFartherFollowed : kFarther;
  const size_t count = behind ? std::size(kFartherFollowed) : std::size(kFarther);
  for (size_t n = 0; n < count; ++n) {
    const double reach = std::min(distance * farther[n], most);
    if (!(reach > none)) break;
    const bool found = co_await timely_stop(work, start, reach, period);
    if (search_.late) co_return false;
    if (found) {
      some = reach;
      break;
    }
    none = reach;
  }
  if (!(some > 0)) co_return false;
  bool last = true;
  for (unsigned n = 0; n < (behind ? kNearerFollowed : kNearer) && some > kCloseStops * none; ++n) {
    search_.hurried = !time_for_two(start);
    if (search_.hurried) break;
    const double reach = std::sqrt(none * some);
    last = co_await timely_stop(work, start, reach, period);
    if (search_.late) co_return false;
    (last ? some : none) = reach;
  }
  search_.none_u = start.u + none;
  if (!last) last = co_await timely_stop(work, start, some, period);
  co_return last;
}

/// There was no time to look for a shorter way to rest than that of the chain, which is followed meanwhile: this is one between the longest way that is none and that of
/// the chain, `some`.
Task<bool> OptimalPlanner::shorter_stop(Work& work, const Start& start, double none, double some, double period) {
  while (some > kShorter * none) {
    const double reach = std::sqrt(none * some);
    const bool found = co_await timely_stop(work, start, reach, period);
    if (search_.late) co_return false;
    if (found) {
      search_.hurried = reach > kShorter * none;
      co_return true;
    }
    none = reach;
    search_.none_u = std::max(search_.none_u, start.u + none);
  }
  chain_.hurried = false;
  co_return false;
}

/// The shortest way to rest that is found, shorter than `most`.
Task<bool> OptimalPlanner::stop_law(Work& work, const Start& start, double most, Stops which) {
  double seconds = 0;
  const double distance = stopping_distance(start, &seconds);
  search_.no_room = false;
  if (!(distance > 0)) co_return false;
  const bool on_a_line = find_line_stop(start, most);
  co_await work.pause(kLineCost);
  if (on_a_line) {
    found_ = Found::line;
    co_return true;
  }
  if (which == Stops::line) co_return false;
  found_ = Found::cells;
  const bool closed = which == Stops::closed;
  if (!closed && seconds > kAtOnce) {
    const bool found = co_await shortest_stop(work, start, distance, which == Stops::solved ? std::min(most, kFarthestAmid * distance) : most, seconds, which);
    if (found || search_.late) co_return found;
  }
  if (!closed && distance * *std::rbegin(kFarther) > most) search_.no_room = ahead_of_end(start) < kHardlyLonger * seconds + kAtOnce;
  if (which == Stops::solved) co_return false;
  found_ = Found::phases;
  for (const double farther : kFartherPhases) {
    const double reach = distance * farther;
    if (reach > most) break;
    const bool found = co_await phase_law(work, start, reach);
    if (found) co_return true;
  }
  co_return false;
}

/// Seconds of the chain behind a place of it.
double OptimalPlanner::ahead_of_end(const Start& start) const {
  return start.fresh ? 0 : chain_end_[chain_.last & store_.cell_mask] - begins_at(start);
}

/// Limits under which the feed does not matter on a way down from `start`: what is faster than it, is so already.
Limits OptimalPlanner::unbound(const Start& start) const {
  Limits l = limits_;
  const Piece& p = store_.piece_at(start.piece);
  const double most = 1.02 * (start.v + (start.a > 0 ? 0.5 * start.a * start.a / along(start).jerk : 0));
  Scales& by = l.scale;
  by.rapid = 1;
  by.feed = std::max(by.feed, chain_.scale.feed);
  if (p.dry && by.dry.of(p.rapid) >= 0) {
    double& dry = p.rapid ? by.dry.rapid : by.dry.cut;
    dry = std::max({dry, chain_.scale.dry.of(p.rapid), most});
    return l;
  }
  switch (p.by) {
    case FeedBy::constant: return l;
    case FeedBy::signals: by.skip_feed = std::max(feed_of(p, l), most); return l;
    case FeedBy::fixed_turns:
    case FeedBy::spindle: by.turns = std::max({by.turns, chain_.scale.turns, most / p.feed}); return l;
    case FeedBy::turns: by.turns = std::max({by.turns, chain_.scale.turns, by.turns > 0 ? 0.0 : 1.0}); break;
    case FeedBy::digit: by.pulses[p.digit.digit] = HUGE_VAL; break;
    case FeedBy::override: break;
  }
  if (p.feed < HUGE_VAL && feed_of(p, l) < most) {
    by.feed = 1;
    by.feed = most / feed_of(p, l);
  }
  return l;
}

/// A stop was asked for: on a line one cycle from now, because that one is found at once, else where a law has the time to be found; from amid the cell
/// that is gone then, or from its end.
Task<bool> OptimalPlanner::stop_soon(Work& work, const Following& f, const Start& start) {
  Start at;
  search_.lead = stop_lead();
  if (find_amid(f, line_lead_, &at) && !at.from_rest) {
    const bool done = co_await stop_there(work, at, Stops::line);
    if (done) co_return true;
  }
  if (find_amid(f, search_.lead, &at) && at.cut > 0) {
    const bool done = co_await stop_there(work, at, Stops::solved);
    if (done || search_.late || chain_.stops) co_return done;
  }
  if (chain_.stops) {
    const bool shorter = co_await stop_there(work, start, Stops::solved);
    co_return shorter;
  }
  const bool done = co_await stop_there(work, start, Stops::any);
  if (done || search_.late) co_return done;
  if (f.brake && search_.no_room) {
    offer_.rests = chain_.last;
    co_return false;
  }
  const bool later = co_await stop_later(work, start);
  co_return later;
}

/// Where the plan uses all of the limits no way to rest may begin: one from one of the next cells, of the solver behind few of them and in
/// closed form behind each. In front of a rest of the path nothing is to be done.
Task<bool> OptimalPlanner::stop_later(Work& work, const Start& from) {
  Start start = from;
  for (unsigned n = 0; n < kStopStarts; ++n) {
    const CellIndex next = chain_next_[start.after & store_.cell_mask];
    if (next == chain_.last || next == kNoCell) co_return false;
    start = behind(next);
    if (start.from_rest) {
      offer_.rests = start.after;
      co_return false;
    }
    const bool closed = std::find(std::begin(kSolvedStops), std::end(kSolvedStops), n) == std::end(kSolvedStops);
    const bool stopped = co_await stop_there(work, start, closed ? Stops::closed : Stops::any);
    if (stopped || search_.late) co_return stopped;
  }
  co_return false;
}

/// Offers the shortest way to rest, if there is one shorter than the chain.
Task<bool> OptimalPlanner::stop_there(Work& work, const Start& start, Stops which) {
  const Limits now = limits_;
  search_.hurried = false;
  limits_ = unbound(start);
  const bool found = co_await stop_law(work, start, 0.99 * (chain_.u - start.u), which);
  limits_ = now;
  if (!found) co_return false;
  if (!start.fresh && !start.from_rest && !(law_seconds() * (chain_.stops ? kCloseStops : 1) < rests_in(start))) {  // it comes to rest no later by itself
    search_.no_room = true;
    co_return false;
  }
  offer_first_ = write_;
  next_chain_ = {};
  next_chain_.hurried = search_.hurried;
  if (start.cut > 0) cut_cell(start);
  Start end;
  const bool copied = co_await copy_law(work, start, &end);
  if (!copied) {
    write_ = offer_first_;
    co_return false;
  }
  next_chain_.last = next_chain_.keep = end.after;
  next_chain_.piece = end.piece;
  next_chain_.x = end.x;
  next_chain_.u = end.u;
  offer(start, true);
  co_return true;
}

/// A law to the end of a block that lies at u, looked for as a stop is: it is one of some that are tried while the axes move.
Task<bool> OptimalPlanner::law_to_block(Work& work, const Start& start, double u) {
  double seconds = 0;
  const double way = way_to(start, u), distance = stopping_distance(start, &seconds);
  const double period = std::min(kPeriod, kStopPeriod * seconds / 14 * way / distance);
  found_ = Found::line;
  const bool on_a_line = find_line_law(start, way);
  co_await work.pause(kLineCost);
  if (on_a_line) co_return true;
  found_ = Found::cells;
  const bool found = co_await one_law(work, start, way, nullptr, true, period, kStopSteps);
  co_return found;
}

/// The scan has passed the place, so that a law from there would come too late.
bool OptimalPlanner::too_late(const Start& start) {
  if (start.fresh || ahead(now_, start.after) > 0) return false;
  begin_later();
  return true;
}

/// Single block has been switched on: to the first end of a block that can be reached at rest. Ever farther ends are tried until there is a law to
/// one. None is looked for twice in the same way, because meanwhile the ends of blocks go by; but where the next end lies much farther, all is done for
/// this one.
Task<bool> OptimalPlanner::stop_at_block(Work& work, const Following& f, const Start& start) {
  double seconds = 0;
  const double distance = stopping_distance(start, &seconds);
  double none = start.u;
  for (const double farther : kFarther) {
    const double end = next_block_end(start.u + distance * farther, f.tail);
    co_await work.pause(kRecordCost * (builder_.taken() - f.tail));
    if (!(end < chain_.u)) {
      if (none > start.u) break;  // from a place farther on there may be a law to one of the ends before
      chain_.block_rests = true;  // the chain itself ends before; what comes behind it rests
      co_return false;
    }
    if (!(end > none)) continue;
    const bool found = co_await law_to_block(work, start, end);
    if (too_late(start)) co_return false;
    if (found) {
      const bool done = co_await stop_between(work, f, start, none, end);
      co_return done;
    }
    none = end;
    const double next = next_block_end(end, f.tail);
    co_await work.pause(kRecordCost * (builder_.taken() - f.tail));
    if (next - start.u < kFarEnd * (end - start.u)) continue;
    const bool done = co_await extend(work, f, start, way_to(start, end), nullptr);
    if (done || too_late(start)) co_return done;
  }
  co_return false;
}

/// The law found last goes to the end of a block at `some`, and none goes to the one at `none`, which is where it begins if none was tried: the same for
/// the ends between the two, and what is found is offered.
Task<bool> OptimalPlanner::stop_between(Work& work, const Following& f, const Start& start, double none, double some) {
  bool last = true;
  for (unsigned n = 0; n < kNearer && none > start.u; ++n) {
    const double end = next_block_end(start.u + std::sqrt((none - start.u) * (some - start.u)), f.tail);
    co_await work.pause(kRecordCost * (builder_.taken() - f.tail));
    if (!(end < some)) break;
    last = co_await law_to_block(work, start, end);
    if (too_late(start)) co_return false;
    (last ? some : none) = end;
  }
  if (!last) last = co_await law_to_block(work, start, some);
  if (last) last = co_await offer_law(work, f, start, way_to(start, some));
  co_return last;
}

}  // namespace nc::optimal
