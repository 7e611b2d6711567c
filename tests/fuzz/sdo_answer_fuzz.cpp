// SPDX-License-Identifier: Apache-2.0
// Any frames as the answers of a node to a transfer. The transfer ends, its length is bounded, and every fault has a sentence.
#include <vector>

#include "fuzz/input.hpp"
#include "hal/canopen/sdo_client.hpp"

namespace {

using namespace nc::hal::canopen;
using nc::fuzz::Bytes;
using nc::fuzz::require;

constexpr unsigned kNode = 5;
constexpr std::size_t kMost = 65536 + 7;

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes in(data, size);
  SdoClient sdo(kNode, 10);
  const std::uint8_t shape = in.byte();
  const auto index = in.value<std::uint16_t>();
  const std::uint8_t sub = in.byte();
  if ((shape & 1) != 0) {
    const std::string text = in.text(shape >> 1);
    sdo.write(index, sub, {text.begin(), text.end()});
  } else {
    sdo.read(index, sub);
  }
  std::int64_t now_ns = 0;
  while (!in.empty() && sdo.state() == SdoClient::State::kBusy) {
    CanFrame request;
    if (sdo.request(now_ns, &request)) require(request.id == kSdoRequestId + kNode && request.length == kMaxData);
    const std::uint8_t kind = in.byte();
    CanFrame answer;
    answer.id = static_cast<std::uint16_t>(kSdoAnswerId + kNode + ((kind & 0xE0) == 0xE0 ? 1 : 0));
    answer.length = (kind & 0x18) == 0x18 ? kind & 7 : kMaxData;
    answer.data[0] = in.byte();
    put_le(answer.data + 1, 2, index);
    answer.data[3] = sub;
    if ((kind & 1) != 0) put_le(answer.data + 1, 4, in.value<std::uint32_t>());
    put_le(answer.data + 4, 4, in.value<std::uint32_t>());
    (void)sdo.answer(answer);
    if ((kind & 2) != 0) now_ns += 6'000'000;
    require(sdo.data().size() <= kMost);
  }
  require((sdo.state() == SdoClient::State::kFailed) == !sdo.error().empty());
  CanFrame rest;
  for (int i = 0; i < 3 && sdo.state() == SdoClient::State::kBusy; ++i) (void)sdo.request(now_ns += 20'000'000, &rest);
  require(sdo.state() != SdoClient::State::kBusy);  // without an answer the transfer ends, too
  return 0;
}
