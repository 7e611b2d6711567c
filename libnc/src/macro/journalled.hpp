// SPDX-License-Identifier: Apache-2.0
// A struct of which every change is journalled. It can be read like any other struct (records->figure.angle), but it can be written only by change() and
// change_from_outside(), which tell the journal, and by a rewind. A record is changed as a whole or in one of its fields. The journal gets the words of
// eight bytes that differ, so a record may have fields of any types that can be copied byte by byte. (Padding of a record is written with it.)
#pragma once

#include <concepts>
#include <type_traits>

#include "macro/journal.hpp"

namespace nc {

/// `Owner` is the class that rewinds the journal. `kShared`: other part systems have copies (interpret/shared_tables.hpp). Then a write of the value that is
/// there already is journalled, too, because another part system may have written another value by the time at which the machine executes it.
template <class T, class Owner, bool kShared = false>
class Journalled {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(uint64_t) == 0);
  template <class Base>
  static constexpr bool kHolds = std::derived_from<T, Base>;  // T inherits groups, so a pointer to a member of a group can be used for T

 public:
  /// The words are journalled under the keys first_key to first_key + words() - 1.
  void create(Journal* journal, uint32_t first_key, Arena& arena) {
    value_ = arena.make<T>();
    journal_ = journal;
    first_key_ = first_key;
  }
  static constexpr uint32_t words() { return sizeof(T) / sizeof(uint64_t); }
  /// The first key of a field of a record of an array.
  template <class Record, size_t count, class Group, class Field>
  requires kHolds<Group> uint32_t key(Record (Group::*records)[count], unsigned index, Field Record::*field) const {
    const auto begin = reinterpret_cast<const char*>(&((value_->*records)[index].*field)) - reinterpret_cast<const char*>(value_);
    return first_key_ + static_cast<uint32_t>(static_cast<size_t>(begin) / sizeof(uint64_t));
  }

  const T* operator->() const { return value_; }
  const T& operator*() const { return *value_; }
  /// How often anything has been changed, also by a rewind. What has been calculated from the records stays valid as long as this number stays.
  uint64_t changes() const { return changes_; }

  // ---- changes by block `seq`: a rewind to a block before it takes them back
  template <class Record, class Group>
  requires kHolds<Group>
  void change(BlockSeq seq, Record Group::*record, const std::type_identity_t<Record>& value) {
    write(value_->*record, value, Journalling{seq, false});
  }
  template <class Record, class Group, class Field, class Part>
  requires kHolds<Group> && std::derived_from<Record, Part>
  void change(BlockSeq seq, Record Group::*record, Field Part::*field, const std::type_identity_t<Field>& value) {
    write(value_->*record.*field, value, Journalling{seq, false});
  }
  /// Changes one record of an array.
  template <class Record, size_t count, class Group>
  requires kHolds<Group>
  void change(BlockSeq seq, Record (Group::*records)[count], unsigned index, const std::type_identity_t<Record>& value) {
    write((value_->*records)[index], value, Journalling{seq, false});
  }
  /// Changes a field of it.
  template <class Record, size_t count, class Group, class Field>
  requires kHolds<Group>
  void change(BlockSeq seq, Record (Group::*records)[count], unsigned index, Field Record::*field, const std::type_identity_t<Field>& value) {
    write((value_->*records)[index].*field, value, Journalling{seq, false});
  }

  // ---- changes from outside of the program: no rewind takes them back, also where blocks have changed the same record before
  template <class Record, class Group>
  requires kHolds<Group>
  void change_from_outside(Record Group::*record, const std::type_identity_t<Record>& value) {
    write(value_->*record, value, Journalling{0, true});
  }
  template <class Record, size_t count, class Group>
  requires kHolds<Group>
  void change_from_outside(Record (Group::*records)[count], unsigned index, const std::type_identity_t<Record>& value) {
    write((value_->*records)[index], value, Journalling{0, true});
  }
  template <class Record, size_t count, class Group, class Field>
  requires kHolds<Group>
  void change_from_outside(Record (Group::*records)[count], unsigned index, Field Record::*field, const std::type_identity_t<Field>& value) {
    write((value_->*records)[index].*field, value, Journalling{0, true});
  }
  /// Changes only the bits that are set in `mask`. The other bits are not changed, and a rewind may still change them.
  template <class Record, size_t count, class Group>
  requires kHolds<Group>
  void change_bits_from_outside(Record (Group::*records)[count], unsigned index, const std::type_identity_t<Record>& value,
                                const std::type_identity_t<Record>& mask) {
    write((value_->*records)[index], value, Journalling{0, true}, &mask);
  }
  void change_from_outside(const T& value) { write(*value_, value, Journalling{0, true}); }

  // ---- for several part systems
  JournalValue word(uint32_t index) const { return JournalValue{load(index)}; }
  /// Another part system has written `value` to a word: see Journal::precede().
  void take_published(uint32_t index, JournalValue value) {
    if (journal_->precede(first_key_ + index, value)) store(index, value.bytes);
  }

 private:
  friend Owner;
  struct Journalling {
    BlockSeq seq;
    bool outside;
  };

  /// For Journal::rewind() and swap(): puts `value` into a word and returns the value that was in it.
  JournalValue exchange(uint32_t word, JournalValue value) {
    const JournalValue old{load(word)};
    store(word, value.bytes);
    return old;
  }

  template <class Field>
  void write(const Field& field, const Field& value, Journalling how, const Field* bits = nullptr) {
    const auto begin = static_cast<size_t>(reinterpret_cast<const char*>(&field) - reinterpret_cast<const char*>(value_));
    write(begin, reinterpret_cast<const char*>(&value), sizeof value, how, reinterpret_cast<const char*>(bits));
  }
  /// `bits`: which bits are written; nullptr = all.
  void write(size_t begin, const char* bytes, size_t size, Journalling how, const char* bits = nullptr) {
    constexpr size_t kWord = sizeof(uint64_t);
    for (size_t at = begin, end = begin + size; at < end;) {
      const size_t word = at / kWord, inside = at % kWord;
      const size_t count = end - at < kWord - inside ? end - at : kWord - inside;
      uint64_t mask = 0;
      if (bits == nullptr) std::memset(reinterpret_cast<char*>(&mask) + inside, 0xff, count);
      else std::memcpy(reinterpret_cast<char*>(&mask) + inside, bits + (at - begin), count);
      uint64_t now = load(word), then = 0;
      std::memcpy(reinterpret_cast<char*>(&then) + inside, bytes + (at - begin), count);
      then = (now & ~mask) | (then & mask);
      write_word(static_cast<uint32_t>(word), now, then, mask, how);
      at += count;
    }
  }
  void write_word(uint32_t word, uint64_t now, uint64_t then, uint64_t mask, Journalling how) {
    const uint32_t key = first_key_ + word;
    // A change from outside is told to the journal even where the value is the same already: a rewind could still bring an older value back.
    if (how.outside) journal_->replace(key, JournalValue{then}, mask);
    if (now == then && (how.outside || !kShared)) return;
    if (!how.outside) journal_->note(how.seq, key, JournalValue{now});
    store(word, then);
  }

  uint64_t load(size_t word) const {
    uint64_t bytes = 0;
    std::memcpy(&bytes, reinterpret_cast<const char*>(value_) + word * sizeof bytes, sizeof bytes);
    return bytes;
  }
  void store(size_t word, uint64_t bytes) {
    std::memcpy(reinterpret_cast<char*>(value_) + word * sizeof bytes, &bytes, sizeof bytes);
    ++changes_;
  }

  T* value_ = nullptr;
  Journal* journal_ = nullptr;
  uint32_t first_key_ = 0;
  uint64_t changes_ = 0;
};

}  // namespace nc
