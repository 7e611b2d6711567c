// SPDX-License-Identifier: Apache-2.0
// Commands that come through the segment, as those of nc_Command do: some take seconds, and what stops the machine waits for none of them.
#include <atomic>
#include <chrono>
#include <memory>
#include <thread>

#include "runtime/share/text.hpp"
#include "services/local_machine.hpp"

namespace nc::test {
namespace {

using namespace rt::share;

class GatewayCommands : public LocalMachine {
 protected:
  void SetUp() override {
    LocalMachine::SetUp();
    std::string error;
    ASSERT_TRUE(reader_.open("unit-s" + std::to_string(getpid()), &error)) << error;
    ASSERT_TRUE(reader_.claim_commands(&error)) << error;
  }
  void TearDown() override {
    let_go();
    reader_.close();
    LocalMachine::TearDown();
  }
  bool has_commands() override { return true; }

  // False when the ring is full.
  bool send(RequestKind kind, const char* client = "hmi", unsigned system = 0, const std::string& text = "", std::uint32_t number = 0) {
    Request request{};
    set_text(&request.client, client);
    request.sequence = ++sent_;
    request.writer = 1;
    request.issued_ns = wall_ns();
    request.kind = static_cast<std::uint32_t>(kind);
    request.lifespan_ms = Intake::kMaxLifespanMs;
    request.lease_ms = Intake::kMaxLeaseMs;
    request.expected_mode = request.expected_run_state = kAny;
    request.system = system;
    request.number = number;
    set_text(&request.text, text);
    const bool given = reader_.get()->commands.push(request);
    wake(&reader_.get()->wake_intake);
    return given;
  }
  // The final answer to a command; an empty one when none comes.
  Ack answer_to(std::uint64_t sequence) {
    Ack ack{};
    for (const auto give_up = later(); std::chrono::steady_clock::now() < give_up;) {
      if (!reader_.get()->acks.pop(&ack)) usleep(500);
      else if (ack.sequence == sequence && ack.state != static_cast<std::uint32_t>(AckState::kAccepted)) return ack;
    }
    return {};
  }
  bool done(RequestKind kind, unsigned system = 0, const std::string& text = "", std::uint32_t number = 0) {
    return send(kind, "hmi", system, text, number) && answer_to(sent_).state == static_cast<std::uint32_t>(AckState::kDone);
  }
  static std::chrono::steady_clock::time_point later() { return std::chrono::steady_clock::now() + std::chrono::seconds(20); }  // only a failure takes so long
  bool comes_to(nc_run_state state) {
    const auto give_up = later();
    while (runtime_->snapshot().system[0].nc.state != state && std::chrono::steady_clock::now() < give_up) usleep(500);
    return runtime_->snapshot().system[0].nc.state == state;
  }
  void run_program() {
    write_program("long.nc", "G1 X50. F60.\nM30\n");
    ASSERT_TRUE(done(RequestKind::kTakeControl));
    ASSERT_TRUE(done(RequestKind::kSetMode, 0, "", static_cast<std::uint32_t>(rt::Mode::kAuto)));
    ASSERT_TRUE(done(RequestKind::kSelectProgram, 0, "long.nc"));
    ASSERT_TRUE(done(RequestKind::kCycleStart, kEverySystem));
    ASSERT_TRUE(comes_to(NC_STATE_RUNNING));
  }
  // The thread that reads programs waits, and with it each command that asks it for something.
  void block_reading() {
    blocks_ = std::thread([this] {
      (void)runtime_->look([this](nc_control*) {
        waits_ = true;
        while (!goes_on_) usleep(1000);
      });
    });
    while (!waits_) usleep(1000);
  }
  void let_go() {
    goes_on_ = true;
    if (blocks_.joinable()) blocks_.join();
  }

  SegmentReader reader_;
  std::uint64_t sent_ = 0;
  std::thread blocks_;
  std::atomic<bool> waits_{false}, goes_on_{false};
};

TEST_F(GatewayCommands, AHoldDoesNotWaitForThoseBeforeIt) {
  run_program();
  block_reading();
  ASSERT_TRUE(send(RequestKind::kMdi, "hmi", 0, "G0 X1."));
  usleep(20000);
  ASSERT_TRUE(send(RequestKind::kFeedHold, "other", kEverySystem));
  EXPECT_TRUE(comes_to(NC_STATE_HOLD));
  let_go();
  EXPECT_EQ(answer_to(sent_).state, static_cast<std::uint32_t>(AckState::kDone));
}

// Whoever sends more commands than have room while one of them takes its time keeps nobody from stopping the machine.
TEST_F(GatewayCommands, AHoldHasRoomBehindAFlood) {
  run_program();
  block_reading();
  ASSERT_TRUE(send(RequestKind::kMdi, "hmi", 0, "G0 X1."));
  const auto give_up = later();
  for (unsigned n = 0; n < 4 * kCommandRing; ++n)
    while (!send(RequestKind::kFeedOverride, "flood") && std::chrono::steady_clock::now() < give_up) usleep(500);
  ASSERT_LT(std::chrono::steady_clock::now(), give_up) << "the ring is emptied";
  ASSERT_TRUE(send(RequestKind::kFeedHold, "other", kEverySystem));
  const std::uint64_t hold = sent_;
  EXPECT_TRUE(comes_to(NC_STATE_HOLD));
  let_go();
  unsigned too_many = 0;
  Ack ack{};
  for (const auto end = later(); std::chrono::steady_clock::now() < end;) {
    if (!reader_.get()->acks.pop(&ack)) usleep(500);
    else if (ack.reason == static_cast<std::uint32_t>(AckReason::kOverflow)) ++too_many;
    else if (ack.sequence == hold && ack.state != static_cast<std::uint32_t>(AckState::kAccepted)) break;
  }
  EXPECT_EQ(ack.sequence, hold);
  EXPECT_EQ(ack.state, static_cast<std::uint32_t>(AckState::kDone)) << text_of(ack.text);
  EXPECT_GE(too_many, 4 * kCommandRing - RequestQueue::kMost) << "each of the others is answered";
}

TEST_F(GatewayCommands, AStartDoesNotOutrunTheHoldBehindIt) {
  run_program();
  ASSERT_TRUE(done(RequestKind::kReset, kEverySystem));
  for (unsigned n = 0; n < 6; ++n) {
    ASSERT_TRUE(send(RequestKind::kCycleStart, "hmi", kEverySystem));
    ASSERT_TRUE(send(RequestKind::kFeedHold, "hmi", kEverySystem));
    ASSERT_EQ(answer_to(sent_).state, static_cast<std::uint32_t>(AckState::kDone));
    EXPECT_NE(runtime_->snapshot().system[0].nc.state, NC_STATE_RUNNING) << n;
    ASSERT_TRUE(done(RequestKind::kReset, kEverySystem));
  }
}

}  // namespace
}  // namespace nc::test
