// SPDX-License-Identifier: Apache-2.0
#include "interpret/parameters.hpp"

#include <cmath>
#include <cstring>

#include "interpret/journal_keys.hpp"
#include "program/cursor.hpp"

namespace nc {
namespace {

bool same_word(const char* word, size_t length, const char* text) {
  for (size_t i = 0; i < length; ++i)
    if (text[i] == 0 || upper(word[i]) != upper(text[i])) return false;
  return text[length] == 0;
}

/// Reads a decimal number with sign and point; false when the text is anything else.
bool parse_number(const char* text, double* value) {
  bool negative = false;
  if (*text == '-' || *text == '+') negative = *text++ == '-';
  double number = 0, scale = 1;
  bool any = false, point = false;
  for (; *text != 0; ++text) {
    if (*text == '.' && !point) {
      point = true;
    } else if (is_digit(*text)) {
      any = true;
      if (point) scale *= 10;
      number = number * 10 + (*text - '0');
    } else {
      return false;
    }
  }
  *value = (negative ? -number : number) / scale;
  return any && std::isfinite(*value);
}

/// Index of `text` in a list such as "a|b|c", -1 if it is not in the list.
int word_index(const char* words, const char* text) {
  int index = 0;
  for (const char* at = words;; ++index) {
    const char* bar = std::strchr(at, '|');
    const size_t length = bar != nullptr ? static_cast<size_t>(bar - at) : std::strlen(at);
    if (same_word(at, length, text)) return index;
    if (bar == nullptr) return -1;
    at = bar + 1;
  }
}

/// No parameter may be as large as this, from where on doubles have no fractions.
constexpr double kTooLarge = 4503599627370496.0;

/// The text has at most 63 letters, digits and signs, a letter first.
bool is_text(const char* text) {
  if (!is_letter(text[0])) return false;
  size_t length = 0;
  for (; text[length] != 0; ++length)
    if (text[length] < ' ' || text[length] > '~') return false;
  return length <= 63;
}

/// A parameter as 32 bits; no bit is set when the value is negative or too large.
uint32_t bits_of(double value) { return value >= 0 && value <= 4294967295.0 ? static_cast<uint32_t>(value) : 0; }

}  // namespace

void Parameters::create(unsigned capacity, Arena& arena, const Journal* journal) {
  entries_ = arena.make<Entry>(capacity + kCommon);
  texts_ = reinterpret_cast<char(*)[kTextSize]>(arena.make<char>(size_t{kTexts} * kTextSize));
  capacity_ = capacity;
  journal_ = journal;
}

Parameters::Entry* Parameters::find(ParameterId id, int axis) const {
  for (unsigned i = 0; i < count_; ++i)
    if (entries_[i].id == id && entries_[i].axis == axis) return &entries_[i];
  return nullptr;
}

const Parameters::Entry* Parameters::in_force(ParameterId id, int axis) const {
  const Entry* entry = find(id, axis);
  if ((entry == nullptr || !entry->value().is_set()) && axis >= 0) entry = find(id, -1);
  return entry != nullptr && entry->value().is_set() ? entry : nullptr;
}

nc_status Parameters::set(const Dialect& dialect, const char* key, int axis, const char* text, unsigned* index, ParameterValue* old) {
  ParameterId id;
  int bit = -1;
  if (key == nullptr || text == nullptr || !parse_parameter(dialect, key, &id, &bit)) return NC_E_NOT_FOUND;
  return set(dialect, id, bit, axis, text, index, old);
}

nc_status Parameters::set(const Dialect& dialect, ParameterId id, int bit, int axis, const char* text, unsigned* index, ParameterValue* old) {
  double number = 0;
  const ParameterName* const named = id.is_name() ? &dialect.parameters->names.row[id.value - ParameterId::kFirstName] : nullptr;
  if (named != nullptr && named->words != nullptr) {
    const int word = word_index(named->words, text);
    return word < 0 ? NC_E_ARGUMENT : set(dialect, id, bit, axis, word, index, old);
  }
  if (parse_number(text, &number)) return set(dialect, id, bit, axis, number, index, old);
  // #1003 takes the letters of 2.1; a letter is stored by its code, also in a parameter that only programs read.
  if (bit >= 0 || named != nullptr || !is_text(text)) return NC_E_ARGUMENT;
  const ParameterKey key{id.value, 0, -1};
  if (!parameter_takes_code(dialect, key)) return NC_E_ARGUMENT;
  if (text[1] == 0) return set(dialect, id, bit, axis, static_cast<unsigned char>(text[0]), index, old);
  // No parameter that has an effect in the control is a text of several characters.
  if (find_parameter(dialect, key) != nullptr) return NC_E_ARGUMENT;
  const uint8_t place = keep_text(text);
  return place == 0 ? NC_E_MEMORY : put(id, bit, axis, false, ParameterValue{OptionalDouble{}, place}, index, old);
}

nc_status Parameters::set(const Dialect& dialect, ParameterId id, int bit, int axis, double number, unsigned* index, ParameterValue* old) {
  if (!(number < kTooLarge)) return NC_E_ARGUMENT;
  if (id.is_name()) return !parameter_name_takes(dialect, id, number) ? NC_E_ARGUMENT : put(id, bit, axis, false, ParameterValue{number}, index, old);
  const ParameterKey key{id.value, 0, bit};
  const ParameterRow* const row = find_parameter(dialect, key);
  if (bit < 0 && (!parameter_takes(dialect, key, number) || (row != nullptr && !machine_takes(row->what, number)))) return NC_E_ARGUMENT;
  if (bit >= 0 && number != 0 && number != 1) return NC_E_ARGUMENT;
  if (bit >= 0 && !parameter_takes(dialect, ParameterKey{id.value, 0, -1}, with_bit(id, bit, axis, number != 0))) return NC_E_ARGUMENT;
  return put(id, bit, axis, row != nullptr && nc::is_common(row->what), ParameterValue{number}, index, old);
}

nc_status Parameters::set(const Dialect& dialect, ParameterOf parameter, int axis, double number, unsigned* index, ParameterValue* old) {
  ParameterId id;
  int bit = -1;
  if (!parameter_place(dialect, parameter, &id, &bit, axis) || bit >= 0) return NC_E_NOT_FOUND;
  const ParameterRow* const row = parameter_row(dialect, parameter.what);
  const bool number_says_axis = row != nullptr && row->axis_step != 0;
  return set(dialect, id, bit, number_says_axis ? -1 : axis, number, index, old);
}

/// What the whole parameter is when one of its bits becomes `on`.
double Parameters::with_bit(ParameterId id, int bit, int axis, bool on) const {
  double before = 0;
  get(id, -1, axis, &before);
  const uint32_t mask = uint32_t{1} << bit;
  return on ? bits_of(before) | mask : bits_of(before) & ~mask;
}

/// Stores a value that has been checked. Where it is one bit of a parameter the other bits stay.
nc_status Parameters::put(ParameterId id, int bit, int axis, bool common, ParameterValue value, unsigned* index, ParameterValue* old) {
  if (bit >= 0) value.number = with_bit(id, bit, axis, *value.number != 0);
  Entry* entry = find(id, axis);
  if (entry == nullptr) {
    if (count_ >= capacity_) return NC_E_MEMORY;
    entry = add(id, axis, common);
  }
  *index = static_cast<unsigned>(entry - entries_);
  *old = exchange(*index, value);
  return NC_OK;
}

Parameters::Entry* Parameters::add(ParameterId id, int axis, bool common) {
  Entry* const entry = &entries_[count_++];
  *entry = Entry{id, static_cast<int8_t>(axis), common, 0, OptionalDouble{}};
  return entry;
}

bool Parameters::same_entry(const Parameters& other, unsigned index, unsigned* there) {
  const Entry& wanted = other.entries_[index];
  const Entry* entry = find(wanted.id, wanted.axis);
  if (entry == nullptr && count_ >= capacity_ + kCommon) return false;
  if (entry == nullptr) entry = add(wanted.id, wanted.axis, true);
  *there = static_cast<unsigned>(entry - entries_);
  return true;
}

bool Parameters::get(const Dialect& dialect, ParameterOf parameter, int axis, double* value) const {
  ParameterId id;
  int bit = -1;
  if (!parameter_place(dialect, parameter, &id, &bit, axis) || !get(id, bit, axis, value)) return false;
  const ParameterRow* const row = parameter_row(dialect, parameter.what);
  if (row != nullptr && row->means != nullptr) *value = row->means(*value);
  return true;
}

bool Parameters::get(ParameterId id, int bit, int axis, double* value) const {
  const Entry* const entry = in_force(id, axis);
  if (entry == nullptr) return false;
  if (const char* const at = text(entry->value()); at != nullptr) {
    double codes = 0;
    unsigned length = 0;
    for (; at[length] != 0; ++length) codes = codes * 256 + static_cast<unsigned char>(at[length]);
    *value = codes;
    return bit < 0 && length <= 6;
  }
  *value = bit >= 0 ? (bits_of(*entry->number) >> bit) & 1 : *entry->number;
  return true;
}

/// Checks what depends on the machine and so cannot stand in the family's table.
bool Parameters::machine_takes(Parameter parameter, double value) const {
  switch (parameter) {
    case Parameter::rapid_before:  // M700 13.15, precaution (5): only in the first part system, otherwise Y51 parameter error 17
      return value == 0 || first_system_;
    case Parameter::rapid_linear:
    case Parameter::cut_linear:
    case Parameter::skip_linear:
      return value <= longest_filter_ms_;
    case Parameter::pattern_filter:
    case Parameter::pattern_second:  // two filters stand one behind the other, so each has half of the room
      return value <= 0.5 * longest_filter_ms_;
    default:
      return true;
  }
}

/// The place for the next text; 0 = none is free.
uint8_t Parameters::free_text_place() const {
  bool held[kTexts + 1] = {};
  for (unsigned i = 0; i < count_; ++i) held[entries_[i].text] = true;
  if (journal_ != nullptr) {
    journal_->each([&held](uint32_t key, JournalValue value) {
      if (place_of(key).table == JournalTable::parameters) held[ParameterValue::of(value).text] = true;
    });
  }
  for (unsigned tried = 0; tried < kTexts; ++tried) {
    const unsigned place = (newest_text_ + tried) % kTexts + 1;
    if (!held[place]) return static_cast<uint8_t>(place);
  }
  return 0;
}

/// Stores a text and returns its place; 0 = there is none.
uint8_t Parameters::keep_text(const char* text) {
  const uint8_t place = free_text_place();
  if (place == 0) return 0;
  newest_text_ = place;
  std::memcpy(texts_[place - 1], text, std::strlen(text) + 1);
  return place;
}

const char* Parameters::text(ParameterId id, int axis) const {
  const Entry* const entry = in_force(id, axis);
  return entry == nullptr ? nullptr : text(entry->value());
}

bool Parameters::at(unsigned index, ParameterId* id, int* axis, ParameterValue* value) const {
  if (index >= count_) return false;
  *id = entries_[index].id;
  *axis = entries_[index].axis;
  *value = entries_[index].value();
  return true;
}

}  // namespace nc
