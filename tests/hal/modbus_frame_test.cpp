// SPDX-License-Identifier: Apache-2.0
// Requests of Modbus TCP byte by byte as in the protocol, and which answers are accepted.
#include "hal/modbus/frame.hpp"

#include <gtest/gtest.h>

#include <random>
#include <set>
#include <string>
#include <vector>

namespace {

using namespace nc::hal::modbus;
using Bytes = std::vector<std::uint8_t>;

Block block(Table table, unsigned unit, unsigned first, unsigned count) {
  Block made;
  made.table = table;
  made.unit = static_cast<std::uint8_t>(unit);
  made.first = static_cast<std::uint16_t>(first);
  made.count = static_cast<std::uint16_t>(count);
  return made;
}
Bytes bytes_of(const Frame& frame) {
  return {frame.bytes.begin(), frame.bytes.begin() + static_cast<std::ptrdiff_t>(frame.size)};
}
Verdict judge(const Frame& request, const Bytes& answer, unsigned* exception = nullptr) {
  unsigned code = 0;
  const char* why = "";
  return check_answer(request, answer.data(), answer.size(), exception != nullptr ? exception : &code, &why);
}

// Modbus application protocol V1.1b3, examples of 6.1, 6.3, 6.5, 6.6, 6.11 and 6.12.
TEST(ModbusFrame, RequestsAreThoseOfTheProtocol) {
  EXPECT_EQ(bytes_of(read_request(block(Table::kCoil, 1, 0x13, 0x13), 0x0102)),
            (Bytes{1, 2, 0, 0, 0, 6, 1, 1, 0, 0x13, 0, 0x13}));
  EXPECT_EQ(bytes_of(read_request(block(Table::kDiscrete, 255, 0xC4, 0x16), 1)),
            (Bytes{0, 1, 0, 0, 0, 6, 255, 2, 0, 0xC4, 0, 0x16}));
  EXPECT_EQ(bytes_of(read_request(block(Table::kHolding, 17, 0x6B, 3), 9)),
            (Bytes{0, 9, 0, 0, 0, 6, 17, 3, 0, 0x6B, 0, 3}));
  EXPECT_EQ(bytes_of(read_request(block(Table::kInput, 0, 8, 1), 9)), (Bytes{0, 9, 0, 0, 0, 6, 0, 4, 0, 8, 0, 1}));
  const std::uint16_t one = 1, three = 3;
  EXPECT_EQ(bytes_of(write_request(block(Table::kCoil, 1, 0xAC, 1), &one, 5)),
            (Bytes{0, 5, 0, 0, 0, 6, 1, 5, 0, 0xAC, 0xFF, 0}));
  EXPECT_EQ(bytes_of(write_request(block(Table::kHolding, 1, 1, 1), &three, 5)),
            (Bytes{0, 5, 0, 0, 0, 6, 1, 6, 0, 1, 0, 3}));
  const std::uint16_t coils[] = {1, 0, 1, 1, 0, 0, 1, 1, 1, 0};  // CD 01
  EXPECT_EQ(bytes_of(write_request(block(Table::kCoil, 1, 0x13, 10), coils, 5)),
            (Bytes{0, 5, 0, 0, 0, 9, 1, 15, 0, 0x13, 0, 10, 2, 0xCD, 1}));
  const std::uint16_t registers[] = {0x000A, 0x0102};
  EXPECT_EQ(bytes_of(write_request(block(Table::kHolding, 1, 1, 2), registers, 5)),
            (Bytes{0, 5, 0, 0, 0, 11, 1, 16, 0, 1, 0, 2, 4, 0, 10, 1, 2}));
}

TEST(ModbusFrame, TheLargestRequestsFit) {
  const std::vector<std::uint16_t> cells(kMaxWriteBits, 1);
  EXPECT_EQ(write_request(block(Table::kCoil, 1, 0, kMaxWriteBits), cells.data(), 5).size, 13u + 246u);
  EXPECT_EQ(write_request(block(Table::kHolding, 1, 0, kMaxWriteRegisters), cells.data(), 5).size, 13u + 246u);
}

TEST(ModbusFrame, AnswersGiveTheirCells) {
  const Block coils = block(Table::kCoil, 1, 19, 10);
  const Bytes answer = {0, 5, 0, 0, 0, 5, 1, 1, 2, 0xCD, 0x02};
  ASSERT_EQ(judge(read_request(coils, 5), answer), Verdict::kGood);
  std::uint16_t cells[10];
  take_cells(coils, answer.data(), cells);
  const std::uint16_t wanted[] = {1, 0, 1, 1, 0, 0, 1, 1, 0, 1};
  EXPECT_TRUE(std::equal(wanted, wanted + 10, cells));
  const Block words = block(Table::kHolding, 1, 107, 2);
  const Bytes registers = {0, 6, 0, 0, 0, 7, 1, 3, 4, 0x02, 0x2B, 0xFF, 0x64};
  ASSERT_EQ(judge(read_request(words, 6), registers), Verdict::kGood);
  take_cells(words, registers.data(), cells);
  EXPECT_EQ(cells[0], 0x022B);
  EXPECT_EQ(cells[1], 0xFF64);
}

TEST(ModbusFrame, ExceptionsAreThoseOfTheRequest) {
  const Frame request = read_request(block(Table::kHolding, 3, 0, 1), 7);
  unsigned code = 0;
  EXPECT_EQ(judge(request, {0, 7, 0, 0, 0, 3, 3, 0x83, 2}, &code), Verdict::kException);
  EXPECT_EQ(code, 2u);
  for (const Bytes& wrong : {Bytes{0, 7, 0, 0, 0, 3, 3, 0x83, 0}, Bytes{0, 7, 0, 0, 0, 3, 3, 0x83, 12},
                             Bytes{0, 7, 0, 0, 0, 3, 4, 0x83, 2}, Bytes{0, 8, 0, 0, 0, 3, 3, 0x83, 2},
                             Bytes{0, 7, 0, 0, 0, 3, 3, 0x84, 2}, Bytes{0, 7, 0, 0, 0, 4, 3, 0x83, 2, 0}})
    EXPECT_EQ(judge(request, wrong), Verdict::kForeign);
}

// This includes exceptions that the protocol does not have, but that a device may send.
TEST(ModbusFrame, EveryExceptionHasWords) {
  const Frame request = read_request(block(Table::kHolding, 3, 0, 1), 7);
  std::set<std::string> words;
  for (std::uint8_t number = 1; number <= 11; ++number) {
    const Bytes answer = {0, 7, 0, 0, 0, 3, 3, 0x83, number};
    unsigned code = 0;
    const char* why = nullptr;
    ASSERT_EQ(check_answer(request, answer.data(), answer.size(), &code, &why), Verdict::kException);
    EXPECT_EQ(code, number);
    ASSERT_NE(why, nullptr);
    EXPECT_TRUE(words.insert(why).second) << why;
    EXPECT_EQ(std::string(why).find("Unknown"), std::string::npos) << why;
  }
  EXPECT_EQ(words.count("exception 9"), 1u);
}

// An answer is rejected if a single bit of it, except those of the values, or its length is wrong.
TEST(ModbusFrame, NothingElseIsBelieved) {
  const std::uint16_t cells[] = {0x1234, 0x5678, 1};
  struct Case {
    Frame request;
    Bytes answer;
    std::size_t checked;  // bytes in which no bit may differ
  };
  const Case cases[] = {
      {read_request(block(Table::kHolding, 17, 5, 2), 0x0A0B), {0x0A, 0x0B, 0, 0, 0, 7, 17, 3, 4, 1, 2, 3, 4}, 9},
      {read_request(block(Table::kCoil, 17, 5, 9), 0x0A0B), {0x0A, 0x0B, 0, 0, 0, 5, 17, 1, 2, 255, 1}, 9},
      {write_request(block(Table::kHolding, 17, 5, 1), cells, 0x0A0B), {0x0A, 0x0B, 0, 0, 0, 6, 17, 6, 0, 5, 0x12, 0x34}, 12},
      {write_request(block(Table::kHolding, 17, 5, 2), cells, 0x0A0B), {0x0A, 0x0B, 0, 0, 0, 6, 17, 16, 0, 5, 0, 2}, 12},
      {write_request(block(Table::kCoil, 17, 5, 1), cells, 0x0A0B), {0x0A, 0x0B, 0, 0, 0, 6, 17, 5, 0, 5, 0xFF, 0}, 12},
  };
  for (const Case& each : cases) {
    ASSERT_EQ(judge(each.request, each.answer), Verdict::kGood);
    for (std::size_t bit = 0; bit < 8 * each.checked; ++bit) {
      Bytes wrong = each.answer;
      wrong[bit / 8] = static_cast<std::uint8_t>(wrong[bit / 8] ^ 1u << bit % 8);
      EXPECT_NE(judge(each.request, wrong), Verdict::kGood) << "bit " << bit;
    }
    for (std::size_t size = 0; size < each.answer.size(); ++size)
      EXPECT_EQ(judge(each.request, {each.answer.begin(), each.answer.begin() + static_cast<std::ptrdiff_t>(size)}),
                Verdict::kForeign);
    Bytes longer = each.answer;
    longer.push_back(0);
    EXPECT_EQ(judge(each.request, longer), Verdict::kForeign);
  }
  std::mt19937 chance(1);
  for (unsigned i = 0; i < 100000; ++i) {
    Bytes noise(chance() % 20);
    for (auto& byte : noise) byte = static_cast<std::uint8_t>(chance());
    unsigned code = 0;
    EXPECT_EQ(judge(cases[i % 5].request, noise, &code), Verdict::kForeign);
  }
}

}  // namespace
