// SPDX-License-Identifier: Apache-2.0
// Reading blocks: window, lexer, cache of compiled blocks.
//
// A block is cached when it is read for the second time. A program that runs straight through is lexed into one block object, which stays in the
// first-level cache of the processor; a loop or a subprogram is lexed twice, and then its blocks are taken from the cache.
#include <cstring>

#include "alarm/condition.hpp"
#include "program/cursor.hpp"
#include "program/longest_block.hpp"
#include "program/store.hpp"
#include "program/tape.hpp"

namespace nc {
namespace {

/// Shortens the text of one block that is longer than the window: leaves out blanks and comments, except a comment that may be a message. The columns of the
/// characters that stay are kept, too.
class Condenser {
 public:
  Condenser(char* buffer, size_t capacity, const LexRules& rules, Semicolon semicolon)
      : rules_(rules), semicolon_(semicolon), out_(buffer), capacity_(capacity) {}

  /// Takes one character of the source. False when the block has ended: before this character (*consumed = false) or with it.
  bool take(char c, bool* consumed) {
    *consumed = true;
    if (source_column_ < UINT8_MAX) ++source_column_;
    if (state_ == State::percent) return c != '\n';
    if (state_ == State::behind_semicolon || state_ == State::comment_behind) return take_behind(c, consumed);
    if (state_ == State::comment) {
      if (c == '\n') {
        if (rules_.comments_end && !comment_kept_) put('(');
        return put_spare(c), false;
      }
      if (c == ')') {
        if (comment_kept_) rules_.comments_end ? put(c) : put_spare(c);  // where it has to end, its end is no spare character
        state_ = State::words;
      } else if (comment_kept_ && comment_length_ < kKeptComment) {
        ++comment_length_;
        put_spare(c);
      }
      return true;
    }
    return take_outside(c, consumed);
  }

  size_t size() const { return size_; }
  bool overflowed() const { return overflowed_; }
  const uint8_t* columns() const { return columns_; }

 private:
  /// percent: the rest of the line is left out.
  enum class State : uint8_t { words, comment, name, percent, behind_semicolon, comment_behind };
  static constexpr unsigned kKeptComment = 127 + 4;  ///< bytes that the lexer keeps, and enough behind them to see where the last character ends

  bool take_outside(char c, bool* consumed) {
    if (c == '\n') return put_spare(c), false;
    if (c == ';' && semicolon_ != Semicolon::unknown) {
      if (semicolon_ == Semicolon::ends_line) state_ = State::behind_semicolon;
      if (semicolon_ == Semicolon::comment) state_ = State::percent;
      return put_spare(c), semicolon_ != Semicolon::ends_block;
    }
    if (c == '%') {
      if (significant_) {
        *consumed = false;
        return put_spare(c), false;
      }
      state_ = State::percent;
      return put(c), true;
    }
    if (c == '(') {
      state_ = State::comment;
      comment_kept_ = assigned_;
      comment_length_ = 0;
      if (!comment_kept_) return comment_dropped_ = true;
      if (comment_at_ != kNone) size_ = comment_at_;  // when several comments follow one another the last one counts
      comment_at_ = size_;
      return put_spare(c), true;
    }
    if (state_ == State::name) {
      if (c == '>') state_ = State::words;
      return put(c), true;
    }
    if (is_blank(c)) return true;
    if (comment_dropped_) keep_apart(c);
    significant_ = true;
    comment_at_ = kNone;
    if (c == '=') assigned_ = true;
    if (c == '<' && rules_.angle_names) state_ = State::name;
    return put(c), true;
  }

  /// A comment in the middle of a word or a number is a fault, so it must not vanish: X1(..)0 would become X10. An empty comment is put in its place,
  /// except where a word begins.
  void keep_apart(char c) {
    comment_dropped_ = false;
    const char last = size_ != 0 ? out_[size_ - 1] : ';';
    const bool word_begins = (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
    const bool word_ended = (last >= '0' && last <= '9') || last == '.' || last == ']';
    if (size_ == 0 || (word_begins && word_ended)) return;
    put('(');
    put(')');
  }

  /// Of the text behind a ';' that ends the line one character is kept, which is enough to show that there is something. It is not a spare character:
  /// without it a fault would be overlooked.
  bool take_behind(char c, bool* consumed) {
    if (c == '\n') return false;
    if (state_ == State::comment_behind) {
      if (c == ')') state_ = State::behind_semicolon;
      return true;
    }
    if (c == '(') return state_ = State::comment_behind, true;
    if (is_blank(c) || c == ';') return true;
    if (c == '%') return *consumed = false, false;
    state_ = State::percent;
    return put(c), true;
  }

  void put(char c) {
    if (size_ == capacity_) overflowed_ = true;
    put_spare(c);
  }

  /// Puts a character that may be missing when there is no room: the end of the block, a comment behind a message variable.
  void put_spare(char c) {
    if (size_ == capacity_) return;
    if (size_ < 256) columns_[size_] = source_column_;
    out_[size_++] = c;
  }

  static constexpr size_t kNone = SIZE_MAX;
  const LexRules& rules_;
  const Semicolon semicolon_;
  char* const out_;
  const size_t capacity_;
  size_t size_ = 0;
  size_t comment_at_ = kNone;  ///< beginning of the last comment that was kept, as long as nothing significant has followed it
  State state_ = State::words;
  unsigned comment_length_ = 0;
  bool comment_dropped_ = false;  ///< a comment was left out, and nothing significant has followed it yet
  bool significant_ = false, assigned_ = false, comment_kept_ = false, overflowed_ = false;
  uint8_t source_column_ = 0;
  uint8_t columns_[256] = {};
};

unsigned power_of_two_below(unsigned n) {
  unsigned power = 1;
  while (power <= n / 2) power *= 2;
  return n == 0 ? 0 : power;
}

/// Ends the block where it is longer than a block can be. Behind the end of the record anything may stand, of any length.
void cut(Block& block) {
  block.next = block.begin + kLongestBlock;
  if (block.percent) return;
  block.empty = false;
  block.has_fault = true;
  block.fault = Fault{};
  block.fault.condition = Condition::block_too_long;
}

}  // namespace

void BlockReader::create(ProgramStore* store, const LexRules* rules, unsigned window_bytes,
                         unsigned cached_blocks, Arena& arena) {
  store_ = store;
  rules_ = rules;
  window_.create(window_bytes, arena);
  slots_ = power_of_two_below(cached_blocks);
  if (slots_ < kWays) slots_ = 0;
  first_time_ = arena.make<Block>();
  searched_ = arena.make<Block>();
  cache_ = arena.make_blank<Block>(slots_);  // a slot without a tag is never read
  tags_ = arena.make<Tag>(slots_);
  indexes_ = arena.make<Index>(kIndexes);
  jumps_ = arena.make<Jump>(kJumps);
}

size_t BlockReader::hash(uint32_t generation, uint64_t offset) {
  const uint64_t mixed =
      (offset + generation) * 0x9e3779b97f4a7c15u;  // 2^64 / golden ratio: spreads neighbours
  return static_cast<size_t>(mixed >> 32);
}

const Block* BlockReader::read(unsigned file, uint64_t offset, uint32_t line) {
  const TextEntry* entry = store_->entry(file);
  if (entry == nullptr) return nullptr;
  const Seen& last = seen_[seen_used_];
  if (offset >= last.end && last.generation == entry->generation) return miss(*entry, file, offset, line);  // never read before, so not in the cache
  const Block* block = cached(*entry, offset, line);
  return block != nullptr ? block : miss(*entry, file, offset, line);
}

/// Slot of a block in the cache, or ~0u. A block may lie in any slot of its set: if there was only one slot for it, two blocks of a loop that share the
/// slot would be compiled again in every pass.
unsigned BlockReader::find_slot(uint32_t generation, uint64_t offset) const {
  const unsigned set = static_cast<unsigned>(hash(generation, offset)) & (slots_ - 1) & ~(kWays - 1);
  for (unsigned at = set; at < set + kWays; ++at) {
    if (tags_[at].offset == offset && tags_[at].generation == generation) return at;
  }
  return ~0u;
}

const Block* BlockReader::cached(const TextEntry& entry, uint64_t offset, uint32_t line) {
  if (slots_ == 0) return nullptr;
  // A block is nearly always followed by the same block as last time.
  Tag& before = tags_[last_slot_];
  unsigned at = before.follower;
  if (tags_[at].offset != offset || tags_[at].generation != entry.generation) {
    at = find_slot(entry.generation, offset);
    if (at == ~0u) return nullptr;
    before.follower = at;
  }
  last_slot_ = at;
  Block& block = cache_[at];
  if (block.line != line) {
    block.next_line += line - block.line;
    block.line = line;
  }
  return &block;
}

const Block* BlockReader::miss(const TextEntry& entry, unsigned file, uint64_t offset, uint32_t line) {
  Seen& seen_so_far = seen(entry.generation);
  if (offset >= seen_so_far.end || slots_ == 0) {
    seen_so_far.end = offset + 1;
    return compile(entry, file, offset, line, *first_time_) ? first_time_ : nullptr;
  }
  const unsigned set = static_cast<unsigned>(hash(entry.generation, offset)) & (slots_ - 1) & ~(kWays - 1);
  const unsigned at = set + (next_way_++ & (kWays - 1));
  tags_[at].generation = 0;
  if (!compile(entry, file, offset, line, cache_[at])) return nullptr;
  tags_[at].offset = offset;
  tags_[at].generation = entry.generation;
  return &cache_[at];
}

BlockReader::Seen& BlockReader::seen(uint32_t generation) {
  if (seen_[seen_used_].generation == generation) return seen_[seen_used_];
  for (unsigned i = 0; i < kSeen; ++i) {
    if (seen_[i].generation != generation) continue;
    seen_used_ = i;
    return seen_[i];
  }
  seen_used_ = (seen_used_ + 1) % kSeen;
  seen_[seen_used_] = Seen{0, generation};
  return seen_[seen_used_];
}

bool BlockReader::compile(const TextEntry& entry, unsigned file, uint64_t offset, uint32_t line,
                          Block& block) {
  bool newline = false;
  failure_ = 0;
  if (!compile_here(entry, offset, block, &newline)) return false;
  block.file = static_cast<uint16_t>(file);
  block.line = line;
  block.next_line = newline ? line + 1 : line;
  block.ordinary = !block.empty && !block.percent && !block.end_of_text && !block.has_o && !block.has_n && block.skip == 0 && !block.has_fault;
  if (!has_parity(entry, offset) || block.percent) return true;  // nothing is significant behind the end of the record
  const Condition wrong = parity_fault(entry, offset, block.next);
  if (wrong == Condition::none) return true;
  block.has_fault = true;
  block.ordinary = false;
  block.fault = Fault{};
  block.fault.condition = wrong;
  return true;
}

/// M700 3.6: checks every row of the significant section, and where a parameter says so the number of characters of a block.
Condition BlockReader::parity_fault(const TextEntry& entry, uint64_t begin, uint64_t end) const {
  BlockParity parity;
  bool whole = false;  // the block has its end
  for (uint64_t at = begin; at < end;) {
    char rows[128];
    const uint64_t left = end - at;
    const long got = TextWindow::read(entry, at, rows, left < sizeof rows ? static_cast<size_t>(left) : sizeof rows);
    if (got <= 0) break;
    parity.take(rows, static_cast<size_t>(got));
    whole = rows[got - 1] == '\n';
    at += static_cast<uint64_t>(got);
  }
  if (parity.bad_row()) return Condition::parity;
  return whole && parity.odd() && ((parity_units_ >> entry.unit) & 1) != 0 ? Condition::parity_vertical : Condition::none;
}

/// Notes why reading through the window has failed.
bool BlockReader::failed() {
  failure_ = window_.failure();
  return false;
}

bool BlockReader::has_parity(const TextEntry& entry, uint64_t begin) {
  return entry.tape > NC_TAPE_TEXT && begin >= entry.label;
}

bool BlockReader::compile_here(const TextEntry& entry, uint64_t offset, Block& block, bool* newline) {
  if (!window_.seek(entry, offset)) return failed();
  if (window_.size() == 0) {
    block.clear();
    block.begin = block.next = offset;
    block.end_of_text = true;
    return true;
  }
  const Semicolon semicolon = semicolon_of(entry);
  LexResult result = rules_->read(window_.text(), window_.size(), *rules_, semicolon, nullptr, block);
  if (result.ran_out && !window_.last()) {
    if (!window_.at_front()) {
      if (!window_.advance(entry)) return failed();
      result = rules_->read(window_.text(), window_.size(), *rules_, semicolon, nullptr, block);
    }
    if (result.ran_out && !window_.last()) return rules_->heads_scanned ? compile_long(entry, offset, block, newline) : refuse_long(entry, offset, block, newline);
  }
  block.begin = offset;
  block.next = offset + result.used;
  *newline = result.newline;
  if (result.used > kLongestBlock) {
    cut(block);
    *newline = false;
  }
  return true;
}

/// A block that is longer than the window, of a language whose blocks cannot be shortened: it is passed over up to the end of its line.
bool BlockReader::refuse_long(const TextEntry& entry, uint64_t offset, Block& block, bool* newline) {
  char chunk[512];
  uint64_t at = offset;
  *newline = false;
  while (!*newline && at - offset < kLongestBlock) {
    const long got = TextWindow::read(entry, at, chunk, sizeof chunk);
    if (got < 0) {
      failure_ = got;
      return false;
    }
    if (got == 0) break;
    const void* const line_end = std::memchr(chunk, '\n', static_cast<size_t>(got));
    *newline = line_end != nullptr;
    at += *newline ? static_cast<uint64_t>(static_cast<const char*>(line_end) - chunk) + 1 : static_cast<uint64_t>(got);
  }
  block.clear();
  block.empty = false;
  block.has_fault = true;
  block.fault.condition = Condition::block_too_long;
  block.begin = offset;
  block.next = at;
  if (at - offset > kLongestBlock) {
    cut(block);
    *newline = false;
  }
  return true;
}

bool BlockReader::compile_long(const TextEntry& entry, uint64_t offset, Block& block, bool* newline) {
  char chunk[512];
  char* const buffer = window_.take_buffer();
  Condenser condenser(buffer, window_.capacity(), *rules_, semicolon_of(entry));
  uint64_t at = offset;
  *newline = false;
  bool open = true;
  while (open && at - offset <= kLongestBlock) {
    const long got = TextWindow::read(entry, at, chunk, sizeof chunk);
    if (got < 0) {
      failure_ = got;
      return false;
    }
    if (got == 0) break;
    for (long i = 0; i < got && open; ++i) {
      bool consumed = true;
      open = condenser.take(chunk[i], &consumed);
      if (consumed) ++at;
      *newline = !open && chunk[i] == '\n';
    }
  }
  rules_->read(buffer, condenser.size(), *rules_, semicolon_of(entry), condenser.columns(), block);
  if (condenser.overflowed()) {  // other faults may only come from the cut, so this one replaces them
    block.has_fault = true;
    block.fault = Fault{};
    block.fault.condition = Condition::block_too_long;
  }
  block.begin = offset;
  block.next = at;
  if (at - offset > kLongestBlock) {
    cut(block);
    *newline = false;
  }
  return true;
}

Semicolon BlockReader::semicolon_of(const TextEntry& entry) const {
  if (entry.mdi) return rules_->mdi_semicolon;
  return comments_ && rules_->semicolon != Semicolon::unknown ? Semicolon::comment : rules_->semicolon;
}

void BlockReader::semicolon_begins_comment(bool comments) {
  if (comments == comments_) return;
  comments_ = comments;
  for (unsigned i = 0; i < slots_; ++i) tags_[i].generation = 0;  // it was compiled by the other rule
  for (unsigned i = 0; i < kIndexes; ++i) indexes_[i].generation = 0;
  for (unsigned i = 0; i < kJumps; ++i) jumps_[i].generation = 0;
}

void BlockReader::forget(unsigned file) {
  const TextEntry* entry = store_->entry(file);
  if (entry == nullptr) return;
  for (unsigned i = 0; i < slots_; ++i) {
    if (tags_[i].generation == entry->generation) tags_[i].generation = 0;
  }
  for (unsigned i = 0; i < kIndexes; ++i) {
    if (indexes_[i].generation == entry->generation) indexes_[i].generation = 0;
  }
  for (unsigned i = 0; i < kJumps; ++i) {
    if (jumps_[i].generation == entry->generation) jumps_[i].generation = 0;
  }
  seen(entry->generation).end = 0;
  window_.forget();
}

}  // namespace nc
