// SPDX-License-Identifier: Apache-2.0
// Local and common variables. What blocks write to them while reading ahead is journalled (macro/journal.hpp).
#pragma once

#include "base/arena.hpp"
#include "macro/expression.hpp"
#include "macro/journal.hpp"
#include "macro/named_parameters.hpp"
#include "nc/types.h"

namespace nc {

inline constexpr unsigned kLocals = 33;      ///< #1..#33
inline constexpr unsigned kNames = 20;       ///< #500..#519 can have a name (M700 13.5.5)
inline constexpr unsigned kNameLength = 7;   ///< characters
/// A name with zeros behind it; empty = none.
struct VariableName {
  char text[kNameLength + 1] = {};
  bool operator==(const VariableName&) const = default;
};
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
  /// Names of #500..#519.
  const VariableName& name(unsigned index) const { return name_[index]; }
  void set_name(unsigned index, const VariableName& name) { name_[index] = name; }
  /// First number >= from that is not vacant; false = none.
  bool next(uint32_t from, uint32_t* number, double* value) const;

 private:
  CommonRanges ranges_;
  unsigned used_ = 0;      ///< no range behind these has a variable
  uint32_t size_[CommonRanges::kCount] = {};
  double* slot_[CommonRanges::kCount] = {};
  VariableName name_[kNames];
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
  /// How a variable's value stands in the journal, and back.
  static JournalValue journalled(Value value) { return JournalValue::of(value.number, value.vacant ? kVacantKind : kNumberKind); }
  static Value variable(JournalValue value) { return {value.as<double>(), value.kind == kVacantKind}; }
  /// The key of a variable's name.
  static uint32_t name_key(uint32_t number);
  /// What a key stands for now; a foreign one is the caller's.
  JournalValue value_of(uint32_t key) const;
  Journal& journal() { return journal_; }
  /// Journal::precede() for a key that is not foreign, with the value in place where it counts from now on.
  void take_published(uint32_t key, JournalValue value) {
    if (journal_.precede(key, value)) put(key, value);
  }
  bool next(uint32_t from, uint32_t* number, double* value) const { return common_->next(from, number, value); }

  /// Local or common variable; false when the number is neither (system variables are
  /// interpret/system_variables.cpp).
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

  /// Programs of this family name parameters themselves. They have numbers that no program can write.
  void create_named(Arena& arena) { named_.create(arena); }
  const NamedParameters& named() const { return named_; }
  bool find_named(const char* name, size_t length, bool make, uint32_t* number) {
    if (make ? !named_.make(name, length, number) : !named_.find(name, length, number)) return false;
    *number += kFirstNamed;
    return true;
  }
  /// The name of a variable, without end; 0 = none. `name` has kNameLength places.
  unsigned name_of(uint32_t number, char* name) const;

  /// Journal key for something that is not a variable (offset tables, parameters): the owner undoes it in
  /// rewind().
  void note(BlockSeq seq, uint32_t key, JournalValue old) { journal_.note(seq, key, old); }
  /// A write that no block made (the host's): rewind() keeps it. For a foreign key the caller has changed it
  /// already.
  bool set_from_outside(uint32_t number, unsigned level, Value value);
  void changed_from_outside(uint32_t key, JournalValue value) { journal_.replace(key, value); }
  /// A run begins: its blocks count from 0 again, and nothing from before can be taken back.
  void forget() {
    journal_.clear();
    named_.forget_program();
  }
  static constexpr uint32_t kForeignKey = 0x40000000;  ///< keys from here on belong to the caller

  /// Undo every write made by blocks after `seq`; false when the journal does not reach back that far.
  /// foreign(self, key, old) is called for foreign keys.
  bool rewind(BlockSeq seq, void* self, void (*foreign)(void* self, uint32_t key, JournalValue old));
  /// Everything is as blocks up to `seq` have left it (back), and as it was before that: nothing may be written in between. For foreign
  /// keys foreign(self, key, value) exchanges.
  void swap(BlockSeq seq, bool back, void* self, JournalValue (*foreign)(void* self, uint32_t key, JournalValue value));

 private:
  // Journal keys of names and of local variables: beside the numbers of common variables, below kForeignKey.
  static constexpr uint32_t kFirstNamed = 0x08000000;
  static constexpr uint32_t kNameKey = 0x10000000;
  static constexpr uint32_t kLocalKey = 0x20000000;
  static constexpr uint32_t local_key(unsigned level, unsigned number) { return kLocalKey | level << 8 | number; }
  static constexpr uint8_t kNumberKind = 0, kVacantKind = 1;  // JournalValue::kind
  void put(uint32_t key, JournalValue value);

  CommonVariables* common_ = nullptr;
  uint32_t shared_100_ = 0, shared_500_ = 0;
  Journal journal_;
  NamedParameters named_;
  double (*local_)[kLocals] = nullptr;
};

}  // namespace nc
