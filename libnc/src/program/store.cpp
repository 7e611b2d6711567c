// SPDX-License-Identifier: Apache-2.0
#include "program/store.hpp"

#include <cstring>

#include "program/cursor.hpp"
#include "program/tape.hpp"

namespace nc {
namespace {

const char* without_folder(const char* name) {
  const char* base = name;
  for (const char* p = name; *p != '\0'; ++p) {
    if (*p == '/' || *p == '\\') base = p + 1;
  }
  return base;
}

/// Length of a name without its ending: "1000.nc" has 4. A name whose only point is its first character has no ending.
size_t stem_length(const char* name, size_t length) {
  for (size_t i = length; i-- > 1;) {
    if (name[i] == '.') return i;
  }
  return length;
}

/// The program number of "O1000", "o0100.nc" or "1000.nc", O being the letter of `numbers`; 0 = none. It is what a program reads as the number of the file (M700
/// 13.5.5, 10.10: "0123" is 123); whether a call finds the file by it is another matter (is_name()).
uint32_t number_of_name(const char* name, ProgramNumbers numbers) {
  const size_t length = stem_length(name, std::strlen(name));
  const bool letter = upper(name[0]) == numbers.letter;
  size_t i = letter ? 1 : 0;
  if (i == length) return 0;
  uint64_t number = 0;
  for (; i < length; ++i) {
    if (!is_digit(name[i])) return 0;
    number = number * 10 + static_cast<uint64_t>(name[i] - '0');
    if (number > numbers.largest) return 0;
  }
  return static_cast<uint32_t>(number);
}

/// A number with leading zeros and no letter in front counts as a name: the file "0100" can only be called as <0100> (M700 13.3.1).
bool is_name(const char* name) { return name[0] == '0'; }

bool same_name(const char* a, size_t a_length, const char* b, size_t b_length) {
  if (a_length != b_length) return false;
  for (size_t i = 0; i < a_length; ++i) {
    if (upper(a[i]) != upper(b[i])) return false;
  }
  return true;
}

}  // namespace

void ProgramStore::create(unsigned capacity, unsigned reserved, ProgramNumbers numbers, Arena& arena) {
  entries_ = arena.make<TextEntry>(capacity + reserved);
  capacity_ = capacity;
  reserved_ = reserved;
  numbers_ = {numbers.letter != 0 ? numbers.letter : 'O', numbers.largest};
  count_ = given_ = 0;
}

uint32_t ProgramStore::number_of(const char* name) const { return number_of_name(without_folder(name), numbers_); }

nc_status ProgramStore::add(const TextEntry& entry, const char* name, unsigned* file, bool own) {
  if (name == nullptr || (entry.read == nullptr && entry.memory == nullptr && entry.size != 0))
    return NC_E_ARGUMENT;
  const char* base = without_folder(name);
  const size_t length = std::strlen(base);
  if (length == 0 || length >= sizeof entry.name) return NC_E_ARGUMENT;
  unsigned at = 0, free = count_;
  for (; at < count_ && !same_name(entries_[at].name, std::strlen(entries_[at].name), base, length); ++at)
    if (free == count_ && entries_[at].name[0] == '\0') free = at;
  if (at == count_) {
    if ((!own && given_ == capacity_) || free == capacity_ + reserved_ || free >= UINT16_MAX) return NC_E_MEMORY;
    at = free;
    if (at == count_) ++count_;
    if (!own) ++given_;
    entries_[at].own = own;
  }
  TextEntry& place = entries_[at];
  const bool was_own = place.own;
  place = entry;
  place.own = was_own;
  std::memcpy(place.name, base, length + 1);
  if (place.number == 0) place.number = number_of_name(base, numbers_);
  place.generation = ++generation_;
  touch(at);
  if (file != nullptr) *file = at;
  return NC_OK;
}

void ProgramStore::remove(unsigned file) {
  if (!entries_[file].own) --given_;
  entries_[file] = TextEntry{};
}

void ProgramStore::forget_notes(unsigned system) {
  for (unsigned i = 0; i < count_; ++i) entries_[i].noted &= static_cast<uint8_t>(~(1u << system));
}

void ProgramStore::on_missing(nc_program_missing callback, void* user, nc_control* control) {
  missing_ = callback;
  missing_user_ = user;
  control_ = control;
}

const TextEntry* ProgramStore::entry(unsigned file) const {
  return file < count_ && entries_[file].name[0] != '\0' ? &entries_[file] : nullptr;
}

bool ProgramStore::set_tape(unsigned file, uint8_t code, uint8_t unit) {
  TextEntry& entry = entries_[file];
  entry.tape = NC_TAPE_NONE;  // the rows of the label are read without decoding
  entry.label = 0;
  entry.generation = ++generation_;
  bool in_label = code != NC_TAPE_NONE;
  while (in_label) {
    char rows[256];
    const long got = TextWindow::read(entry, entry.label, rows, sizeof rows);
    if (got < 0) return false;
    if (got == 0) break;
    for (long i = 0; i < got && in_label; ++i, ++entry.label) in_label = !ends_tape_block(code, rows[i]);
  }
  entry.tape = code;
  entry.unit = unit;
  return true;
}

int ProgramStore::find_exactly(const char* name) const {
  const size_t length = std::strlen(name);
  for (unsigned i = 0; i < count_; ++i)
    if (same_name(entries_[i].name, std::strlen(entries_[i].name), name, length)) return static_cast<int>(i);
  return -1;
}

int ProgramStore::find_name(const char* name, size_t length) const {
  for (size_t i = length; i-- > 0;) {
    if (name[i] != '/' && name[i] != '\\') continue;
    name += i + 1;
    length -= i + 1;
    break;
  }
  for (unsigned i = 0; i < count_; ++i) {
    if (same_name(entries_[i].name, std::strlen(entries_[i].name), name, length)) return static_cast<int>(i);
  }
  // An ending may be missing in one of the two names; two different endings mean two different files.
  const size_t stem = stem_length(name, length);
  for (unsigned i = 0; i < count_; ++i) {
    const size_t entry_length = std::strlen(entries_[i].name);
    if (entry_length == 0) continue;
    const size_t entry_stem = stem_length(entries_[i].name, entry_length);
    if (stem != length && entry_stem != entry_length) continue;
    if (same_name(entries_[i].name, entry_stem, name, stem)) return static_cast<int>(i);
  }
  return -1;
}

int ProgramStore::find_number(uint32_t number) const {
  if (number == 0) return -1;
  for (unsigned i = 0; i < count_; ++i) {
    if (entries_[i].number == number && !is_name(entries_[i].name)) return static_cast<int>(i);
  }
  return -1;
}

bool ProgramStore::ask_host(const char* name) {
  if (missing_ == nullptr) return false;
  const uint32_t before = generation_;
  return missing_(missing_user_, control_, name) && generation_ != before;
}

}  // namespace nc
