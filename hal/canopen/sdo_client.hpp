// SPDX-License-Identifier: Apache-2.0
// One transfer at a time to or from the object dictionary of a node (CiA 301, SDO): expedited or segmented, with a time-out.
// A state machine without a thread or a clock: its user sends the frames that request() gives and hands over the frames from the node.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/canopen/frame.hpp"

namespace nc::hal::canopen {

// The meaning of an abort code in CiA 301, table "SDO abort codes", such as "object does not exist"; an unknown code in hexadecimal.
std::string abort_text(std::uint32_t code);

class SdoClient {
 public:
  explicit SdoClient(unsigned node, unsigned timeout_ms) : node_(node), timeout_ns_(timeout_ms * 1'000'000LL) {}

  enum class State : std::uint8_t { kIdle, kBusy, kDone, kFailed };

  void read(std::uint16_t index, std::uint8_t sub);
  void write(std::uint16_t index, std::uint8_t sub, std::vector<std::uint8_t> data);

  // True when a frame is to be sent now, which is in *frame.
  bool request(std::int64_t now_ns, CanFrame* frame);
  // Takes a frame from the node. False: it is no answer to the last request (a late answer, or another node with this number).
  bool answer(const CanFrame& frame);

  State state() const { return state_; }
  const std::vector<std::uint8_t>& data() const { return data_; }  // the data read, with kDone
  std::uint32_t number() const;                                     // the first four bytes of data() as a number
  const std::string& error() const { return error_; }               // with kFailed: "6064h:0: object does not exist"
  std::uint32_t abort_code() const { return abort_code_; }

 private:
  enum class Step : std::uint8_t { kReadStart, kReadSegment, kWriteStart, kWriteSegment };
  void begin(Step step, std::uint16_t index, std::uint8_t sub);
  CanFrame frame() const;
  bool take_read_start(const CanFrame& frame);
  bool take_read_segment(const CanFrame& frame);
  bool take_write_segment(const CanFrame& frame);
  void next();
  bool fail(const std::string& why, std::uint32_t code, bool tell = true);

  const unsigned node_;
  const std::int64_t timeout_ns_;
  State state_ = State::kIdle;
  Step step_ = Step::kReadStart;
  bool waits_ = false;    // a request was sent and not answered yet
  bool aborting_ = false;  // an abort is still to be sent to the node
  bool toggle_ = false, last_ = false;
  std::int64_t sent_ns_ = 0;
  std::uint16_t index_ = 0;
  std::uint8_t sub_ = 0;
  std::size_t at_ = 0;        // when writing: number of bytes that have been acknowledged
  std::size_t expected_ = 0;  // when reading: number of bytes that the node has announced, 0 = not announced
  std::vector<std::uint8_t> data_;
  std::string error_;
  std::uint32_t abort_code_ = 0;
};

std::string object_text(unsigned index, unsigned sub);  // "6064h:0"

}  // namespace nc::hal::canopen
