// SPDX-License-Identifier: Apache-2.0
// The loop of an offline run; see offline_run.hpp. Which item becomes which event is written down in
// docs/trace.md.
#include "tools/lib/offline_run.hpp"

#include <algorithm>
#include <utility>

#include "tools/lib/cut_item.hpp"
#include "tools/lib/life_minutes.hpp"
#include "tools/lib/operation_alarm.hpp"

namespace nc::tools {
namespace {

constexpr uint32_t kBudget = 4096;  // blocks that one pull may read
constexpr uint64_t kMostMovesInBlock = 1000000;  // a cycle with a peck of a thousandth of what was meant

class OfflineRun {
 public:
  OfflineRun(ItemSource* items, VirtualWorld* world, RunSink* sink, Decides decides, bool one_pass, const RunProgress& progress, const LoopLimits& loops, const RoundLimits& rounds)
      : items_(*items), world_(*world), sink_(*sink), one_pass_(one_pass), progress_(progress), next_told_(progress.first), passes_(std::move(decides)), loops_(loops, without_silent(rounds)), cuts_(world->waits_for_time()), axis_count_(world->axis_count()) {}

  RunResult run(uint64_t max_silent_blocks) {
    alarms_ = items_.operation_alarms(&digits_);
    passes_moves_ = !sink_.takes_moves() && world_.waits_for_nothing();
    passes_.begin([this](uint32_t from, uint32_t* number, double* value) { return items_.next_common(from, number, value); });
    for (;;) {
      if (max_silent_blocks && silent_ >= max_silent_blocks) return endless();
      const nc_status status = passes_moves_ && may_pass() ? pull_past() : items_.pull(kBudget, &item_);
      if (moves_in_block_ >= kMostMovesInBlock) return too_many_moves(past_.source);
      if (status == NC_BUDGET) {
        // There may be many lines without a block, so a thousand of them count as one block. A loop of a program always has blocks, and so
        // marks.
        constexpr uint64_t kLinesForABlock = 1000;
        empty_lines_ += kBudget;
        if (max_silent_blocks && silent_ + empty_lines_ / kLinesForABlock >= max_silent_blocks) return endless();
        if (sink_.stop()) return stopped();
        continue;
      }
      if (status == NC_ENDED || status == NC_ALARMED) break;
      if (status != NC_OK) return fail("the control stopped with status " + std::to_string(status));
      empty_lines_ = 0;
      count_silence(item_);
      if (world_.on_item(item_, world_.waits_for_block() ? items_.main_line(item_.source) : 0)) return reset();
      if (world_.macro_interrupt() != interrupt_) {
        interrupt_ = !interrupt_;
        if (items_.interrupt(interrupt_)) continue;  // the interrupt program comes before this item
      }
      if (cuts_) [[unlikely]] cut_.resume(&item_, world_.machine(), &items_);
      if (!handle(item_)) return result_;
      if (result_.one_pass || sink_.stop()) {
        if (!result_.one_pass) return stopped();
        result_.how = RunResult::How::kEnded;
        sink_.end(last(), true, work_, world_.machine(), modal_);
        return finish();
      }
    }
    if (!ended_) return fail("the control stopped without an end");
    return finish();
  }

 private:
  // Rounds in which the machine has got nothing to do are no rounds of a program that is for it.
  RoundLimits without_silent(RoundLimits rounds) {
    if (rounds.never_ends)
      rounds.never_ends = [this, most = rounds.rounds, asks = rounds.never_ends](const nc_source& to, uint32_t from) { return silent_ < most && asks(to, from); };
    return rounds;
  }

  // Where the last item comes from; all 0 before there is one.
  const nc_source& last() const { return item_.source; }

  // The next item but moves, which are executed and counted.
  nc_status pull_past() {
    world_.prepare(&past_);
    past_.most_in_row = kMostMovesInBlock;
    past_.moves_in_row = moves_in_block_;
    past_.moves = result_.moves;
    past_.length = result_.length;
    const nc_status status = items_.pull_past(kBudget, &past_, &item_);
    if (past_.moves == result_.moves) return status;
    world_.execute(past_);
    work_ = past_.work;
    result_.moves = past_.moves;
    result_.length = past_.length;
    moves_in_block_ = past_.moves_in_row;
    silent_ = empty_lines_ = 0;
    for (uint64_t i = 0; i < past_.marks; ++i) count_mark(past_.source);
    if (status != NC_OK) item_.source = past_.source;
    return status;
  }

  // Counts blocks that only calculate and jump. The count begins anew with every item that the machine notices or that lets time pass, and with a block of
  // the main program beyond all that were executed before, because a program that goes forward comes to its
  // end.
  void count_silence(const nc_item& item) {
    if (item.kind == NC_ITEM_MOVE) {  // most items are
      silent_ = 0;
    } else if (item.kind == NC_ITEM_MARK) {
      count_mark(item.source);
    } else if (item.kind == NC_ITEM_SYNC) {
      if (item.u.sync.what & NC_SYNC_CLOCK) silent_ = 0;
    } else if (item.kind != NC_ITEM_ACTION || item.u.action.kind != NC_ACTION_CONTROL ||
               item.u.action.index != NC_CONTROL_INTERRUPT) {
      silent_ = 0;
    }
  }

  void count_mark(const nc_source& source) {
    ++silent_;
    tell_progress(source);
    if (source.depth == 0 && source.line > furthest_line_) {
      furthest_line_ = source.line;
      silent_ = 0;
    }
  }

  void tell_progress(const nc_source& source) {
    if (++passed_ < next_told_) return;
    next_told_ *= 2;
    if (progress_.tell) progress_.tell(source, passed_);
  }

  RunResult endless() {
    result_.silent = true;
    const std::string place = last().line == 0
                                  ? ""
                                  : "line " + std::to_string(last().line) +
                                        (last().program ? " of O" + std::to_string(last().program) : "") + ": ";
    return give_up(place + std::to_string(silent_) +
                   " blocks without anything that the machine would do: an endless loop, or too few allowed "
                   "(--max-silent-blocks)");
  }

  void give_up_loop() {
    result_.loop = loops_.verdict();
    result_.endless_as_written = loops_.endless_as_written();
    give_up(loops_.verdict_and_option());
  }

  RunResult too_many_moves(const nc_source& source) {
    return give_up("line " + std::to_string(source.line) + ": " + std::to_string(kMostMovesInBlock) +
                   " moves of this block alone, and it goes on: is a decimal point missing in its words?");
  }

  RunResult stopped() {
    result_.how = RunResult::How::kStopped;
    if (loops_.given_up()) {
      result_.loop = loops_.verdict();
      result_.endless_as_written = loops_.endless_as_written();
    }
    return finish();
  }

  // Ends the run. What has been done so far is kept: the sink is closed as at the end of a program.
  RunResult give_up(std::string why) {
    result_.how = RunResult::How::kEndless;
    result_.error = std::move(why);
    sink_.end(last(), false, work_, world_.machine(), modal_);
    return finish();
  }

  bool handle(nc_item& item) {
    if (item.kind == NC_ITEM_MOVE) {  // most items are, and a jump by a table is foreseen less often than this one
      if (!move(item)) return false;
      if (++moves_in_block_ < kMostMovesInBlock) return true;
      too_many_moves(item.source);
      return false;
    }
    switch (item.kind) {
      case NC_ITEM_ACTION:
        action(item);
        break;
      case NC_ITEM_GATE:
        if (!gate(item)) return false;
        break;
      case NC_ITEM_SYNC:
        if (item.u.sync.what & NC_SYNC_CLOCK) loops_.asked();
        sink_.sync(item.source, item.u.sync.what);
        wear_tool_in_spindle();
        if (items_.answer(world_.answer(item.u.sync.what)) < NC_OK) {
          fail("the control refused the answer to a sync");
          return false;
        }
        // Series 8 G06 goes to and fro until the machine answers otherwise.
        if ((item.u.sync.what & NC_SYNC_INPUT) != 0 && !result_.one_pass && loops_.block_goes_on(item.source, [this] { return items_.program_state(); })) {
          give_up_loop();
          return false;
        }
        break;
      case NC_ITEM_MARK:
        mark(item);
        if (item.u.mark.report && !result_.one_pass && endless_loop(item)) {
          give_up_loop();
          return false;
        }
        break;
      case NC_ITEM_ALARM:
        result_.alarm.source = item.source;
        items_.alarm(&result_.alarm);
        result_.how = RunResult::How::kAlarmed;
        sink_.alarm(result_.alarm);
        break;
      case NC_ITEM_END:
        end(item);
        break;
      default:
        fail("an item of an unknown kind");
        return false;
    }
    return true;
  }

  // All moves can be passed over: none of them may raise an operation alarm, how long it lasts does not depend on its place, and nobody counts how long it cuts.
  bool may_pass() const { return !life_.managed() && world_.clock().is_constant() && (!alarms_ || (!digits_ && !world_.spindle_stands())); }

  bool holds(const nc_item& item) {
    if (!alarms_ || !operation_alarm(item.u.move, world_.spindle_stands() ? 0.0 : 1.0, &result_.alarm)) return false;
    result_.alarm.source = item.source;
    result_.how = RunResult::How::kAlarmed;
    sink_.alarm(result_.alarm);
    sink_.end(item.source, false, work_, world_.machine(), modal_);
    finish();
    return true;
  }

  // False: the run has ended, by an operation alarm or a reset in the middle of the move.
  bool move(nc_item& item) {
    nc_move& move = item.u.move;
    if (move.feed_mm_rev > 0.0 || move.feed_mm_min == 0.0) [[unlikely]]
      if (holds(item)) return false;
    if (move.kind == NC_MOVE_HELIX) world_.clock().set_helix_in_plane(items_.helix_in_plane());
    const double begins = world_.seconds();
    const bool moves = world_.begin(&move);
    const bool whole = runs_through(&move);
    if (!whole) {
      cut_.cut_move(&item, world_.share(move), work_, axis_count_, &items_);
      world_.cut_short();
    }
    world_.arrive(move);
    if (move.kind != NC_MOVE_RAPID) life_.cut(world_.seconds() - begins);
    if (moves && move.length > 0.0) note_move(item);
    return whole || goes_on();
  }

  void note_move(const nc_item& item) {
    work_ = item.u.move.work;
    ++result_.moves;
    result_.length += item.u.move.length;
    if (item.u.move.kind == NC_MOVE_SKIP) sink_.skip_move(item.source, item.u.move, world_.skipped());
    else sink_.move(item.source, item.u.move);
  }

  // Lets the move (nullptr: the dwell) that has begun go on to its end. False: an event ends it before that, a reset or an interrupt of type 1 (M700 13.12).
  bool runs_through(const nc_move* move) {
    while (!world_.go_on()) {
      if (!world_.reset() && world_.macro_interrupt() == interrupt_) continue;
      items_.stand(move != nullptr ? cut_.place(*move, world_.share(*move), &items_) : world_.machine());
      if (world_.reset()) return false;
      interrupt_ = !interrupt_;
      if (items_.interrupt(interrupt_)) return false;
    }
    return true;
  }

  // Behind an item that was cut: false when the run has ended there.
  bool goes_on() {
    if (!world_.reset()) return true;
    reset();
    return false;
  }

  void action(const nc_item& item) {
    const nc_action& action = item.u.action;
    switch (action.kind) {
      case NC_ACTION_M:
        sink_.aux(item.source, 'M', action.value);
        return;
      case NC_ACTION_S:
        world_.clock().speed(action.value);
        sink_.aux(item.source, 'S', action.value);
        return;
      case NC_ACTION_T:
        sink_.aux(item.source, 'T', action.value);
        return;
      case NC_ACTION_B:
        sink_.aux(item.source, action.letter ? action.letter : 'B', action.value);
        return;
      case NC_ACTION_MESSAGE: {
        nc_text text = {};
        items_.text(action.text, &text);
        text.s[sizeof text.s - 1] = 0;
        sink_.message(item.source, action.index, text);
        return;
      }
      case NC_ACTION_CONTROL:
        world_.control(action);
        if (action.index != NC_CONTROL_TOOL_LIFE) return;
        wear_tool_in_spindle();
        life_.mount(action);
        return;
      default:
        return;  // interface outputs and control flags are no events of a trace
    }
  }

  void wear_tool_in_spindle() {
    if (life_.managed()) items_.wear(life_.place(), life_.tool(), life_.take_minutes());
  }

  // False: the run has ended, by a reset in its middle.
  bool gate(nc_item& item) {
    const nc_gate& gate = item.u.gate;
    // The switch of the optional stop decides whether M01 appears in the trace: the stream has only a gate for it, and no action.
    // M700 9.1
    if (gate.kind == NC_GATE_OPTIONAL_STOP && world_.optional_stop()) sink_.aux(item.source, 'M', items_.optional_stop_code());
    if (gate.kind != NC_GATE_DWELL_SECONDS && gate.kind != NC_GATE_DWELL_TURNS) return true;
    const bool turns = gate.kind == NC_GATE_DWELL_TURNS;
    double lasted = world_.begin_dwell(turns, gate.value, gate.skip_mask);
    const bool whole = runs_through(nullptr);
    if (!whole) cut_.cut_dwell(&item, lasted = world_.dwelt(turns));
    if (gate.announce) sink_.dwell(item.source, turns, lasted);
    return whole || goes_on();
  }

  void mark(const nc_item& item) {
    work_ = item.u.mark.work;
    modal_ = item.u.mark.modal;
    moves_in_block_ = 0;
    if (!item.u.mark.report) return;
    last_mark_ = item.serial;
    if (item.u.mark.again) result_.one_pass = one_pass_ || !passes_differ();
    ++result_.blocks;
    sink_.block(item.source, item.u.mark.work, world_.machine());
  }

  bool endless_loop(const nc_item& mark) {
    if (world_.changes()) loops_.asked();
    return loops_.block(mark.source, [this] { return items_.program_state(); });
  }

  bool passes_differ() {
    return passes_.differ([this](uint32_t from, uint32_t* number, double* value) { return items_.next_common(from, number, value); });
  }

  void end(const nc_item& item) {
    ended_ = true;
    if (result_.how != RunResult::How::kAlarmed) result_.how = RunResult::How::kEnded;
    sink_.end(item.source, item.u.end.ok, item.u.end.work, world_.machine(), item.u.end.modal);
  }

  // The end has `ok` set, because no alarm has stopped the program. The block that has just begun was read but is not executed.
  RunResult reset() {
    if (items_.rewind(last_mark_) != NC_OK) return fail("the control cannot go back to the end of the block before the reset");
    items_.reset();
    result_.how = RunResult::How::kReset;
    sink_.end(last(), true, work_, world_.machine(), modal_);
    return finish();
  }

  RunResult fail(std::string why) {
    result_.how = RunResult::How::kFailed;
    result_.error = std::move(why);
    return finish();
  }

  RunResult finish() {
    result_.seconds = world_.seconds();
    return result_;
  }

  ItemSource& items_;
  VirtualWorld& world_;
  RunSink& sink_;
  const bool one_pass_;
  const RunProgress& progress_;
  uint64_t passed_ = 0, next_told_;  // number of blocks so far; number at which progress is told next
  Passes passes_;
  LoopWatch loops_;
  RunResult result_;
  nc_item item_ = NC_INIT(nc_item);  // the last one
  nc_passed past_ = NC_INIT(nc_passed);
  bool passes_moves_ = false;
  nc_axes work_ = {};
  uint64_t silent_ = 0;         // number of blocks since something happened
  uint64_t empty_lines_ = 0;    // number of lines without a block since the last item
  uint32_t furthest_line_ = 0;  // last line of the main program on which a block was executed
  uint64_t moves_in_block_ = 0;
  uint64_t last_mark_ = 0;      // serial number of the last mark
  uint32_t modal_ = 0;
  bool ended_ = false, interrupt_ = false;
  bool alarms_ = false, digits_ = false;  // operation alarms are raised; F1 to F5 may be feeds of one digit
  CutItem cut_;
  LifeMinutes life_;
  const bool cuts_;             // an event of the clock may end an item in its middle
  const unsigned axis_count_;
};

}  // namespace

bool has_decision(std::string_view text) {
  bool comment = false;
  bool matters[256] = {};  // nearly all characters are others
  for (const unsigned char c : {'(', ')', '\n', 'I', 'i', 'W', 'w'}) matters[c] = true;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (!matters[static_cast<unsigned char>(c)]) continue;
    if (c == '(') comment = true;
    if (c == ')' || c == '\n') comment = false;
    const auto is = [&](const char* word, size_t length) {  // small letters count, too, as in the lexer
      for (size_t k = 0; k < length; ++k)
        if (i + k >= text.size() || (text[i + k] & ~0x20) != word[k]) return false;
      return true;
    };
    if (c < 'I' || comment) continue;
    const int capital = c & ~0x20;
    if (capital != 'I' && capital != 'W') continue;
    if (is("IF", 2) || is("WHILE", 5)) return true;
  }
  return false;
}

RunResult run_offline(ItemSource* items, VirtualWorld* world, RunSink* sink, Decides decides,
                      uint64_t max_silent_blocks, bool one_pass, const RunProgress& progress, const LoopLimits& loops, const RoundLimits& rounds) {
  return OfflineRun(items, world, sink, std::move(decides), one_pass, progress, loops, rounds).run(max_silent_blocks);
}

}  // namespace nc::tools
