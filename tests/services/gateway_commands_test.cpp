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
  bool send(RequestKind kind, const char* client = "hmi", unsigned system = 0, const std::string& text = "", std::uint32_t number = 0, double value = 0) {
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
    request.value = value;
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
  while (!send(RequestKind::kFeedHold, "other", kEverySystem) && std::chrono::steady_clock::now() < give_up) usleep(500);  // as the gateway does
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

// A hold acts when it comes, and not once more when what was before it has been executed: the start behind it is not held.
TEST_F(GatewayCommands, AStartBehindAHoldIsNotHeldByIt) {
  run_program();
  block_reading();
  ASSERT_TRUE(send(RequestKind::kMdi, "hmi", 0, "G0 X1."));
  usleep(20000);
  ASSERT_TRUE(send(RequestKind::kFeedHold, "other", kEverySystem));
  const std::uint64_t hold = sent_;
  ASSERT_TRUE(comes_to(NC_STATE_HOLD));
  rt::Command start;  // of the console, which waits for nobody
  start.kind = rt::CommandKind::kCycleStart;
  start.system = rt::kAllSystems;
  std::thread console([&] { EXPECT_EQ(runtime_->execute(start), rt::Answer::kDone); });
  usleep(20000);
  let_go();
  console.join();
  (void)answer_to(hold - 1);  // behind it the hold has its turn
  usleep(50000);
  EXPECT_EQ(runtime_->snapshot().system[0].nc.state, NC_STATE_RUNNING);
  EXPECT_EQ(text_of(answer_to(hold).text), "") << "the axes have stood behind it";
}

// The same with a start of the other way, which may have its turn before the hold: both are done.
TEST_F(GatewayCommands, AHoldIsDoneAlthoughAStartBehindItGoesOn) {
  write_program("long.nc", "G1 X50. F60.\nM30\n");
  ServiceClient local(path_);
  ASSERT_EQ(local.outcome("control.take", {{"lease_ms", 60000}}), "");
  ASSERT_EQ(local.outcome("mode", {{"mode", "auto"}}), "");
  ASSERT_EQ(local.outcome("select", {{"name", "long.nc"}}), "");
  ASSERT_EQ(local.outcome("start"), "");
  block_reading();
  ASSERT_TRUE(local.ask(100, "mdi", {{"blocks", "G0 X1."}}));
  usleep(20000);
  ASSERT_TRUE(send(RequestKind::kFeedHold, "other", kEverySystem));
  ASSERT_TRUE(comes_to(NC_STATE_HOLD));
  ASSERT_TRUE(local.ask(101, "start"));
  usleep(20000);
  let_go();
  EXPECT_EQ(answer_to(sent_).state, static_cast<std::uint32_t>(AckState::kDone));
  EXPECT_EQ(local.receive()["id"], 100);
  EXPECT_EQ(local.receive()["ok"], true);
  EXPECT_TRUE(comes_to(NC_STATE_RUNNING));
}

// A start that waits for its turn while a hold comes, from whomever, is taken back.
TEST_F(GatewayCommands, AStartInFrontOfAHoldIsTakenBack) {
  run_program();
  ASSERT_TRUE(done(RequestKind::kReset, kEverySystem));
  block_reading();
  ASSERT_TRUE(send(RequestKind::kMdi, "hmi", 0, "G0 X1."));
  ASSERT_TRUE(send(RequestKind::kCycleStart, "hmi", kEverySystem));
  const std::uint64_t start = sent_;
  usleep(20000);
  rt::Command hold;  // by another way, which is answered before the start has its turn
  hold.kind = rt::CommandKind::kFeedHold;
  hold.system = rt::kAllSystems;
  EXPECT_EQ(runtime_->execute(hold), rt::Answer::kDone);
  let_go();
  const Ack ack = answer_to(start);
  EXPECT_EQ(ack.state, static_cast<std::uint32_t>(AckState::kRejected));
  EXPECT_EQ(text_of(ack.text), "a feed hold has taken it back");
  EXPECT_EQ(ack.refusal, static_cast<std::uint32_t>(rt::RefusalCause::kFeedHold));
  EXPECT_EQ(runtime_->snapshot().system[0].nc.state, NC_STATE_IDLE);
  ASSERT_TRUE(done(RequestKind::kCycleStart, kEverySystem)) << "the next one is free";
  EXPECT_TRUE(comes_to(NC_STATE_RUNNING));
}

// The same of a jog: nobody's finger moves an axis behind a hold without being lifted.
TEST_F(GatewayCommands, AJogInFrontOfAHoldIsTakenBack) {
  ASSERT_TRUE(done(RequestKind::kTakeControl));
  ASSERT_TRUE(done(RequestKind::kSetMode, 0, "", static_cast<std::uint32_t>(rt::Mode::kManual)));
  block_reading();
  ASSERT_TRUE(send(RequestKind::kMdi, "hmi", 0, "G0 X1."));
  const auto jog = [&](double velocity) { return send(RequestKind::kJog, "hmi", 0, "", 0, velocity); };
  ASSERT_TRUE(jog(20));
  const std::uint64_t first = sent_;
  usleep(20000);
  ASSERT_TRUE(send(RequestKind::kFeedHold, "other", kEverySystem));
  ASSERT_TRUE(jog(20));
  const std::uint64_t second = sent_;
  let_go();
  const Ack taken_back = answer_to(first);  // while the hold itself is still on, its sentence is that of a feed hold that is on
  EXPECT_EQ(taken_back.state, static_cast<std::uint32_t>(AckState::kRejected));
  EXPECT_EQ(taken_back.refusal, static_cast<std::uint32_t>(rt::RefusalCause::kFeedHold));
  EXPECT_EQ(answer_to(second).state, static_cast<std::uint32_t>(AckState::kRejected)) << "the button is on since before the hold";
  EXPECT_EQ(runtime_->snapshot().system[0].nc.command.v[0], 0);
  ASSERT_TRUE(jog(0));
  ASSERT_EQ(answer_to(sent_).state, static_cast<std::uint32_t>(AckState::kDone));
  ASSERT_TRUE(jog(20));
  EXPECT_EQ(answer_to(sent_).state, static_cast<std::uint32_t>(AckState::kDone));
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
