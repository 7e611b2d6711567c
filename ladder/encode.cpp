// SPDX-License-Identifier: Apache-2.0
// Converts the operands of an instruction to the form that the interpreter takes, and checks their type and whether they may be written.
#include <limits>

#include "ladder/compiler.hpp"

namespace nc::ladder {

std::uint32_t Compiler::new_bit() {
  code_.edge_start.push_back(0);
  return code_.layout.edges + static_cast<std::uint32_t>(code_.edge_start.size()) - 1;
}

std::uint32_t Compiler::new_edge() {
  const std::uint32_t bit = new_bit();
  code_.edge_start.back() = kEdgeUnknown;
  remember(bit);
  return bit;
}

void Compiler::emit(Op op, std::uint32_t a, unsigned mode) {
  Unit unit{};
  unit.head = {static_cast<std::uint16_t>(op), static_cast<std::uint16_t>(mode), a};
  code_.units.push_back(unit);
  code_.lines.push_back(line_);
}

void Compiler::emit2(std::uint32_t b, std::uint32_t c) {
  Unit unit{};
  unit.tail = {b, c};
  code_.units.push_back(unit);
  code_.lines.push_back(line_);
}

void Compiler::emit_pulse(Op next, bool pulse) {
  if (pulse) note_rising();
  if (pulse) emit(Op::kSkipNotRising, new_edge(), units_of(next));
}

bool Compiler::bit_operand(std::string_view word, bool written, Place* place) {
  std::string message;
  const auto operand = names_.operand(word, &message);
  if (!operand) {
    error(message);
    return false;
  }
  if (operand->form != Operand::Form::kDevice) {
    error("'" + std::string(word) + "' is no bit");
    return false;
  }
  if (operand->place.type != DeviceType::kBit) {
    error("'" + std::string(word) + "' is a word; a bit is needed");
    return false;
  }
  if (written && !operand->place.writable) {
    const Kind kind = operand->place.kind;
    error("'" + std::string(word) +
          (kind == Kind::kTimer || kind == Kind::kCounter || kind == Kind::kContact
               ? "' is a contact of a timer or counter; only OUT and RST work on it"
               : "' is read-only"));
    return false;
  }
  *place = operand->place;
  if (written) note_written(*place);
  if (place->kind == Kind::kWordBit) open_word_bit(place, written);
  return true;
}

// Instructions cannot work on a bit of a word directly. So it is copied into a bit of its own before the instruction, and copied back after it.
void Compiler::open_word_bit(Place* place, bool written) {
  const WordBit bit{place->index, place->number, new_bit()};
  emit(Op::kWordBit, bit.word);
  emit2(bit.number, bit.bit);
  if (written) word_bits_.push_back(bit);
  place->index = bit.bit;
}

void Compiler::close_word_bits() {
  for (const WordBit& bit : word_bits_) {
    emit(Op::kBitWord, bit.word);
    emit2(bit.number, bit.bit);
  }
  word_bits_.clear();
}

// A hint to the instruction of the other width, such as "use the D form DMOV"; empty when there is none.
std::string Compiler::other_width(bool wide) const {
  const std::string name = rule_->info.name;
  std::string other;
  if (wide) {
    other = name.substr(0, name.find_first_of("=<>"));
    if (other != name && other.size() > 1 && other.back() == 'D')  // LDD= -> LD=
      other = other.substr(0, other.size() - 1) + name.substr(other.size());
    else
      other = name.substr(1);  // DMOV -> MOV
  } else {
    const std::size_t sign = name.find_first_of("=<>");
    other = sign == std::string::npos ? "D" + name : name.substr(0, sign) + "D" + name.substr(sign);
    if (name[0] == 'W') other = "D" + name.substr(1);  // WAND -> DAND
  }
  if (wide && other != name && (other == "AND" || other == "OR" || other == "XOR")) other = "W" + other;
  bool pulse;
  if (find_rule(other, &pulse) == nullptr) return {};
  return wide ? "; use the 16-bit form " + other : "; use the D form " + other;
}

bool Compiler::encode_constant(const Operand& operand, bool wide, bool written, Encoded* out) {
  if (written) {
    error("a constant cannot be a destination");
    return false;
  }
  std::int64_t value = operand.constant;
  if (operand.hexadecimal) {
    if (value > (wide ? 0xffffffffLL : 0xffffLL)) {
      error(wide ? "H is at most FFFFFFFF" : "H is at most FFFF" + other_width(false));
      return false;
    }
    value = wide ? static_cast<std::int32_t>(static_cast<std::uint32_t>(value))
                 : static_cast<std::int16_t>(static_cast<std::uint16_t>(value));
  } else {
    const std::int64_t least =
        wide ? std::numeric_limits<std::int32_t>::min() : std::numeric_limits<std::int16_t>::min();
    if (value < least || value > -(least + 1)) {
      error("K is from " + std::to_string(least) + " to " + std::to_string(-(least + 1)) +
            (wide ? std::string() : other_width(false)));
      return false;
    }
  }
  *out = {Mode::kConstant, static_cast<std::uint32_t>(static_cast<std::int32_t>(value))};
  return true;
}

bool Compiler::encode_digits(const Operand& operand, bool wide, bool written, Encoded* out) {
  if (!wide && operand.digits > 4) {
    error("a 16-bit instruction takes K1 to K4 of bits" + other_width(false));
    return false;
  }
  if (written && !operand.place.writable) {
    error("the bits are read-only");
    return false;
  }
  Indirect where;
  where.base = operand.place.index;
  where.digits = operand.digits;
  code_.indirect.push_back(where);
  *out = {Mode::kIndirect, static_cast<std::uint32_t>(code_.indirect.size() - 1)};
  return true;
}

// Encodes the place of a word together with the range of devices of its kind, which the scan checks.
bool Compiler::encode_row(const Operand& operand, bool written, Encoded* out) {
  const Place place = current_value(operand.place);
  if (written && !place.writable) {
    error("the destination is read-only");
    return false;
  }
  if (written) note_written(place);
  code_.indirect.push_back({place.index, operand.z, place.first, place.end, 0});
  *out = {Mode::kIndirect, static_cast<std::uint32_t>(code_.indirect.size() - 1)};
  return true;
}

bool Compiler::encode_words(const Operand& operand, std::uint32_t width, std::string_view word,
                            Encoded* out) {
  if (!operand.place.pairs) {
    error("'" + std::string(word) + "': the result takes " + std::to_string(width) + " words; use D");
    return false;
  }
  if (operand.z == Indirect::kNoZ && operand.place.index + width > operand.place.end) {
    error("'" + std::string(word) + "': the last of the " + std::to_string(width) + " words does not exist");
    return false;
  }
  return encode_row(operand, true, out);
}

bool Compiler::encode(char letter, std::string_view word, Encoded* out) {
  std::string message;
  auto operand = names_.operand(word, &message);
  if (!operand) {
    error(message);
    return false;
  }
  const bool wide = letter == 'S' || letter == 'D';
  const bool written = letter != 's' && letter != 'S' && letter != 'r';
  const bool row = letter == 'r' || letter == 'w' || letter == 'q' || letter == 'Q';
  if (row && operand->form != Operand::Form::kDevice) {
    error("'" + std::string(word) + "': a row of words is needed");
    return false;
  }
  if (operand->form == Operand::Form::kConstant) return encode_constant(*operand, wide, written, out);
  if (operand->form == Operand::Form::kDigits) return encode_digits(*operand, wide, written, out);
  operand->place = current_value(operand->place);
  const Place& place = operand->place;
  if (place.type == DeviceType::kBit) {
    error("'" + std::string(word) + "' is a bit; a word is needed");
    return false;
  }
  if (letter == 'q' || letter == 'Q') return encode_words(*operand, letter == 'q' ? 2 : 4, word, out);
  if (row) return encode_row(*operand, written, out);
  if (!wide && place.type == DeviceType::kWord32) {
    error("'" + std::string(word) + "' has 32 bits" + other_width(false));
    return false;
  }
  if (wide && place.type == DeviceType::kWord16 && !place.pairs) {
    error("'" + std::string(word) + "' has 16 bits" + other_width(true));
    return false;
  }
  if (written && !place.writable) {
    error("'" + std::string(word) + "' is read-only");
    return false;
  }
  if (operand->z != Indirect::kNoZ) return encode_row(*operand, written, out);
  if (wide && place.index + 2 > place.end) {
    error("'" + std::string(word) + "': the second of the two words does not exist");
    return false;
  }
  if (written) note_written(place);
  *out = {Mode::kDirect, place.index};
  return true;
}

}  // namespace nc::ladder
