// SPDX-License-Identifier: Apache-2.0
#include "motion/optimal/optimal_planner.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace nc::optimal {
namespace {

constexpr double kPeriod = 0.005;      ///< s, of a cell
constexpr double kHungry = 0.5;        ///< s of chain that are left when it is made longer
constexpr double kPartLeft = 0.5;      ///< of what was made, where no more of the path could be gone through at once
constexpr double kEnough = 1.0;        ///< s of chain that are made at once where there are many rests
constexpr double kNew = 0.1;           ///< of the path that is left, what must have come before a law is solved for it
constexpr double kLongestLead = 0.2;   ///< s
constexpr double kDown = 1.06;         ///< of the squared speed of a stop, below which a lower feed is reached
constexpr unsigned kLawsAtOnce = 8;
constexpr unsigned kCellsAtOnce = 480; ///< of a law, so that it is there soon
constexpr unsigned kBack = 7;          ///< cells farther back, from which a law is tried that was not found
constexpr uint32_t kRetry = 4;         ///< cells that the scan goes until a law is tried again
constexpr double kAtOnce = 1e-4;       ///< s: a stop that is as good as done
constexpr double kFartherPhases[] = {1.02, 1.2, 1.6, 2.5, 4, 8};  ///< the same for laws in phases
constexpr double kHardlyLonger = 3;    ///< times as long as a stop on a line
constexpr unsigned kStopStarts = 24;   ///< cells behind which such a law is looked for, one after the other
constexpr unsigned kSolvedStops[] = {1, 4};  ///< of these, where the solver looks for one, too
constexpr double kUrgent = 0.15;       ///< s of chain that are left when a law in phases goes where no other has been found so far
constexpr double kMostJerk = 8;        ///< of an acceleration by a cycle: more cannot be seen in one position a cycle, and only makes laws hard to find
constexpr double kSameScale = 1e-9;
constexpr double kTiny = 1e-9;         ///< mm
constexpr double kFarther[] = {1.004, 1.05, 1.15, 1.35, 1.8, 2.7, 4, 8};  ///< of the distance that a stop takes on a line
constexpr unsigned kNearer = 4;        ///< halvings between one that is too short and one that is not
constexpr unsigned kStopSteps = 18;    ///< of the solver, after which there is none so short
constexpr double kStopPeriod = 0.5;    ///< of the cells of other laws: in a bend that takes all there is, a stop begins between them
constexpr double kCloseStops = 1.02;   ///< within that distances are not worth one

bool same(double a, double b) {
  return std::fabs(a - b) <= kSameScale * (std::fabs(a) + std::fabs(b));
}

bool same(const Scales& a, const Scales& b) {
  bool all = same(a.feed, b.feed) && same(a.rapid, b.rapid) && same(a.turns, b.turns) && a.skip_feed == b.skip_feed;
  for (unsigned i = 0; i < sizeof a.pulses / sizeof a.pulses[0]; ++i) all = all && a.pulses[i] == b.pulses[i];
  return all;
}

/// Some feed is lower under `a` than under `b`. A skip signal may call for a feed that is lower than the first one.
bool lower(const Scales& a, const Scales& b) {
  bool any = a.feed < b.feed || a.rapid < b.rapid || a.turns < b.turns || (a.skip_feed != b.skip_feed && (a.skip_feed < b.skip_feed || b.skip_feed == 0));
  for (unsigned i = 0; i < sizeof a.pulses / sizeof a.pulses[0]; ++i) any = any || a.pulses[i] < b.pulses[i];
  return any;
}

}  // namespace

void OptimalPlanner::create(const Setup& setup, const Record* records, Arena& arena) {
  setup_ = setup;
  for (unsigned i = 0; i < setup.limits.axis_count; ++i) {
    const double seen = kMostJerk * setup.limits.acceleration[i] / setup.cycle_s;
    if (setup.limits.acceleration[i] > 0 && setup_.limits.jerk[i] > seen) setup_.limits.jerk[i] = seen;
  }
  limits_ = setup_.limits;
  store_.cell = arena.make<PlanCell>(kCells);
  store_.next = arena.make<CellIndex>(kCells);
  store_.cell_mask = kCells - 1;
  store_.passed = arena.make<double>(setup.capacity);
  store_.record_mask = setup.capacity - 1;
  builder_.create(setup_.limits, setup.tolerance, kPeriod, records, &store_, arena);
  windows_ = arena.make<Windows>();
  chain_next_ = arena.make<CellIndex>(kCells);
  chain_end_ = arena.make<double>(kCells);
  down_u_ = arena.make<double>(kMaxCells + 1);
  down_b_ = arena.make<double>(kMaxCells + 1);
  records_ = records;
  lead_ = least_lead();
}

void OptimalPlanner::count_from(uint64_t first) {
  write_ = offer_first_ = free_from_ = first;
  const auto narrow = static_cast<uint32_t>(first);
  head_ = generation_ = offer_.number = published_ = narrow;
  offer_.end = offer_.taken = offer_.generation = narrow;
  builder_.count_from(narrow);
  fresh_piece_ = narrow;
  Following f;
  f.generation = f.tail = f.answered = narrow;
  following_.write(f);
  offers_.write(offer_);
}

Limits OptimalPlanner::with(const Following& f) const {
  Limits l = setup_.limits;
  l.scale = f.scale;
  if (!builder_.uses_turns()) l.scale.turns = 0;
  return l;
}

// ---- what the scan has said
// ------------------------------------------------------------------------------------------------------------

/// The scan follows nothing any more.
void OptimalPlanner::begin_again(const Following& f) {
  generation_ = f.generation;
  fresh_ = true;
  open_ = false;
  chain_ = {};
  lead_ = least_lead();
  tried_at_ = kNoCell;
  offer_.first = offer_.last = offer_.after = offer_.rests = kNoCell;
  offer_.failed = false;
}

/// It has given everything up: the path begins anew with its records.
void OptimalPlanner::rebuild(const Following& f) {
  begin_again(f);
  builder_.restart(f.tail, f.s, f.machine, 0);
  fresh_piece_ = builder_.head();
  fresh_x_ = 0;
}

/// False while an offer waits for its answer.
bool OptimalPlanner::answered(const Following& f) {
  if (!open_) return true;
  if (f.answered != offer_.number) return false;
  open_ = false;
  if (f.taken) {
    if (!offer_.fresh) chain_next_[offer_.after & store_.cell_mask] = offer_.first;
    chain_ = next_chain_;
    fresh_ = false;
    lead_ = std::max(0.9 * lead_, least_lead());
  } else {
    write_ = offer_.first;
    lead_ = std::min(2 * lead_, kLongestLead);
  }
  return true;
}

void OptimalPlanner::replan(uint32_t head) {
  const Following& f = following_.read();
  const bool idle = head == head_;
  head_ = head;
  if (f.generation != generation_) {
    if (f.halted) {  // it rests on the path, which stays as it is
      begin_again(f);
      fresh_piece_ = f.piece;
      fresh_x_ = f.x;
      if (f.x >= store_.piece_at(f.piece).length - kTiny) ++fresh_piece_, fresh_x_ = 0;
    } else {
      rebuild(f);
    }
  }
  if (!answered(f)) {
    publish();
    return;
  }
  if (f.cell != kNoCell && !fresh_) builder_.free_pieces(store_.at(f.cell).piece);
  free_from_ = f.cell != kNoCell ? f.cell : write_;
  limits_ = with(f);
  builder_.take(head);
  change(f);
  if (!open_ && !f.brake) go_on(f, idle);
  publish();
}

void OptimalPlanner::truncate(uint32_t end) {
  const Following& f = following_.read();
  head_ = end;
  rebuild(f);
  ++offer_.number;  // void: what the scan has of the chain is given up
  offer_.fresh = true;
  limits_ = with(f);
  builder_.take(end);
  if (!f.brake) go_on(f, false);
  publish();
}

void OptimalPlanner::publish() {
  if (offer_.end == head_ && offer_.generation == generation_ && published_ == offer_.number && offer_.failed == told_failed_ &&
      offer_.rests == told_rests_)
    return;
  offer_.end = head_;
  offer_.taken = builder_.taken();
  offer_.generation = generation_;
  published_ = offer_.number;
  told_failed_ = offer_.failed;
  told_rests_ = offer_.rests;
  offers_.write(offer_);
}

// ---- places
// ------------------------------------------------------------------------------------------------------------------------

OptimalPlanner::Start OptimalPlanner::at_end() const {
  Start s;
  if (fresh_) {
    s.fresh = true;
    s.piece = fresh_piece_;
    s.x = fresh_x_;
    s.u = fresh_piece_ != builder_.head() ? builder_.start_of(fresh_piece_) + fresh_x_ : 0;
    return s;
  }
  s.after = chain_.last;
  s.piece = chain_.piece;
  s.x = chain_.x;
  s.u = chain_.u;
  return s;
}

/// The state behind a cell of the chain.
OptimalPlanner::Start OptimalPlanner::behind(CellIndex cell) const {
  if (cell == chain_.last) return at_end();
  const PlanCell& next = store_.at(chain_next_[cell & store_.cell_mask]);
  Start s;
  s.after = cell;
  s.piece = next.piece;
  s.x = next.x;
  s.u = next.u;
  s.from_rest = next.kind == PlanCell::Kind::launch;
  s.v = s.from_rest ? 0 : next.v;
  s.a = next.a;
  return s;
}

/// Seconds until the scan leaves the cell of the chain; 0 when it has.
double OptimalPlanner::ahead(const Following& f, CellIndex cell) const {
  if (f.cell == kNoCell || cell < f.cell) return 0;
  const double time = f.at_end ? 0 : store_.at(f.cell).seconds - f.t;
  return time + chain_end_[cell & store_.cell_mask] - chain_end_[f.cell & store_.cell_mask];
}

/// The first place at least `lead` seconds ahead where a law may begin, or the next rest. False when that is the end of the chain.
bool OptimalPlanner::find_ahead(const Following& f, double lead, Start* start) const {
  if (!moving(f)) return false;
  CellIndex k = f.cell;
  double time = f.at_end ? 0 : store_.at(k).seconds - f.t;
  while (k != chain_.last) {
    const bool rests = store_.at(k).kind == PlanCell::Kind::land;
    if (time >= lead || (rests && (time > 0 || f.at_end))) {
      *start = behind(k);
      return true;
    }
    k = chain_next_[k & store_.cell_mask];
    time += store_.at(k).seconds;
  }
  return false;
}

/// The cell of the chain that lies `count` cells before another one, not before the one in execution.
CellIndex OptimalPlanner::before(const Following& f, CellIndex cell, unsigned count) const {
  unsigned between = 0;
  for (CellIndex k = f.cell; k != cell && k != chain_.last; k = chain_next_[k & store_.cell_mask]) ++between;
  CellIndex k = f.cell;
  for (; between > count; --between) k = chain_next_[k & store_.cell_mask];
  return k;
}

/// Pieces from `piece` on that one law may go through, to the next rest; no more than `most`.
unsigned OptimalPlanner::pieces_from(uint32_t piece, unsigned most) const {
  unsigned n = 0;
  while (n != most && piece + n != builder_.head()) {
    const Piece& p = store_.piece_at(piece + n);
    if (stands(p, limits_)) break;
    ++n;
    if (p.rest_behind) break;
  }
  return n;
}

/// The end of the next block that ends behind u, where single block rests.
double OptimalPlanner::next_block_end(double u, uint32_t tail) const {
  double at = -HUGE_VAL;
  bool thread = false;  // M700 6.7.1: the stop is behind the first block that is none
  for (uint32_t k = tail; k != builder_.taken(); ++k) {
    const Record& r = records_[k & store_.record_mask];
    if (r.kind == ItemKind::move && r.segment.curve.length > 0) {
      at = store_.passed[k & store_.record_mask];
      thread = r.segment.thread;
    }
    if (r.kind == ItemKind::mark && r.mark.stop && at > u + kTiny && !thread) return at;
  }
  return HUGE_VAL;
}

// ---- laws
// --------------------------------------------------------------------------------------------------------------------------

MeshRequest OptimalPlanner::request_from(const Start& start, double reach, const WayDown* down) const {
  MeshRequest request;
  request.piece = store_.piece;
  request.mask = store_.piece_mask;
  request.base = start.piece;
  request.count = pieces_from(start.piece, kCellsAtOnce + 1);  // each has a cell at least
  request.from.x = start.x;
  request.from_rest = start.from_rest;
  request.b0 = start.v * start.v;
  request.slope0 = 2 * start.a;
  request.reach = reach;
  request.most = kCellsAtOnce;
  request.down = down;
  return request;
}

/// The chain behind a place that is passed at speed, up to its next rest.
const Followed* OptimalPlanner::follow(const Start& start) {
  followed_.count = 0;
  if (start.fresh || start.from_rest) return nullptr;
  unsigned cells = 0;
  for (CellIndex k = start.after; k != chain_.last && store_.at(k).kind != PlanCell::Kind::land; k = chain_next_[k & store_.cell_mask]) ++cells;
  const unsigned every = cells / Followed::kMost + 1;
  double seconds = 0;
  CellIndex k = start.after;
  for (unsigned n = 0; n < cells; ++n) {
    if (n > 0) seconds += store_.at(k).seconds;
    const CellIndex next = chain_next_[k & store_.cell_mask];
    const PlanCell& c = store_.at(next);
    if (n % every == 0) {
      followed_cell_[followed_.count] = k;
      followed_.at[followed_.count++] = {c.u - start.u, seconds, c.v, c.a};
    }
    k = next;
  }
  const PlanCell& last = store_.at(k);
  followed_.end = {last.u + last.h - start.u, seconds + last.seconds, 0, 0};
  return followed_.count > 0 ? &followed_ : nullptr;
}

bool OptimalPlanner::one_law(const Start& start, double reach, const WayDown* down, bool once, double period, unsigned steps) {
  MeshRequest request = request_from(start, reach, down);
  if (request.count == 0) return false;
  if (!start.fresh && !start.from_rest && period >= kPeriod) {  // the cells that the chain has there
    CellIndex k = start.after;
    while (request.first_cells < kFirstCells) {
      k = chain_next_[k & store_.cell_mask];
      if (k == kNoCell || store_.at(k).kind != PlanCell::Kind::level) break;
      request.first_h[request.first_cells++] = store_.at(k).h;
    }
  }
  if (down == nullptr && reach == HUGE_VAL) request.followed = follow(start);
  Windows::Goal goal;
  goal.once = once;
  goal.period = period;
  goal.steps = steps;
  return windows_->law_to(request, limits_, goal);
}

/// The law in phases, which always is one from rest.
bool OptimalPlanner::phase_law(const Start& start, double reach) {
  const MeshRequest request = request_from(start, reach, nullptr);
  return request.count > 0 && windows_->phases_to(request, limits_);
}

/// The law found last reaches the end of the pieces, or of what was asked for.
bool OptimalPlanner::whole() const {
  return found_ == Found::cells ? windows_->whole() : found_ == Found::line ? line_.whole() : windows_->phases().whole();
}

/// Of the law found last.
double OptimalPlanner::law_seconds() const {
  return found_ == Found::cells ? windows_->law().seconds : found_ == Found::line ? line_.seconds() : windows_->phases().seconds();
}

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

/// The way to rest of the solver that ends the soonest: ever longer ones until there is one, and then those between the last two.
bool OptimalPlanner::shortest_stop(const Start& start, double distance, double most, double seconds) {
  const double period = kStopPeriod * std::min(kPeriod, seconds / 14);
  const auto law = [&](double reach) { return one_law(start, reach, nullptr, true, period, kStopSteps); };
  double none = distance, some = 0;
  for (const double farther : kFarther) {
    const double reach = std::min(distance * farther, most);
    if (!(reach > none)) break;
    if (law(reach)) {
      some = reach;
      break;
    }
    none = reach;
  }
  if (!(some > 0)) return false;
  bool last = true;
  for (unsigned n = 0; n < kNearer && some > kCloseStops * none; ++n) {
    const double reach = std::sqrt(none * some);
    last = law(reach);
    (last ? some : none) = reach;
  }
  return last || law(some);
}

/// The shortest way to rest that is found, shorter than `most`.
bool OptimalPlanner::stop_law(const Start& start, double most, bool closed) {
  double seconds = 0;
  const double distance = stopping_distance(start, &seconds);
  no_room_ = false;
  if (!(distance > 0)) return false;
  if (find_line_stop(start, most)) {
    found_ = Found::line;
    return true;
  }
  found_ = Found::cells;
  if (!closed && seconds > kAtOnce && shortest_stop(start, distance, most, seconds)) return true;
  if (!closed && distance * *std::rbegin(kFarther) > most) no_room_ = ahead_of_end(start) < kHardlyLonger * seconds + kAtOnce;
  found_ = Found::phases;
  for (const double farther : kFartherPhases) {
    const double reach = distance * farther;
    if (reach > most) break;
    if (phase_law(start, reach)) return true;
  }
  return false;
}

/// Seconds of the chain behind a place of it.
double OptimalPlanner::ahead_of_end(const Start& start) const {
  return start.fresh ? 0 : chain_end_[chain_.last & store_.cell_mask] - chain_end_[start.after & store_.cell_mask];
}

/// The law that was found last ends where the path rests.
bool OptimalPlanner::path_ends() const {
  const PathPlace& place = windows_->place(windows_->law().cells);
  const Piece& last = windows_->piece_of(windows_->law().cells);
  return last.rest_behind && place.x >= last.length - kTiny;
}

/// Where the next law begins behind one that ends in piece `piece`.
OptimalPlanner::Start OptimalPlanner::behind_law(uint32_t piece, double x, double u) const {
  Start s;
  s.after = write_ - 1;
  s.piece = piece;
  s.x = x;
  s.u = u;
  const Piece& p = store_.piece_at(piece);
  if (x >= p.length - kTiny) {
    s.u = builder_.start_of(piece) + p.length;
    ++s.piece;
    s.x = 0;
  }
  return s;
}

/// Writes the cells of the law. False when they have no room.
bool OptimalPlanner::copy_law(const Start& start, Start* end) {
  if (found_ == Found::line) return copy_phases(line_, start, end);
  if (found_ == Found::phases) return copy_phases(windows_->phases(), start, end);
  const Law& law = windows_->law();
  const Mesh& mesh = windows_->mesh();
  if (write_ + law.cells - free_from_ >= kCells) return false;
  const bool ends = path_ends();
  double time = start.fresh ? 0 : chain_end_[start.after & store_.cell_mask];
  for (unsigned k = 0; k < law.cells; ++k) {
    PlanCell& c = store_.cell[write_ & store_.cell_mask];
    c = plan_cell(law, mesh, k);
    c.x = windows_->place(k).x;
    c.piece = start.piece + windows_->place(k).piece;
    c.u = builder_.start_of(c.piece) + c.x;  // not by the cells' lengths, whose rounding adds up
    c.path_ends = ends && k + 1 == law.cells;
    c.turns = static_cast<float>(limits_.scale.turns);
    chain_next_[write_ & store_.cell_mask] = write_ + 1;
    chain_end_[write_ & store_.cell_mask] = time += c.seconds;
    ++write_;
  }
  const PathPlace& place = windows_->place(law.cells);
  *end = behind_law(start.piece + place.piece, place.x, builder_.start_of(start.piece + place.piece) + place.x);
  return true;
}

/// A law from `start`, as fast as it is found: in phases where nothing else is.
bool OptimalPlanner::try_limits(const Start& start, double most, const WayDown* down) {
  found_ = Found::line;
  if (find_line_law(start, most)) return true;
  found_ = Found::cells;
  if (one_law(start, most, down, !start.from_rest && !urgent_, kPeriod)) return true;
  found_ = Found::phases;
  if ((start.from_rest || urgent_) && phase_law(start, most)) return true;
  found_ = Found::line;
  return find_creep(start, most);
}

double OptimalPlanner::block_most(const Following& f, const Start& at) const {
  return f.block_rests ? next_block_end(at.u, f.tail) - at.u : HUGE_VAL;
}

/// Laws from `start` on, one behind the other, written and offered. False when there is none.
bool OptimalPlanner::extend(const Following& f, const Start& start, double most, const WayDown* down) {
  Start at = start;
  offer_first_ = write_;
  next_chain_ = {};
  double time = 0;
  bool any = false;
  for (unsigned n = 0; n < kLawsAtOnce && time < kEnough; ++n) {
    if (pieces_from(at.piece, 1) == 0) break;
    if (!try_limits(at, most, down)) {
      if (!any && at.from_rest) offer_.failed = true;
      break;
    }
    const CellIndex first = write_;
    Start end;
    if (!copy_law(at, &end)) break;
    any = true;
    const bool rests = store_.at(end.after).path_ends || (most < HUGE_VAL && whole());
    CellIndex keep = end.after;
    if (!rests && found_ != Found::cells) {
      keep = line_keep_;
    } else if (!rests) {
      for (double back = 0; keep != first && back < windows_->stop_seconds(); --keep) back += store_.at(keep).seconds;
      // Behind cell keep: at the start of the cell that follows.
      keep = first - 1 + better_start(static_cast<unsigned>(keep + 1 - first), [&](unsigned k) { return store_.at(first + k).a; });
    }
    for (CellIndex k = first; k != write_; ++k) time += store_.at(k).seconds;
    next_chain_.keep = keep;
    next_chain_.last = end.after;
    next_chain_.piece = end.piece;
    next_chain_.x = end.x;
    next_chain_.u = end.u;
    at = end;
    down = nullptr;
    most = HUGE_VAL;
    if (!rests || f.block_rests) break;
  }
  if (!any) {
    write_ = offer_first_;
    return false;
  }
  next_chain_.block_rests = f.block_rests;
  next_chain_.enough_s = whole() ? kHungry : kPartLeft * (chain_end_[next_chain_.keep & store_.cell_mask] - (start.fresh ? 0 : chain_end_[start.after & store_.cell_mask]));
  offer(start, false);
  return true;
}

/// Where there is none from `start`: the chain stays up to the first place behind it from which there is a law in phases. It comes to rest
/// only where that may begin nowhere on its way there.
bool OptimalPlanner::extend_later(const Following& f, const Start& start, double most) {
  MeshRequest request = request_from(start, most, nullptr);
  request.followed = follow(start);
  if (request.count == 0 || request.followed == nullptr) return false;
  const unsigned place = windows_->leaves_at(request, limits_);
  if (place == Windows::kNone || place == 0) return false;
  const Start later = behind(followed_cell_[place]);
  return extend(f, later, most - (later.u - start.u), nullptr);
}

void OptimalPlanner::offer(const Start& start, bool stops) {
  chain_next_[(write_ - 1) & store_.cell_mask] = kNoCell;
  for (CellIndex k = offer_first_; k != write_; ++k) store_.next[k & store_.cell_mask] = chain_next_[k & store_.cell_mask];
  next_chain_.scale = limits_.scale;
  next_chain_.stops = stops;
  ++offer_.number;
  offer_.after = start.after;
  offer_.fresh = start.fresh;
  offer_.first = offer_first_;
  offer_.last = write_ - 1;
  offer_.failed = false;
  offer_.stops = stops;
  offer_.rests = kNoCell;
  open_ = true;
}

/// Limits under which the feed does not matter on a way down from `start`: what is faster than it, is so already.
Limits OptimalPlanner::unbound(const Start& start) const {
  Limits l = limits_;
  const Piece& p = store_.piece_at(start.piece);
  const double most = 1.02 * (start.v + (start.a > 0 ? 0.5 * start.a * start.a / along(start).jerk : 0));
  Scales& by = l.scale;
  by.rapid = 1;
  by.feed = std::max(by.feed, chain_.scale.feed);
  switch (p.by) {
    case FeedBy::constant: return l;
    case FeedBy::signals: by.skip_feed = std::max(feed_of(p, l), most); return l;
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

/// Where the plan uses all of the limits no way to rest may begin: one from one of the next cells, of the solver behind few of them and in
/// closed form behind each. In front of a rest of the path nothing is to be done.
bool OptimalPlanner::stop_later(const Start& from) {
  Start start = from;
  for (unsigned n = 0; n < kStopStarts; ++n) {
    const CellIndex next = chain_next_[start.after & store_.cell_mask];
    if (next == chain_.last || next == kNoCell) return false;
    start = behind(next);
    if (start.from_rest) {
      offer_.rests = start.after;
      return false;
    }
    const bool closed = std::find(std::begin(kSolvedStops), std::end(kSolvedStops), n) == std::end(kSolvedStops);
    if (stop_there(start, closed)) return true;
  }
  return false;
}

/// Offers the shortest way to rest, if there is one shorter than the chain. `closed`: of those in closed form.
bool OptimalPlanner::stop_there(const Start& start, bool closed) {
  const Limits now = limits_;
  limits_ = unbound(start);
  const bool found = stop_law(start, 0.99 * (chain_.u - start.u), closed);
  limits_ = now;
  if (!found) return false;
  const Followed* const chain = follow(start);
  if (chain != nullptr && !(law_seconds() < chain->end.seconds)) {  // it comes to rest no later by itself
    no_room_ = true;
    return false;
  }
  offer_first_ = write_;
  next_chain_ = {};
  Start end;
  if (!copy_law(start, &end)) return false;
  next_chain_.last = next_chain_.keep = end.after;
  next_chain_.piece = end.piece;
  next_chain_.x = end.x;
  next_chain_.u = end.u;
  offer(start, true);
  return true;
}

// ---- what is to be done
// ----------------------------------------------------------------------------------------------------------------

/// Another override, a stop, or the end of one, while the scan moves.
void OptimalPlanner::change(const Following& f) {
  if (fresh_ || !moving(f)) {
    chain_.stops = false;
    return;
  }
  const bool scales = !same(limits_.scale, chain_.scale);
  const bool blocks = f.block_rests && !chain_.block_rests;
  if (!f.brake) offer_.rests = kNoCell;
  if (!(f.brake ? !chain_.stops && offer_.rests == kNoCell : scales || blocks || chain_.stops)) return;
  if (f.waits) {  // none of the chain has been gone: it is made anew as a whole
    if (f.brake) return;
    Start first;
    first.fresh = true;
    first.piece = store_.at(f.cell).piece;
    first.x = store_.at(f.cell).x;
    first.u = store_.at(f.cell).u;
    extend(f, first, block_most(f, first), nullptr);
    return;
  }
  // At rest no cell goes by, and what was tried in vain from a moving start may be found from here: a thread waits for it.
  if (!f.at_end && tried_at_ != kNoCell && f.cell - tried_at_ < (f.brake ? 1 : kRetry)) return;
  urgent_ = f.brake || blocks || chain_.stops || lower(limits_.scale, chain_.scale);
  Start start;
  if (!find_ahead(f, lead_, &start)) {  // it comes to rest before anything could be changed
    if (f.brake) offer_.rests = chain_.last;
    return;
  }
  if (start.from_rest) {
    if (f.brake) offer_.rests = start.after;
    reuse_cells(f);
    if (!f.brake) extend(f, start, block_most(f, start), nullptr);
    return;  // the scan stops there by itself
  }
  if (f.brake || stands(store_.piece_at(start.piece), limits_)) {
    if (!chain_.stops && !stop_there(start, false)) {
      if (f.brake && no_room_) {
        offer_.rests = chain_.last;
      } else {
        stop_later(start);
      }
    }
  } else if (blocks) {
    stop_at_block(f, start);
  } else if (lower(limits_.scale, chain_.scale)) {
    slow_down(f, start);
  } else if (!extend(f, start, block_most(f, start), nullptr) && urgent_) {
    extend_later(f, start, block_most(f, start));
  }
  tried_at_ = open_ ? kNoCell : f.cell;
}

/// The scan rests behind a cell and may do so for long while what follows is planned again and again: cells between that one and those
/// that it would go on with have been replaced and are free.
void OptimalPlanner::reuse_cells(const Following& f) {
  if (!f.at_end) return;
  const CellIndex next = chain_next_[f.cell & store_.cell_mask];
  if (next != kNoCell && next - f.cell > kLawsAtOnce * kCellsAtOnce) write_ = f.cell + 1;
}

/// Single block has been switched on: to the first end of a block that can be reached at rest.
void OptimalPlanner::stop_at_block(const Following& f, const Start& start) {
  double seconds = 0;
  const double distance = stopping_distance(start, &seconds);
  for (const double farther : kFarther) {
    const double end = next_block_end(start.u + distance * farther, f.tail);
    if (!(end < chain_.u)) {
      chain_.block_rests = true;  // the chain itself ends before; what comes behind it rests
      return;
    }
    if (extend(f, start, end - start.u, nullptr)) return;
  }
}

/// Somewhat faster than the stop that was found last.
void OptimalPlanner::way_down(WayDown* down) {
  if (found_ == Found::line) return phase_way_down(line_, kDown, down);
  const Law& law = windows_->law();
  down_u_[0] = 0;
  for (unsigned k = 0; k <= law.cells; ++k) {
    down_b_[k] = kDown * law.b[k];
    if (k > 0) down_u_[k] = down_u_[k - 1] + windows_->mesh().h[k - 1];
  }
  *down = {down_u_, down_b_, law.cells + 1};
}

/// A lower feed: down to it no faster than a stop would be.
void OptimalPlanner::slow_down(const Following& f, const Start& start) {
  const double most = block_most(f, start);
  if (find_line_law(start, most) && extend(f, start, most, nullptr)) return;
  const Limits now = limits_;
  limits_ = unbound(start);
  const bool stops = stop_law(start, HUGE_VAL, false);
  limits_ = now;
  if (!stops) return;
  WayDown down;
  way_down(&down);
  if (!extend(f, start, most, &down) && !extend_later(f, start, most)) stop_there(start, false);
}

/// A longer chain.
void OptimalPlanner::go_on(const Following& f, bool idle) {
  const bool rests = fresh_ || !moving(f);
  const Start end = at_end();
  if (pieces_from(end.piece, 1) == 0) {
    if (rests && idle && end.piece == builder_.head()) builder_.finish();
    return;
  }
  if (rests || chain_.keep == chain_.last) {
    if (rests || ahead(f, chain_.last) < kHungry) extend(f, end, block_most(f, end), nullptr);
    return;
  }
  if (ahead(f, chain_.keep) >= std::min(kHungry, chain_.enough_s)) return;
  const double more = builder_.end_u() - chain_.u;
  const bool whole = store_.piece_at(builder_.head() - 1).rest_behind;
  if (!(more > kNew * (chain_.u - store_.at(f.cell).u)) && !(whole && more > kTiny)) return;
  if (tried_at_ != kNoCell && f.cell - tried_at_ < kRetry) return;
  Start start = behind(chain_.keep);
  // Farther back and, each other time, from the end again, which has become another one where there is more path.
  if (failed_ % 2 != 0) start = behind(before(f, chain_.keep, kBack * (failed_ / 2 + 1)));
  if (ahead(f, start.after) < lead_ && !find_ahead(f, lead_, &start)) return;
  urgent_ = ahead(f, chain_.keep) < kUrgent;
  if (!extend(f, start, block_most(f, start), nullptr) && urgent_) extend_later(f, start, block_most(f, start));
  tried_at_ = open_ ? kNoCell : f.cell;
  failed_ = open_ ? 0 : failed_ + 1;
}

}  // namespace nc::optimal
