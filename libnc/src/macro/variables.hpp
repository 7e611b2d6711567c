// SPDX-License-Identifier: Apache-2.0
// Local and common variables. What blocks write to them while reading ahead is journalled (macro/journal.hpp).
#pragma once

#include "base/arena.hpp"
#include "macro/expression.hpp"
#include "macro/journal.hpp"
#include "macro/named_parameters.hpp"
#include "nc/types.h"

namespace nc {

inline constexpr unsigned kLocals = 33;      ///< #1..#33, which take the words of a macro call
inline constexpr unsigned kMostLocals = 99;  ///< #1..#99 are the local variables that a family can have (HX 14.2.3)
inline constexpr unsigned kNames = 20;       ///< most variables that can have a name (M700 13.5.5)
inline constexpr unsigned kNameLength = 7;   ///< most characters of a name
/// A name, filled up with zeros; empty = none.
struct VariableName {
  char text[kNameLength + 1] = {};
  bool operator==(const VariableName&) const = default;
};
inline constexpr unsigned kLocalLevels = 5;  ///< main program and four macro levels (M700 13.5.2)

/// Which common variables exist (M700 13.4): the two ranges of the family, that of later models, and the further ranges of the machine. The ranges do not
/// overlap; one that does not exist is empty.
struct CommonRanges {
  static constexpr unsigned kCount = 3 + NC_VARIABLE_RANGES, kExtended = 2;
  uint32_t first[kCount] = {};
  uint32_t last[kCount] = {};
  uint32_t first_named = 0, named = 0;  ///< those that can have a name: the first, and how many
  uint32_t size(unsigned i) const { return first[i] == 0 || last[i] < first[i] ? 0 : last[i] - first[i] + 1; }
};

/// The common variables of one part system: those of its own, and its copy of those that all part systems share (interpret/shared_tables.hpp).
class CommonVariables {
 public:
  void create(const CommonRanges& ranges, Arena& arena);
  const CommonRanges& ranges() const { return ranges_; }
  bool exists(uint32_t number) const;
  /// Which of the two ranges of the family the variable belongs to, of which parameters decide what part systems share (M700 13.4); kExtended = none of them.
  unsigned divided(uint32_t number) const {
    unsigned i = 0;
    while (i < CommonRanges::kExtended && number - ranges_.first[i] >= size_[i]) ++i;
    return i;
  }
  Value get(uint32_t number) const;  ///< number must exist
  void set(uint32_t number, Value value);
  /// Names of the variables that can have one, from the first of them on.
  const VariableName& name(unsigned index) const { return name_[index]; }
  void set_name(unsigned index, const VariableName& name) { name_[index] = name; }
  /// First number >= from that is not vacant; false = none.
  bool next(uint32_t from, uint32_t* number, double* value) const;

 private:
  CommonRanges ranges_;
  unsigned used_ = 0;      ///< number of ranges up to the last one that is not empty
  uint32_t size_[CommonRanges::kCount] = {};
  double* slot_[CommonRanges::kCount] = {};
  VariableName name_[kNames];
};

/// Variables of one part system.
class Variables {
 public:
  /// `locals`: how many local variables a level has, from kLocals to kMostLocals.
  void create(CommonVariables* common, unsigned locals, unsigned journal_capacity, Arena& arena);
  /// Where there are several part systems, they share the common variables of the family's two ranges up to these (M700 13.4, #1303, #1304), and all those of
  /// later models and of further ranges, and the names.
  void share(const uint32_t (&last)[CommonRanges::kExtended]) {
    for (unsigned i = 0; i < CommonRanges::kExtended; ++i) last_shared_[i] = last[i];
  }
  /// The key is that of a variable which part systems share, or of a name.
  bool shares(uint32_t key) const {
    if (key >= kNameKey) return key < kLocalKey;
    if (!common_->exists(key)) return false;
    const unsigned range = common_->divided(key);
    return range == CommonRanges::kExtended || key <= last_shared_[range];
  }
  /// The value of a variable as it is written into the journal, and back.
  static JournalValue journalled(Value value) { return JournalValue::of(value.number, value.vacant ? kVacantKind : kNumberKind); }
  static Value variable(JournalValue value) { return {value.as<double>(), value.kind == kVacantKind}; }
  /// The key of the name of a variable that can have one.
  uint32_t name_key(uint32_t number) const { return kNameKey | (number - common_->ranges().first_named); }
  /// The present value of the place that a key stands for. The key must not be a foreign one.
  JournalValue value_of(uint32_t key) const;
  Journal& journal() { return journal_; }
  /// Journal::precede() for a key that is not foreign; where the value counts from now on, it is put into its place.
  void take_published(uint32_t key, JournalValue value) {
    if (journal_.precede(key, value)) put(key, value);
  }
  bool next(uint32_t from, uint32_t* number, double* value) const { return common_->next(from, number, value); }

  /// Local or common variable; false when the number is neither (system variables are
  /// interpret/system_variables.cpp).
  bool get(uint32_t number, unsigned level, Value* value) const;
  bool set(uint32_t number, unsigned level, Value value, BlockSeq seq);

  /// The local variables of a level as they are stored, and how many they are: NaN = vacant.
  const double* locals(unsigned level) const { return local_[level]; }
  unsigned local_count() const { return locals_; }
  /// Sets #1..#33 of `level` to `arguments`; its further local variables are vacant.
  void enter(unsigned level, const Value* arguments, BlockSeq seq);
  /// rewind(seq) is possible, and will still be possible when one more block has been executed.
  bool keeps(BlockSeq seq) const { return journal_.keeps(seq, kMostWrites); }
  static constexpr unsigned kMostWrites = 512;  ///< the most writes of one block: each of its words and statements writes a few numbers
  void clear_locals(BlockSeq seq);

  /// SETVN: a name of 1 to kNameLength capitals and digits; false when the variable cannot have a name.
  bool set_name(uint32_t number, const char* name, size_t length, BlockSeq seq);
  /// A name given by the host, ended by a NUL; "" takes the name away. No rewind undoes it.
  bool name_from_outside(uint32_t number, const char* name);
  bool find_name(const char* name, size_t length, uint32_t* number) const;

  /// For families whose programs name parameters themselves. Inside, these have numbers that a program cannot write.
  void create_named(Arena& arena) { named_.create(arena); }
  const NamedParameters& named() const { return named_; }
  bool find_named(const char* name, size_t length, bool make, uint32_t* number) {
    if (make ? !named_.make(name, length, number) : !named_.find(name, length, number)) return false;
    *number += kFirstNamed;
    return true;
  }
  /// The name of a variable, without a NUL; returns its length, 0 = none. `name` has room for kNameLength characters.
  unsigned name_of(uint32_t number, char* name) const;

  /// Journals the old value of a place that is not a variable (an offset table, a parameter); its owner undoes it in rewind().
  void note(BlockSeq seq, uint32_t key, JournalValue old) { journal_.note(seq, key, old); }
  /// A write by the host and not by a block, which rewind() keeps. For a foreign key (changed_from_outside) the caller has changed the place already.
  bool set_from_outside(uint32_t number, unsigned level, Value value);
  void changed_from_outside(uint32_t key, JournalValue value) { journal_.replace(key, value); }
  /// A run begins: its blocks count from 0 again, and nothing from before can be taken back.
  void forget() {
    journal_.clear();
    named_.forget_program();
  }
  static constexpr uint32_t kForeignKey = 0x40000000;  ///< keys from here on belong to the caller

  /// Undoes every write by blocks after `seq`; false when the journal does not reach back that far. foreign(self, key, old) is called for foreign keys.
  bool rewind(BlockSeq seq, void* self, void (*foreign)(void* self, uint32_t key, JournalValue old));
  /// If `back` is true, sets everything to the values after block `seq`. If it is false, sets everything to the present values again, provided that nothing
  /// was written in between. For foreign keys foreign(self, key, value) exchanges the values.
  void swap(BlockSeq seq, bool back, void* self, JournalValue (*foreign)(void* self, uint32_t key, JournalValue value));

 private:
  // First journal keys of named parameters, of names and of local variables; they lie above the numbers of common variables and below kForeignKey.
  static constexpr uint32_t kFirstNamed = 0x08000000;
  static constexpr uint32_t kNameKey = 0x10000000;
  static constexpr uint32_t kLocalKey = 0x20000000;
  static constexpr uint32_t local_key(unsigned level, unsigned number) { return kLocalKey | level << 8 | number; }
  static constexpr uint8_t kNumberKind = 0, kVacantKind = 1;  // JournalValue::kind
  /// The place of a variable's name. False: the variable does not exist, or can have no name.
  bool name_place(uint32_t number, unsigned* place) const;
  void put(uint32_t key, JournalValue value);

  CommonVariables* common_ = nullptr;
  uint32_t last_shared_[CommonRanges::kExtended] = {};  ///< of each range that parameters divide
  Journal journal_;
  NamedParameters named_;
  double (*local_)[kMostLocals] = nullptr;
  unsigned locals_ = kLocals;
};

}  // namespace nc
