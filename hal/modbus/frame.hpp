// SPDX-License-Identifier: Apache-2.0
// Requests and answers as the bytes of Modbus TCP: MBAP header and PDU. A serial line has the unit and the PDU of them. Modbus application protocol V1.1b3, 6;
// Modbus messaging on TCP/IP V1.0b, 3.1.3.
//
// An answer is accepted only when all of it fits: transaction, protocol, length, unit, function, and, depending on the function, the
// number of bytes or the echo of what was written. libmodbus 3.1.6 checks only the transaction and the function.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/modbus/blocks.hpp"

namespace nc::hal::modbus {

constexpr std::size_t kMaxFrame = 260;  // 7 bytes of header, 253 of PDU

// Exceptions that mean that the partner cannot ever do what was requested; every other one may be temporary. V1.1b3, 7.
constexpr unsigned kIllegalFunction = 1, kIllegalAddress = 2;

struct Frame {
  std::array<std::uint8_t, kMaxFrame> bytes{};
  std::size_t size = 0;

  std::uint8_t function() const { return bytes[7]; }
};

Frame read_request(const Block& block, std::uint16_t transaction);
// One cell is written with function 5 or 6, which every device has; several with 15 or 16.
Frame write_request(const Block& block, const std::uint16_t* cells, std::uint16_t transaction);

// The answer of a serial line, unit and PDU without its check sum, as that of TCP to this request would be. `answer` has room for kMaxFrame; the
// size of what is in it, 0 where it does not fit.
std::size_t answer_of_line(const Frame& request, const std::uint8_t* unit_and_pdu, std::size_t size, std::uint8_t* answer);

enum class Verdict : std::uint8_t {
  kGood,
  kException,  // an exception as answer to this request; *exception is its code
  kForeign     // not an answer to this request
};
// `why` gets a static text: a sentence for kForeign, the name of the exception for kException.
Verdict check_answer(const Frame& request, const std::uint8_t* answer, std::size_t size, unsigned* exception,
                     const char** why);

// The cells of a good answer to a read request (registers, or bits as 0 and 1).
void take_cells(const Block& block, const std::uint8_t* answer, std::uint16_t* cells);

}  // namespace nc::hal::modbus
