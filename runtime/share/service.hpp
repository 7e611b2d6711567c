// SPDX-License-Identifier: Apache-2.0
// ncrtd's side of the segment: makes it, publishes every 10 ms, and takes commands if that is allowed. Its
// threads are ordinary ones. One of them takes commands from the segment as soon as they come and gives the machine those that stop it at once; another one executes
// them in their order, for which some need seconds.
#pragma once

#include <atomic>
#include <memory>
#include <string>

#include "runtime/rt_thread.hpp"
#include "runtime/runtime.hpp"
#include "runtime/share/intake_desk.hpp"
#include "runtime/share/point_tap.hpp"
#include "runtime/share/program_table.hpp"
#include "runtime/share/publisher.hpp"
#include "runtime/share/request_queue.hpp"
#include "runtime/share/segment.hpp"

namespace nc::rt::share {

struct ServiceOptions {
  std::string name;
  bool commands = false, group = false, virtual_time = false;
  bool local = false;  // local services bring commands in, too
};

// A running Runtime as the intake sees it.
class RuntimeMachine final : public Machine {
 public:
  RuntimeMachine(Runtime* runtime, ProgramTable* programs) : runtime_(*runtime), programs_(*programs) {}
  State state() override;
  Answer execute(const Command& command) override { return runtime_.execute(command); }
  std::uint64_t hold_at_once(unsigned system) override { return runtime_.ask_hold(system); }
  Answer await_hold(std::uint64_t number, unsigned system) override { return runtime_.await_hold(number, system); }
  bool has_stood(std::uint64_t number, unsigned system) override { return runtime_.has_stood(number, system); }
  std::uint64_t holds() override { return runtime_.holds(); }
  std::uint32_t held_since(std::uint64_t holds) override { return runtime_.held_since(holds); }
  Answer load_mdi(unsigned system, const std::string& blocks) override;
  Answer select_program(unsigned system, const std::string& file) override {
    return runtime_.select_program(system, file);
  }
  Answer force(const std::string& device, std::int64_t value) override { return runtime_.force(device, value); }
  Answer write_device(const std::string& device, std::int64_t value) override { return runtime_.write_device(device, value); }
  Answer find_restart(unsigned system, const RestartWish& wish) override { return runtime_.find_restart(system, wish); }
  Answer release(const std::string& device) override { return runtime_.release(device); }
  bool checks(unsigned system) override { return runtime_.start_gate() != nullptr && runtime_.start_gate()->waits(system); }
  std::string remark(unsigned system) override { return runtime_.start_gate() != nullptr ? runtime_.start_gate()->remark(system) : std::string(); }
  std::string alarm() override;
  std::string explain(Answer answer) override { return runtime_.explain(answer); }

 private:
  Runtime& runtime_;
  ProgramTable& programs_;
};

class Service {
 public:
  // All must outlive the service. `tap` may be null.
  Service(Runtime* runtime, ProgramTable* programs, PointTap* tap, const ServiceOptions& options);
  ~Service() { stop(); }
  // Makes the segment. To be called before the runtime starts, so that a name in use is an error before anything moves.
  bool create(std::string* error);
  // Starts the threads. To be called after the start of the runtime.
  bool start(std::string* error);
  // Publishes the last state, then tells the readers that this is the end.
  void stop();
  // For the local services. The segment exists after create().
  IntakeDesk* desk() { return &desk_; }
  Segment* segment() { return segment_.get(); }

 private:
  void publisher_thread();
  void arrival_thread();
  void intake_thread();
  void arrived(const Request& request);
  void give_answers();

  Runtime& runtime_;
  const ServiceOptions options_;
  RuntimeMachine machine_;
  IntakeDesk desk_;
  SegmentOwner segment_;
  ProgramTable& programs_;
  PointTap* tap_;
  std::unique_ptr<Publisher> publisher_;
  RequestQueue waiting_;
  AnswerQueue answers_;
  RtThread publisher_thread_, arrival_thread_, intake_thread_;
  std::atomic<bool> stop_{false};
  bool started_ = false;
};

}  // namespace nc::rt::share
