// SPDX-License-Identifier: Apache-2.0
// The planner of the optimal mode (feeder thread). It gives the scan one chain of cells, which always ends at rest, and changes it in
// front of the scan: for more path, for another override, for a stop. What it offers begins with the state that the chain has behind
// some cell; the scan takes it when it has not left that cell, and else goes on as before (docs/motion-optimal.md).
#pragma once

#include "base/triple_buffer.hpp"
#include "motion/optimal/feeder_pace.hpp"
#include "motion/optimal/line_law.hpp"
#include "motion/optimal/path_builder.hpp"
#include "motion/optimal/windows.hpp"

namespace nc::optimal {

class OptimalPlanner {
 public:
  struct Setup {
    Limits limits;
    double tolerance = 0.01, cycle_s = 0.001;
    uint32_t capacity = 1024;  ///< records
  };
  void create(const Setup& setup, const Record* records, Arena& arena);

  // The planner works in slices: each call of the next two goes on for about so many `instructions` and leaves in them what is left. What the
  // scan has of the plan stays what it is, which ends at rest, until a call has something better to offer.

  /// Hears the scan. Where that asks for what the plan does not do (a stop, another override, single block), this is done before anything
  /// else; what is under way for a plan that is not wanted any more is given up. @return whether nothing is left to be done of that
  bool answer(int64_t* instructions);
  /// A round: brings the plan up to date with the records before `head` and with what the scan has said when answer() was called, which is
  /// called before each call of this. `head` counts where a round begins. @return whether it has come to its end
  bool replan(uint32_t head, int64_t* instructions);
  /// Forgets the records from ring index `end` on. The scan is at rest and waits.
  void truncate(uint32_t end);

  /// For tests: cells, pieces and records are counted from here. Before anything else.
  void count_from(uint64_t first);

  PlanStore& store() { return store_; }
  const Limits& axis_limits() const { return setup_.limits; }
  // ---- scan
  const Proposal& newest() NC_RT { return offers_.read(); }
  void say(const Following& f) NC_RT { following_.write(f); }

 private:
  static constexpr uint32_t kCells = 8192;  ///< in the ring
  /// A place where a law may begin: behind a cell of the chain, or amid it, or at rest without one.
  struct Start {
    CellIndex after = kNoCell;
    double cut = 0;                  ///< s: so long after it is entered the cell `after` ends; 0 = at its end
    CellIndex before = kNoCell;      ///< of a cell that is cut: the one in front of it; kNoCell where it is in execution
    bool fresh = false, from_rest = true;
    uint32_t piece = 0;
    double x = 0, u = 0, v = 0, a = 0;
  };
  /// What a chain is once the scan has taken it.
  struct Chain {
    CellIndex last = kNoCell;
    CellIndex keep = kNoCell;  ///< behind this cell the stop at the end has slowed it; == last: nothing has
    double enough_s = 0;      ///< s up to there, with which it need not be longer
    uint32_t piece = 0;       ///< where it ends
    double x = 0, u = 0;
    Scales scale;
    bool block_rests = false, stops = false;
    bool hurried = false;     ///< it stops, but there was no time to look for a shorter way to rest
  };

  bool heard(const Following& f) const;
  bool called(const Following& f) const;
  void give_up_law();
  void give_up_rounds();
  void follow_generation(const Following& f);
  void begin_law(bool answer);
  Task<bool> law(Work& work, bool answer);
  void rebuild(const Following& f);
  void begin_again(const Following& f);
  bool answered(const Following& f);
  double hungry() const;
  bool wants_path(const Following& f) const;
  Task<bool> go_on(Work& work, const Following& f, bool idle);
  bool stroke_waits(const Following& f) const;
  bool must_change(const Following& f);
  Task<bool> change(Work& work, const Following& f);
  Task<bool> change_from(Work& work, const Following& f, const Start& start);
  CellIndex before(const Following& f, CellIndex cell, unsigned count) const;
  bool find_ahead(const Following& f, double lead, Start* start) const;
  bool find_amid(const Following& f, double lead, Start* start) const;
  void cut_cell(const Start& start);
  double begins_at(const Start& start) const;
  double rests_in(const Start& start) const;
  Start at_end() const;
  Start behind(CellIndex cell) const;
  double ahead(const Following& f, CellIndex cell) const;
  bool moving(const Following& f) const { return f.cell != kNoCell && !(f.at_end && f.cell == chain_.last); }
  Task<bool> extend(Work& work, const Following& f, const Start& start, double most, const WayDown* down);
  Task<bool> offer_law(Work& work, const Following& f, const Start& start, double most);
  void offer_laws(Work& work, const Following& f, const Start& start);
  bool keep_law(CellIndex first, const Start& end, double most);
  Task<bool> extend_later(Work& work, const Following& f, const Start& start, double most);
  const Followed* follow(const Start& start);
  Task<bool> try_limits(Work& work, const Start& start, double most, const WayDown* down);
  MeshRequest request_from(const Start& start, double reach, const WayDown* down) const;
  Task<bool> one_law(Work& work, const Start& start, double reach, const WayDown* down, bool once, double period, unsigned steps);
  Task<bool> phase_law(Work& work, const Start& start, double reach);
  bool whole() const;
  double law_seconds() const;
  /// What is looked for: the stop on a straight line alone; that and those of the solver; that and those in phases; all; those of a way down, which leave room for a law that goes on.
  enum class Stops : uint8_t { line, solved, closed, any, gentle };
  Task<bool> find_cells_behind(Work& work, const Start& start, double most);
  Task<bool> one_stop(Work& work, const Start& start, double reach, double period);
  Task<bool> shortest_stop(Work& work, const Start& start, double distance, double most, double seconds, Stops which);
  Task<bool> shorter_stop(Work& work, const Start& start, double none, double some, double period);
  Task<bool> stop_law(Work& work, const Start& start, double most, Stops which);
  double ahead_of_end(const Start& start) const;
  struct Along {
    double acceleration, jerk;
  };
  Along along(const Start& start) const;
  double stopping_distance(const Start& start, double* seconds) const;
  double next_block_end(double u, uint32_t tail) const;
  unsigned pieces_from(uint32_t piece, unsigned most) const;
  bool path_ends() const;
  bool rests_soon(const Start& at) const;
  Task<bool> copy_law(Work& work, const Start& start, Start* end);
  void copy_cell(const Start& start, unsigned cell, bool path_ends, double* time);
  Start behind_law(uint32_t piece, double x, double u, double way) const;
  void way_down(WayDown* down);
  // planner_lines.cpp
  bool line_limits(const Piece& p, LineLimits* most) const;
  bool straight(const Start& start, double reach, bool feed, LineLimits* most, double* length) const;
  bool find_line_law(const Start& start, double reach);
  Task<bool> find_creep(Work& work, const Start& start, double reach);
  void bound_creep(const Piece& p, double x, LineLimits* most) const;
  bool keeps_limits(const Piece& p, double x) const;
  bool find_line_stop(const Start& start, double most);
  bool goes_beyond(uint32_t piece, double beyond, double way) const;
  template <class PhasesOf>
  void phase_way_down(const PhasesOf& law, double share, WayDown* down);
  template <class PhasesOf>
  Task<bool> copy_phases(Work& work, const PhasesOf& law, const Start& start, Start* end);
  void offer(const Start& start, bool stops);
  Task<bool> stop_there(Work& work, const Start& start, Stops which);
  Task<bool> timely_stop(Work& work, const Start& start, double reach, double period);
  Task<bool> stop_soon(Work& work, const Following& f, const Start& start);
  Task<bool> stop_later(Work& work, const Start& from);
  void reuse_cells(const Following& f);
  Task<bool> law_to_block(Work& work, const Start& start, double u);
  bool too_late(const Start& start);
  double left_to(const Start& start) const;
  bool time_for_two(const Start& start) const;
  void begin_later();
  void begin_later(double lead);
  double stop_lead() const;
  bool search_is_late() const;
  double scan_at() const;
  bool unfinished();
  Task<bool> stop_at_block(Work& work, const Following& f, const Start& start);
  Task<bool> stop_between(Work& work, const Following& f, const Start& start, double none, double some);
  Task<bool> slow_down(Work& work, const Following& f, const Start& start);
  Limits unbound(const Start& start) const;
  double way_to(const Start& at, double u) const;
  double block_most(const Following& f, const Start& at) const;
  double least_lead() const { return 4 * setup_.cycle_s; }
  double least_line_lead() const { return setup_.cycle_s; }
  void publish();
  Limits with(const Following& f) const;

  Setup setup_;
  const Record* records_ = nullptr;
  PlanStore store_;
  PathBuilder builder_;
  Windows* windows_ = nullptr;
  LineLaw line_;
  enum class Found : uint8_t { cells, line, phases };
  Found found_ = Found::cells;    ///< what the law found last is: that of windows_, line_, or the phases of windows_
  CellIndex line_keep_ = kNoCell;  ///< cell of it behind which a law to a farther end would be another one
  CellIndex* chain_next_ = nullptr;
  double* chain_end_ = nullptr;  ///< s from the start of the chain to the end of the cell
  double *down_u_ = nullptr, *down_b_ = nullptr;
  FollowedCell* cell_behind_ = nullptr;  ///< of the chain, behind the place where a stop is to begin
  unsigned cells_behind_ = 0;
  Followed followed_;                               ///< of the chain, from where a law is to begin
  CellIndex followed_cell_[Followed::kMost] = {};  ///< behind which each of its places lies

  Limits limits_;               ///< with the overrides of this call
  Chain chain_, next_chain_;    ///< what the scan follows; what it has been offered
  bool open_ = false;           ///< an offer waits for its answer
  Proposal offer_;
  CellIndex offer_first_ = 0;
  uint32_t published_ = 0;
  bool told_failed_ = false;
  CellIndex told_rests_ = kNoCell;
  bool urgent_ = false;   ///< any law is better than what the chain does
  FeederPace pace_;
  /// What is known of the search for a stop: how near the scan has come to the place from which it is looked for, and how long each try takes.
  struct StopSearch {
    bool under_way = false;    ///< a law for a stop is under way that begins ...
    Start from;                ///< ... here,
    double lead = 0;           ///< s: and was so far ahead when the search began
    double none_u = 0;         ///< no stop before this place of the path is found
    bool hurried = false;      ///< the search ended because there was no more time
    bool late = false;         ///< the scan has passed the place from which a stop was looked for
    double passed_s = 0;       ///< by how much it has come nearer to that place since the search began, ...
    double longest_s = 0;      ///< in the longest of the laws that were tried ...
    double found_s = 0;        ///< ... and in those of them that there are, which are ...
    unsigned times_found = 0;  ///< ... so many
    bool no_room = false;      ///< the stop that was not found last would hardly have been shorter than the chain
  };
  StopSearch search_;
  CellIndex write_ = 0;         ///< next free cell
  CellIndex free_from_ = 0;     ///< cells from here on may be looked at by the scan
  uint32_t generation_ = 0;
  bool fresh_ = true;           ///< the scan has no chain
  uint32_t fresh_piece_ = 0;    ///< where it begins then
  double fresh_x_ = 0;
  double lead_ = 0.004;
  double line_lead_ = 0.001;    ///< the same for the stop on a line, which is found at once
  uint32_t head_ = 0;
  unsigned failed_ = 0;          ///< laws from the chain on that were not found
  CellIndex tried_at_ = kNoCell; ///< cell of the scan when no law was found

  /// What is under way: records become path, and then there is a law for what the path and the scan ask for.
  enum class Round : uint8_t { none, path, law_due, law };
  Round round_ = Round::none;
  bool answering_ = false;    ///< a law is under way for what the scan has asked for, before the round goes on
  bool unanswered_ = false;   ///< it has asked while an offer was open
  bool turn_over_ = false;    ///< another override has had its turn: the round comes first
  bool idle_ = false;         ///< nothing has come since the round before
  bool truncated_ = false;    ///< records have been given up since then
  Following now_, heard_, law_for_;  ///< as it is; of the newest answer or round; of the law that is under way
  CellIndex law_first_ = 0;   ///< the cells of that law are written from here on
  Work *path_work_ = nullptr, *law_work_ = nullptr;

  Latest<Proposal> offers_;
  Latest<Following> following_;
};

}  // namespace nc::optimal
