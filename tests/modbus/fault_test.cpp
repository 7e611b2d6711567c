// SPDX-License-Identifier: Apache-2.0
// Wrong answers: none of their values may ever be shown, and afterwards the link must work as before.
#include <random>
#include <set>

#include "modbus/link_rig.hpp"

namespace {

using namespace nc::test;

constexpr std::uint16_t kRight = 5, kPoison = 666, kOnLoss = 99;

// Replaces the value of an answer by the poison: the last two bytes of the answer to function 3 for one register.
Answer poisoned(Answer right) {
  right.bytes[right.bytes.size() - 2] = kPoison >> 8;
  right.bytes.back() = kPoison & 0xFF;
  return right;
}

struct Wrong {
  const char* name;
  Answer (*make)(Answer);
};
std::ostream& operator<<(std::ostream& out, const Wrong& wrong) {
  return out << wrong.name;
}

const Wrong kWrong[] = {
    {"transaction",
     [](Answer a) {
       a = poisoned(a);
       a.bytes[1] ^= 1;
       return a;
     }},
    {"unit",
     [](Answer a) {
       a = poisoned(a);
       a.bytes[6] = 2;
       return a;
     }},
    {"protocol",
     [](Answer a) {
       a = poisoned(a);
       a.bytes[3] = 1;
       return a;
     }},
    {"length_too_large",
     [](Answer a) {
       a = poisoned(a);
       a.bytes[5] = 9;
       return a;
     }},
    {"length_too_small",
     [](Answer a) {
       a = poisoned(a);
       a.bytes[5] = 3;
       return a;
     }},
    {"exception_of_another_unit",
     [](Answer a) {
       a.bytes[6] = 7;
       a.bytes[7] = 0x83;
       a.bytes[8] = 2;
       a.bytes.resize(9);
       a.bytes[5] = 3;
       return a;
     }},
    {"function",
     [](Answer a) {
       a = poisoned(a);
       a.bytes[7] = 4;
       return a;
     }},
    {"more_registers",
     [](Answer a) {
       a = poisoned(a);
       a.bytes[8] = 4;
       a.bytes.insert(a.bytes.end(), {1, 2});
       return a;
     }},
    {"no_registers",
     [](Answer a) {
       a = poisoned(a);
       a.bytes[8] = 0;
       return a;
     }},
    {"odd_bytes",
     [](Answer a) {
       a = poisoned(a);
       a.bytes[8] = 3;
       a.bytes.push_back(9);
       return a;
     }},
    {"unknown_exception",
     [](Answer a) {
       a.bytes[7] = 0x83;
       a.bytes[8] = 0x77;
       a.bytes.resize(9);
       return a;
     }},
    {"exception_of_another_function",
     [](Answer a) {
       a.bytes[7] = 0x84;
       a.bytes[8] = 2;
       a.bytes.resize(9);
       return a;
     }},
    {"half_and_close",
     [](Answer a) {
       a = poisoned(a);
       a.bytes.resize(6);
       a.close = true;
       return a;
     }},
    {"half_value_and_close",
     [](Answer a) {
       a = poisoned(a);
       a.bytes.pop_back();
       a.close = true;
       return a;
     }},
    {"half_and_silence",
     [](Answer a) {
       a = poisoned(a);
       a.bytes.resize(8);
       return a;
     }},
    {"silence",
     [](Answer a) {
       a.bytes.clear();
       return a;
     }},
    {"close",
     [](Answer a) {
       a.bytes.clear();
       a.close = true;
       return a;
     }},
    {"text",
     [](Answer a) {
       const std::string text = "HTTP/1.1 400 Bad Request\r\n\r\n";
       a.bytes.assign(text.begin(), text.end());
       return a;
     }},
    {"flood",
     [](Answer a) {
       a.bytes.assign(5000, 0xFF);
       return a;
     }},
    // The late answer is there when the next request is sent: libmodbus alone would from then on be one answer behind.
    {"late",
     [](Answer a) {
       a = poisoned(a);
       a.delay_ms = 400;
       return a;
     }},
};

class ModbusFault : public testing::TestWithParam<Wrong> {};

TEST_P(ModbusFault, ShowsNoWrongValueAndHeals) {
  const Wrong wrong = GetParam();
  LoopbackServer server;
  server.with([](auto& units) { units[1].holding = {{0, kRight}}; });
  LinkRig rig;
  rig.short_timeouts();
  const unsigned point = rig.add(Table::kHolding, 0, Format::kU16);
  rig.map().on_loss = OnLoss::kValue;
  rig.map().loss_value = kOnLoss;
  rig.start(server.port());
  ASSERT_TRUE(rig.until([&] { return rig.good(point) && rig.value(point) == kRight; }));
  const unsigned connections = server.connections();
  server.set_fault([&](const Bytes&, Answer right) { return wrong.make(right); });
  std::set<std::uint32_t> seen;
  ASSERT_TRUE(rig.until([&] {
    seen.insert(rig.value(point));
    return !rig.ok() && !rig.good(point);
  }));
  EXPECT_EQ(rig.value(point), kOnLoss);
  EXPECT_GT(server.connections(), connections) << "the connection was closed";
  server.set_fault({});
  server.with([](auto& units) { units[1].holding[0] = kRight + 1; });
  ASSERT_TRUE(rig.until([&] {
    seen.insert(rig.value(point));
    return rig.ok() && rig.good(point) && rig.value(point) == kRight + 1;
  }));
  for (int i = 0; i < 50; ++i) {
    rig.scan();
    seen.insert(rig.value(point));
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  const std::set<std::uint32_t> allowed{kRight, kOnLoss, kRight + 1};
  for (const std::uint32_t value : seen) EXPECT_TRUE(allowed.contains(value)) << value;
}

INSTANTIATE_TEST_SUITE_P(All, ModbusFault, testing::ValuesIn(kWrong),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

// An answer comes twice: the second one must not be taken for the answer to the next request.
TEST(ModbusFault, AnAnswerNobodyAskedForClosesTheConnection) {
  LoopbackServer server;
  server.with([](auto& units) { units[1].holding = {{0, kRight}}; });
  LinkRig rig;
  const unsigned point = rig.add(Table::kHolding, 0, Format::kU16);
  rig.start(server.port());
  server.set_fault([](const Bytes&, Answer right) {
    const Bytes again = poisoned(right).bytes;
    right.bytes.insert(right.bytes.end(), again.begin(), again.end());
    return right;
  });
  bool poison = false;
  ASSERT_TRUE(rig.until([&] {
    poison |= rig.value(point) == kPoison;
    return server.connections() > 5;
  }));
  EXPECT_FALSE(poison);
  EXPECT_NE(rig.link->statistics().last_error.find("nobody asked for"), std::string::npos)
      << rig.link->statistics().last_error;
}

// Random bytes, and right answers with random damage before the value, or cut off anywhere.
TEST(ModbusFault, TwoThousandRandomAnswers) {
  constexpr unsigned kAnswers = 2000;
  // The server's threads use these until it is destroyed, so they outlive it.
  std::mt19937 random(20260101);
  std::atomic<unsigned> answers{0};
  LoopbackServer server;
  server.with([](auto& units) {
    units[1].holding = {{0, kRight}};
    units[1].coil = {{0, 0}};
  });
  LinkRig rig;
  rig.config.poll_ms = 1;
  rig.short_timeouts(20);
  rig.config.lost_after = 1;
  rig.config.backoff_min_ms = 0;
  rig.config.backoff_max_ms = 1;
  const unsigned point = rig.add(Table::kHolding, 0, Format::kU16);
  rig.map().on_loss = OnLoss::kValue;
  rig.map().loss_value = kOnLoss;
  const unsigned bit = rig.add(Table::kCoil, 0);
  server.set_fault([&](const Bytes&, Answer right) {
    if (answers.fetch_add(1) >= kAnswers) return right;
    const auto pick = [&](unsigned n) { return static_cast<unsigned>(random() % n); };
    const unsigned kind = pick(3);
    if (kind == 0) {  // noise
      right.bytes.resize(pick(300));
      for (std::uint8_t& byte : right.bytes) byte = static_cast<std::uint8_t>(random());
    } else if (kind == 1) {  // damage in what stands in front of the value, in the transaction or behind it
      right.bytes[pick(9)] = static_cast<std::uint8_t>(random());
      if (pick(2) == 0) right.bytes[pick(2)] ^= static_cast<std::uint8_t>(1 + pick(255));
    } else {
      right.bytes.resize(pick(static_cast<unsigned>(right.bytes.size())));
    }
    right.close = right.bytes.size() < 9 || pick(4) != 0;  // without that each short answer would take a time-out
    return right;
  });
  rig.start(server.port());
  std::set<std::uint32_t> seen;
  ASSERT_TRUE(rig.until(
      [&] {
        seen.insert(rig.value(point));
        EXPECT_EQ(rig.value(bit), 0u);
        return answers > kAnswers && rig.good(point) && rig.good(bit);
      },
      120));
  EXPECT_EQ(seen, (std::set<std::uint32_t>{kRight, kOnLoss}));
  EXPECT_GE(rig.link->statistics().errors, kAnswers * 3 / 4);
}

}  // namespace
