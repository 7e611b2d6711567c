// SPDX-License-Identifier: Apache-2.0
// The scan: see scan.hpp for its order.
#include "runtime/scan.hpp"

#include <algorithm>
#include <ctime>
#include <iterator>

#include "runtime/rt_scope.hpp"
#include "runtime/signals/signal_table.hpp"

namespace nc::rt {
namespace {

hal::PointImage initial_image(const hal::PointTable& points) {
  hal::PointImage image;
  for (unsigned p = 0; p < points.size(); ++p) image.value[p] = points.at(p).initial;
  return image;
}

// A reset is given to the NC for at least this number of scans, so that its edge is seen in every state.
constexpr unsigned kResetMinScans = 2;

// M700 10.6: true when the spindles are selected by the ladder, or by points that are wired to the selection signals.
bool selects_spindles(const Config& config) {
  const std::vector<Signal> signals = machine_signals(config.nc);
  return !config.ladder.program.empty() || std::any_of(config.wires.begin(), config.wires.end(), [&](const SignalWire& wire) {
    return signals[wire.signal].name.find(".spindle_select.") != std::string::npos;
  });
}

// The points that are wired to the alarms of the ladder; -1 = none.
std::array<int, kLadderAlarms> wired_alarms(const Config& config) {
  const std::vector<Signal> signals = machine_signals(config.nc);
  std::array<int, kLadderAlarms> points;
  points.fill(-1);
  for (const SignalWire& wire : config.wires)
    for (unsigned n = 0; n < kLadderAlarms; ++n)
      if (signals[wire.signal].name == "plc.alarm." + std::to_string(n + 1)) points[n] = static_cast<int>(wire.point);
  return points;
}

// The time for the execution histogram. clock_gettime() of the monotonic clock does not enter the kernel.
std::int64_t processor_ns() noexcept {
  timespec t{};
  clock_gettime(CLOCK_MONOTONIC, &t);
  return t.tv_sec * 1'000'000'000LL + t.tv_nsec;
}

}  // namespace

bool stops_the_nc(const ActiveAlarm& alarm) noexcept {
  return alarm.id != AlarmId::kProgram && alarm_row(alarm.id).stops && !alarm.acknowledged;
}

Scan::Scan(const Config& config, Clock* clock, hal::Hal* hal, LadderHook* ladder, NcPort* nc)
    : config_(config),
      clock_(clock),
      hal_(hal),
      ladder_(ladder),
      nc_(nc),
      systems_(config.nc.system_count),
      alarm_point_(wired_alarms(config)),
      selects_spindles_(selects_spindles(config)),
      period_ns_(static_cast<std::int64_t>(config.cycle_us) * 1000),
      points_(initial_image(config.points)),
      macro_(config.macro, points_),
      snapshot_(Snapshot::bytes(config.nc.system_count)) {
  for (unsigned s = 0; s < systems_; ++s) {
    in_[s].feed_override = in_[s].rapid_override = feed_override_[s] = rapid_override_[s] = 1;
    last_command_[s] = config.start[s];
    out_[s].command = config.start[s];
    out_[s].distance_zero = true;
    feedback_.system[s].actual = config.start[s];
  }
  create_axes();
  power_.create(config.power, has_brakes());
  std::uint32_t mapped[NC_WORDS];
  macro_.mapped(mapped);
  tell_found_outputs(mapped);  // the points of macro outputs may begin with another value than 0
}

// Programs read their macro outputs from the control, which the feeder supplies. So the feeder is told of outputs that a bus has found with
// another value.
void Scan::tell_found_outputs(const std::uint32_t found[NC_WORDS]) noexcept {
  for (unsigned w = 0; w < NC_WORDS; ++w) {
    output_value_[w].store(macro_.output()[w], std::memory_order_relaxed);
    output_found_[w].fetch_or(found[w], std::memory_order_release);
  }
}

void Scan::begin() noexcept {
  next_ns_ = clock_->now_ns() + period_ns_;
}

void Scan::loop_step() noexcept {
  clock_->sleep_until(next_ns_);
  statistics_.jitter.record(clock_->now_ns() - next_ns_);
  const std::int64_t started = processor_ns();
  run_once();
  statistics_.execution.record(processor_ns() - started);
  // A scan that ends after the end of its slot is an overrun. If it is late by less than a period, the next scan runs at once.
  // If it is later, the missed slots are skipped. The NC's time advances by one cycle per scan, so no set-point jumps.
  const std::int64_t late = clock_->now_ns() - (next_ns_ + period_ns_);
  next_ns_ += period_ns_;
  if (late < 0) return;
  const std::int64_t missed = late / period_ns_;
  next_ns_ += missed * period_ns_;
  statistics_.overruns.fetch_add(1, std::memory_order_relaxed);
  statistics_.missed_slots.fetch_add(static_cast<std::uint64_t>(missed), std::memory_order_relaxed);
  missed_since_reset_ += static_cast<std::uint64_t>(missed);
}

void Scan::run_once() noexcept {
  const RtScope scope;
  ++scan_;
  scan_time_ns_ = clock_->now_ns();
  read_inputs();
  run_ladder();
  run_axes();
  for (unsigned s = 0; s < systems_; ++s) {  // what the ladder left in the points is what the program reads
    macro_.gather(points_, interface_input_);
    for (unsigned w = 0; w < NC_WORDS; ++w) in_[s].input[w] = interface_input_[w] |= last_requests_.macro_input[w];
  }
  for (unsigned s = 0; s < systems_; ++s) last_command_[s] = out_[s].command;
  nc_->cycle(in_, out_);
  take_positions();
  note_given();
  write_outputs();
  follow_requests();
  publish();
  answer_commands();
}

// ---- 1 inputs ----

void Scan::read_inputs() noexcept {
  read_machine();
  std::uint32_t found[NC_WORDS];
  if (macro_.take_over(points_, found)) tell_found_outputs(found);
  bind_spindles();
  look_at_axes();
  take_commands();
  watch_machine();
  watch_standstill();
  watch_overruns();
  watch_fin();
  watch_links();
  watch_retained();
  watch_printer();
  build_nc_inputs();
}

// Replaces what the machine reports of spindles whose speed it does not measure ([[spindle]]) by the value of the configured point. The speed counts as
// not measured when no point is configured or the bus of the point does not answer.
void Scan::bind_spindles() noexcept {
  for (unsigned s = 0; s < systems_; ++s) {
    for (unsigned n = 0; n < NC_MAX_SPINDLES; ++n) {
      const SpindleFeedback& by = config_.spindle_feedback[s][n];
      if (by.by == SpindleFeedback::By::kSimulation) continue;
      nc_spindle_inputs& spindle = feedback_.system[s].spindle[n];
      spindle = {};
      const bool silent = by.point >= 0 && (config_.points.at(static_cast<unsigned>(by.point)).bus == 0 ? feedback_.lost : points_.good[by.point] == 0);
      spindle.unmeasured = by.by == SpindleFeedback::By::kNothing || silent;
      if (!spindle.unmeasured) spindle.rev_per_s = static_cast<std::int32_t>(points_.value[by.point]) * by.rpm_per_count / 60;
    }
  }
}

void Scan::take_commands() noexcept {
  held_now_ = 0;
  // In front of the commands: those that were asked for before the hold are taken back by their count, and a start behind it is wanted.
  if (const std::uint32_t systems = hold_door_.take(); systems != 0) hold_as_asked(systems);
  Command command;
  while (answered_count_ < std::size(answered_) && commands_.pop(&command)) answered_[answered_count_++] = {command.ticket, apply(command)};
}

// A feed hold of one of these part systems has come since the command was asked for.
bool Scan::is_taken_back(const Command& command) const noexcept { return (hold_door_.asked_since(command.holds) & named_systems(command)) != 0; }

// Holds what runs, or in manual mode what moves by hand.
void Scan::hold_as_asked(std::uint32_t systems) noexcept {
  if (mode_ == Mode::kManual) hands_held_ |= systems;
  else hold(systems);
}

// Called after the snapshot is published. So a client that has its answer finds the effect of the command in the snapshot, and so does the feeder before
// it executes the next command.
void Scan::answer_commands() noexcept {
  // A full ring of answers loses answers, not commands. That happens only when nobody fetches the answers, because the ring is larger than that of the
  // commands.
  for (unsigned n = 0; n < answered_count_; ++n) (void)answers_.push(answered_[n]);
  answered_count_ = 0;
  hold_door_.answer();
  const std::uint32_t braking = hold_door_.braking();
  for (unsigned s = 0; braking != 0 && s < systems_; ++s)
    if ((braking >> s & 1u) != 0 && stands(s)) hold_door_.stands(s);
}

bool Scan::stands(unsigned system) const noexcept {
  const nc_axes& velocity = out_[system].velocity;
  return out_[system].state != NC_STATE_RUNNING && std::all_of(std::begin(velocity.v), std::end(velocity.v), [](double v) { return v == 0; });
}

// The part systems that a command names, one bit each; 0 = the part system does not exist.
std::uint32_t Scan::named_systems(const Command& command) const noexcept {
  if (command.system == kAllSystems) return all_systems();
  return command.system < systems_ ? 1u << command.system : 0;
}

Answer Scan::apply(const Command& command) noexcept {
  const std::uint32_t systems = named_systems(command);
  if (takes_all_systems(command.kind) && systems == 0) return Answer::kAxisUnknown;
  const auto set = [systems](bool on, std::uint32_t* switches) {
    *switches = on ? *switches | systems : *switches & ~systems;
    return Answer::kDone;
  };
  switch (command.kind) {
    case CommandKind::kSetMode:
      if (command.number > static_cast<std::uint32_t>(Mode::kManual)) return Answer::kOutOfRange;
      return set_mode(static_cast<Mode>(command.number));
    case CommandKind::kCycleStart:
      return start_cycle(systems, command.system == kAllSystems, command.by, hold_door_.asked_since(command.holds));
    case CommandKind::kFeedHold:
      hold_as_asked(systems);
      return Answer::kDone;
    case CommandKind::kEnd:
      ending_ = true;
      if (mode_ == Mode::kManual) request_reset();  // behind a feed hold a handle that is turned, or a button that is pressed anew, would move its axis again
      else hold(all_systems());
      return Answer::kDone;
    case CommandKind::kReset:
      request_reset();
      return Answer::kDone;
    case CommandKind::kFeedOverride:
      return set_override(systems, command.value, config_.nc.max_feed_override, machine_feeds_, feed_override_);
    case CommandKind::kRapidOverride:
      return set_override(systems, command.value, 1, machine_rapids_, rapid_override_);
    case CommandKind::kSingleBlock:
      return set(command.number != 0, &single_block_);
    case CommandKind::kOptionalStop:
      return set(command.number != 0, &optional_stop_);
    case CommandKind::kJog:
    case CommandKind::kStep:
    case CommandKind::kReference:
      return manual(command);
    case CommandKind::kApproach:
      return approach(command);
    case CommandKind::kHome:
      return is_taken_back(command) ? Answer::kTakenBack : home_command(command);
    case CommandKind::kTapRetract:
      return command.number != 0 && is_taken_back(command) ? Answer::kTakenBack : draw_tap(command.system, command.number != 0);
    case CommandKind::kForce:
      return ladder_->force(command.number, static_cast<std::int32_t>(command.value));
    case CommandKind::kRelease:
      return ladder_->release(command.number);
    case CommandKind::kWriteDevice:
      return ladder_->write(command.number, static_cast<std::int32_t>(command.value));
    case CommandKind::kSelectProgram:
    case CommandKind::kLoadMdi:
    case CommandKind::kSwitches:
    case CommandKind::kFindRestart:
    case CommandKind::kConfirmRestart:
    case CommandKind::kCancelRestart:
    case CommandKind::kLook:
    case CommandKind::kChange:
      break;  // these are commands for the feeder
  }
  return Answer::kOutOfRange;
}

// Holds programs that run, and cancels starts of this scan: a start that was commanded earlier in this scan is removed here, before the NC sees it, and a
// hold also reaches a start that the NC has not carried out yet. The start of a button comes after the commands of its scan (follow_ladder()), so
// start_cycle() cancels it.
void Scan::hold(std::uint32_t systems) noexcept {
  const std::uint32_t taken_back = start_pulse_ & systems;
  for (unsigned s = 0; s < systems_; ++s)
    if ((taken_back >> s & 1u) != 0) refuse(s, Asked::kCycleStart, Answer::kTakenBack, -1, false, start_by_[s]);
  start_pulse_ &= ~systems;
  for (unsigned s = 0; s < systems_; ++s)
    if ((taken_back & mdi_beginning() & 1u << s) != 0) mdi_started_[s] = 0, mdi_runs_ &= ~(1u << s);
  hold_request_ |= systems;
  held_now_ |= systems;
}

// A program that is stopped at the end of a block may be interrupted by manual motion, and one that was started in AUTO by blocks of MDI. In a feed hold there is
// manual motion only, and the axes come back before the program goes on. To go on, each needs the mode in which it was started.
Answer Scan::set_mode(Mode mode) noexcept {
  if (mode == mode_) return Answer::kDone;
  const bool active = program_active();
  // A start that was accepted: the NC gets it with this scan or the next one.
  if (start_pulse_ != 0 || std::any_of(in_, in_ + systems_, [](const nc_inputs& in) { return in.cycle_start; })) return Answer::kNotWhileRunning;
  if (!at_rest()) return active ? Answer::kNotWhileRunning : Answer::kAxesMove;
  for (unsigned s = 0; s < systems_; ++s) {
    const std::uint8_t state = out_[s].state;
    if (state == NC_STATE_RUNNING) return Answer::kNotWhileRunning;
    if (state == NC_STATE_MANUAL) return Answer::kAxesMove;
    if (!active) continue;
    if (mode == mode_to_go_on()) continue;
    if (mode == Mode::kAuto || (mode == Mode::kMdi && mode_to_go_on() != Mode::kAuto)) return Answer::kNotWhileRunning;
    const bool held = state == NC_STATE_HOLD;
    if ((held || state == NC_STATE_STOPPED) && (!out_[s].manual_allowed || (held && mode == Mode::kMdi))) return Answer::kMiddleOfBlock;
  }
  mode_ = mode;
  return Answer::kDone;
}

// The part systems in which a start has an effect: an interrupted program goes on, otherwise the program that is ready for this mode begins. A start of
// all part systems (`all`) begins no program while one of them runs or is interrupted: a program that has ended meanwhile must not begin again just
// because the program of another part system goes on. A start that names one part system begins its program even then.
std::uint32_t Scan::ready_systems(std::uint32_t systems, bool all) const noexcept {
  std::uint32_t begins = head_with(mode_ == Mode::kMdi ? kMdiLoaded : kPartLoaded, all);
  // The program of another part system would begin at its head, in front of an operator who wants to come to a place without a movement.
  if (const std::uint32_t found = begins & restart_found_.load(std::memory_order_acquire); found != 0 && all) begins = found;
  std::uint32_t goes_on = in_state(NC_STATE_HOLD) | in_state(NC_STATE_STOPPED);
  // In MDI the interrupted program of AUTO does not go on, but blocks of MDI begin in it, or go on.
  if (mode_ == Mode::kMdi && program_mode_ == Mode::kAuto) goes_on &= (mdi_waiting() & in_state(NC_STATE_STOPPED)) | (mdi_runs_ & ~mdi_beginning());
  return systems & (goes_on | begins);
}

// The part systems at whose head this is loaded, as far as a start could begin it.
std::uint32_t Scan::head_with(Loaded wanted, bool all) const noexcept {
  const std::uint32_t loaded = loaded_.load(std::memory_order_acquire), active = active_systems();
  constexpr std::uint32_t kMask = (1u << kLoadedBits) - 1;
  std::uint32_t found = 0;
  for (unsigned s = 0; s < systems_ && (active == 0 || !all); ++s)
    if ((loaded >> kLoadedBits * s & kMask) == wanted) found |= 1u << s;
  return found & ~active;
}

bool Scan::any_not_checked() const noexcept {
  const std::uint32_t loaded = loaded_.load(std::memory_order_acquire);
  for (unsigned s = 0; s < systems_; ++s)
    if ((loaded >> kLoadedBits * s & ((1u << kLoadedBits) - 1)) == kPartNotChecked) return true;
  return false;
}

// Blocks of MDI that wait for a start.
std::uint32_t Scan::mdi_waiting() const noexcept {
  std::uint32_t waiting = 0;
  for (unsigned s = 0; s < systems_; ++s) {
    const std::uint32_t text = mdi_waits_[s].load(std::memory_order_acquire);
    if (text != 0 && text != mdi_started_[s]) waiting |= 1u << s;
  }
  return waiting;
}

// Blocks of MDI that have been started, and of which the NC has executed nothing yet.
std::uint32_t Scan::mdi_beginning() const noexcept {
  std::uint32_t beginning = 0;
  for (unsigned s = 0; s < systems_; ++s)
    if ((mdi_runs_ >> s & 1u) != 0 && out_[s].state == NC_STATE_STOPPED && out_[s].serial == mdi_serial_[s]) beginning |= 1u << s;
  return beginning;
}

// Notices that blocks of MDI have come to their end, or that the NC has refused their start because of a feed hold.
void Scan::follow_mdi() noexcept {
  for (unsigned s = 0; s < systems_; ++s) {
    const nc_outputs& out = out_[s];
    const bool stopped = out.state == NC_STATE_STOPPED, begun = out.serial != mdi_serial_[s];
    if (stopped && ((begun && out.cause == NC_CAUSE_MDI_ENDED) || (!begun && in_[s].feed_hold))) {
      if (!begun) mdi_started_[s] = 0;
      mdi_runs_ &= ~(1u << s);
    }
  }
  mdi_runs_ &= active_systems();
}

// `held_since`: the part systems of which a feed hold has come since the start was asked for.
Answer Scan::start_cycle(std::uint32_t systems, bool all, Asker by, std::uint32_t held_since) noexcept {
  if (ending_) return Answer::kEnding;
  if (mode_ == Mode::kManual) return Answer::kNotInThisMode;
  if (reset_phase_ != ResetPhase::kNone) return in_reset();
  // A warning prevents the next program from starting; it does not prevent an interrupted one from going on.
  if (alarms_.stops()) return Answer::kAlarmActive;
  const std::uint32_t ready = ready_systems(systems, all), active = active_systems();
  if ((systems & active) == 0 && alarms_.waits_for_reset()) return Answer::kWarningActive;
  // A start of several part systems begins none of them when one may not: their programs belong together.
  if (mode_ == Mode::kAuto && (systems & head_with(kPartNotChecked, all)) != 0) return Answer::kNotChecked;
  if (ready == 0 && (systems & in_state(NC_STATE_RUNNING)) != 0) return Answer::kAlreadyRunning;
  std::uint32_t held = 0;
  for (unsigned s = 0; s < systems_; ++s) held |= machine_holds_[s] ? 1u << s : 0;
  if (((ready != 0 ? ready : systems) & ~held) == 0) return Answer::kFeedHold;
  if (ready == 0) return Answer::kNoProgram;
  if (drives_not_following() || any_powerless()) return Answer::kDrivesOff;
  for (unsigned s = 0; s < systems_; ++s)
    for (unsigned a = 0; (ready >> s & 1u) != 0 && a < config_.nc.system[s].axis_count; ++a)
      if (lock_left(s, a)) return Answer::kLockLeft;
  if (at_limit_switch(ready)) return Answer::kLimitSwitch;
  for (unsigned s = 0; s < systems_; ++s)
    if ((ready >> s & 1u) != 0 && axis_not_homed(s) >= 0) return Answer::kNotHomed;
  for (unsigned s = 0; s < systems_; ++s)
    if ((ready >> s & 1u) != 0 && out_[s].tap_holds != 0) return Answer::kTapInHole;  // the NC would refuse it without a word
  if (const Answer why = restart_hindrance(ready); why != Answer::kDone) return why;
  // Who commands a start behind his hold wants it. Whoever presses a button in that scan does not know of the hold.
  const std::uint32_t taken_back = held_since | (by == Asker::kPanel || by == Asker::kLadder ? held_now_ : 0), starts = ready & ~taken_back;
  if (starts == 0) return Answer::kTakenBack;
  if (active == 0) program_mode_ = mode_;
  for (unsigned s = 0; s < systems_; ++s)
    if ((starts & ~active) >> s & 1u) begun_[s] = out_[s].command;
  for (unsigned s = 0; s < systems_ && mode_ == Mode::kMdi && program_mode_ == Mode::kAuto; ++s) {
    if ((starts & mdi_waiting() & ~mdi_runs_ & 1u << s) == 0) continue;
    mdi_started_[s] = mdi_waits_[s].load(std::memory_order_relaxed);
    mdi_serial_[s] = out_[s].serial;
    mdi_runs_ |= 1u << s;
  }
  start_pulse_ |= starts;
  hold_request_ &= ~starts;
  for (unsigned s = 0; s < systems_; ++s)
    if ((starts & hold_door_.braking()) >> s & 1u) hold_door_.stands(s);  // what is started behind a hold, before the axes stand, ends it
  for (unsigned s = 0; s < systems_; ++s) {
    if ((systems >> s & 1u) == 0) continue;
    start_by_[s] = by;
    if (machine_holds_[s]) refuse(s, Asked::kCycleStart, Answer::kFeedHold, -1, false, by);
    else if ((ready & taken_back) >> s & 1u) refuse(s, Asked::kCycleStart, Answer::kTakenBack, -1, false, by);
    else happened(s, Asked::kCycleStart);
  }
  return Answer::kDone;
}

// M700 10.5: true for an axis that is also a spindle and whose servo is off, so that it turns as a spindle now.
bool Scan::is_spindle_now(unsigned system, unsigned axis) const noexcept {
  return config_.nc.system[system].axis[axis].spindle != 0 && (out_[system].servo_ready >> axis & 1u) == 0;
}

void Scan::build_nc_inputs() noexcept {
  const std::int64_t local_ms = clock_->local_ms();
  // The blocks of MDI that were entered and not started are taken back before the program goes on in AUTO.
  const std::uint32_t waits = mode_ == Mode::kAuto && reset_phase_ == ResetPhase::kNone ? mdi_waiting() & in_state(NC_STATE_STOPPED) : 0;
  for (unsigned s = 0; s < systems_; ++s) {
    nc_inputs& in = in_[s];
    const hal::SystemFeedback& machine = feedback_.system[s];
    in.cycle_start = ((start_pulse_ & ~waits) >> s & 1u) != 0;
    in.feed_hold = (hold_request_ >> s & 1u) != 0;  // run_ladder() adds the feed hold of the machine
    in.reset = reset_phase_ == ResetPhase::kStopping;
    in.single_block = (single_block_ >> s & 1u) != 0;
    in.optional_stop = (optional_stop_ >> s & 1u) != 0;
    in.fin = machine.fin;
    in.fin2 = false;
    in.fin_groups = 0;
    in.auxiliary_lock = in.dry_run = false;
    in.interlock = false;
    in.macro_interrupt = false;
    in.tap_retract = taps_drawn_ >> s & 1u;
    in.tool_broken = false;
    in.manual_absolute_off = false;
    // The level tells the NC of alarms of the machine. A program alarm does not set it, because it is a state of libnc itself.
    in.alarm = false;
    for (unsigned i = 0; i < alarms_.count; ++i) in.alarm |= stops_the_nc(alarms_.alarm[i]);
    in.skip = machine.skip;
    in.skip_latched = machine.skip_latched;
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) {
      const AxisWork& axis = axes_[s][a];
      in.skip_place.v[a] = machine.skip_place.v[a] - axis.screw.value() + axis.shift + axis.beside;
    }
    in.unclamped = machine.unclamped;
    in.mirror = 0;
    in.feed_override = feed_override_[s];  // decide_overrides() may replace it
    in.rapid_override = rapid_override_[s];
    std::copy(std::begin(machine.spindle), std::end(machine.spindle), in.spindle);
    std::copy(std::begin(machine.spindle_age_s), std::end(machine.spindle_age_s), in.spindle_age_s);
    in.spindle_select = selects_spindles_ ? 0 : 1;
    in.spindle_encoder = 0;
    in.servo_on = 0;
    in.feed_pulses = 0;
    in.tool_length_handle = in.tool_angle[0] = in.tool_angle[1] = 0;
    in.actual_valid = machine.actual_valid;
    in.actual = machine.actual;
    in.follow_up = (drives_off_ || machine.not_following != 0) && !feedback_.lost;
    in.clock_ms = local_ms;
    give_commands_by_hand(s);
  }
  start_pulse_ &= waits;
}

// ---- 4 outputs ----

void Scan::write_outputs() noexcept {
  if (!drives_off_ && !drives_not_following()) watch_soft_limits();  // not while drives are off: coasting axes may be anywhere
  drives_off_ |= machine_faulty();
  for (unsigned s = 0; s < systems_; ++s) {
    const nc_outputs& out = out_[s];
    macro_.distribute(out.output, out.output_written, &points_);
    hal::SystemCommand& machine = machine_.system[s];
    const std::uint32_t all = (1u << config_.nc.system[s].axis_count) - 1;
    machine.off = power_axes(s) & all;
    machine.enable = !drives_off_ || machine.off != all;  // a drive may have to hold until its brake does
    machine.reset = reset_phase_ == ResetPhase::kStopping || reset_phase_ == ResetPhase::kFeeder;
    machine.position = out.command;
    machine.velocity = out.velocity;
    for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) give_to_drive(s, a);
    machine.strobe = out.strobe;
    machine.m = out.m;
    machine.t = out.t;
    machine.b = out.b;
    std::copy(std::begin(out.spindle_rev_min), std::end(out.spindle_rev_min), machine.spindle_rev_min);
    machine.spindle_selected = out.spindle_selected;
    machine.spindle_synchronous = out.spindle_synchronous;
    machine.spindle_turns = out.spindle_turns;
    machine.servo_on = out.servo_on;
    machine.servo_ready = out.servo_ready;
    machine.serial = out.serial;
    machine.source = out.source;
    machine.running = out.state == NC_STATE_RUNNING;
    machine.idle = out.state == NC_STATE_IDLE;
    machine.unclamp = out.unclamp;
    std::copy(std::begin(out.current_limit), std::end(out.current_limit), machine.current_limit);
    machine.stop_homing = drives_to_stop(s);
    if (out.message && !message_seen_[s] && !messages_.push({s, out.message_text, out.message_port}) && out.message_port != 0)
      post_print_trouble(s);  // the queue is full, so this line is lost
    message_seen_[s] = out.message;
    if (recording_) record_position(s);
  }
  ladder_->hold_outputs(&points_);
  macro_.leave(points_);
  hal_->write(machine_, points_);
}

// Records the path for drawings. Samples that find the queue full (after about four seconds without a feeder) are lost; the machine does not wait.
void Scan::record_position(unsigned system) noexcept {
  const nc_outputs& out = out_[system];
  if (out.distance_zero && scan_ > 1) return;
  (void)positions_.push({static_cast<std::uint8_t>(system), out.rapid, out.command, out.work});
}

// Ends requests that have been carried out: a request to hold is dropped when the program has stopped, and a reset is handed over to the
// feeder when the machine is at rest.
void Scan::follow_requests() noexcept {
  for (unsigned s = 0; s < systems_; ++s) {
    // An alarm state of the NC is a program alarm, unless the NC was given the alarm by the scan.
    const bool alarm = out_[s].state == NC_STATE_ALARM;
    alarm_was_given_[s] = alarm && (alarm_was_given_[s] || in_[s].alarm);
    if (out_[s].inputs_refused != 0) raise(AlarmId::kBadInput, s, -1, out_[s].inputs_refused);
    if (alarm && !alarm_was_given_[s] && reset_phase_ == ResetPhase::kNone) raise(AlarmId::kProgram, s, -1);
  }
  hold_request_ &= in_state(NC_STATE_RUNNING);
  follow_mdi();
  watch_manual();
  for (unsigned s = 0; s < systems_; ++s) publish_axes(s);
  if (reset_phase_ == ResetPhase::kStopping) {
    ++reset_scans_;
    if (reset_scans_ >= kResetMinScans && !program_active() && at_rest() && axes_stand()) {
      reset_phase_ = ResetPhase::kFeeder;
      reset_rest_.fetch_add(1, std::memory_order_release);
    }
  } else if (reset_phase_ == ResetPhase::kFeeder &&
             reset_done_.load(std::memory_order_acquire) == reset_rest_.load(std::memory_order_relaxed)) {
    reset_phase_ = ResetPhase::kHeld;
    ++resets_;
    drives_off_ = machine_faulty();
  }
  // The reset is over when the reset button goes off. While the control is being ended the button is not waited for, because nothing starts anyway.
  if (reset_phase_ == ResetPhase::kHeld && (!last_requests_.reset || ending_)) reset_phase_ = ResetPhase::kNone;
}

// ---- 5 snapshot ----

void Scan::publish_overrides(unsigned s, SystemSnapshot* out) const noexcept {
  const bool program = out_[s].override_source == NC_OVERRIDE_PROGRAM;
  const auto given = [](bool machine) { return machine ? OverrideSource::kMachine : OverrideSource::kOperator; };
  out->feed_override = program ? out_[s].feed_override : in_[s].feed_override;
  out->feed_override_source = program ? OverrideSource::kProgram : given(machine_feeds_[s]);
  out->rapid_override = in_[s].rapid_override;
  out->rapid_override_source = given(machine_rapids_[s]);
}

void Scan::publish() noexcept {
  Snapshot& out = building_;
  out.scan = scan_;
  out.time_ns = scan_time_ns_;
  out.clock_ms = in_[0].clock_ms;
  out.mode = mode_;
  out.system_count = systems_;
  for (unsigned s = 0; s < systems_; ++s) {
    out.system[s].nc = out_[s];
    out.system[s].actual = feedback_.system[s].actual;
    out.system[s].begun = begun_[s];
    out.system[s].mirror = in_[s].mirror;
    std::copy(std::begin(in_[s].tool_angle), std::end(in_[s].tool_angle), out.system[s].tool_angle);
    out.system[s].refusal = refusal_[s];
    publish_overrides(s, &out.system[s]);
    out.system[s].axes = flags_[s];
    std::copy(std::begin(feedback_.system[s].spindle), std::end(feedback_.system[s].spindle), out.system[s].spindle);
  }
  out.single_block = single_block_;
  out.optional_stop = optional_stop_;
  out.resetting = reset_phase_ != ResetPhase::kNone;
  out.reset_held = reset_phase_ == ResetPhase::kHeld;
  out.resets = resets_;
  out.alarms = alarms_;
  ladder_->list_forces(&out.forces);
  out.overruns = statistics_.overruns.load(std::memory_order_relaxed);
  out.missed_slots = statistics_.missed_slots.load(std::memory_order_relaxed);
  for (unsigned w = 0; w < NC_WORDS; ++w) {
    out.interface_input[w] = interface_input_[w];
    out.interface_output[w] = macro_.output()[w];
  }
  snapshot_.store(out);
  if (history_ != nullptr) history_->look(out);
}

template class SeqLock<Snapshot>;

}  // namespace nc::rt
