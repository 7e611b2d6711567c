// SPDX-License-Identifier: Apache-2.0
// Tells hosts that look at the text of a program what the numbers of a block are (nc_number_kinds). The tables of the family decide.
#include <cmath>
#include <cstring>

#include "dialect/dialect.hpp"
#include "nc/control.h"

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

class Words {
 public:
  Words(const Dialect& dialect, const nc_plain_word* words, unsigned count) : dialect_(dialect), words_(words), count_(count) {}

  BlockKind kind() const {
    for (unsigned i = 0; i < count_; ++i) {
      const nc_plain_word& word = words_[i];
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

  bool is(const nc_plain_word& word, Role role) const { return !word.comma && dialect_.addresses.is(word.letter, role); }

  bool is_length(const nc_plain_word& word, BlockKind block, const char* axes) const {
    const bool axis = !word.comma && std::strchr(axes, word.letter) != nullptr;
    switch (block) {
      case BlockKind::work_data: return axis;
      case BlockKind::tool_data: return is(word, Role::input_amount);
      case BlockKind::holes:  // M700 13.2: K of a pattern counts
        if (is(word, Role::hole_count)) return false;
        break;
      case BlockKind::tap:  // 13.1.1: ,R and ,S choose how the tap is made
        if (word.comma) return false;
        break;
      case BlockKind::bore:  // a peck, or the shift of a bore
        if (is(word, Role::cycle_depth_step)) return true;
        break;
      case BlockKind::motion: break;
      default: return false;
    }
    if (word.comma) return dialect_.addresses.is(word.letter, Role::option_chamfer) || dialect_.addresses.is(word.letter, Role::option_corner_radius);
    return axis || is(word, Role::vector_x) || is(word, Role::vector_y) || is(word, Role::vector_z) || is(word, Role::arc_radius);
  }

 private:
  static constexpr double kMostCode = 1000;

  DataInput input() const {
    uint32_t kind = DataInputRow::kWithoutL;
    for (unsigned i = 0; i < count_; ++i)
      if (is(words_[i], Role::input_kind) && words_[i].value >= 0 && words_[i].value < kMostCode) kind = static_cast<uint32_t>(words_[i].value);
    for (const DataInputRow& row : dialect_.data_input)
      if (row.l == kind) return row.input;
    return DataInput::missing;
  }

  const Dialect& dialect_;
  const nc_plain_word* words_;
  unsigned count_;
};

}  // namespace
}  // namespace nc

nc_status nc_number_kinds(nc_dialect dialect, const char* axes, const nc_plain_word* words, unsigned count, bool* data, uint8_t* kinds) {
  if (!nc::known(dialect) || axes == nullptr || data == nullptr || (count != 0 && (words == nullptr || kinds == nullptr))) return NC_E_ARGUMENT;
  const nc::Words block(nc::dialect(dialect), words, count);
  nc::BlockKind kind = block.kind();
  if (kind == nc::BlockKind::data_end) *data = false;
  else if (*data) kind = nc::BlockKind::other_data;
  else if (kind == nc::BlockKind::parameters_begin) *data = true;
  for (unsigned i = 0; i < count; ++i) {
    const bool dwell = kind == nc::BlockKind::dwell && block.is(words[i], nc::Role::dwell_time);
    kinds[i] = dwell ? NC_NUMBER_DWELL : block.is_length(words[i], kind, axes) ? NC_NUMBER_LENGTH : NC_NUMBER_OTHER;
  }
  return NC_OK;
}
