// SPDX-License-Identifier: Apache-2.0
// Two part systems whose operator does anything, with causes of docs/safety.md in one, in the other and in both: starts, holds, single blocks and overrides of one or of all, resets,
// jogs, returns to the path and restarts of one while the other runs. In every scan: each keeps the limits of its axes, a brake is open only where its drive holds, behind
// an alarm both come to rest and nothing moves before somebody has asked for it, what is held stands, and an axis that knows where it stands is where it is shown.
#include "random_machine.hpp"

namespace {

using nc::rt::Answer;
using nc::rt::CommandKind;
using nc::rt::Mode;

constexpr unsigned kSystems = 2, kAxes = 3;

// What the drives of both part systems are given.
class BothMeasured final : public nc::hal::Hal {
 public:
  BothMeasured(const nc::rt::Config& config, nc::hal::SimMachine* machine) : config_(config), machine_(machine) {}
  bool start(const nc::hal::PointImage& initial, std::string* error) override { return machine_->start(initial, error); }
  void read(nc::hal::Feedback* feedback, nc::hal::PointImage* image) noexcept override { machine_->read(feedback, image); }
  void write(const nc::hal::Command& command, const nc::hal::PointImage& image) noexcept override {
    for (unsigned s = 0; s < kSystems; ++s)
      for (unsigned a = 0; a < config_.nc.system[s].axis_count; ++a) measure(s, a, command.system[s]);
    last = command;
    machine_->write(command, image);
  }
  void stop() noexcept override { machine_->stop(); }

  nc::hal::Command last{};
  double fastest = 0, hardest = 0;
  std::uint64_t moved[kSystems] = {};  // scans in which a drive was given another place

 private:
  void measure(unsigned s, unsigned a, const nc::hal::SystemCommand& command) noexcept {
    const nc_axis_config& axis = config_.nc.system[s].axis[a];
    const double dt = config_.nc.cycle_s, velocity = (command.position.v[a] - at_[s][a]) / dt;
    if (!command.enable || (command.off >> a & 1u) != 0) return void(known_[s][a] = 0);
    if (known_[s][a] >= 1) fastest = std::max(fastest, std::abs(velocity) / axis.max_velocity);
    if (known_[s][a] >= 2) hardest = std::max(hardest, std::abs(velocity - velocity_[s][a]) / dt / axis.max_acceleration);
    moved[s] += known_[s][a] >= 1 && velocity != 0;
    at_[s][a] = command.position.v[a];
    velocity_[s][a] = velocity;
    known_[s][a] = std::min(known_[s][a] + 1, 2);
  }

  const nc::rt::Config& config_;
  nc::hal::SimMachine* machine_;
  double at_[kSystems][kAxes] = {}, velocity_[kSystems][kAxes] = {};
  int known_[kSystems][kAxes] = {};
};

constexpr const char* kPrograms[kSystems][3] = {
    {"G90 G53 G0 X-20. Y10. Z-20.\nN1 G91\nG1 X60. Y-40. Z5. F9000\nG2 X20. Y20. I20. J0. F4000\nM8\nG4 X0.1\n#500=#500+1\nG0 X-60. Y30. Z8.\nG1 X-22. Y-11. Z-1. F6000\nGOTO 1\n",
     "G90 G53 G0 X0 Y0 Z-10.\nN1 G90 G81 X10. Y10. Z-20. R-12. F3000\nX20.\nX30. Y5.\nG80\nS500 M3\nG4 X0.05\nM5\nGOTO 1\n",
     "G90 G53 G0 X5. Y5. Z5.\nG1 X25. F3000\nT3 M6\nM0\nG1 Y40.\nM30\n"},
    {"G90 G53 G0 X10. Z-15.\nN1 G91\nG1 X40. Z-20. F7000\n#500=#500+1\nG0 X-40. Z20.\nM8\nM9\nGOTO 1\n",
     "G90 G53 G0 X0. Z0.\nN1 G90 G1 X20. F2000\n#501=#500\nZ12.\nX0.\nG4 X0.02\nZ0\nGOTO 1\n",
     "G90 G53 G0 X7. Z3.\nG91 G1 X-5. F1500\nT2\nG1 X5.\nM30\n"}};

class RandomSystems : public nc::test::RandomMachine {
 protected:
  static std::string machine_text() {
    std::string inputs = nc::test::input_points({"supply", "go_all", "go_1", "go_2", "x2_free_p"}, {"contact", "mode_hand", "mode_auto", "back_x2", "reset_button", "z2_servo_off"});
    inputs +=
        "[[point]]\nname = \"z2_brake\"\ndirection = \"output\"\n[signals]\n\"plc.power_fail_n\" = \"supply\"\n\"plc.alarm.1\" = \"contact\"\n\"plc.interlock_n\" = \"go_1\"\n\"plc2.interlock_n\" = \"go_2\"\n"
        "\"plc2.interlock_p_n.X\" = \"x2_free_p\"\n\"plc.mode_manual\" = \"mode_hand\"\n\"plc.mode_auto\" = \"mode_auto\"\n\"plc2.restart_approach.X\" = \"back_x2\"\n\"plc.reset\" = \"reset_button\"\n"
        "\"plc2.servo_off.Z\" = \"z2_servo_off\"\n\"plc2.feed_hold_n\" = \"go_all\"\n";
    const std::string second =
        "[[axis]]\nsystem = 2\nname = \"X\"\nmax_velocity = 120.0\nmax_acceleration = 900.0\nmax_jerk = 50000.0\nsoft_limits = [-200.0, 200.0]\nservo_lag_ms = 2.0\nfollowing_error_limit = 1.0\n"
        "homing = { kind = \"here\", offset = 0.0, order = 3 }\n"
        "[[axis]]\nsystem = 2\nname = \"Z\"\nmax_velocity = 80.0\nmax_acceleration = 700.0\nmax_jerk = 50000.0\nsoft_limits = [-150.0, 150.0]\nservo_lag_ms = 2.0\n"
        "brake = { point = \"z2_brake\", open_s = 0.05, close_s = 0.15 }\n";
    std::string text = changed({{"[signals]\n", inputs.c_str()}, {"servo_lag_ms = 2.0", "servo_lag_ms = 2.0\nfollowing_error_limit = 1.0"}, {"[[point]]\n", (second + "[[point]]\n").c_str()}});
    return text + "[[sim.axis]]\nname = \"Z2\"\nweight = 9810.0\n[power]\nstop_s = 0.5\nsettle_s = 0.03\n";
  }
  void TearDown() override { runtime.reset(); }  // before the machine that it has
  void build_both() {
    runtime.reset();
    config = nc::rt::Config();
    for (const nc::rt::ConfigError& error : nc::rt::parse_config(machine_text(), "systems.toml", &config)) ADD_FAILURE() << error.text();
    if (HasFailure()) return;
    machine = std::make_unique<nc::hal::SimMachine>(config.sim, config.points);
    both = std::make_unique<BothMeasured>(config, machine.get());
    std::vector<nc::rt::ConfigError> errors;
    runtime = nc::rt::Runtime::create(config, {&clock, both.get(), nullptr, nullptr}, &errors);
    ASSERT_NE(runtime, nullptr) << (errors.empty() ? "" : errors[0].text());
    std::string error;
    ASSERT_TRUE(runtime->start_stepping(&error)) << error;
    for (unsigned s = 0; s < kSystems; ++s)
      for (unsigned p = 0; p < 3; ++p) ASSERT_EQ(nc_program_add_text(runtime->control(), ("p" + std::to_string(s) + std::to_string(p)).c_str(), kPrograms[s][p], std::strlen(kPrograms[s][p]), &file_[s][p]), NC_OK);
    steps(250);
  }

  // ---- the operator ----

  unsigned one_or_all() { return below(3) == 0 ? nc::rt::kAllSystems : below(2); }
  unsigned axes_of(unsigned s) const { return config.nc.system[s].axis_count; }

  void operate() override {
    const unsigned s = below(2), axis = below(axes_of(s));
    switch (below(34)) {
      case 0:
      case 1: jog_ = {s, axis, either_way(1 + below(70)), 1 + below(1200)}; break;
      case 2: asked(give(CommandKind::kStep, s, axis, static_cast<double>(below(80)) - 40)); break;
      case 3: asked(give(CommandKind::kHome, s, axis)); break;
      case 4: asked(give(CommandKind::kHome, nc::rt::kAllSystems)); break;
      case 5: asked(give(CommandKind::kReference, s, axis)); break;
      case 6:
      case 7: (void)give(CommandKind::kReset, 0); break;
      case 8:
      case 9: hold_one(one_or_all()); break;
      case 10:
      case 11: asked(give(CommandKind::kCycleStart, one_or_all())); break;
      case 12:
      case 13: press("start"); break;
      case 14: press(below(2) == 0 ? "mode_hand" : "mode_auto"); break;
      case 15: press("back_x2", 1 + below(500)); break;
      case 16: (void)give(CommandKind::kSingleBlock, one_or_all(), 0, 0, below(2)); break;
      case 17: (void)give(CommandKind::kFeedOverride, one_or_all(), 0, below(3) == 0 ? 0.0 : below(200) / 100.0); break;
      case 18:
      case 24:
      case 25: begin_inside(); break;
      case 19:
      case 26:
      case 27:
      case 28:
      case 29:
      case 30:
      case 31: run_both(); break;
      case 20: press("reset_button"); break;
      case 21: (void)mode(static_cast<Mode>(below(3))); break;
      case 22: by_hand_in_hold(); break;
      default: asked(give(CommandKind::kApproach, s, axis, 40)); break;
    }
  }
  void hold_one(unsigned s) { (void)give(CommandKind::kFeedHold, s); }
  void run_both() {
    if (!comes_to_rest() || (below(4) != 0 && !homes_all())) return;
    (void)mode(Mode::kAuto);
    for (unsigned s = 0; s < kSystems; ++s)
      if (below(2) == 0) (void)give(CommandKind::kSelectProgram, s, 0, 0, file_[s][below(3)]);
    asked(give(CommandKind::kCycleStart, one_or_all()));
  }
  // As docs/restart.md says it, for one part system or for both, while causes come: what has come away must not begin, and what goes on stands where its program goes on.
  void begin_inside() {
    const unsigned chosen = 1 + below(3);
    const bool all = chosen == 3;
    if (!comes_to_rest() || !homes_all()) return;
    (void)mode(Mode::kAuto);
    for (unsigned s = 0; s < kSystems; ++s)
      if ((chosen >> s & 1u) != 0 && !finds(s)) return;
    for (unsigned s = 0; s < kSystems; ++s)
      if ((chosen >> s & 1u) != 0 && !all) asked(give(CommandKind::kCycleStart, s));
    if (all) asked(give(CommandKind::kCycleStart, nc::rt::kAllSystems));
    if (!scans_until([&] { return stands(chosen); }, 1500)) return;
    if (below(6) == 0) return;  // somebody goes away
    for (unsigned s = 0; s < kSystems; ++s)
      if ((chosen >> s & 1u) != 0) (void)give(CommandKind::kConfirmRestart, s, 0, 0, nc::rt::kEveryEntry);
    if (below(6) == 0) return void(give(CommandKind::kCancelRestart, below(2)));
    (void)mode(Mode::kManual);
    for (unsigned s = 0; s < kSystems; ++s)
      if ((chosen >> s & 1u) != 0 && !axes_come(s)) return;
    (void)mode(Mode::kAuto);
    goes_on_from_place(chosen, all);
  }
  bool comes_to_rest() {
    (void)give(CommandKind::kReset);
    return scans_until([this] { return !runtime->snapshot().resetting && runtime->snapshot().alarms.count == 0; }, 1000);
  }
  bool homes_all() {
    const auto homed = [this] { return runtime->snapshot().system[0].axes.homed == 7 && (runtime->snapshot().system[1].axes.homed & 1u) != 0; };
    if (homed()) return true;
    (void)mode(Mode::kManual);
    asked(give(CommandKind::kHome, nc::rt::kAllSystems));
    if (!scans_until([&] { return (runtime->snapshot().system[0].axes.homing | runtime->snapshot().system[1].axes.homing) != 0; }, 10)) return false;
    return scans_until([&] { return (runtime->snapshot().system[0].axes.homing | runtime->snapshot().system[1].axes.homing) == 0; }, 25000) && homed();
  }
  bool finds(unsigned s) {
    nc::rt::RestartWish wish;
    wish.by = below(2) == 0 ? nc::rt::RestartBy::kLastStop : nc::rt::RestartBy::kLine;
    wish.number = 2 + below(5);
    wish.passing = below(3);
    Answer answer = runtime->find_restart(s, wish);
    if (answer != Answer::kDone && wish.by == nc::rt::RestartBy::kLastStop) {
      wish.by = nc::rt::RestartBy::kLine;
      answer = runtime->find_restart(s, wish);
    }
    if (log_) std::printf("  %u: find %s\n", s, nc::rt::answer_text(answer));
    if (answer != Answer::kDone) return false;
    ++searched_;
    (void)scans_until([&] { return phase(s) != nc::rt::RestartPhase::kSearching; }, 3000);
    return phase(s) == nc::rt::RestartPhase::kFound;
  }
  nc::rt::RestartPhase phase(unsigned s) const { return runtime->info().system[s].restart.phase; }
  bool stands(unsigned chosen) const {
    for (unsigned s = 0; s < kSystems; ++s)
      if ((chosen >> s & 1u) != 0 && phase(s) != nc::rt::RestartPhase::kStands) return false;
    return true;
  }
  template <class Done>
  bool scans_until(Done done, int most) {
    for (int n = 0; n < most && !HasFatalFailure(); ++n) {
      if (done()) return true;
      if (below(6000) == 0) cause();
      scan();
    }
    return !HasFatalFailure() && done();
  }
  bool axes_come(unsigned s) {
    const unsigned first = below(axes_of(s));
    for (unsigned n = 0; n < axes_of(s); ++n) {
      const unsigned a = (first + n) % axes_of(s);
      const auto away = [&] { return (runtime->snapshot().system[s].nc.restart_axes >> a & 1u) != 0; };
      for (int times = 0; away() && times < 200; ++times) {
        const Answer answer = give(CommandKind::kApproach, s, a, 60);
        asked(answer);
        if (answer != Answer::kDone || HasFatalFailure()) return false;
        (void)scans_until([&] { return !away(); }, 50);
      }
      (void)give(CommandKind::kJog, s, a, 0);
      (void)scans_until([&] { return runtime->snapshot().system[s].nc.velocity.v[a] == 0; }, 300);
    }
    return !HasFatalFailure();
  }
  void goes_on_from_place(unsigned chosen, bool all) {
    const bool stood = stands(chosen);
    const nc::rt::Snapshot before = runtime->snapshot();
    for (unsigned s = 0; s < kSystems; ++s) {
      if ((chosen >> s & 1u) == 0 || (all && s != 0)) continue;
      const Answer answer = give(CommandKind::kCycleStart, all ? nc::rt::kAllSystems : s);
      asked(answer);
      if (answer != Answer::kDone) return;
      ASSERT_TRUE(stood) << "it has begun, and did not stand at its place";
    }
    for (unsigned s = 0; s < kSystems; ++s)
      for (unsigned a = 0; (chosen >> s & 1u) != 0 && a < axes_of(s); ++a)
        ASSERT_NEAR(before.system[s].nc.command.v[a], before.system[s].nc.return_place.v[a], 1e-6) << "it goes on from elsewhere";
    ++begun_inside_;
    both_begun_ += all;
  }
  void by_hand_in_hold() {
    (void)give(CommandKind::kFeedHold, nc::rt::kAllSystems);
    for (int n = 0; n < 300; ++n) scan();
    (void)mode(Mode::kManual);
    asked(give(CommandKind::kStep, below(2), 0, static_cast<double>(below(20)) - 10));
  }
  // ---- causes, for so many scans ----
  void cause() override {
    const unsigned scans = below(3) == 0 ? 1 + below(3) : 1 + below(400), s = below(2), axis = below(axes_of(s));
    if (log_) std::printf("  cause\n");
    switch (below(11)) {
      case 0: drive_[s][axis] = scans; break;
      case 1: bus_ = 1 + scans / 4; break;
      case 2: blocked_[s] = 10 + scans; break;
      case 3: hold("supply", 0, scans); break;
      case 4: hold("contact", 1, scans); break;
      case 5: hold("x_go", 0, scans); break;
      case 6: hold("go_all", 0, scans); break;
      case 7: hold(below(2) == 0 ? "z_servo_off" : "z2_servo_off", 1, scans * 3); break;
      case 8: hold("x2_free_p", 0, scans); break;
      case 9: hold(below(2) == 0 ? "go_1" : "go_2", 0, scans); break;
      default: hold("supply", 0, 1); break;
    }
  }
  // ---- what is looked at ----

  void look() override {
    const nc::rt::Snapshot now = runtime->snapshot();
    const int scans = scans_since(now);
    for (unsigned s = 0; s < kSystems; ++s) {
      SCOPED_TRACE("part system " + std::to_string(s + 1));
      look_at(s, now, scans);
      if (HasFatalFailure()) return;
    }
    stopped_for_ = now.stopped_by_alarm() ? stopped_for_ + scans : 0;
    quiet_ |= stopped_for_ > kStopScans;
    for (unsigned s = 0; s < kSystems; ++s) {
      if (!quiet_) moved_[s] = both->moved[s];
      ASSERT_EQ(both->moved[s], moved_[s]) << "nobody has asked for that, in part system " << s + 1;
    }
    ASSERT_LE(both->fastest, 1.001);
    ASSERT_LE(both->hardest, 1.001);
    quiets_ += quiet_;
  }
  void look_at(unsigned s, const nc::rt::Snapshot& now, int scans) {
    const nc_outputs& nc = now.system[s].nc;
    const unsigned z = axes_of(s) - 1;
    const nc::hal::SystemCommand& given = both->last.system[s];
    look_at_brake(s, z, given, nc, machine->outputs().value[point_of(s == 0 ? "z_brake" : "z2_brake")] != 0, s == 0 ? 200 : 150, scans);
    if (HasFatalFailure()) return;
    ASSERT_FALSE(nc.state == NC_STATE_RUNNING && now.mode == Mode::kManual) << "a program in mode manual";
    ASSERT_TRUE(stopped_for_ <= kStopScans || nc.distance_zero || nc.followed) << "an alarm, and it moves";
    held_for_[s] = nc.state == NC_STATE_HOLD ? held_for_[s] + scans : 0;
    ASSERT_TRUE(held_for_[s] <= kStopScans || nc.distance_zero || nc.followed) << "held, and it moves";
    const bool rests = nc.distance_zero && !nc.followed && given.enable;
    rests_for_[s] = rests ? rests_for_[s] + scans : 0;
    for (unsigned a = 0; a < axes_of(s) && rests_for_[s] > 300 && blocked_[s] == 0; ++a) {
      const bool homes = (config.equipment[s][a].homing.kind != nc::rt::HomingKind::kNone);
      if (!homes || (now.system[s].axes.homed >> a & 1u) == 0 || (given.off >> a & 1u) != 0) continue;
      if (s != 0) continue;  // its mark is where it stands
      ASSERT_NEAR(machine->place(s, a), nc.command.v[a], 0.02) << "axis " << a << " is not where it is shown";
      ++placed_;
    }
    ran_[s] += nc.state == NC_STATE_RUNNING && !nc.distance_zero;
    if (log_) std::printf("%u scan %llu state %d cause %d line %u at %.3f %.3f %.3f %s\n", s + 1, static_cast<unsigned long long>(now.scan), int{nc.state}, int{nc.cause}, nc.source.line, nc.command.v[0], nc.command.v[1], nc.command.v[2], alarm().c_str());
  }
  void begin() override {
    moving_buttons = {"back_x2"};
    rests_for_ = held_for_ = {};
    ASSERT_NO_FATAL_FAILURE(build_both());
    (void)mode(Mode::kManual);
    steps(3);
    if (below(5) != 0) {
      ASSERT_EQ(give(CommandKind::kHome, nc::rt::kAllSystems), Answer::kDone);
      steps(2);
      ASSERT_GE(until([this] { return runtime->snapshot().system[0].axes.homing == 0 && runtime->snapshot().system[0].axes.homed == 7; }), 0) << alarm() << refusal();
      steps(20);
    }
    (void)mode(Mode::kAuto);
    for (unsigned s = 0; s < kSystems; ++s) (void)give(CommandKind::kSelectProgram, s, 0, 0, file_[s][below(3)]);
    for (unsigned s = 0; s < kSystems; ++s) moved_[s] = both->moved[s];
  }

  std::unique_ptr<BothMeasured> both;
  unsigned file_[kSystems][3] = {};
  std::array<int, kSystems> rests_for_{}, held_for_{};
  std::uint64_t moved_[kSystems] = {}, ran_[kSystems] = {}, quiets_ = 0, placed_ = 0, searched_ = 0, begun_inside_ = 0, both_begun_ = 0;
};

TEST_F(RandomSystems, EachKeepsWhatItPromisesWhateverTheOtherDoes) {
  const std::uint64_t seeds = nc::test::seeds(6, 2);
  ASSERT_NO_FATAL_FAILURE(run_seeds(nc::test::wish("NC_FIRST_SEED", 1), seeds, 20000));
  std::printf("%llu and %llu scans of programs, %llu behind alarms, %llu places compared, %llu searches, %llu begun inside, %llu with both\n", static_cast<unsigned long long>(ran_[0]),
              static_cast<unsigned long long>(ran_[1]), static_cast<unsigned long long>(quiets_), static_cast<unsigned long long>(placed_), static_cast<unsigned long long>(searched_),
              static_cast<unsigned long long>(begun_inside_), static_cast<unsigned long long>(both_begun_));
  EXPECT_GT(ran_[0], 200 * seeds);
  EXPECT_GT(ran_[1], 200 * seeds);
  EXPECT_GT(placed_, 500 * seeds);
  EXPECT_GE(begun_inside_, seeds / 2) << "else it shows little of programs that are begun inside";
}

}  // namespace
