// SPDX-License-Identifier: Apache-2.0
// Any bytes as the answer of a Modbus device to each kind of request. An answer that is believed is the answer to this request; its values
// lie within their points, and come back when they are written.
#include <algorithm>
#include <array>
#include <vector>

#include "fuzz/input.hpp"
#include "hal/modbus/codec.hpp"
#include "hal/modbus/frame.hpp"

namespace {

using namespace nc::hal::modbus;
using nc::fuzz::Bytes;
using nc::fuzz::require;

constexpr unsigned kHeader = 7;  // of Modbus TCP, in front of the function

struct Asked {
  Block block;
  Frame request;
  std::uint16_t transaction = 0;
};

Asked asked_from(Bytes* in) {
  Asked asked;
  Block& block = asked.block;
  const std::uint8_t shape = in->byte();
  block.table = static_cast<Table>(shape & 3);
  block.write = (shape & 4) != 0 && can_be_written(block.table);
  block.unit = in->byte();
  block.first = in->value<std::uint16_t>();
  const bool bits = is_bit_table(block.table);
  const unsigned most = block.write ? (bits ? kMaxWriteBits : kMaxWriteRegisters) : (bits ? kMaxReadBits : kMaxReadRegisters);
  const unsigned count = 1 + in->value<std::uint16_t>() % ((shape & 8) != 0 ? most : 4);
  block.count = static_cast<std::uint16_t>(std::min(count, 0x10000u - block.first));
  asked.transaction = in->value<std::uint16_t>();
  std::array<std::uint16_t, kMaxReadBits> cells{};
  for (unsigned i = 0; i < block.count && !in->empty() && block.write; ++i) cells[i] = in->value<std::uint16_t>();
  asked.request = block.write ? write_request(block, cells.data(), asked.transaction) : read_request(block, asked.transaction);
  const Frame& frame = asked.request;
  require(frame.size > kHeader && frame.size <= kMaxFrame);
  require((frame.bytes[4] << 8 | frame.bytes[5]) + 6u == frame.size);
  return asked;
}

/// Mostly an answer that begins correctly, so that its other parts are tested, too.
std::vector<std::uint8_t> answer_from(Bytes* in, const Asked& asked) {
  const std::uint8_t shape = in->byte();
  const std::string rest = in->text(kMaxFrame);
  std::array<std::uint8_t, kMaxFrame> answer{};
  const auto& sent = asked.request.bytes;
  const bool begins = (shape & 1) != 0, goes_on = (shape & 3) == 3;
  std::size_t size = 0;
  if (begins) size = kHeader + 1;
  if (goes_on && asked.block.write) size += 4;  // the echo
  std::copy_n(sent.begin(), size, answer.begin());
  if (goes_on && !asked.block.write) {
    const unsigned count = asked.block.count;
    answer[size++] = static_cast<std::uint8_t>(is_bit_table(asked.block.table) ? (count + 7) / 8 : 2 * count);
    std::copy_n(rest.begin(), std::min<std::size_t>(rest.size(), answer[kHeader + 1]), answer.begin() + static_cast<long>(size));
    size += answer[kHeader + 1];
  } else if (!goes_on) {
    const std::size_t count = std::min(rest.size(), kMaxFrame - size);
    std::copy_n(rest.begin(), count, answer.begin() + static_cast<long>(size));
    size += count;
  }
  if ((shape & 4) != 0) answer[kHeader] |= 0x80;
  if (begins && (shape & 8) == 0) {
    answer[4] = static_cast<std::uint8_t>((size - 6) >> 8);
    answer[5] = static_cast<std::uint8_t>(size - 6);
  }
  return {answer.begin(), answer.begin() + static_cast<long>(size)};
}

/// A point over the first cells of the block.
void look_through(const PointMap& map, const std::uint16_t* cells) {
  std::uint32_t value = 0;
  if (!decode(map, cells, &value)) {
    require(map.format == Format::kF32);  // the only format with NaN
    return;
  }
  const std::int64_t number = point_is_signed(map) ? static_cast<std::int32_t>(value) : static_cast<std::int64_t>(value);
  require(value_range(map).holds(number));
  if (map.scale != 1 || map.offset != 0 || map.format == Format::kF32) return;
  std::array<std::uint16_t, 2> back{cells[0], map.width() == 2 ? cells[1] : std::uint16_t{0}};
  encode(map, value, back.data());
  require(back[0] == cells[0] && (map.width() == 1 || back[1] == cells[1]));
}

void look_through_all(const Block& block, const std::uint16_t* cells, std::uint8_t choice) {
  constexpr double kScale[] = {1, -1, 0.1, 1000, 1e-9, 1e9, 0.5, -0.001};
  constexpr double kOffset[] = {0, 0, 10, -4e9};
  PointMap map;
  map.table = block.table;
  map.bit = choice & 15;
  map.order = static_cast<WordOrder>(choice >> 4 & 3);
  for (const double scale : kScale) {
    map.scale = scale;
    map.offset = kOffset[choice >> 6];
    for (unsigned format = 0; format <= static_cast<unsigned>(Format::kF32); ++format) {
      map.format = static_cast<Format>(format);
      const bool bit = map.format == Format::kBit;
      if ((is_bit_table(block.table) && !bit) || map.width() > block.count) continue;
      if (bit && (map.scale != 1 || map.offset != 0)) continue;  // refused in the configuration
      look_through(map, cells);
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes in(data, size);
  const Asked asked = asked_from(&in);
  const std::uint8_t choice = in.byte();
  // A block of exactly this size: a read behind it is seen.
  std::vector<std::uint8_t> answer = answer_from(&in, asked);
  if ((choice & 1) != 0) {  // the same as a serial line brings it, whose header is made here
    std::array<std::uint8_t, kMaxFrame> from_line{};
    const std::size_t from = std::min<std::size_t>(answer.size(), kHeader - 1);
    const std::size_t there = answer_of_line(asked.request, answer.data() + from, answer.size() - from, from_line.data());
    require(there <= kMaxFrame);
    answer.assign(from_line.begin(), from_line.begin() + static_cast<long>(there));
  }
  unsigned exception = 0;
  const char* why = nullptr;
  const Verdict verdict = check_answer(asked.request, answer.data(), answer.size(), &exception, &why);
  if (verdict != Verdict::kGood) {
    require(why != nullptr && *why != '\0');
    require((exception != 0) == (verdict == Verdict::kException) && exception <= 11);
    return 0;
  }
  const auto& sent = asked.request.bytes;
  require(answer.size() > kHeader && answer[0] == sent[0] && answer[1] == sent[1] && answer[6] == sent[6] && answer[7] == sent[7]);
  if (asked.block.write) {
    require(std::equal(sent.begin() + 8, sent.begin() + 12, answer.begin() + 8));
    return 0;
  }
  const std::vector<std::uint16_t> nothing(asked.block.count, 0xFFFF);
  std::vector<std::uint16_t> cells = nothing;
  take_cells(asked.block, answer.data(), cells.data());
  if (is_bit_table(asked.block.table)) require(std::all_of(cells.begin(), cells.end(), [](std::uint16_t c) { return c <= 1; }));
  look_through_all(asked.block, cells.data(), choice);
  return 0;
}
