// SPDX-License-Identifier: Apache-2.0
// The virtual machine of `ncsim time`; see virtual_machine.hpp.
#include "tools/lib/virtual_machine.hpp"

#include <cmath>

#include "tools/lib/foresight.hpp"
#include "tools/lib/item_source.hpp"

namespace nc::tools {
namespace {

constexpr uint32_t kFeedBudget = 1024;            // blocks that one call of nc_feed() may read
constexpr uint64_t kMaxSilentFeeds = 16 * 1024;   // 16 M blocks in a row that commit nothing: an endless loop
constexpr uint64_t kMaxSilentBlocks = 1'000'000;  // blocks executed without motion, dwell or FIN
constexpr double kPatience = 10.0;  // s; a program that does not go on for this time is given up

class VirtualMachine {
 public:
  VirtualMachine(nc_control* control, const nc_config& config, const Setup& setup, Decides decides, const LoopLimits& loops, const ServoModel* servo)
      : control_(control),
        config_(config),
        setup_(setup),
        servo_(servo),
        passes_(std::move(decides)),
        world_(setup, config.system[0]),
        foresight_(&world_, config.system[0].axis_count),
        loops_(loops),
        actual_(setup.start) {
    out_[kPartSystem].command = setup.start;
    nc_commit_watch_set(control_, kPartSystem, committed, this);
  }
  ~VirtualMachine() { nc_commit_watch_set(control_, kPartSystem, nullptr, nullptr); }
  VirtualMachine(const VirtualMachine&) = delete;
  VirtualMachine& operator=(const VirtualMachine&) = delete;

  MachineResult run(double limit_s, const CycleObserver& observe) {
    nc_outputs& out = out_[kPartSystem];
    double waiting = 0.0;
    at_executed([&](const auto& next) { passes_.begin(next); });
    const uint64_t limit = static_cast<uint64_t>(limit_s / config_.cycle_s);
    for (uint64_t cycle = 0; cycle < limit; ++cycle) {
      if (!feed()) return give_up("the program is read on and on, and nothing comes of it: an endless loop of calculation");
      inputs(cycle);
      nc_cycle(control_, in_, out_);
      result_.cycles = cycle + 1;
      follow();
      if (observe && !observe(out)) return take(MachineResult::How::kStopped);
      if (out.state != NC_STATE_IDLE) started_ = true;
      if (out.state == NC_STATE_ALARM) return alarmed();
      take_events();
      if (result_.one_pass) return take(MachineResult::How::kEnded);
      if (given_up_ && executed_ == committed_) return give_up(loops_.verdict_and_option());
      if (started_ && out.state == NC_STATE_IDLE) return take(MachineResult::How::kEnded);
      // Nothing here will change a stopped spindle, a feed of 0 or a thread that is too fast, so such a program is stuck.
      const bool stuck = out.cause == NC_CAUSE_SPINDLE_STOPPED || out.cause == NC_CAUSE_FEED_ZERO || out.cause == NC_CAUSE_SPINDLE_FAST;
      const bool goes_on = started_ && out.state == NC_STATE_RUNNING && !stuck &&
                           (out.cause != NC_CAUSE_STARVED || out.blocks != blocks_before_);
      blocks_before_ = out.blocks;
      waiting = goes_on ? 0.0 : waiting + config_.cycle_s;
      if (!progresses(out))
        return give_up("line " + std::to_string(out.source.line) + ": " + std::to_string(kMaxSilentBlocks) +
                       " blocks in a row without motion, dwell or an M, S or T function: an endless loop of calculation");
      if (waiting > kPatience) return fail("line " + std::to_string(out.source.line) + ": " + reason(out.cause));
    }
    return give_up("not at its end after " + std::to_string(static_cast<uint64_t>(limit_s)) + " s of machine time (--max-seconds)");
  }

 private:
  // Reads ahead until the ring is full, because on virtual time the feeder is never late. False when nothing comes of it.
  bool feed() {
    for (uint64_t calls = 0; calls < kMaxSilentFeeds; ++calls) {
      const nc_status status = nc_feed(control_, kFeedBudget);
      if (status == NC_OK) calls = 0;
      if (status != NC_OK && status != NC_BUDGET) return true;
    }
    return false;
  }

  // Moves the axes as the simulated machine of the runtime does: with a servo of first order.
  void follow() {
    if (servo_ == nullptr) return;
    const nc_axes& command = out_[kPartSystem].command;
    for (unsigned i = 0; i < config_.system[kPartSystem].axis_count; ++i)
      actual_.v[i] += (command.v[i] - actual_.v[i]) * servo_->follow[i];
  }

  // The clamps of index tables (M700 9.3): they answer in the next cycle like FIN, or with a machine after its times.
  uint32_t clamps(uint32_t unclamp) {
    if (servo_ == nullptr) return unclamp;
    uint32_t unclamped = 0;
    for (unsigned i = 0; i < config_.system[kPartSystem].axis_count; ++i)
      if (clamp_[i].step(servo_->clamp[i], (unclamp >> i & 1u) != 0, config_.cycle_s)) unclamped |= 1u << i;
    return unclamped;
  }

  std::string reason(uint8_t cause) const {
    switch (cause) {
      case NC_CAUSE_SPINDLE_STOPPED: return "a feed per revolution or a thread waits for the spindle: there is no S";
      case NC_CAUSE_SPINDLE_FAST: return "at this S the thread needs more than the largest feed of its axes";
      case NC_CAUSE_FEED_ZERO: {
        char key[24];
        const bool named = nc_parameter_key_get(control_, NC_PARAMETER_DIGIT_FEED, key) == NC_OK;
        return "the speed of this feed of one digit is 0" + (named ? std::string(" (parameters from #") + key + " on)" : "");
      }
      default: return "the program does not go on (cause " + std::to_string(cause) + ")";
    }
  }

  // False after too many blocks that only calculate.
  bool progresses(const nc_outputs& out) {
    if (out.path_length != progress_length_ || out.strobe != 0 || out.cause == NC_CAUSE_DWELL) {
      progress_length_ = out.path_length;
      progress_blocks_ = out.blocks;
    }
    return out.blocks - progress_blocks_ < kMaxSilentBlocks;
  }

  void inputs(uint64_t cycle) {
    const nc_outputs& last = out_[kPartSystem];
    nc_inputs& in = in_[kPartSystem];
    // A rising edge of cycle start starts or continues the program, so the signal is off in the cycle before.
    const bool press = !started_ || last.state == NC_STATE_STOPPED || last.state == NC_STATE_HOLD;
    in.cycle_start = press && !in.cycle_start;
    in.actual_valid = servo_ != nullptr;
    in.actual = actual_;
    in.fin = last.strobe != 0;
    in.unclamped = clamps(last.unclamp);
    in.optional_stop = setup_.optional_stop;
    in.single_block = setup_.single_block;
    in.feed_override = 1.0;
    in.rapid_override = 1.0;
    turn_spindle(last);
    const bool tap = last.spindle_synchronous != 0;  // it stands at once, and turns with the path
    in.spindle[0].rev_per_s = (tap ? last.spindle_rev_min[0] : direction_ * last.s) / 60.0;
    in.spindle[0].turns_valid = true;
    if (tap && !tapped_) tap_from_ = in.spindle[0].turns - last.spindle_turns;
    in.spindle[0].turns = tap ? tap_from_ + last.spindle_turns : in.spindle[0].turns + in.spindle[0].rev_per_s * config_.cycle_s;
    tapped_ = tap;
    // The events of the setup come with their blocks, or at their time on the clock of the machine.
    world_.set_seconds(static_cast<double>(cycle) * config_.cycle_s);
    in.reset = started_ && foresight_.fire(last.serial);
    in.macro_interrupt = world_.macro_interrupt();
    const OutsideSignals outside = foresight_.signals(last.command, last.work);
    in.skip = outside.skip;
    for (int w = 0; w < NC_WORDS; ++w) in.input[w] = outside.input[w];
    in.clock_ms = setup_.clock_ms + whole_ms(static_cast<double>(cycle) * config_.cycle_s);
  }

  // Sets the direction of the spindle from the M code. It is forward until the first such code.
  void turn_spindle(const nc_outputs& last) {
    if ((last.strobe & 1u) == 0) return;
    const nc_code_role role = nc_code_role_get(static_cast<nc_dialect>(config_.dialect), 'M', last.m);
    if (role == NC_CODE_SPINDLE_FORWARD) direction_ = 1.0;
    if (role == NC_CODE_SPINDLE_REVERSE) direction_ = -1.0;
  }

  static bool committed(void* user, const nc_item* item) { return static_cast<VirtualMachine*>(user)->commits(*item); }
  bool commits(const nc_item& item) {
    if (given_up_) return false;
    uint32_t main_line = 0;
    nc_main_line_get(control_, kPartSystem, &item.source, &main_line);
    if (!foresight_.commit(item, main_line)) return false;
    committed_ = item.serial;
    // With a servo the measured position changes by itself, so reading it counts as well.
    const uint32_t by_itself = servo_ != nullptr ? NC_SYNC_CLOCK | NC_SYNC_POSITION : +NC_SYNC_CLOCK;
    if (world_.changes() || (item.kind == NC_ITEM_SYNC && (item.u.sync.what & by_itself) != 0)) loops_.asked();
    const auto state = [this] {
      uint64_t hash = 0;
      nc_program_state_hash(control_, kPartSystem, &hash);
      return hash;
    };
    if (item.kind == NC_ITEM_SYNC && (item.u.sync.what & NC_SYNC_INPUT) != 0) given_up_ = loops_.block_goes_on(item.source, state);  // within its block
    if (item.kind == NC_ITEM_MARK && item.u.mark.report) given_up_ = loops_.block(item.source, state);
    return true;  // the end of the pass is still executed, but nothing after it
  }

  // Takes the events of the cycle one by one, because several blocks may have ended in it.
  void take_events() {
    nc_event event = {};
    while (nc_event_poll(control_, kPartSystem, &event, nullptr) == NC_OK) {
      if (event.again && !passes_differ()) result_.one_pass = true;
      foresight_.executed(event.serial);
      executed_ = event.serial;
    }
  }

  // Lets `use` look at the common variables without what was read ahead, which belongs to later passes.
  template <typename Use>
  void at_executed(Use use) {
    const auto look = [](void* user, const nc_control* control) {
      (*static_cast<Use*>(user))([control](uint32_t from, uint32_t* number, double* value) {
        return nc_variable_next(control, kPartSystem, from, number, value) == NC_OK;
      });
    };
    nc_look_executed(control_, look, &use);
  }

  bool passes_differ() {
    bool differ = false;
    at_executed([&](const auto& next) { differ = passes_.differ(next); });
    return differ;
  }

  MachineResult take(MachineResult::How how) {
    const nc_outputs& out = out_[kPartSystem];
    result_.how = how;
    result_.seconds = out.run_s;
    result_.path_length = out.path_length;
    result_.blocks = out.blocks;
    if (how != MachineResult::How::kFailed) result_.unused = world_.unused();
    return result_;
  }
  MachineResult alarmed() {
    if (nc_alarm_get(control_, kPartSystem, &result_.alarm) != NC_OK) return fail("an alarm without a text");
    return take(MachineResult::How::kAlarmed);
  }
  MachineResult give_up(std::string why) {
    result_.error = std::move(why);
    return take(MachineResult::How::kEndless);
  }
  MachineResult fail(std::string why) {
    result_.error = std::move(why);
    return take(MachineResult::How::kFailed);
  }

  nc_control* control_;
  const nc_config& config_;
  const Setup& setup_;
  const ServoModel* servo_;
  double direction_ = 1.0;  // direction of the spindle
  bool tapped_ = false;     // a synchronous tap had it in the cycle before
  double tap_from_ = 0;     // its turns when the tap took it over
  Passes passes_;
  VirtualWorld world_;
  Foresight foresight_;
  LoopWatch loops_;
  nc_axes actual_;
  hal::SimClampState clamp_[NC_MAX_AXES];
  nc_inputs in_[NC_MAX_SYSTEMS] = {};
  nc_outputs out_[NC_MAX_SYSTEMS] = {};
  MachineResult result_;
  double progress_length_ = 0.0;
  uint64_t progress_blocks_ = 0, blocks_before_ = 0;
  uint64_t committed_ = 0, executed_ = 0;  // serial numbers of the last items that were committed and executed
  bool started_ = false, given_up_ = false;
};

}  // namespace

MachineResult run_machine(nc_control* control, const nc_config& config, const Setup& setup, Decides decides, double limit_s,
                          const LoopLimits& loops, const CycleObserver& observe, const ServoModel* servo) {
  return VirtualMachine(control, config, setup, std::move(decides), loops, servo).run(limit_s, observe);
}

}  // namespace nc::tools
