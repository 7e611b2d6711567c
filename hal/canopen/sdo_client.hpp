// SPDX-License-Identifier: Apache-2.0
// One transfer at a time to or from the object dictionary of a node (CiA 301, SDO): expedited and segmented, with its time-out.
// A state machine without a thread or a clock: who drives it sends what request() gives and hands over what comes from the node.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hal/canopen/frame.hpp"

namespace nc::hal::canopen {

// "object does not exist": of CiA 301, table "SDO abort codes"; another code in hexadecimal.
std::string abort_text(std::uint32_t code);

class SdoClient {
 public:
  explicit SdoClient(unsigned node, unsigned timeout_ms) : node_(node), timeout_ns_(timeout_ms * 1'000'000LL) {}

  enum class State : std::uint8_t { kIdle, kBusy, kDone, kFailed };

  void read(std::uint16_t index, std::uint8_t sub);
  void write(std::uint16_t index, std::uint8_t sub, std::vector<std::uint8_t> data);

  // True with the frame that is to be sent now.
  bool request(std::int64_t now_ns, CanFrame* frame);
  // A frame from the node. False: it answers nothing that was asked (a late answer, or another node under this number).
  bool answer(const CanFrame& frame);

  State state() const { return state_; }
  const std::vector<std::uint8_t>& data() const { return data_; }  // kDone of a read
  std::uint32_t number() const;                                     // its first four bytes
  const std::string& error() const { return error_; }               // kFailed: "6064h:0: object does not exist"
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
  bool waits_ = false;    // sent, not answered
  bool aborting_ = false;  // the node is to be told
  bool toggle_ = false, last_ = false;
  std::int64_t sent_ns_ = 0;
  std::uint16_t index_ = 0;
  std::uint8_t sub_ = 0;
  std::size_t at_ = 0;        // of a write: bytes that have been acknowledged
  std::size_t expected_ = 0;  // of a read: 0 = not said
  std::vector<std::uint8_t> data_;
  std::string error_;
  std::uint32_t abort_code_ = 0;
};

std::string object_text(unsigned index, unsigned sub);  // "6064h:0"

}  // namespace nc::hal::canopen
