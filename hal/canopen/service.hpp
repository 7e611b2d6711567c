// SPDX-License-Identifier: Apache-2.0
// The slow part of a bus of drives: NMT, the set-up of each node by SDO, changes of the mode of operation, and messages for the log.
// step() is called every few milliseconds in an ordinary thread. All nodes are served at the same time, with one SDO transfer each.
//
// A node that is away is tried again and again. When it has come back, it is set up as at the start; its axes keep their alarm until a reset.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "hal/canopen/cyclic.hpp"
#include "hal/canopen/sdo_client.hpp"
#include "hal/canopen/setup_plan.hpp"
#include "hal/log_gate.hpp"

namespace nc::hal::canopen {

// Takes one line for the operator's log.
using Report = std::function<void(const std::string& line)>;

class Service {
 public:
  Service(const BusMap& bus, Cyclic* cyclic, Report report);

  // ---- the thread of the slow part ----
  void step(std::int64_t now_ns);

  // ---- any thread ----
  bool all_operational() const;
  // The nodes that are not operational and what is wrong with each: "node 3 (y): no answer"; empty = all are operational.
  std::string missing() const;
  bool refused() const;  // some node cannot be set up

 private:
  static constexpr unsigned kEmergencies = 8;  // of a node in a minute, as lines of the log
  enum class Step : std::uint8_t { kReset, kBoot, kPlan, kStart, kMode, kRun, kPause };
  struct Node {
    enum class Job : std::uint8_t { kNone, kWrite, kRead };
    unsigned index = 0;
    const NodeMap* map = nullptr;
    std::vector<SetupStep> plan;
    std::unique_ptr<SdoClient> sdo;
    Step step = Step::kReset;
    std::size_t at = 0;
    std::int64_t since_ns = 0;
    std::int64_t pause_ns = 0;  // before it is tried again
    std::uint8_t state = 0xFF;  // state in its last heartbeat
    unsigned unasked = 0;       // number of answers without a request during this set-up
    bool silent = false;        // a request was not answered during this set-up
    Job job = Job::kNone;       // transfer that changes the mode of an axis
    std::size_t axis = 0;
    std::int8_t wanted = 0;
    std::vector<std::int8_t> mode;  // mode of each axis that the drive has confirmed
    std::string said;           // last message for the log
    LogGate emergencies{kEmergencies};
  };

  void take(const CanFrame& frame, std::int64_t now_ns);
  void take_emergency(Node* node, const CanFrame& frame, std::int64_t now_ns);
  void report(const Node& node, const std::string& line) const;
  void step_node(Node* node, std::int64_t now_ns);
  void work_plan(Node* node, std::int64_t now_ns);
  void judge_plan_step(Node* node, std::int64_t now_ns);
  void start_node(Node* node, std::int64_t now_ns);
  void work_mode(Node* node, std::int64_t now_ns);
  void judge_mode(Node* node, std::int64_t now_ns);
  void begin(Node* node, Step step, std::int64_t now_ns);
  void fail(Node* node, const std::string& why, NodePhase phase, std::int64_t now_ns);
  void nmt(const Node& node, std::uint8_t command);
  void say(Node* node, const std::string& text);
  bool was_silent(const Node& node) const;

  const BusMap bus_;
  Cyclic* cyclic_;
  const Report report_;
  std::vector<Node> nodes_;
  std::vector<unsigned> first_axis_;
  mutable std::mutex mutex_;
  std::vector<std::string> wrong_;      // what is wrong with each node; guarded by mutex_
  std::vector<std::string> emergency_;  // what it has said of itself by EMCY and not taken back; guarded by mutex_
};

}  // namespace nc::hal::canopen
