// SPDX-License-Identifier: Apache-2.0
// Modbus TCP as bytes. See frame.hpp.
#include "hal/modbus/frame.hpp"

#include <algorithm>

namespace nc::hal::modbus {
namespace {

// Function codes. V1.1b3, 6.1 to 6.6, 6.11, 6.12.
constexpr std::uint8_t kReadFunction[] = {1, 2, 4, 3};  // indexed by Table
constexpr std::uint8_t kWriteOneCoil = 5, kWriteOneRegister = 6, kWriteCoils = 15, kWriteRegisters = 16;
constexpr std::size_t kPdu = 7, kData = 8;  // offsets of the function code and of the data after it
constexpr std::uint8_t kExceptionBit = 0x80;
constexpr unsigned kLastException = 11;  // V1.1b3, 7
// The names of V1.1b3, 7. Code 7 is from older devices; 0 and 9 have no name.
constexpr const char* kExceptions[kLastException + 1] = {"exception 0",
                                                         "Illegal function",
                                                         "Illegal data address",
                                                         "Illegal data value",
                                                         "Slave device or server failure",
                                                         "Acknowledge",
                                                         "Slave device or server is busy",
                                                         "Negative acknowledge",
                                                         "Memory parity error",
                                                         "exception 9",
                                                         "Gateway path unavailable",
                                                         "Target device failed to respond"};

void put(Frame* frame, unsigned value) {
  frame->bytes[frame->size++] = static_cast<std::uint8_t>(value);
}
void put16(Frame* frame, unsigned value) {
  put(frame, value >> 8 & 0xFF);
  put(frame, value & 0xFF);
}
unsigned get16(const std::uint8_t* at) {
  return static_cast<unsigned>(at[0]) << 8 | at[1];
}

Frame begin(const Block& block, std::uint16_t transaction, std::uint8_t function) {
  Frame frame;
  put16(&frame, transaction);
  put16(&frame, 0);  // protocol 0 is Modbus
  put16(&frame, 0);  // the length, which end() sets
  put(&frame, block.unit);
  put(&frame, function);
  put16(&frame, block.first);
  return frame;
}

Frame end(Frame frame) {
  const std::size_t length = frame.size - 6;  // counted from the unit on
  frame.bytes[4] = static_cast<std::uint8_t>(length >> 8);
  frame.bytes[5] = static_cast<std::uint8_t>(length & 0xFF);
  return frame;
}

// The number of bytes of data in the answer to a read request.
std::size_t data_bytes(const Frame& request) {
  const unsigned count = get16(&request.bytes[10]);
  return request.function() <= 2 ? (count + 7) / 8 : 2 * count;
}

}  // namespace

Frame read_request(const Block& block, std::uint16_t transaction) {
  Frame frame = begin(block, transaction, kReadFunction[static_cast<unsigned>(block.table)]);
  put16(&frame, block.count);
  return end(frame);
}

Frame write_request(const Block& block, const std::uint16_t* cells, std::uint16_t transaction) {
  const bool bits = is_bit_table(block.table);
  if (block.count == 1) {
    Frame frame = begin(block, transaction, bits ? kWriteOneCoil : kWriteOneRegister);
    put16(&frame, bits ? (cells[0] != 0 ? 0xFF00u : 0u) : cells[0]);
    return end(frame);
  }
  Frame frame = begin(block, transaction, bits ? kWriteCoils : kWriteRegisters);
  put16(&frame, block.count);
  put(&frame, bits ? (block.count + 7u) / 8 : 2u * block.count);
  if (bits) {
    for (unsigned i = 0; i < block.count; i += 8) {
      unsigned byte = 0;
      for (unsigned k = 0; k < std::min(8u, block.count - i); ++k) byte |= (cells[i + k] != 0 ? 1u : 0u) << k;
      put(&frame, byte);
    }
  } else {
    for (unsigned i = 0; i < block.count; ++i) put16(&frame, cells[i]);
  }
  return end(frame);
}

std::size_t answer_of_line(const Frame& request, const std::uint8_t* unit_and_pdu, std::size_t size, std::uint8_t* answer) {
  constexpr std::size_t kUnit = kPdu - 1;
  if (size < 2 || size > kMaxFrame - kUnit) return 0;
  std::copy_n(request.bytes.begin(), 2, answer);
  answer[2] = answer[3] = 0;
  answer[4] = static_cast<std::uint8_t>(size >> 8);
  answer[5] = static_cast<std::uint8_t>(size & 0xFF);
  std::copy_n(unit_and_pdu, size, answer + kUnit);
  return kUnit + size;
}

Verdict check_answer(const Frame& request, const std::uint8_t* answer, std::size_t size, unsigned* exception,
                     const char** why) {
  const auto foreign = [why](const char* text) {
    *why = text;
    return Verdict::kForeign;
  };
  const std::uint8_t* const asked = request.bytes.data();
  if (size < kData + 1) return foreign("the answer is too short");
  if (get16(answer) != get16(asked)) return foreign("the answer is of another transaction");
  if (get16(answer + 2) != 0) return foreign("the answer is of another protocol");
  if (get16(answer + 4) + 6u != size) return foreign("the answer has another length than it says");
  if (answer[6] != asked[6]) return foreign("the answer is of another unit");
  if (answer[kPdu] == (asked[kPdu] | kExceptionBit)) {
    if (size != kData + 1) return foreign("the exception has a wrong length");
    if (answer[kData] == 0 || answer[kData] > kLastException) return foreign("the answer is an unknown exception");
    *exception = answer[kData];
    *why = kExceptions[answer[kData]];
    return Verdict::kException;
  }
  if (answer[kPdu] != asked[kPdu]) return foreign("the answer is of another function");
  if (request.function() <= 4) {
    if (answer[kData] != data_bytes(request) || size != kData + 1 + answer[kData])
      return foreign("the answer holds another number of values");
    return Verdict::kGood;
  }
  // The answer to a write request repeats the address, and the value or the count.
  if (size != kData + 4) return foreign("the answer has a wrong length");
  if (!std::equal(answer + kData, answer + kData + 4, asked + kData))
    return foreign("the answer is of another address or value");
  return Verdict::kGood;
}

void take_cells(const Block& block, const std::uint8_t* answer, std::uint16_t* cells) {
  const std::uint8_t* data = answer + kData + 1;
  for (unsigned i = 0; i < block.count; ++i)
    cells[i] = static_cast<std::uint16_t>(is_bit_table(block.table) ? data[i / 8] >> i % 8 & 1u
                                                                    : get16(data + 2 * static_cast<std::size_t>(i)));
}

}  // namespace nc::hal::modbus
