// SPDX-License-Identifier: Apache-2.0
// Tells hosts that look at the text of a program which words a block has, and what their numbers are (nc_block_words). The family's own reader reads them, and
// its tables decide.
#include <cmath>
#include <cstring>

#include "base/struct_size.hpp"
#include "dialect/dialect.hpp"
#include "nc/dialects.h"
#include "program/cursor.hpp"

namespace nc {
namespace {

/// What the words of a block are, which its codes decide.
enum class BlockKind : uint8_t { motion, holes, tap, bore, dwell, arguments, work_data, tool_data, other_data, parameters_begin, data_end };

/// The cycle has a length that is no axis word.
bool has_depth(Function function) {
  return function == Function::cycle_step || function == Function::cycle_peck || function == Function::cycle_fine_bore || function == Function::cycle_back_bore;
}

BlockKind kind_of(DataInput input) {
  switch (input) {
    case DataInput::work_offset:
    case DataInput::work_offset_here:
    case DataInput::extended_offset: return BlockKind::work_data;
    case DataInput::tool_length:
    case DataInput::tool_length_wear:
    case DataInput::tool_radius:
    case DataInput::tool_radius_wear: return BlockKind::tool_data;
    case DataInput::parameters: return BlockKind::parameters_begin;
    case DataInput::tool_life:
    case DataInput::missing:
    case DataInput::current_limit: break;
  }
  return BlockKind::other_data;
}

/// The number of the word is written there.
bool is_plain(const Word& word) { return (word.flags & (kWordExpression | kWordNoValue | kWordCount)) == 0; }
bool has_comma(const Word& word) { return (word.flags & kWordComma) != 0; }

class Words {
 public:
  Words(const Dialect& dialect, const Block& block) : dialect_(dialect), words_(block.words) {}

  BlockKind kind() const {
    for (const Word& word : words_) {
      if (!is_plain(word)) continue;
      if (is(word, Role::misc_code) && word.value >= 0 && word.value < kMostCode && calls_program(misc_function(dialect_, static_cast<unsigned>(word.value))))
        return BlockKind::arguments;
      if (!is(word, Role::code) || !(word.value >= 0 && word.value < kMostCode)) continue;
      const FunctionRow* const row = find_function(dialect_, static_cast<int>(std::lround(word.value * 10)));
      if (row == nullptr) continue;
      if (row->function == Function::dwell) return BlockKind::dwell;
      if (row->function >= Function::holes_on_circle && row->function <= Function::holes_on_grid) return BlockKind::holes;
      if (row->function == Function::cycle_tap || row->function == Function::cycle_reverse_tap) return BlockKind::tap;
      if (has_depth(row->function)) return BlockKind::bore;
      if (row->function == Function::data_input) return kind_of(input());
      if (ends_data_input(row->function)) return BlockKind::data_end;
      if (is_macro_call(row->function)) return BlockKind::arguments;
    }
    return BlockKind::motion;
  }

  bool is(const Word& word, Role role) const { return !has_comma(word) && dialect_.addresses.is(word.slot, role); }

  bool is_length(const Word& word, BlockKind block, const char* axes) const {
    const bool axis = !has_comma(word) && std::strchr(axes, letter_of(word.slot)) != nullptr;
    switch (block) {
      case BlockKind::work_data: return axis;
      case BlockKind::tool_data: return is(word, Role::input_amount);
      case BlockKind::holes:  // M700 13.2: K of a pattern counts
        if (is(word, Role::hole_count)) return false;
        break;
      case BlockKind::tap:  // 13.1.1: ,R and ,S choose how the tap is made
        if (has_comma(word)) return false;
        break;
      case BlockKind::bore:  // a peck, or the shift of a bore
        if (is(word, Role::cycle_depth_step)) return true;
        break;
      case BlockKind::motion: break;
      default: return false;
    }
    if (has_comma(word)) return dialect_.addresses.is(word.slot, Role::option_chamfer) || dialect_.addresses.is(word.slot, Role::option_corner_radius);
    return axis || is(word, Role::vector_x) || is(word, Role::vector_y) || is(word, Role::vector_z) || is(word, Role::arc_radius);
  }

 private:
  static constexpr double kMostCode = 1000;

  DataInput input() const {
    uint32_t kind = DataInputRow::kWithoutL;
    for (const Word& word : words_)
      if (is_plain(word) && is(word, Role::input_kind) && word.value >= 0 && word.value < kMostCode) kind = static_cast<uint32_t>(word.value);
    for (const DataInputRow& row : dialect_.data_input)
      if (row.l == kind) return row.input;
    return DataInput::missing;
  }

  const Dialect& dialect_;
  const decltype(Block::words)& words_;
};

/// Where a word is written: from its address, whose column the reader has kept, to behind the last digit of its number.
void set_place(const Word& word, const char* text, size_t length, nc_plain_word* plain) {
  if (word.column == 0 || word.column == UINT8_MAX || word.column > length) return;
  Cursor at;
  at.p = text + word.column;
  at.end = text + length;
  if (!at.accept('-')) at.accept('+');
  plain->begin = word.column - 1u;
  for (char c = at.peek(); is_digit(c) || c == '.'; c = at.peek()) plain->end = static_cast<uint32_t>(++at.p - text);
}

}  // namespace
}  // namespace nc

nc_status nc_block_words(nc_dialect dialect, const char* axes, const char* text, size_t length, nc_block_text* block, nc_plain_word* words) {
  if (!nc::known(dialect) || axes == nullptr || text == nullptr || length == 0 || block == nullptr || nc::caller_bytes(block) == 0 || words == nullptr)
    return NC_E_ARGUMENT;
  static_assert(NC_MAX_WORDS == decltype(nc::Block::words)::capacity());
  const nc::Dialect& family = nc::dialect(dialect);
  nc::Block read;
  const nc::LexResult result = family.lex->read(text, length, *family.lex, family.lex->semicolon, nullptr, read);
  const nc::Words of_block(family, read);
  nc_block_text known{};
  nc::take_struct(block, &known);
  nc::BlockKind kind = of_block.kind();
  if (kind == nc::BlockKind::data_end) known.data = false;
  else if (known.data) kind = nc::BlockKind::other_data;
  else if (kind == nc::BlockKind::parameters_begin) known.data = true;
  known.fault = read.has_fault;
  known.used = result.used != 0 ? result.used : 1;
  known.count = 0;
  for (const nc::Word& word : read.words) {
    if (!nc::is_plain(word)) continue;
    nc_plain_word plain{};
    plain.letter = nc::letter_of(word.slot);
    plain.comma = nc::has_comma(word);
    plain.point = (word.flags & nc::kWordPoint) != 0;
    plain.value = word.value;
    const bool dwell = kind == nc::BlockKind::dwell && of_block.is(word, nc::Role::dwell_time);
    plain.kind = of_block.is(word, nc::Role::code) ? NC_NUMBER_CODE : dwell ? NC_NUMBER_DWELL : of_block.is_length(word, kind, axes) ? NC_NUMBER_LENGTH : NC_NUMBER_OTHER;
    nc::set_place(word, text, length, &plain);
    words[known.count++] = plain;
  }
  nc::give_struct(known, block);
  return NC_OK;
}
