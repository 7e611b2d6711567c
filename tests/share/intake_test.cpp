// SPDX-License-Identifier: Apache-2.0
// The rules of the command intake, one by one.
#include "runtime/share/intake.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "nc/run.h"
#include "runtime/share/text.hpp"

namespace nc::rt::share {
namespace {

constexpr std::int64_t kMs = 1'000'000;

struct FakeMachine final : Machine {
  State now;
  Answer answer = Answer::kDone;
  std::vector<Command> executed;
  std::vector<std::string> mdi, selected, forced, released;
  std::vector<nc::rt::RestartWish> places;
  std::string why, alarm_text;
  std::vector<unsigned> held;  // at once
  std::vector<std::uint64_t> awaited;  // holds, at their turns
  std::uint64_t hold_at_once(unsigned system) override {
    held.push_back(system);
    return held.size();
  }
  Answer await_hold(std::uint64_t number, unsigned) override {
    awaited.push_back(number);
    return answer;
  }
  std::uint64_t stood = 0;  // the last hold behind which the axes have been at rest
  bool has_stood(std::uint64_t number, unsigned) override { return number <= stood; }
  std::uint64_t holds() override { return held.size(); }
  std::uint32_t held_since(std::uint64_t count) override {
    std::uint32_t systems = 0;
    for (std::size_t n = count; n < held.size(); ++n) systems |= held[n] == kAllSystems ? 3u : 1u << held[n];
    return systems;
  }
  FakeMachine() {
    now.axis_count[0] = 3;
    now.program[0] = "part.nc";
  }
  State state() override { return now; }
  Answer execute(const Command& command) override {
    executed.push_back(command);
    return answer;
  }
  Answer load_mdi(unsigned, const std::string& blocks) override {
    mdi.push_back(blocks);
    return answer;
  }
  Answer select_program(unsigned, const std::string& file) override {
    selected.push_back(file);
    return answer;
  }
  Answer write_device(const std::string& device, std::int64_t value) override { return force(device + ".once", value); }
  Answer force(const std::string& device, std::int64_t value) override {
    forced.push_back(device + "=" + std::to_string(value));
    return answer;
  }
  Answer find_restart(unsigned, const nc::rt::RestartWish& wish) override {
    places.push_back(wish);
    return answer;
  }
  Answer release(const std::string& device) override {
    released.push_back(device);
    return answer;
  }
  std::string alarm() override { return alarm_text; }
  std::string explain(Answer given) override { return why.empty() ? answer_text(given) : why; }
  std::size_t total() const {
    return executed.size() + mdi.size() + selected.size() + forced.size() + released.size();
  }
};

class IntakeRules : public testing::Test {
 protected:
  Request request(RequestKind kind, std::uint64_t sequence, const char* client = "hmi") {
    Request r{};
    set_text(&r.client, client);
    r.sequence = sequence;
    r.writer = std::string(client) == "hmi" ? 1 : 2;
    r.issued_ns = now_;
    r.kind = static_cast<std::uint32_t>(kind);
    r.lifespan_ms = 1000;
    r.expected_mode = r.expected_run_state = kAny;
    return r;
  }
  Ack give(const Request& r) {
    acks_.clear();
    intake_.take(r, now_, &acks_);
    return acks_.empty() ? Ack{} : acks_.back();
  }
  Ack give(RequestKind kind, std::uint64_t sequence, const char* client = "hmi") {
    return give(request(kind, sequence, client));
  }
  void take_control() { ASSERT_EQ(give(RequestKind::kTakeControl, 1).state, state(AckState::kDone)); }
  static std::uint32_t state(AckState s) { return static_cast<std::uint32_t>(s); }
  static std::uint32_t reason(AckReason r) { return static_cast<std::uint32_t>(r); }
  void expect_rejected(const Ack& ack, AckReason why) {
    EXPECT_EQ(ack.state, state(AckState::kRejected));
    EXPECT_EQ(ack.reason, reason(why)) << text_of(ack.text);
    EXPECT_FALSE(text_of(ack.text).empty());
  }

  FakeMachine machine_;
  Intake intake_{&machine_};
  std::int64_t now_ = 1'000'000 * kMs;
  std::vector<Ack> acks_;
};

// "Other" is for a control of a later release: every reason of this one has its own number, in the answer as in the status.
TEST_F(IntakeRules, EveryReasonOfTheRuntimeIsNamedInTheAnswer) {
  take_control();
  std::uint64_t sequence = 1;
  for (unsigned n = 0; n < kAnswers; ++n) {
    const auto why = static_cast<Answer>(n);
    SCOPED_TRACE(answer_text(why));
    ASSERT_STRNE(answer_text(why), "?");
    const RefusalCause cause = refusal_cause(why);
    EXPECT_NE(cause, RefusalCause::kOther);
    EXPECT_LE(cause, RefusalCause::kLast);
    EXPECT_EQ(cause == RefusalCause::kNone, why == Answer::kDone);
    EXPECT_EQ(refusal_cause(Refusal{1, Asked::kCycleStart, why}), cause);
    machine_.answer = why;
    const std::pair<RequestKind, const char*> kinds[] = {{RequestKind::kSingleBlock, ""}, {RequestKind::kMdi, "G0 X1."}, {RequestKind::kSelectProgram, "part.nc"}};
    for (const auto& [kind, text] : kinds) {
      Request r = request(kind, ++sequence);
      set_text(&r.text, text);
      const Ack ack = give(r);
      EXPECT_EQ(ack.reason, reason(why == Answer::kDone ? AckReason::kNone : AckReason::kRefused)) << text;
      EXPECT_EQ(ack.refusal, static_cast<std::uint32_t>(cause)) << text;
    }
  }
  EXPECT_EQ(refusal_cause(Answer::kFeedHold), RefusalCause::kFeedHold);
  EXPECT_EQ(refusal_cause(Answer::kInterlock), RefusalCause::kInterlock);
  EXPECT_EQ(refusal_cause(Answer::kAlarmActive), RefusalCause::kAlarm) << "an emergency stop is one of the ladder";
  EXPECT_EQ(refusal_cause(Answer::kResetHeld), RefusalCause::kResetHeld);
}

TEST_F(IntakeRules, NothingActsWithoutControlButAHold) {
  expect_rejected(give(RequestKind::kCycleStart, 1), AckReason::kNoControl);
  EXPECT_EQ(machine_.total(), 0u);
  EXPECT_EQ(give(RequestKind::kFeedHold, 2).state, state(AckState::kAccepted));
  ASSERT_EQ(machine_.executed.size(), 1u);
  EXPECT_EQ(machine_.executed[0].kind, CommandKind::kFeedHold);
}

TEST_F(IntakeRules, ControlBelongsToOne) {
  take_control();
  expect_rejected(give(RequestKind::kTakeControl, 1, "other"), AckReason::kNoControl);
  expect_rejected(give(RequestKind::kCycleStart, 2, "other"), AckReason::kNoControl);
  expect_rejected(give(RequestKind::kReleaseControl, 3, "other"), AckReason::kNoControl);
  EXPECT_EQ(give(RequestKind::kReleaseControl, 2).state, state(AckState::kDone));
  EXPECT_EQ(give(RequestKind::kTakeControl, 4, "other").state, state(AckState::kDone));
  EXPECT_EQ(intake_.controlling(), "other");
}

TEST_F(IntakeRules, ControlEndsWithItsLease) {
  Request r = request(RequestKind::kTakeControl, 1);
  r.lease_ms = 500;
  give(r);
  now_ += 400 * kMs;
  give(RequestKind::kSingleBlock, 2);  // any command renews it
  now_ += 400 * kMs;
  acks_.clear();
  intake_.tick(now_, &acks_);
  EXPECT_EQ(intake_.controlling(), "hmi");
  now_ += 200 * kMs;
  intake_.tick(now_, &acks_);
  EXPECT_EQ(intake_.controlling(), "");
  expect_rejected(give(RequestKind::kCycleStart, 3), AckReason::kNoControl);
}

// The time of day is set back by an hour, and forward again: that must neither keep a silent client in control nor end the lease of an
// active one.
TEST_F(IntakeRules, ALeaseDoesNotFollowTheTimeOfDay) {
  Request r = request(RequestKind::kTakeControl, 1);
  r.lease_ms = 500;
  give(r);
  const std::int64_t hour = 3'600'000 * kMs;
  intake_.tick({now_ + hour, now_ + 400 * kMs}, &acks_);
  EXPECT_EQ(intake_.controlling(), "hmi");
  intake_.tick({now_ - hour, now_ + 600 * kMs}, &acks_);
  EXPECT_EQ(intake_.controlling(), "");
  r.sequence = 2;
  r.issued_ns = now_ - hour;
  intake_.take(r, {now_ - hour, now_ + 700 * kMs}, &acks_);
  EXPECT_EQ(acks_.back().state, state(AckState::kDone)) << "its age is a matter of the time of day";
  EXPECT_EQ(acks_.back().time_ns, now_ - hour);
}

TEST_F(IntakeRules, ControlEndsWithItsClient) {
  take_control();
  machine_.now.mode = Mode::kManual;
  Request jog = request(RequestKind::kJog, 2);
  jog.axis = 1;
  jog.value = 20;
  EXPECT_EQ(give(jog).state, state(AckState::kDone));
  Request gone{};
  gone.kind = static_cast<std::uint32_t>(RequestKind::kClientGone);
  gone.writer = 99;
  give(gone);
  EXPECT_EQ(intake_.controlling(), "hmi") << "somebody else";
  gone.writer = 1;
  give(gone);
  EXPECT_EQ(intake_.controlling(), "");
  ASSERT_EQ(machine_.executed.size(), 2u) << "its jog is stopped";
  EXPECT_EQ(machine_.executed[1].kind, CommandKind::kJog);
  EXPECT_EQ(machine_.executed[1].axis, 1);
  EXPECT_EQ(machine_.executed[1].value, 0);
  EXPECT_EQ(give(RequestKind::kTakeControl, 1).state, state(AckState::kDone)) << "it may begin again with 1";
}

TEST_F(IntakeRules, NewGatewayEndsEverything) {
  take_control();
  Request began{};
  began.kind = static_cast<std::uint32_t>(RequestKind::kGatewayBegan);
  give(began);
  EXPECT_EQ(intake_.controlling(), "");
  EXPECT_TRUE(acks_.empty());
}

TEST_F(IntakeRules, DuplicateGetsTheSameAnswerAndIsNotExecuted) {
  take_control();
  const Request start = request(RequestKind::kCycleStart, 2);
  const Ack first = give(start);
  EXPECT_EQ(first.state, state(AckState::kAccepted));
  for (int i = 0; i < 3; ++i) {
    const Ack again = give(start);
    EXPECT_EQ(again.state, first.state);
    EXPECT_EQ(again.repeated, 1u);
  }
  EXPECT_EQ(machine_.executed.size(), 1u);
  machine_.now.run_state[0] = NC_STATE_RUNNING;
  acks_.clear();
  intake_.tick(now_, &acks_);
  ASSERT_EQ(acks_.size(), 1u);
  EXPECT_EQ(acks_[0].state, state(AckState::kDone));
  EXPECT_EQ(give(start).state, state(AckState::kDone)) << "from now on the duplicate gets the later answer";
  EXPECT_EQ(machine_.executed.size(), 1u);
}

TEST_F(IntakeRules, OutOfOrderIsRejected) {
  take_control();
  give(RequestKind::kReset, 10);
  expect_rejected(give(RequestKind::kCycleStart, 5), AckReason::kOutOfOrder);
  expect_rejected(give(RequestKind::kCycleStart, 0), AckReason::kMalformed);
  EXPECT_EQ(machine_.executed.size(), 1u);
  EXPECT_EQ(give(RequestKind::kCycleStart, 11).state, state(AckState::kAccepted));
}

TEST_F(IntakeRules, LateIsRejected) {
  take_control();
  Request r = request(RequestKind::kCycleStart, 2);
  r.lifespan_ms = 100;
  now_ += 101 * kMs;
  expect_rejected(give(r), AckReason::kLate);
  r = request(RequestKind::kCycleStart, 3);
  r.issued_ns = now_ + 10'000 * kMs;
  expect_rejected(give(r), AckReason::kLate);
  r = request(RequestKind::kCycleStart, 4);
  r.issued_ns = std::numeric_limits<std::int64_t>::min();
  expect_rejected(give(r), AckReason::kLate);
  r = request(RequestKind::kCycleStart, 5);
  r.issued_ns = std::numeric_limits<std::int64_t>::max();
  expect_rejected(give(r), AckReason::kLate);
  EXPECT_EQ(machine_.total(), 0u);
  expect_rejected(give(r), AckReason::kLate);
  EXPECT_EQ(acks_.back().repeated, 1u) << "a rejection is remembered, too";
}

TEST_F(IntakeRules, ExpectedStateIsHeldAgainstTheMachine) {
  take_control();
  Request r = request(RequestKind::kCycleStart, 2);
  r.expected_mode = static_cast<std::int32_t>(Mode::kMdi);
  expect_rejected(give(r), AckReason::kExpectedState);
  r = request(RequestKind::kCycleStart, 3);
  r.expected_run_state = NC_STATE_HOLD;
  expect_rejected(give(r), AckReason::kExpectedState);
  r = request(RequestKind::kCycleStart, 4);
  set_text(&r.expected_program, "old.nc");
  expect_rejected(give(r), AckReason::kExpectedState);
  EXPECT_EQ(machine_.total(), 0u);
  r = request(RequestKind::kCycleStart, 5);
  r.expected_mode = static_cast<std::int32_t>(Mode::kAuto);
  r.expected_run_state = NC_STATE_IDLE;
  set_text(&r.expected_program, "part.nc");
  EXPECT_EQ(give(r).state, state(AckState::kAccepted));
}

// Files may have names of 255 bytes. The status shows as many whole characters as it has room for, and a client may expect that name.
TEST_F(IntakeRules, ALongNameIsExpectedAsStatusShowsIt) {
  take_control();
  std::string name;
  for (unsigned n = 0; n < 84; ++n) name += "ab\u00e4";
  machine_.now.program[0] = name + ".nc";
  SystemStatus status{};
  set_text(&status.program, machine_.now.program[0]);
  ASSERT_EQ(text_of(status.program).size(), 126u) << "not 127, the middle of a character";
  Request r = request(RequestKind::kCycleStart, 2);
  set_text(&r.expected_program, text_of(status.program));
  EXPECT_EQ(give(r).state, state(AckState::kAccepted));
  r = request(RequestKind::kCycleStart, 3);
  set_text(&r.expected_program, text_of(status.program).substr(0, 120));
  expect_rejected(give(r), AckReason::kExpectedState);
}

TEST_F(IntakeRules, MalformedIsRejected) {
  take_control();
  std::uint64_t sequence = 2;
  const auto rejected = [&](Request r, auto change, AckReason why = AckReason::kMalformed) {
    r.sequence = sequence++;
    change(&r);
    expect_rejected(give(r), why);
  };
  const Request start = request(RequestKind::kCycleStart, 1), feed = request(RequestKind::kFeedOverride, 1),
                jog = request(RequestKind::kJog, 1), mdi = request(RequestKind::kMdi, 1),
                select = request(RequestKind::kSelectProgram, 1);
  rejected(start, [](Request* r) { r->kind = 4711; }, AckReason::kUnknownKind);
  rejected(start, [](Request* r) { r->kind = static_cast<std::uint32_t>(RequestKind::kCount); }, AckReason::kUnknownKind);
  rejected(start, [](Request* r) { r->lifespan_ms = 0; });
  rejected(start, [](Request* r) { r->lifespan_ms = ~0u; });
  rejected(start, [](Request* r) { r->lease_ms = 1; });
  rejected(start, [](Request* r) { r->system = 1; });
  rejected(start, [](Request* r) { r->system = kEverySystem - 1; });
  rejected(start, [](Request* r) { r->expected_mode = 3; });
  rejected(start, [](Request* r) { r->expected_run_state = -2; });
  rejected(start, [](Request* r) { r->value = std::nan(""); });
  rejected(start, [](Request* r) { r->text.fill('G'); });
  rejected(feed, [](Request* r) { r->value = 2.01; });
  rejected(feed, [](Request* r) { r->value = -0.01; });
  rejected(feed, [](Request* r) { r->value = std::numeric_limits<double>::infinity(); });
  rejected(request(RequestKind::kRapidOverride, 1), [](Request* r) { r->value = 1.01; });
  rejected(request(RequestKind::kSetMode, 1), [](Request* r) { r->number = 3; });
  rejected(request(RequestKind::kSingleBlock, 1), [](Request* r) { r->number = 2; });
  rejected(jog, [](Request* r) { r->axis = 3; });
  rejected(jog, [](Request* r) { r->value = 1e9; });
  rejected(mdi, [](Request*) {});
  rejected(mdi, [](Request* r) { set_text(&r->text, "G0 X1\x1b[2J"); });
  for (const char* name : {"", "../part.nc", "/etc/passwd", ".hidden", "a\nb"})
    rejected(select, [&](Request* r) { set_text(&r->text, name); });
  EXPECT_EQ(machine_.total(), 0u);
}

TEST_F(IntakeRules, WithoutANameThereIsNoAnswer) {
  Request r = request(RequestKind::kTakeControl, 1, "");
  give(r);
  EXPECT_TRUE(acks_.empty());
  r.client.fill('x');  // not ended
  give(r);
  EXPECT_TRUE(acks_.empty());
  set_text(&r.client, "two words");
  give(r);
  EXPECT_TRUE(acks_.empty());
  EXPECT_EQ(intake_.controlling(), "");
}

TEST_F(IntakeRules, ClientIdBelongsToItsParticipant) {
  take_control();
  Request thief = request(RequestKind::kCycleStart, 2);
  thief.writer = 77;
  expect_rejected(give(thief), AckReason::kClientInUse);
  EXPECT_EQ(machine_.total(), 0u);
}

// What a hold asks for is given to the machine when it comes, when nothing is wrong with it; at its turn it is not late any more, and only waited for.
TEST_F(IntakeRules, AHoldIsGivenToTheMachineWhenItComes) {
  Request r = request(RequestKind::kFeedHold, 1, "other");
  const Arrival arrival = intake_.arrived(r, now_);
  EXPECT_EQ(arrival.hold, 1u);
  EXPECT_EQ(machine_.held, std::vector<unsigned>{0});
  EXPECT_EQ(machine_.total(), 0u);
  now_ += 5000 * kMs;
  acks_.clear();
  intake_.take(r, now_, &acks_, Way::kLocal, arrival);
  EXPECT_EQ(acks_.back().state, state(AckState::kAccepted)) << text_of(acks_.back().text);
  EXPECT_EQ(machine_.awaited, std::vector<std::uint64_t>{1});
  EXPECT_EQ(machine_.total(), 0u) << "a hold that has acted does not act once more";
  r = request(RequestKind::kFeedHold, 2);
  r.system = kEverySystem;
  EXPECT_NE(intake_.arrived(r, now_).hold, 0u);
  EXPECT_EQ(machine_.held.back(), unsigned{kAllSystems});
  const std::size_t before = machine_.held.size();
  EXPECT_EQ(intake_.arrived(request(RequestKind::kReset, 3), now_).hold, 0u) << "no hold";
  r = request(RequestKind::kFeedHold, 4);
  r.issued_ns = now_ - 1001 * kMs;
  EXPECT_EQ(intake_.arrived(r, now_).hold, 0u) << "late";
  r = request(RequestKind::kFeedHold, 5);
  r.system = 7;
  EXPECT_EQ(intake_.arrived(r, now_).hold, 0u) << "malformed";
  r = request(RequestKind::kFeedHold, 6);
  r.expected_mode = static_cast<std::int32_t>(Mode::kMdi);
  EXPECT_EQ(intake_.arrived(r, now_).hold, 0u) << "another mode is expected";
  EXPECT_EQ(intake_.arrived(request(RequestKind::kFeedHold, 7, ""), now_).hold, 0u) << "from nobody";
  EXPECT_EQ(machine_.held.size(), before);
}

// What moves something carries how many holds there were when it came, so that the machine can take it back.
TEST_F(IntakeRules, WhatMovesIsGivenWithTheHoldsOfItsArrival) {
  take_control();
  std::uint64_t sequence = 1;
  for (const RequestKind kind : {RequestKind::kCycleStart, RequestKind::kJog, RequestKind::kRestartApproach}) {
    Request r = request(kind, ++sequence);
    r.value = 1;
    const Arrival arrival = intake_.arrived(r, now_);
    (void)intake_.arrived(request(RequestKind::kFeedHold, 1, "other"), now_);
    acks_.clear();
    intake_.take(r, now_, &acks_, Way::kGateway, arrival);
    ASSERT_FALSE(machine_.executed.empty());
    EXPECT_EQ(machine_.executed.back().holds, machine_.holds() - 1);
    EXPECT_EQ(give(request(RequestKind::kCycleStart, ++sequence)).reason, reason(AckReason::kNone));
    EXPECT_EQ(machine_.executed.back().holds, machine_.holds()) << "it comes now";
  }
}

// A start that was accepted and has not begun, or stands already, when a hold comes behind it.
TEST_F(IntakeRules, AStartThatIsHeldIsAnsweredAtOnce) {
  take_control();
  ASSERT_EQ(give(RequestKind::kCycleStart, 2).state, state(AckState::kAccepted));
  acks_.clear();
  intake_.tick(now_, &acks_);
  EXPECT_TRUE(acks_.empty());
  (void)intake_.arrived(request(RequestKind::kFeedHold, 1, "other"), now_);
  intake_.tick(now_, &acks_);
  ASSERT_EQ(acks_.size(), 1u);
  EXPECT_EQ(acks_[0].state, state(AckState::kFailed));
  EXPECT_EQ(acks_[0].refusal, static_cast<std::uint32_t>(RefusalCause::kFeedHold));
}

// A hold is done when nothing moves any more by what was asked for before it, also where a start behind it has been executed before the hold had its turn.
TEST_F(IntakeRules, AHoldIsDoneWhereAStartBehindItGoesOn) {
  take_control();
  machine_.now.run_state[0] = NC_STATE_RUNNING;
  const Request hold = request(RequestKind::kFeedHold, 1, "other");
  const Arrival arrival = intake_.arrived(hold, now_);
  Request start = request(RequestKind::kCycleStart, 2);
  acks_.clear();
  intake_.take(start, now_, &acks_, Way::kGateway, intake_.arrived(start, now_));
  intake_.take(hold, now_, &acks_, Way::kGateway, arrival);
  acks_.clear();
  intake_.tick(now_, &acks_);
  bool done = false;
  for (const Ack& ack : acks_) done |= text_of(ack.client) == "other" && ack.state == state(AckState::kDone);
  EXPECT_TRUE(done);
  const Request next = request(RequestKind::kFeedHold, 2, "other");
  intake_.take(next, now_, &acks_, Way::kGateway, intake_.arrived(next, now_));
  acks_.clear();
  intake_.tick(now_, &acks_);
  EXPECT_TRUE(acks_.empty()) << "that start was before this hold";
}

// The same where somebody else has started it, by the panel or the console, of which the intake knows nothing: the axes have stood.
TEST_F(IntakeRules, AHoldIsDoneWhereTheAxesHaveStoodBehindIt) {
  machine_.now.run_state[0] = NC_STATE_RUNNING;
  const Request hold = request(RequestKind::kFeedHold, 1, "other");
  const Arrival arrival = intake_.arrived(hold, now_);
  intake_.take(hold, now_, &acks_, Way::kGateway, arrival);
  acks_.clear();
  intake_.tick(now_, &acks_);
  EXPECT_TRUE(acks_.empty()) << "on its way to rest";
  machine_.stood = arrival.hold;
  intake_.tick(now_, &acks_);
  ASSERT_EQ(acks_.size(), 1u);
  EXPECT_EQ(acks_[0].state, state(AckState::kDone));
}

TEST_F(IntakeRules, AHoldIsTakenUnderANameInUse) {
  give(RequestKind::kFeedHold, 1);
  Request other = request(RequestKind::kFeedHold, 1);
  other.writer = 77;
  const Ack ack = give(other);
  EXPECT_EQ(ack.state, state(AckState::kAccepted)) << text_of(ack.text);
  EXPECT_EQ(ack.writer, 77u);
  EXPECT_EQ(ack.repeated, 0u);
  EXPECT_EQ(machine_.executed.size(), 2u);
  other.sequence = 0;
  EXPECT_EQ(give(other).state, state(AckState::kRejected)) << "its form is checked all the same";
}

// Clients of the gateway of whom something was executed, as many as find a place: it may not be executed again, so they keep their places for a while.
TEST_F(IntakeRules, AHoldNeedsNoPlace) {
  const auto numbered = [&](RequestKind kind, std::uint64_t sequence, unsigned i) {
    Request r = request(kind, sequence, ("c" + std::to_string(i)).c_str());
    r.writer = 100 + i;
    return r;
  };
  for (unsigned i = 0; i < Intake::kClients; ++i) {
    give(numbered(RequestKind::kTakeControl, 1, i));
    give(numbered(RequestKind::kReleaseControl, 2, i));
  }
  expect_rejected(give(numbered(RequestKind::kTakeControl, 1, 99)), AckReason::kTooManyClients);
  for (unsigned i = 90; i < 99; ++i) EXPECT_EQ(give(numbered(RequestKind::kFeedHold, 1, i)).state, state(AckState::kAccepted)) << i;
  EXPECT_EQ(machine_.executed.size(), 9u);
  // The local way has places that the gateway does not get: a reset from there finds one.
  acks_.clear();
  intake_.take(request(RequestKind::kTakeControl, 1, "local"), now_, &acks_, Way::kLocal);
  intake_.take(request(RequestKind::kReset, 2, "local"), now_, &acks_, Way::kLocal);
  ASSERT_EQ(acks_.size(), 2u);
  EXPECT_EQ(acks_[0].state, state(AckState::kDone));
  EXPECT_EQ(acks_[1].state, state(AckState::kAccepted));
  now_ += Intake::kForgetNs + kMs;
  intake_.tick(now_, &acks_);
  EXPECT_EQ(give(numbered(RequestKind::kTakeControl, 1, 99)).state, state(AckState::kDone)) << "the silent are forgotten";
}

TEST_F(IntakeRules, RefusedCommandsKeepNoPlace) {
  for (unsigned i = 0; i < 3 * Intake::kClients; ++i) expect_rejected(give(RequestKind::kReset, 1, ("c" + std::to_string(i)).c_str()), AckReason::kNoControl);
  EXPECT_EQ(give(RequestKind::kTakeControl, 1, "one-more").state, state(AckState::kDone));
}

TEST_F(IntakeRules, LocalClientsGiveUpTheirPlacesButNotControl) {
  const auto local = [&](RequestKind kind, std::uint64_t sequence, unsigned i) {
    Request r = request(kind, sequence, ("local" + std::to_string(i)).c_str());
    r.writer = i;
    acks_.clear();
    intake_.take(r, now_, &acks_, Way::kLocal);
    return acks_.at(0);
  };
  EXPECT_EQ(local(RequestKind::kTakeControl, 1, 1000).state, state(AckState::kDone));
  for (unsigned i = 0; i < 3 * Intake::kClients; ++i) {
    expect_rejected(local(RequestKind::kReset, 1, i), AckReason::kNoControl);
    EXPECT_NE(local(RequestKind::kFeedHold, 2, i).state, state(AckState::kRejected));
  }
  EXPECT_EQ(intake_.controlling(), "local1000");
  EXPECT_NE(local(RequestKind::kReset, 2, 1000).state, state(AckState::kRejected));
  EXPECT_EQ(local(RequestKind::kReleaseControl, 3, 1000).state, state(AckState::kDone));
  EXPECT_EQ(local(RequestKind::kTakeControl, 3, 0).state, state(AckState::kDone)) << "who has lost his place goes on";
}

TEST_F(IntakeRules, AParticipantHasSomeOfThePlaces) {
  const auto both = [&](const char* name, std::uint64_t writer) {
    Request take = request(RequestKind::kTakeControl, 1, name), release = request(RequestKind::kReleaseControl, 2, name);
    take.writer = release.writer = writer;
    const Ack ack = give(take);
    give(release);
    return ack;
  };
  for (unsigned i = 0; i < Intake::kPerWriter; ++i) EXPECT_EQ(both(("c" + std::to_string(i)).c_str(), 5).state, state(AckState::kDone)) << i;
  expect_rejected(both("too-many", 5), AckReason::kTooManyClients);
  EXPECT_EQ(both("another", 6).state, state(AckState::kDone));
}

// Part system 0 of the IDL means all of them, as the buttons of a panel do. A command for only one of them must name it.
TEST_F(IntakeRules, ACommandNamesAPartSystemOrAllOfThem) {
  machine_.now.system_count = 2;
  machine_.now.axis_count = {3, 3};
  take_control();
  std::uint64_t sequence = 1;
  const auto ask = [&](RequestKind kind, std::uint32_t system) {
    Request r = request(kind, ++sequence);
    r.system = system;
    set_text(&r.text, "part.nc");
    return give(r);
  };
  for (const RequestKind kind : {RequestKind::kCycleStart, RequestKind::kFeedHold, RequestKind::kReset, RequestKind::kSetMode, RequestKind::kFeedOverride,
                                 RequestKind::kRapidOverride, RequestKind::kSingleBlock, RequestKind::kOptionalStop}) {
    SCOPED_TRACE(static_cast<unsigned>(kind));
    EXPECT_NE(ask(kind, 1).state, state(AckState::kRejected));
    EXPECT_EQ(machine_.executed.back().system, 1);
    EXPECT_NE(ask(kind, kEverySystem).state, state(AckState::kRejected));
    EXPECT_EQ(machine_.executed.back().system, kAllSystems);
    expect_rejected(ask(kind, 2), AckReason::kMalformed);
  }
  for (const RequestKind kind : {RequestKind::kJog, RequestKind::kMdi, RequestKind::kSelectProgram}) expect_rejected(ask(kind, kEverySystem), AckReason::kMalformed);
}

// A command for the whole control says so if a client names one part system.
TEST_F(IntakeRules, ModeAndResetSayThatTheyAreOfAll) {
  machine_.now.system_count = 2;
  take_control();
  for (const RequestKind kind : {RequestKind::kReset, RequestKind::kSetMode}) {
    Request r = request(kind, kind == RequestKind::kReset ? 2 : 3);
    r.system = 1;
    const Ack taken = give(r);
    EXPECT_EQ(taken.state, state(AckState::kAccepted));
    EXPECT_EQ(text_of(taken.text), "of all part systems");
    acks_.clear();
    intake_.tick(now_, &acks_);
    ASSERT_EQ(acks_.size(), 1u);
    EXPECT_EQ(acks_[0].state, state(AckState::kDone));
    EXPECT_EQ(text_of(acks_[0].text), "of all part systems");
  }
  Request all = request(RequestKind::kReset, 4);
  all.system = kEverySystem;
  EXPECT_EQ(text_of(give(all).text), "") << "that is what was asked for";
}

// The answer to a start, a hold or a reset is about the part systems that were named.
TEST_F(IntakeRules, TheStateIsThatOfThePartSystemsThatAreNamed) {
  machine_.now.system_count = 2;
  take_control();
  std::uint64_t sequence = 1;
  const auto outcome = [&](RequestKind kind, std::uint32_t system, std::uint8_t first, std::uint8_t second, std::uint64_t second_runs) {
    machine_.now.run_state = {NC_STATE_IDLE, NC_STATE_IDLE};
    machine_.now.runs = {};
    Request r = request(kind, ++sequence);
    r.system = system;
    EXPECT_EQ(give(r).state, state(AckState::kAccepted));
    machine_.now.run_state = {first, second};
    machine_.now.runs[1] = second_runs;
    acks_.clear();
    intake_.tick(now_, &acks_);
    const bool reached = !acks_.empty() && acks_[0].state == state(AckState::kDone);
    now_ += Intake::kReachNs + kMs;  // a state that was not reached in time is given up
    intake_.tick(now_, &acks_);
    (void)give(RequestKind::kTakeControl, ++sequence);
    return reached;
  };
  EXPECT_TRUE(outcome(RequestKind::kCycleStart, 1, NC_STATE_IDLE, NC_STATE_RUNNING, 0));
  EXPECT_TRUE(outcome(RequestKind::kCycleStart, 1, NC_STATE_IDLE, NC_STATE_IDLE, 1)) << "at its end already";
  EXPECT_FALSE(outcome(RequestKind::kCycleStart, 1, NC_STATE_RUNNING, NC_STATE_IDLE, 0));
  EXPECT_FALSE(outcome(RequestKind::kCycleStart, 0, NC_STATE_IDLE, NC_STATE_IDLE, 1));
  EXPECT_TRUE(outcome(RequestKind::kCycleStart, kEverySystem, NC_STATE_IDLE, NC_STATE_RUNNING, 0)) << "the one that has a program";
  EXPECT_TRUE(outcome(RequestKind::kFeedHold, 1, NC_STATE_RUNNING, NC_STATE_HOLD, 0));
  EXPECT_FALSE(outcome(RequestKind::kFeedHold, kEverySystem, NC_STATE_RUNNING, NC_STATE_HOLD, 0));
  EXPECT_TRUE(outcome(RequestKind::kFeedHold, kEverySystem, NC_STATE_HOLD, NC_STATE_HOLD, 0));
  EXPECT_FALSE(outcome(RequestKind::kReset, 1, NC_STATE_HOLD, NC_STATE_IDLE, 0)) << "a reset is of all";
  EXPECT_TRUE(outcome(RequestKind::kReset, 1, NC_STATE_IDLE, NC_STATE_IDLE, 0));
}

// A reset whose cause is still there is answered when it is done, with the alarm: an operator who presses it with the door open is not left without a word until it is too late.
TEST_F(IntakeRules, AResetThatLeavesAnAlarmSaysSoAtOnce) {
  take_control();
  machine_.now.run_state[0] = NC_STATE_ALARM;
  machine_.now.alarmed = true;
  machine_.alarm_text = "R16 Door open";
  EXPECT_EQ(give(RequestKind::kReset, 2).state, state(AckState::kAccepted));
  machine_.now.resetting = true;
  acks_.clear();
  intake_.tick(now_, &acks_);
  EXPECT_TRUE(acks_.empty()) << "the reset goes on";
  machine_.now.resetting = false;
  machine_.now.resets = 1;
  intake_.tick(now_, &acks_);
  ASSERT_EQ(acks_.size(), 1u);
  EXPECT_EQ(acks_[0].state, state(AckState::kFailed));
  EXPECT_EQ(acks_[0].reason, reason(AckReason::kRefused));
  EXPECT_EQ(acks_[0].refusal, static_cast<std::uint32_t>(RefusalCause::kAlarm));
  EXPECT_EQ(text_of(acks_[0].text), "an alarm is there behind the reset: R16 Door open");
  // A button that is held does not keep the answer back, and a reset that leaves nothing is done.
  EXPECT_EQ(give(RequestKind::kReset, 3).state, state(AckState::kAccepted));
  machine_.now.resets = 2;
  machine_.now.resetting = true;  // the one before is done, and this one goes on
  acks_.clear();
  intake_.tick(now_, &acks_);
  EXPECT_TRUE(acks_.empty());
  machine_.now.reset_held = true;
  intake_.tick(now_, &acks_);
  ASSERT_EQ(acks_.size(), 1u);
  EXPECT_EQ(acks_[0].state, state(AckState::kFailed));
  machine_.now.reset_held = false;
  EXPECT_EQ(give(RequestKind::kReset, 4).state, state(AckState::kAccepted));
  machine_.now.resets = 3;
  machine_.now.resetting = machine_.now.alarmed = false;
  machine_.now.run_state[0] = NC_STATE_IDLE;
  acks_.clear();
  intake_.tick(now_, &acks_);
  ASSERT_EQ(acks_.size(), 1u);
  EXPECT_EQ(acks_[0].state, state(AckState::kDone));
}

// Somebody who opens a door when his hold is answered must find the axes at rest: RUN_HOLD begins while they still brake.
TEST_F(IntakeRules, AHoldIsDoneWhenTheAxesOfItsPartSystemStand) {
  machine_.now.system_count = 2;
  machine_.now.run_state = {NC_STATE_RUNNING, NC_STATE_RUNNING};
  machine_.now.moves = {true, true};
  EXPECT_EQ(give(RequestKind::kFeedHold, 1).state, state(AckState::kAccepted));
  acks_.clear();
  machine_.now.run_state[0] = NC_STATE_HOLD;
  intake_.tick(now_, &acks_);
  EXPECT_TRUE(acks_.empty()) << "on its way to rest";
  machine_.now.moves[0] = false;
  intake_.tick(now_, &acks_);
  ASSERT_EQ(acks_.size(), 1u) << "the other one may move";
  EXPECT_EQ(acks_[0].state, state(AckState::kDone));
}

// A state that a client expects of all part systems must be that of each of them.
TEST_F(IntakeRules, AnExpectationOfAllPartSystems) {
  machine_.now.system_count = 2;
  machine_.now.run_state = {NC_STATE_IDLE, NC_STATE_HOLD};
  machine_.now.program = {"part.nc", "other.nc"};
  take_control();
  Request r = request(RequestKind::kSingleBlock, 2);
  r.system = kEverySystem;
  r.expected_run_state = NC_STATE_IDLE;
  expect_rejected(give(r), AckReason::kExpectedState);
  r.sequence = 3;
  r.expected_run_state = kAny;
  set_text(&r.expected_program, "part.nc");
  expect_rejected(give(r), AckReason::kExpectedState);
  machine_.now.program[1] = "part.nc";
  r.sequence = 4;
  EXPECT_EQ(give(r).state, state(AckState::kDone));
}

TEST_F(IntakeRules, RefusalOfTheMachineIsPassedOn) {
  take_control();
  machine_.answer = Answer::kAlarmActive;
  const Ack ack = give(RequestKind::kCycleStart, 2);
  expect_rejected(ack, AckReason::kRefused);
  EXPECT_EQ(text_of(ack.text), answer_text(Answer::kAlarmActive));
}

TEST_F(IntakeRules, TheReasonOfARefusalIsPassedOn) {
  take_control();
  machine_.answer = Answer::kNotLoaded;
  machine_.why = "none.nc: No such file or directory";
  Request r = request(RequestKind::kSelectProgram, 2);
  set_text(&r.text, "none.nc");
  const Ack ack = give(r);
  expect_rejected(ack, AckReason::kRefused);
  EXPECT_EQ(text_of(ack.text), "none.nc: No such file or directory");
}

TEST_F(IntakeRules, ForcesNeedControlANameAndAWholeNumber) {
  Request r = request(RequestKind::kForce, 1);
  set_text(&r.text, "M5");
  r.value = 1;
  expect_rejected(give(r), AckReason::kNoControl);
  ASSERT_EQ(give(RequestKind::kTakeControl, 2).state, state(AckState::kDone));
  std::uint64_t sequence = 3;
  const auto ask = [&](RequestKind kind, const char* device, double value) {
    Request asked = request(kind, sequence++);
    set_text(&asked.text, device);
    asked.value = value;
    return give(asked);
  };
  EXPECT_EQ(ask(RequestKind::kForce, "M5", 1).state, state(AckState::kDone));
  EXPECT_EQ(ask(RequestKind::kForce, "plc.jog_p.X", 4294967295.0).state, state(AckState::kDone));
  EXPECT_EQ(ask(RequestKind::kWriteDevice, "D5", -3).state, state(AckState::kDone));
  EXPECT_EQ(ask(RequestKind::kReleaseForce, "M5", 0).state, state(AckState::kDone));
  EXPECT_EQ(ask(RequestKind::kReleaseForce, "", 0).state, state(AckState::kDone));
  EXPECT_EQ(machine_.forced, (std::vector<std::string>{"M5=1", "plc.jog_p.X=4294967295", "D5.once=-3"}));
  EXPECT_EQ(machine_.released, (std::vector<std::string>{"M5", ""}));
  for (const double value : {0.5, -2147483649.0, 4294967296.0, 1e300, std::nan(""), HUGE_VAL})
    for (const RequestKind kind : {RequestKind::kForce, RequestKind::kWriteDevice}) expect_rejected(ask(kind, "M5", value), AckReason::kMalformed);
  const std::string long_name(65, 'M');
  for (const char* device : {"", "M 5", "M5\n", "M\xc3\xa4", long_name.c_str()})
    for (const RequestKind kind : {RequestKind::kForce, RequestKind::kWriteDevice}) expect_rejected(ask(kind, device, 1), AckReason::kMalformed);
  expect_rejected(ask(RequestKind::kReleaseForce, "M 5", 0), AckReason::kMalformed);
  EXPECT_EQ(machine_.forced.size(), 3u);
}

TEST_F(IntakeRules, CommandsOfARestartAreCheckedBeforeTheMachineGetsThem) {
  take_control();
  std::uint64_t sequence = 1;
  const auto ask = [&](RequestKind kind, std::uint32_t axis, double value, const char* text = "", std::uint32_t system = 0) {
    Request r = request(kind, ++sequence);
    r.axis = axis;
    r.value = value;
    r.system = system;
    set_text(&r.text, text);
    return give(r);
  };
  EXPECT_EQ(ask(RequestKind::kRestartFind, static_cast<std::uint32_t>(RestartBy::kLine), 12, "O9.nc").state, state(AckState::kDone));
  ASSERT_EQ(machine_.places.size(), 1u);
  EXPECT_EQ(machine_.places[0].number, 12u);
  EXPECT_EQ(machine_.places[0].file, "O9.nc");
  for (const double value : {-1.0, 0.5, 1e17, std::nan(""), HUGE_VAL}) expect_rejected(ask(RequestKind::kRestartFind, 0, value), AckReason::kMalformed);
  expect_rejected(ask(RequestKind::kRestartFind, static_cast<std::uint32_t>(RestartBy::kCount), 1), AckReason::kMalformed);
  for (const char* name : {"../O9.nc", ".O9", "O\n9"}) expect_rejected(ask(RequestKind::kRestartFind, 0, 1, name), AckReason::kMalformed);
  for (const RequestKind kind : {RequestKind::kRestartFind, RequestKind::kRestartConfirm, RequestKind::kRestartApproach, RequestKind::kRestartCancel})
    expect_rejected(ask(kind, 0, 1, "", kEverySystem), AckReason::kMalformed);
  expect_rejected(ask(RequestKind::kRestartApproach, 3, 1), AckReason::kMalformed);
  expect_rejected(ask(RequestKind::kRestartApproach, 0, -1), AckReason::kMalformed);
  EXPECT_EQ(machine_.places.size(), 1u);
  EXPECT_EQ(ask(RequestKind::kRestartApproach, 2, 5).state, state(AckState::kDone));
  EXPECT_EQ(machine_.executed.back().kind, CommandKind::kApproach);
}

// As a jog does.
TEST_F(IntakeRules, AReturnToThePathEndsWithControl) {
  take_control();
  Request r = request(RequestKind::kRestartApproach, 2);
  r.axis = 1;
  r.value = 5;
  EXPECT_EQ(give(r).state, state(AckState::kDone));
  EXPECT_EQ(give(request(RequestKind::kReleaseControl, 3)).state, state(AckState::kDone));
  EXPECT_EQ(machine_.executed.back().kind, CommandKind::kJog);
  EXPECT_EQ(machine_.executed.back().axis, 1u);
  EXPECT_EQ(machine_.executed.back().value, 0);
}

TEST_F(IntakeRules, AcceptedBecomesFailedWhenItsStateDoesNotCome) {
  take_control();
  Request r = request(RequestKind::kSetMode, 2);
  r.number = static_cast<std::uint32_t>(Mode::kMdi);
  EXPECT_EQ(give(r).state, state(AckState::kAccepted));
  acks_.clear();
  intake_.tick(now_, &acks_);
  EXPECT_TRUE(acks_.empty());
  now_ += Intake::kReachNs + kMs;
  intake_.tick(now_, &acks_);
  ASSERT_EQ(acks_.size(), 1u);
  EXPECT_EQ(acks_[0].state, state(AckState::kFailed));
  EXPECT_EQ(acks_[0].reason, reason(AckReason::kNotReached));
  EXPECT_EQ(acks_[0].sequence, 2u);
}

TEST_F(IntakeRules, StartThatEndsInAnAlarmFails) {
  take_control();
  give(RequestKind::kCycleStart, 2);
  machine_.now.alarmed = true;
  machine_.now.run_state[0] = NC_STATE_ALARM;
  acks_.clear();
  intake_.tick(now_, &acks_);
  ASSERT_EQ(acks_.size(), 1u);
  EXPECT_EQ(acks_[0].state, state(AckState::kFailed));
}

TEST_F(IntakeRules, TextsAndValuesArriveAsTheyWereSent) {
  take_control();
  Request r = request(RequestKind::kMdi, 2);
  set_text(&r.text, "G0 X1.\nM3 S100");
  EXPECT_EQ(give(r).state, state(AckState::kDone));
  EXPECT_EQ(machine_.mdi.at(0), "G0 X1.\nM3 S100\n");
  r = request(RequestKind::kSelectProgram, 3);
  set_text(&r.text, "part 7 (left).nc");
  give(r);
  EXPECT_EQ(machine_.selected.at(0), "part 7 (left).nc");
  r = request(RequestKind::kFeedOverride, 4);
  r.value = 1.25;
  give(r);
  EXPECT_EQ(machine_.executed.at(0).kind, CommandKind::kFeedOverride);
  EXPECT_EQ(machine_.executed.at(0).value, 1.25);
}

}  // namespace
}  // namespace nc::rt::share
