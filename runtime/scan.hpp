// SPDX-License-Identifier: Apache-2.0
// One scan, and the loop of scans on absolute deadlines.
//
// The order of a scan is a contract, and a test holds it:
//
//   1 inputs    HAL read: positions, FIN, skip, input points; operator commands; macro interface inputs
//   2 ladder    sees this scan's inputs and the NC's outputs of the scan before; has the last word on what
//               the NC gets
//   3 NC        nc_cycle(): one set of positions
//   4 outputs   macro interface outputs into the points; HAL write
//   5 snapshot  one consistent copy for readers
//
// run_once() is NC_RT: no allocation, no lock, no system call, bounded work. Everything it exchanges with
// other threads goes through single-producer queues, atomics and one sequence lock.
#pragma once

#include <atomic>
#include <cstdint>

#include "hal/hal.hpp"
#include "runtime/alarms.hpp"
#include "runtime/axes/axis_power.hpp"
#include "runtime/axes/homing.hpp"
#include "runtime/clock.hpp"
#include "runtime/command.hpp"
#include "runtime/config.hpp"
#include "runtime/histogram.hpp"
#include "runtime/history/scan_tap.hpp"
#include "runtime/hold_door.hpp"
#include "runtime/ladder_hook.hpp"
#include "runtime/macro_interface.hpp"
#include "runtime/nc_port.hpp"
#include "runtime/power/power_watch.hpp"
#include "runtime/restart/recovery_list.hpp"
#include "runtime/seqlock.hpp"
#include "runtime/snapshot.hpp"
#include "runtime/spsc.hpp"

namespace nc::rt {

// Figures of the loop. Execution: time from the wake-up to the end of the scan's body, always in real time. Jitter: time from
// the deadline to the wake-up, on the scan's clock.
struct ScanStatistics {
  Histogram execution, jitter;
  std::atomic<std::uint64_t> overruns{0};      // scans that ended after the end of their slot
  std::atomic<std::uint64_t> missed_slots{0};  // slots without a scan; the time of the path stands still in them
};

// True for an alarm that the scan must tell the NC: one that stops the machine and is not an alarm of the program, which libnc has raised itself.
bool stops_the_nc(const ActiveAlarm& alarm) noexcept;

// The commanded position in one scan, for drawings of the executed path.
struct PositionSample {
  std::uint8_t system = 0;
  bool rapid = false;
  nc_axes command{};
  nc_axes work{};  // the same position in workpiece coordinates, without the tool length
};

// Compiled in scan.cpp only: whoever reads a snapshot in each scan, as tests do, gets the optimized code.
extern template class SeqLock<Snapshot>;

class Scan {
 public:
  Scan(const Config& config, Clock* clock, hal::Hal* hal, LadderHook* ladder, NcPort* nc);

  // ---- scan thread ----
  // First deadline = now + one cycle.
  void begin() noexcept;
  // Sleeps until the next deadline, runs one scan and records its times.
  void loop_step() noexcept;
  // The body alone. NC_RT.
  void run_once() noexcept;

  // ---- one operator's thread ----
  bool post(const Command& command) noexcept { return commands_.push(command); }
  bool poll_answer(CommandAnswer* answer) noexcept { return answers_.pop(answer); }

  // ---- any thread ----
  HoldDoor& hold_door() { return hold_door_; }
  const HoldDoor& hold_door() const { return hold_door_; }
  Snapshot snapshot() const { return snapshot_.load(); }
  const ScanStatistics& statistics() const { return statistics_; }

  // ---- feeder thread ----
  // What is loaded in the control and ready to start, with kLoadedBits bits for each part system. A part program starts only in AUTO and MDI blocks only in
  // MDI, so that a start in one mode never begins something that was left over from the other mode in any part system.
  // kPartNotChecked: a part program that may not begin (StartGate).
  enum Loaded : std::uint8_t { kNothingLoaded = 0, kPartLoaded = 1, kMdiLoaded = 2, kPartNotChecked = 3 };
  static constexpr unsigned kLoadedBits = 2;
  void set_loaded(std::uint32_t loaded) noexcept { loaded_.store(loaded, std::memory_order_release); }
  // Whether a start would find a part program that may not begin. Any thread.
  bool any_not_checked() const noexcept;
  // Blocks of MDI wait that are to interrupt the program of a part system, which stands in a block stop (M700 12.4.4): `text` is their number, 0 = there are
  // none. They begin with a start in MDI; a start in AUTO waits until they are taken back.
  void set_mdi_waits(unsigned system, std::uint32_t text) noexcept { mdi_waits_[system].store(text, std::memory_order_release); }
  // The machine has come to rest after a reset: now the feeder resets the interpreter and calls reset_finished().
  bool reset_waits() const noexcept {
    return reset_rest_.load(std::memory_order_acquire) != reset_done_.load(std::memory_order_relaxed);
  }
  void reset_finished() noexcept {
    reset_done_.store(reset_rest_.load(std::memory_order_relaxed), std::memory_order_release);
  }
  struct Message {
    unsigned system;
    std::uint32_t text;
    std::uint32_t port;  // 0 = message to the operator, 1 = line for the external output
  };
  bool poll_message(Message* message) noexcept { return messages_.pop(message); }
  // A warning, with the next scan: something that a program of this part system has printed is lost.
  void post_print_trouble(unsigned system) noexcept { print_trouble_.fetch_or(1u << system, std::memory_order_release); }
  // Positions are recorded from now on, one per scan in which an axis moves. Before the threads start.
  void record_positions() { recording_ = true; }
  // Told of every scan. Before the threads start.
  void set_history(history::ScanTap* tap) { history_ = tap; }
  bool poll_position(PositionSample* sample) noexcept { return positions_.pop(sample); }
  // The optional block skips that the ladder sets for a part system; below, how often it has asked for a recalculation.
  std::uint32_t skip_switches(unsigned system) const noexcept {
    return skip_switches_[system].load(std::memory_order_relaxed);
  }
  std::uint32_t recalculations(unsigned system) const noexcept {
    return recalculations_[system].load(std::memory_order_acquire);
  }

  // A program that is begun inside (runtime/restart/), one bit per part system each: nothing starts while its place is looked for, a start of all part systems
  // begins only those whose place is found as long as there are such, and a program does not go on from the place while what it has given to the machine is not
  // there.
  void set_restart(std::uint32_t searches, std::uint32_t found, std::uint32_t bars, std::uint32_t stands, std::uint32_t lost) noexcept {
    restart_lost_.store(lost, std::memory_order_release);
    restart_found_.store(found, std::memory_order_release);
    restart_searches_.store(searches, std::memory_order_release);
    restart_bars_.store(bars, std::memory_order_release);
    restart_stands_.store(stands, std::memory_order_release);
  }
  // The external search that the machine asks for.
  SearchDoor& search(unsigned system) noexcept { return search_[system]; }
  // The codes that the machine has got, in their order.
  bool poll_given(GivenCode* code) noexcept { return given_.pop(code); }

  // The bits of a word #1132 to #1135 whose values come from the machine and not from a block, since the last call: the initial values of the points, and
  // values that a bus finds in its device (on_stop = "hold"). Returns their mask; *bits gets the whole word.
  std::uint32_t take_found_outputs(unsigned word, std::uint32_t* bits) noexcept {
    const std::uint32_t mask = output_found_[word].exchange(0, std::memory_order_acquire);
    *bits = output_value_[word].load(std::memory_order_relaxed);
    return mask;
  }

  // ---- the thread that keeps retained data ----
  // Raises alarm R19 or R20 in the next scan; a reset acknowledges it. `detail`: retain_detail(). The cause of R20 lasts until end_retain_trouble().
  void post_retain_trouble(unsigned detail) noexcept {
    if (!is_lost(static_cast<RetainTrouble>(detail % 4))) retain_holds_.fetch_or(1u << detail, std::memory_order_relaxed);
    retain_trouble_.fetch_or(1u << detail, std::memory_order_release);
  }
  void end_retain_trouble(unsigned detail) noexcept { retain_holds_.fetch_and(~(1u << detail), std::memory_order_relaxed); }
  // The retained data are to be written at once. save_asked() counts the requests; save_finished() answers all of them up to `request`.
  std::uint32_t save_asked() const noexcept { return save_asked_.load(std::memory_order_acquire); }
  void save_finished(std::uint32_t request, SaveResult result) noexcept {
    save_answered_.store(request * kSaveResults + static_cast<std::uint32_t>(result), std::memory_order_release);
  }
  // The power has failed and nobody has acknowledged it: kPowerFailed, and a bit for each part system whose program was in execution or interrupted. Else 0.
  static constexpr std::uint32_t kPowerFailed = 0x80000000u;
  std::uint32_t power_failed_in() const noexcept { return power_in_.load(std::memory_order_relaxed); }
  // Raises warning R25 with the next scan: the power failed in a program before this start.
  void post_found_place() noexcept { found_place_.store(true, std::memory_order_release); }
  // True once R25 has been acknowledged by an operator.
  bool place_seen() const noexcept { return place_seen_.load(std::memory_order_acquire); }
  // True once R19 has been acknowledged by an operator.
  bool retain_loss_seen() const noexcept { return retain_loss_seen_.load(std::memory_order_acquire); }

 private:
  // kStopping: the machine comes to rest. kFeeder: the feeder resets the interpreter. kHeld: the reset is done, but plc.reset is still on.
  enum class ResetPhase : std::uint8_t { kNone, kStopping, kFeeder, kHeld };
  struct Jog {
    std::uint8_t kind = NC_MANUAL_NONE;
    double value = 0;
    unsigned remaining = 0;  // number of scans for which the command is still given; ~0 = until the axis is there
    bool refused = false;    // a jog that was refused or stopped: it has no effect until it has been released
  };

  // What the scan keeps of an axis and what stands beside it (scan_axes.cpp, scan_homing.cpp).
  struct AxisWork {
    AxisHoming homing;
    AxisPower power;
    double drive = 0;      // where the drive says it is; kept, because a machine that does not answer leaves the last place as it was
    double shift = 0;      // machine position = that + this
    bool homed = false;
    bool waits_for_homing = false;  // home all has not come to it yet
    unsigned stop_scans = 0;        // so long its drive, which homes by itself, is told to stop
    bool sets = false;     // its position is set in this scan ...
    double set_by = 0;     // ... by so much
    double set_screw = 0;  // of that what the drive got for its screw
    bool sets_back = false;  // and that takes back what was counted in a machine lock
    bool locked = false;     // machine lock (scan_lock.cpp)
    double beside = 0;       // what was counted in it: machine position = drive + shift + that
    double held = 0;         // newest place that the drive was given
    ScrewCompensation screw;  // what the drive is given beyond that; not in drive and held
    bool limit[2] = {};       // it stands on its switch in -, in +
    bool blind[2] = {};       // which cannot be read
    bool limit_told[2] = {};  // its alarm has been raised
  };

  void read_inputs() noexcept;
  void tell_found_outputs(const std::uint32_t found[NC_WORDS]) noexcept;
  void bind_spindles() noexcept;
  void take_commands() noexcept;
  void hold_as_asked(std::uint32_t systems) noexcept;
  Answer apply(const Command& command) noexcept;
  std::uint32_t named_systems(const Command& command) const noexcept;
  std::uint32_t all_systems() const noexcept { return (1u << systems_) - 1; }
  bool is_taken_back(const Command& command) const noexcept;
  Answer start_cycle(std::uint32_t systems, bool all, Asker by, std::uint32_t held_since = 0) noexcept;
  std::uint32_t ready_systems(std::uint32_t systems, bool all) const noexcept;
  std::uint32_t head_with(Loaded wanted, bool all) const noexcept;
  void hold(std::uint32_t systems) noexcept;
  Answer set_mode(Mode mode) noexcept;
  Answer manual(const Command& command) noexcept;
  Answer jog(const Command& command) noexcept;
  Answer step_or_return(const Command& command) noexcept;
  Answer approach(const Command& command) noexcept;
  Answer approach_hindrance(unsigned system, unsigned axis) const noexcept;
  void follow_approach_button(unsigned system, unsigned axis, bool on, bool free) noexcept;
  // What the buttons of motion by hand ask for, mm/s or deg/s, before the axis' own limit.
  static double button_feed(const nc_axis_config& axis, const LadderRequests::System& now) noexcept { return now.rapid ? axis.rapid : std::max(0, now.jog_feed) / 60.0; }
  double approach_feed(unsigned system, unsigned axis, const LadderRequests& requests) const noexcept;
  void watch_approach(unsigned system, unsigned axis) noexcept;
  bool others_move(unsigned system, unsigned axis) const noexcept;
  Answer restart_hindrance(std::uint32_t ready) const noexcept;
  bool goes_on_from_path(unsigned system) const noexcept;
  void note_given() noexcept;
  void give_commands_by_hand(unsigned system) noexcept;
  void build_nc_inputs() noexcept;
  void run_ladder() noexcept;
  void follow_ladder(const LadderRequests& requests) noexcept;
  void watch_fin() noexcept;
  void watch_clamps(std::uint64_t most) noexcept;
  void watch_links() noexcept;
  bool is_raised(AlarmId id, std::uint32_t detail) const noexcept;
  bool is_of_lost_link(unsigned ladder_alarm) const noexcept;
  void watch_retained() noexcept;
  void watch_printer() noexcept;
  void watch_power(bool fails) noexcept;
  bool all_braked() const noexcept;
  bool has_brakes() const noexcept;
  void decide_overrides(const LadderRequests& requests) noexcept;
  Answer set_override(std::uint32_t systems, double value, double most, const bool* machines, double* operators) noexcept;
  void follow_ladder_manual(const LadderRequests& requests) noexcept;
  void request_reset() noexcept;
  void write_outputs() noexcept;
  void watch_machine() noexcept;
  void watch_soft_limits() noexcept;
  void watch_overruns() noexcept;
  void follow_requests() noexcept;
  void record_position(unsigned system) noexcept;
  void publish() noexcept;
  void publish_overrides(unsigned system, SystemSnapshot* out) const noexcept;
  void answer_commands() noexcept;

  void create_axes();
  void read_machine() noexcept;
  bool readable(int point) const noexcept;
  bool is_on(const Contact& contact) const noexcept;
  void look_at_axes() noexcept;
  void look_at_limits(unsigned system, unsigned axis) noexcept;
  void look_at_homed(unsigned system, unsigned axis) noexcept;
  bool limit_holds(const ActiveAlarm& alarm) const noexcept;
  Answer way_hindrance(unsigned system, unsigned axis, int direction) const noexcept;
  bool is_interlocked(unsigned system, unsigned axis, int direction) const noexcept;
  bool at_limit_switch(std::uint32_t systems) const noexcept;
  void run_axes() noexcept;
  void limit_by_hand(unsigned system, unsigned axis) noexcept;
  void give_up_way(unsigned system, unsigned axis, Answer why) noexcept;
  void hold_at_interlock(unsigned system) noexcept;
  void hold_positions(unsigned system) noexcept;
  std::uint32_t power_axes(unsigned system) noexcept;
  bool is_powerless(unsigned system, unsigned axis) const noexcept;
  bool any_powerless() const noexcept;

  bool limits_known(unsigned system, unsigned axis) const noexcept;
  int axis_not_homed(unsigned system) const noexcept;
  bool all_homed() const noexcept;
  bool is_homing() const noexcept;
  Answer homing_hindrance(unsigned system, unsigned axis) const noexcept;
  Answer search_hindrance(unsigned system, unsigned axis) const noexcept;
  Answer begin_homing(unsigned system, unsigned axis) noexcept;
  Answer home_command(const Command& command) noexcept;
  Answer draw_tap(unsigned system, bool on) noexcept;
  Answer tap_hindrance(unsigned system) const noexcept;
  void follow_tap(unsigned system) noexcept;
  void begin_next_homing() noexcept;
  void forget_order() noexcept;
  AxisHoming::Seen homing_sight(unsigned system, unsigned axis) const noexcept;
  void home(unsigned system, unsigned axis) noexcept;
  void end_search(unsigned system, unsigned axis) noexcept;
  bool homes_by_drive(unsigned system, unsigned axis) const noexcept;
  bool any_homes_by_drive() const noexcept;
  std::uint32_t drives_to_stop(unsigned system) noexcept;
  void set_positions(unsigned system) noexcept;
  void take_positions() noexcept;
  static void take_mark(AxisWork* axis) noexcept;
  void publish_axes(unsigned system) noexcept;

  void follow_locks(unsigned system) noexcept;
  bool lock_left(unsigned system, unsigned axis) const noexcept;
  void ask_to_set_back() noexcept { set_back_asked_ = all_systems(); }
  void set_back(unsigned system) noexcept;
  void give_to_drive(unsigned system, unsigned axis) noexcept;
  void publish_lock(unsigned system, unsigned axis) noexcept;

  bool raise(AlarmId id, unsigned system, int axis, std::uint32_t detail = 0, std::uint32_t code = 0) noexcept;
  ActiveAlarm* alarm_to_replace(const ActiveAlarm& by) noexcept;
  void tell_later(const ActiveAlarm& alarm) noexcept;
  void acknowledge_alarms() noexcept;
  bool holds_still(const ActiveAlarm& alarm) const noexcept;
  template <class Gone>
  void remove_alarms(Gone gone) noexcept {
    unsigned kept = 0;
    for (unsigned i = 0; i < alarms_.count; ++i)
      if (!gone(alarms_.alarm[i])) alarms_.alarm[kept++] = alarms_.alarm[i];
    alarms_.count = kept;
  }
  bool program_active() const noexcept { return active_systems() != 0; }
  std::uint32_t mdi_waiting() const noexcept;
  std::uint32_t mdi_beginning() const noexcept;
  void follow_mdi() noexcept;
  Mode mode_to_go_on() const noexcept { return mdi_runs_ != 0 ? Mode::kMdi : program_mode_; }
  std::uint32_t active_systems() const noexcept;
  std::uint32_t in_state(std::uint8_t state) const noexcept;
  bool at_rest() const noexcept;
  bool stands(unsigned system) const noexcept;
  void refuse(unsigned system, Asked asked, Answer why, int axis = -1, bool stopped = false, Asker by = Asker::kConsole) noexcept;
  void settle(Asked asked, Answer answer, Asker by) noexcept;
  void name_axis_away(unsigned system) noexcept;
  Asker machine_asker() const noexcept { return config_.ladder.program.empty() ? Asker::kPanel : Asker::kLadder; }
  void happened(unsigned system, Asked asked) noexcept;
  Answer in_reset() const noexcept { return reset_phase_ == ResetPhase::kHeld ? Answer::kResetHeld : Answer::kResetting; }
  bool at_soft_limit(unsigned system, unsigned axis, int direction) const noexcept;
  Answer hand_hindrance(unsigned system, unsigned axis) const noexcept;
  Answer jog_hindrance(unsigned system, unsigned axis, int direction) const noexcept;
  void watch_manual() noexcept;
  void watch_jog(unsigned system, unsigned axis) noexcept;
  void watch_way(unsigned system, unsigned axis) noexcept;
  bool is_held(int point) const noexcept;
  void turn_handwheels(LadderRequests* requests) noexcept;
  bool wheel_jumped(unsigned system, unsigned axis) const noexcept;
  int chosen_axis(const HandwheelConfig& wheel, bool* alone) const noexcept;
  void move_joysticks(LadderRequests* requests) noexcept;
  void watch_handle(unsigned system, unsigned axis) noexcept;
  bool handle_changes_length(const LadderRequests::System& now, unsigned axis) const noexcept;
  void watch_length_handle(unsigned system) noexcept;
  bool is_spindle_now(unsigned system, unsigned axis) const noexcept;
  bool machine_faulty() const noexcept;
  bool axes_stand() const noexcept;
  bool drives_not_following() const noexcept;
  void watch_standstill() noexcept;

  const Config& config_;
  Clock* clock_;
  hal::Hal* hal_;
  LadderHook* ladder_;
  NcPort* nc_;
  const unsigned systems_;
  const std::array<int, kLadderAlarms> alarm_point_;  // the point that is wired to plc.alarm.n+1; -1 = none
  const bool selects_spindles_;  // the ladder or wired points give the signals that select spindles
  const std::int64_t period_ns_;
  std::int64_t next_ns_ = 0;

  hal::Feedback feedback_{};
  hal::PointImage points_;
  MacroInterface macro_;
  nc_inputs in_[NC_MAX_SYSTEMS] = {};
  nc_outputs out_[NC_MAX_SYSTEMS] = {};
  nc_axes last_command_[NC_MAX_SYSTEMS] = {};
  std::uint32_t interface_input_[NC_WORDS] = {};
  hal::Command machine_{};

  Mode mode_ = Mode::kAuto;
  Mode program_mode_ = Mode::kAuto;  // mode in which the active program was started
  double feed_override_[NC_MAX_SYSTEMS], rapid_override_[NC_MAX_SYSTEMS];  // overrides that the operator has set
  bool machine_holds_[NC_MAX_SYSTEMS] = {};  // the machine gives a feed hold (plc.feed_hold_n is 0)
  bool machine_feeds_[NC_MAX_SYSTEMS] = {}, machine_rapids_[NC_MAX_SYSTEMS] = {};  // a switch of the machine gives the override
  bool feed_codes_[NC_MAX_SYSTEMS] = {};  // a switch gives codes of the feed override: one has been seen since the start
  std::uint32_t set_back_asked_ = 0;      // bit per part system: a reset takes back what was counted in a machine lock
  std::uint32_t single_block_ = 0, optional_stop_ = 0;  // set by the operator; one bit per part system
  LadderRequests last_requests_;     // requests of the previous scan
  unsigned ladder_start_scans_ = 0;  // number of scans for which the ladder's cycle start has been on
  std::uint32_t links_seen_ = 0;  // bit n: the n-th point bus has answered at least once
  std::uint64_t fin_scans_[NC_MAX_SYSTEMS] = {};  // number of scans for which a part system has waited for FIN
  std::uint64_t clamp_scans_[NC_MAX_SYSTEMS] = {};  // number of scans for which it has waited for the clamp of an index table
  std::uint8_t last_strobe_[NC_MAX_SYSTEMS] = {};  // strobes of the previous scan
  std::uint8_t fin_own_taken_[NC_MAX_SYSTEMS] = {};  // groups that have been completed by their own FIN, which is on now
  std::uint8_t fin_taken_[NC_MAX_SYSTEMS] = {};    // groups that have been completed by the FIN that is on now
  std::atomic<std::uint32_t> restart_searches_{0}, restart_found_{0}, restart_bars_{0}, restart_stands_{0}, restart_lost_{0};  // set_restart()
  std::uint8_t given_strobe_[NC_MAX_SYSTEMS] = {};  // strobes whose codes have been noted
  std::uint32_t approach_asked_[NC_MAX_SYSTEMS] = {};    // bit per axis: it is asked for in this scan to go back, with or without effect
  std::uint32_t approach_buttons_refused_[NC_MAX_SYSTEMS] = {};  // bit per axis: its button was refused or stopped and has been on since
  nc_axes begun_[NC_MAX_SYSTEMS] = {};              // SystemSnapshot::begun
  SpscQueue<GivenCode, 256> given_;
  std::atomic<std::uint32_t> mdi_waits_[NC_MAX_SYSTEMS] = {};  // set_mdi_waits()
  std::uint32_t mdi_started_[NC_MAX_SYSTEMS] = {};  // number of the text that was started last
  std::uint32_t mdi_runs_ = 0;                      // bit s: blocks of MDI that interrupt the program of part system s have been started and have not ended
  std::uint64_t mdi_serial_[NC_MAX_SYSTEMS] = {};   // newest item that was executed before them
  std::uint32_t start_pulse_ = 0;  // bit per part system: its program starts or goes on in this scan
  Asker start_by_[NC_MAX_SYSTEMS] = {};  // who has asked for the last start
  std::uint32_t hands_held_ = 0;    // bit per part system: what moves by hand is to come to rest and to be given up; until it stands
  std::uint32_t hold_request_ = 0;  // bit per part system: its program is to be held, until it stands
  std::uint32_t taps_drawn_ = 0;    // bit per part system: a command draws its tap out of the hole
  std::uint32_t taps_asked_ = 0;    // bit per part system: a signal or a command has asked for that in the scan before
  std::uint32_t taps_refused_ = 0;  // bit per part system: it was refused or stopped, and has been asked for since
  std::uint32_t held_now_ = 0;      // bit per part system: a command of this scan has held it
  bool ending_ = false;  // the control is being ended, and nothing starts any more
  Refusal refusal_[NC_MAX_SYSTEMS];
  struct JogWatch {
    Answer why = Answer::kDone;  // reason that was noted last
    bool went = false;           // the axis has moved since the jog was asked for
  };
  JogWatch jog_watch_[NC_MAX_SYSTEMS][NC_MAX_AXES];
  std::int8_t jog_asked_[NC_MAX_SYSTEMS][NC_MAX_AXES] = {};  // direction in which a jog is asked for in this scan, with or without effect
  std::uint8_t jog_without_feed_[NC_MAX_SYSTEMS] = {};       // bit per axis: a jog is asked for while the jog feed is 0
  std::uint32_t button_refused_[NC_MAX_SYSTEMS] = {};        // bit per axis: its jog button was refused or stopped and has been on since
  std::uint32_t pulses_lost_[NC_MAX_SYSTEMS] = {};           // bit per axis: pulses of its handle do not go to the NC in this scan
  Handwheel handwheel_[kMostHandwheels];
  std::uint32_t wheels_clash_[NC_MAX_SYSTEMS] = {};          // bit per axis: a wheel is turned whose axis another one has chosen, or that has chosen two
  Joystick joystick_[NC_MAX_SYSTEMS][NC_MAX_AXES];
  Answer handle_noted_[NC_MAX_SYSTEMS][NC_MAX_AXES] = {};    // reason for lost pulses that was noted last
  bool length_handle_noted_[NC_MAX_SYSTEMS] = {};            // that its pulses did not change the length along the tool axis was noted
  Asked on_its_way_[NC_MAX_SYSTEMS][NC_MAX_AXES] = {};       // a step or a reference return that has not ended
  // True from a fault of the machine to the end of the reset; meanwhile the commanded position follows the measured one.
  bool drives_off_ = false;
  nc_axes stood_at_[NC_MAX_SYSTEMS] = {};  // measured position since which stood_scans_ counts
  unsigned stood_scans_ = 0;               // number of scans for which the axes have stayed there
  bool alarm_was_given_[NC_MAX_SYSTEMS] = {};  // the NC's alarm state comes from an alarm of the runtime
  Jog jog_[NC_MAX_SYSTEMS][NC_MAX_AXES];
  AxisWork axes_[NC_MAX_SYSTEMS][NC_MAX_AXES];
  Answer hindered_[NC_MAX_SYSTEMS][NC_MAX_AXES] = {};  // what has kept motion by hand from its direction in this scan
  std::uint32_t interlock_waits_[NC_MAX_SYSTEMS] = {}; // a program waits: bit 2 n for axis n in -, bit 2 n + 1 in +
  AxisFlags flags_[NC_MAX_SYSTEMS];
  bool message_seen_[NC_MAX_SYSTEMS] = {};
  ResetPhase reset_phase_ = ResetPhase::kNone;
  unsigned reset_scans_ = 0;
  std::uint64_t resets_ = 0;  // that are done
  AlarmList alarms_;
  std::uint64_t scan_ = 0;
  std::int64_t scan_time_ns_ = 0;
  std::uint64_t missed_since_reset_ = 0;

  SpscQueue<Command, 64> commands_;
  HoldDoor hold_door_;
  SpscQueue<CommandAnswer, 128> answers_;
  CommandAnswer answered_[64];  // answers to the commands of this scan
  unsigned answered_count_ = 0;
  SpscQueue<Message, 64> messages_;
  bool recording_ = false;
  history::ScanTap* history_ = nullptr;
  SpscQueue<PositionSample, 4096> positions_;
  std::atomic<std::uint32_t> loaded_{kNothingLoaded};
  SearchDoor search_[NC_MAX_SYSTEMS];
  std::atomic<std::uint32_t> skip_switches_[NC_MAX_SYSTEMS] = {}, recalculations_[NC_MAX_SYSTEMS] = {};
  std::atomic<std::uint32_t> print_trouble_{0};   // bit per part system: a printed line was lost since the last scan
  std::atomic<std::uint32_t> retain_trouble_{0};  // bit per retain_detail(): the trouble was reported since the last scan
  std::atomic<std::uint32_t> retain_holds_{0};    // bit per retain_detail() of R20: the trouble has not ended
  std::atomic<bool> retain_loss_seen_{false};
  static constexpr std::uint32_t kSaveResults = 4;  // a request and its result in one word
  PowerWatch power_;
  std::atomic<std::uint32_t> save_asked_{0}, save_answered_{0}, power_in_{0};
  std::atomic<bool> found_place_{false}, place_seen_{false};
  std::atomic<std::uint32_t> reset_rest_{0}, reset_done_{0};
  std::atomic<std::uint32_t> output_found_[NC_WORDS] = {}, output_value_[NC_WORDS] = {};
  SeqLock<Snapshot> snapshot_;
  Snapshot building_;
  ScanStatistics statistics_;
};

}  // namespace nc::rt
