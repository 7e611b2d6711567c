// SPDX-License-Identifier: Apache-2.0
// The slow part of a bus of drives. See service.hpp.
#include "hal/canopen/service.hpp"

#include <algorithm>
#include <cstdio>

namespace nc::hal::canopen {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kBootWaitNs = 300 * kMs;   // time after a reset within which a node should send its boot-up message
constexpr std::int64_t kPauseNs = 1000 * kMs;     // pause before a silent node is tried again; with each time it is twice as long, so that the resets do
constexpr std::int64_t kMostPauseNs = 8000 * kMs;  // not keep one that boots slowly from coming up at all
constexpr std::int64_t kRefusedNs = 5000 * kMs;   // pause before a node that cannot be set up is tried again
constexpr std::int64_t kStateNs = 2000 * kMs;     // time in which a node must become operational, or a drive must take its mode of operation
constexpr std::uint8_t kStart = 0x01, kPreOperational = 0x80, kResetCommunication = 0x82;  // CiA 301, NMT
constexpr std::uint8_t kBootUp = 0x00, kOperational = 0x05;
constexpr std::uint32_t kNoObject = 0x06020000, kNoSub = 0x06090011, kNoAccess = 0x06010000, kReadOnly = 0x06010002;
constexpr unsigned kUnaskedLimit = 3;
constexpr double kBeats = 2.5;  // heartbeat periods in which the state of a node has to be seen
constexpr const char* kAnew = "is away or has begun anew; it is set up again when it answers";

std::string hex(std::uint32_t value) {
  char text[16];
  std::snprintf(text, sizeof text, "%Xh", value);
  return text;
}

std::vector<std::uint8_t> bytes_of(const ObjectValue& object) {
  std::vector<std::uint8_t> data(object.bytes);
  put_le(data.data(), object.bytes, object.value);
  return data;
}

}  // namespace

Service::Service(const BusMap& bus, Cyclic* cyclic, Report report) : bus_(bus), cyclic_(cyclic), report_(std::move(report)) {
  unsigned axis = 0;
  for (unsigned n = 0; n < bus_.nodes.size(); ++n) {
    Node node;
    node.index = n;
    node.pause_ns = kPauseNs;
    node.map = &bus_.nodes[n];
    node.plan = setup_plan(bus_, *node.map);
    node.sdo = std::make_unique<SdoClient>(node.map->id, bus_.sdo_timeout_ms);
    nodes_.push_back(std::move(node));
    first_axis_.push_back(axis);
    axis += static_cast<unsigned>(bus_.nodes[n].axes.size());
    wrong_.emplace_back("has not answered yet");
    emergency_.emplace_back();
  }
}

bool Service::all_operational() const {
  for (unsigned n = 0; n < nodes_.size(); ++n)
    if (cyclic_->phase(n) != NodePhase::kOperational) return false;
  return true;
}

bool Service::refused() const {
  for (unsigned n = 0; n < nodes_.size(); ++n)
    if (cyclic_->phase(n) == NodePhase::kRefused) return true;
  return false;
}

std::string Service::missing() const {
  const std::lock_guard lock(mutex_);
  std::string text;
  for (unsigned n = 0; n < bus_.nodes.size(); ++n) {
    if (cyclic_->phase(n) == NodePhase::kOperational) continue;
    text += (text.empty() ? "node " : "; node ") + std::to_string(bus_.nodes[n].id) + " (" + bus_.nodes[n].name + "): " + wrong_[n];
    if (!emergency_[n].empty()) text += ", and says " + emergency_[n];
  }
  return text;
}

void Service::say(Node* node, const std::string& text) {
  {
    const std::lock_guard lock(mutex_);
    wrong_[node->index] = text;
  }
  if (text != node->said) report(*node, text);
  node->said = text;
}

void Service::report(const Node& node, const std::string& line) const {
  if (!line.empty() && report_) report_("node " + std::to_string(node.map->id) + " (" + node.map->name + "): " + line);
}

void Service::nmt(const Node& node, std::uint8_t command) {
  CanFrame frame;
  frame.id = kNmtId;
  frame.length = 2;
  frame.data[0] = command;
  frame.data[1] = static_cast<std::uint8_t>(node.map->id);
  (void)cyclic_->to_bus(frame);  // a full queue loses the command; then a time-out follows, and the node is tried again
}

void Service::begin(Node* node, Step step, std::int64_t now_ns) {
  node->step = step;
  node->since_ns = now_ns;
}

void Service::fail(Node* node, const std::string& why, NodePhase phase, std::int64_t now_ns) {
  say(node, why);
  cyclic_->set_phase(node->index, phase);
  begin(node, Step::kPause, now_ns);
}

// ---- frames from the bus ----

void Service::take(const CanFrame& frame, std::int64_t now_ns) {
  const unsigned id = frame.id & kLastNode, kind = frame.id & ~kLastNode;
  for (Node& node : nodes_) {
    if (node.map->id != id) continue;
    if (kind == kSdoAnswerId && !node.sdo->answer(frame)) ++node.unasked;
    if (kind == kHeartbeatId) {
      node.state = frame.data[0] & 0x7F;
      if (node.state == kBootUp) {  // what it has said before is of another life
        const std::lock_guard lock(mutex_);
        emergency_[node.index].clear();
      }
      // A node that boots has lost its set-up, wherever that was, so it begins again.
      if (node.state == kBootUp && node.step != Step::kReset && node.step != Step::kBoot) {
        if (node.step == Step::kRun) say(&node, kAnew);
        cyclic_->set_phase(node.index, NodePhase::kAway);
        node.step = Step::kBoot;
      }
    }
    if (kind == kEmergencyId) take_emergency(&node, frame, now_ns);
  }
}

// What a node says of itself stands beside the reason for which it cannot be used, and not in its place.
void Service::take_emergency(Node* node, const CanFrame& frame, std::int64_t now_ns) {
  const unsigned code = get_le(frame.data, 2);
  const std::string text = code == 0 ? "" : drive_fault_text(drive_fault_code(DriveTrouble::kEmergency, code, frame.data[2]));
  {
    const std::lock_guard lock(mutex_);
    emergency_[node->index] = text;
  }
  if (code != 0 && node->emergencies.takes(text, now_ns)) report(*node, text);
}

void Service::step(std::int64_t now_ns) {
  CanFrame frame;
  for (Node& node : nodes_) report(node, node.emergencies.due(now_ns));
  while (cyclic_->from_bus(&frame)) take(frame, now_ns);
  for (Node& node : nodes_) step_node(&node, now_ns);
}

// ---- one node ----

void Service::step_node(Node* node, std::int64_t now_ns) {
  if (node->step == Step::kRun && cyclic_->phase(node->index) != NodePhase::kOperational) {
    say(node, kAnew);
    begin(node, Step::kReset, now_ns);
  }
  switch (node->step) {
    case Step::kReset:
      node->state = 0xFF;
      nmt(*node, kResetCommunication);
      begin(node, Step::kBoot, now_ns);
      break;
    case Step::kBoot:
      if (node->state != kBootUp && now_ns - node->since_ns < kBootWaitNs) break;
      nmt(*node, kPreOperational);
      node->at = 0;
      node->unasked = 0;
      node->silent = false;
      node->state = 0xFF;
      cyclic_->set_phase(node->index, NodePhase::kSetUp);
      if (node->said.empty()) {
        const std::lock_guard lock(mutex_);
        wrong_[node->index] = "is being set up";
      }
      node->mode.assign(node->map->axes.size(), 0);
      node->job = Node::Job::kNone;
      for (unsigned a = 0; a < node->map->axes.size(); ++a) cyclic_->set_mode(first_axis_[node->index] + a, 0);
      begin(node, Step::kPlan, now_ns);
      break;
    case Step::kPlan:
      work_plan(node, now_ns);
      break;
    case Step::kStart:
      if (node->state == kOperational) {
        node->axis = 0;
        begin(node, Step::kMode, now_ns);
      } else if (now_ns - node->since_ns > std::max(kStateNs, static_cast<std::int64_t>(bus_.heartbeat_ms * kBeats) * kMs)) {
        fail(node, "does not become operational, or sends no heartbeat", NodePhase::kRefused, now_ns);
      }
      break;
    case Step::kMode:
      if (node->state != kOperational) {  // it has started anew, and its boot-up message was lost
        say(node, kAnew);
        cyclic_->set_phase(node->index, NodePhase::kAway);
        begin(node, Step::kReset, now_ns);
        break;
      }
      work_mode(node, now_ns);
      break;
    case Step::kRun:
      work_mode(node, now_ns);
      break;
    case Step::kPause:
      if (now_ns - node->since_ns > (cyclic_->phase(node->index) == NodePhase::kRefused ? kRefusedNs : node->pause_ns)) {
        node->pause_ns = std::min(2 * node->pause_ns, kMostPauseNs);
        begin(node, Step::kReset, now_ns);
      }
      break;
  }
}

// Works through the set-up plan, one object after the other.
void Service::work_plan(Node* node, std::int64_t now_ns) {
  SdoClient& sdo = *node->sdo;
  if (node->unasked >= kUnaskedLimit && !node->silent)
    return fail(node, "two nodes answer under this number, or one answers what it was not asked", NodePhase::kRefused, now_ns);
  if (sdo.state() == SdoClient::State::kBusy) {
    CanFrame frame;
    if (sdo.request(now_ns, &frame)) (void)cyclic_->to_bus(frame);
    return;
  }
  if (node->at > 0) {
    judge_plan_step(node, now_ns);
    if (node->step != Step::kPlan) return;
  }
  if (node->at == node->plan.size()) {
    nmt(*node, kStart);
    node->state = 0xFF;  // only what it says from now on counts
    return begin(node, Step::kStart, now_ns);
  }
  const SetupStep& next = node->plan[node->at++];
  if (next.kind == SetupStep::Kind::kCheck) sdo.read(next.object.index, next.object.sub);
  else sdo.write(next.object.index, next.object.sub, bytes_of(next.object));
  CanFrame frame;
  if (sdo.request(now_ns, &frame)) (void)cyclic_->to_bus(frame);
}

void Service::judge_plan_step(Node* node, std::int64_t now_ns) {
  const SetupStep& done = node->plan[node->at - 1];
  const SdoClient& sdo = *node->sdo;
  if (sdo.state() == SdoClient::State::kFailed) {
    const std::uint32_t code = sdo.abort_code();
    const bool refused = code == kNoSub || code == kNoAccess || code == kReadOnly;
    if (done.kind == SetupStep::Kind::kWriteIfThere && (code == kNoObject || refused)) return;
    if (done.kind == SetupStep::Kind::kIsZero && code == kNoObject) return;
    const bool silent = was_silent(*node);
    node->silent |= silent;
    const std::string value = done.kind == SetupStep::Kind::kCheck ? "" : " (written: " + hex(done.object.value) + ")";
    return fail(node, sdo.error() + value, silent ? NodePhase::kAway : NodePhase::kRefused, now_ns);
  }
  if (done.kind == SetupStep::Kind::kCheck && (sdo.number() & done.mask) != (done.object.value & done.mask))
    fail(node, object_text(done.object.index, done.object.sub) + " is " + hex(sdo.number() & done.mask) + ", not " + hex(done.object.value & done.mask),
         NodePhase::kRefused, now_ns);
}

bool Service::was_silent(const Node& node) const { return node.sdo->abort_code() == 0x05040000; }

// Brings each axis into the mode that is wanted: 6060h is written, then 6061h is read until it shows that mode.
void Service::work_mode(Node* node, std::int64_t now_ns) {
  SdoClient& sdo = *node->sdo;
  CanFrame frame;
  if (node->job != Node::Job::kNone && sdo.state() == SdoClient::State::kBusy) {
    if (sdo.request(now_ns, &frame)) (void)cyclic_->to_bus(frame);
    return;
  }
  if (node->job != Node::Job::kNone) return judge_mode(node, now_ns);
  for (node->axis = 0; node->axis < node->map->axes.size(); ++node->axis) {
    const std::int8_t wanted = cyclic_->wanted_mode(first_axis_[node->index] + node->axis);
    if (wanted == node->mode[node->axis]) continue;
    node->wanted = wanted;
    node->since_ns = now_ns;
    node->job = Node::Job::kWrite;
    sdo.write(static_cast<std::uint16_t>(node->map->axes[node->axis].object(0x6060)), 0, {static_cast<std::uint8_t>(wanted)});
    if (sdo.request(now_ns, &frame)) (void)cyclic_->to_bus(frame);
    return;
  }
  if (node->step != Step::kMode) return;
  if (!cyclic_->set_operational(node->index)) return begin(node, Step::kReset, now_ns);  // the bus went off meanwhile
  say(node, "operational");
  node->pause_ns = kPauseNs;
  begin(node, Step::kRun, now_ns);
}

void Service::judge_mode(Node* node, std::int64_t now_ns) {
  SdoClient& sdo = *node->sdo;
  const Node::Job job = node->job;
  const unsigned object = node->map->axes[node->axis].object(0x6061);
  node->job = Node::Job::kNone;
  if (sdo.state() != SdoClient::State::kDone) {
    if (node->step == Step::kMode) return fail(node, sdo.error(), was_silent(*node) ? NodePhase::kAway : NodePhase::kRefused, now_ns);
    return say(node, sdo.error());  // it is tried again; a homing that waits for the mode ends with its time-out
  }
  const auto shown = static_cast<std::int8_t>(sdo.number());
  if (job == Node::Job::kRead && shown == node->wanted) {
    node->mode[node->axis] = shown;
    cyclic_->set_mode(first_axis_[node->index] + static_cast<unsigned>(node->axis), shown);
  } else if (job == Node::Job::kWrite || now_ns - node->since_ns < kStateNs) {
    node->job = Node::Job::kRead;
    sdo.read(static_cast<std::uint16_t>(object), 0);
    CanFrame frame;
    if (sdo.request(now_ns, &frame)) (void)cyclic_->to_bus(frame);
  } else {
    const std::string why = object_text(object, 0) + " stays " + std::to_string(shown) + ": the mode of operation is to be " + std::to_string(node->wanted);
    if (node->step == Step::kMode) fail(node, why, NodePhase::kRefused, now_ns);
    else say(node, why);
  }
}

}  // namespace nc::hal::canopen
