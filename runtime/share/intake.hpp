// SPDX-License-Identifier: Apache-2.0
// Takes commands that come over a network and decides which of them the machine gets.
//
// The rules are asked in this order, except that rule 2 is asked before rule 1:
//   1  well formed: known kind, numbers finite and in range, texts ended and printable       else malformed
//   2  a (client, sequence) that was answered before gets the same answer; nothing is executed again
//   3  sequence above the last one of this client                                            else out of order
//   4  younger than its lifespan                                                             else late
//   5  from the client that has control; a feed hold is accepted from every client           else no control
//   6  mode, run state and program are those that the client expects                         else expected state
//   7  the runtime accepts the command                                                       else refused
// A command concerns the part system that it names, or all of them (kEverySystem). Mode and reset always concern all of them, and their answer says so.
// Control is a token: one client has it, from its first kTakeControl until it releases it, is gone, or has not
// sent anything for the time of its lease. When a client loses control, its jogs are stopped.
//
// Places for clients are bounded, and nobody can take them from others: a place is for not executing a command twice, so a client whose commands were refused, or
// that is local (its numbers are those of its connection), gives its place up to the next one, the longest silent first. A participant of the gateway has at most
// kPerWriter places, and kKeptForLocal are not for the gateway at all, so that a local client always finds one. A hold needs none: to stop is never refused for
// want of a place or of a name, and to stop twice does no harm.
//
// An executed command that asks for a state which takes time (a start, a hold, a reset, a mode) is answered `accepted`, and later
// `done` or `failed`. Any other one is answered `done` at once.
//
// All calls come from one thread. Everything is bounded; nothing here depends on DDS or shared memory.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "runtime/command.hpp"
#include "runtime/refusal.hpp"
#include "runtime/restart/wish.hpp"
#include "runtime/share/layout.hpp"
#include "runtime/share/request_table.hpp"

namespace nc::rt::share {

// The runtime as the intake sees it.
class Machine {
 public:
  struct State {
    Mode mode = Mode::kAuto;
    bool resetting = false, reset_held = false, alarmed = false;  // held: it is done, and its button is still on
    std::uint64_t resets = 0;  // that are done
    unsigned system_count = 1;
    std::array<unsigned, NC_MAX_SYSTEMS> axis_count{};
    std::array<std::uint8_t, NC_MAX_SYSTEMS> run_state{};  // nc_run_state
    std::array<bool, NC_MAX_SYSTEMS> moves{};              // an axis is commanded to move, in whatever run state
    std::array<std::string, NC_MAX_SYSTEMS> program;       // file name without folder
    std::array<std::uint64_t, NC_MAX_SYSTEMS> runs{};      // number of programs that came to their end
    double max_feed_override = 2.0;
  };
  virtual ~Machine() = default;
  virtual State state() = 0;
  virtual Answer execute(const Command& command) = 0;
  // A feed hold that waits for no other command, from any thread: its number, 0 when it cannot be given so. And until the machine has done it.
  virtual std::uint64_t hold_at_once(unsigned /*system*/) { return 0; }
  virtual Answer await_hold(std::uint64_t /*number*/, unsigned /*system*/) { return Answer::kDone; }
  // Whether the axes have been at rest behind it, also where they move again since.
  virtual bool has_stood(std::uint64_t /*number*/, unsigned /*system*/) { return false; }
  // The feed holds that have been asked for so far, whoever has; the part systems of which one has come since it was so many. Any thread.
  virtual std::uint64_t holds() { return 0; }
  virtual std::uint32_t held_since(std::uint64_t /*holds*/) { return 0; }
  virtual Answer load_mdi(unsigned system, const std::string& blocks) = 0;
  virtual Answer select_program(unsigned system, const std::string& file) = 0;
  // Devices of the ladder; "" releases all of them.
  virtual Answer force(const std::string& device, std::int64_t value) = 0;
  virtual Answer write_device(const std::string& device, std::int64_t value) = 0;
  virtual Answer find_restart(unsigned system, const RestartWish& wish) = 0;
  virtual Answer release(const std::string& device) = 0;
  // The program that was selected is still being checked; and what is to be said of it, also when it was not.
  virtual bool checks(unsigned /*system*/) { return false; }
  virtual std::string remark(unsigned /*system*/) { return {}; }
  // The alarm that stops the machine: "R16 Door open". "" when it has no text yet.
  virtual std::string alarm() { return {}; }
  // What the last answer means, with its reason when that is known.
  virtual std::string explain(Answer answer) { return answer_text(answer); }
};

// Two clocks. The time of day decides whether a command is late. Leases end by a clock that is never set: when a time server sets the time of day back
// while a client is silent, that must not prolong its control or its jog.
struct Now {
  Now(std::int64_t both) : wall_ns(both), steady_ns(both) {}
  Now(std::int64_t wall, std::int64_t steady) : wall_ns(wall), steady_ns(steady) {}
  std::int64_t wall_ns, steady_ns;
};

// What is known of a request from when it came, which may be long before its turn.
struct Arrival {
  std::uint64_t hold = 0;           // the number of the feed hold that the machine has got for it (Intake::hold_at_once()), 0 = none
  std::uint64_t holds = kBehindAll;  // the feed holds that had been asked for then (Machine::holds()); kBehindAll = it comes now
  bool operator==(const Arrival&) const = default;
};

class Intake {
 public:
  explicit Intake(Machine* machine) : machine_(*machine) {}

  // Takes one command and adds its acknowledgement to *acks.
  // A hold that the machine has got when it came cannot be late, and is only waited for.
  void take(const Request& request, const Now& now, std::vector<Ack>* acks, Way way = Way::kGateway, const Arrival& arrival = {});
  // To be called when a request comes. A hold is given to the machine then, and not when its turn among the commands comes, which a selection may keep for seconds; unless take() has to say what is
  // wrong with it. It takes back what was asked for before it, and moves something, and has not had its turn. Any thread, also while another one is in take().
  Arrival arrived(const Request& request, const Now& now);
  // Ends leases, and answers accepted commands whose state has been reached. To be called every few ms.
  void tick(const Now& now, std::vector<Ack>* acks);

  // The client that has control, "" = nobody.
  std::string controlling() const;

  static constexpr unsigned kClients = 16, kPerWriter = 8, kKeptForLocal = 4, kRemembered = 32, kPending = 16;
  static constexpr std::uint32_t kMaxLifespanMs = 10'000, kMinLeaseMs = 100, kMaxLeaseMs = 60'000;
  static constexpr std::uint32_t kDefaultLeaseMs = 2'000;
  // A client with executed commands that has been silent for this long may be forgotten: none of its commands can still be on the way, because lifespans are shorter.
  static constexpr std::int64_t kForgetNs = 60'000'000'000;
  static constexpr std::int64_t kClockSkewNs = 500'000'000;    // a command may be dated in the future by at most this much
  static constexpr std::int64_t kReachNs = 10'000'000'000;     // time within which an accepted command must reach its state

 private:
  struct Client {
    bool used = false;
    bool executed = false;  // a command that must not be executed again; a hold may
    Way way = Way::kGateway;
    Text<32> name{};
    std::uint64_t writer = 0, last_sequence = 0;
    std::int64_t heard_ns = 0;
    std::array<Ack, kRemembered> answered{};  // ring of the last answers, in the order of arrival
    unsigned answers = 0;
  };
  struct Pending {
    bool used = false;
    Way way = Way::kGateway;
    Request request{};
    std::int64_t since_ns = 0;
    Arrival arrival{};
    std::array<std::uint64_t, NC_MAX_SYSTEMS> runs{};  // State::runs before the command
    std::uint64_t resets = 0;                          // State::resets before it
  };
  struct Verdict {
    AckState state = AckState::kDone;
    AckReason reason = AckReason::kNone;
    std::string text;
    RefusalCause refusal = RefusalCause::kNone;  // with kRefused: the cause for which the runtime refuses
  };

  Verdict check_form(const Request& request, const Machine::State& state) const;
  Verdict decide(Client* client, const Request& request, Way way, const Machine::State& state, const Now& now, const Arrival& arrival);
  static Verdict check_time(const Request& request, const Now& now);
  Verdict hold_without_place(const Request& request, Way way, const Now& now, const Arrival& arrival);
  Verdict execute(const Request& request, const Arrival& arrival);
  Answer give(const RequestRow& row, const Request& request, const Arrival& arrival);
  bool is_reached(const Pending& pending, const Machine::State& state);
  bool is_held(const Pending& pending);
  bool is_in_vain(const Pending& pending, const Machine::State& state) const;
  Verdict take_control(Client* client, const Request& request, std::int64_t now_ns);
  bool expected(const Request& request, const Machine::State& state, std::string* text) const;
  Client* client_of(const Request& request, Way way, std::int64_t now_ns);
  Client* place_for(std::uint64_t writer, Way way, std::int64_t now_ns);
  bool may_displace(const Client& client, std::int64_t now_ns) const;
  void remember(Client* client, const Ack& ack);
  void lose_control();
  void gone(const Request& request, Way way, bool everyone);
  void settle(Pending* pending, const Verdict& verdict, std::int64_t now_ns, std::vector<Ack>* acks);
  bool wait_for(const Request& request, Way way, std::int64_t now_ns, const Machine::State& before, const Arrival& arrival);

  Machine& machine_;
  std::array<Client, kClients> client_;
  std::array<Pending, kPending> pending_;
  Client* control_ = nullptr;
  std::int64_t lease_ns_ = 0, lease_end_ns_ = 0;
  bool jogging_[NC_MAX_SYSTEMS][NC_MAX_AXES] = {};
  std::uint64_t moved_[NC_MAX_SYSTEMS] = {};  // Arrival::holds of the last command that was executed and moves something there
};

const char* reason_text(AckReason reason);
// The answer to a command of the gateway that was not asked of the intake.
Ack refusal_of(const Request& request, std::int64_t now_ns, AckReason reason, const char* text);

}  // namespace nc::rt::share
