// SPDX-License-Identifier: Apache-2.0
// The program store: texts by name and O number, read through a read-at callback in windows, never whole.
#pragma once

#include "alarm/condition.hpp"
#include "base/arena.hpp"
#include "nc/control.h"
#include "program/block.hpp"
#include "program/window.hpp"

namespace nc {

/// A place in a text where a program begins.
struct ProgramRef {
  uint16_t file = 0xffff;  ///< 0xffff = none
  uint32_t number = 0;     ///< O number, 0 = none
  uint64_t offset = 0;     ///< its first block (the O line itself, or the start of the text)
  uint32_t line = 1;
  bool valid() const { return file != 0xffff; }
  bool operator==(const ProgramRef&) const = default;
};

/// Shared by all part systems of a control.
class ProgramStore {
 public:
  /// `reserved` places more are for texts of the control's own (MDI), whatever the host has entered.
  void create(unsigned capacity, unsigned reserved, Arena& arena);
  nc_status add(const TextEntry& entry, const char* name, unsigned* file, bool own = false);
  /// Frees the place of an entry that nothing refers to.
  void remove(unsigned file);
  /// It is used now.
  void touch(unsigned file) { entries_[file].used = ++uses_; }
  /// A part system (counted from 0) keeps a reference beside its state, until forget_notes().
  void note(unsigned file, unsigned system) { entries_[file].noted |= static_cast<uint8_t>(1u << system); }
  void forget_notes(unsigned system);
  void on_missing(nc_program_missing callback, void* user, nc_control* control);
  const TextEntry* entry(unsigned file) const;
  void set_edited(unsigned file, bool edited) { entries_[file].edited = edited; }
  /// The text is that of MDI: it may have several blocks in a line.
  void set_mdi(unsigned file) { entries_[file].mdi = true; }
  /// The text is a tape in the code of nc_tape, read by `unit`: looks for its label. False: the text cannot be read.
  bool set_tape(unsigned file, uint8_t code, uint8_t unit);
  /// By the whole name; case is ignored.
  int find_exactly(const char* name) const;
  /// By name without folder; case is ignored; with or without an ending.
  int find_name(const char* name, size_t length) const;
  int find_number(uint32_t number) const;
  /// Asks the host. True when it has added something.
  bool ask_host(const char* name);

 private:
  TextEntry* entries_ = nullptr;
  unsigned capacity_ = 0, reserved_ = 0, count_ = 0;  ///< places behind count_ have never been used
  unsigned given_ = 0;                                ///< entries of the host
  uint64_t uses_ = 0;
  uint32_t generation_ = 0;  ///< of the newest entry; unique in the store
  nc_program_missing missing_ = nullptr;
  void* missing_user_ = nullptr;
  nc_control* control_ = nullptr;
};

/// Reads blocks of the texts of a store for one part system: window, compiled-block cache, searches.
class BlockReader {
 public:
  void create(ProgramStore* store, const LexRules* rules, unsigned window_bytes, unsigned cached_blocks,
              Arena& arena);

  /// The block at `offset` (first character) of `file`, compiled; from the cache when it is there. The
  /// reference holds until the next call of read(); searching leaves it alone. At the end of the text: a
  /// Block with end_of_text. nullptr when the read callback failed.
  const Block* read(unsigned file, uint64_t offset, uint32_t line);

  /// Program `number`: an entry of the store by number; else an O line inside `own_file`; else whatever the
  /// host adds.
  ProgramRef find_program(uint32_t number, unsigned own_file);
  ProgramRef find_program(const char* name, size_t length);
  /// A program outside the memory: by name, or by number where `length` is 0. In the store and for the host its name begins with
  /// `place`: "198:" the data server (M198), "D1:" to "D4:" a device (M98 ,D).
  ProgramRef find_external(const char* place, const char* name, size_t length, uint32_t number);
  /// The block at `offset` without disturbing the one that read() gave.
  const Block* peek(unsigned file, uint64_t offset = 0, uint32_t line = 1);

  /// First block with sequence number n in [offset, limit); limit 0 = the end of the program (a '%', the next
  /// O line, the end of the text). Blocks with a skip sign count (M700 13.5.7). False when there is none.
  /// Interruptible: gives up after `budget` bytes with *offset at where to go on and *again = true. budget 0
  /// = no limit. `from_head`: *offset is where a program begins, so an O line (or, at the start of the text,
  /// '%' before it) does not end it.
  bool find_sequence(unsigned file, uint32_t n, uint64_t* offset, uint32_t* line, uint64_t limit,
                     uint64_t budget, bool* again, bool from_head = true);

  /// Start of the block behind the END m that belongs to the DO m whose block ends at *offset (nesting
  /// respected); false = none.
  bool find_loop_end(unsigned file, uint32_t m, uint64_t* offset, uint32_t* line);

  /// Input devices whose tapes have the number of characters in each block checked, bit n = unit n (M700 3.6 (2)).
  void check_block_parity(uint32_t units) { parity_units_ = units; }
  /// By parameter ';' begins a comment, in families that know it and in texts that are not MDI.
  void semicolon_begins_comment(bool comments);
  bool is_tape(unsigned file) const { return store_->entry(file)->tape != NC_TAPE_NONE; }

  /// Why the last read or search came to nothing: read_failed or program_changed; none where the text could be read.
  Condition failure() const {
    return failure_ == 0 ? Condition::none : failure_ == NC_READ_CHANGED ? Condition::program_changed : Condition::read_failed;
  }

  /// Same program text, different content: forget compiled blocks of a file.
  void forget(unsigned file);

 private:
  static constexpr unsigned kWays = 4;     ///< slots of the cache where a block may lie; power of two
  static constexpr unsigned kSeen = 8;     ///< texts whose extent of reading is remembered
  static constexpr unsigned kIndexes = 2;  ///< texts whose O lines are remembered
  static constexpr unsigned kJumps = 64;  ///< searches for sequence numbers that are remembered; power of two
  static constexpr unsigned kIndexed = 64;  ///< O lines of each; those beyond are looked for every time

  /// Name of a compiled block: generations are unique in the store.
  struct Tag {
    uint64_t offset = 0;
    uint32_t generation = 0;  ///< 0 = free
    uint32_t follower = 0;    ///< slot of the block that was read behind this one: a guess
  };
  /// How far a text has been read. Blocks beyond are read for the first time and most likely the last: they
  /// are not cached.
  struct Seen {
    uint64_t end = 0;
    uint32_t generation = 0;
  };
  /// A search for a sequence number and what came of it: a GOTO in a loop looks once.
  struct Jump {
    uint64_t from = 0, limit = 0, offset = 0;
    uint32_t generation = 0, n = 0, line = 0;
    bool from_head = false, found = false;
  };
  struct Index {
    uint64_t scanned = 0;  ///< where looking for O lines goes on
    uint32_t scanned_line = 1;
    uint32_t generation = 0;
    unsigned count = 0;
    bool complete = false;
    ProgramRef at[kIndexed];
  };

  const Block* cached(const TextEntry& entry, uint64_t offset, uint32_t line);
  const Block* miss(const TextEntry& entry, unsigned file, uint64_t offset, uint32_t line);
  bool compile(const TextEntry& entry, unsigned file, uint64_t offset, uint32_t line, Block& block);
  bool compile_here(const TextEntry& entry, uint64_t offset, Block& block, bool* newline);
  bool compile_long(const TextEntry& entry, uint64_t offset, Block& block, bool* newline);
  bool failed();
  Condition parity_fault(const TextEntry& entry, uint64_t begin, uint64_t end) const;
  static bool has_parity(const TextEntry& entry, uint64_t begin);
  Semicolon semicolon_of(const TextEntry& entry) const;
  Seen& seen(uint32_t generation);
  unsigned find_slot(uint32_t generation, uint64_t offset) const;
  static size_t hash(uint32_t generation, uint64_t offset);
  Index& index(const TextEntry& entry);
  Jump scan_for_sequence(const TextEntry& entry, uint32_t line, const Jump& wanted, uint64_t budget,
                         bool* again, bool* failed);
  ProgramRef find_o_line(uint32_t number, unsigned file);

  ProgramStore* store_ = nullptr;
  const LexRules* rules_ = nullptr;
  bool comments_ = false;  ///< semicolon_begins_comment()
  long failure_ = 0;  ///< what the read callback gave in the last read or search; 0 = the text
  TextWindow window_;
  Block* first_time_ = nullptr;  ///< block that is being read for the first time
  Block* searched_ = nullptr;    ///< block that a search looks at
  Block* cache_ = nullptr;
  Tag* tags_ = nullptr;
  unsigned slots_ = 0;  ///< power of two, at least kWays, or 0
  unsigned next_way_ = 0;
  unsigned last_slot_ = 0;  ///< of the block read last
  Seen seen_[kSeen];
  unsigned seen_used_ = 0;  ///< entry of seen_ last used
  uint32_t parity_units_ = 0;
  Index* indexes_ = nullptr;
  Jump* jumps_ = nullptr;
  unsigned index_used_ = 0;
};

}  // namespace nc
