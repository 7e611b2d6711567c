// SPDX-License-Identifier: Apache-2.0
// SDO transfers. See sdo_client.hpp. Command specifiers as CiA 301 numbers them ("SDO protocols").
#include "hal/canopen/sdo_client.hpp"

#include <algorithm>
#include <cstdio>

namespace nc::hal::canopen {
namespace {

constexpr std::size_t kSegment = 7, kExpedited = 4;
constexpr std::size_t kMostBytes = 65536;  // limit for an answer, so that a node cannot fill the memory
constexpr std::uint32_t kToggle = 0x05030000, kTimeout = 0x05040000, kNoMemory = 0x05040005, kLengthWrong = 0x06070010;

struct AbortRow {
  std::uint32_t code;
  const char* text;
};
constexpr AbortRow kAborts[] = {
    {0x05030000, "toggle bit not alternated"},
    {0x05040000, "no answer in time"},
    {0x05040001, "command specifier not valid or unknown"},
    {0x05040002, "block size not valid"},
    {0x05040003, "sequence number not valid"},
    {0x05040004, "CRC error"},
    {0x05040005, "out of memory"},
    {0x06010000, "access to the object is not supported"},
    {0x06010001, "the object can only be written"},
    {0x06010002, "the object can only be read"},
    {0x06020000, "the object does not exist"},
    {0x06040041, "the object cannot be mapped into a PDO"},
    {0x06040042, "the mapped objects are longer than a PDO"},
    {0x06040043, "parameter incompatible"},
    {0x06040047, "incompatible inside the device"},
    {0x06060000, "access failed: hardware error"},
    {0x06070010, "length of the value does not match"},
    {0x06070012, "the value is too long"},
    {0x06070013, "the value is too short"},
    {0x06090011, "the sub-index does not exist"},
    {0x06090030, "the value is out of its range"},
    {0x06090031, "the value is too high"},
    {0x06090032, "the value is too low"},
    {0x06090036, "the maximum is below the minimum"},
    {0x060A0023, "resource not available"},
    {0x08000000, "general error"},
    {0x08000020, "the value cannot be transferred or stored"},
    {0x08000021, "not now: the device is under local control"},
    {0x08000022, "not now: the state of the device forbids it"},
    {0x08000023, "no object dictionary"},
    {0x08000024, "no data available"},
};

}  // namespace

std::string abort_text(std::uint32_t code) {
  for (const AbortRow& row : kAborts)
    if (row.code == code) return row.text;
  char text[48];
  std::snprintf(text, sizeof text, "abort code %08Xh", code);
  return text;
}

std::string object_text(unsigned index, unsigned sub) {
  char text[24];
  std::snprintf(text, sizeof text, "%04Xh:%u", index & 0xFFFF, sub & 0xFF);
  return text;
}

void SdoClient::begin(Step step, std::uint16_t index, std::uint8_t sub) {
  state_ = State::kBusy;
  step_ = step;
  index_ = index;
  sub_ = sub;
  waits_ = aborting_ = toggle_ = last_ = false;
  at_ = expected_ = 0;
  abort_code_ = 0;
  error_.clear();
}

void SdoClient::read(std::uint16_t index, std::uint8_t sub) {
  begin(Step::kReadStart, index, sub);
  data_.clear();
}

void SdoClient::write(std::uint16_t index, std::uint8_t sub, std::vector<std::uint8_t> data) {
  begin(Step::kWriteStart, index, sub);
  data_ = std::move(data);
}

std::uint32_t SdoClient::number() const {
  return get_le(data_.data(), static_cast<unsigned>(std::min<std::size_t>(data_.size(), 4)));
}

CanFrame SdoClient::frame() const {
  CanFrame out;
  out.id = static_cast<std::uint16_t>(kSdoRequestId + node_);
  out.length = kMaxData;
  put_le(out.data + 1, 2, index_);
  out.data[3] = sub_;
  const std::uint8_t toggle = toggle_ ? 0x10 : 0;
  if (aborting_) {
    out.data[0] = 0x80;
    put_le(out.data + 4, 4, abort_code_);
  } else if (step_ == Step::kReadStart) {
    out.data[0] = 0x40;
  } else if (step_ == Step::kReadSegment) {
    std::fill(out.data, out.data + kMaxData, std::uint8_t{0});
    out.data[0] = static_cast<std::uint8_t>(0x60 | toggle);
  } else if (step_ == Step::kWriteStart && !data_.empty() && data_.size() <= kExpedited) {
    out.data[0] = static_cast<std::uint8_t>(0x23 | (kExpedited - data_.size()) << 2);
    std::copy(data_.begin(), data_.end(), out.data + 4);
  } else if (step_ == Step::kWriteStart) {
    out.data[0] = 0x21;
    put_le(out.data + 4, 4, static_cast<std::uint32_t>(data_.size()));
  } else {
    const std::size_t count = std::min(kSegment, data_.size() - at_);
    std::fill(out.data, out.data + kMaxData, std::uint8_t{0});
    out.data[0] = static_cast<std::uint8_t>(toggle | (kSegment - count) << 1 | (at_ + count == data_.size() ? 1 : 0));
    std::copy_n(data_.begin() + static_cast<std::ptrdiff_t>(at_), count, out.data + 1);
  }
  return out;
}

bool SdoClient::request(std::int64_t now_ns, CanFrame* out) {
  if (aborting_) {  // tells the node to end the transfer, too
    *out = frame();
    aborting_ = false;
    return true;
  }
  if (state_ != State::kBusy) return false;
  if (waits_) {
    if (now_ns - sent_ns_ < timeout_ns_) return false;
    fail("no answer", kTimeout);
    return request(now_ns, out);
  }
  *out = frame();
  waits_ = true;
  sent_ns_ = now_ns;
  return true;
}

bool SdoClient::fail(const std::string& why, std::uint32_t code, bool tell) {
  state_ = State::kFailed;
  waits_ = false;
  abort_code_ = code;
  aborting_ = tell;
  error_ = object_text(index_, sub_) + ": " + why;
  return true;
}

void SdoClient::next() { waits_ = false; }

bool SdoClient::answer(const CanFrame& frame) {
  if (frame.id != kSdoAnswerId + node_ || frame.length < 1 || state_ != State::kBusy || !waits_) return false;
  const unsigned command = frame.data[0];
  const bool whole = frame.length == kMaxData, same = whole && get_le(frame.data + 1, 2) == index_ && frame.data[3] == sub_;
  if (command >> 5 == 4) {  // an abort, which names its object
    if (!same) return false;
    const std::uint32_t reason = get_le(frame.data + 4, 4);
    return fail(abort_text(reason), reason, false);
  }
  const bool starts = step_ == Step::kReadStart || step_ == Step::kWriteStart;
  const unsigned wanted = step_ == Step::kReadStart ? 2 : step_ == Step::kReadSegment ? 0 : step_ == Step::kWriteStart ? 3 : 1;
  if (!whole || command >> 5 != wanted || (starts && !same)) return false;
  if (step_ == Step::kReadStart) return take_read_start(frame);
  if (step_ == Step::kReadSegment) return take_read_segment(frame);
  if (step_ == Step::kWriteSegment) return take_write_segment(frame);
  if (!data_.empty() && data_.size() <= kExpedited) {
    state_ = State::kDone;
  } else {
    step_ = Step::kWriteSegment;
  }
  next();
  return true;
}

bool SdoClient::take_read_start(const CanFrame& frame) {
  const unsigned command = frame.data[0];
  const bool expedited = (command & 2) != 0, sized = (command & 1) != 0;
  if (expedited) {
    const std::size_t count = sized ? kExpedited - (command >> 2 & 3) : kExpedited;
    data_.assign(frame.data + 4, frame.data + 4 + count);
    state_ = State::kDone;
  } else {
    expected_ = sized ? get_le(frame.data + 4, 4) : 0;
    if (expected_ > kMostBytes) return fail("says that it is " + std::to_string(expected_) + " bytes long", kNoMemory);
    step_ = Step::kReadSegment;
  }
  next();
  return true;
}

bool SdoClient::take_read_segment(const CanFrame& frame) {
  const unsigned command = frame.data[0];
  if ((command >> 4 & 1) != (toggle_ ? 1u : 0u)) return fail(abort_text(kToggle), kToggle);
  const std::size_t count = kSegment - (command >> 1 & 7);
  data_.insert(data_.end(), frame.data + 1, frame.data + 1 + count);
  if (data_.size() > kMostBytes) return fail("is longer than " + std::to_string(kMostBytes) + " bytes", kNoMemory);
  if ((command & 1) != 0) {
    if (expected_ != 0 && expected_ != data_.size())
      return fail("says that it is " + std::to_string(expected_) + " bytes long and sends " + std::to_string(data_.size()), kLengthWrong, false);
    state_ = State::kDone;
  }
  toggle_ = !toggle_;
  next();
  return true;
}

bool SdoClient::take_write_segment(const CanFrame& frame) {
  if ((frame.data[0] >> 4 & 1) != (toggle_ ? 1u : 0u)) return fail(abort_text(kToggle), kToggle);
  at_ += std::min(kSegment, data_.size() - at_);
  if (at_ == data_.size()) state_ = State::kDone;
  toggle_ = !toggle_;
  next();
  return true;
}

}  // namespace nc::hal::canopen
