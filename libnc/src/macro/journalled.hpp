// SPDX-License-Identifier: Apache-2.0
// A struct every change of which is journalled. It can be read like any other (records->figure.angle) and there is no way to write to it but
// the two below, each of which tells the journal, and the way back that a rewind takes. A record is changed whole or by one of its fields; what goes into the
// journal are the words of eight bytes that differ, so a record may have fields of any types that can be copied byte by byte. (Where a record has
// padding, that is written with it.)
#pragma once

#include <concepts>
#include <type_traits>

#include "macro/journal.hpp"

namespace nc {

/// `Owner` is the one who rewinds the journal.
template <class T, class Owner>
class Journalled {
  static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(uint64_t) == 0);
  template <class Base>
  static constexpr bool kHolds = std::derived_from<T, Base>;  // T is made of groups: a pointer to a member of a group is one to a member of T

 public:
  /// Words are journalled under `first_key` and the keys behind it, as many as words() says.
  void create(Journal* journal, uint32_t first_key, Arena& arena) {
    value_ = arena.make<T>();
    journal_ = journal;
    first_key_ = first_key;
  }
  static constexpr uint32_t words() { return sizeof(T) / sizeof(uint64_t); }

  const T* operator->() const { return value_; }
  const T& operator*() const { return *value_; }
  /// How often anything has been changed, by a rewind as well: what is made of the records holds as long as this stays.
  uint64_t changes() const { return changes_; }

  // ---- by block `seq`: a rewind to a block before it takes the change back
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
  /// One of several.
  template <class Record, size_t count, class Group>
  requires kHolds<Group>
  void change(BlockSeq seq, Record (Group::*records)[count], unsigned index, const std::type_identity_t<Record>& value) {
    write((value_->*records)[index], value, Journalling{seq, false});
  }

  // ---- by no block: no rewind takes it back, whichever block has changed the same before
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
  /// Bit by bit: those that `mask` has. The others stay what they are, and what a rewind makes of them stays so, too.
  template <class Record, size_t count, class Group>
  requires kHolds<Group>
  void change_bits_from_outside(Record (Group::*records)[count], unsigned index, const std::type_identity_t<Record>& value,
                                const std::type_identity_t<Record>& mask) {
    write((value_->*records)[index], value, Journalling{0, true}, &mask);
  }
  void change_from_outside(const T& value) { write(*value_, value, Journalling{0, true}); }

 private:
  friend Owner;
  struct Journalling {
    BlockSeq seq;
    bool outside;
  };

  /// For a rewind, and for a look at how things were (Journal::rewind, swap): what stood in a word is in it again. What has been in it.
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
  /// `bits`: those that are written; null = all.
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
    // From outside also what is so already: an older value could still come back.
    if (how.outside) journal_->replace(key, JournalValue{then}, mask);
    if (now == then) return;
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
