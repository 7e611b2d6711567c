// SPDX-License-Identifier: Apache-2.0
#include "macro/variables.hpp"

#include <cstring>
#include <limits>

#include "macro/variable_name.hpp"

namespace nc {
namespace {

/// A vacant variable is stored as a NaN. No calculation stores one, because the evaluator refuses results that are not finite.
constexpr double kVacant = std::numeric_limits<double>::quiet_NaN();

bool is_vacant(double stored) {
  return stored != stored;
}
Value from_storage(double stored) {
  return is_vacant(stored) ? Value{} : Value::of(stored);
}
double to_storage(const Value& value) {
  return value.vacant ? kVacant : value.number;
}

void fill_vacant(double* slots, size_t count) {
  if (slots == nullptr) return;  // measuring, or out of memory: the arena says so
  for (size_t i = 0; i < count; ++i) slots[i] = kVacant;
}

VariableName name_of_text(const char* text, size_t length) {
  VariableName name;
  std::memcpy(name.text, text, length);
  return name;
}

}  // namespace

// ---- common variables
// ----------------------------------------------------------------------------------------------

void CommonVariables::create(const CommonRanges& ranges, Arena& arena) {
  ranges_ = ranges;
  used_ = 0;
  for (unsigned i = 0; i < CommonRanges::kCount; ++i) {
    slot_[i] = nullptr;
    size_[i] = ranges.size(i);
    if (size_[i] == 0) continue;
    used_ = i + 1;
    slot_[i] = arena.make<double>(size_[i]);
    fill_vacant(slot_[i], size_[i]);
  }
}

bool CommonVariables::exists(uint32_t number) const {
  for (unsigned i = 0; i < used_; ++i) {
    if (number - ranges_.first[i] < size_[i]) return true;
  }
  return false;
}

Value CommonVariables::get(uint32_t number) const {
  for (unsigned i = 0; i < used_; ++i) {
    const uint32_t at = number - ranges_.first[i];
    if (at < size_[i]) return from_storage(slot_[i][at]);
  }
  return {};
}

void CommonVariables::set(uint32_t number, Value value) {
  for (unsigned i = 0; i < used_; ++i) {
    const uint32_t at = number - ranges_.first[i];
    if (at >= size_[i]) continue;
    slot_[i][at] = to_storage(value);
    return;
  }
}

bool CommonVariables::next(uint32_t from, uint32_t* number, double* value) const {
  bool found = false;
  for (unsigned i = 0; i < used_; ++i) {
    if (size_[i] == 0) continue;
    const uint32_t first = from > ranges_.first[i] ? from : ranges_.first[i];
    for (uint32_t n = first; n <= ranges_.last[i] && !(found && n >= *number); ++n) {
      const double stored = slot_[i][n - ranges_.first[i]];
      if (is_vacant(stored)) continue;
      *number = n;
      *value = stored;
      found = true;
      break;
    }
  }
  return found;
}

// ---- variables of a part system
// ------------------------------------------------------------------------------------

void Variables::create(CommonVariables* common, unsigned locals, unsigned journal_capacity, Arena& arena) {
  common_ = common;
  locals_ = locals;
  journal_.create(journal_capacity, arena);
  local_ = reinterpret_cast<double(*)[kMostLocals]>(arena.make<double>(size_t{kLocalLevels} * kMostLocals));
  if (local_ != nullptr) fill_vacant(local_[0], size_t{kLocalLevels} * kMostLocals);
}

bool Variables::get(uint32_t number, unsigned level, Value* value) const {
  if (number - 1 < locals_) {
    *value = from_storage(local_[level][number - 1]);
    return true;
  }
  if (named_.exists(number - kFirstNamed)) {
    *value = named_.get(number - kFirstNamed);
    return true;
  }
  if (!common_->exists(number)) return false;
  *value = common_->get(number);
  return true;
}

bool Variables::set(uint32_t number, unsigned level, Value value, BlockSeq seq) {
  if (number - 1 < locals_) {
    double& slot = local_[level][number - 1];
    journal_.note(seq, local_key(level, number - 1), journalled(from_storage(slot)));
    slot = to_storage(value);
    return true;
  }
  if (named_.exists(number - kFirstNamed)) {
    journal_.note(seq, number, journalled(named_.get(number - kFirstNamed)));
    named_.set(number - kFirstNamed, value);
    return true;
  }
  if (!common_->exists(number)) return false;
  journal_.note(seq, number, journalled(common_->get(number)));
  common_->set(number, value);
  return true;
}

bool Variables::set_from_outside(uint32_t number, unsigned level, Value value) {
  if (number - 1 < locals_) {
    local_[level][number - 1] = to_storage(value);
    journal_.replace(local_key(level, number - 1), journalled(value));
    return true;
  }
  if (!common_->exists(number)) return false;
  common_->set(number, value);
  journal_.replace(number, journalled(value));
  return true;
}

void Variables::enter(unsigned level, const Value* arguments, BlockSeq seq) {
  for (unsigned i = 0; i < locals_; ++i) {
    double& slot = local_[level][i];
    const Value value = i < kLocals ? arguments[i] : Value{};
    if (is_vacant(slot) && value.vacant) continue;
    journal_.note(seq, local_key(level, i), journalled(from_storage(slot)));
    slot = to_storage(value);
  }
}

void Variables::clear_locals(BlockSeq seq) {
  static constexpr Value kNoArguments[kLocals] = {};
  for (unsigned level = 0; level < kLocalLevels; ++level) enter(level, kNoArguments, seq);
}

bool Variables::name_place(uint32_t number, unsigned* place) const {
  const CommonRanges& ranges = common_->ranges();
  *place = number - ranges.first_named;
  return *place < ranges.named && *place < kNames && common_->exists(number);
}

bool Variables::set_name(uint32_t number, const char* name, size_t length, BlockSeq seq) {
  unsigned index = 0;
  if (!name_place(number, &index) || length > kNameLength) return false;
  journal_.note(seq, name_key(number), JournalValue::of(common_->name(index)));
  common_->set_name(index, name_of_text(name, length));
  return true;
}

bool Variables::name_from_outside(uint32_t number, const char* name) {
  unsigned index = 0;
  size_t length = 0;
  for (; name[length] != 0; ++length) {
    const char c = name[length];
    const bool good = (c >= 'A' && c <= 'Z') || (length > 0 && c >= '0' && c <= '9');
    if (!good || length == kNameLength) return false;
  }
  if (is_reserved_name(name, length) || !name_place(number, &index)) return false;
  const VariableName given = name_of_text(name, length);
  common_->set_name(index, given);
  journal_.replace(name_key(number), JournalValue::of(given));
  return true;
}

bool Variables::find_name(const char* name, size_t length, uint32_t* number) const {
  if (length == 0 || length > kNameLength) return false;
  const VariableName wanted = name_of_text(name, length);
  for (unsigned i = 0; i < kNames; ++i) {
    if (!(common_->name(i) == wanted)) continue;
    *number = common_->ranges().first_named + i;
    return true;
  }
  return false;
}

unsigned Variables::name_of(uint32_t number, char* name) const {
  unsigned index = 0;
  if (!name_place(number, &index)) return 0;
  const VariableName& given = common_->name(index);
  const auto length = static_cast<unsigned>(std::strlen(given.text));
  std::memcpy(name, given.text, length);
  return length;
}

JournalValue Variables::value_of(uint32_t key) const {
  if (key >= kLocalKey) return journalled(from_storage(local_[key >> 8 & 0xff][key & 0xff]));
  if (named_.exists(key - kFirstNamed)) return journalled(named_.get(key - kFirstNamed));
  return key >= kNameKey ? JournalValue::of(common_->name(key & 0xff)) : journalled(common_->get(key));
}

void Variables::put(uint32_t key, JournalValue value) {
  if (key >= kLocalKey) {
    local_[key >> 8 & 0xff][key & 0xff] = to_storage(variable(value));
  } else if (key >= kNameKey) {
    common_->set_name(key & 0xff, value.as<VariableName>());
  } else if (named_.exists(key - kFirstNamed)) {
    named_.set(key - kFirstNamed, variable(value));
  } else {
    common_->set(key, variable(value));
  }
}

bool Variables::rewind(BlockSeq seq, void* self, void (*foreign)(void* self, uint32_t key, JournalValue old)) {
  if (seq + 1 < journal_.oldest()) return false;
  journal_.rewind(seq, [&](uint32_t key, JournalValue old) {
    if (key < kForeignKey) {
      put(key, old);
    } else if (foreign != nullptr) {
      foreign(self, key, old);
    }
  });
  return true;
}

void Variables::swap(BlockSeq seq, bool back, void* self, JournalValue (*foreign)(void* self, uint32_t key, JournalValue value)) {
  journal_.swap(seq, back, [&](uint32_t key, JournalValue value) {
    if (key >= kForeignKey) return foreign(self, key, value);
    const JournalValue old = value_of(key);
    put(key, value);
    return old;
  });
}

}  // namespace nc
