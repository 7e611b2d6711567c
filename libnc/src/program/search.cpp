// SPDX-License-Identifier: Apache-2.0
// Searches a text for programs, sequence numbers and the ends of loops. Only the heads of blocks are read: blanks, skip sign, O, N; the rest of a block is
// passed over as fast as its end can be found.
#include <cstring>
#include <initializer_list>

#include "alarm/condition.hpp"
#include "program/cursor.hpp"
#include "program/longest_block.hpp"
#include "program/store.hpp"

namespace nc {
namespace {

/// Characters at which passing over a block has to stop and look closer.
struct StopCharacter {
  bool is[256] = {};
  constexpr StopCharacter() {
    for (char c : {'\n', ';', '%', '('}) is[static_cast<unsigned char>(c)] = true;
  }
};
constexpr StopCharacter kStop;

/// The head of a block.
struct Head {
  uint64_t offset = 0;
  uint32_t line = 1;
  uint64_t o = 0, n = 0;  ///< 0 = none
  bool percent = false;
  bool blank = true;  ///< the block holds only blanks and comments
};

}  // namespace

/// Goes from block to block of a text, through the window of its reader. In a text that is not one of ISO 6983 it reads the whole blocks.
class HeadScanner {
 public:
  HeadScanner(BlockReader& reader, TextWindow& window, const TextEntry& entry, const LexRules& rules, Semicolon semicolon,
              uint64_t offset, uint32_t line)
      : reader_(reader), window_(window), entry_(entry), rules_(rules), semicolon_(semicolon), next_(offset), line_(line) {}

  /// The next block. False at the end of the text, or when reading failed.
  bool next(Head* head) {
    *head = Head{};
    head->offset = offset();
    head->line = line_;
    if (!rules_.heads_scanned) return next_whole(head);
    int c = significant();
    if (c < 0) return false;
    if (c == '/') {
      head->blank = false;
      take();
      c = significant();
      if (rules_.skip_numbers && c > 0 && is_digit(static_cast<char>(c))) {
        take();
        c = significant();
      }
    }
    if (c == rules_.program_letter) head->o = number(&c);
    if (c == rules_.sequence_letter) head->n = number(&c);
    head->blank = head->blank && head->o == 0 && head->n == 0 && ends(c);
    head->percent = c == '%' && head->blank;
    pass_over(head->percent);
    return true;
  }

  uint64_t offset() const { return next_ - static_cast<uint64_t>(end_ - p_); }
  uint32_t line() const { return line_; }
  bool failed() const { return failed_; }

 private:
  bool next_whole(Head* head) {
    Block& block = *reader_.searched_;
    if (!reader_.compile(entry_, 0, next_, line_, block)) {
      failed_ = true;
      return false;
    }
    if (block.end_of_text || block.next <= next_) return false;
    head->o = block.has_o ? block.o : 0;
    head->n = block.has_n ? block.n : 0;
    head->percent = block.percent;
    head->blank = block.percent || (block.empty && !block.has_o && !block.has_n && block.skip == 0 && !block.has_fault);
    next_ = block.next;
    line_ = block.next_line;
    if (block.next - block.begin >= kLongestBlock && !block.percent) pass_over_line();
    return true;
  }

  /// Behind a block that was cut because it is too long: what is left of its line is no block.
  void pass_over_line() {
    pass_over(true);
    next_ = offset();
    p_ = end_;
  }

  bool more() {
    if (!window_.seek(entry_, next_)) {
      failed_ = true;
      return false;
    }
    p_ = window_.text();
    end_ = p_ + window_.size();
    next_ += window_.size();
    return p_ != end_;
  }
  int look() { return p_ != end_ || more() ? static_cast<unsigned char>(*p_) : -1; }
  void take() { ++p_; }

  bool ends(int c) const { return c < 0 || c == '\n' || c == '%' || (c == ';' && semicolon_ != Semicolon::unknown); }

  /// The next character behind blanks and comments, as a capital.
  int significant() {
    for (;;) {
      const int c = look();
      if (c < 0) return c;
      const char ch = static_cast<char>(c);
      if (is_blank(ch)) {
        take();
      } else if (ch == '(') {
        take();
        pass_comment();
      } else {
        return upper(ch) & 0xff;
      }
    }
  }

  /// The number behind a letter, without its decimals; 0 = there is none. *c becomes the character behind it.
  uint64_t number(int* c) {
    constexpr uint64_t kSaturated = UINT32_MAX + uint64_t{1};
    uint64_t n = 0;
    take();
    bool point = false;
    for (*c = significant(); *c > 0 && (is_digit(static_cast<char>(*c)) || (*c == '.' && !point));
         *c = significant()) {
      if (*c == '.') point = true;
      if (!point && n < kSaturated) n = n * 10 + static_cast<uint64_t>(*c - '0');
      take();
    }
    return n;
  }

  void pass_comment() {
    for (int c = look(); c >= 0 && c != '\n'; c = look()) {
      take();
      if (c == ')') return;
    }
  }

  /// Behind a ';' that ends a line: whether something follows in the line, which is a fault.
  bool more_in_line() {
    int c = significant();
    for (; c == ';'; c = significant()) take();
    return !ends(c);
  }

  /// Passes over the rest of the block and its end.
  void pass_over(bool whole_line) {
    for (;;) {
      while (p_ != end_ && !kStop.is[static_cast<unsigned char>(*p_)]) ++p_;
      if (p_ == end_) {
        if (!more()) return;
        continue;
      }
      const char c = *p_;
      if (c == '\n') {
        take();
        ++line_;
        return;
      }
      if (whole_line) {
        take();
      } else if (c == '(') {
        take();
        pass_comment();
      } else if (c == '%') {
        return;
      } else {
        take();
        if (semicolon_ == Semicolon::ends_block) return;
        whole_line = semicolon_ == Semicolon::comment || (semicolon_ == Semicolon::ends_line && more_in_line());
      }
    }
  }

  BlockReader& reader_;
  TextWindow& window_;
  const TextEntry& entry_;
  const LexRules& rules_;
  const Semicolon semicolon_;
  const char* p_ = nullptr;
  const char* end_ = nullptr;
  uint64_t next_;  ///< offset of end_
  uint32_t line_;
  bool failed_ = false;
};

BlockReader::Index& BlockReader::index(const TextEntry& entry) {
  for (unsigned i = 0; i < kIndexes; ++i) {
    if (indexes_[i].generation == entry.generation) {
      index_used_ = i;
      return indexes_[i];
    }
  }
  index_used_ = (index_used_ + 1) % kIndexes;
  Index& fresh = indexes_[index_used_];
  fresh.generation = entry.generation;
  fresh.scanned = 0;
  fresh.scanned_line = 1;
  fresh.count = 0;
  fresh.complete = false;
  return fresh;
}

ProgramRef BlockReader::find_o_line(uint32_t number, unsigned file) {
  const TextEntry* entry = store_->entry(file);
  if (entry == nullptr) return {};
  Index& known = index(*entry);
  for (unsigned i = 0; i < known.count; ++i) {
    if (known.at[i].number == number) return known.at[i];
  }
  if (known.complete) return {};
  HeadScanner scanner(*this, window_, *entry, *rules_, semicolon_of(*entry), known.scanned, known.scanned_line);
  ProgramRef found;
  for (Head head; !found.valid() && scanner.next(&head);) {
    if (head.o == 0 || head.o > UINT32_MAX) continue;
    ProgramRef ref;
    ref.file = static_cast<uint16_t>(file);
    ref.number = static_cast<uint32_t>(head.o);
    ref.offset = head.offset;
    ref.line = head.line;
    if (ref.number == number) found = ref;
    if (known.count == kIndexed) continue;
    known.at[known.count++] = ref;
    known.scanned = scanner.offset();
    known.scanned_line = scanner.line();
  }
  if (scanner.failed()) failed();
  known.complete = !found.valid() && !scanner.failed() && known.count < kIndexed;
  return found;
}

ProgramRef BlockReader::find_program(uint32_t number, unsigned own_file) {
  failure_ = 0;
  if (number == 0) return {};
  int file = store_->find_number(number);
  if (file < 0) {
    const ProgramRef own = find_o_line(number, own_file);
    if (own.valid() || failure_ != 0) return own;  // where the text could not be read the program may be in it, so no other one is taken instead
    char name[16] = {store_->number_letter()};
    unsigned length = 1;
    char digits[10];
    unsigned count = 0;
    for (uint32_t n = number; n != 0; n /= 10) digits[count++] = static_cast<char>('0' + n % 10);
    while (count != 0) name[length++] = digits[--count];
    if (!store_->ask_host(name)) return {};
    file = store_->find_number(number);
    if (file < 0) return {};
  }
  store_->touch(static_cast<unsigned>(file));
  ProgramRef ref;
  ref.file = static_cast<uint16_t>(file);
  ref.number = number;
  return ref;
}

ProgramRef BlockReader::find_program(const char* name, size_t length) {
  int file = store_->find_name(name, length);
  if (file < 0) {
    char text[sizeof TextEntry{}.name];
    if (length >= sizeof text) return {};
    std::memcpy(text, name, length);
    text[length] = '\0';
    if (!store_->ask_host(text)) return {};
    file = store_->find_name(name, length);
    if (file < 0) return {};
  }
  store_->touch(static_cast<unsigned>(file));
  ProgramRef ref;
  ref.file = static_cast<uint16_t>(file);
  ref.number = store_->entry(static_cast<unsigned>(file))->number;
  return ref;
}

ProgramRef BlockReader::find_external(const char* place, const char* name, size_t length, uint32_t number) {
  char text[sizeof TextEntry{}.name] = {};
  size_t used = std::strlen(place);
  std::memcpy(text, place, used);
  if (length != 0) {
    if (used + length >= sizeof text) return {};
    std::memcpy(text + used, name, length);
    used += length;
  } else {
    char digits[10];
    unsigned count = 0;
    for (uint32_t n = number; n != 0; n /= 10) digits[count++] = static_cast<char>('0' + n % 10);
    if (count == 0) return {};
    text[used++] = store_->number_letter();
    while (count != 0) text[used++] = digits[--count];
  }
  text[used] = '\0';
  if (store_->find_name(text, used) < 0 && !store_->ask_host(text)) return {};
  const int file = store_->find_name(text, used);
  ProgramRef ref;
  if (file < 0) return ref;
  store_->touch(static_cast<unsigned>(file));
  ref.file = static_cast<uint16_t>(file);
  return ref;
}

const Block* BlockReader::peek(unsigned file, uint64_t offset, uint32_t line) {
  const TextEntry* entry = store_->entry(file);
  return entry != nullptr && compile(*entry, file, offset, line, *searched_) ? searched_ : nullptr;
}

bool BlockReader::find_sequence(unsigned file, uint32_t n, uint64_t* offset, uint32_t* line, uint64_t limit,
                                uint64_t budget, bool* again, bool from_head) {
  *again = false;
  failure_ = 0;
  const TextEntry* entry = store_->entry(file);
  if (entry == nullptr || n == 0) return false;
  Jump& known = jumps_[(hash(entry->generation, *offset) ^ n) & (kJumps - 1)];
  const bool remembered = known.generation == entry->generation && known.from == *offset && known.n == n &&
                          known.limit == limit && known.from_head == from_head;
  Jump jump = known;
  if (!remembered) {
    jump = Jump{*offset, limit, 0, entry->generation, n, 0, from_head, false};
    bool failed = false;
    jump = scan_for_sequence(*entry, *line, jump, budget, again, &failed);
    if (failed) return this->failed();
    if (!*again) known = jump;
  }
  if (!jump.found && !*again) return false;
  *offset = jump.offset;
  *line = jump.line;
  return jump.found;
}

/// Returns `wanted` with what has been found. *again: the budget is used up, and offset and line are where the search has to go on.
BlockReader::Jump BlockReader::scan_for_sequence(const TextEntry& entry, uint32_t line, const Jump& wanted,
                                                 uint64_t budget, bool* again, bool* failed) {
  Jump jump = wanted;
  HeadScanner scanner(*this, window_, entry, *rules_, semicolon_of(entry), wanted.from, line);
  bool at_head = wanted.from_head;  // so far only blocks have been seen that may stand before a program
  bool o_seen = false;
  for (Head head;;) {
    if (budget != 0 && scanner.offset() - wanted.from >= budget) {
      jump.offset = scanner.offset();
      jump.line = scanner.line();
      *again = true;
      return jump;
    }
    if (!scanner.next(&head) || (wanted.limit != 0 && head.offset >= wanted.limit)) break;
    if (has_parity(entry, head.offset) && !head.percent && parity_fault(entry, head.offset, scanner.offset()) != Condition::none) {
      head.n = wanted.n;  // the search ends at this block; reading it gives the alarm (M700 3.6)
    }
    if (head.blank && !head.percent) continue;
    if (head.percent) {
      if (at_head && wanted.from == 0 && !o_seen) continue;  // the start mark
      break;
    }
    if (head.o != 0) {
      if (!at_head || o_seen) break;  // the next program
      o_seen = true;
    } else {
      at_head = false;
    }
    if (head.n != wanted.n) continue;
    jump.found = true;
    jump.offset = head.offset;
    jump.line = head.line;
    break;
  }
  *failed = scanner.failed();
  return jump;
}

bool BlockReader::find_loop_end(unsigned file, uint32_t m, uint64_t* offset, uint32_t* line) {
  constexpr unsigned kMostOpen = 27;  // M700 13.5.7 (3)
  const TextEntry* entry = store_->entry(file);
  if (entry == nullptr) return false;
  FixedVector<uint32_t, kMostOpen> open;
  failure_ = 0;
  for (uint64_t at = *offset;;) {
    const Block* block = cached(*entry, at, *line);
    if (block == nullptr && compile(*entry, file, at, *line, *searched_)) block = searched_;
    if (block == nullptr || block->end_of_text || block->percent || block->has_o) return false;
    for (const Statement& s : block->statements) {
      if (s.kind == StatementKind::while_do || s.kind == StatementKind::do_loop) {
        if (!open.push_back(s.number)) return false;
      } else if (s.kind == StatementKind::end_loop) {
        if (open.empty()) {
          if (s.number != m) return false;
          *offset = block->next;
          *line = block->next_line;
          return true;
        }
        if (open.back() != s.number) return false;  // loops that overlap: M700 P294
        open.pop_back();
      }
    }
    at = block->next;
    *line = block->next_line;
  }
}

}  // namespace nc
