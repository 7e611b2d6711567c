// SPDX-License-Identifier: Apache-2.0
// Runs one program offline from its first item to its last: pulls the items, lets the virtual world execute them
// and reports them to a sink.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "nc/nc.h"
#include "tools/lib/item_source.hpp"
#include "tools/lib/loop_watch.hpp"
#include "tools/lib/virtual_world.hpp"

namespace nc::tools {

/** What an offline run reports; every function does nothing unless it is overridden. */
class RunSink {
 public:
  virtual ~RunSink() = default;
  /** False: it needs no move(), and moves are only counted, which takes less time. */
  virtual bool takes_moves() const { return true; }
  virtual void move(const nc_source&, const nc_move&) {}
  /** A skip move as it was executed; `skipped`: its signal ended it. */
  virtual void skip_move(const nc_source& source, const nc_move& done, bool /*skipped*/) { move(source, done); }
  virtual void block(const nc_source&, const nc_axes& /*work*/, const nc_axes& /*machine*/) {}
  virtual void aux(const nc_source&, char /*code*/, double /*value*/) {}
  virtual void dwell(const nc_source&, bool /*turns*/, double /*value*/) {}
  virtual void sync(const nc_source&, uint32_t /*what*/) {}
  virtual void message(const nc_source&, uint32_t /*port*/, const nc_text& /*text*/) {}
  virtual void alarm(const nc_alarm&) {}
  virtual void end(const nc_source&, bool /*ok*/, const nc_axes& /*work*/, const nc_axes& /*machine*/,
                   uint32_t /*modal*/) {}
  /** True when the run is to stop, because the output cannot be written. */
  virtual bool stop() const { return false; }
};

/** How a run ended. */
struct RunResult {
  enum class How { kEnded, kAlarmed, kReset, kStopped, kEndless, kFailed };
  How how = How::kFailed;
  nc_alarm alarm = {};  // for kAlarmed
  std::string error;    // for kFailed; for kEndless the loop that was given up
  std::string loop;     // that loop, without an option of ncsim; "" where it is none. For kStopped one that is under way
  uint64_t blocks = 0, moves = 0;
  bool endless_as_written = false;  // with kEndless and kStopped: that loop has no end by what is written, and comes to new states
  bool silent = false;    // with kEndless: so many blocks in a row did nothing that the machine would notice
  bool one_pass = false;  // with kEnded: the run ended where M99 would begin the main program again
  double length = 0.0;    // mm
  double seconds = 0.0;   // on the clock of the trace
};

/** True when the text of a main program has an IF or a WHILE outside of comments. */
bool has_decision(std::string_view text);

/** Says has_decision() of the main program. It is asked only where the main program begins again, because the text may be long; one that
 * is empty says no. */
using Decides = std::function<bool()>;

/**
 * Whether a main program that M99 begins again may come to an end by itself: it has a decision (IF or WHILE), and the
 * common variables have changed since its head was passed last. Otherwise it would run for ever.
 */
class Passes {
 public:
  explicit Passes(Decides decides) : decides_(std::move(decides)) {}
  /** To be called at the head of the first pass. `next` is like nc_variable_next(). */
  template <typename Next>
  void begin(const Next& next) {
    before_ = variables(next);
  }
  /** To be called at the head of each further pass. */
  template <typename Next>
  bool differ(const Next& next) {
    if (!known_) known_ = decides_ && decides_();
    if (!*known_) return false;
    Variables now = variables(next);
    const bool differs = now != before_;
    before_ = std::move(now);
    return differs;
  }

 private:
  using Variables = std::vector<std::pair<uint32_t, double>>;
  template <typename Next>
  static Variables variables(const Next& next) {
    Variables all;
    uint32_t number = 0;
    double value = 0.0;
    for (uint32_t from = 0; next(from, &number, &value); from = number + 1) all.emplace_back(number, value);
    return all;
  }

  const Decides decides_;
  std::optional<bool> known_;  // what it has said
  Variables before_;
};

/**
 * Reports the progress of a long run: `tell` is called with the block that has ended after `first` blocks, then after twice as many,
 * and so on. A loop with moves never ends, and no number of blocks distinguishes it from a long program, so the user has to judge.
 */
struct RunProgress {
  uint64_t first = 10'000'000;
  std::function<void(const nc_source&, uint64_t blocks)> tell = {};
};

/**
 * Runs the program to its end. The run is given up after `max_silent_blocks` blocks in a row that only calculate and jump, and after more passes of a
 * loop than `loops` allows; 0 = no limit. Blocks that read the clock are not counted: time passes, so a waiting loop ends. Where M99
 * would begin the main program again, the run ends; without `one_pass` it goes on there if the passes differ (Passes).
 * @param rounds when a loop that counts is given up because its text has no end
 * @param decides has_decision() of the main program, asked at the end of its first pass
 */
RunResult run_offline(ItemSource* items, VirtualWorld* world, RunSink* sink, Decides decides,
                      uint64_t max_silent_blocks, bool one_pass = false, const RunProgress& progress = {},
                      const LoopLimits& loops = LoopLimits::all(0), const RoundLimits& rounds = {});

}  // namespace nc::tools
