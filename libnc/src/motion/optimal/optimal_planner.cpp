// SPDX-License-Identifier: Apache-2.0
#include "motion/optimal/optimal_planner.hpp"

#include <algorithm>
#include <cmath>

namespace nc::optimal {
namespace {

constexpr double kPeriod = 0.005;  ///< s that a cell lasts
constexpr double kHungry = 0.5;  ///< the chain is made longer when it lasts for less, in s
/// The chain is made longer when this part of what was made is left, where no more of the path could be gone through at once.
constexpr double kPartLeft = 0.5;
constexpr double kEnough = 1.0;  ///< s of chain that are made at once where there are many rests
constexpr double kPathFirst = 0.1;  ///< s sooner all records become path, so that the law goes as far as it can
constexpr double kNew = 0.1;  ///< a law is solved anew when this part of the path that is left has been added to it
constexpr double kDown = 1.06;  ///< the way down to a lower feed has this many times the squared speed of the stop that was found last
constexpr double kLater = 1.25;  ///< a law that came too late begins at least so many times as far ahead
constexpr double kLongestLead = 0.2;  ///< s: a law begins no farther ahead of the scan
constexpr unsigned kLawsAtOnce = 8;
constexpr unsigned kCellsAtOnce = 480; ///< of a law, so that it is there soon
constexpr unsigned kBack = 7;          ///< cells farther back, from which a law is tried that was not found
constexpr uint32_t kRetry = 4;         ///< cells that the scan goes until a law is tried again
constexpr double kUrgent = 0.15;       ///< s of chain that are left when a law in phases goes where no other has been found so far
constexpr double kMostJerk = 8;        ///< of an acceleration by a cycle: more cannot be seen in one position a cycle, and only makes laws hard to find
constexpr double kSameScale = 1e-9;
constexpr double kTiny = 1e-9;  ///< mm: places that are nearer to each other are the same
// Instructions: of a law in closed form, of a cell that is copied, and of one of the chain that is looked at.
constexpr int64_t kLineCost = 15000, kCopyCost = 300, kChainCost = 20;

bool same(double a, double b) {
  return std::fabs(a - b) <= kSameScale * (std::fabs(a) + std::fabs(b));
}

bool same(const Scales& a, const Scales& b) {
  bool all = same(a.feed, b.feed) && same(a.rapid, b.rapid) && same(a.turns, b.turns) && a.skip_feed == b.skip_feed && a.dry == b.dry && a.turning_axis == b.turning_axis;
  for (unsigned i = 0; i < sizeof a.pulses / sizeof a.pulses[0]; ++i) all = all && a.pulses[i] == b.pulses[i];
  return all;
}

/// Some feed is lower under `a` than under `b`. A skip signal may call for a feed that is lower than the first one.
bool lower(const Scales& a, const Scales& b) {
  bool any = a.feed < b.feed || a.rapid < b.rapid || a.turns < b.turns || (a.skip_feed != b.skip_feed && (a.skip_feed < b.skip_feed || b.skip_feed == 0)) || slows(b.dry, a.dry);
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
  path_work_ = arena.make<Work>();
  law_work_ = arena.make<Work>();
  chain_next_ = arena.make<CellIndex>(kCells);
  chain_end_ = arena.make<double>(kCells);
  down_u_ = arena.make<double>(kMaxCells + 1);
  down_b_ = arena.make<double>(kMaxCells + 1);
  cell_behind_ = arena.make<FollowedCell>(kMaxCells);
  records_ = records;
  lead_ = least_lead();
  line_lead_ = least_line_lead();
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
  line_lead_ = least_line_lead();
  tried_at_ = kNoCell;
  offer_.first = offer_.last = offer_.after = offer_.cuts = offer_.rests = kNoCell;
  offer_.failed = false;
}

/// It has given everything up: the path begins anew with its records.
void OptimalPlanner::rebuild(const Following& f) {
  begin_again(f);
  builder_.restart(f.tail, f.s, f.machine, 0, f.epoch);
  fresh_piece_ = builder_.head();
  fresh_x_ = 0;
}

/// A law came too late: the next one begins farther ahead.
void OptimalPlanner::begin_later() {
  begin_later(2 * lead_);
}
void OptimalPlanner::begin_later(double lead) {
  lead_ = std::min(std::max(lead, kLater * lead_), kLongestLead);
}

/// False while an offer waits for its answer.
bool OptimalPlanner::answered(const Following& f) {
  if (!open_) return true;
  if (f.answered != offer_.number) return false;
  open_ = false;
  if (f.taken) {
    if (!offer_.fresh && offer_.after != kNoCell) chain_next_[offer_.after & store_.cell_mask] = offer_.first;
    chain_ = next_chain_;
    fresh_ = false;
    lead_ = std::max(0.9 * lead_, least_lead());
    line_lead_ = std::max(0.9 * line_lead_, least_line_lead());
  } else {
    write_ = offer_.first;
    begin_later();
    line_lead_ = std::min(2 * line_lead_, kLongestLead);
  }
  return true;
}

// ---- rounds
// ------------------------------------------------------------------------------------------------------------------------

/// What asks for another plan is as it was when the newest round began. A hold asks nothing of a scan that rests behind its whole chain: it does not begin what
/// is offered to it while the hold stays on, and were the law that is under way begun anew, a hold now and then would keep a slow feeder from ever ending one.
bool OptimalPlanner::heard(const Following& f) const {
  return (f.brake == heard_.brake || fresh_ || !moving(f)) && (turn_over_ || (f.block_rests == heard_.block_rests && same(f.scale, heard_.scale)));
}

/// The scan asks for what the chain does not do, and no round has been begun for that.
bool OptimalPlanner::called(const Following& f) const {
  return f.generation != generation_ || !heard(f) || (unanswered_ && f.answered == offer_.number);
}

/// What is under way for a law. Where it has come to an offer that stays, and with it the cells that have been written.
void OptimalPlanner::give_up_law() {
  if (!law_work_->open()) return;
  law_work_->give_up();
  search_.under_way = false;
  if (round_ == Round::law) builder_.give_up();
  if (!open_) write_ = law_first_;
}

void OptimalPlanner::give_up_rounds() {
  give_up_law();
  path_work_->give_up();
  round_ = Round::none;
  answering_ = unanswered_ = false;
}

/// The scan follows another path, or none.
void OptimalPlanner::follow_generation(const Following& f) {
  if (!f.halted) {
    give_up_rounds();
    rebuild(f);
    return;
  }
  give_up_law();
  if (round_ != Round::path) round_ = Round::none;
  answering_ = unanswered_ = false;
  begin_again(f);  // it rests on the path, which stays as it is, and what is under way for it goes on
  fresh_piece_ = f.piece;
  fresh_x_ = f.x;
  const Piece& p = store_.piece_at(f.piece);
  if (f.x >= p.length - unseen(p, limits_, p.length)) ++fresh_piece_, fresh_x_ = 0;
}

void OptimalPlanner::begin_law(bool answer) {
  law_first_ = write_;
  law_for_ = now_;
  free_from_ = now_.cell != kNoCell ? now_.cell : write_;
  limits_ = with(now_);
  law_work_->begin(law(*law_work_, answer));
}

/// All that is to be done for what the scan has said. `answer`: no more than that.
Task<bool> OptimalPlanner::law(Work& work, bool answer) {
  const Following& f = law_for_;
  co_await change(work, f);
  if (!answer && !open_ && !f.brake) co_await go_on(work, f, idle_);
  co_return true;
}

/// A call ends with nothing left of what it was given.
bool OptimalPlanner::unfinished() {
  pace_.spent();
  return false;
}

bool OptimalPlanner::answer(int64_t* instructions) {
  now_ = following_.read();
  if (now_.generation != generation_) {
    heard_ = now_;
    follow_generation(now_);
    return true;
  }
  pace_.begins(scan_at(), *instructions);
  const bool late = search_is_late();
  if (late) begin_later(2 * search_.lead);
  if (late || (called(now_) && !(answering_ && now_.brake == heard_.brake))) {
    // Only a hold or its end breaks off an answer: an override that never stands still gets one, and then the path is gone on with.
    turn_over_ = turn_over_ || (!late && now_.brake == heard_.brake);
    heard_ = now_;
    if (law_work_->open()) {
      give_up_law();
      if (round_ == Round::law) round_ = Round::law_due;
    }
    answering_ = answered(now_);
    unanswered_ = !answering_;
    if (answering_) begin_law(true);
  }
  if (!answering_) {
    if (published_ != offer_.number) publish();  // of a law that was broken off behind its offer
    return true;
  }
  *instructions = law_work_->go_on(*instructions);
  if (law_work_->open()) return unfinished();
  answering_ = false;
  publish();
  return true;
}

bool OptimalPlanner::replan(uint32_t head, int64_t* instructions) {
  if (round_ == Round::none) {
    idle_ = head == head_ && !truncated_;
    truncated_ = false;
    head_ = head;
    heard_ = now_;
    if (!answered(now_)) {
      publish();
      return true;
    }
    unanswered_ = false;
    if (now_.cell != kNoCell && !fresh_) builder_.free_pieces(store_.at(now_.cell).piece);
    path_work_->begin(builder_.take(*path_work_, head, wants_path(now_)));
    round_ = Round::path;
  }
  if (round_ == Round::path) {
    *instructions = path_work_->go_on(*instructions);
    if (path_work_->open()) return unfinished();
    round_ = Round::law_due;
  }
  if (round_ == Round::law_due && answered(now_)) {
    heard_ = now_;
    begin_law(false);
    round_ = Round::law;
  }
  if (round_ == Round::law) {
    *instructions = law_work_->go_on(*instructions);
    if (law_work_->open()) return unfinished();
  }
  round_ = Round::none;
  turn_over_ = false;
  publish();
  return true;
}

void OptimalPlanner::truncate(uint32_t end) {
  now_ = following_.read();
  head_ = end;
  truncated_ = true;
  heard_ = now_;
  give_up_rounds();
  rebuild(now_);
  ++offer_.number;  // void: what the scan has of the chain is given up
  offer_.fresh = true;
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

// ---- laws
// --------------------------------------------------------------------------------------------------------------------------

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

Task<bool> OptimalPlanner::one_law(Work& work, const Start& start, double reach, const WayDown* down, bool once, double period, unsigned steps) {
  MeshRequest request = request_from(start, reach, down);
  if (request.count == 0) co_return false;
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
  const bool found = co_await windows_->law_to(work, request, limits_, goal);
  co_return found;
}

/// The law in phases, which always is one from rest.
Task<bool> OptimalPlanner::phase_law(Work& work, const Start& start, double reach) {
  const MeshRequest request = request_from(start, reach, nullptr);
  if (request.count == 0) co_return false;
  const bool found = co_await windows_->phases_to(work, request, limits_);
  co_return found;
}

/// The law found last reaches the end of the pieces, or of what was asked for.
bool OptimalPlanner::whole() const {
  return found_ == Found::cells ? windows_->whole() : found_ == Found::line ? line_.whole() : windows_->phases().whole();
}

/// Of the law found last.
double OptimalPlanner::law_seconds() const {
  return found_ == Found::cells ? windows_->law().seconds : found_ == Found::line ? line_.seconds() : windows_->phases().seconds();
}

/// The law that was found last ends where the path rests.
bool OptimalPlanner::path_ends() const {
  const PathPlace& place = windows_->place(windows_->law().cells);
  const Piece& last = windows_->piece_of(windows_->law().cells);
  return last.rest_behind && place.x >= last.length - unseen(last, limits_, last.length);
}

/// The path rests right behind `at` (kBeforeRest).
bool OptimalPlanner::rests_soon(const Start& at) const {
  const double most = kBeforeRest + kBeforeRestShare * std::fabs(at.u);
  double left = -at.x;
  for (uint32_t k = at.piece; k != builder_.head(); ++k) {
    left += store_.piece_at(k).length;
    if (left > most) return false;
    if (store_.piece_at(k).rest_behind) return true;
  }
  return false;
}

/// Where the next law begins behind one that ends in piece `piece`.
OptimalPlanner::Start OptimalPlanner::behind_law(uint32_t piece, double x, double u, double way) const {
  Start s;
  s.after = write_ - 1;
  s.piece = piece;
  s.x = x;
  s.u = u;
  const Piece& p = store_.piece_at(piece);
  if (x >= p.length - unseen(p, limits_, way)) {
    s.u = builder_.start_of(piece) + p.length;
    ++s.piece;
    s.x = 0;
  }
  return s;
}

/// Writes the cells of the law. False when they have no room.
Task<bool> OptimalPlanner::copy_law(Work& work, const Start& start, Start* end) {
  bool copied = false;
  if (found_ == Found::line) {
    copied = co_await copy_phases(work, line_, start, end);
    co_return copied;
  }
  if (found_ == Found::phases) {
    copied = co_await copy_phases(work, windows_->phases(), start, end);
    co_return copied;
  }
  const Law& law = windows_->law();
  if (write_ + law.cells - free_from_ >= kCells) co_return false;
  const bool ends = path_ends();
  double time = begins_at(start);
  for (unsigned k = 0; k < law.cells; ++k) {
    copy_cell(start, k, ends && k + 1 == law.cells, &time);
    co_await work.pause(kCopyCost);
  }
  const PathPlace& place = windows_->place(law.cells);
  *end = behind_law(start.piece + place.piece, place.x, builder_.start_of(start.piece + place.piece) + place.x, place.x);
  store_.cell[end->after & store_.cell_mask].before_rest = !ends && rests_soon(*end);
  co_return true;
}

void OptimalPlanner::copy_cell(const Start& start, unsigned k, bool path_ends, double* time) {
  PlanCell& c = store_.cell[write_ & store_.cell_mask];
  c = plan_cell(windows_->law(), windows_->mesh(), k);
  c.x = windows_->place(k).x;
  c.piece = start.piece + windows_->place(k).piece;
  c.u = builder_.start_of(c.piece) + c.x;  // not by the cells' lengths, whose rounding adds up
  c.path_ends = path_ends;
  c.turns = turns_of(limits_.scale);
  c.turning_axis = limits_.scale.turning_axis;
  chain_next_[write_ & store_.cell_mask] = write_ + 1;
  chain_end_[write_ & store_.cell_mask] = *time += c.seconds;
  ++write_;
}

/// A law from `start`, as fast as it is found: in phases where nothing else is.
Task<bool> OptimalPlanner::try_limits(Work& work, const Start& start, double most, const WayDown* down) {
  found_ = Found::line;
  bool found = find_line_law(start, most);
  if (found) {
    co_await work.pause(kLineCost);
    co_return true;
  }
  found_ = Found::cells;
  found = co_await one_law(work, start, most, down, !start.from_rest && !urgent_, kPeriod, kMaxSteps);
  if (found) co_return true;
  found_ = Found::phases;
  if (start.from_rest || urgent_) {
    found = co_await phase_law(work, start, most);
    if (found) co_return true;
  }
  found_ = Found::line;
  found = co_await find_creep(work, start, most);
  co_return found;
}

/// How far a law from `at` may go to a place on the path. Where that is the end of a piece, it is that to the last bit: places are rounded, and by as
/// little an axis may show that it has not come to its end.
double OptimalPlanner::way_to(const Start& at, double u) const {
  const double way = u - at.u;
  double end = -at.x;
  for (uint32_t k = at.piece; way < HUGE_VAL && k != builder_.head() && end < way + kTiny; ++k) {
    end += store_.piece_at(k).length;
    if (std::fabs(end - way) < kTiny) return end;
  }
  return way;
}

/// The same to the end of the block, in single block.
double OptimalPlanner::block_most(const Following& f, const Start& at) const {
  return f.block_rests ? way_to(at, next_block_end(at.u, f.tail)) : HUGE_VAL;
}

/// Laws from `start` on, one behind the other, written and offered. False when there is none.
Task<bool> OptimalPlanner::extend(Work& work, const Following& f, const Start& start, double most, const WayDown* down) {
  Start at = start;
  offer_first_ = write_;
  next_chain_ = {};
  double time = 0;
  bool any = false;
  for (unsigned n = 0; n < kLawsAtOnce && time < kEnough; ++n) {
    if (pieces_from(at.piece, 1) == 0) break;
    const bool found = co_await try_limits(work, at, most, down);
    if (!found) {
      if (!any && at.from_rest) offer_.failed = true;
      break;
    }
    const CellIndex first = write_;
    Start end;
    const bool copied = co_await copy_law(work, at, &end);
    if (!copied) break;
    any = true;
    const bool rests = keep_law(first, end, most);
    for (CellIndex k = first; k != write_; ++k) time += store_.at(k).seconds;
    work.spend(kChainCost * static_cast<int64_t>(write_ - first));
    at = end;
    down = nullptr;
    most = HUGE_VAL;
    if (!rests || f.block_rests) break;
  }
  if (!any) {
    write_ = offer_first_;
    co_return false;
  }
  offer_laws(work, f, start);
  co_return true;
}

/// The law found last goes on from `start`. False when it has no room.
Task<bool> OptimalPlanner::offer_law(Work& work, const Following& f, const Start& start, double most) {
  offer_first_ = write_;
  next_chain_ = {};
  Start end;
  const bool copied = co_await copy_law(work, start, &end);
  if (!copied) {
    write_ = offer_first_;
    co_return false;
  }
  keep_law(offer_first_, end, most);
  offer_laws(work, f, start);
  co_return true;
}

/// What has been copied from cell offer_first_ on.
void OptimalPlanner::offer_laws(Work& work, const Following& f, const Start& start) {
  next_chain_.block_rests = f.block_rests;
  next_chain_.enough_s = whole() ? kHungry : kPartLeft * (chain_end_[next_chain_.keep & store_.cell_mask] - (start.fresh ? 0 : chain_end_[start.after & store_.cell_mask]));
  offer(start, false);
  work.spend(kChainCost * static_cast<int64_t>(write_ - offer_first_));
}

/// The chain goes on up to the end of the law that was copied from cell `first` on, and will have to be another one from some cell of it on.
/// @return it rests there in any case
bool OptimalPlanner::keep_law(CellIndex first, const Start& end, double most) {
  const bool rests = store_.at(end.after).path_ends || (most < HUGE_VAL && whole());
  CellIndex keep = end.after;
  if (!rests && found_ != Found::cells) {
    keep = line_keep_;
  } else if (!rests) {
    for (double back = 0; keep != first && back < windows_->stop_seconds(); --keep) back += store_.at(keep).seconds;
    // Behind cell keep: at the start of the cell that follows.
    keep = first - 1 + better_start(static_cast<unsigned>(keep + 1 - first), [&](unsigned k) { return store_.at(first + k).a; });
  }
  next_chain_.keep = keep;
  next_chain_.last = end.after;
  next_chain_.piece = end.piece;
  next_chain_.x = end.x;
  next_chain_.u = end.u;
  return rests;
}

/// Where there is none from `start`: the chain stays up to the first place behind it from which there is a law in phases. It comes to rest
/// only where that may begin nowhere on its way there.
Task<bool> OptimalPlanner::extend_later(Work& work, const Following& f, const Start& start, double most) {
  MeshRequest request = request_from(start, most, nullptr);
  request.followed = follow(start);
  if (request.count == 0 || request.followed == nullptr) co_return false;
  const unsigned place = co_await windows_->leaves_at(work, request, limits_);
  if (place == Windows::kNone || place == 0) co_return false;
  const Start later = behind(followed_cell_[place]);
  const bool extended = co_await extend(work, f, later, most - (later.u - start.u), nullptr);
  co_return extended;
}

void OptimalPlanner::offer(const Start& start, bool stops) {
  chain_next_[(write_ - 1) & store_.cell_mask] = kNoCell;
  for (CellIndex k = offer_first_; k != write_; ++k) store_.next[k & store_.cell_mask] = chain_next_[k & store_.cell_mask];
  next_chain_.scale = limits_.scale;
  next_chain_.stops = stops;
  ++offer_.number;
  offer_.after = start.cut > 0 ? start.before : start.after;
  offer_.cuts = start.cut > 0 ? start.after : kNoCell;
  offer_.fresh = start.fresh;
  offer_.first = offer_first_;
  offer_.last = write_ - 1;
  offer_.failed = false;
  offer_.stops = stops;
  offer_.rests = kNoCell;
  open_ = true;
}

// ---- what is to be done
// ----------------------------------------------------------------------------------------------------------------

/// The scan rests in front of a law that was made for another spindle: a tap is waiting for one that is made for its own.
bool OptimalPlanner::stroke_waits(const Following& f) const {
  const CellIndex next = f.at_end ? chain_next_[f.cell & store_.cell_mask] : kNoCell;
  return next != kNoCell && store_.at(next).turning_axis != limits_.scale.turning_axis;
}

/// What is asked for of the scan that moves is not what the chain does, and it has not been tried in vain just before.
bool OptimalPlanner::must_change(const Following& f) {
  if (fresh_ || !moving(f)) {
    chain_.stops = chain_.hurried = false;
    return false;
  }
  const bool scales = !same(limits_.scale, chain_.scale) || stroke_waits(f), blocks = f.block_rests && !chain_.block_rests;
  if (!f.brake) offer_.rests = kNoCell;
  if (!(f.brake ? (!chain_.stops || chain_.hurried) && offer_.rests == kNoCell : scales || blocks || chain_.stops)) return false;
  if (f.waits) return !f.brake;
  // At rest no cell goes by, and what was tried in vain from a moving start may be found from here: a thread waits for it.
  if (!f.at_end && tried_at_ != kNoCell && f.cell - tried_at_ < (f.brake ? 1 : kRetry)) return false;
  urgent_ = f.brake || blocks || chain_.stops || lower(limits_.scale, chain_.scale);
  return true;
}

/// Another override, a stop, or the end of one, while the scan moves.
Task<bool> OptimalPlanner::change(Work& work, const Following& f) {
  if (!must_change(f)) co_return false;
  Start start;
  if (f.waits) {  // none of the chain has been gone: it is made anew as a whole
    start.fresh = true;
    start.piece = store_.at(f.cell).piece;
    start.x = store_.at(f.cell).x;
    start.u = store_.at(f.cell).u;
    co_await extend(work, f, start, block_most(f, start), nullptr);
    co_return true;
  }
  if (!find_ahead(f, f.brake ? stop_lead() : lead_, &start)) {  // it comes to rest before anything could be changed
    if (f.brake) offer_.rests = chain_.last;
    co_return true;
  }
  if (start.from_rest) {
    if (f.brake) offer_.rests = start.after;
    reuse_cells(f);
    if (!f.brake) co_await extend(work, f, start, block_most(f, start), nullptr);
    co_return true;  // the scan stops there by itself
  }
  search_.late = false;
  co_await change_from(work, f, start);
  tried_at_ = open_ || search_.late ? kNoCell : f.cell;  // a search that came too late is begun anew at once
  co_return true;
}

Task<bool> OptimalPlanner::change_from(Work& work, const Following& f, const Start& start) {
  bool done = false;
  if (f.brake || stands(store_.piece_at(start.piece), limits_)) {
    if (!chain_.stops || chain_.hurried) co_await stop_soon(work, f, start);
  } else if (f.block_rests && !chain_.block_rests) {
    co_await stop_at_block(work, f, start);
  } else if (lower(limits_.scale, chain_.scale)) {
    co_await slow_down(work, f, start);
  } else {
    const double most = block_most(f, start);
    done = co_await extend(work, f, start, most, nullptr);
    if (!done && urgent_) co_await extend_later(work, f, start, most);
  }
  co_return true;
}

/// The scan rests behind a cell and may do so for long while what follows is planned again and again: cells between that one and those
/// that it would go on with have been replaced and are free.
void OptimalPlanner::reuse_cells(const Following& f) {
  if (!f.at_end) return;
  const CellIndex next = chain_next_[f.cell & store_.cell_mask];
  if (next != kNoCell && next - f.cell > kLawsAtOnce * kCellsAtOnce) write_ = f.cell + 1;
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
Task<bool> OptimalPlanner::slow_down(Work& work, const Following& f, const Start& start) {
  const double most = block_most(f, start);
  bool done = false;
  if (find_line_law(start, most)) {
    done = co_await extend(work, f, start, most, nullptr);
    if (done) co_return true;
  }
  const Limits now = limits_;
  limits_ = unbound(start);
  const bool stops = co_await stop_law(work, start, HUGE_VAL, Stops::gentle);
  limits_ = now;
  if (!stops) co_return false;
  WayDown down;
  way_down(&down);
  done = co_await extend(work, f, start, most, &down);
  if (!done) done = co_await extend_later(work, f, start, most);
  if (!done) done = co_await stop_there(work, start, Stops::gentle);
  co_return done;
}

/// Seconds of chain that may be left before it is to be made longer: so many.
double OptimalPlanner::hungry() const { return chain_.keep == chain_.last ? kHungry : std::min(kHungry, chain_.enough_s); }

/// The chain is to be made longer soon.
bool OptimalPlanner::wants_path(const Following& f) const {
  return fresh_ || !moving(f) || ahead(f, chain_.keep) < hungry() + kPathFirst;
}

/// A longer chain.
Task<bool> OptimalPlanner::go_on(Work& work, const Following& f, bool idle) {
  const bool rests = fresh_ || !moving(f);
  const Start end = at_end();
  bool done = false;
  if (pieces_from(end.piece, 1) == 0) {
    if (rests && idle && end.piece == builder_.head()) done = co_await builder_.finish(work);
    co_return done;
  }
  if (rests || chain_.keep == chain_.last) {
    if (rests || ahead(f, chain_.last) < hungry()) done = co_await extend(work, f, end, block_most(f, end), nullptr);
    co_return done;
  }
  if (ahead(f, chain_.keep) >= hungry()) co_return false;
  const double more = builder_.end_u() - chain_.u;
  const bool whole = store_.piece_at(builder_.head() - 1).rest_behind;
  if (!(more > kNew * (chain_.u - store_.at(f.cell).u)) && !(whole && more > kTiny)) co_return false;
  if (tried_at_ != kNoCell && f.cell - tried_at_ < kRetry) co_return false;
  Start start = behind(chain_.keep);
  // Farther back and, each other time, from the end again, which has become another one where there is more path.
  if (failed_ % 2 != 0) start = behind(before(f, chain_.keep, kBack * (failed_ / 2 + 1)));
  if (ahead(f, start.after) < lead_ && !find_ahead(f, lead_, &start)) co_return false;
  urgent_ = ahead(f, chain_.keep) < kUrgent;
  const double most = block_most(f, start);
  done = co_await extend(work, f, start, most, nullptr);
  if (!done && urgent_) co_await extend_later(work, f, start, most);
  tried_at_ = open_ ? kNoCell : f.cell;
  failed_ = open_ ? 0 : failed_ + 1;
  co_return open_;
}

}  // namespace nc::optimal
