// SPDX-License-Identifier: Apache-2.0
// What the part systems of a control share: the tool table, the table of tool life, the common variables that M700 13.4 (#1303, #1304) does not give to each of them separately,
// those of later models and of further ranges, the names of #500 up, and the parameters of the whole control (is_common()).
//
// Each part system reads ahead with its own copy of these, so that a rewind takes back only what it has written itself. When the machine has executed a
// block, what that block has written to shared places is published: it goes into the copies of the others, as if it was written before the blocks that
// these have read ahead and not executed. So all copies agree about what has been executed, and each also has what its own program will do next.
//
// A program that reads a shared place waits until the machine has come to its block (NC_SYNC_SHARED): then everything that the others have executed is in
// its copy. Tool data selected by H and D are read from the copy without waiting, as with a single part system.
#pragma once

#include <cstdint>

#include "interpret/shared_history.hpp"
#include "macro/variables.hpp"
#include "stream/stream.hpp"

namespace nc {

struct Interpreter;

/// All functions are called in the feeder thread.
class SharedTables {
 public:
  /// For `systems` part systems that read `look_ahead` blocks ahead.
  void create(unsigned systems, unsigned look_ahead, Arena& arena);
  /// Adds a part system. To be called once for each of a control, after all have been created.
  void join(Interpreter& in);

  /// The machine has executed the blocks of `writer` up to `executed`.
  void publish(Interpreter& writer, BlockSeq executed);
  /// Everything that `writer` has published since block `seq` can be taken back. (Offline a host may go back to any mark.)
  bool reaches(const Interpreter& writer, BlockSeq seq) const { return history_.reaches(number_of(writer), seq); }
  /// The blocks of `writer` after `seq` have been taken back: what they had published is taken back as well. What another part system has written to the
  /// same places since then stays.
  void take_back(Interpreter& writer, BlockSeq seq);
  /// The program of `writer` has ended or was given up: everything that it has published stays.
  void keep_for_good(const Interpreter& writer) { history_.keep_for_good(number_of(writer)); }

  // Writes by the host: they hold for all part systems, and no rewind undoes them.
  void set_variable(uint32_t number, Value value);
  void set_name(uint32_t number, const char* name);
  void set_tool(unsigned key, double value);
  /// write(in) writes to the shared place `key` in the copy of one part system.
  template <class Write>
  void write_to_all(uint32_t key, Write&& write) {
    for (unsigned i = 0; i < count_; ++i) write(*system_[i]);
    changed_by_host(*system_[0], key);
  }
  /// The parameter `index` of `in` has been changed.
  void parameter_changed(const Interpreter& in, unsigned index);

  /// The journal key is that of a place which part systems share.
  static bool shares(const Interpreter& in, uint32_t key);

 private:
  void changed_by_host(const Interpreter& in, uint32_t key);
  unsigned number_of(const Interpreter& in) const;
  void publish_to_others(const Interpreter& writer, uint32_t key, JournalValue value);
  static bool same_place(Interpreter& to, const Interpreter& from, uint32_t key, uint32_t* there);
  void divide_again(const uint32_t (&last)[2]);
  void divide_again(uint32_t first, uint32_t end, bool common);
  Interpreter* system_[NC_MAX_SYSTEMS] = {};
  unsigned count_ = 0;
  SharedHistory history_;  ///< its keys are those of the first part system
  uint32_t last_[2] = {};  ///< last shared variable of each range of common variables, as the copies are divided now
};

}  // namespace nc
