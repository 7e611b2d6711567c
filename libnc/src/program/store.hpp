// SPDX-License-Identifier: Apache-2.0
// The program store: texts with their names and O numbers. They are read piece by piece through a read-at callback, never as a whole.
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

/// The numbers of programs in a family's language.
struct ProgramNumbers {
  char letter;       ///< that names of files begin with; 0 = O, where the language has none
  uint32_t largest;  ///< a longer number is no number of a program
};

/// Shared by all part systems of a control.
class ProgramStore {
 public:
  /// `reserved` more places are kept for texts of the control itself (MDI), however many texts the host enters.
  void create(unsigned capacity, unsigned reserved, ProgramNumbers numbers, Arena& arena);
  char number_letter() const { return numbers_.letter; }
  /// The number that a text of this name has; 0 = none.
  uint32_t number_of(const char* name) const;
  nc_status add(const TextEntry& entry, const char* name, unsigned* file, bool own = false);
  /// Frees the place of an entry that nothing refers to.
  void remove(unsigned file);
  /// Notes that the program is used now.
  void touch(unsigned file) { entries_[file].used = ++uses_; }
  /// Notes that a part system (from 0) refers to the program in tables outside of its state, until forget_notes().
  void note(unsigned file, unsigned system) { entries_[file].noted |= static_cast<uint8_t>(1u << system); }
  void forget_notes(unsigned system);
  void on_missing(nc_program_missing callback, void* user, nc_control* control);
  const TextEntry* entry(unsigned file) const;
  void set_edited(unsigned file, bool edited) { entries_[file].edited = edited; }
  /// Notes that the text is one of MDI, in which a line may hold several blocks.
  void set_mdi(unsigned file) { entries_[file].mdi = true; }
  /// Notes that the text is a tape, `code` being an nc_tape, read by input device `unit`, and finds the end of its label. False: the text cannot be read.
  bool set_tape(unsigned file, uint8_t code, uint8_t unit);
  // The following find an entry, -1 = there is none.
  /// Finds it by its whole name; upper and lower case are the same.
  int find_exactly(const char* name) const;
  /// Finds it by its name without the folder, with or without the ending; upper and lower case are the same.
  int find_name(const char* name, size_t length) const;
  int find_number(uint32_t number) const;
  /// Asks the host for a program. True when the host has added one.
  bool ask_host(const char* name);

 private:
  TextEntry* entries_ = nullptr;
  unsigned capacity_ = 0, reserved_ = 0, count_ = 0;  ///< places behind count_ have never been used
  ProgramNumbers numbers_{};
  unsigned given_ = 0;                                ///< number of entries of the host
  uint64_t uses_ = 0;
  uint32_t generation_ = 0;  ///< of the newest entry; unique in the store
  nc_program_missing missing_ = nullptr;
  void* missing_user_ = nullptr;
  nc_control* control_ = nullptr;
};

/// Reads blocks of the texts of a store for one part system: with a window, a cache of compiled blocks, and searches.
class BlockReader {
 public:
  void create(ProgramStore* store, const LexRules* rules, unsigned window_bytes, unsigned cached_blocks,
              Arena& arena);

  /// The compiled block whose first character is at `offset` of `file`, from the cache when it is there. It is valid until the next call of read();
  /// searches do not change it. At the end of the text: a Block with end_of_text. nullptr when the read callback has failed.
  const Block* read(unsigned file, uint64_t offset, uint32_t line);

  /// Program `number`: an entry of the store with this number; else an O line inside `own_file`; else the program that the host adds.
  ProgramRef find_program(uint32_t number, unsigned own_file);
  ProgramRef find_program(const char* name, size_t length);
  /// A program outside the memory, by its name, or by its number where `length` is 0. Its name in the store, and for the host, begins with `place`:
  /// "198:" for the data server (M198), "D1:" to "D4:" for a device (M98 ,D).
  ProgramRef find_external(const char* place, const char* name, size_t length, uint32_t number);
  /// The compiled block at `offset`; the block that read() has given stays valid.
  const Block* peek(unsigned file, uint64_t offset = 0, uint32_t line = 1);

  /// First block with sequence number n in [offset, limit); limit 0 = up to the end of the program (a '%', the next O line, the end of the text). Blocks
  /// with a skip sign count, too (M700 13.5.7). False when there is none. The search can be interrupted: after `budget` bytes it returns false with
  /// *again = true and *offset at where it has to go on; budget 0 = no limit. `from_head`: *offset is where a program begins, so that its own O line
  /// (or, at the start of the text, a '%' before it) does not end the search.
  bool find_sequence(unsigned file, uint32_t n, uint64_t* offset, uint32_t* line, uint64_t limit,
                     uint64_t budget, bool* again, bool from_head = true);

  /// Start of the block behind the END m that belongs to the DO m whose block ends at *offset; loops in between are respected. False = there is none.
  bool find_loop_end(unsigned file, uint32_t m, uint64_t* offset, uint32_t* line);

  /// Sets the input devices on whose tapes the number of characters of each block is checked, bit n = unit n (M700 3.6 (2)).
  void check_block_parity(uint32_t units) { parity_units_ = units; }
  /// Sets whether ';' begins a comment, as a parameter may say. It holds in families that know ';', and not for MDI.
  void semicolon_begins_comment(bool comments);
  bool is_tape(unsigned file) const { return store_->entry(file)->tape != NC_TAPE_NONE; }

  /// Why the text could not be read in the last read or search: read_failed or program_changed; none where it could.
  Condition failure() const {
    return failure_ == 0 ? Condition::none : failure_ == NC_READ_CHANGED ? Condition::program_changed : Condition::read_failed;
  }

  /// The content of a text has changed: forgets the compiled blocks of the file.
  void forget(unsigned file);

 private:
  friend class HeadScanner;
  static constexpr unsigned kWays = 4;     ///< number of slots of the cache in which a block may lie; power of two
  static constexpr unsigned kSeen = 8;     ///< number of texts for which it is remembered how far they have been read
  static constexpr unsigned kIndexes = 2;  ///< number of texts whose O lines are remembered
  static constexpr unsigned kJumps = 64;  ///< number of searches for sequence numbers that are remembered; power of two
  static constexpr unsigned kIndexed = 64;  ///< O lines remembered of each text; further ones are searched for every time

  /// Name of a compiled block: generations are unique in the store.
  struct Tag {
    uint64_t offset = 0;
    uint32_t generation = 0;  ///< 0 = free
    uint32_t follower = 0;    ///< slot of the block that was read after this one, as a guess for the next time
  };
  /// How far a text has been read. Blocks beyond that are read for the first time, and most likely the last time: they are not cached.
  struct Seen {
    uint64_t end = 0;
    uint32_t generation = 0;
  };
  /// A search for a sequence number and its result, so that a GOTO in a loop searches only once.
  struct Jump {
    uint64_t from = 0, limit = 0, offset = 0;
    uint32_t generation = 0, n = 0, line = 0;
    bool from_head = false, found = false;
  };
  struct Index {
    uint64_t scanned = 0;  ///< where the search for further O lines goes on
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
  bool refuse_long(const TextEntry& entry, uint64_t offset, Block& block, bool* newline);
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
  bool comments_ = false;  ///< set by semicolon_begins_comment()
  long failure_ = 0;  ///< what the read callback returned when it failed in the last read or search; 0 = it did not fail
  TextWindow window_;
  Block* first_time_ = nullptr;  ///< block that is being read for the first time
  Block* searched_ = nullptr;    ///< block that a search looks at
  Block* cache_ = nullptr;
  Tag* tags_ = nullptr;
  unsigned slots_ = 0;  ///< power of two, at least kWays, or 0
  unsigned next_way_ = 0;
  unsigned last_slot_ = 0;  ///< slot of the block read last
  Seen seen_[kSeen];
  unsigned seen_used_ = 0;  ///< entry of seen_ last used
  uint32_t parity_units_ = 0;
  Index* indexes_ = nullptr;
  Jump* jumps_ = nullptr;
  unsigned index_used_ = 0;
};

}  // namespace nc
