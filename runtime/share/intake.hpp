// SPDX-License-Identifier: Apache-2.0
// Takes commands that came over a network and decides which of them the machine gets.
//
// The rules, in this order:
//   1  well formed: known kind, numbers finite and in range, texts ended and printable       else malformed
//   2  a (client, sequence) that was answered before gets the same answer; nothing is executed again
//   3  sequence above the last one of this client                                            else out of order
//   4  younger than its lifespan                                                             else late
//   5  from the client that has control; a feed hold is taken from anyone                   else no control
//   6  mode, run state and program are what the client believes                              else expected state
//   7  the runtime agrees                                                                    else refused
// A command is of the part system that it names, or of all (kEverySystem); mode and reset always of all, which their answer says.
// Control is a token: one client has it, from its first kTakeControl until it releases it, is gone, or does
// not send anything for its lease. Whoever loses control loses its jogs: the axes are stopped.
//
// An executed command is answered `accepted` and later `done` (or `failed`) when it asks for a state that comes
// with time (a start, a hold, a reset, a mode), else `done` at once.
//
// One thread. Everything is bounded; nothing here knows DDS or shared memory.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/command.hpp"
#include "runtime/refusal.hpp"
#include "runtime/share/layout.hpp"

namespace nc::rt::share {

// What the runtime is to the intake.
class Machine {
 public:
  struct State {
    Mode mode = Mode::kAuto;
    bool resetting = false, alarmed = false;
    unsigned system_count = 1;
    std::array<unsigned, NC_MAX_SYSTEMS> axis_count{};
    std::array<std::uint8_t, NC_MAX_SYSTEMS> run_state{};  // nc_run_state
    std::array<bool, NC_MAX_SYSTEMS> moves{};              // an axis is commanded to move, whatever the state is called
    std::array<std::string, NC_MAX_SYSTEMS> program;       // file name without folder
    std::array<std::uint64_t, NC_MAX_SYSTEMS> runs{};      // programs that came to their end
    double max_feed_override = 2.0;
  };
  virtual ~Machine() = default;
  virtual State state() = 0;
  virtual Answer execute(const Command& command) = 0;
  virtual Answer load_mdi(unsigned system, const std::string& blocks) = 0;
  virtual Answer select_program(unsigned system, const std::string& file) = 0;
  // Devices of the ladder; "" releases all of them.
  virtual Answer force(const std::string& device, std::int64_t value) = 0;
  virtual Answer release(const std::string& device) = 0;
  // What the last answer means, with the reason where one is known.
  virtual std::string explain(Answer answer) { return answer_text(answer); }
};

// Time of day, by which a command is late or not, and a clock that nobody sets, by which a lease ends: a control that
// gets its time from a server while a client is silent must not keep an axis or a token for it.
struct Now {
  Now(std::int64_t both) : wall_ns(both), steady_ns(both) {}
  Now(std::int64_t wall, std::int64_t steady) : wall_ns(wall), steady_ns(steady) {}
  std::int64_t wall_ns, steady_ns;
};

class Intake {
 public:
  explicit Intake(Machine* machine) : machine_(*machine) {}

  // One command. Adds its acknowledgement, and those of what ends because of it.
  void take(const Request& request, const Now& now, std::vector<Ack>* acks);
  // Leases, and accepted commands whose state has come. Call it every few ms.
  void tick(const Now& now, std::vector<Ack>* acks);

  // The client that has control, "" = nobody.
  std::string controlling() const;

  static constexpr unsigned kClients = 16, kRemembered = 32, kPending = 16;
  static constexpr std::uint32_t kMaxLifespanMs = 10'000, kMinLeaseMs = 100, kMaxLeaseMs = 60'000;
  static constexpr std::uint32_t kDefaultLeaseMs = 2'000;
  // A client that has been silent for this long can be forgotten: nothing of it can still be on its way.
  static constexpr std::int64_t kForgetNs = 60'000'000'000;
  static constexpr std::int64_t kClockSkewNs = 500'000'000;    // a command may come from so far in the future
  static constexpr std::int64_t kReachNs = 10'000'000'000;     // for an accepted command to reach its state

 private:
  struct Client {
    bool used = false;
    Text<32> name{};
    std::uint64_t writer = 0, last_sequence = 0;
    std::int64_t heard_ns = 0;
    std::array<Ack, kRemembered> answered{};  // ring by sequence of arrival
    unsigned answers = 0;
  };
  struct Pending {
    bool used = false;
    Request request{};
    std::int64_t since_ns = 0;
    std::array<std::uint64_t, NC_MAX_SYSTEMS> runs{};  // before it
  };
  struct Verdict {
    AckState state = AckState::kDone;
    AckReason reason = AckReason::kNone;
    std::string text;
    RefusalCause refusal = RefusalCause::kNone;  // which of them, when the runtime refuses
  };

  Verdict check_form(const Request& request, const Machine::State& state) const;
  Verdict decide(Client* client, const Request& request, const Machine::State& state, const Now& now);
  Verdict execute(const Request& request);
  Verdict take_control(Client* client, const Request& request, std::int64_t now_ns);
  bool expected(const Request& request, const Machine::State& state, std::string* text) const;
  Client* client_of(const Request& request, std::int64_t now_ns);
  void remember(Client* client, const Ack& ack);
  void lose_control();
  void gone(const Request& request, bool everyone);
  void settle(Pending* pending, const Verdict& verdict, std::int64_t now_ns, std::vector<Ack>* acks);
  bool wait_for(const Request& request, std::int64_t now_ns, const Machine::State& before);

  Machine& machine_;
  std::array<Client, kClients> client_;
  std::array<Pending, kPending> pending_;
  Client* control_ = nullptr;
  std::int64_t lease_ns_ = 0, lease_end_ns_ = 0;
  bool jogging_[NC_MAX_SYSTEMS][NC_MAX_AXES] = {};
};

const char* reason_text(AckReason reason);

}  // namespace nc::rt::share
