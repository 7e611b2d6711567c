// SPDX-License-Identifier: Apache-2.0
// SDO transfers byte by byte as in CiA 301, and answers that are rejected.
#include "hal/canopen/sdo_client.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace {

using nc::hal::canopen::CanFrame;
using nc::hal::canopen::SdoClient;
using State = SdoClient::State;
using Bytes = std::vector<std::uint8_t>;

CanFrame from_node(const Bytes& data, unsigned node = 3) {
  CanFrame frame;
  frame.id = static_cast<std::uint16_t>(0x580 + node);
  frame.length = static_cast<std::uint8_t>(data.size());
  std::copy(data.begin(), data.end(), frame.data);
  return frame;
}
Bytes sent(SdoClient* sdo, std::int64_t now_ns = 0) {
  CanFrame frame;
  if (!sdo->request(now_ns, &frame)) return {};
  EXPECT_EQ(frame.id, 0x603);
  return {frame.data, frame.data + frame.length};
}

TEST(SdoClient, ANumberIsReadInOneFrame) {
  SdoClient sdo(3, 100);
  sdo.read(0x6041, 0);
  EXPECT_EQ(sent(&sdo), (Bytes{0x40, 0x41, 0x60, 0, 0, 0, 0, 0}));
  EXPECT_TRUE(sent(&sdo).empty());  // once
  EXPECT_TRUE(sdo.answer(from_node({0x4B, 0x41, 0x60, 0, 0x37, 0x12, 0, 0})));
  EXPECT_EQ(sdo.state(), State::kDone);
  EXPECT_EQ(sdo.data(), (Bytes{0x37, 0x12}));
  EXPECT_EQ(sdo.number(), 0x1237u);
}

TEST(SdoClient, ANumberIsWrittenInOneFrame) {
  SdoClient sdo(3, 100);
  sdo.write(0x6060, 0, {8});
  EXPECT_EQ(sent(&sdo), (Bytes{0x2F, 0x60, 0x60, 0, 8, 0, 0, 0}));
  EXPECT_TRUE(sdo.answer(from_node({0x60, 0x60, 0x60, 0, 0, 0, 0, 0})));
  EXPECT_EQ(sdo.state(), State::kDone);
}

TEST(SdoClient, ATextIsReadInSegments) {
  SdoClient sdo(3, 100);
  sdo.read(0x1008, 0);
  (void)sent(&sdo);
  EXPECT_TRUE(sdo.answer(from_node({0x41, 0x08, 0x10, 0, 9, 0, 0, 0})));
  EXPECT_EQ(sent(&sdo), (Bytes{0x60, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_TRUE(sdo.answer(from_node({0x00, 'A', 'B', 'C', 'D', 'E', 'F', 'G'})));
  EXPECT_EQ(sent(&sdo), (Bytes{0x70, 0, 0, 0, 0, 0, 0, 0}));
  EXPECT_TRUE(sdo.answer(from_node({0x1B, 'H', 'I', 0, 0, 0, 0, 0})));
  EXPECT_EQ(sdo.state(), State::kDone);
  EXPECT_EQ(std::string(sdo.data().begin(), sdo.data().end()), "ABCDEFGHI");
}

TEST(SdoClient, EightBytesAreWrittenInSegments) {
  SdoClient sdo(3, 100);
  sdo.write(0x2000, 1, {1, 2, 3, 4, 5, 6, 7, 8});
  EXPECT_EQ(sent(&sdo), (Bytes{0x21, 0x00, 0x20, 1, 8, 0, 0, 0}));
  EXPECT_TRUE(sdo.answer(from_node({0x60, 0x00, 0x20, 1, 0, 0, 0, 0})));
  EXPECT_EQ(sent(&sdo), (Bytes{0x00, 1, 2, 3, 4, 5, 6, 7}));
  EXPECT_TRUE(sdo.answer(from_node({0x20, 0, 0, 0, 0, 0, 0, 0})));
  EXPECT_EQ(sent(&sdo), (Bytes{0x1D, 8, 0, 0, 0, 0, 0, 0}));
  EXPECT_TRUE(sdo.answer(from_node({0x30, 0, 0, 0, 0, 0, 0, 0})));
  EXPECT_EQ(sdo.state(), State::kDone);
}

TEST(SdoClient, AnAbortHasItsObjectAndText) {
  SdoClient sdo(3, 100);
  sdo.write(0x1600, 2, {0x20, 0, 0x7A, 0x60});
  (void)sent(&sdo);
  EXPECT_TRUE(sdo.answer(from_node({0x80, 0x00, 0x16, 2, 0x41, 0x00, 0x04, 0x06})));
  EXPECT_EQ(sdo.state(), State::kFailed);
  EXPECT_EQ(sdo.error(), "1600h:2: the object cannot be mapped into a PDO");
  EXPECT_EQ(nc::hal::canopen::abort_text(0x12345678), "abort code 12345678h");
  EXPECT_TRUE(sent(&sdo).empty());  // no abort is sent: the node has aborted itself
}

TEST(SdoClient, SilenceEndsTheTransferAndTellsTheNode) {
  SdoClient sdo(3, 100);
  sdo.read(0x6041, 0);
  (void)sent(&sdo, 0);
  EXPECT_TRUE(sent(&sdo, 99'000'000).empty());
  EXPECT_EQ(sent(&sdo, 100'000'000), (Bytes{0x80, 0x41, 0x60, 0, 0x00, 0x00, 0x04, 0x05}));
  EXPECT_EQ(sdo.state(), State::kFailed);
  EXPECT_EQ(sdo.error(), "6041h:0: no answer");
}

TEST(SdoClient, WhatAnswersSomethingElseIsNotTaken) {
  SdoClient sdo(3, 100);
  EXPECT_FALSE(sdo.answer(from_node({0x4B, 0x41, 0x60, 0, 0, 0, 0, 0})));  // nothing was asked
  sdo.read(0x6041, 0);
  (void)sent(&sdo);
  EXPECT_FALSE(sdo.answer(from_node({0x4B, 0x41, 0x60, 0, 0, 0, 0, 0}, 4)));  // another node
  EXPECT_FALSE(sdo.answer(from_node({0x4B, 0x40, 0x60, 0, 0, 0, 0, 0})));     // another object
  EXPECT_FALSE(sdo.answer(from_node({0x4B, 0x41, 0x60, 1, 0, 0, 0, 0})));     // another sub-index
  EXPECT_FALSE(sdo.answer(from_node({0x60, 0x41, 0x60, 0, 0, 0, 0, 0})));     // the answer to a write
  EXPECT_FALSE(sdo.answer(from_node({0x4B, 0x41, 0x60})));                    // half a frame
  EXPECT_FALSE(sdo.answer(from_node({})));
  EXPECT_EQ(sdo.state(), State::kBusy);
}

TEST(SdoClient, AToggleThatDoesNotAlternateEndsTheTransfer) {
  SdoClient sdo(3, 100);
  sdo.read(0x1008, 0);
  (void)sent(&sdo);
  (void)sdo.answer(from_node({0x41, 0x08, 0x10, 0, 9, 0, 0, 0}));
  (void)sent(&sdo);
  EXPECT_TRUE(sdo.answer(from_node({0x10, 'A', 'B', 'C', 'D', 'E', 'F', 'G'})));
  EXPECT_EQ(sdo.error(), "1008h:0: toggle bit not alternated");
  EXPECT_EQ(sent(&sdo), (Bytes{0x80, 0x08, 0x10, 0, 0x00, 0x00, 0x03, 0x05}));
}

TEST(SdoClient, ALengthThatIsNotKeptIsAnError) {
  SdoClient sdo(3, 100);
  sdo.read(0x1008, 0);
  (void)sent(&sdo);
  (void)sdo.answer(from_node({0x41, 0x08, 0x10, 0, 3, 0, 0, 0}));
  (void)sent(&sdo);
  (void)sdo.answer(from_node({0x01, 'A', 'B', 'C', 'D', 'E', 'F', 'G'}));
  EXPECT_EQ(sdo.error(), "1008h:0: says that it is 3 bytes long and sends 7");
  sdo.read(0x1008, 0);
  (void)sent(&sdo);
  (void)sdo.answer(from_node({0x41, 0x08, 0x10, 0, 0xFF, 0xFF, 0xFF, 0xFF}));
  EXPECT_EQ(sdo.state(), State::kFailed);  // a node must not be able to fill the memory
}

}  // namespace
