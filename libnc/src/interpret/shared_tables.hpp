// SPDX-License-Identifier: Apache-2.0
// What the part systems of a control have in common: the tool table, the common variables that M700 13.4 (#1303, #1304) does not give to each of
// them, those of later models and of further ranges, the names of #500 up, the parameters that are the control's (is_common()).
//
// Each part system reads ahead with a copy of its own, so that what it takes back is what it has written itself. When the machine has executed a
// block, what that block has written to shared places is published: it goes into the copies of the others, in front of what these have read
// ahead and not executed. So all copies agree in what has been executed, and each has in front of that what its own program is going to do.
//
// A program that reads a shared place waits until the machine has come there (NC_SYNC_SHARED): by then everything that the others have executed
// is in its copy. Tool data that H and D select are read from the copy as they are, like those of one part system.
#pragma once

#include <cstdint>

#include "interpret/shared_history.hpp"
#include "macro/variables.hpp"
#include "stream/stream.hpp"

namespace nc {

struct Interpreter;

/// All calls are made by the feeder's thread.
class SharedTables {
 public:
  /// For `systems` part systems that look `look_ahead` blocks ahead.
  void create(unsigned systems, unsigned look_ahead, Arena& arena);
  /// All part systems of a control, once, when they have been created.
  void join(Interpreter& in);

  /// The machine has executed the blocks of `writer` up to `executed`.
  void publish(Interpreter& writer, BlockSeq executed);
  /// Offline a host can go back to any mark. False: of what `writer` has published since block `seq` some is no longer known.
  bool reaches(const Interpreter& writer, BlockSeq seq) const { return history_.reaches(number_of(writer), seq); }
  /// Blocks of `writer` behind `seq` have been taken back: what of theirs had been published is taken back as well. What another part system has
  /// written since stays.
  void take_back(Interpreter& writer, BlockSeq seq);
  /// All that `writer` has published stays: its program has ended or was given up.
  void keep_for_good(const Interpreter& writer) { history_.keep_for_good(number_of(writer)); }

  // What the host writes is so for all of them, and no rewind undoes it.
  void set_variable(uint32_t number, Value value);
  void set_name(uint32_t number, const char* name);
  void set_tool(unsigned key, double value);
  /// The parameter `index` of `in` has been changed.
  void parameter_changed(const Interpreter& in, unsigned index);

  /// Journal key of a place that part systems share.
  static bool shares(const Interpreter& in, uint32_t key);

 private:
  void changed_by_host(const Interpreter& in, uint32_t key);
  unsigned number_of(const Interpreter& in) const;
  void publish_to_others(const Interpreter& writer, uint32_t key, JournalValue value);
  static bool same_place(Interpreter& to, const Interpreter& from, uint32_t key, uint32_t* there);
  void divide_again(uint32_t last_100, uint32_t last_500);
  void divide_again(uint32_t first, uint32_t end, bool common);
  Interpreter* system_[NC_MAX_SYSTEMS] = {};
  unsigned count_ = 0;
  SharedHistory history_;  ///< by the keys of the first part system
  uint32_t last_100_ = 0, last_500_ = 0;  ///< as the copies are divided now
};

}  // namespace nc
