// SPDX-License-Identifier: Apache-2.0
// Requests and answers as the bytes of Modbus TCP: MBAP header and PDU. A serial line has the unit and the PDU of them. Modbus application protocol V1.1b3, 6;
// Modbus messaging on TCP/IP V1.0b, 3.1.3.
//
// An answer is believed only when all of it fits: transaction, protocol, length, unit, function, and, by function, the
// number of bytes or the echo of what was written. libmodbus 3.1.6 looks at the transaction and the function alone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/modbus/blocks.hpp"

namespace nc::hal::modbus {

constexpr std::size_t kMaxFrame = 260;  // 7 bytes of header, 253 of PDU

// Exceptions that mean that the partner never does what was asked of it; every other one may pass. V1.1b3, 7.
constexpr unsigned kIllegalFunction = 1, kIllegalAddress = 2;

struct Frame {
  std::array<std::uint8_t, kMaxFrame> bytes{};
  std::size_t size = 0;

  std::uint8_t function() const { return bytes[7]; }
};

Frame read_request(const Block& block, std::uint16_t transaction);
// One cell goes out by functions 5 and 6, which every device has; more by 15 and 16.
Frame write_request(const Block& block, const std::uint16_t* cells, std::uint16_t transaction);

// The answer of a serial line, unit and PDU without its check sum, as that of TCP to this request would be. `answer` has room for kMaxFrame; the
// size of what is in it, 0 where it does not fit.
std::size_t answer_of_line(const Frame& request, const std::uint8_t* unit_and_pdu, std::size_t size, std::uint8_t* answer);

enum class Verdict : std::uint8_t {
  kGood,
  kException,  // of this request; *exception is its code
  kForeign     // the answer of something else, or none
};
// `why`: a sentence for kForeign and the words for kException, static.
Verdict check_answer(const Frame& request, const std::uint8_t* answer, std::size_t size, unsigned* exception,
                     const char** why);

// The cells of a good answer to a read request (registers, or bits as 0 and 1).
void take_cells(const Block& block, const std::uint8_t* answer, std::uint16_t* cells);

}  // namespace nc::hal::modbus
