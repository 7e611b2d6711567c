// SPDX-License-Identifier: Apache-2.0
// A machine whose axes are drives on a CANopen bus. See can_machine.hpp.
#include "hal/canopen/can_machine.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstring>
#include <ctime>

namespace nc::hal::canopen {
namespace {

constexpr std::size_t kStackBytes = 256 * 1024;
constexpr std::int64_t kServiceNs = 2'000'000;
constexpr std::int64_t kModulesNs = 3'000'000'000;  // behind the drives; so long I/O modules that do not answer hold the start up
constexpr std::int64_t kPhaseShare = 64;      // with each cycle the bus's thread corrects 1/64 of its distance from the middle between two scans
constexpr std::int64_t kPhaseStepNs = 2'000;  // the largest such correction

// The time of CLOCK_MONOTONIC; does not enter the kernel.
std::int64_t monotonic_ns() noexcept {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return t.tv_sec * 1'000'000'000LL + t.tv_nsec;
}

void sleep_until(std::int64_t ns) {
  timespec t{};
  t.tv_sec = ns / 1'000'000'000;
  t.tv_nsec = ns % 1'000'000'000;
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr) == EINTR) {
  }
}

// Makes a thread that takes no signals, because they are for the operator's thread. It gets its priority under SCHED_FIFO if that is allowed; otherwise it is
// an ordinary thread.
bool make_thread(void* (*body)(void*), void* self, int priority, const char* name, pthread_t* thread, std::string* error) {
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, kStackBytes);
  pthread_attr_setinheritsched(&attributes, PTHREAD_EXPLICIT_SCHED);
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  int problem = EPERM;
  for (int wanted = priority; problem == EPERM; wanted = 0) {
    sched_param parameters{};
    parameters.sched_priority = wanted;
    pthread_attr_setschedpolicy(&attributes, wanted > 0 ? SCHED_FIFO : SCHED_OTHER);
    pthread_attr_setschedparam(&attributes, &parameters);
    problem = pthread_create(thread, &attributes, body, self);
    if (wanted == 0) break;
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  pthread_attr_destroy(&attributes);
  if (problem == 0) pthread_setname_np(*thread, name);
  else *error = std::string("CANopen: no thread: ") + std::strerror(problem);
  return problem == 0;
}

}  // namespace

CanMachine::CanMachine(const BusMap& bus, std::unique_ptr<CanPort> port, Report report)
    : bus_(bus), report_(std::move(report)), port_(std::move(port)), cyclic_(bus_, port_.get()), service_(bus_, &cyclic_, report_) {
  for (unsigned i = 0; i < cyclic_.axis_count(); ++i)
    if (cyclic_.axis(i).spindle) spindle_[i].loop = SpindleLoop(cyclic_.axis(i).spindle->law);
}

CanMachine::~CanMachine() { stop(); }

// ---- start and stop ----

bool CanMachine::start(const PointImage& initial, std::string* error) {
  for (unsigned n = 0; n < cyclic_.module_count(); ++n) cyclic_.module(n)->begin(initial);
  if (!start_stepping(error) || !make_threads(error)) return false;
  const std::int64_t begin = monotonic_ns(), last = begin + bus_.boot_timeout_ms * 1'000'000LL;
  while (!cyclic_.ready() && !service_.refused() && monotonic_ns() < last) sleep_until(monotonic_ns() + kServiceNs);
  const std::int64_t modules = std::min(last, monotonic_ns() + kModulesNs);
  while (cyclic_.ready() && !service_.all_operational() && !service_.refused() && monotonic_ns() < modules) sleep_until(monotonic_ns() + kServiceNs);
  if (cyclic_.ready() && !service_.refused()) return true;
  const std::string missing = service_.missing();
  // No node of a bus with another bit rate is ever heard, and all that its controller says of that are errors.
  const bool deaf = cyclic_.statistics().received.load() == 0;
  *error = "CANopen on " + bus_.interface + ": " + (missing.empty() ? "a drive is operational and sends no positions" : missing) +
           (deaf ? "; nothing at all has come from the bus: look at its bit rate, wires and terminators" : "");
  return false;
}

bool CanMachine::start_stepping(std::string* error) {
  std::string why;
  if (!port_->open(&why)) {
    *error = "CANopen on " + bus_.interface + ": " + why;
    return false;
  }
  open_ = true;
  return true;
}

void CanMachine::step_bus(std::int64_t now_ns) {
  cyclic_.cycle(now_ns);
  service_.step(now_ns);
  say_what_waits();
}

bool CanMachine::make_threads(std::string* error) {
  ending_.store(false);
  const auto bus = [](void* self) -> void* {
    static_cast<CanMachine*>(self)->bus_thread();
    return nullptr;
  };
  const auto service = [](void* self) -> void* {
    static_cast<CanMachine*>(self)->service_thread();
    return nullptr;
  };
  has_bus_thread_ = make_thread(bus, this, bus_.priority, "can-bus", &bus_pthread_, error);
  has_service_thread_ = has_bus_thread_ && make_thread(service, this, 0, "can-service", &service_pthread_, error);
  return has_service_thread_;
}

// The thread has deadlines of its own, which are moved towards the middle between two scans. So the positions of a scan are complete when a cycle begins,
// and the answers of the drives are there when the next scan begins.
void CanMachine::bus_thread() {
  const std::int64_t period = bus_.cycle_us * 1000LL;
  std::int64_t next = monotonic_ns() + period;
  while (!ending_.load(std::memory_order_acquire)) {
    sleep_until(next);
    const std::int64_t now = monotonic_ns();
    cyclic_.cycle(now);
    if (const std::int64_t stamp = cyclic_.scan_stamp_ns(); stamp != 0) {
      std::int64_t away = (next - stamp) % period;
      if (away < 0) away += period;
      next += std::clamp((period / 2 - away) / kPhaseShare, -kPhaseStepNs, kPhaseStepNs);
    }
    next += period;
    if (now > next) next += (now - next + period) / period * period;  // cycles that were missed are skipped
  }
}

void CanMachine::service_thread() {
  while (!ending_.load(std::memory_order_acquire)) {
    service_.step(monotonic_ns());
    say_what_waits();
    sleep_until(monotonic_ns() + kServiceNs);
  }
}

// A spindle that stands although its points are on is a line of the log, once.
void CanMachine::say_what_waits() {
  for (unsigned i = 0; i < cyclic_.axis_count(); ++i) {
    const bool waits = waits_[i].load(std::memory_order_relaxed);
    if (waits && !waits_said_[i] && report_) report_(cyclic_.axis(i).name + " stands: its points are on from a time when its drive was off, and must be let go first");
    waits_said_[i] = waits;
  }
}

void CanMachine::end_threads() {
  ending_.store(true, std::memory_order_release);
  if (has_bus_thread_) pthread_join(bus_pthread_, nullptr);
  if (has_service_thread_) pthread_join(service_pthread_, nullptr);
  has_bus_thread_ = has_service_thread_ = false;
}

// First the drives stop their axes with their own quick stop ramp, while SYNC goes on. Then the nodes are switched to "pre-operational", in which PDOs have
// no effect.
void CanMachine::stop() noexcept {
  if (has_bus_thread_) {
    BusWanted& wanted = cyclic_.wanted();
    for (AxisWanted& axis : wanted.axis) axis = {};
    wanted.serial = ++serial_;
    wanted.stamp_ns = 0;
    cyclic_.give();
    const auto moving = [this] {
      for (unsigned i = 0; i < cyclic_.axis_count(); ++i)
        if (cyclic_.is_enabled(i)) return true;
      return false;
    };
    const std::int64_t last = monotonic_ns() + bus_.stop_timeout_ms * 1'000'000LL;
    while (moving() && monotonic_ns() < last) sleep_until(monotonic_ns() + kServiceNs);
    end_modules();
  }
  end_threads();
  if (open_) {
    stop_nodes();
    port_->close();
  }
  open_ = false;
}

// The drives are off: the outputs of the modules take their values for the end.
void CanMachine::end_modules() {
  unsigned slowest = 0;
  for (const NodeMap& node : bus_.nodes) slowest = std::max(slowest, node.module ? node.module->every : 0);
  const auto all_ended = [this] {
    for (unsigned n = 0; n < cyclic_.module_count(); ++n)
      if (!cyclic_.module(n)->ended()) return false;
    return true;
  };
  for (unsigned n = 0; n < cyclic_.module_count(); ++n) cyclic_.module(n)->end();
  const std::int64_t last = monotonic_ns() + 4LL * slowest * bus_.sync_us * 1000 + kServiceNs;
  while (!all_ended() && monotonic_ns() < last) sleep_until(monotonic_ns() + kServiceNs);
}

void CanMachine::stop_nodes() {
  for (const NodeMap& node : bus_.nodes) {
    CanFrame frame;
    frame.id = kNmtId;
    frame.length = 2;
    frame.data[0] = 0x80;
    frame.data[1] = static_cast<std::uint8_t>(node.id);
    (void)port_->send(frame);
  }
}

// ---- scan ----

void CanMachine::read(Feedback* feedback, PointImage* image) noexcept {
  const BusShown& shown = cyclic_.shown();
  feedback->lost = shown.lost;
  for (unsigned s = 0; s < NC_MAX_SYSTEMS; ++s) {
    SystemFeedback& out = feedback->system[s];
    out.following_fault = out.drive_fault = out.not_following = out.place_lost = 0;
    out.skip = out.skip_latched = 0;
    out.spindle_fault = 0;
    out.fin = bus_.completes_functions && strobe_[s];
    for (nc_spindle_inputs& spindle : out.spindle) spindle.unmeasured = true;
  }
  for (unsigned i = 0; i < cyclic_.axis_count(); ++i) {
    const AxisMap& map = cyclic_.axis(i);
    const AxisShown& axis = shown.axis[i];
    SystemFeedback& out = feedback->system[map.system];
    if (map.spindle) {
      read_spindle(i, map, shown, feedback, image);
      continue;
    }
    const std::uint32_t bit = 1u << map.axis;
    const auto machine = [&map](std::int64_t increments) { return static_cast<double>(increments) / map.increments_per_unit + map.zero; };
    if (axis.probe_on) {
      const std::uint32_t signal = 1u << (map.skip_signal - 1);
      out.skip |= signal;
      out.skip_latched |= signal & shown.latched[map.system];
    }
    out.skip_place.v[map.axis] = machine(axis.edge);
    if (axis.homing) homing_[i].begun = true;
    if (map.homed >= 0) image->value[map.homed] = axis.homed ? 1 : 0;
    if (axis.known) out.actual.v[map.axis] = machine(axis.position);
    out.actual_ns = std::max(out.actual_ns, axis.measured_ns);
    out.actual_valid = true;
    if (!axis.follows) out.not_following |= bit;
    if (axis.places_lost != places_lost_[i]) out.place_lost |= bit;
    places_lost_[i] = axis.places_lost;
    if (shown.serial < reset_serial_) continue;  // these faults are from before the reset
    if (axis.following_fault) out.following_fault |= bit;
    if ((axis.fault & kFaulty) != 0) {
      out.drive_fault |= bit;
      out.drive_fault_code[map.axis] = axis.fault & ~kFaulty;
    }
  }
}

// The turns are counted on by the way of the motor in the gear that is in.
void CanMachine::read_spindle(unsigned index, const AxisMap& map, const BusShown& shown, Feedback* feedback, PointImage* image) noexcept {
  const AxisShown& axis = shown.axis[index];
  const SpindleMap& spindle = *map.spindle;
  SystemFeedback& out = feedback->system[map.system];
  Spindle& now = spindle_[index];
  const double increments = spindle.increments * spindle.gears[now.gear];
  if (axis.known && !now.known) {
    now.turns = static_cast<double>(axis.position) / increments;
    now.before.fill(now.turns);
  } else if (axis.known) {
    now.turns += static_cast<double>(axis.position - now.position) / increments;
  }
  now.known = axis.known;
  now.position = axis.position;
  double& oldest = now.before[now.scan++ % kSpeedScans];
  const double speed = (now.turns - oldest) / (kSpeedScans * bus_.cycle_us * 1e-6);
  oldest = now.turns;
  const bool faulty = (axis.fault & kFaulty) != 0;
  out.spindle[spindle.number] = {speed, now.turns, true, false, false, !axis.known || shown.lost || faulty};
  out.spindle_age_s[spindle.number] = std::min(static_cast<double>(serial_ - axis.measured_at) * bus_.cycle_us * 1e-6 + spindle.tap_axis_lag_s, NC_SPINDLE_AGE_MAX);
  if (spindle.oriented >= 0) image->value[spindle.oriented] = now.loop.oriented() ? 1 : 0;
  if (!faulty || shown.serial < reset_serial_) return;
  out.spindle_fault |= 1u << spindle.number;
  out.spindle_fault_code[spindle.number] = axis.fault & ~kFaulty;
}

// A gear that is not in turns nothing: the motor stands until the ladder says which one is.
std::int64_t CanMachine::spindle_target(unsigned index, const AxisMap& map, const SystemCommand& system, const PointImage& image) noexcept {
  const SpindleMap& spindle = *map.spindle;
  Spindle& now = spindle_[index];
  const SpindleAsked asked = asked_of(index, map, system, image);
  const double speed = now.loop.step(asked, now.turns, bus_.cycle_us * 1e-6);
  return std::llround(speed * 60 * spindle.gears[now.gear] * spindle.velocity_scale);
}

// Behind a time in which its drive was off, a point that is still on must be let go first; for the ways also a new S command counts. A synchronous tap needs no such rule:
// the spindle stands first, and then goes by what the axis is led.
SpindleAsked CanMachine::asked_of(unsigned index, const AxisMap& map, const SystemCommand& system, const PointImage& image) noexcept {
  constexpr unsigned kSpeedStrobe = 2;  // of SystemCommand::strobe
  const SpindleMap& spindle = *map.spindle;
  Spindle& now = spindle_[index];
  const AxisShown& axis = cyclic_.shown().axis[index];
  const auto is_on = [&image](int point) { return point >= 0 && image.value[point] != 0; };
  const unsigned step = spindle.gear_select >= 0 ? image.value[spindle.gear_select] : 1;
  const bool in_gear = step >= 1 && step <= spindle.gears.size();
  if (in_gear && step - 1 != now.gear) {
    now.loop.change_gear(spindle.gears[now.gear] / spindle.gears[step - 1]);
    now.gear = step - 1;
  }
  const bool on = system.enable && (axis.fault & kFaulty) == 0 && cyclic_.is_enabled(index);
  const bool speed_given = (system.strobe & kSpeedStrobe) != 0 && (system.spindle_selected >> spindle.number & 1u) != 0;
  const bool anew = speed_given && !now.speed_given;
  now.speed_given = speed_given;
  const bool forward = now.forward.step(is_on(spindle.forward), on, anew), backward = now.backward.step(is_on(spindle.backward), on, anew);
  const bool orient = now.orient.step(is_on(spindle.orient), on);
  const bool way_held = now.forward.is_held() || now.backward.is_held();
  waits_[index].store(on && (way_held || now.orient.is_held()), std::memory_order_relaxed);
  const int way = way_held ? 0 : static_cast<int>(forward) - static_cast<int>(backward);
  SpindleAsked asked;
  asked.enabled = system.enable && axis.follows;
  asked.speed = in_gear ? way * std::abs(system.spindle_rev_min[spindle.number]) / 60 : 0;
  asked.orient = in_gear && orient && !way_held;
  asked.synchronous = in_gear && (system.spindle_synchronous >> spindle.number & 1u) != 0;
  asked.turns = system.spindle_turns;
  return asked;
}

// True when the request point has risen and the drive has not begun homing since. While a program runs the request waits for its end.
bool CanMachine::asks_for_homing(unsigned index, const AxisMap& map, const PointImage& image) noexcept {
  const bool on = map.homing_request >= 0 && image.value[map.homing_request] != 0;
  HomingRequest& request = homing_[index];
  request.waits = on && !request.begun && (request.waits || !request.on);
  request.on = on;
  request.begun = false;
  return request.waits;
}

void CanMachine::write(const Command& command, const PointImage& image) noexcept {
  BusWanted& wanted = cyclic_.wanted();
  for (unsigned i = 0; i < cyclic_.axis_count(); ++i) {
    const AxisMap& map = cyclic_.axis(i);
    const SystemCommand& system = command.system[map.system];
    AxisWanted& axis = wanted.axis[i];
    if (map.spindle) {
      axis.target = spindle_target(i, map, system, image);
      axis.on = system.enable;
      axis.reset = system.reset;
      continue;
    }
    axis.target = std::llround((system.position.v[map.axis] - map.zero) * map.increments_per_unit);
    axis.on = system.enable && (system.off >> map.axis & 1u) == 0;
    axis.reset = system.reset;
    axis.home = asks_for_homing(i, map, image) && system.idle;
    axis.stop_homing = (system.stop_homing >> map.axis & 1u) != 0;
  }
  for (unsigned s = 0; s < NC_MAX_SYSTEMS; ++s) strobe_[s] = command.system[s].strobe != 0;
  wanted.serial = ++serial_;
  const bool reset = command.system[0].reset;  // a reset always concerns the whole control
  if (reset && !resetting_) reset_serial_ = serial_;
  resetting_ = reset;
  wanted.stamp_ns = monotonic_ns();
  cyclic_.give();
}

}  // namespace nc::hal::canopen
