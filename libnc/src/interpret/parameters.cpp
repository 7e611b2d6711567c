// SPDX-License-Identifier: Apache-2.0
#include "interpret/parameters.hpp"

#include <cmath>
#include <cstring>
#include <limits>

namespace nc {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

bool same_word(const char* word, size_t length, const char* text) {
  for (size_t i = 0; i < length; ++i)
    if (text[i] == 0 || lower(word[i]) != lower(text[i])) return false;
  return text[length] == 0;
}

/// Decimal number with sign and point; false when the text is anything else.
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

/// Index of `text` in "a|b|c", -1 when it is none of them.
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

/// Values from here on are places of texts.
constexpr double kTextBase = 4503599627370496.0;  // 2^52: no parameter is as large

/// Letters, digits and signs, at most 63, a letter first.
bool is_text(const char* text) {
  if (lower(text[0]) < 'a' || lower(text[0]) > 'z') return false;
  size_t length = 0;
  for (; text[length] != 0; ++length)
    if (text[length] < ' ' || text[length] > '~') return false;
  return length <= 63;
}

/// A parameter as bits; what is no whole number of 32 bits has none set.
uint32_t bits_of(double value) { return value >= 0 && value <= 4294967295.0 ? static_cast<uint32_t>(value) : 0; }

}  // namespace

/// "1229" out of "1229/bit2".
const char* Parameters::whole_key(const char* key, const ParameterKey& parsed, char (&whole)[kKeySize]) {
  std::memcpy(whole, key, parsed.digits);
  whole[parsed.digits] = 0;
  return whole;
}

void Parameters::create(unsigned capacity, Arena& arena) {
  entries_ = arena.make<Entry>(capacity + kCommon);
  texts_ = reinterpret_cast<char(*)[kTextSize]>(arena.make<char>(size_t{kTexts} * kTextSize));
  capacity_ = capacity;
}

/// Keys are compared as numbers: a hundred of them are looked for whenever a parameter has changed.
Parameters::Entry* Parameters::find(const char* key, int axis) const {
  uint64_t wanted[kKeySize / 8] = {}, there[kKeySize / 8];
  const size_t length = std::strlen(key);
  if (length >= kKeySize) return nullptr;
  std::memcpy(wanted, key, length);
  for (unsigned i = 0; i < count_; ++i) {
    std::memcpy(there, entries_[i].key, kKeySize);
    if (there[0] == wanted[0] && there[1] == wanted[1] && there[2] == wanted[2] && entries_[i].axis == axis) return &entries_[i];
  }
  return nullptr;
}

nc_status Parameters::set(const Dialect& dialect, const char* key, int axis, const char* text, unsigned* index, double* old) {
  if (key == nullptr || text == nullptr || std::strlen(key) >= kKeySize) return NC_E_NOT_FOUND;
  double value = 0;
  ParameterKey parsed{};
  parsed.bit = -1;
  bool common = false;
  const ParameterName* named = find_parameter_name(dialect, key);
  if (named != nullptr && named->words != nullptr) {
    const int word = word_index(named->words, text);
    if (word < 0) return NC_E_ARGUMENT;
    value = word;
  } else if (named == nullptr && (dialect.parameters->numbers.size == 0 || !parse_parameter_key(key, &parsed))) {
    return NC_E_NOT_FOUND;
  } else {
    const ParameterRow* const row = named == nullptr ? find_parameter(dialect, parsed) : nullptr;
    common = row != nullptr && nc::is_common(row->what);
    // #1003 takes the letters of 2.1; any letter is stored by its code.
    if (!parse_number(text, &value)) {
      if (parsed.bit >= 0 || named != nullptr || !is_text(text)) return NC_E_ARGUMENT;
      const bool letter = text[1] == 0;
      if (!letter && parameter_used(dialect, key)) return NC_E_ARGUMENT;  // none of these is a text of several characters
      value = letter ? static_cast<unsigned char>(text[0]) : keep_text(text);
    } else if (!(value < kTextBase)) {
      return NC_E_ARGUMENT;
    }
    if (named != nullptr && value < 0) return NC_E_ARGUMENT;
    if (named == nullptr && parsed.bit < 0 && value < kTextBase) {
      if (!parameter_takes(dialect, parsed, value) || (row != nullptr && !machine_takes(row->what, value))) return NC_E_ARGUMENT;
    }
  }
  char whole[kKeySize];
  if (parsed.bit >= 0) {  // one bit of a parameter: the others stay
    if (value != 0 && value != 1) return NC_E_ARGUMENT;
    whole_key(key, parsed, whole);
    double before = 0;
    get(whole, axis, &before);
    const uint32_t mask = uint32_t{1} << parsed.bit;
    value = value != 0 ? bits_of(before) | mask : bits_of(before) & ~mask;
    key = whole;
  }
  Entry* entry = find(key, axis);
  if (entry == nullptr) {
    if (count_ >= capacity_) return NC_E_MEMORY;
    entry = add(key, axis, common);
  }
  *index = static_cast<unsigned>(entry - entries_);
  *old = entry->value;
  entry->value = value;
  return NC_OK;
}

Parameters::Entry* Parameters::add(const char* key, int axis, bool common) {
  Entry* const entry = &entries_[count_++];
  std::memset(entry->key, 0, kKeySize);
  std::strcpy(entry->key, key);
  entry->axis = static_cast<int8_t>(axis);
  entry->common = common;
  entry->value = std::numeric_limits<double>::quiet_NaN();
  return entry;
}

bool Parameters::same_entry(const Parameters& other, unsigned index, unsigned* there) {
  const Entry& wanted = other.entries_[index];
  const Entry* entry = find(wanted.key, wanted.axis);
  if (entry == nullptr && count_ >= capacity_ + kCommon) return false;
  if (entry == nullptr) entry = add(wanted.key, wanted.axis, true);
  *there = static_cast<unsigned>(entry - entries_);
  return true;
}

bool Parameters::get(const char* key, int axis, double* value) const {
  ParameterKey parsed;
  char whole[kKeySize];
  const int bit = parse_parameter_key(key, &parsed) ? parsed.bit : -1;
  return value_of(bit >= 0 ? whole_key(key, parsed, whole) : key, bit, axis, value);
}

bool Parameters::get(const Dialect& dialect, ParameterOf parameter, int axis, double* value) const {
  char key[kKeySize];
  int bit = -1;
  return parameter_place(dialect, parameter, key, &bit) && value_of(key, bit, axis, value);
}

/// Of the whole parameter `key`, or of one bit of it.
bool Parameters::value_of(const char* key, int bit, int axis, double* value) const {
  const Entry* entry = find(key, axis);
  if ((entry == nullptr || std::isnan(entry->value)) && axis >= 0) entry = find(key, -1);
  if (entry == nullptr || std::isnan(entry->value)) return false;
  if (entry->value >= kTextBase) {
    const char* at = texts_[static_cast<unsigned>(entry->value - kTextBase)];
    double codes = 0;
    unsigned length = 0;
    for (; at[length] != 0; ++length) codes = codes * 256 + static_cast<unsigned char>(at[length]);
    *value = codes;
    return bit < 0 && length <= 6;
  }
  *value = bit >= 0 ? (bits_of(entry->value) >> bit) & 1 : entry->value;
  return true;
}

/// What the table cannot know.
bool Parameters::machine_takes(Parameter parameter, double value) const {
  switch (parameter) {
    case Parameter::rapid_before:  // M700 13.15, precaution (5): with one part system only, else Y51 parameter error 17
      return value == 0 || first_system_;
    case Parameter::rapid_linear:
    case Parameter::cut_linear:
    case Parameter::skip_linear:
      return value <= longest_filter_ms_;
    case Parameter::pattern_filter:
    case Parameter::pattern_second:  // two of them stand one behind the other
      return value <= 0.5 * longest_filter_ms_;
    default:
      return true;
  }
}

double Parameters::keep_text(const char* text) {
  const unsigned place = text_count_++ % kTexts;
  std::strcpy(texts_[place], text);
  return kTextBase + place;
}

const char* Parameters::text(const char* key, int axis) const {
  const Entry* entry = find(key, axis);
  if (entry == nullptr && axis >= 0) entry = find(key, -1);
  if (entry == nullptr || !(entry->value >= kTextBase)) return nullptr;
  return texts_[static_cast<unsigned>(entry->value - kTextBase)];
}

bool Parameters::at(unsigned index, const char** key, int* axis, double* value, const char** text) const {
  if (index >= count_) return false;
  const Entry& entry = entries_[index];
  *key = entry.key;
  *axis = entry.axis;
  *value = entry.value;
  *text = entry.value >= kTextBase ? texts_[static_cast<unsigned>(entry.value - kTextBase)] : nullptr;
  return true;
}

}  // namespace nc
