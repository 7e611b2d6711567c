// SPDX-License-Identifier: Apache-2.0
// Local and common variables and the journal that can undo what was written while reading ahead.
#pragma once

#include "base/arena.hpp"
#include "macro/expression.hpp"
#include "nc/types.h"

namespace nc {

inline constexpr unsigned kLocals = 33;      ///< #1..#33
inline constexpr unsigned kNames = 20;       ///< #500..#519 can have a name (M700 13.5.5)
inline constexpr unsigned kNameLength = 7;
inline constexpr unsigned kLocalLevels = 5;  ///< main program and four macro levels (M700 13.5.2)

/// Which common variables exist (M700 13.4): those of the option `variable_sets`, #900000 up of later models, and what else the machine has.
/// They are apart from one another.
struct CommonRanges {
  static constexpr unsigned kCount = 3 + NC_VARIABLE_RANGES, kExtended = 2;
  uint32_t first[kCount] = {100, 500, 900000};
  uint32_t last[kCount] = {199, 999, 899999};  ///< the third range is empty unless it is set (option: 907399)
  uint32_t size(unsigned i) const { return first[i] == 0 || last[i] < first[i] ? 0 : last[i] - first[i] + 1; }
};

/// Common variables as one part system sees them, with storage for those that are configured: its own, and its copy of those that part systems
/// share (interpret/shared_tables.hpp).
class CommonVariables {
 public:
  void create(const CommonRanges& ranges, Arena& arena);
  const CommonRanges& ranges() const { return ranges_; }
  bool exists(uint32_t number) const;
  /// It is one of #100 up or #500 up, which the parameters of 13.4 divide among part systems.
  bool divided(uint32_t number) const {
    for (unsigned i = 0; i < CommonRanges::kExtended; ++i)
      if (number - ranges_.first[i] < size_[i]) return true;
    return false;
  }
  Value get(uint32_t number) const;  ///< number must exist
  void set(uint32_t number, Value value);
  /// Names of #500..#519, as numbers: base 37, first letter highest; 0 = none.
  double name(unsigned index) const { return name_[index]; }
  void set_name(unsigned index, double code) { name_[index] = code; }
  /// First number >= from that is not vacant; false = none.
  bool next(uint32_t from, uint32_t* number, double* value) const;

 private:
  CommonRanges ranges_;
  unsigned used_ = 0;      ///< no range behind these has a variable
  uint32_t size_[CommonRanges::kCount] = {};
  double* slot_[CommonRanges::kCount] = {};
  double name_[kNames] = {};
};

/// Old values by the block that overwrote them; bounded: the oldest entries go first, and with them the
/// ability to rewind that far.
class Journal {
 public:
  void create(unsigned capacity, Arena& arena);  ///< capacity: power of two
  void note(BlockSeq seq, uint32_t key, Value old);
  BlockSeq oldest() const;  ///< rewinding to seq >= oldest() - 1 is possible
  /// Rewinding to `seq` is possible, and still will be after `more` notes.
  bool keeps(BlockSeq seq, unsigned more) const;
  /// Takes entries newer than `seq` back, newest first, through `undo`.
  template <class Undo>
  void rewind(BlockSeq seq, Undo&& undo);
  /// Entries newer than `seq` change places with what they speak of, newest first (back), or oldest first, which undoes exactly that.
  /// exchange(key, value) puts a value in place and gives what was there.
  template <class Exchange>
  void swap(BlockSeq seq, bool back, Exchange&& exchange);
  void clear();
  /// Someone outside the program has changed `key`: whatever is taken back from now on, it keeps this value.
  void replace(uint32_t key, Value value);

  // ---- of several part systems
  /// Blocks up to `executed` have been executed: give(key, value) is called for each key of theirs that is shared(key), with the value that they
  /// have left, nullptr where it is the present one. Once for each entry.
  template <class Shared, class Give>
  void publish(BlockSeq executed, Shared&& shared, Give&& give);
  /// Another part system has executed a write to `key` before the blocks of this journal that are not published: no rewind brings an older value
  /// back. False: one of those blocks writes `key`, and what it has written stays.
  bool precede(uint32_t key, Value value);
  /// The value that `key` has behind the published blocks; `present` is the one that it has now.
  Value published(uint32_t key, Value present) const;
  /// What the last rewind() has taken back although it was published: take(key).
  template <class Take>
  void each_published_taken_back(Take&& take) const;
  /// Called with the block of an entry that is not published yet and is going to be lost.
  void before_loss(void* self, void (*call)(void* self, BlockSeq seq)) {
    loser_ = self;
    before_loss_ = call;
  }

 private:
  struct Entry {
    BlockSeq seq;
    double number;
    uint32_t key;
    bool vacant;
  };
  Entry* ring_ = nullptr;
  uint32_t mask_ = 0;
  uint64_t head_ = 0, tail_ = 0;
  BlockSeq lost_ = 0;
  uint64_t published_ = 0;        ///< entries below this number are
  uint64_t published_before_ = 0; ///< the same before the last rewind
  void* loser_ = nullptr;
  void (*before_loss_)(void* self, BlockSeq seq) = nullptr;
};

/// Variables of one part system.
class Variables {
 public:
  void create(CommonVariables* common, unsigned journal_capacity, Arena& arena);
  /// Of several part systems all share the common variables up to `last_100` and `last_500` (M700 13.4, #1303, #1304), as they do those of later
  /// models and of further ranges, and the names.
  void share(uint32_t last_100, uint32_t last_500) {
    shared_100_ = last_100;
    shared_500_ = last_500;
  }
  uint32_t shared_100() const { return shared_100_; }
  uint32_t shared_500() const { return shared_500_; }
  /// The variable is one that part systems share, or the key is that of such a variable or of a name.
  bool shares(uint32_t key) const {
    if (key >= kNameKey) return key < kLocalKey;
    if (!common_->exists(key)) return false;
    return !common_->divided(key) || key <= (key < 500 ? shared_100_ : shared_500_);
  }
  /// What a key stands for now; a foreign one is the caller's.
  Value value_of(uint32_t key) const;
  Journal& journal() { return journal_; }
  /// Journal::precede() for a key that is not foreign, with the value in place where it counts from now on.
  void take_published(uint32_t key, Value value) {
    if (journal_.precede(key, value)) put(key, value);
  }
  bool next(uint32_t from, uint32_t* number, double* value) const { return common_->next(from, number, value); }

  /// Local or common variable; false when the number is neither (system variables are
  /// interpret/system_variables.hpp).
  bool get(uint32_t number, unsigned level, Value* value) const;
  bool set(uint32_t number, unsigned level, Value value, BlockSeq seq);

  /// The stored #1..#33 of a level: NaN = vacant.
  const double* locals(unsigned level) const { return local_[level]; }
  /// Locals of `level` become `arguments` (33 values).
  void enter(unsigned level, const Value* arguments, BlockSeq seq);
  /// rewind(seq) is possible, and still will be when one more block has been executed.
  bool keeps(BlockSeq seq) const { return journal_.keeps(seq, kMostWrites); }
  static constexpr unsigned kMostWrites = 512;  ///< of a block: each of its words and statements writes a few numbers
  void clear_locals(BlockSeq seq);

  /// SETVN: capitals and digits, 1..kNameLength of them; false when the variable cannot have a name.
  bool set_name(uint32_t number, const char* name, size_t length, BlockSeq seq);
  /// The same by the host, NUL-terminated; "" takes the name away. No rewind undoes it.
  bool name_from_outside(uint32_t number, const char* name);
  bool find_name(const char* name, size_t length, uint32_t* number) const;
  /// The name of a variable, without end; 0 = none. `name` has kNameLength places.
  unsigned name_of(uint32_t number, char* name) const;

  /// Journal key for something that is not a variable (offset tables, outputs): the owner undoes it in
  /// rewind().
  void note(BlockSeq seq, uint32_t key, double old);
  /// A write that no block made (the host's): rewind() keeps it. For a foreign key the caller has changed it
  /// already.
  bool set_from_outside(uint32_t number, unsigned level, Value value);
  void changed_from_outside(uint32_t key, double value) { journal_.replace(key, Value::of(value)); }
  /// A run begins: its blocks count from 0 again, and nothing from before can be taken back.
  void forget() { journal_.clear(); }
  static constexpr uint32_t kForeignKey = 0x40000000;  ///< keys from here on belong to the caller

  /// Undo every write made by blocks after `seq`; false when the journal does not reach back that far.
  /// foreign(self, key, old) is called for foreign keys.
  bool rewind(BlockSeq seq, void* self, void (*foreign)(void* self, uint32_t key, double old));
  /// Everything is as blocks up to `seq` have left it (back), and as it was before that: nothing may be written in between. For foreign
  /// keys foreign(self, key, value) exchanges.
  void swap(BlockSeq seq, bool back, void* self, double (*foreign)(void* self, uint32_t key, double value));

 private:
  // Journal keys of names and of local variables: beside the numbers of common variables, below kForeignKey.
  static constexpr uint32_t kNameKey = 0x10000000;
  static constexpr uint32_t kLocalKey = 0x20000000;
  static constexpr uint32_t local_key(unsigned level, unsigned number) { return kLocalKey | level << 8 | number; }
  void put(uint32_t key, Value value);

  CommonVariables* common_ = nullptr;
  uint32_t shared_100_ = 0, shared_500_ = 0;
  Journal journal_;
  double (*local_)[kLocals] = nullptr;
};

template <class Undo>
void Journal::rewind(BlockSeq seq, Undo&& undo) {
  published_before_ = published_;
  while (head_ != tail_ && ring_[(head_ - 1) & mask_].seq > seq) {
    --head_;
    const Entry& e = ring_[head_ & mask_];
    undo(e.key, Value{e.number, e.vacant});
  }
  if (published_ > head_) published_ = head_;
}

template <class Shared, class Give>
void Journal::publish(BlockSeq executed, Shared&& shared, Give&& give) {
  while (published_ != head_ && ring_[published_ & mask_].seq <= executed) {
    const uint32_t key = ring_[published_++ & mask_].key;
    if (!shared(key)) continue;
    uint64_t newer = published_;
    while (newer != head_ && ring_[newer & mask_].key != key) ++newer;
    const Entry& e = ring_[newer & mask_];
    const Value then{e.number, e.vacant};
    give(key, newer != head_ ? &then : nullptr);
  }
}

template <class Take>
void Journal::each_published_taken_back(Take&& take) const {
  for (uint64_t i = head_; i < published_before_; ++i) take(ring_[i & mask_].key);
}

template <class Exchange>
void Journal::swap(BlockSeq seq, bool back, Exchange&& exchange) {
  uint64_t first = head_;
  while (first != tail_ && ring_[(first - 1) & mask_].seq > seq) --first;
  for (uint64_t n = 0; n < head_ - first; ++n) {
    Entry& e = ring_[(back ? head_ - 1 - n : first + n) & mask_];
    const Value old = exchange(e.key, Value{e.number, e.vacant});
    e.number = old.number;
    e.vacant = old.vacant;
  }
}

}  // namespace nc
